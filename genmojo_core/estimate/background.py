"""The background without objects: what is seen behind them at other times, painted where it is never seen."""

from __future__ import annotations

import cv2
import numpy as np

from genmojo_core.clip.cameras import Cameras
from genmojo_core.estimate.views import carry, depth_in

_MOST_FRAMES = 41  # frames a plate is made from; more do not change a median
_PAINT_SIDE = 256  # short side at which unseen parts are painted


def make_plate(
    frames: np.ndarray,  # (T, H, W, 3) uint8
    free: np.ndarray,  # (T, H, W) bool, surely background
    cameras: Cameras,
    depth: np.ndarray,  # (H, W) depth of the plate, scene units
    reference: int = 0,
) -> tuple[np.ndarray, np.ndarray]:  # (H, W, 3) uint8, (H, W) bool
    """Median colour over time of what the plate's points show in other frames, and where there was any.

    Frames are carried into the plate's camera through its depth. Unseen pixels are painted from their surroundings.
    """
    chosen = np.unique(np.linspace(0, len(frames) - 1, min(len(frames), _MOST_FRAMES)).round().astype(int))
    stack = np.full((len(chosen), *frames.shape[1:]), np.nan, np.float32)
    for i, t in enumerate(chosen):
        where = carry(cameras.view(reference), cameras.view(int(t)), depth)
        color = cv2.remap(frames[t], where[..., 0], where[..., 1], cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
        inside = cv2.remap(
            free[t].astype(np.uint8), where[..., 0], where[..., 1], cv2.INTER_NEAREST, borderMode=cv2.BORDER_CONSTANT
        )
        ok = np.asarray(inside) > 0
        stack[i][ok] = color[ok] * light_gain(frames[reference], np.asarray(color), ok & free[reference])
    seen = np.asarray(np.isfinite(stack[..., 0]).any(axis=0))
    median = masked_median(stack)
    plate = np.where(seen[..., None], median, 0).round().clip(0, 255).astype(np.uint8)
    return paint(plate, ~seen), seen


def light_gain(reference: np.ndarray, image: np.ndarray, shared: np.ndarray) -> np.ndarray:  # (3,)
    """Factor per channel that brings an image's light to the reference's (H, W, 3): the median ratio on shared pixels.

    Ratios are taken where neither is nearly black or clipped; gains within 2 % of 1 count as 1, so that a still light
    leaves pixels exact.
    """
    gain = np.ones(3, np.float32)
    for c in range(3):
        a, b = reference[..., c][shared].astype(np.float32), image[..., c][shared].astype(np.float32)
        usable = (a > 10) & (b > 10) & (a < 245) & (b < 245)
        if usable.sum() >= 100:
            gain[c] = np.clip(np.median(a[usable] / b[usable]), 0.25, 4.0)
    return np.where(np.abs(gain - 1) < 0.02, np.float32(1), gain)


def masked_median(stack: np.ndarray) -> np.ndarray:  # (N, H, W, ...) float32 with NaN where unknown
    """Median over the first axis of what is known, 0 where nothing is (no warnings, unlike nanmedian)."""
    count = np.isfinite(stack).sum(axis=0)
    ordered = np.sort(stack, axis=0)  # NaN goes last
    low = np.take_along_axis(ordered, np.maximum((count - 1) // 2, 0)[None], axis=0)[0]
    high = np.take_along_axis(ordered, np.maximum(count // 2 * (count > 1), 0)[None], axis=0)[0]
    return np.where(count > 0, 0.5 * (low + high), 0).astype(np.float32)


def paint(image: np.ndarray, unknown: np.ndarray) -> np.ndarray:  # (H, W, 3) uint8, (H, W) bool -> (H, W, 3) uint8
    """Unknown pixels filled from around them (Telea), at a reduced size for large images."""
    if not unknown.any():
        return image
    if unknown.all():
        return np.full_like(image, 128)
    h, w = unknown.shape
    scale = min(1.0, _PAINT_SIDE / min(h, w))
    small = (max(1, round(w * scale)), max(1, round(h * scale)))
    known = cv2.resize((~unknown).astype(np.float32), small, interpolation=cv2.INTER_AREA)
    color = cv2.resize(image * (~unknown[..., None]).astype(np.float32), small, interpolation=cv2.INTER_AREA)
    color = np.where(known[..., None] > 0.5, color / np.maximum(known, 1e-6)[..., None], 0).round().astype(np.uint8)
    filled = cv2.inpaint(color, (known <= 0.5).astype(np.uint8), 5, cv2.INPAINT_TELEA)
    large = cv2.resize(filled, (w, h), interpolation=cv2.INTER_CUBIC) if scale < 1 else filled
    return np.where(unknown[..., None], large, image)


def plate_depth(
    depth: np.ndarray,  # (T, H, W) scene units
    valid: np.ndarray,  # (T, H, W) bool
    free: np.ndarray,  # (T, H, W) bool, surely background
    cameras: Cameras,
    reference: int = 0,
) -> tuple[np.ndarray, np.ndarray]:  # (H, W) float32, (H, W) bool
    """Background depth in the reference camera: median over time outside the masks, filled smoothly behind objects.

    Other frames' points are projected into the reference camera; the nearest-pixel samples of all frames are pooled.
    """
    t, h, w = depth.shape
    chosen = np.unique(np.linspace(0, t - 1, min(t, _MOST_FRAMES)).round().astype(int))
    stack = np.full((len(chosen), h, w), np.nan, np.float32)
    for i, j in enumerate(chosen):
        ok = free[j] & valid[j]
        source, target = cameras.view(int(j)), cameras.view(reference)
        where = carry(source, target, depth[j])[ok]
        z = depth_in(source, target, depth[j])[ok]
        column, row = np.rint(where[:, 0]).astype(int), np.rint(where[:, 1]).astype(int)
        inside = (column >= 0) & (column < w) & (row >= 0) & (row < h) & (z > 0)
        stack[i, row[inside], column[inside]] = z[inside]
    seen = np.asarray(np.isfinite(stack).any(axis=0))
    return fill_smoothly(masked_median(stack), seen), seen


def fill_smoothly(values: np.ndarray, known: np.ndarray) -> np.ndarray:  # (H, W) float32, (H, W) bool -> (H, W)
    """Unknown pixels filled by pulling and pushing averages through a pyramid; known pixels stay exact.

    Without one known pixel the result is 1 everywhere.
    """
    if not known.any():
        return np.ones_like(values)
    levels = [(np.where(known, values, 0).astype(np.float32), known.astype(np.float32))]
    while min(levels[-1][0].shape) > 1:
        value, weight = levels[-1]
        size = ((value.shape[1] + 1) // 2, (value.shape[0] + 1) // 2)
        mean_weight = cv2.resize(weight, size, interpolation=cv2.INTER_AREA)
        mean = cv2.resize(value * weight, size, interpolation=cv2.INTER_AREA) / np.maximum(
            mean_weight, np.float32(1e-6)
        )
        levels.append((np.asarray(mean, np.float32), (mean_weight > 0).astype(np.float32)))
    value, weight = levels[-1]
    result = np.full_like(value, np.sum(value * weight) / max(float(weight.sum()), 1e-6))
    for value, weight in reversed(levels):
        coarse = cv2.resize(result, value.shape[::-1], interpolation=cv2.INTER_LINEAR)
        result = np.where(weight > 0, value, coarse)
    return result.astype(np.float32)
