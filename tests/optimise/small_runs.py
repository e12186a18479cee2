"""A clip small enough to be optimised in a second or two, and runs of it."""

from dataclasses import replace
from typing import Any

from genmojo_core.clip.clip import Clip
from genmojo_core.clip.synthetic import generate
from genmojo_core.clip.synthetic_specs import spec
from genmojo_core.config import RunConfig, preset
from genmojo_core.effects.decide import plan
from genmojo_core.estimate.complete import complete
from genmojo_core.optimise.run import Run


def small_clip(name: str = "crossing-shapes", frames: int = 5, width: int = 80) -> Clip:
    base = spec(name)
    made, _ = generate(replace(base, frames=min(frames, base.frames), size=(width, width * 9 // 16), tracks=4))
    return complete(made)


def small_config(**changes: Any) -> RunConfig:
    settings = {
        "gaussians_per_object": 200, "background_gaussians": 300, "lift_steps": 6, "joint_steps": 10,
        "settle_steps": 10, "budget_seconds": 1e6, "plane_resolution": 8, "plane_levels": (1,), "plane_channels": 8,
        "field_width": 16,
        "motion_bases": 4, "densify_every": 5, "neighbours": 6, "frames_per_step": 3, "short_side": 45,
    }  # fmt: skip
    return preset("draft", **{**settings, **changes})


def small_run(clip: Clip, effects: dict[str, bool] | None = None, run_dir: Any = None, resume: bool = False,
              **changes: Any) -> Run:  # fmt: skip
    config = small_config(**changes)
    return Run(clip, plan(clip, config, effects), config, run_dir, resume)
