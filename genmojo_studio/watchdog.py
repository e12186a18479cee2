"""Notices when the window does not answer: a timer that should fire every 50 ms and looks how late it is."""

from __future__ import annotations

import logging
import time

from PySide6.QtCore import QObject, Qt, QTimer

LOG = logging.getLogger("genmojo_studio")
_PERIOD_MS = 50
STALL_MS = 100.0


class Watchdog(QObject):
    """Logs every stall of the event loop over 100 ms. `longest` and `stalls` (ms) are there for tests."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.longest = 0.0
        self.stalls: list[float] = []
        self._last = time.monotonic()
        self._timer = QTimer(self, interval=_PERIOD_MS, timerType=Qt.TimerType.PreciseTimer)
        self._timer.timeout.connect(self._tick)
        self._timer.start()

    def reset(self) -> None:
        """Forgets what it saw."""
        self.longest, self.stalls, self._last = 0.0, [], time.monotonic()

    def _tick(self) -> None:
        now = time.monotonic()
        late = (now - self._last) * 1000 - _PERIOD_MS
        self._last = now
        self.longest = max(self.longest, late)
        if late > STALL_MS:
            self.stalls.append(late)
            LOG.info("the window did not answer for %.0f ms", late)
