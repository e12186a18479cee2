"""How long a run will take and how much memory it will want, told before it starts. Knows no Qt.

The model of `genmojo_core.effects.costs` is within a factor of two, and so is this.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from genmojo_core.config import RunConfig
from genmojo_core.effects.costs import FIELD_MS, PIXEL_MS, SPLAT_MS, Sizes
from genmojo_studio.worker.machine import memory

BASE_MB = 620.0  # a worker before it has a scene: Python, PyTorch, compiled kernels
_VALUES_PER_PIXEL = 40  # bytes of a clip's channels and targets per pixel and frame
_START_SECONDS = 12.0  # imports, completing the clip, first motion


@dataclass(frozen=True)
class Forecast:
    """Seconds and megabytes that a run will want, each likely within half and double, and the machine's memory."""

    seconds: float
    megabytes: float
    machine_megabytes: float

    @property
    def too_large(self) -> bool:
        """True above 80 % of the machine's memory."""
        return self.megabytes > 0.8 * self.machine_megabytes


def forecast(effects: Iterable[Mapping[str, Any]], sizes: Sizes, config: RunConfig) -> Forecast:
    """What a run with these effects (rows of `EffectPlan.to_json`, `on` as chosen) will want."""
    on = [effect for effect in effects if effect["on"]]
    base_ms = sizes.views * (sizes.gaussians * SPLAT_MS + sizes.pixels * PIXEL_MS + 0.2 * sizes.gaussians * FIELD_MS)
    step_ms = base_ms + sum(float(effect["ms_per_step"]) for effect in on)
    steps = config.joint_steps_of(sizes.frames == 1 or any(effect["name"] == "non_rigid_motion" for effect in on))
    seconds = _START_SECONDS + (steps + 0.5 * config.lift_steps) * step_ms / 1000
    seconds = min(seconds, config.budget_seconds)
    pixels = sizes.pixels * sizes.frames * _VALUES_PER_PIXEL / 1e6
    return Forecast(
        seconds, BASE_MB + pixels + sum(float(effect["mb"]) for effect in on), memory()["total_mb"] or math.inf
    )


def spoken(seconds: float) -> str:
    """A duration as people say it: "45 s", "3 min", "1 h 20 min"."""
    if not math.isfinite(seconds):
        return "–"
    if seconds < 90:
        return f"{seconds:.0f} s"
    if seconds < 5400:
        return f"{seconds / 60:.0f} min"
    return f"{int(seconds // 3600)} h {int(seconds % 3600 // 60)} min"
