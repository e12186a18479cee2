"""Smooth non-rigid motion on top of a rigid path: displacements that are quadratic in the object's own coordinates.

Few numbers per frame describe a bend, a twist or a stretch of the whole object, so the unseen side and hidden frames
follow what is seen. Solved linearly, with robust weights, from the same matches as the rigid path.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from genmojo_core.optimise.pose_solver import residual_rows, robust_weights
from genmojo_core.optimise.poses import Path, Problem, Sight

_TERMS = 10
_ROUNDS = 4


@dataclass(frozen=True)
class Bend:
    """Displacements in the object's reference coordinates.

    Args:
        centre: (3,) world, origin of the object's coordinates at the reference frame.
        scale: scene units per unit of the normalised coordinates.
        coefficients: (T, 10, 3) float64 scene units per monomial; zero at the reference frame.
    """

    centre: np.ndarray
    scale: float
    coefficients: np.ndarray

    def at(self, t: int, points: np.ndarray) -> np.ndarray:
        """Reference points (..., 3) displaced as at frame t, before the rigid pose of frame t."""
        return points + monomials((points - self.centre) / self.scale) @ self.coefficients[t]

    def undone(self, t: int, points: np.ndarray) -> np.ndarray:
        """Inverse of `at` by fixed-point steps: bent points (..., 3) back to the reference shape."""
        straight = points
        for _ in range(4 if self.coefficients[t].any() else 0):
            straight = points - (self.at(t, straight) - straight)
        return straight


def monomials(x: np.ndarray) -> np.ndarray:  # (..., 3) -> (..., 10)
    """1, x, y, z and their products of order two, of coordinates limited to +-1.5."""
    x, y, z = np.moveaxis(np.clip(x, -1.5, 1.5), -1, 0)
    return np.stack([np.ones_like(x), x, y, z, x * x, x * y, x * z, y * y, y * z, z * z], axis=-1)


def no_bend(frames: int, centre: np.ndarray, scale: float) -> Bend:
    """No displacement in any frame."""
    return Bend(centre, scale, np.zeros((frames, _TERMS, 3)))


def fit_bend(path: Path, problem: Problem) -> Bend:
    """The displacements that best explain what the rigid path leaves of the matches.

    Args:
        path: rigid motion. problem: matches, depths and noise.

    Priors: a coefficient is within 6 % of the object's size of zero, and its second difference in time within 1 %.
    """
    frames, terms = len(path.position), 3 * _TERMS
    bend = no_bend(frames, path.centre, problem.size)
    for _ in range(_ROUNDS):
        normal = _prior(frames, terms, problem.size)
        right = np.zeros(frames * terms)
        for sight in problem.sights:
            _add(normal, right, sight, problem, path, bend)
        keep = np.arange(frames * terms) // terms != path.ref
        found = np.zeros(frames * terms)
        found[keep] = np.linalg.solve(normal[np.ix_(keep, keep)], right[keep])
        bend = Bend(bend.centre, bend.scale, found.reshape(frames, _TERMS, 3))
    return bend


def carried(path: Path, bend: Bend, s: int, t: int, points: np.ndarray) -> np.ndarray:
    """World points (..., 3) on the object at frame s, carried to frame t with the bend."""
    straight = bend.undone(s, (points - path.position[s]) @ path.rotation[s] + path.centre)
    return (bend.at(t, straight) - path.centre) @ path.rotation[t].T + path.position[t]


def _prior(frames: int, terms: int, size: float) -> np.ndarray:
    """Ridge and second differences in time."""
    second = np.diff(np.eye(frames), n=2, axis=0) / (0.01 * size) if frames > 2 else np.zeros((1, frames))
    in_time = second.T @ second + np.eye(frames) / (0.06 * size) ** 2
    return np.kron(in_time, np.eye(terms))


def _add(normal: np.ndarray, right: np.ndarray, sight: Sight, problem: Problem, path: Path, bend: Bend) -> None:
    """One sight's rows: what the displacement of its target less that of its source must add to the image places."""
    s, t = sight.source, sight.target
    points = problem.origin[sight.index] + problem.depth[sight.index, None] * problem.ray[sight.index]
    straight = bend.undone(s, (points - path.position[s]) @ path.rotation[s] + path.centre)
    basis = monomials((straight - bend.centre) / bend.scale)
    rigid = path.between(s, t, points)
    rows, error, noise = residual_rows(problem, sight, t, rigid)
    local = rows @ path.rotation[t]
    design = (basis[:, None, :, None] * local[:, :, None, :]).reshape(len(rows) * rows.shape[1], -1)
    now = design @ (bend.coefficients[t] - bend.coefficients[s]).ravel()
    left = (error.ravel() - now).reshape(error.shape)
    weights = robust_weights(left / noise, sight.shares) / noise**2
    weighted = design * weights.reshape(-1, 1)
    square, vector = weighted.T @ design, weighted.T @ error.ravel()
    n = design.shape[1]
    here, there = slice(t * n, t * n + n), slice(s * n, s * n + n)
    normal[here, here] += square
    normal[there, there] += square
    normal[here, there] -= square
    normal[there, here] -= square
    right[here] += vector
    right[there] -= vector
