"""Image, view, track and time measurements."""
