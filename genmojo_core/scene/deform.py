"""Deformation of one object: motion bases with coefficients from K-planes, and heads for scale, rotation, colour.

METHOD.md section 4 with its recommended corrections: every output is exactly zero before the first step (bases start
at zero, head outputs start at zero), while the coefficients start spatially varied, so that the bases can part.
"""

from __future__ import annotations

from dataclasses import dataclass

import torch
from torch import Tensor, nn

from genmojo_core.scene.kplanes import KPlanes


@dataclass(frozen=True)
class Deformation:
    """What the field says about N points at B times, in object space.

    d_means (B, N, 3) object units; d_log_scales (B, N, 3); d_quats (B, N, 4) added to the raw quaternion;
    d_dc (B, N, 3) or None if the clip calls for no change of appearance.
    """

    d_means: Tensor
    d_log_scales: Tensor
    d_quats: Tensor
    d_dc: Tensor | None

    def at(self, b: int) -> Deformation:
        """The deformation at one of the times, leading axis dropped."""
        return Deformation(self.d_means[b], self.d_log_scales[b], self.d_quats[b],
                           None if self.d_dc is None else self.d_dc[b])  # fmt: skip


@dataclass(frozen=True)
class FieldShape:
    """Sizes of a deformation field (config.py gives the presets)."""

    frames: int
    bases: int = 10
    resolution: int = 48
    levels: tuple[int, ...] = (1, 2)
    channels: int = 16
    width: int = 64
    appearance: bool = False


class DeformationField(nn.Module):
    """Motion of one object.

    Args:
        box: (2, 3) of the canonical means, enlarged by the caller.
        anchors: (bases, 3) canonical points; coefficients start as a softmax of closeness to them.
        shape: sizes. generator: for start values.
    """

    def __init__(self, box: Tensor, anchors: Tensor, shape: FieldShape, generator: torch.Generator) -> None:
        super().__init__()
        self.shape = shape
        time_nodes = max(2, min(shape.frames, max(25, int(0.8 * shape.frames))))
        self.planes = KPlanes(box, shape.resolution, shape.levels, time_nodes, shape.channels, generator)
        self.trunk = nn.Linear(self.planes.features, shape.width)
        self.outputs = 7 + shape.bases + (3 if shape.appearance else 0)
        self.head = nn.Linear(shape.width, self.outputs)
        nn.init.xavier_uniform_(self.trunk.weight, generator=generator)
        nn.init.zeros_(self.trunk.bias)
        nn.init.zeros_(self.head.weight)
        nn.init.zeros_(self.head.bias)
        self.bases = nn.Parameter(torch.zeros(shape.frames, shape.bases, 3))
        self.register_buffer("anchors", anchors.float())
        spread = (anchors[:, None] - anchors[None]).norm(dim=-1)
        self.register_buffer("reach", spread[spread > 0].mean() if len(anchors) > 1 else torch.tensor(1.0))

    anchors: Tensor
    reach: Tensor

    def forward(self, points: Tensor, frames: Tensor) -> Deformation:  # (N, 3) canonical, (B,) int64
        """Deformation of canonical points at some frames."""
        times = 2.0 * frames.float() / max(self.shape.frames - 1, 1) - 1.0
        hidden = torch.relu(self.trunk(self.planes(points, times)))
        out = self.head(hidden)
        k = self.shape.bases
        coefficients = torch.softmax(self._closeness(points)[None] + out[..., 7 : 7 + k], dim=-1)  # rows sum to 1
        d_means = torch.bmm(coefficients, self.bases[frames])
        d_dc = out[..., 7 + k :] if self.shape.appearance else None
        return Deformation(d_means, out[..., 0:3], out[..., 3:7], d_dc)

    def coefficients(self, points: Tensor) -> Tensor:  # (N, 3) -> (N, bases)
        """Start values of the motion coefficients: how close each canonical point is to each anchor; rows sum to 1."""
        return torch.softmax(self._closeness(points), dim=-1)

    def _closeness(self, points: Tensor) -> Tensor:
        return -4.0 * (points.detach()[:, None] - self.anchors[None]).norm(dim=-1) / self.reach

    def smoothness(self) -> Tensor:
        """Mean squared second difference of the bases in time; 0 for fewer than three frames."""
        if len(self.bases) < 3:
            return self.bases.sum() * 0.0
        second = self.bases[2:] - 2.0 * self.bases[1:-1] + self.bases[:-2]
        return (second * second).mean()
