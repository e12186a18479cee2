"""Points of an object carried by the flow over a few frames."""

from __future__ import annotations

import cv2
import numpy as np

_MOST_WINDOWS = 24  # of a long clip


def follow(masks: np.ndarray, flow: np.ndarray, valid: np.ndarray, frames: range, most: int) -> np.ndarray:
    """Tracks (P, F, 2) of points carried by the flow that stay inside the object and where the flow holds."""
    inner = {t: cv2.erode(masks[t].astype(np.uint8), np.ones((3, 3), np.uint8)).astype(np.float32) for t in frames}
    y, x = np.nonzero(inner[frames[0]])
    chosen = np.linspace(0, len(x) - 1, min(len(x), most)).astype(int)
    points = np.stack([x[chosen], y[chosen]], axis=1).astype(np.float64)
    tracks, good = [points], np.ones(len(points), bool)
    for t in frames[:-1]:
        good &= _bilinear(valid[t].astype(np.float32)[..., None], points)[:, 0] > 0.9
        points = points + _bilinear(flow[t], points)
        good &= _bilinear(inner[t + 1][..., None], points)[:, 0] > 0.5
        tracks.append(points)
    return np.stack(tracks, axis=1)[good]


def _bilinear(image: np.ndarray, points: np.ndarray) -> np.ndarray:  # (H, W, C), (P, 2) pixel indices -> (P, C)
    """Values between pixels; places outside take the border's."""
    h, w = image.shape[:2]
    x, y = np.clip(points[:, 0], 0, w - 1), np.clip(points[:, 1], 0, h - 1)
    i, j = np.minimum(x.astype(int), max(w - 2, 0)), np.minimum(y.astype(int), max(h - 2, 0))
    a, b = (x - i)[:, None], (y - j)[:, None]
    right, down = np.minimum(i + 1, w - 1), np.minimum(j + 1, h - 1)
    return (1 - b) * ((1 - a) * image[j, i] + a * image[j, right]) + b * (
        (1 - a) * image[down, i] + a * image[down, right]
    )


def window_starts(frames: int, window: int) -> list[int]:
    """First frames of windows that follow one another, each starting where the one before ends."""
    return list(range(0, max(frames - 1, 1), max(window - 1, 1)))
