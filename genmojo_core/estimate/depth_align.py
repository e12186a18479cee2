"""Disparity of unknown scale and shift brought to depth (METHOD.md section 11.6).

Relative depth networks and DepthCrafter give disparity d' = a / z + b with unknown a > 0 and b. Ratios of 1 / d' mean
nothing before b is known: it is fitted against metric depth where there is some, else set by a floor.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

_MOST_SAMPLES = 200_000
_FLOOR = 0.1  # of the disparities' spread: how far from zero the furthest background is put without metric depth
_USUAL_DEPTH = 3.0  # scene units of the median pixel without metric depth
_DEPTH_RATIO = 30.0  # furthest over median depth, and median over nearest, that a fit may give


@dataclass(frozen=True)
class Alignment:
    """1 / z = scale * disparity + shift, with the median relative depth error of the fit (NaN without a fit)."""

    scale: float
    shift: float
    error: float

    def depth(self, disparity: np.ndarray) -> np.ndarray:
        """Depth of disparities, finite and positive, kept within a ratio of 30 of its median."""
        inverse = self.scale * np.nan_to_num(disparity.astype(np.float64)) + self.shift
        middle = float(np.median(inverse[inverse > 0])) if (inverse > 0).any() else 1.0
        return (1.0 / np.clip(inverse, middle / _DEPTH_RATIO, middle * _DEPTH_RATIO)).astype(np.float32)


def fit_alignment(disparity: np.ndarray, depth: np.ndarray, valid: np.ndarray, seed: int = 0) -> Alignment | None:
    """Robust scale and shift over all frames at once, or None when fewer than 16 values or no slope support it.

    Args:
        disparity, depth: (T, H, W); depth in scene units. valid: (T, H, W) bool where depth holds.
    Least squares in disparity, reweighted (Geman-McClure) with the residuals' median as scale.
    """
    chosen = valid & np.isfinite(disparity) & np.isfinite(depth) & (depth > 0)
    x, y = disparity[chosen].astype(np.float64), 1.0 / depth[chosen].astype(np.float64)
    if len(x) < 16 or np.ptp(x) <= 0:
        return None
    if len(x) > _MOST_SAMPLES:
        pick = np.random.default_rng(seed).choice(len(x), _MOST_SAMPLES, replace=False)
        x, y = x[pick], y[pick]
    scale, shift = _theil(x, y, seed)
    for _ in range(20):
        residual = y - scale * x - shift
        width = 3.0 * max(float(np.median(np.abs(residual))), 1e-6 * float(np.median(y)))
        weight = 1.0 / (1.0 + (residual / width) ** 2) ** 2
        mean_x, mean_y = np.average(x, weights=weight), np.average(y, weights=weight)
        spread = float(np.sum(weight * (x - mean_x) ** 2))
        if spread <= 0:
            return None
        scale = float(np.sum(weight * (x - mean_x) * (y - mean_y))) / spread
        shift = float(mean_y - scale * mean_x)
    if not np.isfinite(scale) or scale <= 0:
        return None
    error = float(np.median(np.abs((scale * x + shift) / y - 1)))
    return Alignment(scale, shift, error)


def floor_alignment(disparity: np.ndarray) -> Alignment:
    """Scale and shift without metric depth: the first percentile lies a tenth of the spread above zero disparity, and
    the median pixel at 3 scene units.
    """
    values = disparity[np.isfinite(disparity)].astype(np.float64)
    if values.size == 0:
        return Alignment(0.0, 1.0 / _USUAL_DEPTH, float("nan"))
    low, middle, high = np.percentile(values, [1, 50, 99])
    spread = high - low
    if spread <= 1e-12 * max(abs(high), 1.0):
        return Alignment(0.0, 1.0 / _USUAL_DEPTH, float("nan"))
    floor = low - _FLOOR * spread
    scale = 1.0 / (_USUAL_DEPTH * (middle - floor))
    return Alignment(scale, -scale * floor, float("nan"))


def steady(disparity: np.ndarray, free: np.ndarray) -> np.ndarray:  # (T, H, W), (T, H, W) bool -> (T, H, W) float32
    """Flicker of single-image networks taken out, for a still camera: every frame's background fits the median one.

    Frames whose background does not support a fit (under 16 pixels, or a slope not above zero) stay as they are.
    """
    usual = np.median(disparity, axis=0)
    seen = free.mean(axis=0) > 0.5
    result = disparity.astype(np.float32).copy()
    for t, plane in enumerate(disparity):
        chosen = seen & free[t]
        x, y = plane[chosen].astype(np.float64), usual[chosen].astype(np.float64)
        if len(x) < 16 or np.ptp(x) <= 0:
            continue
        slope, offset = _theil(x, y, t)
        if slope > 0:
            result[t] = slope * plane + offset
    return result


def _theil(x: np.ndarray, y: np.ndarray, seed: int) -> tuple[float, float]:
    """Start of the fit: the median slope between random pairs (Theil and Sen) and the median offset."""
    pairs = np.random.default_rng(seed).integers(0, len(x), size=(2, 4000))
    dx, dy = x[pairs[0]] - x[pairs[1]], y[pairs[0]] - y[pairs[1]]
    far = np.abs(dx) > 0.05 * np.ptp(x)
    slope = float(np.median(dy[far] / dx[far])) if far.any() else 1.0
    return slope, float(np.median(y - slope * x))
