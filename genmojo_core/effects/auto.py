"""The budget-aware schedule: given seconds, the size, Gaussians, frames a step and field that give most of them.

A fixed preset stopped early has neither brought all frames into play nor lowered its learning rates. Here the schedule
is paced (RunConfig.paced): it ends when the time does, whatever a step costs. What is left to choose is how much each
step should carry. The exponents come from tries at 30 and 60 s on one clip (crossing); the report of `genmojo tradeoff`
shows on any clip what they are worth. Bending them costs most of a step, so in a short run many objects share
what two may have: with 4300 Gaussians for each of the five fish of "gold-fish" a minute was enough for 124 steps, with
2000 for 168.
"""

from __future__ import annotations

from typing import Any

from genmojo_core.clip.clip import Clip
from genmojo_core.config import MEASURED_SIDE, RunConfig, preset

AUTO_SECONDS = 300.0  # where no budget is given
LONGEST = 100_000  # joint steps: more than any time allows
_ANCHOR = 30.0  # seconds on the reference machine at which the first values hold
_SIDE, _SIDE_POWER = 180.0, 0.27  # pixels of the short side of a square clip
_TOGETHER, _ENOUGH = 2.0, 60.0  # so many objects have all they may within so many seconds; more of them share that
_LONG, _VERY_LONG = 240.0, 900.0  # seconds from which a prior, and more pixels than 256, are worth their time


def for_budget(seconds: float, clip: Clip, speed: float = 1.0, **changes: Any) -> RunConfig:
    """The configuration for a clip and a time.

    Args:
        seconds: budget of the run. clip: its source size decides how many pixels a short side means, its objects how
            many Gaussians each may have.
        speed: of this machine against the reference one (effects/forecast.py). changes: fields that the user set.

    Raises GenmojoError("config") for values out of range.
    """
    time = max(seconds * speed, 1.0)
    width, height = clip.source_size
    aspect = max(width, height) / max(min(width, height), 1)
    most = MEASURED_SIDE if time < _VERY_LONG else 2 * MEASURED_SIDE  # more pays only once there is time to spare
    share = min(1.0, _TOGETHER * max(time / _ENOUGH, 1.0) ** 0.5 / max(clip.objects, 1))
    side = _SIDE * (time / _ANCHOR) ** _SIDE_POWER / aspect**0.25
    chosen: dict[str, Any] = {
        "preset": "auto", "paced": True, "budget_seconds": seconds, "joint_steps": LONGEST, "lift_steps": LONGEST,
        "short_side": int(min(max(round(side / 8) * 8, 96), most, max(min(width, height), 16))),
        "gaussians_per_object": round(_between(time, 4000, 5000) * share),
        "background_gaussians": _between(time, 7000, 12000),
        "frames_per_step": 2 if time < _LONG else 3, "densify_every": 30,
    }  # fmt: skip
    if time >= _LONG:
        chosen |= {"prior": "embedded", "plane_resolution": 48, "plane_channels": 16}
    return preset("draft", **{**chosen, **changes})


def _between(time: float, low: int, high: int) -> int:
    """From `low` at 30 s to `high` at four times that, and on in proportion to the fourth root."""
    share = min(max((time - _ANCHOR) / (3 * _ANCHOR), 0.0), 1.0)
    return round((low + (high - low) * share) * max(time / (20 * _ANCHOR), 1.0) ** 0.25)
