"""How often a view may draw while an optimiser works on the same processors, and what drawing costs the optimiser.

The cost is measured, not guessed: steps during which the view drew much are compared with steps during which it drew
little, as they come. Knows no Qt.
"""

from __future__ import annotations

import statistics
from collections import deque
from dataclasses import dataclass, field

MOST = 0.06  # of a step that drawing may add; above, there are fewer frames
FASTEST, SLOWEST = 0.05, 0.1  # seconds between two frames while something moves
FIRST = 0.08  # before anything is known
BUSY, CALM = 0.12, 0.03  # drawing for more of a step makes it a busy one, for less a calm one
_KEPT = 40  # steps of each kind that are compared
_ENOUGH = 10


@dataclass
class Pace:
    """Told of every frame and every step; `interval` seconds should lie between two frames."""

    interval: float = FIRST
    share: float = 0.0  # of a step that drawing adds, as last measured
    _drawn: float = 0.0
    _busy: deque[float] = field(default_factory=lambda: deque(maxlen=_KEPT))
    _calm: deque[float] = field(default_factory=lambda: deque(maxlen=_KEPT))
    _fresh: int = 0  # busy steps since the interval last changed

    def drew(self, seconds: float) -> None:
        """A frame took so long."""
        self._drawn += seconds

    def stepped(self, seconds: float) -> None:
        """A step of the optimiser took so long, by its own clock."""
        share, self._drawn = self._drawn / max(seconds, 1e-9), 0.0
        if share <= CALM:
            self._calm.append(seconds)
        elif share >= BUSY:
            self._busy.append(seconds)
            self._fresh += 1
            if self._fresh >= _ENOUGH and len(self._calm) >= _ENOUGH:
                self._judge()

    def _judge(self) -> None:
        """Fewer frames while they cost more than MOST, more while they cost next to nothing."""
        newest = list(self._busy)[-self._fresh :]
        self.share = max(0.0, statistics.median(newest) / statistics.median(self._calm) - 1.0)
        if self.share > MOST:
            self.interval = min(self.interval * 1.25, SLOWEST)
        elif self.share < MOST / 3:
            self.interval = max(self.interval / 1.25, FASTEST)
        self._fresh = 0
