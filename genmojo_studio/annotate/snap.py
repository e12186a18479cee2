"""Where near a click a point looks most like it did in another frame: normalised correlation to a part of a pixel.

No Qt. The place is only proposed; a person sees it before it counts.
"""

from __future__ import annotations

import cv2
import numpy as np

SIDE = 15  # pixels of the picture compared
REACH = 10  # pixels searched on every side
LEAST = 0.75  # correlation below which nothing is proposed


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


def _grey(frame: np.ndarray, xy: tuple[float, float], side: int) -> np.ndarray:
    """A (side, side) uint8 patch around a raster place, interpolated; the rim of the frame is continued."""
    reach = side // 2 + 2
    x0, y0 = int(xy[0]) - reach, int(xy[1]) - reach
    height, width = frame.shape[:2]
    columns = np.clip(np.arange(x0, x0 + 2 * reach + 2), 0, width - 1)
    rows = np.clip(np.arange(y0, y0 + 2 * reach + 2), 0, height - 1)
    grey = cv2.cvtColor(np.ascontiguousarray(frame[rows[:, None], columns]), cv2.COLOR_BGRA2GRAY)
    return np.asarray(cv2.getRectSubPix(grey, (side, side), (xy[0] - 0.5 - x0, xy[1] - 0.5 - y0)))


def _peak(values: np.ndarray) -> float:
    """Offset -0.5..0.5 of the top of a parabola through three values; 0 at a rim."""
    if len(values) < 3:
        return 0.0
    bend = values[0] - 2 * values[1] + values[2]
    return float(np.clip((values[0] - values[2]) / (2 * bend), -0.5, 0.5)) if abs(bend) > 1e-9 else 0.0
