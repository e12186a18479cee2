"""K-plane sampling kernels: numpy arrays in and out, no torch."""
