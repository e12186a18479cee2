"""How well a place can be followed and placed: corner strength, texture, distance to the mask's rim. No Qt."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

SIDE = 21  # pixels of the window looked at
NEAR = 8.0  # pixels: closer points are hard to tell apart
_GOOD_CORNER = 0.02  # smaller eigenvalue of the structure tensor (grey levels 0..1) that counts as a full corner


@dataclass(frozen=True)
class Meter:
    """score 0..1 (1: a strong corner), and warnings in the order of weight: "off mask", "flat", "edge", "near"."""

    score: float
    warnings: tuple[str, ...]


def measure(
    frame: np.ndarray,  # (H, W, 4) uint8 BGRA
    xy: tuple[float, float],
    labels: np.ndarray | None,  # (H, W) ids, or None
    object_id: int,
    others: np.ndarray,  # (n, 2) places of other points
) -> Meter:
    """What speaks for and against putting a point of an object at a raster position."""
    size = np.array([frame.shape[1], frame.shape[0]])
    patch = cv2.getRectSubPix(cv2.cvtColor(_around(frame, xy), cv2.COLOR_BGRA2GRAY), (SIDE, SIDE), _middle(frame, xy))
    grey = patch.astype(np.float32) / 255
    dx, dy = cv2.Sobel(grey, cv2.CV_32F, 1, 0, scale=0.125), cv2.Sobel(grey, cv2.CV_32F, 0, 1, scale=0.125)
    tensor = np.array([[(dx * dx).mean(), (dx * dy).mean()], [(dx * dy).mean(), (dy * dy).mean()]])
    low, high = np.linalg.eigvalsh(tensor)
    score = float(np.clip(np.sqrt(max(low, 0.0)) / np.sqrt(_GOOD_CORNER) * 2.0, 0.0, 1.0))
    warnings = []
    if labels is not None and not on_mask(labels, xy, object_id, size):
        warnings.append("off mask")
    if score < 0.15:
        warnings.append("flat" if high < 4 * max(low, 1e-7) or high < 2e-4 else "edge")
    if len(others) and float(np.hypot(*(others - np.array(xy)).T).min()) < NEAR:
        warnings.append("near")
    return Meter(score, tuple(warnings))


def on_mask(labels: np.ndarray, xy: tuple[float, float], object_id: int, size: np.ndarray) -> bool:
    """True if a raster position of a clip of `size` (width, height) lies on an object's mask of any resolution."""
    x, y = np.floor(np.array(xy) * labels.shape[1::-1] / size).astype(int)
    return bool(0 <= x < labels.shape[1] and 0 <= y < labels.shape[0] and labels[y, x] == object_id)


def _around(frame: np.ndarray, xy: tuple[float, float]) -> np.ndarray:
    """The part of a frame near a position."""
    x0, y0 = _corner(frame, xy)
    return np.ascontiguousarray(frame[y0 : y0 + 3 * SIDE, x0 : x0 + 3 * SIDE])


def _middle(frame: np.ndarray, xy: tuple[float, float]) -> tuple[float, float]:
    """The position in that part, in OpenCV's pixel centres."""
    x0, y0 = _corner(frame, xy)
    return float(xy[0] - 0.5 - x0), float(xy[1] - 0.5 - y0)


def _corner(frame: np.ndarray, xy: tuple[float, float]) -> tuple[int, int]:
    x = int(np.clip(xy[0] - 1.5 * SIDE, 0, max(frame.shape[1] - 1, 0)))
    y = int(np.clip(xy[1] - 1.5 * SIDE, 0, max(frame.shape[0] - 1, 0)))
    return x, y
