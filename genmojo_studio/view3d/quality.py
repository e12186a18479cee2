"""How much of a picture is drawn, what comes out, and how much can be afforded while something moves."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

MOVING_MS = 100.0  # a frame while moving takes no longer than this where the processor draws
SMOOTH_MS = 33.0  # and where a graphics card does
_EASY = 0.45  # faster than this share of the limit, the next finer step is tried


@dataclass(frozen=True)
class Picture:
    """What a view of splats sums up to.

    Args:
        sums: (H, W, 4) float32, row 0 at the top: premultiplied channels of the mode (RGB; depth; flow x, y; normal;
            for objects: position in `object_ids`, share) and coverage.
        order_is_exact: False where a large scene was drawn in an order of an earlier camera.
    """

    sums: np.ndarray
    order_is_exact: bool = True


@dataclass(frozen=True)
class Quality:
    """Every `stride`-th splat of a fixed shuffle, at `scale` of the resolution."""

    stride: int = 1
    scale: float = 1.0

    def size(self, width: int, height: int) -> tuple[int, int]:
        """Pixels that are drawn for a picture of width x height."""
        return max(1, round(width * self.scale)), max(1, round(height * self.scale))


FULL = Quality()
STEPS = (FULL, Quality(1, 0.7), Quality(1, 0.5), Quality(2, 0.5), Quality(4, 0.4), Quality(8, 0.3), Quality(16, 0.25))


class Detail:
    """Chooses the quality of frames while something moves, from how long frames took; at rest it is always full.

    A frame that took too long lowers the next one, by two steps if it took more than twice the limit; quick frames
    raise it again, but not to a step that was too slow in the same motion.
    """

    def __init__(self, limit_ms: float = MOVING_MS) -> None:
        self.limit_ms = limit_ms
        self._step = 0
        self._slow = len(STEPS)  # the finest step known to be too slow lies before this one

    def begin(self, full_ms: float | None) -> None:
        """A motion begins; the last full frame took `full_ms` (None: not known)."""
        self._slow = -1
        if full_ms is not None:
            costs = [full_ms * cost_share(q) for q in STEPS]
            self._step = next((k for k, ms in enumerate(costs) if ms <= self.limit_ms), len(STEPS) - 1)

    @property
    def quality(self) -> Quality:
        """For the next frame of a motion."""
        return STEPS[self._step]

    def took(self, ms: float) -> None:
        """A frame of the motion at `quality` took this long."""
        if ms > self.limit_ms:
            self._slow = max(self._slow, self._step)
            self._step = min(self._step + (2 if ms > 2 * self.limit_ms else 1), len(STEPS) - 1)
        elif ms < _EASY * self.limit_ms and self._step > self._slow + 1:
            self._step -= 1


def cost_share(quality: Quality) -> float:
    """What a frame costs relative to a full one, by experience: a third for splats, two thirds for pixels."""
    return 0.35 / quality.stride + 0.65 * quality.scale**2
