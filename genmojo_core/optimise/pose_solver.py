"""Rigid motion of one object through a clip, solved jointly from flow links between many pairs of frames.

Unknowns are the object's pose in every frame and, where the depth is a guess, the depth of every source point along
its ray. Residuals are reprojection errors in pixels, distances to the target's surface, and second differences in time
(so that hidden frames are interpolated). Gauss-Newton with a redescending kernel. ARCHITECTURE.md section 6.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from genmojo_core.clip.cameras import Cameras
from genmojo_core.optimise.poses import Path, Problem, Sight, exp_rotation, log_rotation

DEPTH_RANGE = 2.0  # a guessed depth may become half or twice as much, no more


def solve(
    path: Path, problem: Problem, free: np.ndarray, known: np.ndarray, rounds: int = 6
) -> tuple[Path, np.ndarray]:
    """Improve the poses of the free frames, and the depths if they are guesses.

    Args:
        path: start.
        problem: matches and their noise.
        free: (T,) bool frames whose pose may change (the reference frame never does).
        known: (T,) bool frames whose pose means something: only these are asked to move smoothly.
        rounds: Gauss-Newton steps.

    Returns the path and the depths (M,).
    """
    free = free.copy()
    free[path.ref] = False
    slot = np.cumsum(free) - 1
    count = int(free.sum())
    depth, prior = problem.depth.copy(), problem.depth
    if count == 0:
        return path, depth
    sights = [sight for sight in problem.sights if len(sight.index) and (free[sight.source] or free[sight.target])]
    kinds = ([s for s in sights if s.facing is None], [s for s in sights if s.facing is not None])
    joined = [Joined(kind, free, slot) for kind in kinds if kind]
    for _ in range(rounds):
        normal = np.zeros((6 * count, 6 * count))
        right = np.zeros(6 * count)
        shape = _ShapeTerms(problem, sights, free, slot)
        for matches in joined:
            _add_matches(normal, right, shape, matches, problem, path, depth)
        _add_smoothness(normal, right, path, (free, known), slot, problem)
        if problem.turn_weight > 0:
            _add_stillness(normal, right, path, (free, known), slot, problem.turn_weight)
        if problem.anchor is not None and problem.anchor_weight is not None:
            for t in np.nonzero(free)[0]:
                place = slice(6 * slot[t] + 3, 6 * slot[t] + 6)
                normal[place, place] += problem.anchor_weight[t] * np.eye(3)
                right[place] += problem.anchor_weight[t] * (problem.anchor[t] - path.position[t])
        step, depth_step = shape.eliminate(normal, right, depth - prior)
        if not (np.isfinite(step).all() and np.isfinite(depth_step).all()):
            break  # matches that determine nothing: what stands is kept
        depth = np.clip(depth + depth_step, prior / DEPTH_RANGE, prior * DEPTH_RANGE)
        path = _stepped(path, step, free, slot, problem.size)
        if np.abs(step).max() < 1e-5 * max(problem.size, 1e-9):
            break
    return path, depth


class _ShapeTerms:
    """The depths' part of the normal equations; the depths are independent, so they are eliminated exactly.

    A depth of frame s couples only the poses of s and of the frames it is matched in, so the coupling is kept per
    source frame: the cost grows with the matches, not with frames times depths.
    """

    def __init__(self, problem: Problem, active: list[Sight], free: np.ndarray, slot: np.ndarray) -> None:
        self.sigma = problem.depth_sigma
        self.on = self.sigma > 0
        count = len(problem.depth) if self.on else 0
        self.diagonal, self.right = np.zeros(count), np.zeros(count)
        self.blocks: dict[int, _Coupling] = {}
        if not self.on:
            return
        for source in {sight.source for sight in active}:
            own = [sight for sight in active if sight.source == source]
            slots = sorted({int(slot[f]) for f in [source, *(sight.target for sight in own)] if free[f]})
            low, high = min(sight.index.min() for sight in own), max(sight.index.max() for sight in own) + 1
            self.blocks[source] = _Coupling(int(low), int(high), slots)

    def add(self, index: np.ndarray, weighted: np.ndarray, along: np.ndarray, errors: np.ndarray) -> None:
        """Add what residuals (N, R) say of depths `index` (N,); `weighted`: derivatives `along` times weights."""
        count = len(self.diagonal)
        self.diagonal += np.bincount(index, (weighted * along).sum(axis=1), count)
        self.right += np.bincount(index, (weighted * errors).sum(axis=1), count)

    def eliminate(self, normal: np.ndarray, right: np.ndarray, offset: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Steps of poses and depths; `offset` (M,) is how far the depths are from their prior."""
        damped = normal + np.diag(1e-6 * np.diag(normal) + 1e-9)
        if not self.on:
            return np.linalg.solve(damped, right), np.zeros(len(offset))
        diagonal = self.diagonal + 1.0 / self.sigma**2
        b = self.right - offset / self.sigma**2
        right = right.copy()
        for block in self.blocks.values():
            share = block.cross / diagonal[block.points, None]
            damped[np.ix_(block.unknowns, block.unknowns)] -= block.cross.T @ share
            right[block.unknowns] -= share.T @ b[block.points]
        step = np.linalg.solve(damped, right)
        for block in self.blocks.values():
            b[block.points] -= block.cross @ step[block.unknowns]
        return step, b / diagonal


class _Coupling:
    """Between the depths low..high of one source frame and the poses of some free frames (by slot)."""

    def __init__(self, low: int, high: int, slots: list[int]) -> None:
        self.points = slice(low, high)
        self.unknowns = np.concatenate([np.arange(6 * s, 6 * s + 6) for s in slots])
        self.column = {s: 6 * i for i, s in enumerate(slots)}
        self.cross = np.zeros((high - low, 6 * len(slots)))

    def add(self, index: np.ndarray, slot: int, values: np.ndarray) -> None:
        """Add (N, 6) values for depths `index` (N,) and the pose of a slot."""
        column = self.column[slot]
        self.cross[index - self.points.start, column : column + 6] += values


class Joined:
    """Sights of one kind, of texture or of outlines, end to end: N points of S sights are worked on at once.

    Args (also attributes):
        sights: none is empty. free: (T,) bool. slot: (T,) place of a frame's pose among the free ones.
    """

    def __init__(self, sights: list[Sight], free: np.ndarray, slot: np.ndarray) -> None:
        count = [len(sight.index) for sight in sights]
        ends = np.cumsum(count)
        self.parts = [slice(int(end) - n, int(end)) for end, n in zip(ends, count, strict=True)]
        self.of = np.repeat(np.arange(len(sights)), count)  # (N,)
        self.sources = np.array([sight.source for sight in sights])
        self.targets = np.array([sight.target for sight in sights])
        place = np.where(free, slot, -1)
        self.slots = np.stack([place[self.sources], place[self.targets]], axis=1)  # (S, 2), -1: the pose stays
        self.index = np.concatenate([sight.index for sight in sights])
        self.xy = np.concatenate([sight.xy for sight in sights])
        self.surface = np.concatenate([sight.surface for sight in sights])
        self.normal = np.concatenate([sight.normal for sight in sights])
        self.shares = np.concatenate([sight.shares for sight in sights])
        outlined = [sight.facing for sight in sights if sight.facing is not None]
        self.facing = np.concatenate(outlined) if outlined else None


def _add_matches(
    normal: np.ndarray,
    right: np.ndarray,
    shape: _ShapeTerms,
    matches: Joined,
    problem: Problem,
    path: Path,
    depth: np.ndarray,
) -> None:
    """Add the reprojection and surface residuals of sights to the normal equations.

    A point moves in the target frame by -J T if the source's pose moves by what moves it by J if the target's does,
    where T turns both halves of a pose's step from source to target: one product per sight serves both frames.
    """
    turns = path.rotation[matches.targets] @ path.rotation[matches.sources].transpose(0, 2, 1)
    turn, index = turns[matches.of], matches.index
    source, target = matches.sources[matches.of], matches.targets[matches.of]
    after = _turned(turn, problem.origin[index] + depth[index, None] * problem.ray[index] - path.position[source])
    rows, errors, noise = residual_rows(problem, matches, target, after + path.position[target])
    weights = robust_weights(errors / noise, matches.shares) / noise**2
    block = np.concatenate([_cross_rows(rows, after), rows], axis=2)
    weighted = block * weights[..., None]
    along, cross = np.zeros(weights.shape), np.zeros((len(index), 6))
    if shape.on:
        along = (rows @ _turned(turn, problem.ray[index])[..., None])[..., 0]
        cross = (weighted * along[..., None]).sum(axis=1)
        shape.add(index, weights * along, along, errors)
    flat, straight = weighted.reshape(-1, 6), block.reshape(-1, 6)
    lines = [slice(part.start * rows.shape[1], part.stop * rows.shape[1]) for part in matches.parts]
    square = np.stack([flat[line].T @ straight[line] for line in lines])
    pull = np.stack([flat[line].T @ errors.reshape(-1)[line] for line in lines])
    back = np.zeros_like(square)
    back[:, :3, :3] = back[:, 3:, 3:] = -turns
    _scatter(normal, right, matches.slots, square, pull, back)
    for i, part in enumerate(matches.parts if shape.on else ()):
        coupling, (here, there) = shape.blocks[int(matches.sources[i])], matches.slots[i]
        if there >= 0:
            coupling.add(index[part], int(there), cross[part])
        if here >= 0:
            coupling.add(index[part], int(here), cross[part] @ back[i])


def _scatter(
    normal: np.ndarray, right: np.ndarray, slots: np.ndarray, square: np.ndarray, pull: np.ndarray, back: np.ndarray
) -> None:  # fmt: skip
    """Add sights' products (S, 6, 6) and pulls (S, 6) on the target's pose to both poses' places, by `back` (S, 6, 6).

    slots: (S, 2) places of the source's and the target's pose, -1 for one that stays.
    """
    forth = back.transpose(0, 2, 1)
    blocks, rights = normal.reshape(len(right) // 6, 6, -1, 6).transpose(0, 2, 1, 3), right.reshape(-1, 6)
    here, there = slots.T
    at_source, at_target, at_both = here >= 0, there >= 0, (here >= 0) & (there >= 0)
    np.add.at(blocks, (there[at_target], there[at_target]), square[at_target])
    np.add.at(blocks, (here[at_source], here[at_source]), (forth @ square @ back)[at_source])
    np.add.at(blocks, (there[at_both], here[at_both]), (square @ back)[at_both])
    np.add.at(blocks, (here[at_both], there[at_both]), (forth @ square)[at_both])
    np.add.at(rights, there[at_target], pull[at_target])
    np.add.at(rights, here[at_source], (forth @ pull[..., None])[at_source, :, 0])


def _turned(turn: np.ndarray, points: np.ndarray) -> np.ndarray:  # (N, 3, 3), (N, 3) -> (N, 3)
    """Every point by its own rotation."""
    return (turn @ points[..., None])[..., 0]


def residual_rows(
    problem: Problem, sight: Sight | Joined, t: int | np.ndarray, world: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """What is missing between world points (N, 3) and their matches in frame t, or each in a frame of its own, t (N,).

    Returns derivatives (N, R, 3) by the points, residuals (N, R) and their noise (R,): image x, y and distance to the
    target's surface, or for points of an outline only the distance across it.
    """
    rows, errors = image_rows(problem.cameras, t, world, sight.xy)
    if sight.facing is not None:
        across = sight.facing[:, None] @ rows
        return across, (sight.facing * errors).sum(axis=1, keepdims=True), np.array([problem.outline_sigma])
    if problem.surface_sigma <= 0:
        return rows, errors, np.full(2, problem.pixel_sigma)
    gap = (sight.normal * (sight.surface - world)).sum(axis=1)
    rows = np.concatenate([rows, sight.normal[:, None]], axis=1)
    noise = np.array([problem.pixel_sigma, problem.pixel_sigma, problem.surface_sigma])
    return rows, np.concatenate([errors, gap[:, None]], axis=1), noise


def image_rows(
    cameras: Cameras, t: int | np.ndarray, world: np.ndarray, xy: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Derivative (N, 2, 3) of image places by world points, and what is missing (N, 2) to the matched places.

    t: the frame that all are seen in, or (N,) one each.
    """
    pose, k = cameras.world_to_camera[t], cameras.K[t]
    turn, focal = pose[..., :3, :3], np.stack([k[..., 0, 0], k[..., 1, 1]], axis=-1)
    x = (turn @ world[..., None])[..., 0] + pose[..., :3, 3]
    z = np.maximum(x[:, 2:], 1e-6)
    scale = focal / z
    local = np.zeros((len(x), 2, 3))
    local[:, 0, 0], local[:, 1, 1] = scale.T
    seen = x[:, :2] * scale
    local[:, :, 2] = -seen / z
    return local @ turn, xy - seen - k[..., :2, 2]


def robust_weights(errors: np.ndarray, shares: np.ndarray) -> np.ndarray:  # (N, R), (N,) -> (N, R)
    """Geman-McClure weights of residuals in units of their noise; image x and y share one, the surface has its own.

    shares: `Sight.shares` of the points.
    """
    kernel = np.empty_like(errors)
    kernel[:, :2] = _kernel((errors[:, :2] ** 2).sum(axis=1))[:, None]
    if errors.shape[1] == 3:
        kernel[:, 2] = _kernel(errors[:, 2] ** 2)
    return kernel * shares[:, None]


def _kernel(square: np.ndarray) -> np.ndarray:
    """Geman-McClure weight of squared errors, a quarter at twice the noise."""
    return 1.0 / (1.0 + square / 4.0) ** 2


def _cross_rows(rows: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Rows (N, R, 3) times the derivative of a turn about the origin of points (N, 3)."""
    x, y, z = points.T[..., None]
    a, b, c = rows[..., 0], rows[..., 1], rows[..., 2]
    out = np.empty_like(rows)
    out[..., 0], out[..., 1], out[..., 2] = y * c - z * b, z * a - x * c, x * b - y * a
    return out


def _six(slot: int) -> slice:
    """The six unknowns of a free frame."""
    return slice(6 * slot, 6 * slot + 6)


def _add_smoothness(
    normal: np.ndarray,
    right: np.ndarray,
    path: Path,
    frames: tuple[np.ndarray, np.ndarray],  # free, known
    slot: np.ndarray,
    problem: Problem,
) -> None:
    """Second differences of position (sigma 3 % of the size) and of rotation (sigma 2 degrees) in time."""
    weights = np.repeat([1.0 / np.deg2rad(2.0) ** 2, 1.0 / (0.03 * problem.size) ** 2], 3) / problem.stride**2
    free, known = frames
    for t in range(1, len(path.position) - 1):
        if not known[t - 1 : t + 2].all():
            continue
        bend = path.position[t + 1] - 2 * path.position[t] + path.position[t - 1]
        turn = log_rotation(path.rotation[t + 1] @ path.rotation[t].T)
        turn -= log_rotation(path.rotation[t] @ path.rotation[t - 1].T)
        error = -np.concatenate([turn, bend])
        terms = [(f, c) for f, c in ((t - 1, 1.0), (t, -2.0), (t + 1, 1.0)) if free[f]]
        for f, c in terms:
            right[_six(slot[f])] += c * weights * error
            for g, d in terms:
                normal[_six(slot[f]), _six(slot[g])] += np.diag(c * d * weights)


def _add_stillness(
    normal: np.ndarray,
    right: np.ndarray,
    path: Path,
    frames: tuple[np.ndarray, np.ndarray],  # free, known
    slot: np.ndarray,
    weight: float,
) -> None:
    """Turning between neighbouring frames costs `weight` per rad^2: a guessed shape must not explain all by turning."""
    free, known = frames
    for t in range(len(path.position) - 1):
        if not (known[t] and known[t + 1]):
            continue
        turn = log_rotation(path.rotation[t + 1] @ path.rotation[t].T)
        terms = [(f, c) for f, c in ((t, -1.0), (t + 1, 1.0)) if free[f]]
        for f, c in terms:
            place = slice(6 * slot[f], 6 * slot[f] + 3)
            right[place] -= c * weight * turn
            for g, d in terms:
                normal[place, 6 * slot[g] : 6 * slot[g] + 3] += c * d * weight * np.eye(3)


def _stepped(path: Path, step: np.ndarray, free: np.ndarray, slot: np.ndarray, size: float) -> Path:
    """The path after a Gauss-Newton step; turns are limited to 0.3 rad, moves to half the object's size."""
    rotation, position = path.rotation.copy(), path.position.copy()
    for t in np.nonzero(free)[0]:
        part = step[_six(slot[t])]
        angle = float(np.linalg.norm(part[:3]))
        turned = exp_rotation(part[:3] * min(1.0, 0.3 / max(angle, 1e-12))) @ rotation[t]
        rotation[t] = exp_rotation(log_rotation(turned))
        far = float(np.linalg.norm(part[3:]))
        position[t] = position[t] + part[3:] * min(1.0, 0.5 * size / max(far, 1e-12))
    return replace(path, rotation=rotation, position=position)
