"""Where near a click a point looks most like it did in another frame, or where the nearest corner is.

Normalised correlation, and the point where all gradients around it meet (Förstner 1987), to a part of a pixel.
No Qt. The place is only proposed; a person sees it before it counts.
"""

from __future__ import annotations

import cv2
import numpy as np

SIDE = 15  # pixels of the picture compared
REACH = 10  # pixels searched on every side
LEAST = 0.75  # correlation below which nothing is proposed
CORNER_REACH = 6  # pixels searched for a corner
_CORNER = 3e-4  # smaller eigenvalue of OpenCV's structure tensor below which there is no corner: some 12 grey levels
_SHARE = 0.2  # of the strongest corner in reach: weaker ones are texture beside it


def snapped(
    source: np.ndarray,  # (H, W, 4) uint8, the frame that shows how it looked
    there: tuple[float, float],  # raster place in it
    frame: np.ndarray,  # (H, W, 4) uint8
    near: tuple[float, float],  # raster place to search around
) -> tuple[float, float] | None:
    """The raster place of the best likeness within `REACH` pixels, None where nothing is alike."""
    template = _grey(source, there, SIDE)
    area = _grey(frame, near, SIDE + 2 * REACH)
    if template.std() < 2:
        return None
    score = cv2.matchTemplate(area, template, cv2.TM_CCOEFF_NORMED)
    _, best, _, (x, y) = cv2.minMaxLoc(score)
    if best < LEAST:
        return None
    dx = _peak(score[y, max(x - 1, 0) : x + 2])
    dy = _peak(score[max(y - 1, 0) : y + 2, x])
    return near[0] + x + dx - REACH, near[1] + y + dy - REACH


def corner(
    frame: np.ndarray,  # (H, W, 4) uint8
    near: tuple[float, float],  # raster place to search around
) -> tuple[float, float] | None:
    """The raster place of the nearest corner within `CORNER_REACH` pixels, None where there is none."""
    reach = CORNER_REACH + 10
    x0, y0 = int(near[0]) - reach, int(near[1]) - reach
    grey = _cut(frame, x0, y0, 2 * reach + 1)
    strength = cv2.cornerMinEigenVal(grey, 5, ksize=3)
    rows, columns = np.nonzero((strength >= cv2.dilate(strength, np.ones((3, 3), np.uint8))) & (strength >= _CORNER))
    away = np.hypot(columns + 0.5 + x0 - near[0], rows + 0.5 + y0 - near[1])
    there = np.flatnonzero(away <= CORNER_REACH + 1)
    if not len(there):
        return None
    least = _SHARE * float(strength[rows[there], columns[there]].max())
    large = cv2.resize(cv2.GaussianBlur(grey, (0, 0), 0.7), None, fx=2, fy=2, interpolation=cv2.INTER_CUBIC)
    for k in there[np.argsort(away[there])]:
        dx, dy = _meeting(large, float(columns[k]), float(rows[k]))
        found = columns[k] + dx + 0.5 + x0, rows[k] + dy + 0.5 + y0
        close = np.hypot(found[0] - near[0], found[1] - near[1]) <= CORNER_REACH
        if close and strength[rows[k], columns[k]] >= least and max(abs(dx), abs(dy)) <= 2.5:
            return float(found[0]), float(found[1])
    return None


def _meeting(large: np.ndarray, x: float, y: float) -> tuple[float, float]:
    """Shift from a pixel to where the gradients around it meet, sought at twice the size: that halves the error."""
    start = np.array([[[2 * x + 0.5, 2 * y + 0.5]]], np.float32)
    stop = (cv2.TERM_CRITERIA_EPS + cv2.TERM_CRITERIA_MAX_ITER, 40, 0.005)
    at = cv2.cornerSubPix(large, start.copy(), (10, 10), (-1, -1), stop)
    return float(at[0, 0, 0] - start[0, 0, 0]) / 2, float(at[0, 0, 1] - start[0, 0, 1]) / 2


def _grey(frame: np.ndarray, xy: tuple[float, float], side: int) -> np.ndarray:
    """A (side, side) uint8 patch around a raster place, interpolated; the rim of the frame is continued."""
    reach = side // 2 + 2
    x0, y0 = int(xy[0]) - reach, int(xy[1]) - reach
    grey = _cut(frame, x0, y0, 2 * reach + 2)
    return np.asarray(cv2.getRectSubPix(grey, (side, side), (xy[0] - 0.5 - x0, xy[1] - 0.5 - y0)))


def _cut(frame: np.ndarray, x0: int, y0: int, side: int) -> np.ndarray:
    """(side, side) uint8 grey pixels of a frame from column x0 and row y0 on; the rim of the frame is continued."""
    height, width = frame.shape[:2]
    columns = np.clip(np.arange(x0, x0 + side), 0, width - 1)
    rows = np.clip(np.arange(y0, y0 + side), 0, height - 1)
    return cv2.cvtColor(np.ascontiguousarray(frame[rows[:, None], columns]), cv2.COLOR_BGRA2GRAY)


def _peak(values: np.ndarray) -> float:
    """Offset -0.5..0.5 of the top of a parabola through three values; 0 at a rim."""
    if len(values) < 3:
        return 0.0
    bend = values[0] - 2 * values[1] + values[2]
    return float(np.clip((values[0] - values[2]) / (2 * bend), -0.5, 0.5)) if abs(bend) > 1e-9 else 0.0
