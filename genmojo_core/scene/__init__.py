"""The 4D scene: Gaussians, placement, deformation, background."""
