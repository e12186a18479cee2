"""Whether tracked points are seen: by masks, by the picture's border, and by what their own pixels look like."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from genmojo_core.trackers.guide import Guide
from genmojo_core.trackers.object_motion import ObjectMotion
from genmojo_core.trackers.stabilise import sample
from genmojo_core.tracks.annotation import CONFIRMED, KEY, PAINTED, Cells
from genmojo_core.tracks.model import NONE, OCCLUDED, OUT_OF_VIEW, VISIBLE

_SPANS = (1, 2, 4)
_AROUND = np.array([[0, 0], [1, 0], [-1, 0], [0, 1], [0, -1]], np.float32)  # held px: masks are good to a pixel
_BORDER = 3  # held px: masks often end just before it


def states_of(
    motion: ObjectMotion, xy: np.ndarray, cells: Sequence[Cells], size: tuple[int, int], guide: Guide | None = None
) -> tuple[np.ndarray, np.ndarray]:  # (n, T, 2) held px -> (n, T) uint8, (n, T) float32
    """States and confidences of n points; what a person said about a state is returned as it is.

    A point on its object's visible mask counts as seen: that links lose it says little (measured on clips with truth,
    they would be wrong four times as often as right). Only a guide knows of an object's far side, hidden behind the
    object's own mask. The confidence is the share of links that agree with the place.
    """
    state = np.stack([states_in(motion, t, xy[:, t], size) for t in range(motion.frames)], axis=1)
    if guide is not None:
        state = np.where(guide.on & (guide.state == OCCLUDED) & (state == VISIBLE), OCCLUDED, state).astype(np.uint8)
    flags, stands = np.stack([c.flags for c in cells]), np.stack([c.state for c in cells])
    said = ((flags & (KEY | PAINTED | CONFIRMED)) > 0) & (stands != NONE)
    conf = np.where((flags & KEY) > 0, 1.0, agreement(motion, xy)).astype(np.float32)
    return np.where(said, stands, state), conf


def states_in(motion: ObjectMotion, t: int, xy: np.ndarray, size: tuple[int, int]) -> np.ndarray:  # (n,) uint8
    """States in frame t of points at held px (n, 2), by the masks and the picture's border alone."""
    gone = _absent(motion, t)
    if gone is not None:
        return np.full(len(xy), gone, np.uint8)
    outside = ((xy < 0) | (xy > np.array(size))).any(axis=1)
    around = np.asarray(xy, np.float32)[:, None] + _AROUND
    on_mask = sample(motion.layer.mask[t].astype(np.float32), around).max(axis=1) > 0.5
    return np.where(outside, OUT_OF_VIEW, np.where(on_mask, VISIBLE, OCCLUDED)).astype(np.uint8)


def _absent(motion: ObjectMotion, t: int) -> int | None:
    """The state of all points of an object that no mask shows in frame t; None where one does.

    NONE where no mask is known. The object is out of view before it is first seen, and where it left or comes in by the
    border of the picture; elsewhere something hides it.
    """
    if not motion.known[t]:
        return NONE
    if motion.areas[t] > 0:
        return None
    seen = np.flatnonzero(motion.areas > 0)
    before, after = seen[seen < t][-1:].tolist(), seen[seen > t][:1].tolist()
    if not before or any(_at_border(motion.layer.mask[s]) for s in before + after):
        return OUT_OF_VIEW
    return OCCLUDED


def _at_border(mask: np.ndarray) -> bool:
    """Whether a mask (H, W) comes to a pixel or two of the picture's border."""
    return bool(mask[:_BORDER].any() or mask[-_BORDER:].any() or mask[:, :_BORDER].any() or mask[:, -_BORDER:].any())


def agreement(motion: ObjectMotion, xy: np.ndarray) -> np.ndarray:  # (n, T, 2) -> (n, T) 0..1
    """How well the best of the links from frames nearby agrees with every place."""
    support = np.zeros(xy.shape[:2])
    for t in range(motion.frames):
        for s in [t + sign * span for span in _SPANS for sign in (-1, 1)]:
            carried = motion.carry(s, t, xy[:, s]) if 0 <= s < motion.frames else None
            if carried is not None:
                gap = np.linalg.norm(carried[0] - xy[:, t], axis=1)
                support[:, t] = np.maximum(support[:, t], carried[1] * np.exp(-((gap / 1.5) ** 2)))
    return support
