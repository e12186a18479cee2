"""Reading at a reduced size: target sizes and the one sampling rule of labels, depth and flow."""

from __future__ import annotations

import cv2
import numpy as np


def fitted(size: tuple[int, int], short_side: int | None) -> tuple[int, int]:
    """(width, height) with the given short side and the same shape, rounded; never larger than `size`."""
    width, height = size
    if short_side is None or short_side >= min(size):
        return width, height
    scale = short_side / min(size)
    return max(1, int(width * scale + 0.5)), max(1, int(height * scale + 0.5))


def area(picture: np.ndarray, size: tuple[int, int]) -> np.ndarray:  # (H, W, 3) uint8
    """The picture at another size: area average when it shrinks, unchanged when it fits."""
    if picture.shape[1::-1] == size:
        return picture
    return cv2.resize(picture, size, interpolation=cv2.INTER_AREA)


def nearest(plane: np.ndarray, size: tuple[int, int]) -> np.ndarray:  # (H, W, ...)
    """Values at the pixel centres of an image of another size: what is valid at a pixel stays together.

    Labels, depth and flow all use this rule, so a depth never belongs to another object than its label.
    """
    width, height = size
    if plane.shape[1::-1] == size:
        return plane
    return plane[_centres(height, plane.shape[0])[:, None], _centres(width, plane.shape[1])]


def nearest_labels(labels: np.ndarray, size: tuple[int, int]) -> np.ndarray:  # (H, W) uint8
    """`nearest`, but an object too small to be met keeps one pixel: a tiny object must not vanish by resizing."""
    small = nearest(labels, size)
    if small.shape == labels.shape:
        return small
    counts = [np.bincount(picture.ravel(), minlength=256)[:255] for picture in (labels, small)]  # 255 is void
    lost = np.flatnonzero((counts[0] > 0) & (counts[1] == 0))
    if lost.size:
        small = small.copy()
    for label in lost:
        rows, columns = np.nonzero(labels == label)
        middle = len(rows) // 2
        row = int(rows[middle] * size[1] / labels.shape[0])
        column = int(columns[middle] * size[0] / labels.shape[1])
        small[row, column] = label
    return small


def nearest_valid(
    plane: np.ndarray,  # (H, W)
    valid: np.ndarray,  # (H, W) bool
    size: tuple[int, int],
) -> tuple[np.ndarray, np.ndarray]:
    """`nearest` of a plane and its validity; a pixel whose centre is not valid takes another one of its own area.

    Tried are the centres of its nine thirds. Returns (value, valid) at `size`.
    """
    value, good = nearest(plane, size), nearest(valid, size)
    if good.all() or plane.shape[1::-1] == size:
        return value, good
    value, good = value.copy(), good.copy()
    for down in (1, 0, 2):
        for right in (1, 0, 2):
            rows = _centres(size[1], plane.shape[0], (down + 0.5) / 3)[:, None]
            columns = _centres(size[0], plane.shape[1], (right + 0.5) / 3)
            take = ~good & valid[rows, columns]
            value[take] = plane[rows, columns][take]
            good |= take
    return value, good


def _centres(out: int, into: int, at: float = 0.5) -> np.ndarray:
    """Index of the source pixel under each target pixel's point `at` (0..1 of its width)."""
    return np.minimum(((np.arange(out) + at) * into / out).astype(np.int64), into - 1)
