"""Motion of long clips: solved jointly on evenly spaced key frames, then each frame between its two nearest keys.

The joint solve costs the square of the frames in memory and more than that in time; between keys every frame costs the
same, so a clip of a thousand frames costs about ten times one of a hundred.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from genmojo_core.optimise.bend import Bend
from genmojo_core.optimise.deadline import Deadline
from genmojo_core.optimise.motion_solver import Found, ObjectSolver
from genmojo_core.optimise.poses import Path, exp_rotation, log_rotation
from genmojo_core.optimise.surfaces import ObjectSurfaces
from genmojo_core.trackers.stabilise import Matcher

MOST_KEYS = 48
_KEYS_SHARE = 0.7  # of the time goes to the keys
_UNCHECKED = 0.5  # confidence of a pose between keys that was not matched, of the keys'


def key_frames(frames: int, ref: int) -> np.ndarray:  # (K,) int64, rising
    """Every n-th frame such that the reference frame is among them and there are at most MOST_KEYS."""
    stride = -(-frames // MOST_KEYS)
    return np.arange(ref % stride, frames, stride)


def follow(surfaces: ObjectSurfaces, ref: int, matcher: Matcher, deadline: Deadline) -> Found:
    """The motion of one object.

    Args:
        surfaces: the object in every frame. ref: its reference frame.
        matcher: finds places in other frames. deadline: after it the rest is done roughly.
    """
    frames = len(surfaces.surfaces)
    keys = key_frames(frames, ref)
    if len(keys) == frames:
        return ObjectSolver(surfaces, ref, matcher, deadline).run()
    solver = ObjectSolver(
        surfaces.selected(keys), int(np.searchsorted(keys, ref)), matcher, deadline.part(_KEYS_SHARE), keys[1] - keys[0]
    )
    return _filled(solver.run(), surfaces, keys, matcher, deadline)


def _filled(found: Found, surfaces: ObjectSurfaces, keys: np.ndarray, matcher: Matcher, deadline: Deadline) -> Found:
    """The motion found on keys, spread to all frames and matched there."""
    frames = len(surfaces.surfaces)
    every = list(surfaces.surfaces)
    for k, key in enumerate(keys):
        every[key] = found.surfaces.surfaces[k]
    whole = replace(surfaces, surfaces=every)
    path = spread_path(found.path, keys, frames)
    confidence = np.interp(np.arange(frames), keys, found.confidence)
    solver = ObjectSolver(whole, path.ref, matcher, deadline)
    for t in np.setdiff1d(np.arange(frames), keys):
        after = int(np.searchsorted(keys, t))
        path, matched = solver.refine(path, int(t), [int(k) for k in keys[max(after - 1, 0) : after + 1]])
        confidence[t] *= 0.0 if not solver.seen[t] else 1.0 if matched else _UNCHECKED
    bend = _spread_bend(found.bend, keys, frames)
    return Found(whole, path, bend, confidence, found.residual_px, found.hurried or deadline.over())


def spread_path(path: Path, keys: np.ndarray, frames: int) -> Path:
    """A path known at key frames (K,), linear in position and turning evenly in between, still beyond the ends."""
    rotation = np.tile(np.eye(3), (frames, 1, 1))
    position = np.stack([np.interp(np.arange(frames), keys, axis) for axis in path.position.T], axis=1)
    for t in range(frames):
        after = int(np.clip(np.searchsorted(keys, t), 1, len(keys) - 1)) if len(keys) > 1 else 0
        before = max(after - 1, 0)
        share = np.clip((t - keys[before]) / max(keys[after] - keys[before], 1), 0.0, 1.0)
        turn = log_rotation(path.rotation[after] @ path.rotation[before].T)
        rotation[t] = exp_rotation(share * turn) @ path.rotation[before]
    return Path(rotation, position, path.centre, int(keys[path.ref]))


def _spread_bend(bend: Bend, keys: np.ndarray, frames: int) -> Bend:
    """A bend known at key frames, linear in between."""
    flat = bend.coefficients.reshape(len(keys), -1)
    every = np.stack([np.interp(np.arange(frames), keys, column) for column in flat.T], axis=1)
    return replace(bend, coefficients=every.reshape(frames, *bend.coefficients.shape[1:]))
