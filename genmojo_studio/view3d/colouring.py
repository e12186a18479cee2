"""From a mode's sums to colours: scales, palettes, and the same on the processor as the RESOLVE shader does."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from genmojo_studio.view3d.look import RGB, Mode

COVERED = 0.05  # pixels with less coverage do not count for a colour scale
LEAST = 1e-4  # coverage by which sums are divided at least


@lru_cache(maxsize=1)
def palette_rgb() -> np.ndarray:
    """(256, 3) float32 colours of a scalar scale, dark to bright (viridis)."""
    import cv2  # a tenth of a second that a window without a scene need not wait

    table = cv2.applyColorMap(np.arange(256, dtype=np.uint8)[:, None], cv2.COLORMAP_VIRIDIS)
    return np.ascontiguousarray(table[:, 0, ::-1], np.float32) / 255


def value_bounds(sums: np.ndarray, mode: Mode) -> tuple[float, float]:
    """The colour scale of sums (..., 4): 2nd and 98th percentile of what is covered; flow and errors from zero."""
    if mode == Mode.OPACITY:
        return 0.0, 1.0
    flat = sums.reshape(-1, 4)
    flat = flat[flat[:, 3] > COVERED]
    if not len(flat):
        return 0.0, 1.0
    mean = flat[:, :3] / flat[:, 3:]
    values = np.hypot(mean[:, 0], mean[:, 1]) if mode == Mode.FLOW else mean[:, 0]
    low, high = (float(v) for v in np.percentile(values, (2, 98)))
    if mode in (Mode.FLOW, Mode.RESIDUAL):
        low = 0.0
    return (low, high) if high > low else (low, low + 1e-6)


def colour(
    sums: np.ndarray,  # (H, W, 4) premultiplied
    mode: Mode,
    backdrop: RGB,
    bounds: tuple[float, float],
    object_colors: np.ndarray,  # (K, 3)
) -> np.ndarray:  # (H, W, 3) uint8
    """Sums over a backdrop as the RESOLVE shader colours them."""
    rgb, alpha = _premultiplied(sums, mode, bounds, object_colors)
    shown = np.array(rgb, np.float32)  # worked on in place: this runs for every frame
    if any(backdrop):
        shown += (1 - alpha) * np.asarray(backdrop, np.float32)
    shown *= 255
    shown += 0.5
    return np.clip(shown, 0, 255.5, out=shown).astype(np.uint8)


def straight_rgba(
    sums: np.ndarray, mode: Mode, bounds: tuple[float, float], object_colors: np.ndarray
) -> np.ndarray:  # (H, W, 4) uint8
    """Sums without a backdrop: colours divided by coverage, as PNG wants them."""
    rgb, alpha = _premultiplied(sums, mode, bounds, object_colors)
    rgba = np.concatenate([rgb / np.maximum(alpha, LEAST), alpha], axis=-1)
    return (np.clip(rgba, 0, 1) * 255 + 0.5).astype(np.uint8)


def _premultiplied(
    sums: np.ndarray, mode: Mode, bounds: tuple[float, float], object_colors: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Colours times coverage (H, W, 3), and the coverage that is shown (H, W, 1)."""
    rgb, alpha = sums[..., :3], sums[..., 3:]
    if mode in (Mode.RGB, Mode.INSTANCE_SOFT, Mode.ELLIPSOIDS, Mode.CENTRES):
        return rgb, alpha
    mean = rgb / np.maximum(alpha, LEAST)
    if mode in (Mode.DEPTH, Mode.DEPTH_MEDIAN, Mode.RESIDUAL):
        rgb = _on_scale(mean[..., 0], bounds) * alpha
    elif mode == Mode.OPACITY:
        rgb, alpha = _on_scale(alpha[..., 0], (0.0, 1.0)), np.ones_like(alpha)
    elif mode == Mode.FLOW:
        rgb = flow_wheel(mean[..., :2], bounds[1]) * alpha
    elif mode == Mode.NORMAL:
        length = np.maximum(np.linalg.norm(mean, axis=-1, keepdims=True), 1e-6)
        rgb = (0.5 + 0.5 * mean * np.array([1, -1, -1], np.float32) / length) * alpha
    elif mode == Mode.INSTANCE:
        alpha = (alpha > 0.5).astype(np.float32)
        rgb = object_colors[sums[..., 0].astype(np.int64)] * alpha
    return rgb, alpha


def flow_wheel(flow: np.ndarray, most: float) -> np.ndarray:  # (..., 2) px -> (..., 3)
    """Direction as hue, speed as saturation: white for none, full colour from `most` pixels on."""
    turn = np.arctan2(flow[..., 1], flow[..., 0]) / (2 * np.pi) + 0.5
    phase = np.array([0.0, 2 / 3, 1 / 3])
    hue = np.clip(np.abs(np.mod(turn[..., None] + phase, 1.0) * 6 - 3) - 1, 0, 1)
    share = np.clip(np.hypot(flow[..., 0], flow[..., 1]) / max(most, 1e-9), 0, 1)[..., None]
    return (1 - share + share * hue).astype(np.float32)


def _on_scale(values: np.ndarray, bounds: tuple[float, float]) -> np.ndarray:
    """(..., 3) palette colours of values between bounds."""
    share = np.clip((values - bounds[0]) / max(bounds[1] - bounds[0], 1e-9), 0, 1)
    return palette_rgb()[np.round(share * 255).astype(np.int64)]
