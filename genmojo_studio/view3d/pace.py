"""How often a view may draw while an optimiser works on the same processors, and what drawing costs the optimiser.

The cost is measured, not guessed: steps during which the view drew much are compared with steps of the same stage
during which it drew little, as they come. It cannot be more than the window's own processor seconds. Knows no Qt.
"""

from __future__ import annotations

import statistics
from collections import deque
from dataclasses import dataclass, field

MOST = 0.06  # of a step that drawing may add; above, there are fewer frames
FASTEST, SLOWEST = 0.05, 0.1  # seconds between two frames while something moves
FIRST = 0.08  # before anything is known
BUSY, CALM = 0.12, 0.03  # drawing for more of a step makes it a busy one, for less a calm one
_KEPT = 20  # steps of each kind that are compared
_ENOUGH = 10

Steps = deque[tuple[float, float]]  # seconds, and processor seconds of the window meanwhile


@dataclass
class Pace:
    """Told of every frame and every step; `interval` seconds should lie between two frames."""

    interval: float = FIRST
    _drawn: float = 0.0
    _slower: float = 0.0  # how much longer a busy step takes, as last measured
    _recent: deque[bool] = field(default_factory=lambda: deque(maxlen=_KEPT))  # was it a busy step?
    _busy: Steps = field(default_factory=lambda: deque(maxlen=_KEPT))
    _calm: Steps = field(default_factory=lambda: deque(maxlen=_KEPT))
    _fresh: int = 0  # busy steps since the interval last changed

    @property
    def share(self) -> float:
        """What drawing adds to the run's time now: nothing for a view that stands still."""
        return self._slower * sum(self._recent) / max(len(self._recent), 1)

    def drew(self, seconds: float) -> None:
        """A frame took so long."""
        self._drawn += seconds

    def another_stage(self) -> None:
        """Steps take another time from now on: nothing is known about them."""
        self._busy.clear()
        self._calm.clear()
        self._slower, self._fresh = 0.0, 0

    def stepped(self, seconds: float, used: float) -> None:
        """A step took so long, by the optimiser's clock; meanwhile the window used so many processor seconds."""
        share, self._drawn = self._drawn / max(seconds, 1e-9), 0.0
        self._recent.append(share >= BUSY)
        if share <= CALM:
            self._calm.append((seconds, used))
        elif share >= BUSY:
            self._busy.append((seconds, used))
            self._fresh += 1
            if self._fresh >= _ENOUGH and len(self._calm) >= _ENOUGH:
                self._judge()

    def _judge(self) -> None:
        """Fewer frames while they cost more than MOST, more while they cost next to nothing."""
        slower = _median(self._busy, 0) / _median(self._calm, 0) - 1.0
        most = _median(self._busy, 1) / _median(self._busy, 0)
        self._slower = max(0.0, min(slower, most))
        if self.share > MOST:
            self.interval = min(self.interval * 1.25, SLOWEST)
        elif self.share < MOST / 3:
            self.interval = max(self.interval / 1.25, FASTEST)
        self._fresh = 0


def _median(steps: Steps, column: int) -> float:
    return statistics.median(step[column] for step in steps)
