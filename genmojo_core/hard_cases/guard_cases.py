"""Numbers that go bad in the middle of a run, and what the guard makes of them (RELIABILITY.md N02, N11, N26, N27)."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import Any, Literal

import torch
from torch import Tensor

from genmojo_core.events import Event, Failed, Step
from genmojo_core.hard_cases import clips
from genmojo_core.hard_cases.case import Case, hold
from genmojo_core.hard_cases.runs import checked, started
from genmojo_core.optimise import guard
from genmojo_core.optimise.run import Run
from genmojo_core.priors.prior import Judgement, Reference, ViewOffsets
from genmojo_core.priors.sds import distil
from genmojo_core.scene import safemath

AT = 7  # the step in which something goes wrong
Spoil = Callable[[Run], None]


def spoiled(spoil: Spoil, times: int = 1) -> tuple[Run, list[Event]]:
    """A run in which `spoil` is done after step AT and the ones that follow, `times` times."""
    run = started(clips.plain(), lift_steps=4, joint_steps=40, densify_every=1000)
    events: list[Event] = []
    left = times
    for event in run:
        events.append(event)
        if isinstance(event, Step) and run.progress.step >= AT and left:
            left -= 1
            with torch.no_grad():
                spoil(run)
    return run, events


def gaussian(value: float) -> str:
    """One Gaussian loses its numbers: it is taken out and named, the run goes on."""
    run, events = spoiled(lambda run: run.scene.objects[1].gaussians.means[4].fill_(value))
    outcome = checked(run, events)
    name = run.scene.objects[1].name
    hold(any("made transparent" in text and name in text for text in outcome.warnings), "nobody was told by name")
    hold(run.guard.quarantined == {name: 1}, f"taken out: {run.guard.quarantined}")
    hold(float(run.scene.objects[1].gaussians.opacities().detach()[4]) < 0.01, "it is still visible")
    hold(run.guard.rollbacks == 0, "one Gaussian cost the others a rollback")
    return outcome.warnings[-1]


def shared() -> str:
    """A parameter that all Gaussians of an object share is lost: back to the last good state, smaller steps."""
    run, events = spoiled(lambda run: run.scene.objects[0].field.bases.fill_(math.nan))
    outcome = checked(run, events)
    hold(any("back to the last good state" in text for text in outcome.warnings), "there was no rollback")
    hold(any("learning rates x 0.5" in text for text in outcome.warnings), "learning rates were not halved")
    named = [text for text in outcome.warnings if "left out" in text]
    hold(len(named) == guard.BAD_IN_A_ROW, f"{len(named)} steps were left out")
    hold(f"bases of {run.scene.objects[0].name}" in named[0], f"the culprit is not named: {named[0]}")
    hold(run.guard.rate == 1.0, f"learning rates are still at {run.guard.rate:g} after {run.guard.good_steps} steps")
    return f"{named[0]}; rolled back after {guard.BAD_IN_A_ROW}"


def hopeless() -> str:
    """A parameter that is lost after every step: the run ends in one sentence, and its last scene is sound."""
    run, events = spoiled(lambda run: run.scene.objects[0].field.bases.fill_(math.nan), times=1000)
    last = events[-1]
    hold(isinstance(last, Failed) and last.code == "numeric", f"the run ended with {type(last).__name__}")
    return f"failed: {last.message}" if isinstance(last, Failed) else ""


def gradients(value: float, row: bool) -> str:
    """A gradient that is not finite, or too large to be squared: of one Gaussian, or of all of an object."""
    run = started(clips.plain(3), densify_every=1000)
    events = iter(run)
    while run.progress.step < 3:
        next(events)
    model = run.scene.objects[0]
    parameter = model.gaussians.means if row else model.placement.turn
    other = run.scene.objects[1].gaussians.means
    parameter.grad = torch.zeros_like(parameter)
    parameter.grad[1] = value
    others = other.grad.clone()
    verdict = run.guard.judge(torch.zeros(()))
    news = run.guard.news()
    hold(verdict == ("step" if row else "skip"), f"the verdict was {verdict}")
    hold(torch.equal(other.grad, others), "another object's gradient changed")
    hold(not row or not bool(parameter.grad.any()), "the row kept its gradient")
    hold(len(news) == 1 and model.name in news[0], f"told: {news}")
    return news[0]


def limits() -> str:
    """Logits, log scales and quaternions that ran away come back to where gradients live, counted and told."""
    run = started(clips.plain(3))
    events = iter(run)
    while not hasattr(run, "guard"):
        next(events)
    g = run.scene.objects[0].gaussians
    with torch.no_grad():
        g.logit_opacities[:3] = torch.tensor([1e3, -1e3, 40.0])
        g.log_scales[:2] = torch.tensor([[1e3] * 3, [-1e3] * 3])
        g.quats[:3] = torch.tensor([[1e-20] * 4, [0.0] * 4, [1e18] * 4])
    news = run.guard.quarantine()
    hold(bool(g.logit_opacities.abs().max() <= safemath.LOGIT_LIMIT), "a logit is out of range")
    hold(bool(g.log_scales.abs().max() <= safemath.LOG_SCALE_LIMIT), "a log scale is out of range")
    lengths = g.quats.detach().norm(dim=1)
    hold(bool(((lengths >= 0.5) & (lengths <= 2.0)).all()), f"a quaternion has length {float(lengths.max()):g}")
    hold(len(news) == 3, f"told: {news}")
    return "; ".join(news)


class BadPrior:
    """A prior that answers with one value everywhere, for tests of what is made of it."""

    kind: Literal["embedded", "zero123", "zeronvs"] = "embedded"
    channels: Literal["rgb", "rgba"] = "rgba"
    resolution = 8
    scope: Literal["object", "scene"] = "object"

    def __init__(self, value: float) -> None:
        self.value = value

    def embed(self, renders: Tensor) -> Tensor:
        """Pictures as they are."""
        return renders

    def encode(self, reference: Reference) -> None:
        """Nothing is needed."""

    def distance(self, reference: Reference) -> float:
        """Any."""
        return 2.0

    def predict(self, condition: Any, views: ViewOffsets) -> None:
        """It has no mean pictures."""

    def judge(
        self, embedded: Tensor, condition: Any, views: ViewOffsets, level: float, generator: torch.Generator
    ) -> Judgement:
        """The value, in one half of the picture; the picture itself in the other."""
        clean = embedded.clone()
        clean[..., : embedded.shape[-1] // 2] = self.value
        return Judgement(clean, torch.ones(len(clean)), None, torch.ones_like(clean[:, :1]))


def guidance(value: float) -> str:
    """A prior that gives no usable numbers: they are left out and counted, the rest keeps its say."""
    pictures = torch.rand(2, 4, 8, 8, generator=torch.Generator().manual_seed(0)).requires_grad_()
    zero = torch.zeros(2)
    said = distil(BadPrior(value), pictures, None, ViewOffsets(zero, zero, zero), 0.5, "x0",
                  torch.Generator().manual_seed(0))  # fmt: skip
    said.loss.backward()
    hold(bool(torch.isfinite(pictures.grad).all()), "the gradient is not finite")
    hold(float(pictures.grad.abs().max()) <= 20.0, f"the gradient is {float(pictures.grad.abs().max()):g}")
    hold(said.statistics["left_out"] == 0.5, f"{said.statistics['left_out']:.0%} counted as left out")
    return "half of what it said was left out and counted"


NAN, INF = math.nan, math.inf
LOST = (NAN, INF, 1e30)
CASES = (
    *(Case("N27", f"a Gaussian becomes {value}", partial(gaussian, value)) for value in (NAN, INF)),
    Case("N27", "a shared parameter becomes nan", shared),
    Case("N27", "a parameter that is lost again and again", hopeless),
    *(
        Case("N27", f"a gradient of {value:g} in one row", partial(gradients, value, True))
        for value in (NAN, INF, 1e30)
    ),
    Case("N27", "a gradient of nan in a placement", partial(gradients, NAN, False)),
    Case("N11", "logits, scales and quaternions that ran away", limits),
    *(Case("N26", f"a prior that says {value:g}", partial(guidance, value)) for value in (NAN, INF, 1e6, 65504.0)),
)
