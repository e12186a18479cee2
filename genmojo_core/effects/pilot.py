"""A pilot: the clip itself, run small and short, before a run that takes long. What it tells and when it pays.

It looks at the whole clip, because what a scene reaches depends on how its objects look at both ends of it: five frames
of the middle were given back 3 dB better than all of "bear", and 4 dB worse than all of "cups".

The run lies in measure/pilot_run.py; this module imports no torch. Its work is bounded by frames, pixels, Gaussians and
steps, never by time, so it says the same on every machine. Results are kept in the user's cache folder under the
frames, masks and effects that they were made with.
"""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Collection
from dataclasses import asdict, dataclass, fields
from pathlib import Path

from genmojo_core import __version__
from genmojo_core.clip.clip import Clip
from genmojo_core.clip.resize import fitted
from genmojo_core.config import RunConfig, preset
from genmojo_core.effects.forecast import PILOT_SIDE, Forecast, cpu_seconds, pilot_gaussians, work_of
from genmojo_core.effects.plan import EffectPlan
from genmojo_core.kernels.cache import user_cache

FRAMES = 24  # at most; of a longer clip evenly spread
LONG = 60.0  # seconds of a run from which a pilot is worth thinking of
SHARE = 0.1  # of the run's time: most that its pilot may take
_AROUND = 1.5  # CPU seconds for background, bake and comparison


@dataclass(frozen=True)
class Pilot:
    """What a pilot found.

    Args:
        reached: foreground PSNR as a run's result is measured.
        coarse: the same of the clip itself, blurred as its pixels are at the pilot's size. fine: as at 256 pixels.
    """

    reached: float
    coarse: float
    fine: float

    def to_json(self) -> dict[str, float]:
        """Plain data."""
        return asdict(self)


def pilot_config(objects: int) -> RunConfig:
    """How a pilot runs on a clip with so many objects."""
    return preset(
        "draft", short_side=PILOT_SIDE, gaussians_per_object=pilot_gaussians(objects),
        background_gaussians=5000, lift_steps=30, joint_steps=80, settle_steps=30, densify_every=20,
        held_out_share=0.0, budget_seconds=math.inf,
    )  # fmt: skip


def pilot_seconds(clip: Clip, on: Collection[str], factor: float) -> float:
    """Seconds that a pilot should take; `factor` as in Forecast."""
    config = pilot_config(clip.objects)
    size = fitted(clip.source_size, min(PILOT_SIDE, *clip.size))
    work = work_of(size, min(FRAMES, len(clip)), clip.objects, [name for name in on if name != "unseen_views"], config)
    cost = cpu_seconds(work, config)
    steps = config.lift_steps * cost["lift"] + config.joint_steps * cost["joint"]
    return factor * (_AROUND + cost["motion"] + steps)


def pays(expected: Forecast, seconds: float) -> bool:
    """True where a pilot of so many seconds is little against the run that is expected."""
    return expected.seconds >= LONG and seconds <= SHARE * expected.seconds


def pilot_plan(plan: EffectPlan) -> EffectPlan:
    """The plan as a pilot follows it: sides that no frame shows do not show in what is measured."""
    return plan.changed("unseen_views", on=False)


def stored(clip: Clip, plan: EffectPlan) -> Pilot | None:
    """The pilot of this clip under this plan; None before one was made, or where the file is not one."""
    try:
        kept = json.loads(pilot_file(clip, plan).read_text())
        found = Pilot(**{f.name: float(kept[f.name]) for f in fields(Pilot)})
    except (OSError, ValueError, KeyError, TypeError):
        return None
    return found if all(math.isfinite(value) for value in found.to_json().values()) else None


def pilot_file(clip: Clip, plan: EffectPlan) -> Path:
    """Where the pilot of a clip under a plan lies: named by pixels, masks, effects, settings and our version."""
    on = [str(effect.name) for effect in pilot_plan(plan).effects if effect.on]
    told = hashlib.sha256(json.dumps([on, __version__, FRAMES, repr(pilot_config(1)), len(clip), clip.size]).encode())
    told.update(clip.frames.tobytes())
    if clip.masks is not None:
        told.update(clip.masks.value.tobytes())
    return user_cache() / "genmojo" / "pilots" / f"{told.hexdigest()[:24]}.json"
