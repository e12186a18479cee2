"""Integer search of an object's place in another frame, by texture and mask overlap."""

from __future__ import annotations

import cv2
import numpy as np

from genmojo_core.trackers.stabilise import Grid, Layer, sample

_CELLS = 40  # pixels of the object's longer side while searching
_REACH = 0.6  # search radius in object sizes


def best_shifts(layer: Layer, grid: Grid, t: int, predicted: np.ndarray, count: int = 2) -> list[np.ndarray]:
    """The most plausible shifts (2,) in pixels of frame t, to be added to a predicted map.

    Args:
        layer: the object. grid: its places in some frame. t: frame to search.
        predicted: (h, w, 2) raster pixels where the places are expected.
        count: how many peaks, best first.

    A shift is scored by agreement of shade where both are the object, overlap of the masks, and against places that
    would lie on the background (those behind another object count as unknown).
    """
    h, w = grid.inside.shape
    reach = _REACH * max(h, w)
    step = max(h, w) / _CELLS
    cells = _extended(predicted, reach, step)
    mask = sample(layer.mask[t].astype(np.float32), cells)
    other = sample(layer.other[t].astype(np.float32), cells)
    shade = (sample(layer.shade[t].astype(np.float32), cells) - 128.0) / 40.0 * mask
    size = (max(int(round(w / step)), 4), max(int(round(h / step)), 4))
    inside = cv2.resize(grid.inside.astype(np.float32), size, interpolation=cv2.INTER_AREA)
    own = (cv2.resize(grid.shade.astype(np.float32), size, interpolation=cv2.INTER_AREA) - 128.0) / 40.0 * inside
    background = np.clip(1.0 - mask - other, 0.0, 1.0)
    texture = cv2.matchTemplate(shade.astype(np.float32), own.astype(np.float32), cv2.TM_CCORR)
    overlap = cv2.matchTemplate((mask - background).astype(np.float32), inside, cv2.TM_CCORR)
    energy = max(float((own**2).sum()), 1e-3)
    score = texture / energy + overlap / max(float(inside.sum()), 1e-3)
    origin = (np.array([score.shape[1], score.shape[0]]) - 1) / 2.0
    scale = _pixels_per_cell(predicted) * step
    return [(peak - origin) * scale for peak in _peaks(score, count)]


def _extended(predicted: np.ndarray, reach: float, step: float) -> np.ndarray:
    """The predicted map's affine part on a coarser grid that is `reach` cells wider on every side."""
    h, w = predicted.shape[:2]
    scale = _pixels_per_cell(predicted)
    centre = predicted.reshape(-1, 2).mean(axis=0)
    xs = np.arange(-(w / 2 + reach) + step / 2, w / 2 + reach, step)
    ys = np.arange(-(h / 2 + reach) + step / 2, h / 2 + reach, step)
    return (np.stack(np.meshgrid(xs, ys), axis=-1) * scale + centre).astype(np.float32)


def _pixels_per_cell(predicted: np.ndarray) -> float:
    """Mean pixels between neighbouring places of a map."""
    across = np.linalg.norm(np.diff(predicted, axis=1), axis=-1).mean()
    down = np.linalg.norm(np.diff(predicted, axis=0), axis=-1).mean()
    return float((across + down) / 2)


def _peaks(score: np.ndarray, count: int) -> list[np.ndarray]:
    """Places (x, y) of the highest values that are at least three cells apart, refined by a parabola."""
    left = score.copy()
    found = []
    for _ in range(count):
        y, x = np.unravel_index(int(np.argmax(left)), left.shape)
        found.append(np.array([x + _vertex(score[y], int(x)), y + _vertex(score[:, x], int(y))], np.float64))
        left[max(y - 3, 0) : y + 4, max(x - 3, 0) : x + 4] = -np.inf
    return found


def _vertex(line: np.ndarray, at: int) -> float:
    """Offset in -0.5..0.5 of the top of a parabola through three neighbours; 0 at the ends."""
    if not 0 < at < len(line) - 1:
        return 0.0
    before, here, after = (float(v) for v in line[at - 1 : at + 2])
    bend = before - 2.0 * here + after
    return float(np.clip(0.5 * (before - after) / bend, -0.5, 0.5)) if bend < 0 else 0.0
