"""Two pictures of one frame on the same pixel grid: joined, subtracted, measured."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from genmojo_core.measure.images import psnr


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


def whole_psnr(first: np.ndarray, second: np.ndarray) -> float:  # (H, W, 3) uint8 each
    """PSNR in dB over all pixels."""
    return psnr(first / np.float32(255), second / np.float32(255))


def psnr_by_object(
    first: np.ndarray,  # (H, W, 3) uint8
    second: np.ndarray,  # (H, W, 3) uint8
    labels: np.ndarray,  # (H, W)
    ids: Mapping[int, int],
) -> dict[int, float]:
    """PSNR in dB inside every object's mask, by id; `ids` maps ids to labels. NaN where an object has no pixel."""
    a, b = first / np.float32(255), second / np.float32(255)
    return {object_id: psnr(a, b, labels == label) for object_id, label in ids.items()}
