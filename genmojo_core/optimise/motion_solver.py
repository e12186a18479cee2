"""The search for one object's motion: outward from a reference frame, then jointly over all frames.

Outward, each next pose is predicted, tried in several versions, matched by stabilised flow to several earlier frames
and solved; then all poses are solved together from links between many pairs of frames, which stops drift, and what is
left is explained by a smooth bend if that has evidence.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from genmojo_core.optimise.bend import Bend, carried, fit_bend, no_bend
from genmojo_core.optimise.deadline import Deadline
from genmojo_core.optimise.pose_solver import solve
from genmojo_core.optimise.poses import Path, Problem, Sight, camera_centre, project, rays, still_path
from genmojo_core.optimise.surfaces import ObjectSurfaces, Surface
from genmojo_core.trackers.contours import meet, outline_of, spread, whole_area
from genmojo_core.trackers.search import best_shifts
from genmojo_core.trackers.stabilise import Link, Matcher

_POINTS = 250  # places of a frame that take part in a solve
_EDGE, _EDGE_REACH = 60, 2  # outline points of a frame; frames between two outlines that are compared
_BACK = (1, 2, 4)  # frame distances of the outward pass
_FIRST_LINKS, _LINKS = (1, 2, 4), (1, 2, 4, 8)  # frame distances of the two joint solves
_TURN_WEIGHT = 10.0 / np.deg2rad(3.0) ** 2  # against explaining a guessed shape's change by turning
_ANCHOR = 0.1  # of the size: how far the middle of what is seen may lie from where the centre goes
_JUMP = 0.15  # of the size: change of position against a known velocity that halves a match's score
_SCRAP = 0.4  # of the largest area: less than this is no ground to leave a known velocity
_FAR = 1e5  # pixels
_FARTHEST = 8.0  # times the first distance from the camera
_UNSEEN = 0.6  # of the last velocity goes on per frame in which the object is not seen
_ON_SURFACE = (0.01, 0.05)  # of the size: how far carried points may lie off measured and guessed depth
_COARSE_COST, _FINE_COST = 2.5, 4.0  # seconds of a joint solve with its links, in seconds of the links made so far
_ROUGH = 0.3  # confidence of a pose that is only where the pixels are
_BEND_GAIN = 0.85  # a bend must bring the median residual below this share of the rigid one's


@dataclass(frozen=True)
class Found:
    """What the search found.

    Args:
        surfaces: with depth improved by the motion where it was a guess.
        path: rigid poses. bend: what is left.
        confidence: (T,) 0..1. residual_px: median distance of matches to the rigid motion.
        hurried: the deadline came first; what was not done is only roughly right.
    """

    surfaces: ObjectSurfaces
    path: Path
    bend: Bend
    confidence: np.ndarray
    residual_px: float
    hurried: bool = False


class ObjectSolver:
    """The work for one object; `run` does all of it, `refine` one frame of a path that is nearly right."""

    def __init__(
        self, surfaces: ObjectSurfaces, ref: int, matcher: Matcher, deadline: Deadline, stride: int = 1
    ) -> None:
        self.surfaces, self.matcher, self.ref, self.deadline = surfaces, matcher, ref, deadline
        self.stride = stride  # frames of the clip from one of these to the next
        self.frames = len(surfaces.surfaces)
        self.seen = np.array([s is not None for s in surfaces.surfaces])
        if not self.seen[ref] and self.seen.any():
            self.ref = int(np.argmax(self.seen))
        self.links, self.linking = 0, 0.0  # how many were made, in how many seconds
        self.outlines = [outline_of(surfaces.layer, t) for t in range(self.frames)]
        self._choose_points()
        self._choose_anchor()

    def run(self) -> Found:
        """Outward pass, then joint solves with fresh links, then the bend."""
        if not self.seen.any():
            path = still_path(self.frames, np.zeros(3), self.ref)
            return Found(self.surfaces, path, no_bend(self.frames, np.zeros(3), 1.0), np.zeros(self.frames), 0.0)
        path, sights, rough = self._outward()
        hurried = bool(rough.any())
        every, solved = np.ones(self.frames, bool), False
        for last in (False, True) if self.surfaces.measured else (False, True, True):  # a guessed shape takes longer
            pairs = self._pairs(_LINKS if last else _FIRST_LINKS, both=last)
            fine = last and self._affordable(_FINE_COST, pairs)
            hurried = hurried or fine != last
            if not rough.any() and (fine or self._affordable(_COARSE_COST, pairs)):
                sights = self._sights(path, pairs, fine)
                path, self.depth = solve(path, self._problem(sights), every, every, rounds=8)
                self._keep_shape()
                solved = True
            else:
                hurried = True
        rigid = no_bend(self.frames, path.centre, self.surfaces.size)
        bend = fit_bend(path, self._problem(sights)) if solved and not self.deadline.over() else rigid
        residual = self._residual(path, rigid, sights)
        if self._residual(path, bend, sights) > _BEND_GAIN * residual:
            bend = rigid
        confidence = np.where(rough, _ROUGH * self.seen, self._confidence(sights) * self._contained(path))
        return Found(self.surfaces, path, bend, confidence, residual, hurried)

    def refine(self, path: Path, t: int, sources: list[int]) -> tuple[Path, bool]:
        """The path with the pose of frame t matched to some frames, and whether there was anything to match."""
        if not self.seen[t] or self.deadline.over():
            return path, False
        sights = self._sights(path, [(s, t) for s in sources])
        free, known = np.zeros(self.frames, bool), np.zeros(self.frames, bool)
        free[t], known[max(t - 1, 0) : t + 2] = True, True
        refined, _ = solve(path, self._problem(sights), free, known)
        return (path, False) if self._lost(refined, t) else (refined, bool(sights))

    # --- preparation

    def _choose_points(self) -> None:
        """At most about _POINTS grid places and _EDGE outline points per frame; rays and depths in one list."""
        self.cells: list[np.ndarray] = []
        self.edges: list[np.ndarray] = []
        self.start = np.zeros(self.frames + 1, np.int64)
        origin, ray, depth = [np.zeros((0, 3))], [np.zeros((0, 3))], [np.zeros(0)]
        cameras = self.surfaces.cameras
        for t, surface in enumerate(self.surfaces.surfaces):
            cells, edge = np.zeros((0, 2), np.int64), np.zeros(0, np.int64)
            if surface is not None:
                cells = np.argwhere(surface.grid.inside)
                cells = cells[:: max(len(cells) // _POINTS, 1)][: 2 * _POINTS]
                xy = surface.grid.xy[cells[:, 0], cells[:, 1]].astype(np.float64)
                outline = self.outlines[t]
                if outline is not None:
                    edge = spread(outline, _EDGE)
                    xy = np.concatenate([xy, outline.xy[edge]])
                origin.append(np.tile(camera_centre(cameras, t), (len(xy), 1)))
                ray.append(rays(cameras, t, xy))
                depth.append(surface.patch.lookup(surface.patch.depth, xy).astype(np.float64))
            self.cells.append(cells)
            self.edges.append(edge)
            self.start[t + 1] = self.start[t] + len(cells) + len(edge)
        self.origin, self.ray, self.depth = np.concatenate(origin), np.concatenate(ray), np.concatenate(depth)

    def _choose_anchor(self) -> None:
        """Where the centre lies by the visible surface alone, and how far to believe it: little, and only if whole."""
        whole = whole_area(self.surfaces.layer)
        usual = (
            float(np.percentile(whole[self.seen], 75)) if self.seen.any() else 0.0
        )  # the largest may be a wrong mask
        share = np.clip(2.0 * whole / max(usual, 1e-9) - 1.0, 0.0, 1.0)
        self.anchor = np.array([np.zeros(3) if s is None else _middle(s) for s in self.surfaces.surfaces])
        self.anchor_weight = share * self.seen / (_ANCHOR * self.surfaces.size) ** 2

    def _problem(self, sights: list[Sight]) -> Problem:
        """The solve with these sights."""
        size, measured = self.surfaces.size, self.surfaces.measured
        return Problem(self.surfaces.cameras, self.origin, self.ray, self.depth, size, tuple(sights),
                       surface_sigma=_ON_SURFACE[0 if measured else 1] * size,
                       depth_sigma=0.0 if measured else 0.15 * size,
                       turn_weight=0.0 if measured else _TURN_WEIGHT,
                       anchor=self.anchor, anchor_weight=self.anchor_weight, stride=self.stride)  # fmt: skip

    def _points(self, index: np.ndarray) -> np.ndarray:  # (N,) -> (N, 3) world
        """Source points in their own frame."""
        return self.origin[index] + self.depth[index, None] * self.ray[index]

    def _keep_shape(self) -> None:
        """Take the solved depths over into the surfaces, smoothly."""
        if self.surfaces.measured:
            return
        for t, surface in enumerate(self.surfaces.surfaces):
            if surface is not None:
                part = slice(self.start[t], self.start[t] + len(self.cells[t]))
                xy = surface.grid.xy[self.cells[t][:, 0], self.cells[t][:, 1]]
                gain = self.depth[part] - surface.patch.lookup(surface.patch.depth, xy)
                self.surfaces = self.surfaces.corrected(t, self.cells[t], gain)

    # --- links

    def _link(self, path: Path, s: int, t: int, fine: bool = False) -> Link | None:
        """Match frame s to frame t as the path predicts."""
        surface = self.surfaces.surfaces[s]
        if surface is None or not self.seen[t]:
            return None
        began = self.deadline.clock()
        predicted = project(self.surfaces.cameras, t, path.between(s, t, surface.points)).astype(np.float32)
        link = self.matcher.link(self.surfaces.layer, surface.grid, t, predicted, fine)
        self.links, self.linking = self.links + 1, self.linking + self.deadline.clock() - began
        return link

    def _sight(self, path: Path, s: int, t: int, fine: bool = False) -> Sight | None:
        """Matches of frame s in frame t at the chosen points."""
        link, target = self._link(path, s, t, fine), self.surfaces.surfaces[t]
        if link is None or target is None:
            return None
        rows, cols = self.cells[s].T
        weight = link.weight[rows, cols].astype(np.float64)
        good = weight > 0.05
        if good.sum() < 6:
            return None
        xy = link.xy[rows, cols][good].astype(np.float64)
        normal = target.patch.lookup(target.normal, xy).astype(np.float64)
        length = np.linalg.norm(normal, axis=1, keepdims=True)
        normal = np.where(length > 0.9, normal / np.maximum(length, 1e-9), 0.0)
        return Sight(s, t, self.start[s] + np.nonzero(good)[0], xy, weight[good], self.surfaces.world(t, xy), normal)

    def _outline_sight(self, path: Path, s: int, t: int) -> Sight | None:
        """The own outline of frame s against that of frame t."""
        source, target = self.outlines[s], self.outlines[t]
        if source is None or target is None or abs(s - t) > _EDGE_REACH or not len(self.edges[s]):
            return None
        index = self.start[s] + len(self.cells[s]) + np.arange(len(self.edges[s]))
        seen = project(self.surfaces.cameras, t, path.between(s, t, self._points(index)))
        reach = 0.12 * float(np.sqrt(self.surfaces.layer.mask[s].sum())) + 2.0
        place, facing, good = meet(target, seen, source.normal[self.edges[s]], reach)
        if good.sum() < 6:
            return None
        none = np.zeros((int(good.sum()), 3))
        return Sight(s, t, index[good], place[good], np.ones(len(none)), none, none, facing[good])

    def _sights(self, path: Path, pairs: list[tuple[int, int]], fine: bool = False) -> list[Sight]:
        """Texture and outline sights of pairs (source, target)."""
        found = [self._sight(path, s, t, fine) for s, t in pairs]
        found += [self._outline_sight(path, s, t) for s, t in pairs]
        return [sight for sight in found if sight is not None]

    def _affordable(self, cost: float, pairs: list[tuple[int, int]]) -> bool:
        """Whether a joint solve of these pairs should end before the deadline, judged by the links made so far."""
        each = self.linking / max(self.links, 1)
        return cost * each * len(pairs) <= self.deadline.left()

    def _pairs(self, distances: tuple[int, ...], both: bool) -> list[tuple[int, int]]:
        """Frames to link: at the given distances, away from the reference frame or both ways, and from it to all."""
        pairs = {(self.ref, t) for t in range(self.frames)} - {(self.ref, self.ref)}
        for early in range(self.frames):
            for late in (early + d for d in distances if early + d < self.frames):
                outward = (early, late) if early + late >= 2 * self.ref else (late, early)
                pairs |= {(early, late), (late, early)} if both else {outward}
        return sorted(pairs)

    # --- outward pass

    def _outward(self) -> tuple[Path, list[Sight], np.ndarray]:
        """Poses one after the other, from the reference frame to both ends.

        Returns the path, the matches of all frames, and (T,) which frames came after the deadline: their poses are
        only where the object's pixels are.
        """
        surface = self.surfaces.surfaces[self.ref]
        centre = np.zeros(3) if surface is None else _middle(surface)
        path = still_path(self.frames, centre, self.ref)
        matches: list[Sight] = []
        rough = np.zeros(self.frames, bool)
        for direction in (1, -1):
            done = [self.ref]
            t = self.ref + direction
            while 0 <= t < self.frames:
                rough[t] = self.deadline.over()
                if rough[t]:
                    here = self.anchor[t] if self.seen[t] else path.position[t - direction]
                    path = path.moved(t, path.rotation[t - direction], here)
                else:
                    path, sights = self._next(path, t, direction, done)
                    matches += sights
                if self.seen[t]:
                    done.append(t)
                t += direction
        return path, matches, rough

    def _next(self, path: Path, t: int, direction: int, done: list[int]) -> tuple[Path, list[Sight]]:
        """The path with the pose of frame t found from the frames done before it, and the matches it was found by."""
        rotation, position = _continued(path, t, direction)
        if not self.seen[t]:  # slower and slower: a motion does not go on for long unseen
            last = path.position[t - direction]
            return path.moved(t, path.rotation[t - direction], last + _UNSEEN**self.stride * (position - last)), []
        path = path.moved(t, rotation, position)
        sources = [s for s in done if abs(s - t) in _BACK] or done[-1:]
        path = self._best_start(path, sources[-1], t)
        free, known = np.zeros(self.frames, bool), np.zeros(self.frames, bool)
        free[t] = True
        known[min(self.ref, t) : max(self.ref, t) + 1] = True
        sights: list[Sight] = []
        for _ in range(2):
            sights = self._sights(path, [(s, t) for s in sources])
            path, _ = solve(path, self._problem(sights), free, known)
        if self._lost(path, t):  # it stays where it was, and the next frame starts anew
            return path.moved(t, path.rotation[t - direction], path.position[t - direction]), []
        return path, sights

    def _lost(self, path: Path, t: int) -> bool:
        """Whether the pose of frame t is none: not finite, or many times as far from the camera as at first."""
        cameras = self.surfaces.cameras
        first = np.linalg.norm(path.position[self.ref] - camera_centre(cameras, self.ref))
        here = np.linalg.norm(path.position[t] - camera_centre(cameras, t))
        return not (np.isfinite(path.rotation[t]).all() and here < _FARTHEST * max(float(first), self.surfaces.size))

    def _best_start(self, path: Path, s: int, t: int) -> Path:
        """The path as predicted, or shifted to one of the best overlaps, whichever matches frame t best.

        Far moves need better matches: score / (1 + (move / allowed)^2), where allowed is the
        object's size, or a part of it once its velocity is known.
        """
        surface = self.surfaces.surfaces[s]
        if surface is None:
            return path
        moved = path.between(s, t, surface.points)
        predicted = project(self.surfaces.cameras, t, moved).astype(np.float32)
        pose, k = self.surfaces.cameras.world_to_camera[t], self.surfaces.cameras.K[t]
        z = float(np.median((moved[surface.grid.inside] @ pose[:3, :3].T + pose[:3, 3])[:, 2]))
        moves = [np.zeros(3)]
        if self.anchor_weight[s] > 0 and self.anchor_weight[t] > 0:
            moves.append(self.anchor[t] - np.median(moved[surface.grid.inside], axis=0))
        steady = abs(s - t) == 1 and s != self.ref  # the velocity is known
        lost = not bool((np.abs(predicted) < _FAR).all())  # behind the camera or far outside: nothing to search
        hidden = lost or (steady and self.surfaces.layer.mask[t].sum() < _SCRAP * self.surfaces.area.max())
        for shift in [] if hidden else best_shifts(self.surfaces.layer, surface.grid, t, predicted):
            moves.append(np.array([shift[0] / k[0, 0] * z, shift[1] / k[1, 1] * z, 0.0]) @ pose[:3, :3])
        allowed = self.surfaces.size * (min(_JUMP * self.stride, 1.0) if steady else 1.0)
        best, best_score = path, -1.0
        for move in moves:
            tried = path.moved(t, path.rotation[t], path.position[t] + move)
            link = self._link(tried, s, t)
            score = 0.0 if link is None else link.score / (1.0 + float(move @ move) / allowed**2)
            if score > best_score:
                best, best_score = tried, score
        return best

    # --- judgement

    def _confidence(self, sights: list[Sight]) -> np.ndarray:  # (T,)
        """Matched weight of every frame, full at half the usual; 0 where the object is not seen."""
        support = np.zeros(self.frames)
        for sight in sights:
            if sight.facing is None:
                support[sight.target] += sight.weight.sum()
        usual = max(float(np.median(support[self.seen])), 1e-9)
        confidence = np.clip(2.0 * support / usual, 0.0, 1.0)
        confidence[self.ref] = 1.0
        return confidence

    def _contained(self, path: Path) -> np.ndarray:  # (T,)
        """1 where at least half of the reference surface falls on the object's mask, or where it may be hidden.

        Matches among frames that all lost the object agree with one another; its mask tells.
        """
        surface, layer = self.surfaces.surfaces[self.ref], self.surfaces.layer
        contained = np.zeros(self.frames)
        if surface is None:
            return contained
        points = surface.points[surface.grid.inside]
        height, width = layer.mask.shape[1:]
        for t in map(int, np.nonzero(self.seen)[0]):
            xy = project(self.surfaces.cameras, t, path.between(self.ref, t, points))
            inside = np.all((xy >= 0) & (xy < [width, height]), axis=1)
            column, row = np.where(inside[:, None], xy, 0).astype(np.int64).T
            may = ~inside | layer.mask[t, row, column] | layer.other[t, row, column]
            contained[t] = min(1.0, 2.0 * float(may.mean()))
        return contained

    def _residual(self, path: Path, bend: Bend, sights: list[Sight]) -> float:
        """Median distance in pixels of the matches to what path and bend predict."""
        residuals = [np.zeros(0)]
        for sight in sights:
            if sight.facing is None:
                world = carried(path, bend, sight.source, sight.target, self._points(sight.index))
                seen = project(self.surfaces.cameras, sight.target, world)
                residuals.append(np.linalg.norm(seen - sight.xy, axis=1))
        every = np.concatenate(residuals)
        return float(np.median(every)) if len(every) else 0.0


def _middle(surface: Surface) -> np.ndarray:  # (3,) world
    """Median of the visible surface."""
    return np.median(surface.points[surface.grid.inside], axis=0)


def _continued(path: Path, t: int, direction: int) -> tuple[np.ndarray, np.ndarray]:
    """Rotation and position of frame t if the last motion goes on."""
    last, before = t - direction, t - 2 * direction
    if not 0 <= before < len(path.position) or last == path.ref:
        return path.rotation[last], path.position[last]
    turn = path.rotation[last] @ path.rotation[before].T
    return turn @ path.rotation[last], 2 * path.position[last] - path.position[before]
