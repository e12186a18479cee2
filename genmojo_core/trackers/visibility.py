"""Whether a tracked point is seen: by masks, by the picture's border, and by what its own pixels look like."""

from __future__ import annotations

import numpy as np

from genmojo_core.trackers.object_motion import ObjectMotion
from genmojo_core.trackers.stabilise import sample
from genmojo_core.tracks.annotation import CONFIRMED, KEY, PAINTED, Cells
from genmojo_core.tracks.model import NONE, OCCLUDED, OUT_OF_VIEW, VISIBLE

_SPANS = (1, 2, 4)
_AROUND = np.array([[0, 0], [1, 0], [-1, 0], [0, 1], [0, -1]], np.float32)  # held px: masks are good to a pixel


def states_of(
    motion: ObjectMotion, xy: np.ndarray, cells: Cells, size: tuple[int, int]
) -> tuple[np.ndarray, np.ndarray]:  # (T, 2) held px -> (T,) uint8, (T,) float32
    """States and confidences of one point; what a person said about a state is returned as it is.

    A point on its object's visible mask counts as seen: that links lose it says little (measured on clips with truth,
    they would be wrong four times as often as right). The confidence is the share of links that agree with the place.
    """
    state = np.array([state_in(motion, t, xy[t], size) for t in range(motion.frames)], np.uint8)
    said = ((cells.flags & (KEY | PAINTED | CONFIRMED)) > 0) & (cells.state != NONE)
    state[said] = cells.state[said]
    sure = (cells.flags & KEY) > 0
    return state, np.where(sure, 1.0, agreement(motion, xy)).astype(np.float32)


def state_in(motion: ObjectMotion, t: int, xy: np.ndarray, size: tuple[int, int]) -> int:
    """State in frame t of a point at held px (2,), by the masks and the picture's border alone."""
    if ((xy < 0) | (xy > np.array(size))).any():
        return OUT_OF_VIEW
    on_mask = sample(motion.layer.mask[t].astype(np.float32), xy + _AROUND).max() > 0.5
    return VISIBLE if on_mask else OCCLUDED


def agreement(motion: ObjectMotion, xy: np.ndarray) -> np.ndarray:  # (T, 2) -> (T,) 0..1
    """How well the best of the links from frames nearby agrees with every place."""
    support = np.zeros(motion.frames)
    for t in range(motion.frames):
        for s in [t + sign * span for span in _SPANS for sign in (-1, 1)]:
            carried = motion.carry(s, t, xy[s : s + 1]) if 0 <= s < motion.frames else None
            if carried is not None:
                gap = float(np.linalg.norm(carried[0][0] - xy[t]))
                support[t] = max(support[t], float(carried[1][0]) * float(np.exp(-((gap / 1.5) ** 2))))
    return support
