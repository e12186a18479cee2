"""What the pictures say about tracks as they stand, for the suspicion queue."""

from __future__ import annotations

import cv2
import numpy as np

from genmojo_core.clip.clip import Clip
from genmojo_core.trackers.object_motion import ObjectMotion
from genmojo_core.trackers.stabilise import sample
from genmojo_core.tracks.annotation import KEY, Cells
from genmojo_core.tracks.model import NONE, VISIBLE
from genmojo_core.tracks.signals import Scene
from genmojo_core.tracks.suspicion import Evidence

_SPANS = (1, 2, 4)
_PATCH = 4  # held px on either side of the point
_MATCHED = 0.15  # weight from which a link has a say


def scene_of(clip: Clip) -> Scene | None:
    """The clip's masks for the mask signal; None without masks."""
    if clip.masks is None:
        return None
    scale = np.array(clip.size, np.float64) / np.array(clip.source_size, np.float64)
    label_of = {int(i): k + 1 for k, i in enumerate(clip.object_ids)}
    return Scene(clip.masks.value, clip.masks.valid, label_of, scale)


def evidence_of(motion: ObjectMotion, frames: np.ndarray, cells: list[Cells], scale: np.ndarray) -> list[Evidence]:
    """Evidence about tracks of one object.

    Args:
        motion: its links. frames: (T, H, W, 3) uint8 held. cells: T cells per track, source px. scale: source -> held.
    """
    xy = np.stack([c.xy for c in cells]).astype(np.float64) * scale
    seen = np.stack([c.state == VISIBLE for c in cells])
    votes, agreement = _votes(motion, xy, seen)
    gaps = _median_gap(votes, xy)
    gray = [cv2.cvtColor(frame, cv2.COLOR_RGB2GRAY) for frame in frames]
    return [Evidence(gap / scale.mean(), fits, _likeness(gray, places, c))
            for gap, fits, places, c in zip(gaps, agreement, xy, cells, strict=True)]  # fmt: skip


def _votes(motion: ObjectMotion, xy: np.ndarray, seen: np.ndarray) -> tuple[list[list[list[np.ndarray]]], np.ndarray]:
    """Per track and frame, places that links from frames in which it is seen give; and how well they agree."""
    count, frames = seen.shape
    votes: list[list[list[np.ndarray]]] = [[[] for _ in range(frames)] for _ in range(count)]
    agreement = np.zeros((count, frames))
    for t in range(frames):
        for s in [t + sign * span for span in _SPANS for sign in (-1, 1)]:
            carried = motion.carry(s, t, xy[:, s]) if 0 <= s < frames else None
            if carried is None:
                continue
            gap = np.linalg.norm(carried[0] - xy[:, t], axis=1)
            agreement[:, t] = np.maximum(agreement[:, t], carried[1] * np.exp(-((gap / 1.5) ** 2)) * seen[:, s])
            for n in np.flatnonzero((carried[1] > _MATCHED) & seen[:, s]):
                votes[n][t].append(carried[0][n])
    return votes, agreement


def _median_gap(votes: list[list[list[np.ndarray]]], xy: np.ndarray) -> np.ndarray:  # (n, T) held px
    """Distance from the place to the median of the votes; NaN without any."""
    out = np.full(xy.shape[:2], np.nan)
    for n, track in enumerate(votes):
        for t, places in enumerate(track):
            if places:
                out[n, t] = np.linalg.norm(np.median(np.stack(places), axis=0) - xy[n, t])
    return out


def _likeness(gray: list[np.ndarray], xy: np.ndarray, cells: Cells) -> np.ndarray:  # (T,)
    """Correlation of each patch with that of the nearest key at or before it, or the first; NaN where no place is.

    Also where the point is said to be hidden: pixels that look like it speak against that.
    """
    side = np.arange(-_PATCH, _PATCH + 1, dtype=np.float32)
    around = np.stack(np.meshgrid(side, side), axis=-1)
    keys = np.flatnonzero(((cells.flags & KEY) > 0) & (cells.state == VISIBLE))
    out = np.full(len(cells), np.nan)
    if not len(keys):
        return out
    patches = {int(t): _standard(sample(gray[t], xy[t] + around)) for t in np.flatnonzero(cells.state != NONE)}
    for t, patch in patches.items():
        before = keys[keys <= t]
        out[t] = float((patch * patches[int(before[-1] if len(before) else keys[0])]).mean())
    return out


def _standard(patch: np.ndarray) -> np.ndarray:
    """Mean 0, variance 1 (a flat patch: all 0)."""
    values = patch.astype(np.float64)
    return (values - values.mean()) / max(float(values.std()), 2.0)
