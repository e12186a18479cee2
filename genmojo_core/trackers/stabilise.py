"""Flow of one object between two frames, after a predicted motion has been taken out.

Peak motion in real clips is tens of pixels a frame over repeating texture, which no dense flow finds by itself. Here
the second frame is first pulled back by a predicted map (an affine, or a rigid motion of a surface), so that the dense
flow only has to find the rest, on a crop of the object alone. ARCHITECTURE.md section 6.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

WORK_SIDE = 112  # pixels of the longer side of a work grid: DIS needs a few of its 8 px patches across an object
_FINEST = 0.8  # pixels between places at least: finer grids only cost time
_MARGIN = 0.12  # of the object's size, around its box
_LARGE = 90  # cells of a grid's longer side from which half its resolution is enough for the flow
_MASK_FULL = 0.9  # warped mask value from which a pixel counts as the object


@dataclass(frozen=True)
class Layer:
    """One object through a clip, ready for matching.

    T frames of H x W held pixels.

    Args:
        shade: (T, H, W) uint8 brightness with the local mean and contrast taken out, so light may change.
        mask: (T, H, W) bool visible pixels of the object.
        other: (T, H, W) bool pixels of other objects, behind which the object may go on.
    """

    shade: np.ndarray
    mask: np.ndarray
    other: np.ndarray


@dataclass(frozen=True)
class Grid:
    """A regular grid of sampling places over the object in one frame.

    Args:
        xy: (h, w, 2) float32 raster pixels of the frame.
        step: pixels between neighbours.
        inside: (h, w) bool, the place lies on the object.
        shade: (h, w) uint8 the frame's shade there.
    """

    xy: np.ndarray
    step: float
    inside: np.ndarray
    shade: np.ndarray


@dataclass(frozen=True)
class Link:
    """Where the places of a grid are found in another frame.

    Args:
        xy: (h, w, 2) float32 raster pixels of the other frame.
        weight: (h, w) float32 0..1; 0 outside the object, where it is hidden there, or where flow contradicts itself;
            all less where most of what is visible in both frames does not match.
        score: mean agreement 0..1 of the matched places, times the share of the object that is matched.
    """

    xy: np.ndarray
    weight: np.ndarray
    score: float


def layer_of(frames: np.ndarray, masks: np.ndarray, label: int, valid: np.ndarray) -> Layer:
    """The layer of the object with a label (>= 1).

    Args:
        frames: (T, H, W, 3) uint8 RGB.
        masks: (T, H, W) labels.
        label: label of the object in `masks`.
        valid: (T, H, W) bool, False on void pixels.
    """
    mask = (masks == label) & valid
    other = (masks > 0) & (masks != label) & valid
    return Layer(np.stack([flat_shade(f) for f in frames]), mask, other | ~valid)


def flat_shade(frame: np.ndarray) -> np.ndarray:  # (H, W, 3) uint8 -> (H, W) uint8
    """Brightness less its local mean, over its local contrast (window 1/12 of the short side), around 128."""
    gray = cv2.cvtColor(frame, cv2.COLOR_RGB2GRAY).astype(np.float32)
    sigma = max(min(gray.shape) / 12.0, 3.0)
    mean = cv2.GaussianBlur(gray, (0, 0), sigma)
    spread = np.sqrt(np.maximum(cv2.GaussianBlur(gray * gray, (0, 0), sigma) - mean * mean, 0.0))
    return np.clip(128.0 + 40.0 * (gray - mean) / (spread + 8.0), 0, 255).astype(np.uint8)


def grid_of(layer: Layer, t: int) -> Grid | None:
    """The sampling grid of the object in frame t; None where it has fewer than 12 visible pixels."""
    rows, cols = np.nonzero(layer.mask[t])
    if len(rows) < 12:
        return None
    x0, x1, y0, y1 = cols.min(), cols.max() + 1, rows.min(), rows.max() + 1
    pad = max(_MARGIN * max(x1 - x0, y1 - y0), 4.0)
    width, height = x1 - x0 + 2 * pad, y1 - y0 + 2 * pad
    step = max(max(width, height) / WORK_SIDE, _FINEST)
    w, h = max(int(np.ceil(width / step)), 24), max(int(np.ceil(height / step)), 24)
    xs = (x0 - pad) + (np.arange(w) + 0.5) * step
    ys = (y0 - pad) + (np.arange(h) + 0.5) * step
    xy = np.stack(np.meshgrid(xs, ys), axis=-1).astype(np.float32)
    inside = sample(layer.mask[t].astype(np.float32), xy) > 0.5
    return Grid(xy, float(step), inside, sample(layer.shade[t], xy))


def sample(image: np.ndarray, xy: np.ndarray, border: int = cv2.BORDER_CONSTANT) -> np.ndarray:
    """Bilinear values of an image (H, W) or (H, W, C) at raster places (h, w, 2) or (N, 2); outside 0 by default."""
    places = np.ascontiguousarray(xy, dtype=np.float32) - np.float32(0.5)
    places = places if places.ndim == 3 else places[:, None]
    out = cv2.remap(image, places, None, cv2.INTER_LINEAR, borderMode=border)
    return out.reshape(*xy.shape[:-1], *image.shape[2:])


class Matcher:
    """Finds a grid's places in other frames. Holds DIS instances, so one per thread."""

    def __init__(self) -> None:
        self._fine, self._coarse = _dis(0), _dis(1)

    def link(self, layer: Layer, grid: Grid, t: int, predicted: np.ndarray, fine: bool = False) -> Link:
        """Match a grid to frame t, starting from a predicted map.

        Args:
            layer: the object.
            grid: its places in some frame.
            t: the frame to match to.
            predicted: (h, w, 2) float32 where each place is expected in frame t, defined on the whole grid.
            fine: flow at the grid's full resolution, for the last pass.
        """
        shade = sample(layer.shade[t], predicted)
        seen = sample(layer.mask[t].astype(np.float32), predicted)
        source, target = _common(grid, shade, seen)
        h, w = grid.inside.shape
        dis = self._coarse if max(h, w) >= _LARGE and not fine else self._fine
        forward, backward = dis.calc(source, target, None), dis.calc(target, source, None)
        cells = np.stack(np.meshgrid(np.arange(w), np.arange(h)), axis=-1).astype(np.float32)
        reached = cells + forward
        error = np.linalg.norm(forward + _at(backward, reached), axis=-1) * grid.step
        alike = np.abs(_at(shade.astype(np.float32), reached) - grid.shade)
        solid = (_at(seen, reached) > _MASK_FULL) & (_eroded(grid.inside))
        weight = solid * np.exp(-((error / 0.8) ** 2)) * np.exp(-((cv2.blur(alike, (5, 5)) / 30.0) ** 2))
        weight *= np.clip(2.5 * weight.sum() / max(float(solid.sum()), 1.0) - 0.5, 0.0, 1.0)
        share = weight.sum() / max(float(grid.inside.sum()), 1.0)
        return Link(_at(predicted, reached), weight.astype(np.float32), float(share))


def _dis(finest: int) -> cv2.DISOpticalFlow:
    """Dense inverse search that ends at a pyramid level: level 1 takes a third of the time of level 0."""
    dis = cv2.DISOpticalFlow_create(cv2.DISOPTICAL_FLOW_PRESET_MEDIUM)
    dis.setFinestScale(finest)
    dis.setPatchSize(8)
    dis.setPatchStride(4)
    dis.setVariationalRefinementIterations(3)
    return dis


def _common(grid: Grid, shade: np.ndarray, seen: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Both images with everything that is not the object, in either of them, set to mid-grey."""
    source = np.where(grid.inside, grid.shade, 128).astype(np.uint8)
    target = np.where(seen > 0.5, shade, 128).astype(np.uint8)
    return source, target


def _at(field: np.ndarray, cells: np.ndarray) -> np.ndarray:
    """Bilinear values of a grid field at cell coordinates (centres at integers), border replicated."""
    return cv2.remap(field, cells.astype(np.float32), None, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)


def _eroded(mask: np.ndarray) -> np.ndarray:
    """A mask without its rim of two cells."""
    return cv2.erode(mask.astype(np.uint8), np.ones((5, 5), np.uint8), borderValue=0) > 0
