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
    sums = np.zeros(2)
    turns = np.zeros((2, *pair.quats.shape), np.float32)
    walk_edges(pair, edges, turns, np.zeros(2), sums, Pair(*(np.zeros((0, a.shape[1]), np.float32) for a in pair)))
    return sums / max(len(edges.rows) * edges.others.shape[1], 1)


def rigid_gradients(pair: Pair, edges: Edges, upstream: np.ndarray) -> Pair:
    """Gradients of upstream (2,) times `rigid_terms`."""
    out = Pair(*(np.zeros(a.shape, np.float32) for a in pair))
    turns = np.zeros((2, *pair.quats.shape), np.float32)
    share = upstream / max(len(edges.rows) * edges.others.shape[1], 1)
    walk_edges(pair, edges, turns, share, np.zeros(2), out)
    return out


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
    pair: Pair, edges: Edges, turns: np.ndarray, share: np.ndarray, sums: np.ndarray, out: Pair
) -> None:  # fmt: skip
    """Add up both terms in sums (2,); where `out` has rows, add the gradient of share . terms to it.

    turns: (2, N, 4) float32, zero on entry: relative rotations and their gradients.
    """
    slopes = out.means.shape[0] > 0
    for i in range(pair.quats.shape[0]):
        relative_turn(pair, turns, i)
    for n in range(edges.rows.size):
        i = edges.rows[n]
        for k in range(edges.others.shape[1]):
            j, weight = edges.others[i, k], edges.weight[i, k]
            x = np.float64(pair.means_after[j, 0]) - pair.means_after[i, 0]
            y = np.float64(pair.means_after[j, 1]) - pair.means_after[i, 1]
            z = np.float64(pair.means_after[j, 2]) - pair.means_after[i, 2]
            back = _turned(turns, i, 1.0, x, y, z)
            d0 = pair.means[j, 0] - pair.means[i, 0] - back[0]
            d1 = pair.means[j, 1] - pair.means[i, 1] - back[1]
            d2 = pair.means[j, 2] - pair.means[i, 2] - back[2]
            moved = weight * (d0 * d0 + d1 * d1 + d2 * d2)
            length = math.sqrt(max_floor(moved))
            sums[0] += length
            if slopes and moved > FLOOR:
                g = share[0] * weight / length
                slope_edge(turns, i, j, (x, y, z), (g * d0, g * d1, g * d2), out)
            sums[1] += turn_edge(turns, i, j, weight, share[1], slopes)
    if slopes:
        for i in range(pair.quats.shape[0]):
            slope_relative_turn(pair, turns, i, out)


@inlined
def max_floor(value: float) -> float:
    """The value, at least FLOOR."""
    return value if value > FLOOR else FLOOR


@inlined
def slope_edge(turns: np.ndarray, i: int, j: int, e: tuple, g: tuple, out: Pair) -> None:
    """Gradient g of e - R e' to both ends before and after, and to the rotation."""
    gx, gy, gz = g
    h = _turned(turns, i, -1.0, gx, gy, gz)
    out.means[j, 0] += gx
    out.means[j, 1] += gy
    out.means[j, 2] += gz
    out.means[i, 0] -= gx
    out.means[i, 1] -= gy
    out.means[i, 2] -= gz
    out.means_after[j, 0] -= h[0]
    out.means_after[j, 1] -= h[1]
    out.means_after[j, 2] -= h[2]
    out.means_after[i, 0] += h[0]
    out.means_after[i, 1] += h[1]
    out.means_after[i, 2] += h[2]
    _slope_turn(turns, i, e, (-gx, -gy, -gz))


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


@inlined
def relative_turn(pair: Pair, turns: np.ndarray, i: int) -> None:
    """turns[0, i] = q q'^-1 for unit quaternions."""
    a, b, c, d = pair.quats[i, 0], pair.quats[i, 1], pair.quats[i, 2], pair.quats[i, 3]
    w, x, y, z = pair.quats_after[i, 0], pair.quats_after[i, 1], pair.quats_after[i, 2], pair.quats_after[i, 3]
    turns[0, i, 0] = a * w + b * x + c * y + d * z
    turns[0, i, 1] = b * w - a * x + d * y - c * z
    turns[0, i, 2] = c * w - a * y + b * z - d * x
    turns[0, i, 3] = d * w - a * z + c * x - b * y


@inlined
def slope_relative_turn(pair: Pair, turns: np.ndarray, i: int, out: Pair) -> None:
    """Gradient of q q'^-1, turns[1, i], to both quaternions."""
    a, b, c, d = pair.quats[i, 0], pair.quats[i, 1], pair.quats[i, 2], pair.quats[i, 3]
    w, x, y, z = pair.quats_after[i, 0], pair.quats_after[i, 1], pair.quats_after[i, 2], pair.quats_after[i, 3]
    p, q, r, s = turns[1, i, 0], turns[1, i, 1], turns[1, i, 2], turns[1, i, 3]
    out.quats[i, 0] = p * w - q * x - r * y - s * z
    out.quats[i, 1] = p * x + q * w + r * z - s * y
    out.quats[i, 2] = p * y + r * w + s * x - q * z
    out.quats[i, 3] = p * z + s * w + q * y - r * x
    out.quats_after[i, 0] = p * a + q * b + r * c + s * d
    out.quats_after[i, 1] = p * b - q * a - r * d + s * c
    out.quats_after[i, 2] = p * c - r * a - s * b + q * d
    out.quats_after[i, 3] = p * d - s * a - q * c + r * b
