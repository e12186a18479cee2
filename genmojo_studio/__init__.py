"""GenMOJO Studio: the desktop app."""
