"""The rasteriser in plain torch: one tile of 16 x 16 pixels after the other, no loop over splats.

Used, with a warning, where the compiled kernels do not work, on any device; and the opponent of
tests/benchmarks/rasterizer.py. Per tile: a boolean select of the splats whose box touches it, one cumulative product
along depth, one matrix product with the channels.
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

TILE = 16  # pixels


def splat(
    splats: Splats[Tensor], view: View, *, detached_channels: int = 0, pose: Tensor | None = None
) -> Rendering[Tensor]:
    """Draw splats in the dtype and on the device of their means; arguments and results as `autograd.splat`."""
    centres, conics, boxes, z, index = _project(splats, view, pose)
    channels = torch.cat([z[:, None], splats.features[index]], dim=1)
    attached = channels.shape[1] - detached_channels
    opacities = splats.opacities[index]
    rows = []
    for top in range(0, view.height, TILE):
        row = []
        for left in range(0, view.width, TILE):
            size = (min(TILE, view.height - top), min(TILE, view.width - left))
            touches = (boxes[:, 0] < left + size[1]) & (boxes[:, 1] > left)
            touches &= (boxes[:, 2] < top + size[0]) & (boxes[:, 3] > top)
            inputs = centres[touches], conics[touches], opacities[touches]
            weights = _weights(*inputs, (left, top), size)
            c = channels[touches]
            parts = [weights @ c[:, :attached], weights.detach() @ c[:, attached:], weights.sum(dim=1, keepdim=True)]
            row.append(torch.cat(parts, dim=1).view(*size, -1))
        rows.append(torch.cat(row, dim=1))
    picture = torch.cat(rows, dim=0)
    return Rendering(picture[..., 1:-1], picture[..., 0], picture[..., -1])


def _weights(
    centres: Tensor, conics: Tensor, opacities: Tensor, corner: tuple[int, int], size: tuple[int, int]
) -> Tensor:
    """Blending weights (pixels, M) of M splats, front to back, on one tile of size (rows, columns)."""
    columns = torch.arange(size[1], device=centres.device) + (corner[0] + 0.5)
    rows = torch.arange(size[0], device=centres.device) + (corner[1] + 0.5)
    y, x = torch.meshgrid(rows, columns, indexing="ij")
    dx = x.reshape(-1, 1) - centres[:, 0]
    dy = y.reshape(-1, 1) - centres[:, 1]
    exponent = -0.5 * (conics[:, 0] * dx * dx + 2 * conics[:, 1] * dx * dy + conics[:, 2] * dy * dy)
    alpha = (opacities * torch.exp(exponent)).clamp(max=ALPHA_MAX)
    alpha = torch.where(alpha >= ALPHA_MIN, alpha, torch.zeros_like(alpha))
    after = torch.cumprod(1 - alpha, dim=1)
    before = torch.cat([torch.ones_like(after[:, :1]), after[:, :-1]], dim=1)[:, : alpha.shape[1]]
    return torch.where(after > TRANSMITTANCE_MIN, alpha * before, torch.zeros_like(alpha))


def _project(splats: Splats[Tensor], view: View, pose: Tensor | None) -> tuple[Tensor, Tensor, Tensor, Tensor, Tensor]:
    """Drawn splats by depth: centres (M, 2), conics (M, 3), boxes (M, 4) left, right, top, bottom, z (M,), index."""
    matrix = torch.as_tensor(view.world_to_camera) if pose is None else pose
    matrix = matrix.to(splats.means)
    parts = [splats.means, splats.quats, splats.scales, splats.opacities[:, None]]
    points = splats.means @ matrix[:3, :3].T + matrix[:3, 3]
    good = torch.isfinite(torch.cat(parts, dim=1)).all(dim=1) & (points[:, 2] >= view.near)
    good &= (points[:, 2] <= view.far) & (splats.opacities >= ALPHA_MIN) & (splats.quats.norm(dim=1) > 1e-12)
    index = torch.nonzero(good).flatten()
    index = index[torch.argsort(points[index, 2].detach(), stable=True)]
    points = points[index]
    sigma = _covariance(points, splats.quats[index], splats.scales[index], view, matrix[:3, :3])
    xx, xy, yy = sigma[:, 0, 0], sigma[:, 0, 1], sigma[:, 1, 1]
    conics = torch.stack([yy, -xy, xx], dim=1) / (xx * yy - xy * xy)[:, None]
    x = view.fx * points[:, 0] / points[:, 2] + view.cx
    y = view.fy * points[:, 1] / points[:, 2] + view.cy
    reach = 2 * torch.log(splats.opacities[index].detach() / ALPHA_MIN)
    hx, hy = (reach * xx.detach()).sqrt(), (reach * yy.detach()).sqrt()
    boxes = torch.stack([x.detach() - hx, x.detach() + hx, y.detach() - hy, y.detach() + hy], dim=1)
    return torch.stack([x, y], dim=1), conics, boxes, points[:, 2], index


def _covariance(points: Tensor, quats: Tensor, scales: Tensor, view: View, rotation: Tensor) -> Tensor:
    """(M, 2, 2) dilated covariances in pixels squared."""
    x, y, z = points.unbind(dim=1)
    margin = (FRUSTUM_CLAMP - 1) / 2
    u = (x / z).clamp(-(view.cx + margin * view.width) / view.fx,
                      (view.width - view.cx + margin * view.width) / view.fx)  # fmt: skip
    v = (y / z).clamp(-(view.cy + margin * view.height) / view.fy,
                      (view.height - view.cy + margin * view.height) / view.fy)  # fmt: skip
    zero = torch.zeros_like(z)
    first = torch.stack([view.fx / z, zero, -view.fx * u / z], dim=1)
    second = torch.stack([zero, view.fy / z, -view.fy * v / z], dim=1)
    w, i, j, k = (quats / quats.norm(dim=1, keepdim=True)).unbind(dim=1)
    turned = [
        torch.stack([1 - 2 * (j * j + k * k), 2 * (i * j - w * k), 2 * (i * k + w * j)], dim=1),
        torch.stack([2 * (i * j + w * k), 1 - 2 * (i * i + k * k), 2 * (j * k - w * i)], dim=1),
        torch.stack([2 * (i * k - w * j), 2 * (j * k + w * i), 1 - 2 * (i * i + j * j)], dim=1),
    ]
    half = torch.stack([first, second], dim=1) @ rotation @ torch.stack(turned, dim=1) * scales[:, None, :]
    return half @ half.transpose(1, 2) + view.dilation * torch.eye(2, dtype=points.dtype, device=points.device)
