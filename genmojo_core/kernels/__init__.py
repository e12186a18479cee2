"""How CPU kernels are written, compiled, kept on disk and run on threads. No torch."""

import os

# numba builds thousands of error messages while it looks for types, and throws them away. Their colours alone are a
# twentieth of the compile time; numba reads this when it is imported, which happens behind this package.
os.environ.setdefault("NUMBA_DISABLE_ERROR_MESSAGE_HIGHLIGHTING", "1")
