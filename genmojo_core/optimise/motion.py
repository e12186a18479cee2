"""First motion of every object, from flow and depth, before any Gaussian exists (ARCHITECTURE.md section 6).

`initial_motion` gives a rigid path, a smooth bend and point tracks per object; `carry` moves any query with them.
Coordinates are world coordinates of the clip's cameras and raster pixels of the frames held.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from genmojo_core.clip.cameras import Cameras
from genmojo_core.clip.clip import Channel, Clip
from genmojo_core.errors import GenmojoError
from genmojo_core.optimise.bend import Bend, carried
from genmojo_core.optimise.deadline import NO_DEADLINE, Deadline
from genmojo_core.optimise.keyframes import follow
from genmojo_core.optimise.motion_solver import Found
from genmojo_core.optimise.poses import Path, camera_centre, project, rays
from genmojo_core.optimise.surfaces import ObjectSurfaces, Patch, object_surfaces
from genmojo_core.trackers.contours import whole_area
from genmojo_core.trackers.stabilise import Layer, Matcher, flat_shade

_TRACKS = 600  # points per object
_NEW_VIEW = 0.5  # radians the object turns before another frame adds points
_HIDDEN = 0.25  # confidence of a place that is predicted but not seen, of the pose's


@dataclass(frozen=True)
class ObjectMotion:
    """How one object moves.

    Args:
        ref_frame: frame in which the points below are given.
        pose: (T, 4, 4) float64, maps world points on the object at ref_frame to world points at frame t (rigid).
        confidence: (T,) 0..1; 0 = interpolated through occlusion or absence.
        track_xyz: (P, 3) world points on the object, as it is at ref_frame.
        track_xy: (P, T, 2) held raster pixels.
        track_conf: (P, T) 0..1; a quarter of the pose's where the place is predicted but hidden.
        residual_px: median distance of matched points to the rigid motion: evidence of non-rigidity.
        path: the poses as rotation about the object's centre and place of the centre.
        bend: smooth non-rigid displacements before the pose; zero where there is no evidence.
        depth: T windows with the object's depth, improved by the motion where depth was a guess; None where not seen.
        hurried: the deadline came before the end; frames not reached are only where the object's pixels are.
    """

    ref_frame: int
    pose: np.ndarray
    confidence: np.ndarray
    track_xyz: np.ndarray
    track_xy: np.ndarray
    track_conf: np.ndarray
    residual_px: float
    path: Path
    bend: Bend
    depth: tuple[Patch | None, ...]
    hurried: bool = False

    def points_at(self, t: int, points: np.ndarray) -> np.ndarray:  # (..., 3) world at ref_frame -> at frame t
        """Points on the object at the reference frame, bent and posed as in frame t."""
        return carried(self.path, self.bend, self.ref_frame, t, points)


def initial_motion(
    clip: Clip, ref_frames: Sequence[int] | None = None, deadline: Deadline = NO_DEADLINE
) -> list[ObjectMotion]:
    """Motion and point tracks of every object of a complete clip.

    Args:
        clip: with masks, depth and cameras (given or estimated).
        ref_frames: reference frame per object; by default `default_reference`.
        deadline: every object gets an equal part of the time left; after its part it is only followed roughly.

    Returns one motion per object, in the order of `clip.object_ids`. Raises GenmojoError("schema") if a channel is
    missing.
    """
    matcher = Matcher()
    shade = np.stack([flat_shade(frame) for frame in clip.frames])
    motions = []
    for k in range(clip.objects):
        surfaces = object_surfaces(clip, k, shade)
        ref = default_reference(surfaces.layer) if ref_frames is None else int(ref_frames[k])
        motions.append(_motion(follow(surfaces, ref, matcher, deadline.part(1.0 / (clip.objects - k)))))
    return motions


def default_reference(layer: Layer) -> int:
    """The first frame that shows the object nearly as well as any: visible area times the free share of its outline.

    Frames with at least 60 % of the best product count as showing it well.
    """
    worth = whole_area(layer)
    return int(np.argmax(worth >= 0.6 * max(float(worth.max()), 1e-9)))


def carry(
    motions: Sequence[ObjectMotion],
    clip: Clip,
    queries_t: np.ndarray,  # (N,) frames
    queries_xy: np.ndarray,  # (N, 2) held raster pixels
    object_index: np.ndarray,  # (N,) 0..K-1
) -> np.ndarray:  # (N, T, 2) held raster pixels
    """Where points of objects go in all frames: lifted by depth, moved by pose and bend, projected.

    A query in a frame where its object is not seen is lifted at the depth of the object's centre. Raises
    GenmojoError("schema") if the clip has no cameras.
    """
    if clip.cameras is None:
        raise GenmojoError("schema", "has no cameras", clip.path, "complete the clip before carrying points")
    cameras: Cameras = clip.cameras.value
    out = np.zeros((len(queries_xy), len(clip), 2))
    for k in np.unique(object_index):
        motion = motions[k]
        for q in np.unique(queries_t[object_index == k]):
            chosen = (object_index == k) & (queries_t == q)
            world = _lifted(motion, cameras, int(q), np.asarray(queries_xy[chosen], np.float64))
            for t in range(len(clip)):
                out[chosen, t] = project(cameras, t, carried(motion.path, motion.bend, int(q), t, world))
    return out


def improved_depth(clip: Clip, motions: Sequence[ObjectMotion]) -> Clip:
    """The clip with the depth of its objects replaced by what their motion told; measured depth stays as it is."""
    if clip.depth is None or clip.masks is None or clip.depth.given:
        return clip
    depth = clip.depth.value.copy()
    for k, motion in enumerate(motions):
        mask = clip.object_mask(k)
        for t, patch in enumerate(motion.depth):
            if patch is not None:
                h, w = patch.depth.shape
                box = slice(patch.top, patch.top + h), slice(patch.left, patch.left + w)
                depth[t][box] = np.where(mask[t][box], patch.depth, depth[t][box])
    return clip.with_channels(depth=Channel(depth, clip.depth.valid, f"{clip.depth.source}, shaped by motion"))


def _lifted(motion: ObjectMotion, cameras: Cameras, q: int, xy: np.ndarray) -> np.ndarray:  # (N, 2) -> (N, 3) world
    """World points of image places on the object in frame q."""
    patch = motion.depth[q]
    if patch is not None:
        depth = patch.lookup(patch.depth, xy)
    else:
        depth = np.full(len(xy), (cameras.world_to_camera[q] @ [*motion.path.position[q], 1.0])[2])
    return camera_centre(cameras, q) + rays(cameras, q, xy) * depth[:, None]


def _motion(found: Found) -> ObjectMotion:
    """The result with its tracks."""
    surfaces, path, bend = found.surfaces, found.path, found.bend
    xyz = _track_points(surfaces, path, bend)
    xy = np.zeros((len(xyz), len(path.position), 2))
    conf = np.zeros(xy.shape[:2])
    for t in range(xy.shape[1]):
        world = carried(path, bend, path.ref, t, xyz)
        xy[:, t] = project(surfaces.cameras, t, world)
        conf[:, t] = found.confidence[t] * np.where(_seen(surfaces, t, xy[:, t], world), 1.0, _HIDDEN)
    depth = tuple(None if s is None else s.patch for s in surfaces.surfaces)
    return ObjectMotion(path.ref, path.matrices(), found.confidence, xyz, xy, conf, found.residual_px, path, bend,
                        depth, found.hurried)  # fmt: skip


def _track_points(surfaces: ObjectSurfaces, path: Path, bend: Bend) -> np.ndarray:  # (P, 3) world at the reference
    """Surface points of the reference frame and of frames that see the object from another side, evenly thinned."""
    views: list[int] = []
    order = sorted(range(len(path.position)), key=lambda t: (t != path.ref, -surfaces.area[t]))
    for t in order:
        turns = [np.arccos(np.clip((np.trace(path.rotation[t] @ path.rotation[v].T) - 1) / 2, -1, 1)) for v in views]
        if surfaces.surfaces[t] is not None and (not views or min(turns) > _NEW_VIEW):
            views.append(t)
    parts = [np.zeros((0, 3))]
    for t in views:
        surface = surfaces.surfaces[t]
        if surface is not None:
            inside = surface.points[surface.grid.inside]
            keep = np.linspace(0, len(inside) - 1, min(max(_TRACKS // len(views), 1), len(inside))).astype(int)
            parts.append(carried(path, bend, t, path.ref, inside[keep]))
    return np.concatenate(parts)


def _seen(surfaces: ObjectSurfaces, t: int, xy: np.ndarray, world: np.ndarray) -> np.ndarray:  # -> (P,) bool
    """Which points lie on the object's mask in frame t and not behind its own surface there."""
    surface = surfaces.surfaces[t]
    if surface is None:
        return np.zeros(len(xy), bool)
    height, width = surfaces.layer.mask.shape[1:]
    cell = np.floor(xy).astype(np.int64)
    within = ((cell >= 0) & (cell < [width, height])).all(axis=1)
    cell = np.clip(cell, 0, [width - 1, height - 1])
    pose = surfaces.cameras.world_to_camera[t]
    z = (world @ pose[:3, :3].T + pose[:3, 3])[:, 2]
    front = z < surface.patch.lookup(surface.patch.depth, xy) + 0.08 * surfaces.size
    return within & surfaces.layer.mask[t][cell[:, 1], cell[:, 0]] & front
