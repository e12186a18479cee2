"""One thin module per command group."""

import os

# Read by numpy's BLAS when it loads, so before any import of it. Our matrices are many and small: more threads than one
# only wait for one another and take time from the other work.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
