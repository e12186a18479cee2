"""The CPU rasteriser as a differentiable torch function."""

from __future__ import annotations

from typing import Any

import numpy as np
import torch
from torch import Tensor

from genmojo_core.clip.cameras import View
from genmojo_core.render.cpu.rasterize import Drawn, backward, draw
from genmojo_core.render.rasterizer import Rendering, Splats


def splat(
    splats: Splats[Tensor], view: View, *, detached_channels: int = 0, pose: Tensor | None = None
) -> Rendering[Tensor]:
    """Draw splats on the CPU; semantics in render/rasterizer.py.

    Args:
        splats: float32 tensors on the CPU (other floating dtypes are converted), world space.
        view: the camera, raster pixels.
        detached_channels: the last so many feature channels give gradient to the features only, never to alpha or
            geometry (flow: moving a splat must not pay for a wrong flow).
        pose: (4, 4) world to camera in place of the view's; gets a gradient where it asks for one (that of its 12
            upper numbers, each on its own: a pose must be built from a rotation to stay one).

    Returns:
        float32: features (H, W, C), depth (H, W), alpha (H, W). Gradients reach means, quats, scales, opacities and
        features; splats that are not drawn get exactly 0.

    Raises:
        GenmojoError("schema" | "budget" | "argument") as render/cpu/rasterize.py.
    """
    parts = (splats.means, splats.quats, splats.scales, splats.opacities, splats.features)
    features, depth, alpha = _Splat.apply(view, detached_channels, pose, *(p.float() for p in parts))
    return Rendering(features, depth, alpha)


class _Splat(torch.autograd.Function):
    """Glue: tensors to arrays and back; everything is in render/cpu."""

    @staticmethod
    def forward(ctx: Any, view: View, detached: int, pose: Tensor | None, *parts: Tensor) -> tuple[Tensor, ...]:
        """Draw and keep the picture's state for backward."""
        arrays = Splats(*(p.detach().numpy() for p in parts))
        matrix = None if pose is None else pose.detach().double().numpy()
        drawn = draw(arrays, view, detached_channels=detached, pose=matrix)
        ctx.drawn = drawn if any(ctx.needs_input_grad) else None
        ctx.set_materialize_grads(False)
        ctx.pose_dtype = None if pose is None else pose.dtype
        picture = drawn.rendering()
        return tuple(torch.from_numpy(a) for a in (picture.features, picture.depth, picture.alpha))

    @staticmethod
    @torch.autograd.function.once_differentiable
    def backward(ctx: Any, *upstream: Tensor | None) -> tuple[Any, ...]:
        """Gradients for (view, detached, pose, means, quats, scales, opacities, features)."""
        drawn: Drawn = ctx.drawn
        height, width = drawn.lens.height, drawn.lens.width
        shapes = ((height, width, drawn.features), (height, width), (height, width))
        arrays = [
            np.zeros(shape, np.float32) if gradient is None else gradient.detach().numpy()
            for gradient, shape in zip(upstream, shapes, strict=True)
        ]
        wanted = ctx.needs_input_grad[2]
        gradients, pose = backward(drawn, Rendering(*arrays), with_pose=wanted)
        pose_gradient = torch.from_numpy(pose).to(ctx.pose_dtype) if wanted else None
        parts = (gradients.means, gradients.quats, gradients.scales, gradients.opacities, gradients.features)
        return None, None, pose_gradient, *(torch.from_numpy(p) for p in parts)
