"""Does the background stand still, pixel by pixel? Only then may a run fit it once and hold it (optimise/still.py).

A camera that stands still is not enough: shadows, reflections and leaves move over the ground, and objects are judged
against it at their rims. Measured against the plate away from the objects, smoothed over a few pixels so that a
sensor's noise does not count.
"""

from __future__ import annotations

import cv2
import numpy as np

from genmojo_core.clip.clip import Clip

STILL = 1.0  # grey levels of 255: root mean square against the plate (48 dB: more than any run reaches)
STILL_SPOTS = 3.0  # grey levels that all but a hundredth of the pixels stay under: no shadow passes
WINDOW_MARGIN = 16  # pixels round the objects' masks that a window has, its grid included (optimise/still.py)
_SMOOTH = 2.0  # pixels: noise of 3 grey levels counts as 0.4
_FRAMES = 48  # of a long clip that are looked at, spread evenly
_RIM = 3  # pixels round the masks that are not judged: soft edges


def background_is_still(clip: Clip) -> bool:
    """True if a completed clip of several frames shows the same background in all of them, as its plate has it."""
    if len(clip) < 2 or clip.background is None or clip.cameras is None or clip.masks is None:
        return False
    w2c = clip.cameras.value.world_to_camera
    if not bool(np.all(np.abs(w2c - w2c[:1]) <= 1e-6 * max(1.0, float(np.abs(w2c).max())))):
        return False
    plate = clip.background.value.astype(np.float32)
    around = np.ones((2 * _RIM + 1, 2 * _RIM + 1), np.uint8)
    errors = []
    for t in np.unique(np.linspace(0, len(clip) - 1, min(len(clip), _FRAMES)).round().astype(int)):
        frame = clip.frames[t]
        free = (cv2.dilate((clip.masks.value[t] > 0).astype(np.uint8), around) == 0) & clip.masks.valid[t]
        smooth = cv2.GaussianBlur(frame.astype(np.float32) - plate, (0, 0), _SMOOTH)
        errors.append((smooth[free] ** 2).mean(axis=-1))
    squared = np.concatenate(errors)
    if not len(squared):
        return False
    return bool(squared.mean() <= STILL**2 and np.percentile(squared, 99) <= STILL_SPOTS**2)


def window_share(clip: Clip) -> float | None:
    """Mean share of the pixels round all objects, all that a step looks at where the background is still.

    None where it is not: steps look at whole frames.
    """
    if not background_is_still(clip) or clip.masks is None:
        return None
    width, height = clip.size
    shares = []
    for labels in clip.masks.value:
        rows, columns = np.flatnonzero(labels.any(axis=1)), np.flatnonzero(labels.any(axis=0))
        if len(rows):
            across = min(int(columns[-1]) + WINDOW_MARGIN, width) - max(int(columns[0]) - WINDOW_MARGIN, 0)
            down = min(int(rows[-1]) + WINDOW_MARGIN, height) - max(int(rows[0]) - WINDOW_MARGIN, 0)
            shares.append(across * down / (width * height))
    return float(np.mean(shares)) if shares else 1.0
