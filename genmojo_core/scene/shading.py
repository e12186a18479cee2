"""Shading that stays in the world while an object turns under it: a smooth factor of where its surface faces.

Light from far away makes a matt surface as bright as its normal says, and all such light is told within a percent by
spherical harmonics up to order 2 (Ramamoorthi and Hanrahan 2001). Colours are those of the object's canonical frame;
in frame t they are multiplied by exp(c . (Y(n_t) - Y(n_ref))), with one c for the scene. Eight numbers cannot stand in
for motion, and without them colours or poses would follow the light.
"""

from __future__ import annotations

from collections.abc import Sequence

import torch
from torch import Tensor, nn

from genmojo_core.conventions import SHADE_LIMIT
from genmojo_core.scene import safemath

TERMS = 8
_FEWEST = 50  # observations that a start is fitted to
_PULL = 0.02  # of all observations: how strongly a start is drawn to no shading


class Shade(nn.Module):
    """Logarithm of brightness by the world normal, spherical harmonics of order 1 and 2.

    Args:
        start: (8,) measured coefficients, or None for no shading.
    """

    def __init__(self, start: Tensor | None = None) -> None:
        super().__init__()
        self.shade = nn.Parameter(torch.zeros(TERMS) if start is None else start.detach().clone().float())

    def forward(self, canonical: Tensor, now: Tensor) -> Tensor:
        """(N, 1) factors of colours, for unit world normals (N, 3) in the canonical frame and now."""
        change = (harmonics(now) - harmonics(canonical)) @ self.shade
        return torch.exp(change.clamp(-SHADE_LIMIT, SHADE_LIMIT))[:, None]


def harmonics(normals: Tensor) -> Tensor:  # (N, 3) -> (N, 8)
    """As conventions.harmonics, with gradients."""
    x, y, z = normals.unbind(-1)
    return torch.stack([x, y, z, x * y, y * z, z * x, 1.5 * z * z - 0.5, 0.5 * (x * x - y * y)], dim=-1)


def thin_axes(log_scales: Tensor) -> Tensor:  # (N, 3) -> (N, 3)
    """Unit vector along every Gaussian's thinnest axis in its own axes."""
    return nn.functional.one_hot(log_scales.argmin(dim=1), 3).to(log_scales)


def outward(means: Tensor, quats: Tensor, axes: Tensor) -> Tensor:  # (N, 3), (N, 4) unit, (N, 3) -> (N, 3)
    """The axes with the sign that makes them point away from the object's centre, as surface seen from outside does."""
    away = (safemath.rotate(quats, axes) * means).sum(dim=1, keepdim=True)
    return torch.where(away < 0, -axes, axes)


def fitted(changes: Sequence[Tensor], ratios: Sequence[Tensor]) -> Tensor | None:
    """Coefficients (8,) that explain how much brighter places became; None where there is too little to see.

    Args:
        changes: (N, 8) each, what `harmonics` changed by. ratios: (N,) each, logarithms of brightness now by that then.
    """
    rows, wanted = torch.cat(list(changes)).double(), torch.cat(list(ratios)).double()
    if len(wanted) < _FEWEST:
        return None
    weight = torch.ones_like(wanted)
    found = torch.zeros(TERMS, dtype=torch.float64)
    for _ in range(5):
        pull = _PULL * weight.sum() * torch.eye(TERMS, dtype=torch.float64)
        found = torch.linalg.solve(rows.T @ (weight[:, None] * rows) + pull, rows.T @ (weight * wanted))
        off = (wanted - rows @ found).abs()
        weight = 1.0 / (1.0 + (off / off.median().clamp(min=0.02)) ** 2)
    return found.float()
