"""Memory of decoded frames, used again: at 1080p the pages of fresh memory cost half as much as decoding into them."""

from __future__ import annotations

import sys
import threading

import numpy as np


class FrameBuffers:
    """Arrays of one shape that are handed out again once nobody holds them, or a part of them, any more.

    Args:
        shape: of every array, uint8. most: how many are kept at most; beyond that memory is fresh.
    """

    def __init__(self, shape: tuple[int, ...], most: int) -> None:
        self._shape, self._most = shape, most
        self._owners: list[np.ndarray] = []  # every view and slice of an owner counts as a reference to it
        self._idle = 0  # references to an owner that nobody uses
        self._lock = threading.Lock()

    def take(self) -> np.ndarray:
        """An array with anything in it; it belongs to the caller as long as it is held."""
        with self._lock:
            for k in range(len(self._owners)):
                if self._references(k) == self._idle:
                    return self._owners[k].view()
            if len(self._owners) >= self._most:
                return np.empty(self._shape, np.uint8)
            self._owners.append(np.empty(self._shape, np.uint8))
            self._idle = self._references(len(self._owners) - 1)
            return self._owners[-1].view()

    def clear(self) -> None:
        """Keep nothing; what is held elsewhere lives on."""
        with self._lock:
            self._owners.clear()

    def _references(self, k: int) -> int:
        return sys.getrefcount(self._owners[k])
