"""What masks alone say about objects: where they stand, how large they look, how thick they may be."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

_EDGE = 2  # pixels: a mask this close to the frame's border is cut by it
_SQUARE_LIMIT = 4.0  # pixel aspects further from 1 than this are taken for this


@dataclass(frozen=True)
class Shapes:
    """Measurements of K objects in T frames; NaN where a measurement does not hold.

    Args:
        seen: (T, K) bool, at least one pixel.
        lowest: (T, K) raster row of the lower edge, NaN where the border or another object cuts it.
        lowest_any: (T, K) the same even where cut, NaN where not seen.
        column: (T, K) raster column of the middle of the lowest rows, NaN where not seen.
        size: (T, K) square root of the area in pixels, NaN where anything cuts the mask.
        radius: (K,) usual radius of the largest inscribed circle, in pixel heights.
    """

    seen: np.ndarray
    lowest: np.ndarray
    lowest_any: np.ndarray
    column: np.ndarray
    size: np.ndarray
    radius: np.ndarray

    def usual_row(self) -> np.ndarray:  # (K,)
        """Median lower edge of every object, from cut ones where there is nothing else, NaN if never seen."""
        return np.array([_median(_median(a), b) for a, b in zip(self.lowest.T, self.lowest_any.T, strict=True)])


def measure_shapes(labels: np.ndarray, objects: int, aspect: float = 1.0) -> Shapes:
    """Measure all objects.

    Args:
        labels: (T, H, W) uint8, k + 1 on object k. objects: K.
        aspect: width / height of a pixel as shown.
    """
    t, h, w = labels.shape
    table = {name: np.full((t, objects), np.nan) for name in ("lowest", "lowest_any", "column", "size", "radius")}
    seen = np.zeros((t, objects), bool)
    for f in range(t):
        for k in range(objects):
            mask = labels[f] == k + 1
            rows = np.flatnonzero(mask.any(axis=1))
            if len(rows) == 0:
                continue
            seen[f, k] = True
            columns = np.flatnonzero(mask.any(axis=0))
            foot = mask[max(rows[0], rows[-1] - max(1, len(rows) // 20)) : rows[-1] + 1]
            table["column"][f, k] = np.flatnonzero(foot.any(axis=0)).mean() + 0.5
            table["lowest_any"][f, k] = rows[-1] + 1.0
            below = labels[f][min(rows[-1] + 2, h - 1)][foot[-1]]
            if rows[-1] < h - _EDGE and not ((below > 0) & (below != k + 1)).any():
                table["lowest"][f, k] = rows[-1] + 1.0
            cut = rows[0] < _EDGE or rows[-1] >= h - _EDGE or columns[0] < _EDGE or columns[-1] >= w - _EDGE
            if not (cut or _neighbours(labels[f], mask)):
                table["size"][f, k] = np.sqrt(mask.sum())
            table["radius"][f, k] = inside_distance(mask, aspect).max()
    radius = np.array([_median(column, np.array([1.0])) for column in table["radius"].T])
    return Shapes(seen, table["lowest"], table["lowest_any"], table["column"], table["size"], radius)


def inside_distance(mask: np.ndarray, aspect: float = 1.0) -> np.ndarray:  # (H, W) bool -> (H, W) float32
    """Distance to the outline in pixel heights, 0 outside; where the frame cuts a mask it is taken to go on."""
    result = np.zeros(mask.shape, np.float32)
    box = cv2.boundingRect(mask.astype(np.uint8))
    if box[2] == 0:
        return result
    left, top, right, bottom = max(0, box[0] - 1), max(0, box[1] - 1), box[0] + box[2] + 1, box[1] + box[3] + 1
    cut = mask[top:bottom, left:right].astype(np.uint8)
    if cut.all():  # nothing outside within the frame
        result[top:bottom, left:right] = 0.5 * min(cut.shape)
        return result
    stretch = float(np.clip(aspect, 1 / _SQUARE_LIMIT, _SQUARE_LIMIT))
    square = cv2.resize(cut, (max(1, round(cut.shape[1] * stretch)), cut.shape[0]), interpolation=cv2.INTER_NEAREST)
    distance = cv2.distanceTransform(square, cv2.DIST_L2, 5)
    result[top:bottom, left:right] = cv2.resize(distance, cut.shape[::-1], interpolation=cv2.INTER_LINEAR)
    return np.where(mask, np.maximum(result, 0.5), 0)


def rounded(mask: np.ndarray, continued: np.ndarray, aspect: float = 1.0) -> np.ndarray:  # (H, W) -> 0..1
    """How far a rounded body bulges toward the camera: 0 on its outline, 1 along its middle.

    Args:
        mask: (H, W) bool. continued: (H, W) bool, pixels of others it goes on behind, so their edge is not its own.
        aspect: width / height of a pixel.
    """
    own = inside_distance(mask, aspect)
    largest = float(own.max())
    if largest <= 0:
        return own
    distance = inside_distance(mask | continued, aspect) if continued.any() else own
    depth_in = np.clip(distance / largest, 0, 1)
    return np.where(mask, np.sqrt(np.clip(1 - (1 - depth_in) ** 2, 0, 1)), 0).astype(np.float32)


def _neighbours(labels: np.ndarray, mask: np.ndarray) -> bool:
    """Whether another object lies within two pixels of the mask."""
    around = cv2.dilate(mask.astype(np.uint8), np.ones((5, 5), np.uint8)) > 0
    return bool(((labels > 0) & around & ~mask).any())


def _median(values: np.ndarray | float, otherwise: np.ndarray | None = None) -> float:
    """Median of what is finite; of `otherwise` when there is nothing; NaN when that has nothing either."""
    listed = np.atleast_1d(values)
    listed = listed[np.isfinite(listed)]
    if len(listed):
        return float(np.median(listed))
    return float("nan") if otherwise is None else _median(otherwise)
