"""Do compiled kernels work on this machine? Asked once; where they do not, plain torch does the work."""

from __future__ import annotations

import importlib
import warnings
from functools import lru_cache


@lru_cache(maxsize=1)
def kernels_work() -> bool:
    """Compile and run one small kernel with the unusual instructions; False, with one warning, where that fails."""
    try:
        fault = importlib.import_module("genmojo_core.kernels.trial").run()
    except (ImportError, OSError, RuntimeError, TypeError, ValueError, NotImplementedError) as error:
        fault = f"{type(error).__name__}: {error}".splitlines()[0]
    if fault:
        warnings.warn(
            f"The compiled CPU kernels do not work here ({fault}); plain torch is used, many times slower.",
            RuntimeWarning,
            stacklevel=2,
        )
    return not fault
