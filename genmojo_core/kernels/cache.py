"""Where compiled kernels live, and how they are declared."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numba


def kernel(function: Callable) -> Any:
    """Compile on first call, without the interpreter lock, kept on disk."""
    return numba.njit(nogil=True, cache=True, error_model="numpy")(function)


def inlined(function: Callable) -> Any:
    """A piece of a kernel: always inlined by LLVM, so tuples and vectors never touch memory."""
    return numba.njit(nogil=True, forceinline=True, error_model="numpy")(function)
