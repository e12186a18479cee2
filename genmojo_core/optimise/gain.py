"""What the next minute of a run is expected to buy, extrapolated from its measured accuracy-against-time curve.

The tail of such curves is close to a line over the logarithm of the time since measuring began. The line is fitted to
the last half of the points; its slope's standard error gives the spread. Nothing is said before a quarter of the time
that is looked ahead has been seen. Imports no torch: the app draws the same line.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

FEWEST = 6  # points below which nothing is said
SEEN_SHARE = 0.25  # of the time looked ahead that must have been seen


@dataclass(frozen=True)
class Gain:
    """Expected dB in the `seconds` after the curve's end, with one standard error, and the fitted line.

    The line is psnr = level + slope * ln(t - origin), t in seconds of the run.
    """

    decibel: float
    spread: float
    seconds: float
    level: float
    slope: float
    origin: float

    def at(self, seconds: np.ndarray) -> np.ndarray:
        """The line in dB at some seconds of the run, later than the origin."""
        return self.level + self.slope * np.log(seconds - self.origin)


def expected(curve: Sequence[tuple[float, float]], seconds: float = 60.0) -> Gain | None:
    """The gain over the next `seconds`; None while there are fewer than six points or too short a time.

    Args:
        curve: rows (seconds since the start, PSNR in dB), in order.
    """
    points = np.array([row for row in curve if math.isfinite(row[1])], np.float64).reshape(-1, 2)
    if len(points) < FEWEST or points[-1, 0] - points[0, 0] < SEEN_SHARE * seconds:
        return None
    origin = float(points[0, 0] - np.median(np.diff(points[:, 0])))
    tail = points[min(len(points) // 2, len(points) - FEWEST) :]
    x, y = np.log(tail[:, 0] - origin), tail[:, 1]
    spread_x = float(((x - x.mean()) ** 2).sum())
    if spread_x < 1e-12:
        return None
    slope = max(float(((x - x.mean()) * (y - y.mean())).sum() / spread_x), 0.0)  # a run keeps what it has
    level = float(y.mean() - slope * x.mean())
    rest = y - level - slope * x
    error = math.sqrt(float((rest**2).sum()) / max(len(tail) - 2, 1) / spread_x)
    factor = math.log1p(seconds / (points[-1, 0] - origin))
    return Gain(slope * factor, error * factor, seconds, level, slope, origin)


class StopRule:
    """Says when a run buys too little: the expected gain stays under a limit for a few points in a row."""

    def __init__(self, patience: int = 3) -> None:
        self._patience = patience
        self._under = 0
        self._seen = 0

    def reached(self, curve: Sequence[tuple[float, float]], least_per_minute: float) -> bool:
        """True once the gain of the next minute was under `least_per_minute` dB at `patience` new points in a row."""
        if len(curve) == self._seen:
            return False
        self._seen = len(curve)
        gain = expected(curve, 60.0)
        self._under = self._under + 1 if gain is not None and gain.decibel < least_per_minute else 0
        return self._under >= self._patience
