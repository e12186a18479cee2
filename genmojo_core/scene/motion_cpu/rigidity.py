"""How far neighbours are from moving and turning as one, and the gradient, in one walk over the edges.

Between two times, with the relative rotation r = q q'^-1 (w, u) of a point, an edge e' to a neighbour afterwards and e
before, and the edge's weight:

    rigid = sqrt(weight |e - R e'|^2),   R e' = e' + 2 w (u x e') + 2 u x (u x e')
    turn  = sqrt(weight |r_j - r_i|^2)   (r_j with the sign that brings it closer to r_i)

A root below 1e-6 counts as 1e-6 and gives no gradient. R's transpose takes the gradient back to e'; to w and u it is
2 g.(u x e') and 2 w (e' x g) + 2 ((u.e') g + (g.u) e' - 2 (g.e') u).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from genmojo_core.kernels.cache import inlined, kernel

FLOOR = 1e-12  # of what is under a root


class Pair(NamedTuple):
    """N points at two times, float32: positions (N, 3) and unit quaternions (N, 4) before and after."""

    means: np.ndarray
    means_after: np.ndarray
    quats: np.ndarray
    quats_after: np.ndarray


class Edges(NamedTuple):
    """The edges that count: others (N, k) int64, weight (N, k) float32, rows (n,) int64 the points whose edges do."""

    others: np.ndarray
    weight: np.ndarray
    rows: np.ndarray


def rigid_terms(pair: Pair, edges: Edges) -> np.ndarray:
    """(2,) float64: the mean of `rigid` and of `turn` over the rows' edges."""
    sums, nothing = np.zeros(2), np.zeros((2, 0, 3), np.float32)
    walk_edges(np.stack(pair[:2]), edges, _turns(pair), np.zeros(2), sums, nothing)
    return sums / max(len(edges.rows) * edges.others.shape[1], 1)


def rigid_gradients(pair: Pair, edges: Edges, upstream: np.ndarray) -> Pair:
    """Gradients of upstream (2,) times `rigid_terms`."""
    turns, slopes = _turns(pair), np.zeros((2, *pair.means.shape), np.float32)
    share = upstream / max(len(edges.rows) * edges.others.shape[1], 1)
    walk_edges(np.stack(pair[:2]), edges, turns, share, np.zeros(2), slopes)
    # r = q q'^-1: the gradient of q is g q', that of q' is g^-1 q
    back = turns[1] * np.array([1, -1, -1, -1], np.float32)
    return Pair(slopes[0], slopes[1], _product(turns[1], pair.quats_after), _product(back, pair.quats))


def _turns(pair: Pair) -> np.ndarray:
    """(2, N, 4) float32: the relative rotations q q'^-1, and zeros for their gradient."""
    found = np.zeros((2, *pair.quats.shape), np.float32)
    found[0] = _product(pair.quats, pair.quats_after * np.array([1, -1, -1, -1], np.float32))
    return found


def _product(left: np.ndarray, right: np.ndarray) -> np.ndarray:
    """(N, 4) Hamilton products."""
    a, b, c, d = left.T
    w, x, y, z = right.T
    rows = (a * w - b * x - c * y - d * z, a * x + b * w + c * z - d * y,
            a * y - b * z + c * w + d * x, a * z + b * y - c * x + d * w)  # fmt: skip
    return np.stack(rows, axis=1)


@inlined
def _turned(turns: np.ndarray, i: int, sign: float, x: float, y: float, z: float) -> tuple:
    """A vector turned by row i of turns[0], or back (sign -1)."""
    w, a, b, c = sign * turns[0, i, 0], turns[0, i, 1], turns[0, i, 2], turns[0, i, 3]
    p, q, r = b * z - c * y, c * x - a * z, a * y - b * x
    return (
        x + 2 * (w * p + b * r - c * q),
        y + 2 * (w * q + c * p - a * r),
        z + 2 * (w * r + a * q - b * p),
    )


@inlined
def _slope_turn(turns: np.ndarray, i: int, e: tuple, g: tuple) -> None:
    """Add to turns[1, i] the gradient of g . (R e) with respect to the rotation."""
    w, a, b, c = turns[0, i, 0], turns[0, i, 1], turns[0, i, 2], turns[0, i, 3]
    x, y, z = e
    p, q, r = y * g[2] - z * g[1], z * g[0] - x * g[2], x * g[1] - y * g[0]  # e x g
    ue, gu, ge = a * x + b * y + c * z, g[0] * a + g[1] * b + g[2] * c, g[0] * x + g[1] * y + g[2] * z
    turns[1, i, 0] += 2 * (a * p + b * q + c * r)
    turns[1, i, 1] += 2 * (w * p + ue * g[0] + gu * x - 2 * ge * a)
    turns[1, i, 2] += 2 * (w * q + ue * g[1] + gu * y - 2 * ge * b)
    turns[1, i, 3] += 2 * (w * r + ue * g[2] + gu * z - 2 * ge * c)


@kernel
def walk_edges(
    means: np.ndarray, edges: Edges, turns: np.ndarray, share: np.ndarray, sums: np.ndarray, out: np.ndarray
) -> None:  # fmt: skip
    """Add up both terms in sums (2,); where `out` has points, add the gradient of share . terms to it and to turns[1].

    means, out: (2, N, 3) float32 positions before and after, and their gradient.
    turns: (2, N, 4) float32 relative rotations and their gradient.
    """
    slopes = out.shape[1] > 0
    for n in range(edges.rows.size):
        i = edges.rows[n]
        for k in range(edges.others.shape[1]):
            j, weight = edges.others[i, k], edges.weight[i, k]
            x, y, z = _edge(means, 1, i, j)
            back = _turned(turns, i, 1.0, x, y, z)
            before = _edge(means, 0, i, j)
            d0, d1, d2 = before[0] - back[0], before[1] - back[1], before[2] - back[2]
            moved = weight * (d0 * d0 + d1 * d1 + d2 * d2)
            length = math.sqrt(max_floor(moved))
            sums[0] += length
            if slopes and moved > FLOOR:
                g = share[0] * weight / length
                slope_edge(turns, i, j, (x, y, z), (g * d0, g * d1, g * d2), out)
            sums[1] += turn_edge(turns, i, j, weight, share[1], slopes)


@inlined
def _edge(means: np.ndarray, moment: int, i: int, j: int) -> tuple:
    """From point i to point j, float64."""
    return (
        np.float64(means[moment, j, 0]) - means[moment, i, 0],
        np.float64(means[moment, j, 1]) - means[moment, i, 1],
        np.float64(means[moment, j, 2]) - means[moment, i, 2],
    )


@inlined
def max_floor(value: float) -> float:
    """The value, at least FLOOR."""
    return value if value > FLOOR else FLOOR


@inlined
def slope_edge(turns: np.ndarray, i: int, j: int, e: tuple, g: tuple, out: np.ndarray) -> None:
    """Gradient g of e - R e' to both ends before and after, and to the rotation; e: the edge afterwards."""
    gx, gy, gz = g
    push(out, 0, j, i, g)
    push(out, 1, i, j, _turned(turns, i, -1.0, gx, gy, gz))
    _slope_turn(turns, i, e, (-gx, -gy, -gz))


@inlined
def push(out: np.ndarray, moment: int, to: int, off: int, g: tuple) -> None:
    """Add g to one point's gradient and take it off another's."""
    for m in range(3):
        out[moment, to, m] += g[m]
        out[moment, off, m] -= g[m]


@inlined
def turn_edge(turns: np.ndarray, i: int, j: int, weight: float, share: float, slopes: bool) -> float:
    """The edge's `turn`; its gradient goes to turns[1]."""
    dot = 0.0
    for m in range(4):
        dot += turns[0, i, m] * turns[0, j, m]
    sign = 1.0 if dot >= 0 else -1.0
    square = 0.0
    for m in range(4):
        d = sign * turns[0, j, m] - turns[0, i, m]
        square += d * d
    turned = weight * square
    length = math.sqrt(max_floor(turned))
    if slopes and turned > FLOOR:
        g = share * weight / length
        for m in range(4):
            d = g * (sign * turns[0, j, m] - turns[0, i, m])
            turns[1, j, m] += sign * d
            turns[1, i, m] -= d
    return length
