"""The oracle: every splat against every pixel in float64, differentiated by autograd.

The same semantics as render/rasterizer.py, written as directly as possible and with none of the kernels' algebra.
Memory is N x H x W: for tests only.
"""

from __future__ import annotations

import torch
from torch import Tensor

from genmojo_core.clip.cameras import View
from genmojo_core.render.rasterizer import (
    ALPHA_MAX,
    ALPHA_MIN,
    FRUSTUM_CLAMP,
    TRANSMITTANCE_MIN,
    Rendering,
    Splats,
)  # fmt: skip


def splat(
    splats: Splats[Tensor], view: View, *, detached_channels: int = 0, pose: Tensor | None = None
) -> Rendering[Tensor]:
    """Draw splats in float64; arguments and results as render/autograd.py, gradients by autograd."""
    alpha, depth = pixel_alphas(splats, view, pose)
    order = torch.argsort(depth.detach(), stable=True)
    drawn = order[(alpha.detach() > 0).flatten(1).any(dim=1)[order]]
    alpha, depth = alpha[drawn], depth[drawn]
    weights = _weights(alpha)
    features = splats.features.double()[drawn]
    attached = features.shape[1] - detached_channels
    picture = torch.cat(
        [
            torch.einsum("nhw,nc->hwc", weights, features[:, :attached]),
            torch.einsum("nhw,nc->hwc", weights.detach(), features[:, attached:]),
        ],
        dim=2,
    )
    return Rendering(picture, torch.einsum("nhw,n->hw", weights, depth), weights.sum(dim=0))


def pixel_alphas(splats: Splats[Tensor], view: View, pose: Tensor | None = None) -> tuple[Tensor, Tensor]:
    """Alpha of every splat at every pixel after clamp and cut (N, H, W), and camera depths (N,); float64.

    Splats that are not drawn (behind near, beyond far, opacity under the cut, no quaternion, not finite) have alpha 0
    everywhere and no gradient.
    """
    world_to_camera = torch.as_tensor(view.world_to_camera).double() if pose is None else pose.double()
    means, quats, scales = splats.means.double(), splats.quats.double(), splats.scales.double()
    opacities = splats.opacities.double()
    points = means @ world_to_camera[:3, :3].T + world_to_camera[:3, 3]
    finite = torch.isfinite(torch.cat([means, quats, scales, opacities[:, None]], dim=1)).all(dim=1)
    good = finite & (points[:, 2] >= view.near) & (points[:, 2] <= view.far)
    good &= (opacities >= ALPHA_MIN) & (quats.norm(dim=1) > 1e-12)
    index = torch.nonzero(good).flatten()
    x, y, z = points[index].unbind(dim=1)
    sigma = _covariance(points[index], quats[index], scales[index], view, world_to_camera[:3, :3])
    conic = torch.linalg.inv(sigma)
    columns = torch.arange(view.width, dtype=torch.float64) + 0.5
    rows = torch.arange(view.height, dtype=torch.float64) + 0.5
    dx = columns[None, None, :] - (view.fx * x / z + view.cx)[:, None, None]
    dy = rows[None, :, None] - (view.fy * y / z + view.cy)[:, None, None]
    a, b, c = conic[:, 0, 0, None, None], conic[:, 0, 1, None, None], conic[:, 1, 1, None, None]
    exponent = -0.5 * (a * dx * dx + 2 * b * dx * dy + c * dy * dy)
    alpha = (opacities[index, None, None] * torch.exp(exponent)).clamp(max=ALPHA_MAX)
    alpha = torch.where(alpha >= ALPHA_MIN, alpha, torch.zeros_like(alpha))
    out = torch.zeros(len(means), view.height, view.width, dtype=torch.float64)
    return out.index_put((index,), alpha), points[:, 2]


def _covariance(points: Tensor, quats: Tensor, scales: Tensor, view: View, rotation: Tensor) -> Tensor:
    """(M, 2, 2) dilated covariances in pixels squared."""
    x, y, z = points.unbind(dim=1)
    margin_x, margin_y = ((FRUSTUM_CLAMP - 1) / 2 * s for s in (view.width, view.height))
    u = (x / z).clamp(-(view.cx + margin_x) / view.fx, (view.width - view.cx + margin_x) / view.fx)
    v = (y / z).clamp(-(view.cy + margin_y) / view.fy, (view.height - view.cy + margin_y) / view.fy)
    zero = torch.zeros_like(z)
    jacobian = torch.stack(
        [
            torch.stack([view.fx / z, zero, -view.fx * u / z], dim=1),
            torch.stack([zero, view.fy / z, -view.fy * v / z], dim=1),
        ],
        dim=1,
    )
    half = jacobian @ rotation @ _matrices(quats) @ torch.diag_embed(scales)
    return half @ half.transpose(1, 2) + view.dilation * torch.eye(2, dtype=torch.float64)


def _matrices(quats: Tensor) -> Tensor:
    """(M, 3, 3) rotations of quaternions (M, 4) wxyz, normalised here."""
    w, x, y, z = (quats / quats.norm(dim=1, keepdim=True)).unbind(dim=1)
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return torch.stack([torch.stack(row, dim=1) for row in rows], dim=1)


def _weights(alpha: Tensor) -> Tensor:
    """Blending weights w = alpha T (N, H, W) of alphas sorted front to back, with the early stop."""
    transmittance = torch.cumprod(1 - alpha, dim=0)
    before = torch.cat([torch.ones_like(alpha[:1]), transmittance[:-1]], dim=0)
    # Transmittance only falls: once a splat would take it to the limit, it and all behind it are left out.
    return torch.where(transmittance > TRANSMITTANCE_MIN, alpha * before, torch.zeros_like(alpha))
