"""Frames in which an object has left the picture: its pose is guessed between sightings and must not be in view there.

An object that goes out at the right and comes back there was seen last and first at the same border; a pose
interpolated between the two would hover in view, where the masks say that it is not.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from genmojo_core.clip.clip import Clip
from genmojo_core.optimise.motion import ObjectMotion
from genmojo_core.optimise.poses import project

MARGIN = 0.02  # of the short side: how far outside the picture an absent object is put
_TOUCHES = 2  # pixels from the border within which a mask is cut by it


def out_of_view(clip: Clip, motions: Sequence[ObjectMotion]) -> list[ObjectMotion]:
    """The motions with every object moved out of the picture in frames where it is absent and nothing can hide it.

    It goes out across the border that cut its mask when it was last or next seen, parallel to the picture. Where no
    border cut it, or other objects, void pixels or the border hide all of it already, its pose stays.
    """
    return [_outside(clip, k, motion) for k, motion in enumerate(motions)]


def _outside(clip: Clip, k: int, motion: ObjectMotion) -> ObjectMotion:
    """One object's motion."""
    mask = clip.object_mask(k)
    seen = np.flatnonzero(mask.any(axis=(1, 2)))
    if not len(seen) or len(seen) == len(clip) or not len(motion.track_xyz):
        return motion
    path, xy = motion.path, motion.track_xy.copy()
    for t in np.setdiff1d(np.arange(len(clip)), seen):
        around = sorted((seen[seen < t][-1:].tolist() + seen[seen > t][:1].tolist()), key=lambda s: abs(s - t))
        way = next((w for w in (_way_out(mask[s]) for s in around) if w is not None), None)
        points = motion.points_at(int(t), motion.track_xyz)
        shift = None if way is None else _shift(clip, int(t), points, *way)
        if shift is not None:
            path = path.moved(int(t), path.rotation[t], path.position[t] + shift)
            xy[:, t] = project(clip.cameras.value, int(t), points + shift)
    if path is motion.path:
        return motion
    return replace(motion, path=path, pose=path.matrices(), track_xy=xy)


def _way_out(mask: np.ndarray) -> tuple[int, int] | None:  # (H, W) bool -> (axis: 0 x, 1 y; sign)
    """The border that cuts most of a mask."""
    edges = {
        (0, -1): mask[:, :_TOUCHES],
        (0, 1): mask[:, -_TOUCHES:],
        (1, -1): mask[:_TOUCHES],
        (1, 1): mask[-_TOUCHES:],
    }
    cut = {way: int(edge.sum()) for way, edge in edges.items()}
    best = max(cut, key=lambda way: cut[way])
    return best if cut[best] else None


def _shift(clip: Clip, t: int, points: np.ndarray, axis: int, sign: int) -> np.ndarray | None:  # (P, 3) -> (3,) world
    """What takes all points of frame t out of the picture, or None if none of them would show."""
    pixels = project(clip.cameras.value, t, points)
    cell = np.floor(pixels).astype(np.int64)
    inside = ((cell >= 0) & (cell < clip.size)).all(axis=1)
    x, y = np.where(inside[:, None], cell, 0).T
    if not (inside & (clip.masks.value[t][y, x] == 0) & clip.masks.valid[t][y, x]).any():
        return None
    margin = MARGIN * min(clip.size)
    missing = clip.size[axis] + margin - pixels[:, axis].min() if sign > 0 else pixels[:, axis].max() + margin
    view = clip.cameras.value.view(t)
    depth = float((points @ view.world_to_camera[2, :3] + view.world_to_camera[2, 3]).max())
    local = np.zeros(3)
    local[axis] = sign * missing * depth / (view.fx, view.fy)[axis]
    return local @ view.world_to_camera[:3, :3]
