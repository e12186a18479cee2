"""The optimisation as a program of its own: how the window starts it, talks to it, sees it and outlives it."""
