"""Point tracks: model, interpolation, metrics."""
