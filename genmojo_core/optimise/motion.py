"""First motion of every object, from flow and depth, before any Gaussian exists (ARCHITECTURE.md section 6).

Outward from a reference frame each next pose is predicted, tried in several versions, matched by stabilised flow to
several earlier frames and solved; then all poses are solved together from links between many pairs of frames.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from genmojo_core.clip.clip import Clip
from genmojo_core.optimise.poses import Path, Problem, Sight, camera_centre, project, rays, solve, still_path
from genmojo_core.optimise.surfaces import ObjectSurfaces, object_surfaces
from genmojo_core.trackers.search import best_shifts
from genmojo_core.trackers.stabilise import Link, Matcher, sample

_POINTS = 250  # places of a frame that take part in a solve
_LINKS = (1, 2, 4, 8)  # frame distances of the joint solve


@dataclass(frozen=True)
class ObjectMotion:
    """How one object moves.

    Args:
        ref_frame: frame in which the points below are given.
        pose: (T, 4, 4) float64, maps world points on the object at ref_frame to world points at frame t (rigid).
        confidence: (T,) 0..1; 0 = interpolated through occlusion or absence.
        track_xyz: (P, 3) world points on the object at ref_frame.
        track_xy: (P, T, 2) held raster pixels.
        track_conf: (P, T) 0..1.
        residual_px: median distance of matched points to the rigid motion: evidence of non-rigidity.
    """

    ref_frame: int
    pose: np.ndarray
    confidence: np.ndarray
    track_xyz: np.ndarray
    track_xy: np.ndarray
    track_conf: np.ndarray
    residual_px: float


def initial_motion(clip: Clip, ref_frames: Sequence[int] | None = None) -> list[ObjectMotion]:
    """Rigid motion and point tracks of every object of a complete clip.

    Args:
        clip: with masks, depth and cameras (given or estimated).
        ref_frames: reference frame per object; by default the first frame in which the object is seen at more than
            80 % of its largest area.

    Returns one motion per object, in the order of `clip.object_ids`.
    """
    matcher = Matcher()
    motions = []
    for k in range(clip.objects):
        surfaces = object_surfaces(clip, k)
        ref = default_reference(surfaces.area) if ref_frames is None else int(ref_frames[k])
        motions.append(_ObjectSolver(surfaces, ref, matcher).run())
    return motions


def default_reference(area: np.ndarray) -> int:  # (T,) visible pixels
    """The first frame in which the object shows more than 80 % of its largest area."""
    return int(np.argmax(area > 0.8 * max(float(area.max()), 1.0)))


class _ObjectSolver:
    """The work for one object; `run` does all of it."""

    def __init__(self, surfaces: ObjectSurfaces, ref: int, matcher: Matcher) -> None:
        self.surfaces, self.matcher, self.ref = surfaces, matcher, ref
        self.frames = len(surfaces.surfaces)
        self.seen = np.array([s is not None for s in surfaces.surfaces])
        if not self.seen[ref] and self.seen.any():
            self.ref = int(np.argmax(self.seen))
        self._choose_points()

    def run(self) -> ObjectMotion:
        """Outward pass, then joint solves with fresh links."""
        if not self.seen.any():
            return _nothing(self.frames, self.ref)
        path = self._outward()
        sights: list[Sight] = []
        every = np.ones(self.frames, bool)
        for _ in range(2):
            sights = self._all_sights(path)
            path, _ = solve(path, self._problem(sights), every, every, rounds=8)
        return self._result(path, sights)

    # --- preparation

    def _choose_points(self) -> None:
        """At most _POINTS grid places per frame, spread evenly; their rays and depths in one list."""
        self.cells: list[np.ndarray] = []
        self.start = np.zeros(self.frames + 1, np.int64)
        origin, ray, depth = [np.zeros((0, 3))], [np.zeros((0, 3))], [np.zeros(0)]
        cameras = self.surfaces.cameras
        for t, surface in enumerate(self.surfaces.surfaces):
            cells = np.zeros((0, 2), np.int64)
            if surface is not None:
                cells = np.argwhere(surface.grid.inside)
                cells = cells[:: max(len(cells) // _POINTS, 1)][: 2 * _POINTS]
                xy = surface.grid.xy[cells[:, 0], cells[:, 1]].astype(np.float64)
                origin.append(np.tile(camera_centre(cameras, t), (len(xy), 1)))
                ray.append(rays(cameras, t, xy))
                depth.append(sample(surface.depth, xy).astype(np.float64))
            self.cells.append(cells)
            self.start[t + 1] = self.start[t] + len(cells)
        self.origin, self.ray, self.depth = np.concatenate(origin), np.concatenate(ray), np.concatenate(depth)

    def _problem(self, sights: list[Sight]) -> Problem:
        """The solve with these sights."""
        size, measured = self.surfaces.size, self.surfaces.measured
        return Problem(self.surfaces.cameras, self.origin, self.ray, self.depth, size, tuple(sights),
                       surface_sigma=0.01 * size if measured else 0.0,
                       depth_sigma=0.0 if measured else 0.15 * size)  # fmt: skip

    # --- links

    def _link(self, path: Path, s: int, t: int) -> Link | None:
        """Match frame s to frame t as the path predicts."""
        surface = self.surfaces.surfaces[s]
        if surface is None or self.surfaces.surfaces[t] is None:
            return None
        predicted = project(self.surfaces.cameras, t, path.between(s, t, surface.points)).astype(np.float32)
        return self.matcher.link(self.surfaces.layer, surface.grid, t, predicted)

    def _sight(self, link: Link | None, s: int, t: int) -> Sight | None:
        """The link's matches at the chosen points."""
        target = self.surfaces.surfaces[t]
        if link is None or target is None:
            return None
        rows, cols = self.cells[s].T
        weight = link.weight[rows, cols].astype(np.float64)
        good = weight > 0.05
        if good.sum() < 6:
            return None
        xy = link.xy[rows, cols][good].astype(np.float64)
        normal = sample(target.normal, xy).astype(np.float64)
        length = np.linalg.norm(normal, axis=1, keepdims=True)
        normal = np.where(length > 0.9, normal / np.maximum(length, 1e-9), 0.0)
        index = self.start[s] + np.nonzero(good)[0]
        return Sight(s, t, index, xy, weight[good], self.surfaces.world(t, xy), normal)

    def _all_sights(self, path: Path) -> list[Sight]:
        """Sights between all frames at the distances of _LINKS, both ways, and with the reference frame."""
        pairs = {(s, t) for s in range(self.frames) for d in _LINKS for t in (s - d, s + d) if 0 <= t < self.frames}
        pairs |= {(self.ref, t) for t in range(self.frames)} - {(self.ref, self.ref)}
        sights = (self._sight(self._link(path, s, t), s, t) for s, t in sorted(pairs))
        return [sight for sight in sights if sight is not None]

    # --- outward pass

    def _outward(self) -> Path:
        """Poses one after the other, from the reference frame to both ends."""
        surface = self.surfaces.surfaces[self.ref]
        inside = surface.points[surface.grid.inside]
        path = still_path(self.frames, np.median(inside, axis=0), self.ref)
        for direction in (1, -1):
            done = [self.ref]
            t = self.ref + direction
            while 0 <= t < self.frames:
                path = self._next(path, t, direction, done)
                if self.seen[t]:
                    done.append(t)
                t += direction
        return path

    def _next(self, path: Path, t: int, direction: int, done: list[int]) -> Path:
        """The path with the pose of frame t found from the frames done before it."""
        rotation, position = _continued(path, t, direction)
        path = path.moved(t, rotation, position)
        if not self.seen[t]:
            return path
        sources = [s for s in done if abs(s - t) in (1, 2, 4)] or done[-1:]
        path = self._best_start(path, sources[-1], t)
        free, known = np.zeros(self.frames, bool), np.zeros(self.frames, bool)
        free[t] = True
        known[[*done, t]] = True
        known[min(done[0], t) : max(done[0], t) + 1] = True
        for _ in range(2):
            sights = [self._sight(self._link(path, s, t), s, t) for s in sources]
            path, _ = solve(path, self._problem([x for x in sights if x is not None]), free, known)
        return path

    def _best_start(self, path: Path, s: int, t: int) -> Path:
        """The path as predicted, or shifted to one of the best overlaps, whichever matches frame t best."""
        surface = self.surfaces.surfaces[s]
        carried = path.between(s, t, surface.points)
        predicted = project(self.surfaces.cameras, t, carried).astype(np.float32)
        shifts = best_shifts(self.surfaces.layer, surface.grid, t, predicted)
        pose = self.surfaces.cameras.world_to_camera[t]
        z = float(np.median((carried[surface.grid.inside] @ pose[:3, :3].T + pose[:3, 3])[:, 2]))
        k = self.surfaces.cameras.K[t]
        best, best_score = path, -1.0
        for shift in [np.zeros(2), *shifts]:
            move = np.array([shift[0] / k[0, 0] * z, shift[1] / k[1, 1] * z, 0.0]) @ pose[:3, :3]
            tried = path.moved(t, path.rotation[t], path.position[t] + move)
            link = self._link(tried, s, t)
            if link is not None and link.score > best_score:
                best, best_score = tried, link.score
        return best

    # --- result

    def _result(self, path: Path, sights: list[Sight]) -> ObjectMotion:
        """Pose, confidence and tracks."""
        support = np.zeros(self.frames)
        residuals = [np.zeros(0)]
        for sight in sights:
            support[sight.target] += sight.weight.sum()
            world = self.origin[sight.index] + self.depth[sight.index, None] * self.ray[sight.index]
            seen = project(self.surfaces.cameras, sight.target, path.between(sight.source, sight.target, world))
            residuals.append(np.linalg.norm(seen - sight.xy, axis=1))
        usual = max(float(np.median(support[self.seen])), 1e-9)
        confidence = np.clip(2.0 * support / usual, 0.0, 1.0)
        confidence[self.ref] = 1.0
        points = slice(self.start[self.ref], self.start[self.ref + 1])
        xyz = self.origin[points] + self.depth[points, None] * self.ray[points]
        pose = path.matrices()
        moved = np.einsum("tij,pj->pti", pose[:, :3, :3], xyz) + pose[:, :3, 3]
        xy = np.stack([project(self.surfaces.cameras, t, moved[:, t]) for t in range(self.frames)], axis=1)
        conf = np.tile(confidence, (len(xyz), 1))
        return ObjectMotion(self.ref, pose, confidence, xyz, xy, conf, float(np.median(np.concatenate(residuals))))


def _continued(path: Path, t: int, direction: int) -> tuple[np.ndarray, np.ndarray]:
    """Rotation and position of frame t if the last motion goes on."""
    last, before = t - direction, t - 2 * direction
    if not 0 <= before < len(path.position) or last == path.ref:
        return path.rotation[last], path.position[last]
    turn = path.rotation[last] @ path.rotation[before].T
    return turn @ path.rotation[last], 2 * path.position[last] - path.position[before]


def _nothing(frames: int, ref: int) -> ObjectMotion:
    """The motion of an object that is never seen."""
    pose = np.tile(np.eye(4), (frames, 1, 1))
    return ObjectMotion(ref, pose, np.zeros(frames), np.zeros((0, 3)), np.zeros((0, frames, 2)),
                        np.zeros((0, frames)), 0.0)  # fmt: skip


__all__ = ["ObjectMotion", "default_reference", "initial_motion"]
