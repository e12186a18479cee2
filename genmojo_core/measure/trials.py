"""One trial of `genmojo tradeoff`: a configuration run on a clip, with times by stage, memory and accuracy."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from genmojo_core.clip import folders
from genmojo_core.clip.clip import Clip
from genmojo_core.clip.cut import cut
from genmojo_core.config import RunConfig, preset
from genmojo_core.effects import decide
from genmojo_core.effects.costs import BYTES_PER_VALUE
from genmojo_core.effects.difficulty import Difficulty, difficulty
from genmojo_core.effects.plan import EffectPlan
from genmojo_core.effects.still import window_share
from genmojo_core.errors import GenmojoError
from genmojo_core.estimate.complete import complete
from genmojo_core.events import Event, Failed, Finished, Preview, StageStarted, Step, Warned
from genmojo_core.measure.scoring import Scorer
from genmojo_core.optimise.cost import term_costs
from genmojo_core.optimise.motion import ObjectMotion, initial_motion
from genmojo_core.optimise.run import Run

_WARM_STEPS = 2
_TIMED_STEPS = 6


@dataclass(frozen=True)
class Trial:
    """What is run.

    Args:
        key: file name of its row. kind: "preset", "size", "effect", "loss" or "growth". title: for people.
        config: of the run. effects: switched by hand. moment: seconds after which a preset is stopped, 0 if it is not.
        terms: losses whose cost is taken out of a step of its result.
        vary: for "growth", what is varied ("frames", "objects", "pixels", "Gaussians") and frames, objects: how many
        are kept of the clip (0 = all).
    """

    key: str
    kind: str
    title: str
    config: RunConfig
    effects: Mapping[str, bool] = field(default_factory=dict)
    moment: float = 0.0
    vary: str = ""
    frames: int = 0
    objects: int = 0
    terms: tuple[str, ...] = ()


@dataclass(frozen=True)
class Source:
    """The clip of all trials: path and positions, as `folders.read` takes them; boxes where it has no masks."""

    path: str
    frames: tuple[int, int | None] | None = None
    boxes: tuple[Any, ...] = ()


class Bench:
    """Runs trials on one clip. What trials share (the completed clip at a size, its motion) is made once."""

    def __init__(self, source: Source) -> None:
        self.source = source
        self._clips: dict[tuple[int, tuple[str, ...]], tuple[Clip, dict[str, float]]] = {}
        self._motions: dict[int, list[ObjectMotion]] = {}
        self._scorer = Scorer(source.path, source.frames)
        self._difficulty: Difficulty | None = None

    def clip(self, config: RunConfig) -> tuple[Clip, dict[str, float]]:
        """The completed clip at a size, and the seconds that reading and completing took."""
        key = (config.short_side, config.ignore)
        if key not in self._clips:
            began = (time.perf_counter(), time.process_time())
            clip = folders.read(self.source.path, frames=self.source.frames, short_side=config.short_side,
                                ignore=config.ignore)  # fmt: skip
            clip = complete(clip, boxes=list(self.source.boxes))
            spent = {"seconds": time.perf_counter() - began[0], "cpu_seconds": time.process_time() - began[1]}
            self._clips[key] = clip, spent
        return self._clips[key]

    def run(self, trial: Trial, hear: Callable[[Event], None]) -> dict[str, Any]:
        """The row of a trial. Raises GenmojoError as reading the clip, and "numeric" where a run fails."""
        clip, prepared = self.clip(trial.config)
        if self._difficulty is None:
            self._difficulty = difficulty(self.clip(preset("draft"))[0])  # one measure for all sizes
        clip = _reduced(clip, trial)
        plan = decide.plan(clip, trial.config, trial.effects)
        row = {"key": trial.key, "kind": trial.kind, "title": trial.title, "seed": trial.config.seed,
               "moment": trial.moment, "vary": trial.vary, "frames": len(clip), "objects": clip.objects,
               "size": list(clip.size), "window": window_share(clip), "prepare": prepared,
               "on": [e.name for e in plan.effects if e.on], "rigid": len(plan.get("non_rigid_motion").spared),
               "difficulty": self._difficulty.to_json(),
               "config": trial.config.to_json()}  # fmt: skip
        if trial.kind == "growth":
            return row | _growth(clip, plan, trial)
        run = Run(clip, plan, trial.config)
        self._scorer.completed = clip
        shared = trial.kind in ("effect", "loss")
        if shared:
            run.motions = self._motions.get(trial.config.short_side)
        figures = _watched(run, None if shared else Scorer(self.source.path, self.source.frames, clip), hear)
        if trial.terms:
            row["term_costs"] = term_costs(run.objective, list(range(trial.config.frames_per_step)), trial.terms)
        if shared and run.motions is not None:
            self._motions[trial.config.short_side] = run.motions
        scene = run.bake()
        prior = "unseen_views" in trial.key or trial.key.startswith("base-")  # what unseen views judge among the parts
        return row | figures | self._scorer.figures(scene, unseen=not shared or prior)


def _watched(run: Run, scorer: Scorer | None, hear: Callable[[Event], None]) -> dict[str, Any]:
    """Run to the end; times by stage, counts, memory and the curve."""
    stages: dict[str, dict[str, float]] = {}
    name, end, notes = "", None, []
    for event in run:
        hear(event)
        if isinstance(event, StageStarted):
            name = event.stage
            stages[name] = {"began": event.seconds, "cpu_began": event.cpu_seconds, "steps": 0.0}
        elif isinstance(event, Step):
            stages[name]["steps"] = float(event.step)
            if scorer is not None:
                scorer.watch(run)
        elif isinstance(event, Preview) and event.stage == "motion":
            stages["motion"] |= {"seconds": event.seconds, "cpu_seconds": event.cpu_seconds}
        elif isinstance(event, Failed):
            raise GenmojoError("numeric", event.message.rstrip("."), run.clip.path)
        elif isinstance(event, Warned):
            notes.append(event.message)
        elif isinstance(event, Finished):
            end = event
    if end is None:
        raise GenmojoError("numeric", "the run ended without a scene", run.clip.path)
    return {
        "seconds": end.seconds, "cpu_seconds": end.cpu_seconds, "steps": end.step, "reason": end.reason,
        "gaussians": len(run.scene), "moving": sum(len(o.gaussians) for o in run.scene.objects),
        "stages": _lengths(stages, end.seconds, end.cpu_seconds), "model_mb": model_megabytes(run), "notes": notes,
        "costs": {str(e.name): e.measured_ms for e in run.plan.effects if e.measured_ms is not None},
        "curve": run.progress.curve, "psnr_held_out": run.progress.psnr(), "ssim_held_out": run.progress.ssim(),
        "psnr_held_frames": run.progress.curve[-1].get("psnr_held_frames", 0.0) if run.progress.curve else 0.0,
    }  # fmt: skip


def _lengths(stages: dict[str, dict[str, float]], end: float, cpu_end: float) -> dict[str, dict[str, float]]:
    """Seconds and CPU seconds that every stage took, with its steps."""
    names = list(stages)
    lengths = {}
    for name, after in zip(names, [*names[1:], ""], strict=True):
        row = stages[name]
        until, cpu_until = (stages[after]["began"], stages[after]["cpu_began"]) if after else (end, cpu_end)
        lengths[name] = {"seconds": until - row["began"], "cpu_seconds": cpu_until - row["cpu_began"],
                         "steps": row["steps"]}  # fmt: skip
    return lengths


def model_megabytes(run: Run) -> float:
    """Memory of all optimised numbers, their gradients and the optimiser's two moments, and of one frame's channels."""
    values = sum(p.numel() for p in run.scene.parameters() if p.requires_grad)
    width, height = run.scene.cameras.size
    channels = run.scene.layout.channels * width * height * 4 * run.config.frames_per_step
    return (values * BYTES_PER_VALUE + 2 * channels) / 1e6


def _reduced(clip: Clip, trial: Trial) -> Clip:
    """The first frames and objects of a clip; what is left out becomes background."""
    if trial.objects and trial.objects < clip.objects and clip.masks is not None:
        masks = replace(clip.masks, value=np.where(clip.masks.value > trial.objects, 0, clip.masks.value))
        clip = clip.with_channels(masks=masks, object_ids=clip.object_ids[: trial.objects],
                                  object_names=clip.object_names[: trial.objects])  # fmt: skip
    if trial.frames and trial.frames < len(clip):
        clip = cut(clip, 0, trial.frames)
    return clip


def _growth(clip: Clip, plan: EffectPlan, trial: Trial) -> dict[str, Any]:
    """CPU milliseconds of a step, and where frames or objects vary the CPU seconds of the search for motion."""
    run = Run(clip, plan, trial.config)
    cpu = [cpu for _, cpu in run.timed_steps(_WARM_STEPS + _TIMED_STEPS)][_WARM_STEPS:]
    row: dict[str, Any] = {"step_ms": 1000 * float(np.median(cpu)), "gaussians": len(run.scene)}
    if trial.vary in ("frames", "objects"):
        began = time.process_time()
        initial_motion(clip)
        row["motion_seconds"] = time.process_time() - began
    return row
