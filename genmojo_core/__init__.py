"""GenMOJO core: multi-object video to 4D Gaussian scenes and point tracks."""

__version__ = "0.1.0"
