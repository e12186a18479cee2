"""Figures of candidate objects that help to choose: size, motion, how long they are seen, how often hidden. No Qt."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

SMALL, STATIC, HIDDEN = 0.0015, 0.3, 0.34  # shares of the frame, pixels per frame at 1080 lines, share of frames
_COVERED = 0.6  # of its usual area: under this an object counts as partly hidden


@dataclass(frozen=True)
class Figures:
    """One object over a clip.

    Args:
        first: first frame (0-based) with a pixel of it, -1 if there is none.
        size: median share of the frame's area where it is seen. motion: median speed of its centre in pixels per
        frame of a clip 1080 lines high. seen: share of frames with any pixel. covered: share of those in which it is
        smaller than `_COVERED` of its usual area.
        advice: "small", "static", "hidden", or "" where nothing speaks against it.
    """

    first: int
    size: float
    motion: float
    seen: float
    covered: float
    advice: str


def figures(labels: np.ndarray, label: int) -> Figures:
    """Figures of one label in masks (T, H, W)."""
    frames, height, width = labels.shape
    masks = labels == label
    area = masks.reshape(frames, -1).sum(axis=1)
    there = np.flatnonzero(area)
    if not len(there):
        return Figures(-1, 0.0, 0.0, 0.0, 0.0, "hidden")
    rows, columns = masks.sum(axis=2), masks.sum(axis=1)
    safe = np.maximum(area, 1)
    centre = np.stack([columns @ np.arange(width) / safe, rows @ np.arange(height) / safe], axis=1)
    steps = np.diff(there)
    moved = np.hypot(*(np.diff(centre[there], axis=0) / steps[:, None]).T) if len(there) > 1 else np.zeros(1)
    motion = float(np.median(moved)) * 1080 / height
    usual = float(np.median(area[there]))
    size, seen = usual / (height * width), len(there) / frames
    covered = float((area[there] < _COVERED * np.percentile(area[there], 80)).mean())
    advice = "small" if size < SMALL else "hidden" if seen < HIDDEN else "static" if motion < STATIC else ""
    return Figures(int(there[0]), size, motion, seen, covered, advice)
