"""Points of the background followed through a clip (Lucas-Kanade, there and back), outside the masks."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

_WANTED = 200  # points alive in a frame; new ones are sought when under 60 % of the start's are left
_WINDOW = (15, 15)
_NOISE = 3.0  # grey levels that are no texture
_STRAY = 2.0  # pixels: how far the look in a point's first frame may pull it from where it was followed to


@dataclass(frozen=True)
class PointPaths:
    """N points in T frames.

    Args:
        xy: (N, T, 2) float64 raster pixels, NaN where a point is not seen. start: (N,) int, its first frame.
    """

    xy: np.ndarray
    start: np.ndarray

    def at_start(self) -> np.ndarray:  # (N, 2)
        """Where every point was in its first frame."""
        return self.xy[np.arange(len(self.start)), self.start]

    def seen(self) -> np.ndarray:  # (N, T) bool
        """Which points are seen in which frames."""
        seen: np.ndarray = np.isfinite(self.xy[..., 0])
        return seen


def follow_background(frames: np.ndarray, free: np.ndarray) -> PointPaths:
    """Follow corners of (T, H, W, 3) uint8 frames on pixels `free` (T, H, W) bool.

    A point is followed frame to frame and then matched with its look in its first frame, so it does not drift; it ends
    where the way back does not close, at the border and on an object.
    """
    greys = [even_light(cv2.cvtColor(frame, cv2.COLOR_RGB2GRAY)) for frame in frames]
    first = _corners(greys[0], free[0], np.zeros((0, 2)))
    columns = [np.full((len(first), 2), np.nan) for _ in greys]
    columns[0] = first
    starts = np.zeros(len(first), int)
    for t in range(1, len(greys)):
        current = np.full((len(starts), 2), np.nan)
        alive = np.flatnonzero(np.isfinite(columns[t - 1][:, 0]))
        for s in np.unique(starts[alive]):
            chosen = alive[starts[alive] == s]
            found, ok = _follow((greys[s], greys[t - 1], greys[t]), columns[s][chosen], columns[t - 1][chosen])
            ok &= _lies_on(free[t], found)
            current[chosen[ok]] = found[ok]
        columns[t] = current
        left = int(np.isfinite(current[:, 0]).sum())
        if left < 0.6 * min(_WANTED, max(len(first), 50)) and t < len(greys) - 1:
            new = _corners(greys[t], free[t], current[np.isfinite(current[:, 0])])[: _WANTED - left]
            columns = [np.vstack([c, np.full((len(new), 2), np.nan)]) for c in columns]
            columns[t][len(starts) :] = new
            starts = np.concatenate([starts, np.full(len(new), t)])
    return PointPaths(np.stack(columns, axis=1), starts)


def drift(paths: PointPaths) -> np.ndarray:  # (T, 2) pixels
    """How far the background as a whole went from where it was in frame 0: the median over points, chained."""
    seen, moved = paths.seen(), np.zeros((paths.xy.shape[1], 2))
    way = paths.xy - paths.at_start()[:, None]
    for t in range(1, len(moved)):
        alive = seen[:, t] & (paths.start < t)
        moved[t] = moved[t - 1]
        if alive.any():
            moved[t] = np.median(way[alive, t] + moved[paths.start[alive]], axis=0)
    return moved


def even_light(grey: np.ndarray) -> np.ndarray:  # (H, W) uint8 -> (H, W) uint8
    """The picture with local brightness and contrast evened, so that a setting sun does not move points."""
    sigma = max(3.0, min(grey.shape) / 24)
    values = grey.astype(np.float32)
    flat = values - cv2.GaussianBlur(values, (0, 0), sigma)
    contrast = np.sqrt(cv2.GaussianBlur(flat * flat, (0, 0), sigma)) + _NOISE
    return np.clip(128 + 45 * flat / contrast, 0, 255).astype(np.uint8)


def _follow(
    greys: tuple[np.ndarray, np.ndarray, np.ndarray], at_start: np.ndarray, current: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:  # (N, 2), (N,) bool
    """Points of the frame before followed into this one; `greys` are their first frame, the one before, this one."""
    first, before, now = greys
    step, ok, _ = cv2.calcOpticalFlowPyrLK(before, now, _cv(current), _cv(current), winSize=_WINDOW, maxLevel=3)
    near = {"winSize": _WINDOW, "maxLevel": 0}
    found, ok_first, _ = cv2.calcOpticalFlowPyrLK(
        first, now, _cv(at_start), step.copy(), **near, flags=cv2.OPTFLOW_USE_INITIAL_FLOW
    )
    astray = (np.linalg.norm(found - step, axis=-1).ravel() > _STRAY) | (ok_first.ravel() == 0)
    found = np.where(astray[:, None, None], step, found)
    back, ok_back, _ = cv2.calcOpticalFlowPyrLK(
        now, before, found, _cv(current).copy(), **near, flags=cv2.OPTFLOW_USE_INITIAL_FLOW
    )
    closed = np.linalg.norm(back - _cv(current), axis=-1).ravel() < 1.0
    return found[:, 0].astype(np.float64) + 0.5, (ok.ravel() > 0) & (ok_back.ravel() > 0) & closed


def _corners(grey: np.ndarray, allowed: np.ndarray, taken: np.ndarray) -> np.ndarray:  # (N, 2) raster px
    """Corners to follow, not near points already taken (M, 2); pixel centres are at + 0.5."""
    spacing = max(3, min(grey.shape) // 40)
    mask = allowed.astype(np.uint8)
    for x, y in taken:
        cv2.circle(mask, (int(x), int(y)), spacing, 0, -1)
    found = cv2.goodFeaturesToTrack(grey, _WANTED, 0.005, spacing, mask=mask)
    return np.zeros((0, 2)) if found is None else found[:, 0].astype(np.float64) + 0.5


def _cv(points: np.ndarray) -> np.ndarray:  # (N, 2) raster px -> (N, 1, 2) OpenCV's pixel-centre coordinates
    """Points as OpenCV's trackers want them."""
    return np.ascontiguousarray(points[:, None] - 0.5, dtype=np.float32)


def _lies_on(allowed: np.ndarray, points: np.ndarray) -> np.ndarray:  # (H, W) bool, (N, 2) -> (N,) bool
    """Which points are inside the image and on allowed pixels."""
    h, w = allowed.shape
    column, row = np.floor(points[:, 0]).astype(int), np.floor(points[:, 1]).astype(int)
    inside = (column >= 0) & (column < w) & (row >= 0) & (row < h)
    return inside & allowed[np.clip(row, 0, h - 1), np.clip(column, 0, w - 1)]
