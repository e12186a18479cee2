"""Python's cyclic garbage collected on the UI thread only.

Closed windows are cycles. Python collects on whatever thread happens to allocate; there the Python halves of widgets
would die while Qt still delivers events to them (background.py).
"""

from __future__ import annotations

import gc

from PySide6.QtCore import QObject, QTimer

_EVERY_MS = 250
_OLDEST = 2  # generation
MOST = 50_000  # objects that a collection may go through; it takes half a microsecond for each, and the window waits


class Collector(QObject):
    """Collects by Python's own thresholds, from a timer of the thread that made it, instead of Python.

    What outlived a full collection is not gone through again until the next `sweep`: with hours of curves and pictures
    in memory that would hold up the window. Nor are more than `MOST` objects that came at once: that is what a thread
    leaves behind when it loads a library.
    """

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        gc.disable()
        self.sweep()
        self._timer = QTimer(self, interval=_EVERY_MS)
        self._timer.timeout.connect(self.collect)
        self._timer.start()

    def collect(self) -> None:
        """The oldest generation that is due."""
        due = [
            g for g, (count, most) in enumerate(zip(gc.get_count(), gc.get_threshold(), strict=True)) if count > most
        ]
        if not due:
            return
        if sum(len(gc.get_objects(g)) for g in range(due[-1] + 1)) > MOST:
            gc.freeze()
            return
        gc.collect(due[-1])
        if due[-1] == _OLDEST:
            gc.freeze()

    def sweep_soon(self) -> None:
        """As `sweep`, in a turn of its own."""
        QTimer.singleShot(0, self, self.sweep)

    def sweep(self) -> None:
        """Everything, however old; for moments when the window changes as a whole."""
        gc.unfreeze()
        gc.collect()
        gc.freeze()
