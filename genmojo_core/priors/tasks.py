"""What the two networks of the embedded prior learn, and the figures that say how far they are."""

from __future__ import annotations

import numpy as np
import torch
from torch import Tensor
from torch.nn import functional

from genmojo_core.priors.batches import Batch
from genmojo_core.priors.denoiser import LOG_SIGMA, SPREAD, Denoiser
from genmojo_core.priors.volume import GREY, Rays, VolumeNet, render

RAYS = 120  # per view and step
NEAR_RAYS = 4.0  # how much likelier a ray near the silhouette is than one far from it
ALPHA_WEIGHT = 0.5
OVERLAP_WEIGHT = 0.05


class VolumeTask:
    """Squared error of rendered rays (colour on grey, coverage) and the overlap of silhouettes."""

    name = "volume"

    def __init__(self, net: VolumeNet) -> None:
        self.net = net

    def loss(self, batch: Batch, generator: torch.Generator) -> Tensor:
        """Mean over random rays of all views, most of them on the object or near it."""
        side = batch.targets.shape[-1]
        index = _chosen_rays(batch.targets[:, :, 3], generator)
        xy = torch.stack([index % side, index // side], dim=-1)
        xy = (xy + 0.5) / side * 2.0 - 1.0
        drawn = render(self.net(batch.condition, batch.facts), Rays(batch.to_space, batch.distance, xy), 24, generator)
        wanted = batch.targets.flatten(3).gather(3, index[:, :, None].expand(-1, -1, 4, -1)).transpose(2, 3)
        error = drawn[..., :4] - wanted
        alpha = error[..., 3]
        color = error[..., :3] - GREY * alpha[..., None]
        squared = (color**2).mean() + ALPHA_WEIGHT * (alpha**2).mean()
        return squared + OVERLAP_WEIGHT * (1.0 - _overlap(drawn[..., 3], wanted[..., 3]).mean())

    def measure(self, batch: Batch) -> dict[str, float]:
        """PSNR on grey, PSNR inside the union of silhouettes, mask IoU."""
        return scores(self.predict(batch), batch.targets)

    def predict(self, batch: Batch) -> Tensor:
        """(B, K, 4, S, S) premultiplied mean pictures."""
        return self.mean_and_depth(batch)[:, :, :4]

    def mean_and_depth(self, batch: Batch) -> Tensor:
        """(B, K, 5, S, S): premultiplied RGB, alpha, premultiplied depth."""
        side = batch.targets.shape[-1]
        pictures = []
        for i in range(0, len(batch.condition), 16):
            rows = slice(i, i + 16)
            part = Batch(*(getattr(batch, n)[rows] for n in Batch.__dataclass_fields__))
            drawn = render(self.net(part.condition, part.facts), part.rays(side))
            pictures.append(drawn.transpose(2, 3).unflatten(3, (side, side)))
        return torch.cat(pictures)


class DenoiserTask:
    """Weighted squared error of clean pictures around the mean pictures of a trained volume network."""

    name = "denoiser"

    def __init__(self, net: Denoiser, volume: VolumeNet) -> None:
        self.net = net
        self.means = VolumeTask(volume.eval().requires_grad_(False))

    def loss(self, batch: Batch, generator: torch.Generator) -> Tensor:
        """EDM's weighted loss at random noise: 1 for a network that knows the mean picture only."""
        mean, clean = self._pictures(batch)
        device = clean.device
        log_sigma = torch.randn(len(clean), generator=generator, device=device) * 1.2 - 1.8
        high = torch.rand(len(clean), generator=generator, device=device) < 0.1
        log_sigma = torch.where(high, LOG_SIGMA[1], log_sigma).clamp(*LOG_SIGMA)
        return self._weighted(mean, clean, torch.exp(log_sigma), generator)

    def measure(self, batch: Batch) -> dict[str, float]:
        """The weighted loss at three noise levels; 1 is the mean picture with the best linear filter."""
        mean, clean = self._pictures(batch)
        figures = {}
        for sigma in (0.05, 0.2, 1.0):
            generator = torch.Generator(clean.device).manual_seed(0)
            level = torch.full((len(clean),), sigma, device=clean.device)
            figures[f"at_{sigma}"] = float(self._weighted(mean, clean, level, generator))
        return figures

    def _pictures(self, batch: Batch) -> tuple[Tensor, Tensor]:
        """Mean with depth (B K, 5, S, S) and clean pictures (B K, 4, S, S)."""
        with torch.no_grad():
            return self.means.mean_and_depth(batch).flatten(0, 1), batch.targets.flatten(0, 1)

    def _weighted(self, mean: Tensor, clean: Tensor, sigma: Tensor, generator: torch.Generator) -> Tensor:
        noise = torch.randn(clean.shape, generator=generator, device=clean.device)
        s = sigma[:, None, None, None]
        got = self.net(clean + s * noise, mean, sigma)
        weight = (s * s + SPREAD**2) / (s * SPREAD) ** 2
        return (weight * (got - clean) ** 2).mean()


def _chosen_rays(alpha: Tensor, generator: torch.Generator) -> Tensor:
    """(B, K, RAYS) places in pictures (B, K, S, S), no place twice."""
    near = functional.max_pool2d(alpha, 5, stride=1, padding=2) > 0
    chances = torch.where(near, NEAR_RAYS, 1.0).flatten(2)
    return torch.multinomial(chances.flatten(0, 1), RAYS, generator=generator).unflatten(0, alpha.shape[:2])


def _overlap(ours: Tensor, theirs: Tensor) -> Tensor:
    """(B, K) intersection over union of soft coverage (B, K, R); 1 where neither covers anything."""
    both = (ours * theirs).sum(-1)
    return (both + 1.0) / ((ours + theirs).sum(-1) - both + 1.0)


def scores(predicted: Tensor, wanted: Tensor) -> dict[str, float]:
    """Figures of pictures (B, K, 4, S, S), premultiplied RGBA.

    psnr: mean over pictures of the PSNR on grey, dB. inside: the same over pixels of either silhouette. iou: mean.
    """
    predicted = predicted.clamp(0, 1)
    error = predicted - wanted
    squared = ((error[:, :, :3] - GREY * error[:, :, 3:]) ** 2).mean(2)
    ours, theirs = predicted[:, :, 3] > 0.5, wanted[:, :, 3] > 0.5
    both, either = (ours & theirs).sum((2, 3)), ours | theirs
    psnr = decibels(squared.mean((2, 3)))
    inside = decibels((squared * either).sum((2, 3)) / either.sum((2, 3)).clamp(min=1))
    iou = both / either.sum((2, 3)).clamp(min=1)
    return {"psnr": float(psnr.mean()), "inside": float(inside.mean()), "iou": float(iou.float().mean())}


def decibels(squared: Tensor) -> Tensor:
    """PSNR of mean squared errors against a range of 1; 100 dB at most."""
    return torch.from_numpy(-10.0 * np.log10(np.maximum(squared.detach().cpu().double().numpy(), 1e-10)))
