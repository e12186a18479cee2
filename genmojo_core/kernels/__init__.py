"""How CPU kernels are written, compiled, kept on disk and run on threads. No torch."""
