"""How long work may take, and whether somebody asked to end it: so that a budget and Ctrl-C reach everywhere."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import dataclass


def _never() -> bool:
    return False


@dataclass(frozen=True)
class Deadline:
    """A point in time after which work takes its shortest way to a usable end.

    Args:
        at: seconds of `clock`; infinite = no limit.
        stopped: asked at every turn; True ends the work as the time does.
        clock: gives the seconds that count.
    """

    at: float = math.inf
    stopped: Callable[[], bool] = _never
    clock: Callable[[], float] = time.perf_counter

    def left(self) -> float:
        """Seconds left; 0 once over."""
        return 0.0 if self.stopped() else max(0.0, self.at - self.clock())

    def over(self) -> bool:
        """True once the time is up or an end was asked for."""
        return self.left() <= 0.0

    def part(self, share: float) -> Deadline:
        """A deadline after a share (0..1) of the time left."""
        return Deadline(self.clock() + share * self.left(), self.stopped, self.clock)


NO_DEADLINE = Deadline()
