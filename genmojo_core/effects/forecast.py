"""What a run will take and reach, foretold before it starts: seconds on this machine and foreground PSNR in dB.

Seconds: the CPU time of a step has a least and is linear in what is splatted and deformed, the search for motion is a
power law; both were fitted by `python -m tests.benchmarks.forecast` on rows of `genmojo tradeoff`, and a short
calibration (machine.py) scales them to the machine. Decibels: linear in how well flow carries the clip's pixels from
frame to frame and in logarithms of what the run may spend. Where a pilot of the clip has run (pilot.py), its error
instead: what of it comes from its few pixels is known from the clip itself, and the rest is carried to what the run
may spend. The same program leaves one clip out after the other and prints the errors. Imports no torch.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from dataclasses import asdict, dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from genmojo_core.clip.clip import Clip
from genmojo_core.config import LIFT_SHARE, MEASURED_SIDE, MOTION_SHARE, SETTLE_SHARE, RunConfig, outward_reach
from genmojo_core.effects.difficulty import Difficulty, difficulty
from genmojo_core.effects.plan import EffectPlan
from genmojo_core.effects.still import window_share

if TYPE_CHECKING:
    from genmojo_core.effects.machine import Machine

REFERENCE_STEP_MS = 48.0  # CPU ms of a step of optimise/calibrate.py on the reference machine
LIFT_WORTH = 0.3  # of a joint step: what a step of the static lift does for the result
PILOT_SIDE = 160  # pixels on the short side
PILOT_TOGETHER, PILOT_FEWEST = 3000, 300  # Gaussians of all objects, and of each at least
_FEW = 4.0  # looks at a frame that do what the first motion does without any
START_SHARE = 0.8  # of the allowed Gaussians that there are on average over a run
STEP_NAMES = ("views x pixels x channels, millions", "views x Gaussians, thousands", "views x bending Gaussians, "
              "thousands", "objects shown to the prior", "objects", "one")  # fmt: skip
PILOT_NAMES = ("one", "ln looks at a frame, on average over frames", "ln Gaussians per object against the pilot's")
_MOMENTS = 200  # of a run's steps at which its frames in play are counted
_SHARPER = 1.5  # power of a pixel's size that the error of few pixels grows with, below the pilot's
LEAST_REST = 0.35  # of a squared error: what cannot come from few pixels
DB_NAMES = (
    "one",
    "motion",
    "ln steps per frame",
    "ln pixels per clip pixel at 256",
    "ln Gaussians per object",
)


@dataclass(frozen=True)
class Work:
    """What a run is made of.

    Args:
        frames, objects: of the clip. views: frames splatted per step. pixels: of a frame as optimised.
        channels: of a rendering. moving: Gaussians of all objects. total: with the background's. bends: objects have
        deformation fields. prior: objects shown to the prior per step. aspect: long side by short side.
        window: share of the pixels that a step looks at. settled: Gaussians of a background that stands still and is
        fitted once (optimise/still.py); they are not in `total`. rigid: objects that do not bend although others do.
    """

    frames: int
    objects: int
    views: int
    pixels: int
    channels: int
    moving: float
    total: float
    bends: bool
    prior: int
    aspect: float
    window: float = 1.0
    settled: float = 0.0
    rigid: int = 0


@dataclass(frozen=True)
class Model:
    """Fitted numbers, and the relative error of seconds and the error of dB on clips that the fit has not seen.

    Args:
        step: CPU ms per entry of `step_features`. motion: ln c, and exponents of frames, objects and pixels, of the
        motion's CPU seconds. decibel: dB per entry of `decibel_features`, piloted: of `pilot_features`, which are
        of the remainder (`remainder`). *_error: root mean square, leaving one clip out after the other.
    """

    step: tuple[float, ...]
    motion: tuple[float, ...]
    decibel: tuple[float, ...]
    decibel_error: float
    seconds_error: float
    piloted: tuple[float, ...] = ()
    piloted_error: float = 0.0


# Fitted on 58 runs of ten clips (crossing, gold-fish, blender-cross, blender-trio, tennis, dogs-jump, bear, cups, two
# made ones) and the small runs of four reports, two programs at a time on two cores. The error of dB is that per clip,
# each left out: 0.8 dB off on average with pilots, 32 runs within 1 dB (gold-fish 1.4 too low), 2.2 dB without. Of
# 27 runs that ended by themselves the seconds of 25 were told within 25 %.
MODEL = Model(
    step=(43.66, 0.2389, 6.182, 54.47, 6.899, 8.311), motion=(-5.041, 1.267, 1.094, 0.1998),
    decibel=(2.033, 0.5243, 2.308, 1.284, 0.04644), decibel_error=2.7, seconds_error=0.18,
    piloted=(-4.702, 2.149, 0.8736), piloted_error=1.0,
)  # fmt: skip


@dataclass(frozen=True)
class Forecast:
    """What to expect of a run.

    Args:
        seconds: by the run's own clock. decibel: foreground PSNR. *_error: root mean square errors of both.
        steps: it will get to. factor: seconds that its clock counts per CPU second of the reference machine.
        clip: the difficulty that it rests on; with `factor` and `window` it can be foretold anew for other settings.
        window: share of the pixels round the objects where the background is still, else None (`window_share`).
    """

    seconds: float
    decibel: float
    seconds_error: float
    decibel_error: float
    steps: float
    factor: float
    clip: Difficulty
    window: float | None = None

    def to_json(self) -> dict[str, Any]:
        """Plain data."""
        return asdict(self)


def work_of(
    size: tuple[int, int],
    frames: int,
    objects: int,
    on: Collection[str],
    config: RunConfig,
    window: float | None = None,
    rigid: int = 0,
) -> Work:
    """The work of a step for a clip of (width, height) pixels as optimised, with the effects that are on.

    window: `window_share`: a step looks at no more where the background stands still; None: at whole frames always.
    rigid: objects that the plan's non-rigid motion spares.
    """
    objects = max(objects, 1)
    moving = START_SHARE * config.gaussians_per_object * objects
    background = config.background_gaussians if "background" in on else 0
    channels = 3 + (objects if "instance_labels" in on else 1) + (2 if "flow" in on else 0)
    shown = (config.prior_objects or objects) if "unseen_views" in on else 0
    changes = {"camera_motion", "appearance_change"} & set(on)
    still = window is not None and bool(background) and frames > 1 and not changes
    return Work(frames, objects, min(config.frames_per_step, frames), size[0] * size[1], channels, moving,
                moving + (0 if still else background), "non_rigid_motion" in on, min(shown, objects),
                max(size) / max(min(size), 1), window if window is not None and still else 1.0,
                background if still else 0.0, min(rigid, objects))  # fmt: skip


def step_features(work: Work, deform: bool = True) -> np.ndarray:  # (6,)
    """What the CPU time of one step is linear in (STEP_NAMES); the static lift deforms nothing."""
    bending = work.moving * (1.0 - work.rigid / work.objects) if work.bends and deform else 0.0
    return np.array([
        work.views * work.window * work.pixels * work.channels / 1e6, work.views * work.total / 1e3,
        work.views * bending / 1e3, float(work.prior), float(work.objects), 1.0,
    ])  # fmt: skip


def motion_features(work: Work) -> np.ndarray:  # (4,)
    """What the logarithm of the motion's CPU seconds is linear in."""
    return np.array([1.0, math.log(max(work.frames, 2)), math.log(work.objects), math.log(work.pixels)])


def decibel_features(clip: Difficulty, work: Work, steps: tuple[float, float], per_object: int) -> np.ndarray:  # (5,)
    """What the foreground's PSNR is linear in (DB_NAMES).

    Args:
        steps: of the lift and of the joint stage. per_object: Gaussians allowed.
    """
    shown = max((LIFT_WORTH * steps[0] + steps[1]) * work.views / work.frames, 0.5)
    side = side_of(work) / MEASURED_SIDE
    return np.array([1.0, clip.motion, math.log(shown), math.log(min(side, 1.0)), math.log(per_object)])


def pilot_gaussians(objects: int) -> int:
    """Gaussians that a pilot gives each of so many objects."""
    return max(PILOT_FEWEST, PILOT_TOGETHER // max(objects, 1))


def pilot_features(work: Work, joint: float, planned: float, per_object: int) -> np.ndarray:  # (3,)
    """What a run gains over a pilot's remainder in dB is linear in these (PILOT_NAMES).

    Args:
        joint: steps done. planned: of the whole schedule, of which frames come into play outward from the middle.
        per_object: Gaussians allowed.
    """
    frames = int(work.frames)
    away, looks = np.abs(np.arange(frames) - frames // 2), np.zeros(frames)
    for share in (np.arange(_MOMENTS) + 0.5) / _MOMENTS * joint / max(planned, 1.0):
        there = away <= outward_reach(frames, share)
        looks += there * min(work.views / there.sum(), 1.0) * joint / _MOMENTS
    more = math.log(per_object / pilot_gaussians(work.objects))
    return np.array([1.0, float(np.log(looks + _FEW).mean()), more])


def ceiling(clip: Difficulty, side: float) -> float:
    """dB that the frames themselves reach with `side` pixels on the short side; results are measured at 256."""
    if clip.coarse is None or clip.fine is None:
        raise ValueError("no pilot of this clip has run")
    if side < PILOT_SIDE:
        return clip.coarse + 20 * _SHARPER * math.log10(side / PILOT_SIDE)
    share = math.log(side / PILOT_SIDE) / math.log(MEASURED_SIDE / PILOT_SIDE)
    return clip.coarse + (clip.fine - clip.coarse) * min(share, 1.0)


def remainder(decibel: float, limit: float) -> float:
    """PSNR of what is left of a squared error once that of few pixels (`limit`, in dB) is taken off."""
    whole = 10 ** (-decibel / 10)
    return -10 * math.log10(max(whole - 10 ** (-limit / 10), LEAST_REST * whole))


def together(decibel: float, limit: float) -> float:
    """The opposite of `remainder`: PSNR of both errors."""
    return -10 * math.log10(10 ** (-decibel / 10) + 10 ** (-limit / 10))


def side_of(work: Work) -> float:
    """Pixels on the short side of a frame as optimised."""
    return math.sqrt(work.pixels / work.aspect)


def cpu_seconds(work: Work, config: RunConfig, model: Model = MODEL) -> dict[str, float]:
    """CPU seconds on the reference machine: of motion and settling, of one lift step and of one joint step."""
    step = np.array(model.step)
    fitting = np.array([work.pixels * 3 / 1e6, work.settled / 1e3, 0.0, 0.0, 0.0, 1.0])
    settle = config.settle_steps * float(fitting @ step) / 1000 if work.settled else 0.0
    motion = math.exp(float(motion_features(work) @ np.array(model.motion))) if work.frames > 1 else 0.0
    return {"motion": motion, "settle": settle, "lift": float(step_features(work, False) @ step) / 1000,
            "joint": float(step_features(work, work.frames > 1) @ step) / 1000}  # fmt: skip


def forecast(
    clip: Clip, plan: EffectPlan, config: RunConfig, machine: Machine, pilot: Mapping[str, float] | None = None
) -> Forecast:
    """Foretell a run on a completed clip, held at the size to optimise, on this machine as busy as it is now.

    pilot: `Pilot.to_json` of the clip's pilot, where one has run.
    """
    on = [effect.name for effect in plan.effects if effect.on]
    window = window_share(clip)
    rigid = len(plan.get("non_rigid_motion").spared)
    work = work_of(clip.size, len(clip), clip.objects, on, config, window, rigid)
    factor = (1.0 if config.clock == "cpu" else machine.wall_now()) / machine.speed
    measured = replace(difficulty(clip), **(pilot or {}))
    return replace(foretold(work, measured, config, factor), window=window)


def foretold(work: Work, clip: Difficulty, config: RunConfig, factor: float, model: Model = MODEL) -> Forecast:
    """As `forecast`; `factor`: seconds that the budget counts per CPU second of the reference machine."""
    cost = {name: factor * value for name, value in cpu_seconds(work, config, model).items()}
    budget = config.budget_seconds
    motion = min(cost["motion"], MOTION_SHARE * budget)
    settle = min(cost["settle"], SETTLE_SHARE * budget)
    left = budget - motion - settle
    if config.paced:
        lift = LIFT_SHARE * left / cost["lift"]
        joint = planned = (1 - LIFT_SHARE) * left / cost["joint"]
        seconds = budget
    else:
        lift = min(config.lift_steps, left / cost["lift"])
        planned = config.joint_steps_of(work.bends or work.frames == 1)
        joint = min(planned, max(left - lift * cost["lift"], 0.0) / cost["joint"])
        seconds = motion + settle + lift * cost["lift"] + joint * cost["joint"]
    limited = seconds >= 0.99 * budget
    error = 0.0 if limited else model.seconds_error * seconds
    if clip.reached is None:
        features = decibel_features(clip, work, (lift, joint), config.gaussians_per_object)
        decibel, unsure = float(features @ np.array(model.decibel)), model.decibel_error
    else:
        features = pilot_features(work, joint, planned, config.gaussians_per_object)
        gain = float(features @ np.array(model.piloted))
        rest = remainder(clip.reached, ceiling(clip, PILOT_SIDE)) + gain
        decibel, unsure = together(rest, ceiling(clip, side_of(work))), model.piloted_error
    return Forecast(seconds, decibel, error, unsure, lift + joint, factor, clip)


def said(expected: Forecast) -> str:
    """ "Expected: 310 s (± 60), 30.1 dB (± 0.8, from a pilot run).", for people."""
    origin = "" if expected.clip.reached is None else ", from a pilot run"
    return f"Expected: {expected.seconds:.0f} s (± {expected.seconds_error:.0f}), {expected.decibel:.1f} dB "\
           f"(± {expected.decibel_error:.1f}{origin})."  # fmt: skip


def outcome(expected: Forecast, seconds: float, decibel: float) -> dict[str, Any]:
    """What was expected beside what came, for the scene's file and the log; "said" is a sentence of it."""
    return {
        "expected_seconds": expected.seconds, "seconds": seconds, "expected_psnr": expected.decibel, "psnr": decibel,
        "seconds_off": seconds / expected.seconds - 1.0 if expected.seconds > 0 else 0.0,
        "psnr_off": decibel - expected.decibel,
        "said": f"Expected {expected.seconds:.0f} s, took {seconds:.0f} s; expected {expected.decibel:.1f} dB, "
                f"got {decibel:.1f} dB.",
    }  # fmt: skip
