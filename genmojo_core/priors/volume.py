"""The embedded prior's first half: a network that fills a frustum with colour and density, and its volume rendering.

The frustum is aligned with the condition's pixels, so turning the view is exact geometry and nothing that is learned:
the network only says what lies along each pixel's ray. Density is cut by the condition's silhouette (visual hull);
behind an occluder, where the silhouette is unknown, the network decides alone.
"""

from __future__ import annotations

from dataclasses import dataclass

import torch
from torch import Tensor, nn
from torch.nn import functional

from genmojo_core.priors.solids import HALF_EXTENT

NEAR, FAR = -0.85, 1.05  # depths of the frustum's ends relative to the origin
REACH = 1.05  # rays are followed this far before and behind the origin
GREY = 0.5


@dataclass(frozen=True)
class VolumeShape:
    """Sizes of the network: channels at half and quarter of `side`, depth bins, side of the volume in cells."""

    narrow: int = 48
    wide: int = 96
    bins: int = 24
    side: int = 32


class VolumeNet(nn.Module):
    """Condition (B, 7, 2 side, 2 side) and facts (B, 2) to a volume (B, 4, bins, side, side): RGB and density per unit.

    facts: elevation of the condition camera in units of 30 degrees, 1 / distance.
    """

    def __init__(self, shape: VolumeShape = VolumeShape()) -> None:  # noqa: B008 - frozen
        super().__init__()
        self.shape = shape
        narrow, wide = shape.narrow, shape.wide
        self.stem = nn.Conv2d(7 * 16, narrow, 3, padding=1)
        self.first = nn.Sequential(Residual(narrow), Residual(narrow))
        self.down = nn.Conv2d(narrow, wide, 3, stride=2, padding=1)
        self.facts = nn.Linear(2, wide)
        self.deep = nn.Sequential(Residual(wide), Attention(wide), Residual(wide), Attention(wide))
        self.up = nn.Conv2d(wide, narrow, 3, padding=1)
        self.last = Residual(narrow)
        self.head = nn.Conv2d(narrow, 4 * shape.bins * 4, 3, padding=1)
        nn.init.normal_(self.head.weight, std=1e-3)
        nn.init.zeros_(self.head.bias)
        depth = torch.linspace(NEAR, FAR, shape.bins)
        self.register_buffer("slab", 1.0 - 8.0 * depth**2, persistent=False)

    slab: Tensor

    def forward(self, condition: Tensor, facts: Tensor) -> Tensor:
        """The volume; see the class."""
        x = self.first(self.stem(functional.pixel_unshuffle(condition, 4)))
        y = self.down(functional.silu(x)) + self.facts(facts)[:, :, None, None]
        y = self.up(functional.interpolate(self.deep(y), scale_factor=2.0, mode="nearest"))
        cells = functional.pixel_shuffle(self.head(functional.silu(self.last(x + y))), 2)
        cells = cells.unflatten(1, (4, self.shape.bins))
        small = functional.avg_pool2d(condition, 2)
        alpha, hidden = small[:, 3:4], small[:, 4:5]
        seen = condition[:, 3:4]
        mean = (condition[:, :3] * seen).sum((2, 3)) / seen.sum((2, 3)).clamp(min=1.0)
        own = functional.avg_pool2d(condition[:, :3] * seen, 2) / alpha.clamp(min=1e-3)
        base = torch.where(alpha > 0.05, own, mean[:, :, None, None].expand_as(own))
        hull = torch.maximum(alpha, hidden)
        density = functional.softplus(2.0 * cells[:, 3:] + self.slab[None, None, :, None, None]) * hull[:, :, None]
        return torch.cat([base[:, :, None] + cells[:, :3], 20.0 * density], dim=1)


class Residual(nn.Module):
    """Two convolutions around a shortcut."""

    def __init__(self, channels: int) -> None:
        super().__init__()
        self.norms = nn.ModuleList([nn.GroupNorm(8, channels), nn.GroupNorm(8, channels)])
        self.convs = nn.ModuleList([nn.Conv2d(channels, channels, 3, padding=1) for _ in range(2)])
        nn.init.zeros_(self.convs[1].weight)
        nn.init.zeros_(self.convs[1].bias)

    def forward(self, x: Tensor) -> Tensor:
        """(B, C, H, W) to the same."""
        y = x
        for norm, conv in zip(self.norms, self.convs, strict=True):
            y = conv(functional.silu(norm(y)))
        return x + y


class Attention(nn.Module):
    """Every cell looks at every other: far sides share what is known about the object."""

    def __init__(self, channels: int, heads: int = 4) -> None:
        super().__init__()
        self.heads = heads
        self.norm = nn.GroupNorm(8, channels)
        self.mix = nn.Conv2d(channels, 3 * channels, 1)
        self.out = nn.Conv2d(channels, channels, 1)
        nn.init.zeros_(self.out.weight)
        nn.init.zeros_(self.out.bias)

    def forward(self, x: Tensor) -> Tensor:
        """(B, C, H, W) to the same."""
        batch, channels, height, width = x.shape
        parts = self.mix(self.norm(x)).reshape(batch, 3, self.heads, channels // self.heads, height * width)
        query, key, value = parts.transpose(-1, -2).unbind(1)
        mixed = functional.scaled_dot_product_attention(query, key, value)
        return x + self.out(mixed.transpose(-1, -2).reshape(batch, channels, height, width))


@dataclass(frozen=True)
class Rays:
    """Where pictures of B volumes are taken.

    Args:
        to_space: (B, K, 4, 4) camera to the prior's space. distance: (B,) of every condition camera to the origin.
        xy: (B, K, R, 2) places in the picture, -1..1 right and down.
        cameras: (B, K) distance of the pictures' own cameras to the origin, the middle of their pictures; None: as the
            condition's.
    """

    to_space: Tensor
    distance: Tensor
    xy: Tensor
    cameras: Tensor | None = None


def picture_rays(to_space: Tensor, distance: Tensor, side: int) -> Rays:
    """Rays through all pixels of square pictures, row by row."""
    ticks = (torch.arange(side, dtype=torch.float32, device=to_space.device) + 0.5) / side * 2.0 - 1.0
    xy = torch.stack(torch.meshgrid(ticks, ticks, indexing="xy"), dim=-1).reshape(1, 1, -1, 2)
    return Rays(to_space, distance, xy.expand(*to_space.shape[:2], -1, -1))


def render(volume: Tensor, rays: Rays, samples: int = 24, jitter: torch.Generator | None = None) -> Tensor:
    """(B, K, R, 5): premultiplied RGB, alpha, premultiplied depth relative to the origin along the camera's axis.

    Args:
        volume: (B, 4, bins, side, side). samples: per ray. jitter: moves the samples of every ray at random.
    """
    own = rays.distance[:, None].expand(rays.xy.shape[:2]) if rays.cameras is None else rays.cameras
    distance = own[..., None, None]
    offset = torch.full((*rays.xy.shape[:3], 1), 0.5, device=volume.device)
    if jitter is not None:
        offset = torch.rand(offset.shape, generator=jitter, device=volume.device)
    step = 2.0 * REACH / samples
    along = torch.arange(samples, dtype=torch.float32, device=volume.device)
    z = distance - REACH + (along + offset) * step  # (B, K, R, N)
    slope = HALF_EXTENT / own[..., None, None, None]
    local = torch.cat([rays.xy[..., None, :] * slope * z[..., None], z[..., None]], dim=-1)
    turn, place = rays.to_space[..., :3, :3], rays.to_space[..., :3, 3]
    points = local.flatten(2, 3) @ turn.transpose(-1, -2) + place[..., None, :]  # (B, K, R N, 3)
    deep = points[..., 2] + rays.distance[:, None, None]
    lens = rays.distance[:, None, None] / (HALF_EXTENT * deep.clamp(min=1e-2))
    third = (points[..., 2] - NEAR) / (FAR - NEAR) * 2.0 - 1.0
    where = torch.stack([points[..., 0] * lens, points[..., 1] * lens, third], dim=-1)
    got = functional.grid_sample(volume, where[:, None].flatten(1, 2)[:, :, :, None], align_corners=False)
    got = got[..., 0].movedim(1, -1).unflatten(2, (-1, samples))  # (B, K, R, N, 4)
    thickness = got[..., 3] * step
    passed = torch.exp(thickness - torch.cumsum(thickness, dim=-1))
    weight = passed * (1.0 - torch.exp(-thickness))
    color = (weight[..., None] * got[..., :3]).sum(-2)
    depth = (weight * (z - distance)).sum(-1, keepdim=True)
    return torch.cat([color, weight.sum(-1, keepdim=True), depth], dim=-1)
