"""Many clips: local or on a cluster."""
