"""Density control: grow where the gradient asks for it, prune what nobody sees. One function per rule.

Thresholds are relative (top share of gradients), so they do not depend on a rasteriser's gradient units
(METHOD.md section 11.3).
"""

from __future__ import annotations

import math

import torch
from torch import Tensor

from genmojo_core.scene import safemath
from genmojo_core.scene.gaussians import Gaussians

GROW_SHARE = 0.1  # of the Gaussians, per control
MIN_OPACITY = 0.01
MAX_SIGMA = 0.35  # object units
KEEP_AT_LEAST = 16
SPLIT_SHRINK = 1.6


class GradientStatistics:
    """Mean gradient length of each Gaussian's position since the last control."""

    def __init__(self, count: int) -> None:
        self.total = torch.zeros(count)
        self.seen = torch.zeros(count)

    def add(self, gradient: Tensor) -> None:  # (N, 3)
        """Count one step; a Gaussian without gradient was not seen."""
        length = gradient.norm(dim=1)
        self.total += length
        self.seen += (length > 0).float()

    def mean(self) -> Tensor:
        """(N,) 0 for those never seen."""
        return self.total / self.seen.clamp(min=1.0)


def select_growth(mean_gradient: Tensor, room: int, share: float = GROW_SHARE) -> Tensor:
    """Rows to grow: the largest `share` of gradients, at most `room`, none with gradient 0."""
    count = min(room, int(share * len(mean_gradient)))
    if count < 1:
        return torch.zeros(0, dtype=torch.int64)
    values, rows = mean_gradient.topk(count)
    return rows[values > 0]


def prunable(gaussians: Gaussians) -> Tensor:
    """(N,) bool: too transparent or too big; never so many that fewer than KEEP_AT_LEAST stay."""
    opacity = gaussians.opacities().detach()
    bad = (opacity < MIN_OPACITY) | (gaussians.scales().detach().amax(dim=1) > MAX_SIGMA)
    spared = KEEP_AT_LEAST - int((~bad).sum())
    if spared > 0:
        best = torch.where(bad, opacity, torch.full_like(opacity, -1.0)).topk(min(spared, len(bad))).indices
        bad[best] = False
    return bad


def children(gaussians: Gaussians, rows: Tensor, generator: torch.Generator) -> tuple[dict[str, Tensor], Tensor]:
    """New Gaussians for the grown rows, and which of these rows are split (their parent goes away).

    A row larger than the median size is split in two along its longest axis; a smaller one is cloned with a jitter of a
    third of its size. Opacity is shared so that the pair covers what the parent did.
    """
    values = {name: getattr(gaussians, name).detach()[rows] for name in Gaussians.NAMES}
    sigma = safemath.exp_scale(values["log_scales"])
    split = sigma.amax(dim=1) > gaussians.scales().detach().amax(dim=1).median()
    axis = sigma.argmax(dim=1)
    direction = _axis(values["quats"], axis) * sigma.gather(1, axis[:, None])
    jitter = torch.randn(len(rows), 3, generator=generator) * sigma.mean(dim=1, keepdim=True) / 3.0
    first = {name: value.clone() for name, value in values.items()}
    first["means"] = torch.where(split[:, None], values["means"] + 0.7 * direction, values["means"] + jitter)
    shrunk = values["log_scales"] - math.log(SPLIT_SHRINK)
    first["log_scales"] = torch.where(split[:, None], shrunk, values["log_scales"])
    second = {name: value[split] for name, value in values.items()}
    second["means"] = (values["means"] - 0.7 * direction)[split]
    second["log_scales"] = shrunk[split]
    return {name: torch.cat([first[name], second[name]]) for name in first}, split


def control(
    gaussians: Gaussians, statistics: GradientStatistics, cap: int, optimiser: torch.optim.Optimizer,
    generator: torch.Generator,
) -> tuple[int, int]:  # fmt: skip
    """One round of growing and pruning, optimiser moments carried along.

    Returns how many Gaussians were added and removed.
    """
    before = len(gaussians)
    drop = prunable(gaussians)
    gradient = torch.where(drop, torch.zeros_like(statistics.mean()), statistics.mean())
    rows = select_growth(gradient, max(0, cap - int((~drop).sum())) // 2)
    added, split = children(gaussians, rows, generator)
    drop[rows[split]] = True
    keep = torch.nonzero(~drop)[:, 0]
    parents = torch.cat([rows, rows[split]])
    replace_rows(gaussians, keep, added, optimiser, gaussians.invented[parents])
    return len(added["means"]), before - len(keep)


def keep_only(gaussians: Gaussians, keep: Tensor, optimiser: torch.optim.Optimizer) -> None:
    """Remove all other rows; keep: (N,) bool."""
    nothing = {name: getattr(gaussians, name).detach()[:0] for name in Gaussians.NAMES}
    replace_rows(gaussians, torch.nonzero(keep)[:, 0], nothing, optimiser)


def replace_rows(
    gaussians: Gaussians, keep: Tensor, added: dict[str, Tensor], optimiser: torch.optim.Optimizer,
    invented: Tensor | None = None,
) -> None:  # fmt: skip
    """Gaussians.replace_rows with the optimiser's moments kept for the kept rows and zero for the new ones."""
    old = {name: getattr(gaussians, name) for name in Gaussians.NAMES}
    gaussians.replace_rows(keep, added, invented)
    for name, parameter in old.items():
        new = getattr(gaussians, name)
        new.requires_grad_(parameter.requires_grad)
        for group in optimiser.param_groups:
            group["params"] = [new if p is parameter else p for p in group["params"]]
        state = optimiser.state.pop(parameter, None)
        if not state:
            continue
        for key, value in state.items():
            if torch.is_tensor(value) and value.shape == parameter.shape:
                fresh = torch.zeros(len(new) - len(keep), *value.shape[1:])
                state[key] = torch.cat([value[keep], fresh])
        optimiser.state[new] = state


def _axis(quats: Tensor, axis: Tensor) -> Tensor:
    """(N, 3) unit direction of one principal axis of each Gaussian."""
    unit = torch.nn.functional.one_hot(axis, 3).float()
    return safemath.rotate(safemath.normalise(quats), unit)
