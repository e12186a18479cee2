"""Kernels for the priors on motion: numpy arrays in and out, no torch."""
