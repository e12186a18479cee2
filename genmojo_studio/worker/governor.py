"""Keeps the view from slowing the run: measures what previews cost and spaces them out.

Two costs are known: the seconds the worker spends on a preview, measured every time; and what the window's own drawing
takes from the run (shared cores, shared memory bandwidth), found out by a probe: every PROBE_EVERY steps the window is
asked not to draw for PROBE_STEPS steps and the medians of step times with and without are compared.
"""

from __future__ import annotations

import statistics
from collections import deque
from dataclasses import dataclass

SHARE = 0.02  # of the run's time that previews may take
SWEEP_SHARE = 0.01  # and the sweep over all frames: together 3 %
CADENCE_SECONDS = {"off": None, "slow": 1.0, "live": 0.0}
MIN_INTERVAL = 0.03  # seconds: nobody sees more than 33 previews a second
MAX_INTERVAL = 20.0
PROBE_EVERY = 200
PROBE_STEPS = 5
_SMOOTHING = 0.2
_WINDOW = 20.0  # seconds over which the share is measured


@dataclass(frozen=True)
class ViewCost:
    """What the view costs: `publish_share` and `draw_share` 0..1 of the run's time, `interval` seconds apart."""

    publish_share: float
    draw_share: float
    interval: float


class Governor:
    """Decides when the next preview is due.

    Args:
        cadence: "off", "slow" (1 Hz) or "live" (as often as SHARE allows). All times are monotonic seconds.
    """

    def __init__(self, cadence: str = "live") -> None:
        self.set_cadence(cadence)
        self._cost: float | None = None  # seconds per preview, smoothed
        self._due = 0.0
        self._stretch = 1.0
        self._draw_share = 0.0
        self._spent: deque[tuple[float, float]] = deque(maxlen=4096)  # when, seconds
        self._steps: deque[float] = deque(maxlen=4 * PROBE_STEPS)
        self._probe: list[float] = []
        self._since_probe = 0

    def set_cadence(self, cadence: str) -> None:
        """Another cadence. Raises KeyError for an unknown one."""
        self._floor = CADENCE_SECONDS[cadence]
        self.cadence = cadence
        self._due = 0.0

    @property
    def probing(self) -> bool:
        """True while the window should not draw."""
        return self._floor is not None and self._since_probe >= PROBE_EVERY

    def due(self, now: float) -> bool:
        """True if a preview may be published."""
        return self._floor is not None and not self.probing and now >= self._due

    def published(self, now: float, seconds: float) -> None:
        """A preview was published; it took the worker some seconds."""
        self._cost = seconds if self._cost is None else (1 - _SMOOTHING) * self._cost + _SMOOTHING * seconds
        self._due = now + self.interval()
        self.spent(now, seconds)

    def spent(self, now: float, seconds: float) -> None:
        """The view took some seconds of the worker."""
        self._spent.append((now, seconds))

    def interval(self) -> float:
        """Seconds between previews, such that they take at most SHARE of the run."""
        wanted = (self._cost or 0.0) / SHARE * self._stretch
        return max(self._floor or 0.0, MIN_INTERVAL, min(wanted, MAX_INTERVAL))

    def stepped(self, seconds: float) -> None:
        """A step of the optimiser took so long (without the preview)."""
        if self._floor is None:
            return
        if self.probing:
            self._probe.append(seconds)
            if len(self._probe) >= PROBE_STEPS:
                self._judge()
        else:
            self._steps.append(seconds)
            self._since_probe += 1

    def cost(self, now: float) -> ViewCost:
        """What the view costs: publishing as measured over the last seconds, drawing as last probed; any thread."""
        share = sum(seconds for when, seconds in list(self._spent) if when > now - _WINDOW) / _WINDOW
        off = self._floor is None
        return ViewCost(min(1.0, share), 0.0 if off else self._draw_share, 0.0 if off else self.interval())

    def _judge(self) -> None:
        """Compare steps with and without drawing; draw less often while it costs more than SHARE."""
        quiet, busy = statistics.median(self._probe), statistics.median(self._steps or self._probe)
        self._draw_share = max(0.0, busy / max(quiet, 1e-9) - 1.0)
        if self._draw_share > SHARE:
            self._stretch = min(self._stretch * 2.0, 64.0)
        elif self._draw_share < SHARE / 3:
            self._stretch = max(self._stretch / 2.0, 1.0)
        self._probe, self._since_probe = [], 0
