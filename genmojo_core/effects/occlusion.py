"""Who covers whom, and when: from the masks where objects touch, and their depth there."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from genmojo_core.clip.clip import Clip
from genmojo_core.effects.objects import REACH
from genmojo_core.estimate.order import front_votes

_BAND = 2 * REACH + 1  # pixels on either side of a contact whose depth is compared


@dataclass(frozen=True)
class Cover:
    """Object `front` lies before object `back` where they touch, in `frames` (positions in the clip)."""

    front: int
    back: int
    frames: tuple[int, ...]


def occlusion_graph(clip: Clip) -> tuple[Cover, ...]:
    """Every pair of objects that touch, the one in front first; a pair that changes places gives two entries.

    Measured depth decides; where depth is a guess or says nothing, motion, outlines and ground do (estimate/order.py).
    """
    if clip.masks is None or clip.objects < 2:
        return ()
    labels = np.where(clip.masks.valid, clip.masks.value, 0)
    still = np.zeros((*labels.shape, 2), np.float32)
    votes = front_votes(labels, clip.objects, still if clip.flow is None else clip.flow.value)
    found: dict[tuple[int, int], list[int]] = {}
    for t in range(len(clip)):
        for i in range(clip.objects):
            for j in range(i + 1, clip.objects):
                contact = _contact(labels[t], i, j)
                if contact is None:
                    continue
                vote = _nearer(clip, t, contact) if clip.depth is not None and clip.depth.given else 0.0
                vote = vote or float(votes[t, i, j])
                pair = (i, j) if vote >= 0 else (j, i)
                found.setdefault(pair, []).append(t)
    return tuple(Cover(i, j, tuple(frames)) for (i, j), frames in sorted(found.items(), key=lambda item: item[1]))


def _contact(labels: np.ndarray, i: int, j: int) -> tuple[np.ndarray, np.ndarray] | None:
    """Pixels of either object near the other, (H, W) bool each; None if they do not touch."""
    one, other = labels == i + 1, labels == j + 1
    if not (one.any() and other.any()):
        return None
    reach = np.ones((2 * REACH + 1, 2 * REACH + 1), np.uint8)
    if not (cv2.dilate(one.astype(np.uint8), reach)[other] > 0).any():
        return None
    band = np.ones((2 * _BAND + 1, 2 * _BAND + 1), np.uint8)
    return (one & (cv2.dilate(other.astype(np.uint8), band) > 0), other & (cv2.dilate(one.astype(np.uint8), band) > 0))


def _nearer(clip: Clip, t: int, contact: tuple[np.ndarray, np.ndarray]) -> float:
    """Positive if the first object's side of a contact is nearer; 0 where depth is not known."""
    depth, valid = clip.depth.value[t], clip.depth.valid[t]  # type: ignore[union-attr]
    sides = [depth[side & valid] for side in contact]
    if not all(len(side) for side in sides):
        return 0.0
    return float(np.median(sides[1]) - np.median(sides[0]))
