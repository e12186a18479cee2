"""Keeps one bad number from spoiling a run: finite gate, quarantine of the culprit, rollback.

RELIABILITY.md N27: a non-finite Gaussian is made transparent and neutral before it is rendered; a non-finite gradient
row loses its say in this step; a non-finite shared parameter skips the step; three bad steps in a row go back to the
last good snapshot, and a run that cannot leave it ends with GenmojoError("numeric"). N11: logits of opacities stay
within +-12, where a sigmoid still has a gradient.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import torch
from torch import Tensor

from genmojo_core.errors import GenmojoError
from genmojo_core.scene import safemath
from genmojo_core.scene.gaussians import Gaussians
from genmojo_core.scene.scene4d import Scene4D

Verdict = Literal["step", "skip", "rollback"]
BAD_IN_A_ROW = 3
ROLLBACKS = 3
NEUTRAL = {"means": 0.0, "quats": 0.5, "log_scales": -6.0, "logit_opacities": -8.0, "dc": 0.0}


@dataclass
class _Snapshot:
    """Parameters and optimiser moments as they were; keyed by the parameter objects themselves."""

    values: dict[torch.nn.Parameter, Tensor]
    moments: dict[torch.nn.Parameter, dict[str, Tensor]]


class Guard:
    """Watches one scene and its optimiser.

    Args:
        scene: the scene. optimiser: steps its parameters.
    """

    def __init__(self, scene: Scene4D, optimiser: torch.optim.Optimizer) -> None:
        self.scene, self.optimiser = scene, optimiser
        self.bad_steps = 0
        self.rollbacks = 0
        self.quarantined: dict[str, int] = {}
        self.snapshot()

    def all_gaussians(self) -> list[tuple[str, Gaussians]]:
        """Every set of Gaussians with its owner's name."""
        sets = [(o.name, o.gaussians) for o in self.scene.objects]
        return sets + ([("background", self.scene.background)] if self.scene.background is not None else [])

    def quarantine(self) -> list[str]:
        """Neutralise Gaussians with non-finite parameters, limit logits; a sentence per owner, none if all is well."""
        found = []
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
                found.append(f"{count} Gaussians of {owner} were not finite and were made transparent")
            with torch.no_grad():
                gaussians.logit_opacities.clamp_(-safemath.LOGIT_LIMIT, safemath.LOGIT_LIMIT)
        return found

    def judge(self, loss: Tensor) -> Verdict:
        """Look at the loss and every gradient after backward; non-finite rows of Gaussians are zeroed in place."""
        clean = bool(torch.isfinite(loss.detach()))
        if clean:
            clean = self._clear_rows()
        if clean:
            self.bad_steps = self.rollbacks = 0
            return "step"
        self.bad_steps += 1
        return "rollback" if self.bad_steps >= BAD_IN_A_ROW else "skip"

    def snapshot(self) -> None:
        """Remember the present state as good."""
        parameters = [p for group in self.optimiser.param_groups for p in group["params"]]
        moments = {}
        for p in parameters:
            state = self.optimiser.state.get(p, {})
            moments[p] = {k: v.clone() for k, v in state.items() if torch.is_tensor(v)}
        self._good = _Snapshot({p: p.detach().clone() for p in parameters}, moments)

    def rollback(self) -> None:
        """Back to the last snapshot. Raises GenmojoError("numeric") after ROLLBACKS of them without a good step."""
        self.rollbacks += 1
        self.bad_steps = 0
        if self.rollbacks > ROLLBACKS:
            raise GenmojoError("numeric", "the optimisation gives non-finite numbers again and again", "",
                               "start from the last checkpoint with smaller learning rates")  # fmt: skip
        with torch.no_grad():
            for p, value in self._good.values.items():
                p.copy_(value)
        for p, moments in self._good.moments.items():
            for key, value in moments.items():
                self.optimiser.state[p][key] = value.clone()

    def _clear_rows(self) -> bool:
        """Zero non-finite rows of per-Gaussian gradients; False if a shared parameter's gradient is not finite."""
        per_row = {id(getattr(g, name)) for _, g in self.all_gaussians() for name in Gaussians.NAMES}
        for group in self.optimiser.param_groups:
            for p in group["params"]:
                if p.grad is None or bool(torch.isfinite(p.grad.sum())):
                    continue
                finite = torch.isfinite(p.grad)
                if bool(finite.all()):  # only the sum overflowed
                    continue
                if id(p) not in per_row:
                    return False
                rows = finite.reshape(len(p), -1).all(dim=1)
                p.grad[~rows] = 0.0
        return True

    def _neutralise(self, gaussians: Gaussians, bad: Tensor) -> None:
        with torch.no_grad():
            for name in Gaussians.NAMES:
                parameter = getattr(gaussians, name)
                parameter[bad] = NEUTRAL[name]
                for key, value in self.optimiser.state.get(parameter, {}).items():
                    if torch.is_tensor(value) and value.shape == parameter.shape:
                        self.optimiser.state[parameter][key][bad] = 0.0
