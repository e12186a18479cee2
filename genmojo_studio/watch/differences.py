"""Two pictures of one frame on the same pixel grid: joined, subtracted, measured. Plain numpy."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np


def wipe(left: np.ndarray, right: np.ndarray, share: float) -> np.ndarray:  # (H, W, 3) uint8 each
    """`left` up to `share` (0..1) of the width, `right` beyond it."""
    joined = right.copy()
    column = round(min(max(share, 0.0), 1.0) * left.shape[1])
    joined[:, :column] = left[:, :column]
    return joined


def onion(below: np.ndarray, above: np.ndarray, share: float) -> np.ndarray:  # (H, W, 3) uint8 each
    """Both at once, `share` (0..1) of the second."""
    part = round(min(max(share, 0.0), 1.0) * 256)
    return ((below.astype(np.uint16) * (256 - part) + above.astype(np.uint16) * part) >> 8).astype(np.uint8)


def absolute(first: np.ndarray, second: np.ndarray, gain: float) -> np.ndarray:  # (H, W, 3) uint8 each
    """|first - second| times a gain, clamped: black where they agree."""
    apart = np.abs(first.astype(np.int16) - second.astype(np.int16))
    return np.minimum(apart * gain, 255).astype(np.uint8)


def psnr(first: np.ndarray, second: np.ndarray, chosen: np.ndarray | None = None) -> float:
    """dB of two uint8 pictures over the chosen pixels (H, W) bool; NaN if there are none, infinite if equal."""
    apart = (first.astype(np.float32) - second.astype(np.float32)) ** 2
    if chosen is not None:
        apart = apart[chosen]
    if not apart.size:
        return math.nan
    error = float(apart.mean()) / 255.0**2
    return math.inf if error == 0 else -10.0 * math.log10(error)


def psnr_by_object(
    first: np.ndarray, second: np.ndarray, labels: np.ndarray, ids: Mapping[int, int]
) -> dict[int, float]:
    """PSNR inside every object's mask: id -> dB; `ids` maps ids to the labels in `labels` (H, W)."""
    return {object_id: psnr(first, second, labels == label) for object_id, label in ids.items()}
