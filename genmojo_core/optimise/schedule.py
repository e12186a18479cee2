"""What a run does when: stages, frames that take part, learning rates, progress against steps and budget."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import torch

from genmojo_core.config import LearningRates, RunConfig, outward_reach
from genmojo_core.optimise.vector_adam import VectorAdamW
from genmojo_core.scene.scene4d import Scene4D

FINAL_RATE = 0.1  # of the first learning rate, reached at the end
LOOKS = 50  # at every frame, after which learning rates fall
VECTORS = ("means", "rigid_means", "bases")  # kinds of parameters whose rows are vectors in space


@dataclass(frozen=True)
class Stage:
    """A stretch of steps: the static lift (`deform` False) or the joint optimisation."""

    name: str
    steps: int
    deform: bool


def stages(config: RunConfig, frames: int, bends: bool) -> list[Stage]:
    """The stages of a run; a still has no motion, so its joint stage only refines."""
    steps = config.joint_steps_of(bends or frames == 1)
    return [Stage("lift", config.lift_steps, False), Stage("joint", steps, frames > 1)]


class Pace:
    """Fits the steps of a stage to the time it has, from the time its steps have taken so far.

    Args:
        name: of the stage. done: its steps so far. now: seconds of the run at which it goes on. end: when it must.
    """

    def __init__(self, name: str, done: int, now: float, end: float) -> None:
        self.name = name
        self._before, self._began, self._end = done, now, end

    def refit(self, stage: Stage, done: int, now: float) -> Stage:
        """The stage with as many steps as there will be time for; at least those done."""
        if done <= self._before:
            return stage
        left = max(self._end - now, 0.0) * (done - self._before) / max(now - self._began, 1e-9)
        return replace(stage, steps=done + int(left))


def frames_in_play(frames: int, centre: int, share: float, held: Sequence[int] = ()) -> np.ndarray:
    """Frames that take part, outward from the canonical frame: a window that grows to the whole clip.

    Args:
        share: 0..1 of the stage done. held: frames that never take part.
    """
    everything = np.setdiff1d(np.arange(frames), held)
    return everything[np.abs(everything - centre) <= outward_reach(frames, share)]


def draw_frames(candidates: np.ndarray, count: int, seed: int, step: int) -> list[int]:
    """`count` frames without replacement for one step; the same for the same seed and step."""
    rng = np.random.default_rng((seed, step))
    return sorted(int(t) for t in rng.choice(candidates, size=min(count, len(candidates)), replace=False))


def rate_factor(progress: float) -> float:
    """Learning rates stay for half the run, then fall along a cosine to FINAL_RATE."""
    x = min(max((progress - 0.5) / 0.5, 0.0), 1.0)
    return FINAL_RATE + (1.0 - FINAL_RATE) * 0.5 * (1.0 + math.cos(math.pi * x))


def wear_factor(step: int, frames: int, frames_per_step: int) -> float:
    """What learning rates fall to in long runs: 1 until every frame was looked at LOOKS times, then as 1 / step.

    The optimiser's steps are as long as the rate, however small a gradient is. Where a step sees only some frames, what
    the frames hardly tell (colours of few pixels, opacities of hidden parts) walks off at random: over thousands of
    steps held-out pixels lost 5 dB while the loss stayed.
    """
    if frames_per_step >= frames or step == 0:
        return 1.0
    return min(1.0, LOOKS * frames / (step * frames_per_step))


def make_optimiser(scene: Scene4D, config: RunConfig) -> VectorAdamW:
    """AdamW with one group per kind of parameter; decay 0.01 only on the deformation field (METHOD.md section 5).

    Decay on opacity logits and placements would shrink them for no reason (METHOD.md section 2). Positions, and the
    vectors that they move along, step along their gradient (vector_adam.py).
    """
    groups: dict[str, list[torch.nn.Parameter]] = {}
    rigid = {id(model.gaussians.means) for model in scene.objects if model.field is None}
    for name, parameter in scene.named_parameters():
        if parameter.requires_grad:
            groups.setdefault("rigid_means" if id(parameter) in rigid else _kind(name), []).append(parameter)
    rows = [group_of(kind, members, config) for kind, members in groups.items()]
    return VectorAdamW(rows, eps=1e-15, betas=(0.9, 0.99), fused=True)


def group_of(kind: str, members: list[torch.nn.Parameter], config: RunConfig) -> dict[str, Any]:
    """One kind of parameters as a group of the optimiser."""
    rate = start_rate(kind, config.rates)
    decay = 0.01 if kind in ("planes", "heads") else 0.0
    return {"params": members, "lr": rate, "start_lr": rate, "kind": kind, "weight_decay": decay,
            "vectors": kind in VECTORS}  # fmt: skip


def start_rate(kind: str, rates: LearningRates) -> float:
    """First learning rate of a group of parameters; the frame's gain is a change of colour."""
    if kind == "rigid_means":
        return rates.means * rates.rigid_means
    return float(getattr(rates, "delta_color" if kind == "log_gain" else kind))


def set_rates(optimiser: torch.optim.Optimizer, progress: float, caution: float = 1.0) -> None:
    """Learning rates for this part of the run; `caution` is the guard's factor after trouble."""
    factor = rate_factor(progress) * caution
    for group in optimiser.param_groups:
        group["lr"] = group["start_lr"] * factor


def _kind(name: str) -> str:
    """Parameter group of a parameter by its path in the scene."""
    leaf = name.rsplit(".", 1)[-1]
    if ".planes." in name:
        return "planes"
    if ".trunk." in name or ".head." in name:
        return "heads"
    if ".placement." in name:
        return "placement"
    return leaf
