"""Data terms of the joint splat: occlusion-aware colour, coverage, instance, depth, flow and track losses.

METHOD.md section 5, in units where the colour term's weight is 1. Here in plain torch, for any device and as the
meaning of the fused kernels that take their place on the CPU (joint_loss.py). Every loss is a finite scalar with
gradient, zero where nothing is to be compared. All pixels that are void or held out are left out of every term.
"""

from __future__ import annotations

import cv2
import numpy as np
import torch
from torch import Tensor
from torch.nn import functional

from genmojo_core.optimise.targets import FrameTargets
from genmojo_core.render.loss_limits import ALPHA_FLOOR, FEWEST, FLOW_LIMIT, GUESSED_DEPTH, LABEL_FLOOR, SHOWN
from genmojo_core.render.rasterizer import Rendering
from genmojo_core.render.ssim import ssim_map, whole_windows
from genmojo_core.scene import safemath
from genmojo_core.scene.scene4d import Layout

REACHED = 1e-3  # coverage by which an object has reached a pixel
HULL_MARGIN = 1.0  # pixels beyond a mask that are as good as on it
LEAST_MASKS = 0.01  # of the seen pixels: spill counts per pixel of the masks, but of no fewer


def masked_mean(values: Tensor, weight: Tensor, beyond: float = 0.0) -> Tensor:
    """Weighted mean; 0 (differentiable) when no weight is left. `beyond`: weight of zeros that count besides."""
    return (values * weight).sum() / (weight.sum() + beyond).clamp(min=1.0)


def balanced(error: Tensor, inside: Tensor, seen: Tensor, beyond: float = 0.0) -> Tensor:  # (H, W) each
    """Mean error inside plus mean error outside a mask, each over its own seen pixels (METHOD.md section 2, Lbal).

    beyond: pixels outside the mask that are not looked at because their error cannot change, and counts as none.
    """
    return masked_mean(error, inside * seen) + masked_mean(error, (1.0 - inside) * seen, beyond)


def color_loss(rendering: Rendering, target: FrameTargets, inside: Tensor, has_background: bool) -> Tensor:
    """L1 plus squared error of colour, balanced; without background Gaussians only inside the objects' masks."""
    difference = rendering.features[..., :3] - target.rgb
    error = 0.5 * difference.abs().mean(-1) + 5.0 * (difference * difference).mean(-1)
    if has_background:
        return balanced(error, inside, target.seen, target.beyond)
    return masked_mean(error, inside * target.seen)


def similarity(rendering: Rendering, target: FrameTargets) -> Tensor:  # (H, W)
    """SSIM of colour at every pixel, windows with pixels that do not count included."""
    return ssim_map(rendering.features[None, ..., :3], target.rgb[None])[0].mean(-1)


def similarity_loss(similar: Tensor, target: FrameTargets) -> Tensor:
    """1 - SSIM of `similarity`, balanced; a window counts where all its pixels are seen."""
    if "windows" not in target.kept:
        inside = (target.labels > 0).float()
        whole = whole_windows(target.seen[None] > 0)[0].float()
        own, rest = inside * whole, (1.0 - inside) * whole
        target.kept["windows"] = own / own.sum().clamp(min=1.0) + rest / (rest.sum() + target.beyond).clamp(min=1.0)
    weight = target.kept["windows"].to(similar)
    return weight.sum() - (weight * similar).sum()


def coverage_loss(rendering: Rendering, layout: Layout, target: FrameTargets, inside: Tensor) -> Tensor:
    """Squared error of the objects' joint coverage (their labels' sum) against the union of masks, balanced."""
    coverage = rendering.features[..., 3 : 3 + layout.labels].sum(-1)
    return balanced((coverage - inside) ** 2, inside, target.seen, target.beyond)


def spill_loss(rendering: Rendering, layout: Layout, target: FrameTargets) -> Tensor:
    """Coverage of the objects beside their masks, in areas of the masks, linear.

    Squared coverage forgives what is thin: objects painted the shadows that they cast on things behind them with
    veils of dark Gaussians, which hang in the air in every other view.
    """
    coverage = rendering.features[..., 3 : 3 + layout.labels].sum(-1)
    return (coverage * beside(target).to(coverage)).sum()


def beside(target: FrameTargets) -> Tensor:  # (H, W) float32
    """What coverage weighs at a pixel: nothing on a mask, nor one pixel around it, where outlines are soft."""
    if "beside" not in target.kept:
        seen = target.seen.sum()
        own = ((target.labels > 0) * target.seen).sum()
        around = cv2.dilate((target.labels > 0).numpy().astype(np.uint8), np.ones((3, 3), np.uint8))
        away = torch.from_numpy(around == 0) * target.seen
        target.kept["beside"] = (away / torch.maximum(own, LEAST_MASKS * seen).clamp(min=1.0)).float()
    return target.kept["beside"]


def gap_loss(alpha: Tensor, seen: Tensor) -> Tensor:  # (H, W) each
    """Mean squared transparency of what is seen of a picture, in which a background leaves no gap.

    Scenes are compared over black. Without this, dark lines are painted by letting it through, and whatever a scene is
    shown over later is seen there.
    """
    return masked_mean((1.0 - alpha) ** 2, seen)


def miss_loss(rendering: Rendering, layout: Layout, target: FrameTargets, centres: Tensor) -> Tensor:
    """Huber distance of an object's centre to its mask's, in 1 % of the diagonal, where it misses its mask altogether.

    A pixel that no splat reaches can pull at nothing (RELIABILITY.md N14): without this an object that starts beside
    its mask would stay there. Zero as soon as one pixel of the mask shows the object.

    Args:
        centres: (objects, 2) raster pixels.
    """
    missed, expected = [], []
    for k in range(layout.labels):
        mask = (target.labels == k + 1) & (target.seen > 0)
        if bool(mask.any()) and not bool((mask & (rendering.features[..., 3 + k].detach() > REACHED)).any()):
            rows, columns = torch.nonzero(mask, as_tuple=True)
            missed.append(k)
            expected.append(torch.stack([columns.float().mean(), rows.float().mean()]) + 0.5)
    if not missed:
        return centres.sum() * 0.0
    distance = safemath.safe_norm(centres[missed] - torch.stack(expected)) / (0.01 * target.diagonal)
    return torch.where(distance < 1.0, 0.5 * distance * distance, distance - 0.5).sum() / layout.labels


def label_loss(rendering: Rendering, layout: Layout, target: FrameTargets) -> Tensor:
    """Negative log likelihood of each pixel's own label; background is the class left over (RELIABILITY.md N14)."""
    labels = rendering.features[..., 3 : 3 + layout.labels]
    background = (1.0 - labels.sum(-1, keepdim=True)).clamp(min=0.0)
    probabilities = torch.cat([background, labels], dim=-1)
    own = probabilities.gather(-1, target.labels.clamp(max=layout.labels)[..., None])[..., 0]
    foreground = (target.labels > 0).float()
    return balanced(-safemath.safe_log(own, LABEL_FLOOR), foreground, target.seen, target.beyond)


def depth_loss(rendering: Rendering, layout: Layout, target: FrameTargets) -> Tensor:
    """Depth inside the objects: relative error where depth was measured, 1 - Pearson per object where it is a guess.

    Only pixels that already show mostly their own object count (the rest is the label term's business).
    """
    flat_depth, flat_alpha = rendering.depth.reshape(-1), rendering.alpha.reshape(-1)
    shown = rendering.features.detach().reshape(-1, rendering.features.shape[-1])
    total = rendering.depth.sum() * 0.0
    for k, pixels in enumerate(target.depth_pixels):
        pixels = pixels[shown[pixels, 3 + min(k, layout.labels - 1)] > SHOWN]
        if len(pixels) < FEWEST:
            continue
        depth = safemath.safe_divide(flat_depth[pixels], flat_alpha[pixels], ALPHA_FLOOR)
        expected = target.depth.reshape(-1)[pixels]
        if target.depth_scaled:
            total = total + ((depth - expected) / expected.clamp(min=1e-6)).abs().mean()
        else:
            total = total + GUESSED_DEPTH * (1.0 - pearson(depth, expected))
    return total / max(len(target.depth_pixels), 1)


def pearson(a: Tensor, b: Tensor) -> Tensor:  # (N,), (N,)
    """Correlation; 0 where either is constant."""
    a, b = a - a.mean(), b - b.mean()
    spread = safemath.safe_sqrt((a * a).mean() * (b * b).mean(), 1e-16)
    return safemath.safe_divide((a * b).mean(), spread, 1e-7)


def flow_loss(rendering: Rendering, layout: Layout, target: FrameTargets) -> Tensor:
    """L1 of splatted centre motion against the flow inside the masks, per object coverage, in 1 % of the diagonal."""
    start = 3 + layout.labels
    features = rendering.features.reshape(-1, layout.channels)
    coverage = features[target.flow_pixels, 3:start].sum(-1).detach()
    pixels, coverage = target.flow_pixels[coverage > SHOWN], coverage[coverage > SHOWN]
    if not len(pixels):
        return rendering.features.sum() * 0.0
    unit = 0.01 * target.diagonal
    expected = target.flow.reshape(-1, 2)[pixels] * coverage[:, None]
    error = (features[pixels, start : start + 2] - expected).abs().sum(-1) / unit
    return error.clamp(max=FLOW_LIMIT).mean()


def track_loss(pixels: Tensor, expected: Tensor, confidence: Tensor, diagonal: float) -> Tensor:
    """Huber distance of carried points to their tracks, (P, 2) px each, in 1 % of the image diagonal."""
    distance = safemath.safe_norm(pixels - expected) / (0.01 * diagonal)
    robust = torch.where(distance < 1.0, 0.5 * distance * distance, distance - 0.5)
    return masked_mean(robust, confidence)


def hull_map(target: FrameTargets, k: int) -> Tensor | None:
    """How far every pixel (H, W) is from the nearest one that object k may show at, in 1 % of the diagonal.

    It may show on its own mask, be hidden by another's, and nobody knows about pixels that are void or held out. None
    where its mask is empty: then the masks do not tell where it is.
    """
    if ("hull", k) not in target.kept:
        own = (target.labels == k + 1) & (target.seen > 0)
        excluded = (target.labels == 0) & (target.seen > 0)
        far = None
        if bool(own.any()):
            pixels = cv2.distanceTransform(excluded.numpy().astype(np.uint8), cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
            far = torch.from_numpy(np.maximum(pixels - HULL_MARGIN, 0.0)) / (0.01 * target.diagonal)
        target.kept["hull", k] = far
    return target.kept["hull", k]


def hull_loss(pixels: Tensor, depths: Tensor, opacities: Tensor, far: Tensor) -> Tensor:
    """Mean distance of an object's Gaussians to where it may show, `far` of `hull_map`; outside the picture 0.

    Coverage pulls at a Gaussian only where its own rim meets the mask's; this takes it by the hand wherever it is, as
    the hull of all silhouettes does.

    Args:
        pixels: (N, 2) raster centres. depths: (N,). opacities: (N,) what each counts.
    """
    size = pixels.new_tensor([far.shape[1], far.shape[0]])
    inside = ((pixels > 0) & (pixels < size)).all(dim=1) & (depths > 0)
    grid = torch.where(inside[:, None], 2.0 * pixels / size - 1.0, torch.zeros_like(pixels))
    value = functional.grid_sample(far.to(pixels)[None, None], grid[None, None], padding_mode="border",
                                   align_corners=False)[0, 0, 0]  # fmt: skip
    return (value * inside * opacities.detach()).mean()


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
    column = torch.where(inside, x, 0.0).long()
    row = torch.where(inside, y, 0.0).long()
    label = target.labels[row, column]
    other = inside & (label > 0) & (label != owner + 1)
    if not bool(other.any()):
        return depths.sum() * 0.0
    shown = rendering.features[..., 3 : 3 + layout.labels].detach()
    right = shown[row, column].gather(1, (label - 1).clamp(min=0)[:, None])[:, 0] > SHOWN
    surface = safemath.safe_divide(rendering.depth, rendering.alpha, ALPHA_FLOOR).detach()[row, column]
    in_front = torch.relu(1.01 * surface - depths) / surface.clamp(min=1e-6)
    return masked_mean(in_front, (other & right).float())
