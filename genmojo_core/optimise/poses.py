"""Rigid motion of one object through a clip, solved jointly from flow links between many pairs of frames.

Unknowns are the object's pose in every frame and, where the depth is a guess, the depth of every source point along
its ray. Residuals are reprojection errors in pixels, distances to the target's surface, and second differences in time
(so that hidden frames are interpolated). Gauss-Newton with a redescending kernel. ARCHITECTURE.md section 6.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import cv2
import numpy as np

from genmojo_core.clip.cameras import Cameras

DEPTH_RANGE = 2.0  # a guessed depth may become half or twice as much, no more


@dataclass(frozen=True)
class Path:
    """Where the object is: X at frame t = rotation[t] (X_ref - centre) + position[t], world coordinates.

    Args:
        rotation: (T, 3, 3) float64.
        position: (T, 3) float64, where the centre goes.
        centre: (3,) float64 world, the object's centre at the reference frame.
        ref: reference frame; there the rotation is the identity and the position the centre.
    """

    rotation: np.ndarray
    position: np.ndarray
    centre: np.ndarray
    ref: int

    def between(self, s: int, t: int, points: np.ndarray) -> np.ndarray:
        """World points (..., 3) on the object at frame s, carried to frame t."""
        return (points - self.position[s]) @ (self.rotation[t] @ self.rotation[s].T).T + self.position[t]

    def matrices(self) -> np.ndarray:
        """(T, 4, 4) maps from world points at the reference frame to world points at each frame."""
        out = np.tile(np.eye(4), (len(self.position), 1, 1))
        out[:, :3, :3] = self.rotation
        out[:, :3, 3] = self.position - self.rotation @ self.centre
        return out

    def moved(self, t: int, rotation: np.ndarray, position: np.ndarray) -> Path:
        """The same path with another pose in frame t; its rotation is made exact.

        Predictions multiply rotations of earlier frames: a rounding error not taken out grows with every frame.
        """
        rotations, positions = self.rotation.copy(), self.position.copy()
        rotations[t], positions[t] = exp_rotation(log_rotation(rotation)), position
        return replace(self, rotation=rotations, position=positions)


@dataclass(frozen=True)
class Sight:
    """Points of the object in a source frame as matched in a target frame.

    Args:
        source, target: frames.
        index: (N,) int64 places of the points in the problem's list of depths.
        xy: (N, 2) raster pixels in the target frame.
        weight: (N,) 0..1.
        surface: (N, 3) world points of the target's surface at xy.
        normal: (N, 3) unit normals there; zero where unknown.
        facing: (N, 2) image normals if the points lie on an outline, which says nothing along itself; else None.
    """

    source: int
    target: int
    index: np.ndarray
    xy: np.ndarray
    weight: np.ndarray
    surface: np.ndarray
    normal: np.ndarray
    facing: np.ndarray | None = None


@dataclass(frozen=True)
class Problem:
    """What a solve needs besides the path.

    Args:
        cameras: of all frames.
        origin: (M, 3) camera centre of each source point's frame. ray: (M, 3) world ray of depth 1.
        depth: (M,) depth along the ray. size: scene units across the object.
        sights: the matches.
        pixel_sigma, outline_sigma: pixels; robust scale of the matches of texture and of outlines.
        surface_sigma: scene units; robust scale of the distance to the target's surface (0: do not use it).
        depth_sigma: scene units; how far depths may move (0: they are exact and stay).
        turn_weight: cost per rad^2 of turning between neighbouring frames.
        anchor, anchor_weight: (T, 3) world and (T,) per unit^2: where the centre lies by the mask alone, to hold frames
            together that no match connects; None: nothing is known.
    """

    cameras: Cameras
    origin: np.ndarray
    ray: np.ndarray
    depth: np.ndarray
    size: float
    sights: tuple[Sight, ...]
    pixel_sigma: float = 1.0
    outline_sigma: float = 2.0
    surface_sigma: float = 0.0
    depth_sigma: float = 0.0
    turn_weight: float = 0.0
    anchor: np.ndarray | None = None
    anchor_weight: np.ndarray | None = None


def still_path(frames: int, centre: np.ndarray, ref: int) -> Path:
    """A path that does not move."""
    return Path(np.tile(np.eye(3), (frames, 1, 1)), np.tile(centre, (frames, 1)), centre, ref)


def project(cameras: Cameras, t: int, points: np.ndarray) -> np.ndarray:  # (..., 3) world -> (..., 2) raster pixels
    """Image places of world points in frame t; points behind the camera land far outside."""
    pose, k = cameras.world_to_camera[t], cameras.K[t]
    x = points @ pose[:3, :3].T + pose[:3, 3]
    z = np.maximum(x[..., 2:], 1e-6)
    return x[..., :2] / z * [k[0, 0], k[1, 1]] + k[:2, 2]


def rays(cameras: Cameras, t: int, xy: np.ndarray) -> np.ndarray:  # (..., 2) raster pixels -> (..., 3) world
    """World directions through image places, of length such that depth (z) is 1."""
    k, rotation = cameras.K[t], cameras.world_to_camera[t][:3, :3]
    local = np.concatenate([(xy - k[:2, 2]) / [k[0, 0], k[1, 1]], np.ones((*xy.shape[:-1], 1))], axis=-1)
    return local @ rotation


def camera_centre(cameras: Cameras, t: int) -> np.ndarray:  # (3,) world
    """Where the camera of frame t is."""
    pose = cameras.world_to_camera[t]
    return -pose[:3, :3].T @ pose[:3, 3]


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
    for _ in range(rounds):
        normal = np.zeros((6 * count, 6 * count))
        right = np.zeros(6 * count)
        shape = _ShapeTerms(len(depth), 6 * count, problem.depth_sigma)
        for sight in problem.sights:
            if free[sight.source] or free[sight.target]:
                _add_sight(normal, right, shape, sight, problem, path, depth, free, slot)
        _add_smoothness(normal, right, path, (free, known), slot, problem.size)
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
    """The depths' part of the normal equations; the depths are independent, so they are eliminated exactly."""

    def __init__(self, points: int, unknowns: int, sigma: float) -> None:
        self.sigma = sigma
        self.on = sigma > 0
        self.diagonal = np.zeros(points if self.on else 0)
        self.cross = np.zeros((points if self.on else 0, unknowns))
        self.right = np.zeros(points if self.on else 0)

    def eliminate(self, normal: np.ndarray, right: np.ndarray, offset: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Steps of poses and depths; `offset` (M,) is how far the depths are from their prior."""
        damped = normal + np.diag(1e-6 * np.diag(normal) + 1e-9)
        if not self.on:
            return np.linalg.solve(damped, right), np.zeros(len(offset))
        diagonal = self.diagonal + 1.0 / self.sigma**2
        b = self.right - offset / self.sigma**2
        share = self.cross / diagonal[:, None]
        step = np.linalg.solve(damped - self.cross.T @ share, right - share.T @ b)
        return step, (b - self.cross @ step) / diagonal


def _add_sight(
    normal: np.ndarray,
    right: np.ndarray,
    shape: _ShapeTerms,
    sight: Sight,
    problem: Problem,
    path: Path,
    depth: np.ndarray,
    *frames: np.ndarray,  # free, slot
) -> None:
    """Add one sight's reprojection and surface residuals to the normal equations."""
    free, slot = frames
    s, t, index = sight.source, sight.target, sight.index
    turn = path.rotation[t] @ path.rotation[s].T
    before = problem.origin[index] + depth[index, None] * problem.ray[index] - path.position[s]
    after = before @ turn.T
    world = after + path.position[t]
    rows, errors, noise = residual_rows(problem, sight, world)
    size = errors / noise
    weights = robust_weights(size, sight.weight) / noise**2
    blocks: list[tuple[slice, np.ndarray]] = []
    if free[t]:
        blocks.append((_six(slot[t]), np.concatenate([_cross_rows(rows, after), rows], axis=2)))
    if free[s]:
        back = rows @ turn
        blocks.append((_six(slot[s]), -np.concatenate([_cross_rows(back, before), back], axis=2)))
    along = np.einsum("nri,ni->nr", rows, problem.ray[index] @ turn.T) if shape.on else None
    for place, block in blocks:
        weighted = block * weights[..., None]
        right[place] += np.einsum("nri,nr->i", weighted, errors)
        for other, second in blocks:
            normal[place, other] += np.einsum("nri,nrj->ij", weighted, second)
        if along is not None:
            shape.cross[index, place] += np.einsum("nri,nr->ni", weighted, along)
    if along is not None:
        shape.diagonal[index] += (weights * along * along).sum(axis=1)
        shape.right[index] += (weights * along * errors).sum(axis=1)


def residual_rows(problem: Problem, sight: Sight, world: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """What is missing between world points (N, 3) and their matches.

    Returns derivatives (N, R, 3) by the points, residuals (N, R) and their noise (R,): image x, y and distance to the
    target's surface, or for points of an outline only the distance across it.
    """
    rows, errors = image_rows(problem.cameras, sight.target, world, sight.xy)
    if sight.facing is not None:
        across = np.einsum("ni,nij->nj", sight.facing, rows)[:, None]
        return across, (sight.facing * errors).sum(axis=1, keepdims=True), np.array([problem.outline_sigma])
    if problem.surface_sigma <= 0:
        return rows, errors, np.full(2, problem.pixel_sigma)
    gap = np.einsum("ni,ni->n", sight.normal, sight.surface - world)
    rows = np.concatenate([rows, sight.normal[:, None]], axis=1)
    noise = np.array([problem.pixel_sigma, problem.pixel_sigma, problem.surface_sigma])
    return rows, np.concatenate([errors, gap[:, None]], axis=1), noise


def image_rows(cameras: Cameras, t: int, world: np.ndarray, xy: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Derivative (N, 2, 3) of image places by world points, and what is missing (N, 2) to the matched places."""
    pose, k = cameras.world_to_camera[t], cameras.K[t]
    x = world @ pose[:3, :3].T + pose[:3, 3]
    z = np.maximum(x[:, 2], 1e-6)
    local = np.zeros((len(x), 2, 3))
    local[:, 0, 0], local[:, 1, 1] = k[0, 0] / z, k[1, 1] / z
    local[:, 0, 2], local[:, 1, 2] = -k[0, 0] * x[:, 0] / z**2, -k[1, 1] * x[:, 1] / z**2
    seen = x[:, :2] / z[:, None] * [k[0, 0], k[1, 1]] + k[:2, 2]
    return local @ pose[:3, :3], xy - seen


def robust_weights(errors: np.ndarray, weight: np.ndarray) -> np.ndarray:  # (N, R), (N,) -> (N, R)
    """Geman-McClure weights of residuals in units of their noise; image x and y share one, the surface has its own.

    Scaled so that one sight counts as at most 40 independent points.
    """
    image = np.linalg.norm(errors[:, :2], axis=1)
    kernel = np.tile(_kernel(image)[:, None], (1, errors.shape[1]))
    if errors.shape[1] == 3:
        kernel[:, 2] = _kernel(np.abs(errors[:, 2]))
    return kernel * weight[:, None] * min(1.0, 40.0 / max(len(errors), 1))


def _kernel(error: np.ndarray) -> np.ndarray:
    """Geman-McClure weight, a quarter at twice the noise."""
    return 1.0 / (1.0 + (error / 2.0) ** 2) ** 2


def _cross_rows(rows: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Rows (N, R, 3) times the derivative of a turn about the origin of points (N, 3)."""
    x, y, z = points[:, None].transpose(2, 0, 1)
    a, b, c = rows.transpose(2, 0, 1)
    return np.stack([y * c - z * b, z * a - x * c, x * b - y * a], axis=-1)


def _six(slot: int) -> slice:
    """The six unknowns of a free frame."""
    return slice(6 * slot, 6 * slot + 6)


def _add_smoothness(
    normal: np.ndarray,
    right: np.ndarray,
    path: Path,
    frames: tuple[np.ndarray, np.ndarray],  # free, known
    slot: np.ndarray,
    size: float,
) -> None:
    """Second differences of position (sigma 3 % of the size) and of rotation (sigma 2 degrees) in time."""
    weights = np.repeat([1.0 / np.deg2rad(2.0) ** 2, 1.0 / (0.03 * size) ** 2], 3)
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


def log_rotation(rotation: np.ndarray) -> np.ndarray:  # (3, 3) -> (3,)
    """Rotation vector of a rotation matrix."""
    return cv2.Rodrigues(np.ascontiguousarray(rotation))[0][:, 0]


def exp_rotation(vector: np.ndarray) -> np.ndarray:  # (3,) -> (3, 3)
    """Rotation matrix of a rotation vector."""
    return cv2.Rodrigues(np.asarray(vector, np.float64))[0]


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
