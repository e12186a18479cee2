"""The prior that comes with the project: small, trained on procedural objects only, runs on a CPU (PRIOR.md)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
import torch
from torch import Tensor
from torch.nn import functional

from genmojo_core.conventions import orbit_camera
from genmojo_core.priors.batches import facts_of
from genmojo_core.priors.denoiser import Denoiser, sigma_of
from genmojo_core.priors.generator import CONDITION, SIDE
from genmojo_core.priors.prior import Judgement, Reference, ViewOffsets
from genmojo_core.priors.volume import VolumeNet, picture_rays, render

NEAR_AZIMUTH = 15.0  # degrees: closer to the reference the frames themselves say more
BODY = 0.65  # coverage from which a mean view shows the body; from half on, bodies come out too wide (prior.md)


@dataclass(frozen=True)
class Condition:
    """One reference as the networks see it.

    volume: (1, 4, bins, side, side), computed once. reference: what it was made from.
    """

    volume: Tensor
    reference: Reference


class EmbeddedPrior:
    """Frustum volume and denoiser.

    Args:
        volume, denoiser: trained networks; they are frozen and put into evaluation mode.
        agreement: how much two volumes of one object may differ (agreement.py).
    """

    resolution = SIDE
    channels: Literal["rgb", "rgba"] = "rgba"
    kind: Literal["embedded", "zero123", "zeronvs"] = "embedded"
    scope: Literal["object", "scene"] = "object"

    def __init__(self, volume: VolumeNet, denoiser: Denoiser, agreement: float = 1.0) -> None:
        self.agreement = agreement
        self.volume = volume.eval().requires_grad_(False)
        self.denoiser = denoiser.eval().requires_grad_(False)

    def distance(self, reference: Reference) -> float:
        """The reference's own: the volume is a frustum of its camera."""
        return reference.distance

    @torch.no_grad()
    def encode(self, reference: Reference) -> Condition:
        """The volume that a reference calls for."""
        channels = channels_of(reference)
        facts = torch.tensor([facts_of(reference.elevation, reference.distance)])
        return Condition(self.volume(channels, facts), reference)

    def embed(self, renders: Tensor) -> Tensor:
        """Area resampling to 32 x 32; premultiplied RGBA stays what it is."""
        if renders.shape[-1] == self.resolution:
            return renders
        return functional.interpolate(renders, (self.resolution, self.resolution), mode="area")

    @torch.no_grad()
    def judge(
        self, embedded: Tensor, condition: Condition, views: ViewOffsets, level: float, generator: torch.Generator
    ) -> Judgement:
        """Mean view from the volume, clean picture from the denoiser, confidence from both angle and coverage.

        The mean view is made solid: half covered pixels are a doubt of the volume's, no glass of the object's.
        """
        drawn = self._draw(condition, views, self.resolution).to(embedded.dtype)
        mean = drawn[:, :4].clamp(0, 1)
        sigma = torch.full((len(embedded),), sigma_of(level), dtype=embedded.dtype)
        noise = torch.randn(embedded.shape, generator=generator, dtype=torch.float32).to(embedded.dtype)
        noisy = embedded + sigma[:, None, None, None] * noise
        clean = self.denoiser(noisy.float(), drawn.float(), sigma.float()).to(embedded.dtype)
        weight = sigma / (1.0 + sigma * sigma)
        return Judgement(clean, weight, _solid(mean), _confidence(mean, views))

    @torch.no_grad()
    def predict(self, condition: Condition, views: ViewOffsets) -> Tensor:
        """(B, 4, 32, 32) mean pictures of the volume."""
        return self._draw(condition, views, self.resolution)[:, :4].clamp(0, 1)

    @torch.no_grad()
    def surface(self, condition: Condition, views: ViewOffsets, side: int) -> Tensor:
        """(B, 5, side, side): premultiplied RGB, alpha, premultiplied depth relative to the origin, of the volume."""
        return self._draw(condition, views, side)

    def _draw(self, condition: Condition, views: ViewOffsets, side: int) -> Tensor:
        poses = view_cameras(condition.reference, views, condition.reference.distance)
        to_space = torch.tensor(np.linalg.inv(poses), dtype=torch.float32)[None]
        rays = picture_rays(to_space, torch.tensor([condition.reference.distance]), side)
        rays = replace(rays, cameras=(condition.reference.distance + views.radius.float())[None])
        return render(condition.volume, rays)[0].transpose(1, 2).unflatten(2, (side, side))


def channels_of(reference: Reference) -> Tensor:
    """(1, 7, CONDITION, CONDITION) float32: a reference as the volume network is shown it (generator.Example)."""
    channels = torch.cat([
        reference.picture[:3] * (reference.picture[3:] > 0), reference.picture[3:], reference.hidden[None],
        (reference.depth * reference.known)[None], reference.known[None],
    ])[None]  # fmt: skip
    if channels.shape[-1] != CONDITION:
        channels = functional.interpolate(channels, (CONDITION, CONDITION), mode="area")
    return channels.float()


def view_cameras(reference: Reference, views: ViewOffsets, distance: float) -> np.ndarray:
    """(B, 4, 4) float64 world to camera of views, in the prior's space, at `distance` (+ radius) from its origin."""
    poses = []
    for elevation, azimuth, radius in zip(views.elevation, views.azimuth, views.radius, strict=True):
        start = np.eye(4)
        start[2, 3] = distance + float(radius)
        poses.append(orbit_camera(start, np.zeros(3), np.array(reference.up), float(elevation), float(azimuth)))
    return np.stack(poses)


def _solid(mean: Tensor) -> Tensor:
    """(B, 4, h, w) premultiplied: fully covered from BODY of coverage on, in the same colour, else empty."""
    coverage = mean[:, 3:4]
    return torch.where(coverage >= BODY, mean / coverage.clamp(min=BODY), 0.0)


def _confidence(mean: Tensor, views: ViewOffsets) -> Tensor:
    """(B, 1, h, w): places whose coverage is unsure count little; views near the reference count nothing."""
    azimuth = (views.azimuth.double() + 180.0) % 360.0 - 180.0
    turned = (azimuth.abs() + views.elevation.double().abs()) >= NEAR_AZIMUTH
    beyond = mean[:, 3:4] - BODY
    sure = (beyond / torch.where(beyond >= 0, 1.0 - BODY, BODY)) ** 2
    return sure * turned.to(mean.dtype)[:, None, None, None]
