"""Data terms of the joint splat: occlusion-aware colour, coverage, instance, depth, flow and track losses.

METHOD.md section 5, in units where the colour term's weight is 1. Every loss is a finite scalar with gradient, zero
where nothing is to be compared. All pixels that are void or held out are left out of every term.
"""

from __future__ import annotations

import torch
from torch import Tensor

from genmojo_core.optimise.targets import FrameTargets
from genmojo_core.render.rasterizer import Rendering
from genmojo_core.scene import safemath
from genmojo_core.scene.scene4d import Layout

HALF = 0.5


def masked_mean(values: Tensor, weight: Tensor) -> Tensor:
    """Weighted mean; 0 (differentiable) when no weight is left."""
    return (values * weight).sum() / weight.sum().clamp(min=1.0)


def balanced(error: Tensor, inside: Tensor, seen: Tensor) -> Tensor:  # (H, W) each
    """Mean error inside plus mean error outside a mask, each over its own seen pixels (METHOD.md section 2, Lbal)."""
    return masked_mean(error, inside * seen) + masked_mean(error, (1.0 - inside) * seen)


def color_loss(rendering: Rendering, target: FrameTargets, inside: Tensor, has_background: bool) -> Tensor:
    """L1 plus squared error of colour, balanced; without background Gaussians only inside the objects' masks."""
    difference = rendering.features[..., :3] - target.rgb
    error = 0.5 * difference.abs().mean(-1) + 5.0 * (difference * difference).mean(-1)
    if has_background:
        return balanced(error, inside, target.seen)
    return masked_mean(error, inside * target.seen)


def coverage_loss(rendering: Rendering, layout: Layout, target: FrameTargets, inside: Tensor) -> Tensor:
    """Squared error of the objects' joint coverage (their labels' sum) against the union of masks, balanced."""
    coverage = rendering.features[..., 3 : 3 + layout.labels].sum(-1)
    return balanced((coverage - inside) ** 2, inside, target.seen)


def label_loss(rendering: Rendering, layout: Layout, target: FrameTargets) -> Tensor:
    """Negative log likelihood of each pixel's own label; background is the class left over (RELIABILITY.md N14)."""
    labels = rendering.features[..., 3 : 3 + layout.labels]
    background = (1.0 - labels.sum(-1, keepdim=True)).clamp(min=0.0)
    probabilities = torch.cat([background, labels], dim=-1)
    own = probabilities.gather(-1, target.labels.clamp(max=layout.labels)[..., None])[..., 0]
    foreground = (target.labels > 0).float()
    return balanced(-safemath.safe_log(own, 1e-2), foreground, target.seen)


def depth_loss(rendering: Rendering, layout: Layout, target: FrameTargets) -> Tensor:
    """Depth inside the objects: relative error where depth was measured, 1 - Pearson per object where it is a guess."""
    depth = safemath.safe_divide(rendering.depth, rendering.alpha, 1e-4)
    labels = rendering.features[..., 3 : 3 + layout.labels].detach()
    total = rendering.depth.sum() * 0.0
    for k in range(layout.labels):
        own = (target.labels == k + 1) if layout.labels > 1 else (target.labels > 0)
        weight = target.depth_seen * own * (labels[..., k] > HALF)
        if float(weight.sum()) < 16:
            continue
        if target.depth_scaled:
            total = total + masked_mean(((depth - target.depth) / target.depth.clamp(min=1e-6)).abs(), weight)
        else:
            total = total + 0.1 * (1.0 - pearson(depth, target.depth, weight))
    return total / layout.labels


def pearson(a: Tensor, b: Tensor, weight: Tensor) -> Tensor:
    """Weighted correlation of two images; 0 where either is constant."""
    a0, b0 = a - masked_mean(a, weight), b - masked_mean(b, weight)
    covariance = masked_mean(a0 * b0, weight)
    spread = safemath.safe_sqrt(masked_mean(a0 * a0, weight) * masked_mean(b0 * b0, weight), 1e-16)
    return safemath.safe_divide(covariance, spread, 1e-7)


def flow_loss(rendering: Rendering, layout: Layout, target: FrameTargets) -> Tensor:
    """L1 of splatted centre motion against the flow inside the masks, per object coverage, in 1 % of the diagonal."""
    start = 3 + layout.labels
    coverage = rendering.features[..., 3:start].sum(-1).detach()
    weight = target.flow_seen * (target.labels > 0) * (coverage > HALF)
    expected = target.flow * coverage[..., None]
    height, width = target.labels.shape
    unit = 0.01 * (height * height + width * width) ** 0.5
    error = (rendering.features[..., start : start + 2] - expected).abs().sum(-1) / unit
    return masked_mean(error.clamp(max=10.0), weight)


def track_loss(pixels: Tensor, expected: Tensor, confidence: Tensor, diagonal: float) -> Tensor:
    """Huber distance of carried points to their tracks, (P, 2) px each, in 1 % of the image diagonal."""
    distance = safemath.safe_norm(pixels - expected) / (0.01 * diagonal)
    robust = torch.where(distance < 1.0, 0.5 * distance * distance, distance - 0.5)
    return masked_mean(robust, confidence)


def order_loss(
    pixels: Tensor, depths: Tensor, owner: Tensor, rendering: Rendering, target: FrameTargets, layout: Layout
) -> Tensor:
    """Hinge: a Gaussian that falls on another object's visible pixels must lie behind that object's rendered depth.

    Args:
        pixels: (N, 2) raster centres. depths: (N,). owner: (N,) int64 label channel of each Gaussian.
    """
    height, width = target.labels.shape
    x, y = pixels[:, 0].detach(), pixels[:, 1].detach()
    inside = (x >= 0) & (x < width) & (y >= 0) & (y < height) & (depths.detach() > 0)
    column = x.clamp(0, width - 1).long()
    row = y.clamp(0, height - 1).long()
    label = target.labels[row, column]
    other = inside & (label > 0) & (label != owner + 1)
    if not bool(other.any()):
        return depths.sum() * 0.0
    shown = rendering.features[..., 3 : 3 + layout.labels].detach()
    right = shown[row, column].gather(1, (label - 1).clamp(min=0)[:, None])[:, 0] > HALF
    surface = safemath.safe_divide(rendering.depth, rendering.alpha, 1e-4).detach()[row, column]
    in_front = torch.relu(1.01 * surface - depths) / surface.clamp(min=1e-6)
    return masked_mean(in_front, (other & right).float())
