"""What effects and loss terms cost in a run, measured on its own scene: CPU time of a step with one and without it.

An effect's part is taken out of the live scene for one frame's loss and gradient, and put back, and a loss term's
weight is 0 for as long: the difference is the cost, the backward pass included. Memory is counted: parameters with
gradient and two moments, and feature channels of the splatted frame.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import Any, cast

import torch
from torch import nn

from genmojo_core.effects.plan import EffectName, EffectPlan
from genmojo_core.optimise.objective import Objective
from genmojo_core.scene.scene4d import Layout

REPEATS = 2  # of which the faster counts
TURNS = 2  # in which loss terms are taken away one after the other; the faster of each counts
_PER_PARAMETER = 4  # value, gradient, two moments
Patch = list[tuple[Any, str, Any]]  # object, attribute, value that takes the effect's part out


def measured_costs(objective: Objective, plan: EffectPlan, frames: list[int]) -> dict[str, tuple[float, float]]:
    """(ms per step, MB) of every effect that is on and has a part in the loss; leaves scene and gradients as they were.

    Args:
        frames: of one step; one of them is timed and counts for all.
    """
    frame = frames[:1]
    whole = _seconds(objective, frame)
    costs = {}
    for name, (parts, megabytes) in _PARTS.items():
        if plan.on(name):  # type: ignore[arg-type]
            with _without(parts(objective)):
                saved = whole - _seconds(objective, frame)
            costs[name] = (max(0.0, 1e3 * saved * len(frames)), megabytes(objective) / 1e6)
    return costs


def term_costs(objective: Objective, frames: list[int], names: Iterable[str]) -> dict[str, float]:
    """CPU ms per step of loss terms, by their names in `LossWeights`; leaves weights and gradients as they were.

    Nothing for a term that takes no time of its own, as those do that are made with others in one go.

    Args:
        frames: as in `measured_costs`.
    """
    names, frame = list(names), frames[:1]
    whole, less = float("inf"), dict.fromkeys(names, float("inf"))
    for _ in range(TURNS):
        whole = min(whole, _seconds(objective, frame))
        for name in names:
            with _without([(objective, "weights", replace(objective.weights, **{name: 0.0}))]):
                less[name] = min(less[name], _seconds(objective, frame))
    return {name: max(0.0, 1e3 * (whole - less[name]) * len(frames)) for name in names}


def with_costs(plan: EffectPlan, objective: Objective, frames: list[int]) -> EffectPlan:
    """The plan with what every effect costs written beside what was predicted."""
    for name, (ms, mb) in measured_costs(objective, plan, frames).items():
        plan = plan.changed(cast(EffectName, name), measured_ms=ms, measured_mb=mb)
    return plan


def _seconds(objective: Objective, frames: list[int]) -> float:
    """CPU seconds of the loss and its gradient, the faster of some."""
    parameters = [p for p in objective.scene.parameters() if p.requires_grad]
    best = float("inf")
    for _ in range(REPEATS):
        start = time.process_time()
        loss = objective.evaluate(frames, True, torch.Generator().manual_seed(0)).loss
        torch.autograd.grad(loss, parameters, allow_unused=True)
        best = min(best, time.process_time() - start)
    return best


@contextmanager
def _without(patch: Patch) -> Iterator[None]:
    """Attributes replaced for a while; parts of a module go through its own table."""
    before = [getattr(owner, name) for owner, name, _ in patch]
    for owner, name, value in patch:
        setattr(owner, name, value)
    try:
        yield
    finally:
        for (owner, name, _), value in zip(patch, before, strict=True):
            setattr(owner, name, value)


def _deformation(o: Objective) -> Patch:
    return [(model, "field", None) for model in o.scene.objects]


def _labels(o: Objective) -> Patch:
    return [(o.scene, "layout", Layout(1, o.scene.layout.flow)), (o, "labels", False), (o, "order", False)]


def _parameters(*modules: nn.Module | None) -> float:
    """Bytes of modules with gradients and moments."""
    values = sum(p.numel() for m in modules if m is not None for p in m.parameters())
    return float(values * 4 * _PER_PARAMETER)


def _channels(o: Objective, count: int) -> float:
    """Bytes of feature channels of one frame, with their gradient."""
    width, height = o.scene.cameras.size
    return float(width * height * count * 4 * 2)


def _nothing(o: Objective) -> float:
    return 0.0


_PARTS: dict[str, tuple[Callable[[Objective], Patch], Callable[[Objective], float]]] = {
    "joint_occlusion": (lambda o: [(o, "order", False)], _nothing),
    "background": (lambda o: [(o.scene, "background", None)], lambda o: _parameters(o.scene.background)),
    "non_rigid_motion": (_deformation, lambda o: _parameters(*(m.field for m in o.scene.objects))),
    "appearance_change": (lambda o: [(o.scene, "gain", None)], lambda o: _parameters(o.scene.gain)),
    "shading": (lambda o: [(o.scene, "shade", None)], lambda o: _parameters(o.scene.shade)),
    "instance_labels": (_labels, lambda o: _channels(o, o.scene.layout.labels - 1)),
    "depth_order": (lambda o: [(o, "depth", False), (o, "order", False)], _nothing),
    "flow": (lambda o: [(o.scene, "layout", Layout(o.scene.layout.labels, False))], lambda o: _channels(o, 2)),
    "track_supervision": (lambda o: [(o, "tracks", [])],
                          lambda o: float(sum(t.xy.numel() + t.conf.numel() + t.points.numel() for t in o.tracks) * 4)),
}  # fmt: skip
