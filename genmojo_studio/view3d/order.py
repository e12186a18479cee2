"""Drawing order: farthest first by linear view z, exact for every frame up to 150 000 splats.

The key is the one the optimiser's rasteriser sorts by; ties keep the order of rows, drawn back to front, so the row
that the rasteriser puts in front is drawn last. Larger scenes are sorted on a thread of their own, and the view draws
with the newest finished order meanwhile.
"""

from __future__ import annotations

import threading
from collections.abc import Callable

import numpy as np

EXACT_UP_TO = 150_000


def back_to_front(depth: np.ndarray) -> np.ndarray:  # (M,) float -> (M,) uint32
    """Rows from the farthest to the nearest; equal depths from the last row to the first; NaN first.

    A radix sort of two passes over float32 keys made monotonic: numpy sorts 16-bit keys in linear time.
    """
    bits = np.ascontiguousarray(depth, np.float32).view(np.uint32)
    key = bits ^ np.where(bits >> 31, np.uint32(0xFFFFFFFF), np.uint32(0x80000000))
    order = np.argsort((key & 0xFFFF).astype(np.uint16), kind="stable")
    order = order[np.argsort((key >> 16).astype(np.uint16)[order], kind="stable")]
    return order[::-1].astype(np.uint32)


class Sorter:
    """Orders for one renderer: at once for small scenes, by a worker thread for large ones (newest request wins).

    Args:
        done: called on the worker thread when an order is ready; must only wake the owner up.
    """

    def __init__(self, done: Callable[[], None] | None = None) -> None:
        self.done = done
        self._lock = threading.Condition()
        self._request: tuple[object, np.ndarray, np.ndarray] | None = None
        self._ready: tuple[object, np.ndarray] | None = None
        self._thread: threading.Thread | None = None
        self._stopped = False

    def request(self, key: object, rows: np.ndarray, depth: np.ndarray) -> None:
        """Sort rows (M,) by depth (M,) in the background; `take` gives the result under its key."""
        with self._lock:
            self._request = (key, rows, depth)
            if self._thread is None:
                self._thread = threading.Thread(target=self._work, name="splat-sort", daemon=True)
                self._thread.start()
            self._lock.notify()

    def take(self) -> tuple[object, np.ndarray] | None:
        """The newest finished (key, rows in drawing order), once; None where nothing is new."""
        with self._lock:
            ready, self._ready = self._ready, None
            return ready

    def stop(self) -> None:
        """End the thread; harmless if there is none."""
        with self._lock:
            self._stopped = True
            self._lock.notify()
        if self._thread is not None:
            self._thread.join(timeout=5)
            self._thread = None

    def _work(self) -> None:
        """The thread: numpy sorts without the interpreter lock."""
        while True:
            with self._lock:
                while self._request is None and not self._stopped:
                    self._lock.wait()
                if self._stopped or self._request is None:
                    return
                key, rows, depth = self._request
                self._request = None
            order = rows[back_to_front(depth)]
            with self._lock:
                self._ready = (key, order)
            if self.done is not None:
                self.done()
