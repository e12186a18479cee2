"""Tracks between the keys people placed: all links of the object that agree, with keys as hard constraints.

Every frame of a track is unknown unless a person is sure of it. A link from frame s to t says where the point of s is
in t. All links over a few frames are solved together, robustly and from both ends at once: a key moves its two
neighbouring segments by distance and confidence, and a single wrong link does no harm. Gauss-Newton on
sum w |x_t - link_st(x_s)|^2 + smoothness, w from the match and a Cauchy weight of the disagreement.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from genmojo_core.trackers.guide import Guide
from genmojo_core.trackers.object_motion import ObjectMotion

SPANS = (1, 2, 3, 4, 6, 8)  # frames between the ends of a link
GUIDED = 0.03  # weight of going as a proposal does, times its confidence: keys, px and OA of acceptance 5
FADE = 1.5  # power of the frames between the ends by which a link counts less: keys and px of acceptance 5
HIDDEN = 0.03  # weight of the object's motion where the point's own match is not seen
SMOOTH = 0.006  # weight of going straight on
_SCALE = 0.6  # held px of disagreement from which a link counts less
_ROUNDS = 6


@dataclass(frozen=True)
class _Edges:
    """M links at one point: frames s and t (M,), linear part (M, 2, 2), where t should be (M, 2), base weight (M,)."""

    s: np.ndarray
    t: np.ndarray
    linear: np.ndarray
    place: np.ndarray
    weight: np.ndarray


def solve_points(
    motion: ObjectMotion,
    xy: np.ndarray,  # (n, T, 2) held px as they stand
    fixed: np.ndarray,  # (n, T) bool, where a person is sure
    first: int,
    end: int,
    slid: np.ndarray,  # (n, T, 2) held px, of `slide.slides`
    guide: Guide | None = None,
) -> np.ndarray:  # (n, T, 2) held px
    """Places of points of one object with frames first..end-1 solved; frames outside, and fixed ones, hold still.

    A guide's links count beside those of the pictures, and alone where these see nothing.
    """
    out = np.array(xy, np.float64)
    pairs = _pairs(motion, first, end)
    for _ in range(_ROUNDS):
        asked = [(s, t, motion.carry(s, t, out[:, s])) for s, t in pairs]
        found = [(s, t, carried) for s, t, carried in asked if carried is not None]
        seen = _seen(motion, found, slid) if found else None
        for n in range(len(out)):
            edges = [] if seen is None else [_Edges(*seen[:3], *(part[:, n] for part in seen[3:]))]
            if guide is not None and guide.on[n].any():
                edges.append(_guided(motion, guide, n, out[n], (first, end)))
            if edges:
                _step(out[n], np.arange(first, end)[~fixed[n, first:end]], _joined(edges))
    return out


def _seen(
    motion: ObjectMotion, found: Sequence[tuple[int, int, tuple[np.ndarray, ...]]], slid: np.ndarray
) -> tuple[np.ndarray, ...]:  # s, t (M,), linear (M, 2, 2), place (M, n, 2), weight (M, n)
    """What the links of the pictures say of all points."""
    s, t = np.array([f[0] for f in found]), np.array([f[1] for f in found])
    linear = np.stack([motion.linear(int(a), int(b)) for a, b in zip(s, t, strict=True)])
    place, own, trust = (np.stack([f[2][part] for f in found]) for part in range(3))
    place += np.swapaxes(slid[:, t] - slid[:, s], 0, 1)
    return s, t, linear, place, np.maximum(own, HIDDEN * trust) / (np.abs(s - t)[:, None] ** FADE)


def _guided(motion: ObjectMotion, guide: Guide, n: int, xy: np.ndarray, span: tuple[int, int]) -> _Edges:
    """What a guide says of one point (T, 2): from frame s to t it goes as the guide does, and what parts it from the
    guide moves with the object."""
    on = np.flatnonzero(guide.on[n])
    reach = on[(on >= span[0] - max(SPANS)) & (on < span[1] + max(SPANS))]
    s, t = (side.ravel() for side in np.meshgrid(reach, reach, indexing="ij"))
    near = np.isin(np.abs(s - t), SPANS)
    s, t = s[near], t[near]
    ways = [motion.linear(int(a), int(b)) for a, b in zip(s, t, strict=True)]
    linear = np.array(ways, np.float64).reshape(-1, 2, 2)  # none where the guide knows nothing nearby
    way = guide.xy[n]
    place = way[t] + np.einsum("mij,mj->mi", linear, xy[s] - way[s])
    weight = GUIDED * np.minimum(guide.conf[n, s], guide.conf[n, t]) / np.abs(s - t) ** FADE
    return _Edges(s, t, linear, place, weight)


def _joined(edges: list[_Edges]) -> _Edges:
    """Links of several sources as one."""
    parts = zip(*((e.s, e.t, e.linear, e.place, e.weight) for e in edges), strict=True)
    return _Edges(*(np.concatenate(part) for part in parts))


def _pairs(motion: ObjectMotion, first: int, end: int) -> list[tuple[int, int]]:
    """Pairs of frames that show the object and touch the range."""
    reach = max(SPANS)
    near = range(max(first - reach, 0), min(end + reach, motion.frames))
    shown = [t for t in near if motion.grid(t) is not None]
    beside = set(zip(shown[:-1], shown[1:], strict=True))  # also over a gap in which the object is not seen
    return [(s, t) for s in shown for t in shown
            if (abs(s - t) in SPANS or (s, t) in beside or (t, s) in beside)
            and (first <= t < end or first <= s < end)]  # fmt: skip


def _step(xy: np.ndarray, unknown: np.ndarray, edges: _Edges) -> None:
    """One Gauss-Newton step of one point (T, 2), in place."""
    n = len(unknown)
    if n == 0:
        return
    index = np.full(len(xy), -1)
    index[unknown] = np.arange(n)
    i, j = index[edges.s], index[edges.t]
    gap = edges.place - xy[edges.t]
    slack = _SCALE * (1 + 0.25 * np.abs(edges.s - edges.t))
    weight = edges.weight / (1.0 + np.square(gap).sum(axis=1) / slack**2)
    matrix, right = np.zeros((n, n, 2, 2)), np.zeros((n, 2))
    at_t, at_s, both = j >= 0, i >= 0, (i >= 0) & (j >= 0)
    turned = weight[:, None, None] * edges.linear
    np.add.at(matrix, (j[at_t], j[at_t]), weight[at_t, None, None] * np.eye(2))
    np.add.at(right, j[at_t], (weight[:, None] * gap)[at_t])
    np.add.at(matrix, (i[at_s], i[at_s]), np.einsum("mji,mjk->mik", edges.linear, turned)[at_s])
    np.add.at(right, i[at_s], -np.einsum("mji,mj->mi", turned, gap)[at_s])
    np.add.at(matrix, (j[both], i[both]), -turned[both])
    np.add.at(matrix, (i[both], j[both]), -np.swapaxes(turned, 1, 2)[both])
    _add_smoothness(matrix, right, xy, index)
    whole = np.swapaxes(matrix, 1, 2).reshape(2 * n, 2 * n) + 1e-6 * np.eye(2 * n)
    xy[unknown] += np.linalg.solve(whole, right.reshape(-1)).reshape(n, 2)


def _add_smoothness(matrix: np.ndarray, right: np.ndarray, xy: np.ndarray, index: np.ndarray) -> None:
    """The second difference of every three frames in a row, where one of them is unknown."""
    middle = np.arange(1, len(xy) - 1)
    triples = np.stack([middle - 1, middle, middle + 1], axis=1)  # (T - 2, 3)
    triples = triples[(index[triples] >= 0).any(axis=1)]
    bend = xy[triples[:, 0]] - 2 * xy[triples[:, 1]] + xy[triples[:, 2]]
    factors = (1.0, -2.0, 1.0)
    for a, factor in enumerate(factors):
        row = index[triples[:, a]]
        np.add.at(right, row[row >= 0], -SMOOTH * factor * bend[row >= 0])
        for b, other in enumerate(factors):
            column = index[triples[:, b]]
            both = (row >= 0) & (column >= 0)
            np.add.at(matrix, (row[both], column[both]), SMOOTH * factor * other * np.eye(2))
