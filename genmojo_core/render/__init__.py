"""Differentiable Gaussian rasterisers behind one interface."""
