"""Structural similarity of pictures, differentiable in the prediction."""

from __future__ import annotations

from typing import Any

import torch
from torch import Tensor
from torch.nn.functional import conv2d, max_pool2d

from genmojo_core.kernels.probe import kernels_work

RADIUS = 5  # pixels: the window is 11 x 11
SIGMA = 1.5  # pixels
C1, C2 = 0.01**2, 0.03**2


def ssim_map(prediction: Tensor, target: Tensor, mask: Tensor | None = None) -> Tensor:
    """SSIM at every pixel: Gaussian window 11 x 11, sigma 1.5, pictures continued by reflection.

    The reflection mirrors about the first and last pixel without repeating them, as often as a small picture needs, so
    any size from 1 x 1 works.

    Args:
        prediction, target: (B, H, W, C) in 0..1; the target gets no gradient.
        mask: (B, H, W), true where a pixel counts. A window that touches a pixel that does not count says nothing: the
            map is 1 there and gives no gradient. `whole_windows(mask)` tells where that is.

    Returns:
        (B, H, W, C), 1 where equal. On the CPU in float32 by fused kernels, else by convolutions of the same meaning.
    """
    target = target.detach()
    if prediction.device.type == "cpu" and prediction.dtype == torch.float32 and kernels_work():
        similar = _Similarity.apply(prediction, target.float())
    else:
        similar = ssim_map_torch(prediction, target)
    if mask is None:
        return similar
    return torch.where(whole_windows(mask)[..., None], similar, torch.ones_like(similar))


def whole_windows(mask: Tensor) -> Tensor:
    """(B, H, W) truth: every pixel of the 11 x 11 window around it counts (beyond the border, reflected pixels do)."""
    missing = (~mask.bool()).float()[:, None]
    return max_pool2d(missing, 2 * RADIUS + 1, stride=1, padding=RADIUS)[:, 0] == 0


def ssim_map_torch(prediction: Tensor, target: Tensor) -> Tensor:
    """`ssim_map` without mask in plain torch, any device and dtype."""
    x, y = prediction.permute(0, 3, 1, 2), target.permute(0, 3, 1, 2)
    mean_x, mean_y = _average(x), _average(y)
    xx, yy, xy = _average(x * x) - mean_x**2, _average(y * y) - mean_y**2, _average(x * y) - mean_x * mean_y
    similar = (2 * mean_x * mean_y + C1) * (2 * xy + C2) / ((mean_x**2 + mean_y**2 + C1) * (xx + yy + C2))
    return similar.permute(0, 2, 3, 1)


def _average(pictures: Tensor) -> Tensor:
    """Gaussian window averages of (B, C, H, W), rows then columns, by convolution of the reflected picture."""
    offsets = torch.arange(-RADIUS, RADIUS + 1, dtype=torch.float64)
    window = torch.exp(-0.5 * (offsets / SIGMA) ** 2)
    window = (window / window.sum()).to(pictures)
    batch, channels, height, width = pictures.shape
    wide = pictures[:, :, _reflected(height)][..., _reflected(width)].reshape(batch * channels, 1, height + 10, -1)
    rows = conv2d(wide, window.view(1, 1, 1, -1))
    return conv2d(rows, window.view(1, 1, -1, 1)).view(batch, channels, height, width)


def _reflected(size: int) -> Tensor:
    """Indices (size + 10,) of a line continued by reflection on both sides."""
    if size == 1:
        return torch.zeros(1 + 2 * RADIUS, dtype=torch.long)
    period = 2 * (size - 1)
    i = torch.arange(-RADIUS, size + RADIUS).abs() % period
    return torch.minimum(i, period - i)


class _Similarity(torch.autograd.Function):
    """`ssim_map` through the kernels."""

    @staticmethod
    def forward(ctx: Any, prediction: Tensor, target: Tensor) -> Tensor:
        """The map; keeps its derivatives with respect to the window averages."""
        from genmojo_core.render.cpu.ssim import ssim_forward

        x, y = prediction.detach().contiguous(), target.contiguous()
        similar, slopes = ssim_forward(x.numpy(), y.numpy())
        ctx.slopes = slopes
        ctx.save_for_backward(x, y)
        return torch.from_numpy(similar)

    @staticmethod
    @torch.autograd.function.once_differentiable
    def backward(ctx: Any, upstream: Tensor) -> tuple[Any, ...]:
        """Gradient of the prediction."""
        from genmojo_core.render.cpu.ssim import ssim_backward

        x, y = ctx.saved_tensors
        gradient = ssim_backward(x.numpy(), y.numpy(), ctx.slopes, upstream.contiguous().numpy())
        return torch.from_numpy(gradient), None
