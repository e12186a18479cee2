"""View-synthesis priors behind one interface."""
