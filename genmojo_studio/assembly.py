"""Something large made one part per turn of the event loop, so that the window answers in between."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from PySide6.QtCore import QObject, QTimer


class Assembly(QObject):
    """Goes through the parts of something, a turn of the event loop each; all that are left at once where it must be.

    Args:
        parts: makes one part each time it is asked for the next.
    """

    def __init__(self, parts: Iterator[None], parent: QObject) -> None:
        super().__init__(parent)
        self._parts = parts
        self._then: list[Callable[[], object]] = []
        self._timer = QTimer(self, interval=0, singleShot=True)
        self._timer.timeout.connect(self._turn)

    def start(self, then: Callable[[], object] | None = None) -> None:
        """Makes the parts that are left, then does something."""
        if then is not None:
            self._then.append(then)
        self._timer.start()

    def finish(self) -> None:
        """Makes all parts that are left now."""
        for _ in self._parts:
            continue

    def stop(self) -> None:
        """What is not made yet never is."""
        self._timer.stop()
        self._then.clear()

    def _turn(self) -> None:
        for _ in self._parts:
            self._timer.start()
            return
        waiting, self._then = self._then, []
        for then in waiting:
            then()
