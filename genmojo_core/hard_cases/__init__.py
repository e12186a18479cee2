"""Hard cases that every installation can try on itself: hostile splats, clips and numbers, each with a property."""
