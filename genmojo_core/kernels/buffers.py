"""Large arrays used again instead of given back to the system, which would hand out fresh pages at every step.

`take` gives an array that nobody else holds any more. An array is free again as soon as every view of it is gone: the
number of references that Python keeps of each object tells. Filling fresh pages costs a tenth of a small picture.
"""

from __future__ import annotations

import math
import sys
import threading
from itertools import accumulate
from typing import Any

import numpy as np

LINE = 64  # bytes of a cache line: vectors of arrays that start on one never lie across two
LIMIT = 2**28  # bytes kept in all; what goes beyond is an ordinary array
SMALLEST = 2**16  # bytes: below, the system's own allocation is as fast

_kept: list[np.ndarray] = []
_lock = threading.Lock()
_COUNTS = sys.implementation.name == "cpython"
_sample = [np.empty(1)]
_FREE = sys.getrefcount(_sample[0]) if _COUNTS else 0  # of an array that only a list holds


def take(shape: tuple[int, ...], dtype: Any = np.float32) -> np.ndarray:
    """An array of any content, C order; free for others once the caller's last view of it is gone."""
    size = math.prod(shape) * np.dtype(dtype).itemsize
    if size < SMALLEST or size > LIMIT or not _COUNTS:
        return np.empty(shape, dtype)
    with _lock:
        return on_line(_free(size + LINE), size).view(dtype).reshape(shape)


def take_together(*wanted: tuple[tuple[int, ...], Any]) -> list[np.ndarray]:
    """Arrays of these (shape, dtype)s as `take` gives them, out of one block: free once the last view of any is gone.

    The block itself, flat uint8 with all of them side by side, comes last.
    """
    sizes = [math.prod(shape) * np.dtype(dtype).itemsize for shape, dtype in wanted]
    ends = list(accumulate(-(-size // LINE) * LINE for size in sizes))
    block = take((ends[-1],), np.uint8)
    found = []
    for (shape, dtype), size, end in zip(wanted, sizes, ends, strict=True):
        start = end + (-size // LINE) * LINE
        found.append(np.ndarray(shape, dtype, block, start))
    return [*found, block]


def on_line(array: np.ndarray, size: int) -> np.ndarray:
    """`size` bytes of a flat uint8 array of at least LINE more, from the start of a cache line on."""
    first = -array.__array_interface__["data"][0] % LINE
    return array[first : first + size]


def zeros(shape: tuple[int, ...], dtype: Any = np.float32) -> np.ndarray:
    """The same, filled with 0."""
    array = take(shape, dtype)
    array.fill(0)
    return array


def _free(size: int) -> np.ndarray:
    """A kept array of at least `size` bytes and at most twice that, or a new one that is kept where there is room."""
    for place in range(len(_kept)):
        if size <= _kept[place].size <= 2 * size and sys.getrefcount(_kept[place]) == _FREE:
            return _kept[place]
    fresh = np.empty(size + (-size) % 64, np.uint8)
    while _kept and sum(a.size for a in _kept) + fresh.size > LIMIT:
        idle = next((i for i in range(len(_kept)) if sys.getrefcount(_kept[i]) == _FREE), None)
        if idle is None:
            return fresh
        del _kept[idle]
    _kept.append(fresh)
    return fresh
