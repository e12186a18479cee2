"""Canonical Gaussians of one object (or of the background) as trainable parameters."""

from __future__ import annotations

import torch
from torch import Tensor, nn

from genmojo_core.conventions import SH_C0
from genmojo_core.scene import safemath


class Gaussians(nn.Module):
    """N Gaussians in object space; stored spaces are in the names.

    Args (all float32):
        means: (N, 3) object units. quats: (N, 4) wxyz, not necessarily unit. log_scales: (N, 3) natural log.
        logit_opacities: (N,). dc: (N, 3) constant spherical-harmonic coefficient, rgb = 0.5 + SH_C0 dc.

    `uid` (N,) int64 is stable over density control; `next_uid` is the first unused one. `invented` (N,) bool: drawn by
    a prior where no frame shows anything, or grown from such a one; of the background, painted in where no frame shows
    it.
    """

    NAMES = ("means", "quats", "log_scales", "logit_opacities", "dc")

    def __init__(self, means: Tensor, quats: Tensor, log_scales: Tensor, logit_opacities: Tensor, dc: Tensor) -> None:
        super().__init__()
        for name, value in zip(self.NAMES, (means, quats, log_scales, logit_opacities, dc), strict=True):
            self.register_parameter(name, nn.Parameter(value.detach().clone().float().contiguous()))
        self.register_buffer("uid", torch.arange(len(means)))
        self.register_buffer("invented", torch.zeros(len(means), dtype=torch.bool))
        self.next_uid = len(means)

    means: nn.Parameter
    quats: nn.Parameter
    log_scales: nn.Parameter
    logit_opacities: nn.Parameter
    dc: nn.Parameter
    uid: Tensor
    invented: Tensor

    def __len__(self) -> int:
        return self.means.shape[0]

    @staticmethod
    def from_points(points: Tensor, rgb: Tensor, sigma: Tensor, opacity: float = 0.9) -> Gaussians:
        """Isotropic Gaussians: points (N, 3), rgb (N, 3) in 0..1, sigma (N,) in the points' units."""
        quats = torch.zeros(len(points), 4)
        quats[:, 0] = 1.0
        log_scales = safemath.safe_log(sigma.clamp(min=1e-7), 1e-7)[:, None].repeat(1, 3)
        logits = safemath.logit(torch.full((len(points),), opacity))
        return Gaussians(points, quats, log_scales, logits, (rgb - 0.5) / SH_C0)

    @staticmethod
    def from_surface(points: Tensor, rgb: Tensor, axes: tuple[Tensor, Tensor], opacity: float = 0.9) -> Gaussians:
        """Gaussians laid on a surface: points (N, 3), rgb (N, 3) in 0..1, axes = quats (N, 4), sigmas (N, 3)."""
        quats, sigmas = axes
        logits = safemath.logit(torch.full((len(points),), opacity))
        return Gaussians(points, quats, safemath.safe_log(sigmas.clamp(min=1e-7), 1e-7), logits, (rgb - 0.5) / SH_C0)

    def opacities(self) -> Tensor:
        """(N,) in 0..1."""
        return torch.sigmoid(self.logit_opacities)

    def scales(self) -> Tensor:
        """(N, 3) linear standard deviations in object units."""
        return safemath.exp_scale(self.log_scales)

    def replace_rows(self, keep: Tensor, added: dict[str, Tensor], invented: Tensor | None = None) -> None:
        """Keep some rows (indices) and append new ones; new rows get fresh uids. Optimiser state is density.py's.

        invented: (new rows,) bool, None for none of them.
        """
        count = len(added["means"])
        fresh = torch.arange(self.next_uid, self.next_uid + count)
        self.next_uid += count
        self.uid = torch.cat([self.uid[keep], fresh])
        added_invented = torch.zeros(count, dtype=torch.bool) if invented is None else invented
        self.invented = torch.cat([self.invented[keep], added_invented])
        for name in self.NAMES:
            old = getattr(self, name)
            setattr(self, name, nn.Parameter(torch.cat([old.detach()[keep], added[name].detach()]).contiguous()))
