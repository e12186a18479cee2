"""The embedded prior's second half: a small diffusion denoiser around the pictures of the volume.

It sees a noisy picture, the volume's mean picture and depth of the same view, pixel by pixel aligned, and gives the
clean picture (EDM preconditioning of the difference to the mean).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import torch
from torch import Tensor, nn
from torch.nn import functional

from genmojo_core.priors.volume import Attention, Residual
from genmojo_core.scene.safemath import safe_log

SPREAD = 0.12  # standard deviation of pictures about their mean view
LOG_SIGMA = (math.log(0.03), math.log(4.0))  # noise at level 0 and 1


@dataclass(frozen=True)
class DenoiserShape:
    """Channels at full resolution and below."""

    narrow: int = 32
    wide: int = 64


class Denoiser(nn.Module):
    """Noisy pictures (N, 4, S, S), mean and depth (N, 5, S, S), sigma (N,) to clean pictures (N, 4, S, S)."""

    def __init__(self, shape: DenoiserShape = DenoiserShape()) -> None:  # noqa: B008 - frozen
        super().__init__()
        self.shape = shape
        narrow, wide = shape.narrow, shape.wide
        self.noise = nn.Sequential(nn.Linear(8, wide), nn.SiLU(), nn.Linear(wide, narrow + 2 * wide))
        self.stem = nn.Conv2d(9, narrow, 3, padding=1)
        self.fine = Residual(narrow)
        self.down = nn.Conv2d(narrow, wide, 3, stride=2, padding=1)
        self.middle = Residual(wide)
        self.deeper = nn.Conv2d(wide, wide, 3, stride=2, padding=1)
        self.deep = nn.Sequential(Residual(wide), Attention(wide), Residual(wide))
        self.up = nn.Conv2d(wide, wide, 3, padding=1)
        self.middle_again = Residual(wide)
        self.upper = nn.Conv2d(wide, narrow, 3, padding=1)
        self.fine_again = Residual(narrow)
        self.out = nn.Conv2d(narrow, 4, 3, padding=1)
        nn.init.zeros_(self.out.weight)
        nn.init.zeros_(self.out.bias)

    def forward(self, noisy: Tensor, mean: Tensor, sigma: Tensor) -> Tensor:
        """The clean pictures; see the class."""
        s = sigma[:, None, None, None]
        total = s * s + SPREAD**2
        gap = noisy - mean[:, :4]
        shown = torch.cat([gap * total**-0.5, mean], dim=1)
        return mean[:, :4] + SPREAD**2 / total * gap + s * SPREAD * total**-0.5 * self._network(shown, sigma)

    def _network(self, shown: Tensor, sigma: Tensor) -> Tensor:
        """What EDM calls F."""
        narrow, wide = self.shape.narrow, self.shape.wide
        level = (safe_log(sigma, 1e-4) - LOG_SIGMA[0]) / (LOG_SIGMA[1] - LOG_SIGMA[0])
        waves = level[:, None] * torch.tensor([1.0, 2.0, 4.0, 8.0], device=sigma.device) * math.pi
        parts = self.noise(torch.cat([waves.sin(), waves.cos()], dim=1))[:, :, None, None]
        first, second, third = parts.split([narrow, wide, wide], dim=1)
        x = self.fine(self.stem(shown) + first)
        y = self.middle(self.down(functional.silu(x)) + second)
        z = self.deep(self.deeper(functional.silu(y)) + third)
        y = self.middle_again(y + self.up(functional.interpolate(z, scale_factor=2.0)))
        x = self.fine_again(x + self.upper(functional.interpolate(y, scale_factor=2.0)))
        return self.out(functional.silu(x))


def sigma_of(level: float) -> float:
    """Noise of a level 0..1."""
    low, high = LOG_SIGMA
    return math.exp(low + (high - low) * min(max(level, 0.0), 1.0))
