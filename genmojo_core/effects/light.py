"""Does the light change? Brightness followed along the flow, region by region, over the whole clip."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from genmojo_core.clip.clip import Clip
from genmojo_core.estimate.flow import warp

_DARKEST, _BRIGHTEST = 24, 235  # brightness outside is noise or clipped
_FEWEST_PIXELS = 300  # of a region: fewer make a chance walk over a long clip
_STRAY = 0.15  # log brightness: pixels further from the median change are highlights or wrong flow


@dataclass(frozen=True)
class LightChange:
    """Greatest change of brightness over the clip, as a share (0.25: the darkest moment has 75 % of the brightest).

    Args:
        background: of everything outside the objects. objects: (K,) of each object.
    """

    background: float
    objects: np.ndarray


def light_change(clip: Clip) -> LightChange:
    """Measure; a single frame counts as unchanged.

    So does a step of a region that is too small, or where flow holds in less than half of it: the rest is chance (an
    object passing behind another).
    """
    steps = np.zeros((len(clip), clip.objects + 1))
    if clip.flow is None or clip.masks is None:
        return LightChange(0.0, np.zeros(clip.objects))
    kernel = np.ones((3, 3), np.uint8)
    grey = [cv2.GaussianBlur(cv2.cvtColor(frame, cv2.COLOR_RGB2GRAY).astype(np.float32), (0, 0), 1.5)
            for frame in clip.frames]  # fmt: skip
    for t in range(len(clip) - 1):
        before, after = grey[t], warp(grey[t + 1], clip.flow.value[t])
        mean = 0.5 * (before + after)  # chosen by both alike, or the choice itself would look like a change
        usable = clip.flow.valid[t] & clip.masks.valid[t] & (mean > _DARKEST) & (mean < _BRIGHTEST)
        for label in range(clip.objects + 1):
            inside = cv2.erode((clip.masks.value[t] == label).astype(np.uint8), kernel) > 0
            chosen = inside & usable
            if chosen.sum() >= max(_FEWEST_PIXELS, 0.5 * inside.sum()):
                steps[t + 1, label] = log_gain(before[chosen], after[chosen])
    level = np.cumsum(steps, axis=0)
    change = 1.0 - np.exp(level.min(axis=0) - level.max(axis=0))
    return LightChange(float(change[0]), change[1:])


def log_gain(before: np.ndarray, after: np.ndarray) -> float:  # (N,), (N,) brightness > 0
    """Logarithm of the brightness gain that most pixels share, from the totals of those near the median change.

    Totals keep steps far below one grey level, which a median would round away, and do not drift by interpolation.
    """
    change = np.log(after) - np.log(before)
    usual = np.abs(change - np.median(change)) <= _STRAY
    return float(np.log(after[usual].sum(dtype=np.float64) / before[usual].sum(dtype=np.float64)))
