"""The CPU rasteriser as a differentiable torch function."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import torch
from torch import Tensor

from genmojo_core.clip.cameras import View
from genmojo_core.kernels.threads import run_whole
from genmojo_core.render.cpu.rasterize import Drawn, backward, draw
from genmojo_core.render.rasterizer import Rendering, Splats

INPUTS, PLANES = 6, 3  # tensors of one picture: the pose and five of its splats; features, depth, alpha


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
    return splat_frames([splats], [view], detached_channels=detached_channels, poses=[pose])[0]


def splat_frames(
    splats: Sequence[Splats[Tensor]],
    views: Sequence[View],
    *,
    detached_channels: int = 0,
    poses: Sequence[Tensor | None] | None = None,
) -> list[Rendering[Tensor]]:
    """Draw several pictures at once, a picture per thread, as `splat` draws each; so is their backward pass.

    The bits are those of pictures drawn one by one. Gradients of all pictures are found together, once all of those
    that the loss looks at have theirs.
    """
    inputs: list[Tensor | None] = []
    for one, pose in zip(splats, poses or [None] * len(views), strict=True):
        parts = (one.means, one.quats, one.scales, one.opacities, one.features)
        inputs += [pose, *(p.float() for p in parts)]
    planes = _Splat.apply(tuple(views), detached_channels, *inputs)
    return [Rendering(*planes[k : k + PLANES]) for k in range(0, len(planes), PLANES)]


class _Splat(torch.autograd.Function):
    """Glue: tensors to arrays and back; everything is in render/cpu."""

    @staticmethod
    def forward(ctx: Any, views: tuple[View, ...], detached: int, *inputs: Tensor | None) -> tuple[Tensor, ...]:
        """Draw and keep the pictures' state for backward. inputs: the pose, then the parts, of each."""
        drawn: list[Any] = [None] * len(views)

        def job(k: int) -> None:
            pose, *parts = inputs[k * INPUTS : (k + 1) * INPUTS]
            arrays = Splats(*(p.detach().numpy() for p in parts if p is not None))
            matrix = None if pose is None else pose.detach().double().numpy()
            drawn[k] = draw(arrays, views[k], detached_channels=detached, pose=matrix)

        run_whole(job, len(views))
        ctx.drawn = drawn if any(ctx.needs_input_grad) else None
        ctx.set_materialize_grads(False)
        ctx.pose_types = [None if pose is None else pose.dtype for pose in inputs[::INPUTS]]
        pictures = [one.rendering() for one in drawn]
        return tuple(torch.from_numpy(a) for p in pictures for a in (p.features, p.depth, p.alpha))

    @staticmethod
    @torch.autograd.function.once_differentiable
    def backward(ctx: Any, *upstream: Tensor | None) -> tuple[Any, ...]:
        """Gradients for (views, detached, then of each picture pose, means, quats, scales, opacities, features)."""
        found: list[tuple[Any, ...]] = [()] * len(ctx.drawn)

        def job(k: int) -> None:
            drawn: Drawn = ctx.drawn[k]
            height, width = drawn.lens.height, drawn.lens.width
            given = upstream[k * PLANES : (k + 1) * PLANES]
            if all(gradient is None for gradient in given):
                found[k] = (None,) * INPUTS
                return
            shapes = ((height, width, drawn.features), (height, width), (height, width))
            arrays = [
                np.zeros(shape, np.float32) if gradient is None else gradient.detach().numpy()
                for gradient, shape in zip(given, shapes, strict=True)
            ]
            wanted = ctx.needs_input_grad[2 + k * INPUTS]
            g, pose = backward(drawn, Rendering(*arrays), with_pose=wanted)
            parts = (g.means, g.quats, g.scales, g.opacities, g.features)
            turned = torch.from_numpy(pose).to(ctx.pose_types[k]) if wanted else None
            found[k] = (turned, *(torch.from_numpy(p) for p in parts))

        run_whole(job, len(found))
        return None, None, *(gradient for one in found for gradient in one)
