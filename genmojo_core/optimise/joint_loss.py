"""The data terms of one frame: by the fused kernels on the CPU in float32, else term by term in plain torch."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import torch
from torch import Tensor

from genmojo_core.kernels.probe import kernels_work
from genmojo_core.optimise import losses
from genmojo_core.optimise.targets import FrameTargets
from genmojo_core.render.rasterizer import Rendering
from genmojo_core.scene.scene4d import Layout

NAMES = ("rgb", "alpha", "labels", "spill", "depth", "flow")  # in the kernels' order


@dataclass(frozen=True)
class Wanted:
    """Terms besides colour and coverage; without background Gaussians colour counts inside the masks only."""

    background: bool
    labels: bool
    depth: bool


def data_terms(rendering: Rendering, layout: Layout, target: FrameTargets, wanted: Wanted) -> dict[str, Tensor]:
    """Colour, coverage, spill, and what else is wanted, each a differentiable scalar; flow where the layout has it."""
    features = rendering.features
    if not (features.device.type == "cpu" and features.dtype == torch.float32 and kernels_work()):
        return data_terms_torch(rendering, layout, target, wanted)
    values = _JointTerms.apply(features, rendering.depth, rendering.alpha, layout, target, wanted)
    on = {"labels": wanted.labels, "depth": wanted.depth, "flow": layout.flow}
    return {name: value for name, value in zip(NAMES, values.unbind(), strict=True) if on.get(name, True)}


def data_terms_torch(rendering: Rendering, layout: Layout, target: FrameTargets, wanted: Wanted) -> dict[str, Tensor]:
    """The same in plain torch, any device and dtype."""
    inside = (target.labels > 0).to(rendering.features.dtype)
    terms = {
        "rgb": losses.color_loss(rendering, target, inside, wanted.background),
        "alpha": losses.coverage_loss(rendering, layout, target, inside),
        "spill": losses.spill_loss(rendering, layout, target),
    }
    if wanted.labels:
        terms["labels"] = losses.label_loss(rendering, layout, target)
    if wanted.depth:
        terms["depth"] = losses.depth_loss(rendering, layout, target)
    if layout.flow:
        terms["flow"] = losses.flow_loss(rendering, layout, target)
    return terms


def _packed(target: FrameTargets, layout: Layout, wanted: Wanted) -> tuple[Any, Any]:
    """The kernels' `Target` and `Terms`; made once per frame."""
    from genmojo_core.render.cpu.joint_loss import Target, Terms, padded

    key = (layout, wanted)
    if key in target.kept:
        return target.kept[key]
    height, width = target.labels.shape
    wide = -(-width // 8) * 8
    inside = (target.labels > 0).float()
    seen_in, seen_out = inside * target.seen, (1.0 - inside) * target.seen
    weight_in = seen_in / seen_in.sum().clamp(min=1.0)
    weight_out = seen_out / (seen_out.sum() + target.beyond).clamp(min=1.0)
    weight = weight_in + weight_out
    color = weight if wanted.background else weight_in
    planes = torch.cat([target.rgb.permute(2, 0, 1), torch.stack([
        target.labels.clamp(max=layout.labels).float(), color, weight, losses.beside(target)])])  # fmt: skip
    lists = target.depth_pixels if wanted.depth else []
    pixels = torch.cat([*lists, torch.zeros(0, dtype=torch.int64)])
    flowing = target.flow_pixels if layout.flow else torch.zeros(0, dtype=torch.int64)

    def places(pixels: Tensor) -> np.ndarray:
        return (pixels // width * wide + pixels % width).numpy()

    packed = Target(
        padded(planes.numpy(), wide).copy(), places(pixels), np.cumsum([0, *(len(one) for one in lists)]),
        target.depth.reshape(-1)[pixels].numpy(), places(flowing), target.flow.reshape(-1, 2)[flowing].numpy(),
    )  # fmt: skip
    unit = 0.01 * target.diagonal
    terms = Terms(height, wide, layout.labels, wanted.labels, layout.flow, target.depth_scaled, unit)
    target.kept[key] = packed, terms
    return packed, terms


class _JointTerms(torch.autograd.Function):
    """Glue to the kernels: (6,) values in the order of NAMES, 0 for a term that there is not."""

    @staticmethod
    def forward(
        ctx: Any, features: Tensor, depth: Tensor, alpha: Tensor, layout: Layout, target: FrameTargets, wanted: Wanted
    ) -> Tensor:
        """The terms; keeps the picture for backward."""
        from genmojo_core.render.cpu.joint_loss import Picture, joint_terms, padded

        packed, terms = _packed(target, layout, wanted)
        planes = features.detach().permute(2, 0, 1).numpy(), depth.detach()[None].numpy(), alpha.detach()[None].numpy()
        picture = Picture(*(padded(one, terms.wide) for one in planes))
        values, flowing = joint_terms(picture, packed, terms)
        ctx.kept = picture, packed, terms, flowing, features.shape[1]
        return torch.from_numpy(values).float()

    @staticmethod
    @torch.autograd.function.once_differentiable
    def backward(ctx: Any, *upstream: Tensor) -> tuple[Any, ...]:
        """Gradients of features, depth and alpha."""
        from genmojo_core.render.cpu.joint_loss import joint_slopes

        picture, packed, terms, flowing, width = ctx.kept
        slopes = joint_slopes(picture, packed, terms, upstream[0].double().numpy(), flowing)
        planes = (torch.from_numpy(one.reshape(-1, terms.height, terms.wide))[:, :, :width] for one in slopes)
        features, depth, alpha = planes
        return features.permute(1, 2, 0), depth[0], alpha[0], None, None, None
