"""The rasteriser on a GPU, through gsplat (>= 1.5): N channels and depth in one call.

gsplat's semantics are ours but for two constants: its alpha is clamped at 0.999 instead of 0.99, and a splat ends at
3.33 sigma at the latest; pictures differ by a few thousandths where splats are nearly opaque.
"""

from __future__ import annotations

import numpy as np
import torch
from gsplat import rasterization
from torch import Tensor

from genmojo_core.clip.cameras import View
from genmojo_core.render.rasterizer import Rendering, Splats


def splat(
    splats: Splats[Tensor], view: View, *, detached_channels: int = 0, pose: Tensor | None = None
) -> Rendering[Tensor]:
    """Draw splats on the CUDA device their tensors live on; arguments and results as `autograd.splat`.

    Detached channels take a second call whose geometry carries no gradient.
    """
    device = splats.means.device
    matrix = torch.from_numpy(np.asarray(view.world_to_camera, dtype=np.float32)) if pose is None else pose.float()
    matrix = matrix.to(device)
    attached = splats.features.shape[1] - detached_channels
    channels = splats.features[:, :attached].float()
    if attached == 0:
        channels = torch.zeros(len(splats.means), 1, device=device)
    picture, alpha = _draw(splats, channels, view, matrix, "RGB+D")
    features, depth = picture[..., :attached], picture[..., -1]
    if detached_channels:
        fixed = [part.detach() for part in (splats.means, splats.quats, splats.scales, splats.opacities)]
        still = Splats(fixed[0], fixed[1], fixed[2], fixed[3], splats.features)
        behind, _ = _draw(still, splats.features[:, attached:].float(), view, matrix.detach(), "RGB")
        features = torch.cat([features, behind], dim=-1)
    return Rendering(features, depth, alpha)


def _draw(splats: Splats[Tensor], channels: Tensor, view: View, matrix: Tensor, mode: str) -> tuple[Tensor, Tensor]:
    """One gsplat call: (H, W, C) channels, depth last in mode "RGB+D", and (H, W) alpha."""
    if len(splats.means) == 0:  # gsplat launches no kernel for nothing; zeros keep the graph
        empty = channels.sum() + splats.means.sum()
        size = (view.height, view.width, channels.shape[1] + (mode == "RGB+D"))
        return torch.zeros(size, device=matrix.device) + empty, torch.zeros(size[:2], device=matrix.device) + empty
    intrinsics = torch.from_numpy(view.K.astype(np.float32)).to(matrix.device)
    picture, alpha, _ = rasterization(
        means=splats.means.float(),
        quats=splats.quats.float(),
        scales=splats.scales.float(),
        opacities=splats.opacities.float(),
        colors=channels,
        viewmats=matrix[None],
        Ks=intrinsics[None],
        width=view.width,
        height=view.height,
        near_plane=view.near,
        far_plane=view.far,
        eps2d=view.dilation,
        packed=False,
        render_mode=mode,
    )
    return picture[0], alpha[0, ..., 0]
