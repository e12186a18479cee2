"""Tracks that people annotated, as supervision beside the motion's own tracks: the loop between tool and method."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from genmojo_core.clip.clip import Clip
from genmojo_core.optimise.motion import ObjectMotion, improved_depth
from genmojo_core.optimise.poses import project
from genmojo_core.tracks.model import VISIBLE, PointTracks
from genmojo_core.tracks.supervision import hidden_by_people, sure

_REACH = 1  # held px around a point in which its depth may be read
_SHARE = 0.4  # what annotated tracks count together, in what the object's own hundreds of tracks do, if all contradict
_LET_PASS = 3.0  # px at 1080 lines that a person accepts as right
_HELD = 0.5  # held px, which matches are not surer of
_HIDDEN = 0.3  # what a place counts that a person gave behind something, of one that is seen
_HIDDEN_PASS = 2.0  # times as far as a seen place may such a one be off before it contradicts


def with_annotated(clip: Clip, motions: Sequence[ObjectMotion]) -> list[ObjectMotion]:
    """The motions with the clip's given tracks added to their own: sure where seen, silent where nobody knows.

    Where a person placed a hidden point, that place holds in the picture as those of seen points do, for less: it says
    where the surface point is behind what hides it, not what shows there. Where their flags tell what a person gave and
    what a tracker guessed, guesses and uncertain places are silent too.

    They are few beside the motion's own tracks, so where the motion is off by more than a person lets pass, each counts
    for as many as makes all of an object's together heard; elsewhere people only say that it is right.

    A track's place in space is read from the depth of the frame nearest the reference frame in which it is seen and
    the object's pose is known; a track without such a frame is left out. Without given tracks nothing changes.
    """
    if clip.tracks is None or not clip.tracks.given or not len(clip.tracks.value.object):
        return list(motions)
    known = improved_depth(clip, motions)
    tracks = sure(clip.tracks.value).resized(*clip.size)
    return [_added(known, tracks, motion, int(clip.object_ids[k])) for k, motion in enumerate(motions)]


def _added(clip: Clip, tracks: PointTracks, motion: ObjectMotion, owner: int) -> ObjectMotion:
    """One object's motion with its annotated tracks."""
    rows, points = [], []
    for row in np.flatnonzero(tracks.object == owner):
        place = _in_space(clip, tracks, int(row), motion)
        if place is not None:
            rows.append(row)
            points.append(place)
    if not rows:
        return motion
    seen, hidden = tracks.state[rows] == VISIBLE, hidden_by_people(tracks)[rows]
    went = _went(clip, motion, np.stack(points))
    xy = np.where((seen | hidden)[..., None], tracks.xy[rows], went)
    weight = seen + _HIDDEN * hidden
    loud = max(1.0, _SHARE * float(motion.track_conf.sum()) / max(float(weight.sum()), 1.0))
    passes = max(_LET_PASS * clip.size[1] / 1080, _HELD) * np.where(hidden, _HIDDEN_PASS, 1.0)
    missed = np.linalg.norm(went - xy, axis=2) > passes
    return replace(
        motion, track_xyz=np.concatenate([motion.track_xyz, np.stack(points)]),
        track_xy=np.concatenate([motion.track_xy, xy]),
        track_conf=np.concatenate([motion.track_conf, np.where(missed, loud, 1.0) * weight]),
    )  # fmt: skip


def _went(clip: Clip, motion: ObjectMotion, places: np.ndarray) -> np.ndarray:  # (P, T, 2) held px
    """Where the motion brings points (P, 3) of the reference frame."""
    cameras = clip.cameras.value
    return np.stack([project(cameras, t, motion.points_at(t, places)) for t in range(len(clip))], axis=1)


def _in_space(clip: Clip, tracks: PointTracks, row: int, motion: ObjectMotion) -> np.ndarray | None:  # (3,)
    """World point on the object, as it is at the reference frame."""
    frames = np.flatnonzero((tracks.state[row] == VISIBLE) & (motion.confidence > 0))
    for t in sorted(frames.tolist(), key=lambda t: abs(t - motion.ref_frame)):
        xy = tracks.xy[row, t].astype(np.float64)
        z = _depth_at(clip, t, xy)
        if z is None:
            continue
        view = clip.cameras.value.view(t)
        camera = np.array([(xy[0] - view.cx) / view.fx * z, (xy[1] - view.cy) / view.fy * z, z, 1.0])
        there = np.linalg.inv(motion.pose[t]) @ np.linalg.inv(view.world_to_camera) @ camera
        return motion.bend.undone(t, there[None, :3])[0]
    return None


def _depth_at(clip: Clip, t: int, xy: np.ndarray) -> float | None:
    """Median depth of the valid pixels around a place; None outside or without one."""
    column, row = np.floor(xy).astype(int)
    width, height = clip.size
    if not (0 <= column < width and 0 <= row < height):
        return None
    window = np.s_[max(row - _REACH, 0) : row + _REACH + 1, max(column - _REACH, 0) : column + _REACH + 1]
    valid = clip.depth.valid[t][window]
    own = clip.masks.value[t][window] == clip.masks.value[t][row, column]
    good = valid & own
    return float(np.median(clip.depth.value[t][window][good])) if good.any() else None
