"""Keeps one bad number from spoiling a run: finite gate, quarantine of the culprit, rollback, smaller steps after it.

RELIABILITY.md N27: a non-finite Gaussian is made transparent and neutral before it is rendered; a non-finite gradient
row loses its say in this step; a non-finite loss or shared parameter skips the step; three bad steps in a row go back
to the last good snapshot with half the learning rate, which doubles again with every stretch of good steps; a run that
cannot leave its trouble ends with GenmojoError("numeric"). N02, N03, N11: quaternions keep a length near one,
log scales and logits of opacities stay where their functions still have a gradient.

Nothing of this is silent: `news` gives a sentence for each thing done, with the name of the culprit.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import torch
from torch import Tensor

from genmojo_core.errors import GenmojoError
from genmojo_core.scene import safemath
from genmojo_core.scene.gaussians import Gaussians
from genmojo_core.scene.scene4d import Scene4D
from genmojo_core.sentences import say

Verdict = Literal["step", "skip", "rollback"]
BAD_IN_A_ROW = 3
ROLLBACKS = 3  # without recovery in between
BACK_OFF = 0.5  # of the learning rates, per rollback
RECOVERY = 25  # good steps after which the learning rates double again
LARGEST = (
    1e15  # gradients beyond it overflow the optimiser's second moment: such a parameter would stand still for good
)
QUAT_LENGTHS = (0.5, 2.0)  # outside of which a quaternion is made a unit one
NEUTRAL = {"means": 0.0, "quats": 0.5, "log_scales": -6.0, "logit_opacities": -8.0, "dc": 0.0}
LIMITS = {"logit_opacities": safemath.LOGIT_LIMIT, "log_scales": safemath.LOG_SCALE_LIMIT}


@dataclass
class _Snapshot:
    """Parameters and optimiser moments as they were; keyed by the parameter objects themselves."""

    values: dict[torch.nn.Parameter, Tensor]
    moments: dict[torch.nn.Parameter, dict[str, Tensor]]


class Guard:
    """Watches one scene and its optimiser.

    Args:
        scene: the scene. optimiser: steps its parameters.

    `rate` is what learning rates are to be multiplied by; `quarantined` counts Gaussians made neutral, per owner.
    """

    def __init__(self, scene: Scene4D, optimiser: torch.optim.Optimizer) -> None:
        self.scene, self.optimiser = scene, optimiser
        self.bad_steps = self.rollbacks = self.good_steps = 0
        self.rate = 1.0
        self.quarantined: dict[str, int] = {}
        self._counts: dict[tuple[object, ...], int] = {}
        self._news: list[str] = []
        self.snapshot()

    def all_gaussians(self) -> list[tuple[str, Gaussians]]:
        """Every set of Gaussians with its owner's name."""
        sets = [(o.name, o.gaussians) for o in self.scene.objects]
        return sets + ([("background", self.scene.background)] if self.scene.background is not None else [])

    def news(self) -> list[str]:
        """What was done since the last call, a sentence each."""
        told, self._news = self._news, []
        return told

    def quarantine(self) -> list[str]:
        """Neutralise Gaussians with non-finite parameters, keep the others in range; what `news` says, if anything."""
        for owner, gaussians in self.all_gaussians():
            bad = torch.zeros(len(gaussians), dtype=torch.bool)
            for name in Gaussians.NAMES:
                values = getattr(gaussians, name).detach()
                if not bool(torch.isfinite(values.sum())):
                    bad |= ~torch.isfinite(values.reshape(len(values), -1)).all(dim=1)
            count = int(bad.sum())
            if count:
                self._neutralise(gaussians, bad)
                self.quarantined[owner] = self.quarantined.get(owner, 0) + count
                self._news.append(say("made_transparent", count=count, name=owner))
            self._limit(owner, gaussians)
        return self.news()

    def judge(self, loss: Tensor, parts: Mapping[str, float] | None = None) -> Verdict:
        """Look at the loss and every gradient after backward; non-finite rows of Gaussians are zeroed in place.

        Args:
            loss: of the step. parts: its terms by name, to tell which one is not finite.
        """
        culprits = [] if math.isfinite(float(loss.detach())) else [*self._lost(), *_not_finite(parts or {})]
        culprits = culprits or self._clear_rows()
        if not culprits:
            self._recover()
            return "step"
        self.bad_steps += 1
        self.good_steps = 0
        self._news.append(say("step_left_out", culprits=", ".join(culprits)))
        return "rollback" if self.bad_steps >= BAD_IN_A_ROW else "skip"

    def snapshot(self) -> bool:
        """Remember the present state as good; False (and the old one is kept) while it is not."""
        parameters = [p for group in self.optimiser.param_groups for p in group["params"]]
        if self.bad_steps or not all(bool(torch.isfinite(p.detach()).all()) for p in parameters):
            return False
        moments = {}
        for p in parameters:
            state = self.optimiser.state.get(p, {})
            moments[p] = {k: v.clone() for k, v in state.items() if torch.is_tensor(v)}
        self._good = _Snapshot({p: p.detach().clone() for p in parameters}, moments)
        return True

    def rollback(self) -> None:
        """Back to the last snapshot, smaller steps from there on.

        Raises GenmojoError("numeric") after ROLLBACKS of them without recovery.
        """
        self.rollbacks += 1
        self.bad_steps = self.good_steps = 0
        if self.rollbacks > ROLLBACKS:
            raise GenmojoError("numeric", "the optimisation gives non-finite numbers again and again", "",
                               "start from the last checkpoint with smaller learning rates")  # fmt: skip
        self.rate *= BACK_OFF
        self._news.append(say("rolled_back", count=BAD_IN_A_ROW, rate=self.rate))
        with torch.no_grad():
            for p, value in self._good.values.items():
                p.copy_(value)
        for p, moments in self._good.moments.items():
            if not moments:
                self.optimiser.state.pop(p, None)
            for key, value in moments.items():
                self.optimiser.state[p][key] = value.clone()

    def _recover(self) -> None:
        """Count a good step; after a stretch of them learning rates and patience come back."""
        self.bad_steps = 0
        self.good_steps += 1
        if self.rollbacks and self.good_steps % RECOVERY == 0:
            self.rollbacks -= 1
            self.rate = min(1.0, self.rate / BACK_OFF)

    def _clear_rows(self) -> list[str]:
        """Zero non-finite rows of per-Gaussian gradients; names of shared parameters whose gradient is not finite."""
        rows_of = {id(getattr(g, name)): (owner, name) for owner, g in self.all_gaussians() for name in g.NAMES}
        culprits = []
        for group in self.optimiser.param_groups:
            for p in group["params"]:
                if p.grad is None or not p.grad.numel() or bool(p.grad.abs().max() < LARGEST):
                    continue
                if id(p) not in rows_of:
                    culprits.append(f"gradient of {self._name_of(p)}")
                    continue
                good = (p.grad.abs() < LARGEST).reshape(len(p), -1).all(dim=1)
                p.grad[~good] = 0.0
                owner, name = rows_of[id(p)]
                self._count(int((~good).sum()), "gradients_left_out", what=name, name=owner)
        return culprits

    def _lost(self) -> list[str]:
        """Names of the shared parameters that are not finite; Gaussians are the quarantine's business."""
        own = {id(getattr(g, name)) for _, g in self.all_gaussians() for name in g.NAMES}
        parameters = (p for group in self.optimiser.param_groups for p in group["params"] if id(p) not in own)
        return [self._name_of(p) for p in parameters if not bool(torch.isfinite(p.detach()).all())]

    def _name_of(self, parameter: Tensor) -> str:
        """Path of a shared parameter, with the object's name in the place of its number."""
        for name, p in self.scene.named_parameters():
            if p is parameter:
                parts = name.split(".")
                if parts[0] == "objects":
                    return f"{'.'.join(parts[2:])} of {self.scene.objects[int(parts[1])].name}"
                return name
        return "a parameter"

    @torch.no_grad()
    def _limit(self, owner: str, gaussians: Gaussians) -> None:
        """Logits, log scales and lengths of quaternions back into their ranges, counted."""
        for name, limit in LIMITS.items():
            values = getattr(gaussians, name)
            if len(values) and bool(values.abs().max() > limit):
                self._count(int((values.abs() > limit).sum()), "limited", what=name, name=owner, limit=limit)
                values.clamp_(-limit, limit)
        lengths = safemath.safe_norm(gaussians.quats)
        far = (lengths < QUAT_LENGTHS[0]) | (lengths > QUAT_LENGTHS[1])
        if bool(far.any()):
            gaussians.quats[far] = safemath.normalise(gaussians.quats[far])
            self._count(int(far.sum()), "made_unit", name=owner)

    def _count(self, count: int, sentence: str, **values: object) -> None:
        """Add to a sentence's count; it is news when that passes the next power of ten."""
        what = (sentence, *values.values())
        before = self._counts.get(what, 0)
        self._counts[what] = before + count
        if len(str(before + count)) > len(str(before)) or not before:
            self._news.append(say(sentence, count=before + count, **values))

    def _neutralise(self, gaussians: Gaussians, bad: Tensor) -> None:
        with torch.no_grad():
            for name in Gaussians.NAMES:
                parameter = getattr(gaussians, name)
                parameter[bad] = NEUTRAL[name]
                for key, value in self.optimiser.state.get(parameter, {}).items():
                    if torch.is_tensor(value) and value.shape == parameter.shape:
                        self.optimiser.state[parameter][key][bad] = 0.0


def _not_finite(parts: Mapping[str, float]) -> list[str]:
    """Names of the loss terms that are not finite, or the loss as a whole."""
    return [f"loss term {name}" for name, value in parts.items() if not math.isfinite(value)] or ["the loss"]
