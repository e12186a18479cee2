"""Figures of candidate objects that help to choose: size, motion, how long they are seen, how often hidden. No Qt."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from genmojo_core.clip.clip import Clip

SMALL, STATIC, HIDDEN = 0.0015, 0.3, 0.34  # shares of the frame, pixels per frame at 1080 lines, share of frames
COVERED = 0.5  # share of the frames in which it is seen
_SHOWN = 0.6  # of its usual area: under this an object counts as partly hidden
_USUAL = 95  # percentile of its area, growth apart, that counts as what it shows when nothing hides it
_SIDE = 240  # pixels of the short side at which the camera's motion is looked for
_CORNERS, _LEAST = 200, 12  # corners that are followed, and that must have been found again


@dataclass(frozen=True)
class Figures:
    """One object over a clip.

    Args:
        first: first frame (0-based) with a pixel of it, -1 if there is none.
        size: median share of the frame's area where it is seen. motion: median speed of its centre against the
        background in pixels per frame of a clip 1080 lines high, 0 if it is seen once only. seen: share of the frames
        with masks in which it has any pixel. covered: share of those in which it is smaller than `_SHOWN` of its usual
        area; steady growth, as of what comes nearer, does not count.
        advice: "small", "static", "hidden", "covered", or "" where nothing speaks against it.
    """

    first: int
    size: float
    motion: float
    seen: float
    covered: float
    advice: str


def all_figures(clip: Clip, known: np.ndarray, camera: np.ndarray) -> dict[int, Figures]:
    """Figures of every object of a clip with masks, by id; `known` and `camera` as for `figures`."""
    if clip.masks is None:
        return {}
    return {int(i): figures(clip.masks.value, k + 1, known, camera) for k, i in enumerate(clip.object_ids)}


def figures(
    labels: np.ndarray,  # (T, H, W)
    label: int,
    known: np.ndarray | None = None,  # (T,) bool, frames for which somebody gave masks; all by default
    camera: np.ndarray | None = None,  # (T, 3, 3) as `camera_path`; a camera at rest by default
) -> Figures:
    """Figures of one label in masks."""
    frames, height, width = labels.shape
    camera = np.repeat(np.eye(3)[None], frames, axis=0) if camera is None else camera
    masks = labels == label
    area = masks.reshape(frames, -1).sum(axis=1)
    there = np.flatnonzero(area)
    if not len(there):
        return Figures(-1, 0.0, 0.0, 0.0, 0.0, "hidden")
    rows, columns = masks.sum(axis=2)[there], masks.sum(axis=1)[there]
    centre = np.stack([columns @ np.arange(width), rows @ np.arange(height)], axis=1) / area[there, None] + 0.5
    steps = np.diff(there)
    expected = [_seen_from(camera, there[n], there[n + 1], centre[n]) for n in range(len(steps))]
    moved = [np.hypot(*(now - then)) for now, then in zip(centre[1:], expected, strict=True)]
    motion = float(np.median(np.array(moved) / steps)) * 1080 / height if len(steps) else 0.0
    size = float(np.median(area[there])) / (height * width)
    seen = len(there) / (frames if known is None else int((known | (area > 0)).sum()))
    covered = _covered(there, area[there])
    still = len(steps) > 0 and motion < STATIC
    advice = ("small" if size < SMALL else "hidden" if seen < HIDDEN else "covered" if covered > COVERED
              else "static" if still else "")  # fmt: skip
    return Figures(int(there[0]), size, motion, seen, covered, advice)


def camera_path(clip: Clip) -> np.ndarray:  # (T, 3, 3)
    """Where the background of frame 0 lies in every frame, in raster pixels of the frames held: a similarity each.

    Corners beside all objects are followed from frame to frame; where too few are found the camera is taken to rest.
    """
    height, width = clip.frames.shape[1:3]
    scale = min(1.0, _SIDE / min(height, width))
    size = max(1, round(width * scale)), max(1, round(height * scale))
    small = [cv2.resize(cv2.cvtColor(f, cv2.COLOR_RGB2GRAY), size, interpolation=cv2.INTER_AREA) for f in clip.frames]
    free = np.full((len(clip), size[1], size[0]), 255, np.uint8)
    if clip.masks is not None:
        for t, labels in enumerate(clip.masks.value):
            objects = cv2.resize((labels > 0).astype(np.uint8), size, interpolation=cv2.INTER_NEAREST)
            free[t] = np.where(cv2.dilate(objects, np.ones((5, 5), np.uint8)) > 0, 0, 255)
    shrink = np.diag([size[0] / width, size[1] / height, 1.0])
    path = [np.eye(3)]
    for t in range(len(clip) - 1):
        step = np.linalg.inv(shrink) @ _camera_step(small[t], small[t + 1], free[t]) @ shrink
        path.append(step @ path[-1])
    return np.stack(path)


def _camera_step(before: np.ndarray, now: np.ndarray, free: np.ndarray) -> np.ndarray:  # (h, w) uint8 each -> (3, 3)
    """The background's similarity from one frame to the next, in raster pixels."""
    step = np.eye(3)
    corners = cv2.goodFeaturesToTrack(before, _CORNERS, 0.01, 5, mask=free)
    if corners is None or len(corners) < _LEAST:
        return step
    found, good, _ = cv2.calcOpticalFlowPyrLK(before, now, corners, None)
    good = good[:, 0] > 0
    if good.sum() < _LEAST:
        return step
    there, here = corners[good, 0] + 0.5, found[good, 0] + 0.5
    fitted, inliers = cv2.estimateAffinePartial2D(there, here, ransacReprojThreshold=1.0)
    if fitted is not None and inliers.sum() >= _LEAST:
        step[:2] = fitted
    return step


def _seen_from(camera: np.ndarray, before: int, now: int, xy: np.ndarray) -> np.ndarray:  # (2,)
    """Where a place of the background in one frame lies in a later one."""
    moved = camera[now] @ np.linalg.solve(camera[before], np.array([xy[0], xy[1], 1.0]))
    return np.asarray(moved[:2])


def _covered(there: np.ndarray, area: np.ndarray) -> float:
    """Share of the frames `there` in which the area is far under what is usual, growth at a steady rate apart."""
    level = np.log(area)
    if len(there) > 2:
        level = level - np.median(np.diff(level) / np.diff(there)) * there
    return float((level < np.percentile(level, _USUAL) + np.log(_SHOWN)).mean())
