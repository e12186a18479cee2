"""K-planes: six feature planes over (x, y, z, t), multiplied, at several resolutions (METHOD.md section 4).

The three space planes are read once per step for all frames; the three space-time planes are read per time.
"""

from __future__ import annotations

import torch
from torch import Tensor, nn

from genmojo_core.scene.plane_sampling import sample_planes, sample_time_planes


class KPlanes(nn.Module):
    """Features of points of a box over time.

    Args:
        box: (2, 3) lowest and highest corner in object units; outside, the border's features hold.
        resolution: spatial nodes of the coarsest level. levels: multiples of it. time_nodes: nodes along time.
        channels: features per level. generator: for the start values (space uniform 0.1..0.5, time 1).
    """

    def __init__(
        self,
        box: Tensor,
        resolution: int,
        levels: tuple[int, ...],
        time_nodes: int,
        channels: int,
        generator: torch.Generator,
    ) -> None:
        super().__init__()
        self.register_buffer("box", box.float())
        self.space = nn.ParameterList()
        self.time = nn.ParameterList()
        for level in levels:
            r = resolution * level
            start = 0.1 + 0.4 * torch.rand(3, r, r, channels, generator=generator)
            self.space.append(nn.Parameter(start))
            self.time.append(nn.Parameter(torch.ones(3, r, time_nodes, channels)))
        self.features = channels * len(levels)

    box: Tensor

    def coordinates(self, points: Tensor) -> Tensor:  # (N, 3) object units -> (N, 3) in -1..1
        """Box coordinates; an axis without extent maps to 0 instead of NaN."""
        low, high = self.box
        extent = (high - low).clamp(min=1e-6)
        return (2.0 * (points - low) / extent - 1.0).clamp(-1.0, 1.0)

    def forward(self, points: Tensor, times: Tensor) -> Tensor:  # (N, 3), (B,) in -1..1 -> (B, N, features)
        """Features of every point at every time; no gradient to the points (they are canonical)."""
        coords = self.coordinates(points.detach())
        levels = [
            sample_planes(space, coords)[None] * sample_time_planes(time, coords, times)
            for space, time in zip(self.space, self.time, strict=True)
        ]
        return torch.cat(levels, dim=-1)
