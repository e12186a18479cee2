"""Effects that the evidence missed and the run itself shows to be needed: they are called in, with the reason.

Two residuals are watched. The initial motion bends an object although its outline and flow seemed rigid: deformation
is called in before the scene is lifted. Whole frames stay brighter or darker than the scene: light is called in while
the optimisation goes on. What the user switched off stays off.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np
import torch
from torch import Tensor

from genmojo_core.clip.clip import Clip
from genmojo_core.effects.decide import with_bases
from genmojo_core.effects.plan import EffectName, EffectPlan
from genmojo_core.effects.texts import Said
from genmojo_core.events import EffectChanged, Event
from genmojo_core.optimise import density
from genmojo_core.optimise.motion import ObjectMotion
from genmojo_core.optimise.objective import Outcome
from genmojo_core.optimise.poses import project
from genmojo_core.optimise.schedule import Stage, group_of
from genmojo_core.scene import safemath
from genmojo_core.scene.appearance import FrameGain

if TYPE_CHECKING:
    from genmojo_core.optimise.run import Run

BENDS = 0.03  # of the object's size: the same as what CALLS_FOR non-rigid motion (measure/effect_truth.py)
LIGHT = 0.08  # change of brightness, as the plan's own threshold
REMEMBERED = 0.7  # of the last value of a frame's residual, in its running mean
LOOKS = 3  # times that every frame must have been seen before its light is judged


def may(plan: EffectPlan, name: EffectName) -> bool:
    """True if an effect is off and the user did not say so."""
    effect = plan.get(name)
    return not effect.on and not effect.overridden


def changed(run: Run, name: EffectName) -> EffectChanged:
    """The event that tells what the plan of a run says of an effect now."""
    effect = run.plan.get(name)
    return EffectChanged(*run.clock.now(), name, effect.on, effect.reason, effect.said)


def bending(clip: Clip, plan: EffectPlan, motions: Sequence[ObjectMotion], most_bases: int) -> EffectPlan:
    """The plan as it was, or with the reason why an object that it holds for rigid bends after all.

    With non-rigid motion off it comes on for all objects, else for those that the initial motion bends.
    """
    effect = plan.get("non_rigid_motion")
    if effect.overridden:
        return plan
    rigid = [k for k in range(len(motions)) if not plan.on_object("non_rigid_motion", int(clip.object_ids[k]))]
    shares = {k: bent_share(clip, k, motions[k]) for k in rigid}
    bent = [k for k in rigid if shares[k] >= BENDS]
    if not bent:
        return plan
    worst = max(bent, key=lambda k: shares[k])
    said = ("leaves_rigid", {"name": clip.object_names[worst], "percent": 100 * shares[worst]})
    plan = plan.decided("non_rigid_motion", True, said)
    if effect.on:
        called_in = {int(clip.object_ids[k]) for k in bent}
        return plan.changed("non_rigid_motion", spared=tuple(i for i in effect.spared if i not in called_in))
    bases = with_bases(plan.get("non_rigid_motion"), most_bases, shares[worst] / BENDS)
    return plan.changed("non_rigid_motion", settings=bases.settings)


def bent_share(clip: Clip, k: int, motion: ObjectMotion) -> float:
    """How far an object's points leave its rigid path, as a share of its size: 90th percentile, worst sure frame."""
    sure = np.flatnonzero(motion.confidence > 0.5)
    if not len(motion.track_xyz) or not np.any(motion.bend.coefficients) or not len(sure):
        return 0.0
    size = math.sqrt(max(float(clip.object_mask(k).sum(axis=(1, 2)).max()), 1.0))
    worst = 0.0
    for t in map(int, sure):
        pose = motion.pose[t]
        rigid = project(clip.cameras.value, t, motion.track_xyz @ pose[:3, :3].T + pose[:3, 3])
        worst = max(worst, float(np.percentile(np.linalg.norm(motion.track_xy[:, t] - rigid, axis=1), 90)))
    return worst / size


class LightWatch:
    """Watches how much brighter or darker than the scene every frame is, while light is not simulated.

    Args:
        frames: T. unknown: frames that are held out, of which nothing is heard.
    """

    def __init__(self, frames: int, unknown: Sequence[int] = ()) -> None:
        self.known = np.setdiff1d(np.arange(frames), np.array(unknown, np.int64))
        self.log_gain = torch.zeros(frames, 3)
        self.looks = torch.zeros(frames)

    def hear(self, light: Sequence[tuple[int, Tensor, Tensor]]) -> None:
        """Take note of frames, each with the mean colours shown and wanted."""
        for t, shown, wanted in light:
            gain = safemath.safe_log(wanted + 1e-3, 1e-4) - safemath.safe_log(shown.clamp(min=0) + 1e-3, 1e-4)
            weight = REMEMBERED if self.looks[t] else 0.0
            self.log_gain[t] = weight * self.log_gain[t] + (1 - weight) * gain.cpu()
            self.looks[t] += 1

    def change(self) -> float:
        """Change of brightness over the clip that the scene leaves unexplained, 0..1; 0 before all frames are known."""
        if bool((self.looks[self.known] < LOOKS).any()):
            return 0.0
        level = self.log_gain[self.known].mean(dim=1)
        return 1.0 - math.exp(float(level.min() - level.max()))

    def gains(self) -> Tensor:
        """(T, 3) gains that would explain what was seen, unknown frames between their neighbours."""
        frames = np.arange(len(self.log_gain))
        known = self.log_gain[self.known].numpy()
        columns = [np.interp(frames, self.known, known[:, c]) for c in range(3)]
        return torch.exp(torch.tensor(np.stack(columns, axis=1), dtype=torch.float32))

    def called_for(self) -> Said | None:
        """Why light must be simulated; None while it need not be."""
        change = self.change()
        return None if change < LIGHT else ("light_called_in", {"percent": 100 * change})


def light_watch(run: Run) -> LightWatch | None:
    """What watches the light of a run; None where light is simulated already or the user does not want it."""
    return LightWatch(len(run.clip), run.held) if may(run.plan, "appearance_change") else None


def change_effects(run: Run, stage: Stage, outcome: Outcome) -> Iterator[Event]:
    """After a step: a prior that does harm is switched off with its Gaussians; light is called in where frames ask."""
    said: Said | None = None
    if run.unseen is not None and stage.deform:
        said = run.unseen.objection(run.objective, run.progress.fraction(run.clock))
    if said is not None:
        run.unseen = None
        for gaussians, _ in run.statistics:
            density.keep_only(gaussians, ~gaussians.invented, run.optimiser)
        run.after_change()
        run.plan = run.plan.decided("unseen_views", False, said)
        yield changed(run, "unseen_views")
    if run.watch is None:
        return
    run.watch.hear(outcome.light)
    said = run.watch.called_for()
    if said is not None:
        gain = simulate_light(run, said, run.watch.gains())
        run.optimiser.add_param_group(group_of("log_gain", [gain.log_gain], run.config))
        run.guard.snapshot()
        yield changed(run, "appearance_change")


def simulate_light(run: Run, said: Said, start: Tensor | None = None) -> FrameGain:
    """One gain per frame of a run from here on, starting at measured gains (T, 3) or ones."""
    gain = FrameGain(len(run.clip), start)
    run.scene.gain, run.watch, run.light_called_in = gain, None, True
    run.plan = run.plan.decided("appearance_change", True, said)
    return gain
