"""Depth that breathes from frame to frame brought to rest: the background must not move along the viewing axis.

Estimators that see one frame at a time give every frame a scale of its own, and objects then jump to and fro (the
paper's second limitation). The ratio of neighbouring frames' depths at static background, carried by the cameras, tells
each frame's scale against the next. A steady drift is left: wrong cameras look the same, and it makes nothing jump.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from genmojo_core.clip.cameras import Cameras
from genmojo_core.clip.clip import Channel, Clip
from genmojo_core.sentences import say

LEAST_JITTER = 0.005  # standard deviation of the log scales from which depth is corrected: measured depth has less
_LEAST_PIXELS = 64  # of background in both frames, below which a pair says nothing
_STEP = 2  # every so many pixels are asked


def without_jitter(clip: Clip, free: np.ndarray) -> Clip:  # free (T, H, W) bool: background
    """The clip with one factor per frame on its depth where its scale jitters; the same clip where it does not.

    Args:
        clip: with cameras; without depth it is returned as it is. free: pixels surely of the background.
    """
    if clip.depth is None or clip.cameras is None or len(clip) < 3:
        return clip
    jitter = log_scales(clip.depth, clip.cameras.value, free)
    if float(jitter.std()) < LEAST_JITTER:
        return clip
    value = (clip.depth.value * np.exp(-jitter)[:, None, None]).astype(np.float32)
    percent = 100.0 * float(np.abs(np.diff(jitter)).max())
    sentence = say("depth_steadied", percent=percent)
    depth = replace(clip.depth, value=value, source=f"{clip.depth.source}, steadied")
    return clip.with_channels(depth=depth, guesses=(*clip.guesses, sentence))


def log_scales(depth: Channel, cameras: Cameras, free: np.ndarray) -> np.ndarray:  # (T,)
    """Logarithm of every frame's depth scale about a straight line over time; pairs that say nothing count as equal."""
    steps = [_ratio(depth, cameras, free, t) for t in range(len(depth.value) - 1)]
    scales = np.concatenate([[0.0], np.cumsum(steps)])
    times = np.arange(len(scales))
    return scales - np.polyval(np.polyfit(times, scales, 1), times)


def _ratio(depth: Channel, cameras: Cameras, free: np.ndarray, t: int) -> float:
    """Log of frame t + 1's depth scale over frame t's: median over background pixels."""
    now, after = cameras.view(t), cameras.view(t + 1)
    height, width = depth.value.shape[1:]
    grid = np.zeros((height, width), bool)
    grid[::_STEP, ::_STEP] = True
    row, column = np.nonzero(grid & free[t] & depth.valid[t])
    z = depth.value[t, row, column].astype(np.float64)
    camera = np.stack([(column + 0.5 - now.cx) / now.fx * z, (row + 0.5 - now.cy) / now.fy * z, z], axis=-1)
    move = after.world_to_camera @ np.linalg.inv(now.world_to_camera)
    there = camera @ move[:3, :3].T + move[:3, 3]
    front = there[:, 2] > 1e-6 * np.abs(z)
    safe = np.where(front, there[:, 2], 1.0)
    place = np.floor(there[:, :2] / safe[:, None] * [after.fx, after.fy] + [after.cx, after.cy])
    inside = front & (z > 0) & (place >= 0).all(axis=1) & (place < [width, height]).all(axis=1)
    x, y = np.where(inside[:, None], place, 0).astype(np.int64).T
    found = depth.value[t + 1, y, x].astype(np.float64)
    good = inside & free[t + 1, y, x] & depth.valid[t + 1, y, x] & (found > 0)
    if good.sum() < _LEAST_PIXELS:
        return 0.0
    return float(np.median(np.log(found[good]) - np.log(there[good, 2])))
