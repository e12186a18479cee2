"""Affine maps of the plane, (2, 3): applied, joined, and fitted to matches and to a few known points."""

from __future__ import annotations

import numpy as np

from genmojo_core.trackers.stabilise import Grid, Link

_HOLD = 0.01  # weight of the fallback affine, as a share of the object's places
_THIN = 0.3  # an affine flatter than this is taken for a wrong match


def applied(affine: np.ndarray, xy: np.ndarray) -> np.ndarray:
    """An affine (2, 3) of places (..., 2); float32 stays float32."""
    return (xy @ affine[:, :2].T + affine[:, 2]).astype(xy.dtype)


def joined(outer: np.ndarray, inner: np.ndarray) -> np.ndarray:
    """The affine (2, 3) that applies `inner`, then `outer`."""
    return outer @ np.vstack([inner, [0.0, 0.0, 1.0]])


def inverted(affine: np.ndarray) -> np.ndarray:
    """The affine (2, 3) that undoes one; whoever fits keeps them from being flat (`robust_affine`)."""
    linear = np.linalg.inv(affine[:, :2])
    return np.concatenate([linear, -(linear @ affine[:, 2])[:, None]], axis=1)


def fit_affine(source: np.ndarray, target: np.ndarray, fallback: np.ndarray) -> np.ndarray:  # (n, 2), (n, 2) -> (2, 3)
    """The affine nearest to the fallback in shape that brings n known points to where they are.

    One point gives a shift of the fallback, two a similarity, more an affine as far as they spread.
    """
    middle, goal = source.mean(axis=0), target.mean(axis=0)
    a, b = source - middle, target - goal
    linear = fallback[:, :2]
    size = float(np.sqrt(np.square(a).sum(axis=1).mean()))
    if len(source) >= 2 and size > 1.0:
        held = a @ linear.T
        cross = held[:, 0] * b[:, 1] - held[:, 1] * b[:, 0]
        length = max(float(np.square(held).sum()), 1e-9)
        turn = np.array([float((held * b).sum()), float(cross.sum())]) / length
        linear = np.array([[turn[0], -turn[1]], [turn[1], turn[0]]]) @ linear
    if len(source) >= 3:
        ridge = 0.05 * len(source) * size**2 * np.eye(2)
        linear = np.linalg.solve(a.T @ a + ridge, a.T @ b + ridge @ linear.T).T
    return np.concatenate([linear, (goal - linear @ middle)[:, None]], axis=1)


def robust_affine(grid: Grid, link: Link, fallback: np.ndarray) -> np.ndarray:  # (2, 3)
    """Affine of a link by reweighted least squares, held to the fallback where few places match."""
    rows, cols = np.nonzero(link.weight > 0.05)
    if len(rows) < 8:
        return fallback
    source, target = grid.xy[rows, cols].astype(np.float64), link.xy[rows, cols].astype(np.float64)
    weight = link.weight[rows, cols].astype(np.float64)
    middle = np.average(source, axis=0, weights=weight)
    spread = max(float(np.sqrt(np.average((source - middle) ** 2, axis=0, weights=weight).sum())), 1e-6)
    design = np.concatenate([(source - middle) / spread, np.ones((len(source), 1))], axis=1)
    held = np.vstack([(fallback[:, :2] * spread).T, applied(fallback, middle)])
    ridge = np.diag([1.0, 1.0, 0.05]) * _HOLD * float(grid.inside.sum())
    solution, pull = held, weight
    for _ in range(6):
        solution = np.linalg.solve(design.T @ (design * pull[:, None]) + ridge + 1e-9 * np.eye(3),
                                   design.T @ (target * pull[:, None]) + ridge @ held)  # fmt: skip
        error = np.linalg.norm(design @ solution - target, axis=1)
        pull = weight / (1.0 + (error / 1.5) ** 2) ** 2
    linear = solution[:2].T / spread
    sizes = np.linalg.svd(linear, compute_uv=False)
    if sizes[1] < _THIN * sizes[0] or not 0.4 < sizes[0] < 2.5:
        return fallback
    return np.concatenate([linear, (solution[2] - linear @ middle)[:, None]], axis=1)
