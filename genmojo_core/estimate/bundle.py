"""Bundle adjustment of a clip's cameras and background points, with what is believed of their depth as a prior.

Unknown are a pose per frame (but frame 0's), the log inverse depth of every point in the frame it was first seen, and
the log focal length. Levenberg-Marquardt with Cauchy weights; depths are eliminated (Schur complement), so the system
solved has six rows a frame. Poses are changed from the left: T <- exp(turn, shift) T.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import cv2
import numpy as np


@dataclass(frozen=True)
class Bundle:
    """Cameras, points and what was seen of them.

    Args:
        poses: (T, 4, 4) world to camera. intrinsics: (3, 3).
        log_depth: (N,) of the points in their first frame. start: (N,) that frame.
        at_start: (N, 2) raster pixels there.
        point, frame, xy: (M,), (M,), (M, 2): observations in later frames, raster pixels.
        believed: (N,) prior log depth. doubt: (N,) its deviation.
        focal_doubt: deviation of the log focal length from 0 change; 0 keeps it fixed.
        moves: False keeps all cameras in one place and all depths as they are.
        log_focal: change of the log focal length found. tolerance: pixels, scale of the Cauchy weights.
    """

    poses: np.ndarray
    intrinsics: np.ndarray
    log_depth: np.ndarray
    start: np.ndarray
    at_start: np.ndarray
    point: np.ndarray
    frame: np.ndarray
    xy: np.ndarray
    believed: np.ndarray
    doubt: np.ndarray
    focal_doubt: float = 0.0
    moves: bool = True
    log_focal: float = 0.0
    tolerance: float = 1.0

    def lens(self) -> np.ndarray:  # (3, 3)
        """Intrinsics with the focal length found."""
        return self.intrinsics @ np.diag([1, 1, np.exp(-self.log_focal)]) * np.exp(self.log_focal)


@dataclass(frozen=True)
class _Linear:
    """Residuals (M, 2) and their derivatives by this frame's pose, the first frame's pose, depth and focal length."""

    residual: np.ndarray
    by_pose: np.ndarray  # (M, 2, 6)
    by_start: np.ndarray  # (M, 2, 6)
    by_depth: np.ndarray  # (M, 2)
    by_focal: np.ndarray  # (M, 2)


def adjust(bundle: Bundle, rounds: int = 25, enough: float = 1e-4) -> Bundle:
    """The bundle at (nearly) least cost, which never rises; a round that gains a share under `enough` is the last."""
    damping, now = 1e-3, cost(bundle)
    for _ in range(rounds):
        step = _step(bundle, damping)
        changed = _moved(bundle, *step)
        changed_cost = cost(changed)
        if changed_cost < now:
            done = now - changed_cost < enough * now
            bundle, now, damping = changed, changed_cost, max(damping / 5, 1e-7)
            if done:
                break
        else:
            damping *= 8
            if damping > 1e6:
                break
    return bundle


def errors(bundle: Bundle) -> np.ndarray:  # (M,) pixels
    """Reprojection error of every observation."""
    return np.linalg.norm(_linearise(bundle).residual, axis=1)


def world_points(bundle: Bundle, most_error: float) -> np.ndarray:  # (N, 3)
    """Points in world coordinates that are seen three times or more with a median error under that many pixels."""
    found = errors(bundle)
    good = np.array([
        len(own) >= 3 and float(np.median(own)) < most_error
        for own in (found[bundle.point == i] for i in range(len(bundle.start)))
    ], dtype=bool)  # fmt: skip
    ray = np.column_stack([bundle.at_start, np.ones(len(good))]) @ np.linalg.inv(bundle.lens()).T
    homogeneous = np.column_stack([ray * np.exp(bundle.log_depth)[:, None], np.ones(len(ray))])
    return np.einsum("nij,nj->ni", np.linalg.inv(bundle.poses)[bundle.start], homogeneous)[good, :3]


def cost(bundle: Bundle) -> float:
    """Cauchy cost of the observations plus the priors."""
    squared = (_linearise(bundle).residual ** 2).sum(axis=1)
    prior = (((bundle.log_depth - bundle.believed) / bundle.doubt) ** 2).sum()
    focal = (bundle.log_focal / bundle.focal_doubt) ** 2 if bundle.focal_doubt > 0 else 0.0
    return float(bundle.tolerance**2 * np.log1p(squared / bundle.tolerance**2).sum() + prior + focal)


def _linearise(bundle: Bundle) -> _Linear:
    """Residuals and derivatives at the present state."""
    fx, fy, cx, cy = bundle.lens()[[0, 1, 0, 1], [0, 1, 2, 2]]
    first = bundle.start[bundle.point]
    uv = bundle.at_start[bundle.point]
    ray = np.column_stack([(uv[:, 0] - cx) / fx, (uv[:, 1] - cy) / fy, np.ones(len(uv))])
    in_start = ray * np.exp(bundle.log_depth)[bundle.point, None]
    inverse = np.linalg.inv(bundle.poses)
    motion = bundle.poses[bundle.frame] @ inverse[first]
    rotation = motion[:, :3, :3]
    here = np.einsum("mij,mj->mi", rotation, in_start) + motion[:, :3, 3]
    z = np.maximum(here[:, 2], 1e-3)
    seen = np.column_stack([fx * here[:, 0] / z + cx, fy * here[:, 1] / z + cy])
    project = np.zeros((len(z), 2, 3))
    project[:, 0, 0], project[:, 0, 2] = fx / z, -fx * here[:, 0] / z**2
    project[:, 1, 1], project[:, 1, 2] = fy / z, -fy * here[:, 1] / z**2
    turned = project @ rotation
    by_pose = np.concatenate([-project @ _cross(here), project], axis=2)
    by_start = np.concatenate([turned @ _cross(in_start), -turned], axis=2)
    by_depth = np.einsum("mij,mj->mi", turned, in_start)
    unfocused = in_start * np.array([-1.0, -1.0, 0.0])
    by_focal = np.einsum("mij,mj->mi", turned, unfocused) + (seen - [cx, cy])
    return _Linear(seen - bundle.xy, by_pose, by_start, by_depth, by_focal)


def _step(bundle: Bundle, damping: float) -> tuple[np.ndarray, np.ndarray, float]:
    """Change of poses (T, 6), log depths (N,) and log focal length that lowers the linearised cost."""
    t, n, linear = len(bundle.poses), len(bundle.log_depth), _linearise(bundle)
    weight = 1.0 / (1.0 + (linear.residual**2).sum(axis=1) / bundle.tolerance**2)
    hessian, gradient = _normal_equations(bundle, linear, weight)
    mixed = _depth_rows(bundle, linear, weight)
    own = np.bincount(bundle.point, weight * (linear.by_depth**2).sum(axis=1), n) + 1 / bundle.doubt**2
    slope = np.bincount(bundle.point, weight * (linear.by_depth * linear.residual).sum(axis=1), n)
    slope += (bundle.log_depth - bundle.believed) / bundle.doubt**2
    active = _active(bundle)
    own, mixed = own * (1 + damping), mixed[:, active] * bundle.moves
    reduced = hessian[np.ix_(active, active)] - mixed.T @ (mixed / own[:, None])
    reduced[np.diag_indices_from(reduced)] += damping * np.diag(hessian)[active] + 1e-9
    change = np.zeros(6 * t + 1)
    change[active] = -np.linalg.solve(reduced, gradient[active] - mixed.T @ (slope / own))
    depths = -(slope + mixed @ change[active]) / own if bundle.moves else np.zeros(n)
    return change[:-1].reshape(t, 6), np.clip(depths, -1, 1), float(change[-1])


def _normal_equations(bundle: Bundle, linear: _Linear, weight: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Weighted J^T J (6 T + 1, 6 T + 1) and J^T r of poses and focal length."""
    t, first = len(bundle.poses), bundle.start[bundle.point]
    hessian, gradient = np.zeros((6 * t + 1, 6 * t + 1)), np.zeros(6 * t + 1)
    blocks = hessian[:-1, :-1].reshape(t, 6, t, 6)
    parts = ((bundle.frame, linear.by_pose), (first, linear.by_start))
    for row, by_row in parts:
        weighted = by_row * weight[:, None, None]
        for column, by_column in parts:
            pair, sums = _grouped(row * t + column, np.einsum("mki,mkj->mij", weighted, by_column))
            blocks[pair // t, :, pair % t, :] += sums
        frame, sums = _grouped(row, np.einsum("mki,mk->mi", weighted, linear.residual))
        gradient[:-1].reshape(t, 6)[frame] += sums
        frame, sums = _grouped(row, np.einsum("mki,mk->mi", weighted, linear.by_focal))
        hessian[:-1, -1].reshape(t, 6)[frame] += sums
    hessian[-1, :-1] = hessian[:-1, -1]
    hessian[-1, -1] = (weight[:, None] * linear.by_focal**2).sum()
    gradient[-1] = (weight[:, None] * linear.by_focal * linear.residual).sum()
    if bundle.focal_doubt > 0:
        hessian[-1, -1] += 1 / bundle.focal_doubt**2
        gradient[-1] += bundle.log_focal / bundle.focal_doubt**2
    return hessian, gradient


def _depth_rows(bundle: Bundle, linear: _Linear, weight: np.ndarray) -> np.ndarray:  # (N, 6 T + 1)
    """Weighted J^T J between every depth and the poses and focal length."""
    t, n = len(bundle.poses), len(bundle.log_depth)
    rows = np.zeros((n, 6 * t + 1))
    by_frame = rows[:, :-1].reshape(n, t, 6)
    by_depth = linear.by_depth * weight[:, None]
    for frame, by in ((bundle.frame, linear.by_pose), (bundle.start[bundle.point], linear.by_start)):
        place, sums = _grouped(bundle.point * t + frame, np.einsum("mk,mki->mi", by_depth, by))
        by_frame[place // t, place % t] += sums
    rows[:, -1] = np.bincount(bundle.point, (by_depth * linear.by_focal).sum(axis=1), n)
    return rows


def _grouped(key: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The distinct keys (G,) and the sums (G, ...) of values (M, ...) over each."""
    order = np.argsort(key, kind="stable")
    ordered = key[order]
    starts = np.flatnonzero(np.concatenate([[True], ordered[1:] != ordered[:-1]]))
    return ordered[starts], np.add.reduceat(values[order], starts, axis=0)


def _active(bundle: Bundle) -> np.ndarray:  # (6 T + 1,) bool
    """Which unknowns may change: frame 0 stands; a turning camera has no place to go."""
    active = np.zeros((len(bundle.poses), 6), bool)
    active[1:, :3] = True
    active[1:, 3:] = bundle.moves
    return np.concatenate([active.ravel(), [bundle.focal_doubt > 0]])


def _moved(bundle: Bundle, poses: np.ndarray, depths: np.ndarray, focal: float) -> Bundle:
    """The bundle after a change."""
    change = np.tile(np.eye(4), (len(poses), 1, 1))
    for matrix, six in zip(change, poses, strict=True):
        matrix[:3, :3], matrix[:3, 3] = cv2.Rodrigues(six[:3])[0], six[3:]
    return replace(
        bundle,
        poses=change @ bundle.poses,
        log_depth=bundle.log_depth + depths,
        log_focal=bundle.log_focal + float(np.clip(focal, -0.3, 0.3)),
    )


def _cross(vectors: np.ndarray) -> np.ndarray:  # (M, 3) -> (M, 3, 3)
    """Matrices of the cross product v x."""
    x, y, z = vectors.T
    zero = np.zeros_like(x)
    return np.stack([zero, -z, y, z, zero, -x, -y, x, zero], axis=1).reshape(-1, 3, 3)
