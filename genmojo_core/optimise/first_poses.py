"""Where every object is, to a first approximation, in a tenth of a second: so that a scene shows at once.

The accurate motion (motion.py) takes its place as soon as it is solved.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from genmojo_core.clip.clip import Clip
from genmojo_core.optimise.bend import Bend, no_bend
from genmojo_core.optimise.motion import ObjectMotion
from genmojo_core.optimise.surfaces import Patch
from genmojo_core.scene.initialise import unproject
from genmojo_core.sentences import say

FARTHEST = 1e3  # poses that move an object by more than this many scene depths are no poses

SMALLEST = 1e-3  # determinant of a pose; a rigid motion has 1


class Moves(Protocol):
    """What the lift needs to know of an object's motion; `ObjectMotion` knows more."""

    @property
    def ref_frame(self) -> int:
        """Canonical frame."""

    @property
    def pose(self) -> np.ndarray:
        """(T, 4, 4) world at ref_frame to world at t."""

    @property
    def confidence(self) -> np.ndarray:
        """(T,) 0..1, 0 where the pose is interpolated."""

    @property
    def bend(self) -> Bend | None:
        """Displacements before the pose, if known."""

    @property
    def depth(self) -> tuple[Patch | None, ...] | None:
        """T windows of better depth than the clip's, if known."""


@dataclass(frozen=True)
class FirstPoses:
    """Translations that follow the median of each object's visible points; see `Moves`."""

    ref_frame: int
    pose: np.ndarray
    confidence: np.ndarray
    bend: Bend | None = None
    depth: tuple[Patch | None, ...] | None = None


def first_poses(clip: Clip) -> list[FirstPoses]:
    """One per object: it is moved as its visible points' median moves, straight on while it is hidden."""
    return [_follow(clip, k) for k in range(clip.objects)]


def usable_motion(clip: Clip, motions: Sequence[ObjectMotion]) -> tuple[list[ObjectMotion], list[str]]:
    """The motions, with rough poses and no tracks in the place of one that is not finite or absurd; a sentence each.

    One object that cannot be followed must not spoil the others (RELIABILITY.md N27).
    """
    checked, doubts = [], []
    farthest = FARTHEST * max(float(np.median(clip.depth.value)), 1.0)
    for k, motion in enumerate(motions):
        numbers = (motion.pose, motion.confidence, motion.track_xyz, motion.track_xy, motion.track_conf)
        finite = all(np.isfinite(part).all() for part in numbers)
        if finite and np.abs(motion.pose).max() < farthest and np.linalg.det(motion.pose[:, :3, :3]).min() > SMALLEST:
            checked.append(motion)
            continue
        rough, frames = _follow(clip, k), len(clip)
        checked.append(
            replace(
                motion, ref_frame=rough.ref_frame, pose=rough.pose, confidence=rough.confidence,
                track_xyz=np.zeros((0, 3)), track_xy=np.zeros((0, frames, 2)), track_conf=np.zeros((0, frames)),
                bend=no_bend(frames, motion.path.centre, 1.0), depth=(None,) * frames,
            )
        )  # fmt: skip
        doubts.append(say("motion_not_found", name=clip.object_names[k]))
    return checked, doubts


def _follow(clip: Clip, k: int) -> FirstPoses:
    frames = len(clip)
    usable = clip.object_mask(k) & clip.depth.valid
    area = usable.sum(axis=(1, 2))
    seen = np.flatnonzero(area)
    pose = np.tile(np.eye(4), (frames, 1, 1))
    if not len(seen):
        return FirstPoses(0, pose, np.zeros(frames))
    centres = []
    for t in seen:
        rows, columns = np.nonzero(usable[t])
        xy = np.stack([columns, rows], axis=1) + 0.5
        places = unproject(xy, clip.depth.value[t][rows, columns].astype(np.float64), clip.cameras.value.view(t))
        centres.append(np.median(places, axis=0))
    path = np.stack([np.interp(np.arange(frames), seen, axis) for axis in np.array(centres).T], axis=1)
    ref = int(np.argmax(area > 0.8 * area.max()))
    pose[:, :3, 3] = path - path[ref]
    return FirstPoses(ref, pose, (area > 0.3 * area.max()).astype(np.float64))
