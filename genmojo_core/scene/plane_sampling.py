"""Reading K-planes at points and times, with gradients to the planes (METHOD.md section 4).

Planes are stored with the channels last. A coordinate in -1..1 runs from the first node to the last (align_corners);
outside, the border's value holds. Coordinates and times get no gradient: points are canonical. On the CPU, with a
multiple of eight float32 channels, fused kernels do the work (imported where they are used, so that a machine without
numba can run the rest); everything else takes plain torch of the same meaning.
"""

from __future__ import annotations

from typing import Any

import torch
from torch import Tensor

from genmojo_core.kernels.probe import kernels_work

PAIRS = ((0, 1), (0, 2), (1, 2))  # coordinates along columns and rows of each space plane


def sample_planes(planes: Tensor, coords: Tensor) -> Tensor:
    """Product over the three space planes.

    Args:
        planes: (3, R, R, C): (x, y), (x, z), (y, z); the first coordinate runs along columns (axis 2), the second
            along rows (axis 1).
        coords: (N, 3) in -1..1.

    Returns:
        (N, C), differentiable in planes.
    """
    coords = coords.detach()
    if _has_kernel(planes):
        return _Space.apply(planes, coords.float().contiguous())
    return sample_planes_torch(planes, coords)


def sample_time_planes(planes: Tensor, coords: Tensor, times: Tensor) -> Tensor:
    """Product over the three space-time planes.

    Args:
        planes: (3, R, T, C): x, y, z along axis 1, time along axis 2.
        coords: (N, 3) in -1..1.
        times: (B,) in -1..1.

    Returns:
        (B, N, C), differentiable in planes.
    """
    coords, times = coords.detach(), times.detach()
    if _has_kernel(planes):
        return _Time.apply(planes, coords.float().contiguous(), times.float())
    return sample_time_planes_torch(planes, coords, times)


def sample_planes_torch(planes: Tensor, coords: Tensor) -> Tensor:
    """`sample_planes` in plain torch, any device, dtype and number of channels."""
    product = torch.ones(())
    for plane, (across, down) in zip(planes, PAIRS, strict=True):
        c0, c1, fx = _cells(coords[:, across], plane.shape[1])
        r0, r1, fy = _cells(coords[:, down], plane.shape[0])
        upper = torch.lerp(plane[r0, c0], plane[r0, c1], fx)
        lower = torch.lerp(plane[r1, c0], plane[r1, c1], fx)
        product = torch.lerp(upper, lower, fy) * product.to(plane.device)
    return product


def sample_time_planes_torch(planes: Tensor, coords: Tensor, times: Tensor) -> Tensor:
    """`sample_time_planes` in plain torch."""
    t0, t1, share = _cells(times, planes.shape[2])
    lines = torch.lerp(planes[:, :, t0], planes[:, :, t1], share)  # (3, R, B, C)
    product = torch.ones(())
    for axis in range(3):
        r0, r1, f = _cells(coords[:, axis], planes.shape[1])
        value = torch.lerp(lines[axis, r0], lines[axis, r1], f[:, None])  # (N, B, C)
        product = value * product.to(planes.device)
    return product.transpose(0, 1)


def _has_kernel(planes: Tensor) -> bool:
    """The fused kernels take float32 on the CPU with a multiple of eight channels."""
    fits = planes.device.type == "cpu" and planes.dtype == torch.float32 and planes.shape[-1] % 8 == 0
    return fits and kernels_work()


def _cells(positions: Tensor, nodes: int) -> tuple[Tensor, Tensor, Tensor]:
    """The two nodes beside each coordinate in -1..1 (P,) int64, and the share of the second (P, 1)."""
    x = torch.nan_to_num((positions + 1) * 0.5 * (nodes - 1), nan=0.0).clamp(0, nodes - 1)
    first = x.floor().clamp(max=max(nodes - 2, 0)).long()
    return first, (first + 1).clamp(max=nodes - 1), (x - first)[:, None]


class _Space(torch.autograd.Function):
    """`sample_planes` through the kernels."""

    @staticmethod
    def forward(ctx: Any, planes: Tensor, coords: Tensor) -> Tensor:
        """Read; keeps the arrays for backward."""
        from genmojo_core.scene.planes_cpu.sampling import space_features

        arrays = planes.detach().contiguous().numpy(), coords.numpy()
        ctx.save_for_backward(planes, coords)
        return torch.from_numpy(space_features(*arrays))

    @staticmethod
    @torch.autograd.function.once_differentiable
    def backward(ctx: Any, upstream: Tensor) -> tuple[Any, ...]:
        """Gradient of the planes."""
        from genmojo_core.scene.planes_cpu.sampling import space_gradient

        planes, coords = ctx.saved_tensors
        arrays = planes.detach().contiguous().numpy(), coords.numpy(), upstream.contiguous().numpy()
        return torch.from_numpy(space_gradient(*arrays)), None


class _Time(torch.autograd.Function):
    """`sample_time_planes` through the kernels."""

    @staticmethod
    def forward(ctx: Any, planes: Tensor, coords: Tensor, times: Tensor) -> Tensor:
        """Read; keeps the planes collapsed to lines for backward."""
        from genmojo_core.scene.planes_cpu.sampling import time_features

        features, lines = time_features(planes.detach().contiguous().numpy(), coords.numpy(), times.numpy())
        ctx.lines, ctx.shape = lines, tuple(planes.shape)
        ctx.save_for_backward(coords, times)
        return torch.from_numpy(features)

    @staticmethod
    @torch.autograd.function.once_differentiable
    def backward(ctx: Any, upstream: Tensor) -> tuple[Any, ...]:
        """Gradient of the planes."""
        from genmojo_core.scene.planes_cpu.sampling import time_gradient

        coords, times = ctx.saved_tensors
        gradient = time_gradient(ctx.shape, ctx.lines, coords.numpy(), times.numpy(), upstream.contiguous().numpy())
        return torch.from_numpy(gradient), None, None
