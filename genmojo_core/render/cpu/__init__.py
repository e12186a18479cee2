"""CPU kernels: numpy arrays in and out, no torch."""
