"""Does the light change? Brightness followed along the flow, region by region, over the whole clip."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from genmojo_core.clip.clip import Clip
from genmojo_core.estimate.flow import warp

_DARKEST, _BRIGHTEST = 24, 235  # brightness outside is noise or clipped
_FEWEST_PIXELS = 50
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
    """Measure; regions too small or without valid flow count as unchanged, and so does a single frame."""
    steps = np.zeros((len(clip), clip.objects + 1))
    if clip.flow is None or clip.masks is None:
        return LightChange(0.0, np.zeros(clip.objects))
    kernel = np.ones((3, 3), np.uint8)
    grey = [cv2.cvtColor(frame, cv2.COLOR_RGB2GRAY).astype(np.float32) for frame in clip.frames]
    for t in range(len(clip) - 1):
        after = warp(grey[t + 1], clip.flow.value[t])
        usable = clip.flow.valid[t] & clip.masks.valid[t] & (grey[t] > _DARKEST) & (grey[t] < _BRIGHTEST)
        usable &= (after > _DARKEST / 2) & (after < 0.5 * (_BRIGHTEST + 255))
        change = np.log(np.maximum(after, 1.0)) - np.log(np.maximum(grey[t], 1.0))
        for label in range(clip.objects + 1):
            inside = cv2.erode((clip.masks.value[t] == label).astype(np.uint8), kernel) > 0
            steps[t + 1, label] = _usual_change(change[inside & usable], int(inside.sum()))
    level = np.cumsum(steps, axis=0)
    change = 1.0 - np.exp(level.min(axis=0) - level.max(axis=0))
    return LightChange(float(change[0]), change[1:])


def _usual_change(values: np.ndarray, pixels: int) -> float:
    """Mean of the changes near their median: unlike the median itself it sees steps below one grey level.

    0 where flow holds in less than half of the region's pixels: the rest is chance (an object passing behind another).
    """
    if len(values) < max(_FEWEST_PIXELS, 0.5 * pixels):
        return 0.0
    middle = float(np.median(values))
    return float(values[np.abs(values - middle) <= _STRAY].mean())
