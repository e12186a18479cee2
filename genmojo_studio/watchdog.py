"""Notices when the window does not answer: a timer that should fire every 20 ms and looks how late it is.

A late tick has two causes: the UI thread worked (a fault of ours), or the machine gave it no time. The thread's own CPU
time tells them apart.
"""

from __future__ import annotations

import logging
import time

from PySide6.QtCore import QObject, Qt, QTimer

LOG = logging.getLogger("genmojo_studio")
_PERIOD_MS = 20
STALL_MS = 100.0


class Watchdog(QObject):
    """Logs every stall of the event loop over 100 ms.

    For tests: `longest` (ms) and `stalls`, pairs of milliseconds late and milliseconds the UI thread worked meanwhile.
    """

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.longest = 0.0
        self.stalls: list[tuple[float, float]] = []
        self._last, self._worked = time.monotonic(), time.thread_time()
        self._timer = QTimer(self, interval=_PERIOD_MS, timerType=Qt.TimerType.PreciseTimer)
        self._timer.timeout.connect(self._tick)
        self._timer.start()

    def reset(self) -> None:
        """Forgets what it saw."""
        self.longest, self.stalls = 0.0, []
        self._last, self._worked = time.monotonic(), time.thread_time()

    def _tick(self) -> None:
        now, worked = time.monotonic(), time.thread_time()
        late, busy = (now - self._last) * 1000 - _PERIOD_MS, (worked - self._worked) * 1000
        self._last, self._worked = now, worked
        self.longest = max(self.longest, late)
        if late > STALL_MS:
            self.stalls.append((late, busy))
            LOG.info("the window did not answer for %.0f ms, of which it worked %.0f ms", late, busy)
