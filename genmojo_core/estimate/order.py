"""Which object is in front of which, from the masks where they touch and the way they move.

Three kinds of evidence, strongest first: pixels of one object that, carried on by their own object's motion, end under
the other (they were hidden by it); the convex outline of one that contains the other (a notch was cut out of it); the
lower lowest row (nearer on common ground).
"""

from __future__ import annotations

import cv2
import numpy as np

_MOTION, _OUTLINE, _ROW = 1.0, 0.35, 0.1  # weights of the evidence
_MEMORY = 6.0  # frames: neighbouring frames of one contact vote together
_WHOLE_CONTACT = 0.15  # weight of a far frame of the clip against the frame itself
_UNSURE = 0.03  # a vote below this says nothing
_FEWEST_PIXELS = 12


def front_votes(
    labels: np.ndarray,  # (T, H, W) uint8, k + 1 on object k
    objects: int,
    flow: np.ndarray,  # (T, H, W, 2) pixels to t + 1; the last frame is not read
) -> np.ndarray:  # (T, K, K) float32
    """Votes that object i is in front of object j, positive for yes, antisymmetric, 0 where they do not touch."""
    t = len(labels)
    votes, touch = np.zeros((t, objects, objects), np.float32), np.zeros((t, objects, objects), bool)
    masks = [[labels[f] == k + 1 for k in range(objects)] for f in range(t)]
    steps = [[object_motion(mask, flow[f]) for mask in masks[f]] for f in range(t - 1)]
    for f in range(t):
        hulls = [hull(mask) for mask in masks[f]]
        for i in range(objects):
            for j in range(i + 1, objects):
                pair, pair_hulls = (masks[f][i], masks[f][j]), (hulls[i], hulls[j])
                if not touches(*pair):
                    continue
                vote = _OUTLINE * _outline_vote(pair, pair_hulls) + _ROW * _row_vote(pair)
                if f + 1 < t:
                    vote += _MOTION * _motion_vote(pair, (steps[f][i], steps[f][j]), (masks[f + 1][i], masks[f + 1][j]))
                if f > 0:
                    back = (_inverse(steps[f - 1][i]), _inverse(steps[f - 1][j]))
                    vote += _MOTION * _motion_vote(pair, back, (masks[f - 1][i], masks[f - 1][j]))
                votes[f, i, j], votes[f, j, i] = vote, -vote
                touch[f, i, j] = touch[f, j, i] = True
    return _agree(votes, touch)


def touches(mask_a: np.ndarray, mask_b: np.ndarray, reach: int = 2) -> bool:  # (H, W) bool each
    """Whether at least three pixels of b lie within `reach` pixels of a."""
    if not (mask_a.any() and mask_b.any()):
        return False
    kernel = np.ones((2 * reach + 1, 2 * reach + 1), np.uint8)
    return int((cv2.dilate(mask_a.astype(np.uint8), kernel) > 0)[mask_b].sum()) >= 3


def hull(mask: np.ndarray) -> np.ndarray:  # (H, W) bool -> (H, W) bool
    """Filled convex outline of a mask; an empty mask has an empty one."""
    filled = np.zeros(mask.shape, np.uint8)
    points = cv2.findNonZero(mask.astype(np.uint8))
    if points is not None:
        cv2.fillConvexPoly(filled, cv2.convexHull(points), 1)
    return filled > 0


def object_motion(mask: np.ndarray, flow: np.ndarray) -> np.ndarray:  # (H, W) bool, (H, W, 2) -> (2, 3)
    """Robust affine displacement (dx, dy) = A (x, y, 1) of an object, from the flow inside its mask.

    Few pixels give the median displacement alone; an empty mask gives zero.
    """
    motion = np.zeros((2, 3))
    inside = cv2.erode(mask.astype(np.uint8), np.ones((5, 5), np.uint8)) > 0
    chosen = inside if inside.sum() >= _FEWEST_PIXELS else mask
    y, x = np.nonzero(chosen)
    if len(x) == 0:
        return motion
    vectors = flow[y, x].astype(np.float64)
    motion[:, 2] = np.median(vectors, axis=0)
    if len(x) < 8 * _FEWEST_PIXELS:
        return motion
    centre, size = np.array([x.mean(), y.mean()]), max(float(np.std(x)), float(np.std(y)), 1.0)
    design = np.column_stack([(x - centre[0]) / size, (y - centre[1]) / size, np.ones(len(x))])
    solution = np.vstack([np.zeros((2, 2)), motion[:, 2]])
    for _ in range(4):  # reweighted least squares, with a pull toward plain translation
        error = np.linalg.norm(vectors - design @ solution, axis=1)
        weight = 1.0 / (1.0 + (error / max(float(np.median(error)), 0.3)) ** 2)
        normal = design.T @ (design * weight[:, None]) + np.diag([0.05, 0.05, 1e-6]) * weight.sum()
        solution = np.linalg.solve(normal, design.T @ (vectors * weight[:, None]))
    motion[:, :2] = solution[:2].T / size
    motion[:, 2] = solution[2] - motion[:, :2] @ centre
    return motion


_Pair = tuple[np.ndarray, np.ndarray]  # of objects i and j


def _inverse(motion: np.ndarray) -> np.ndarray:  # (2, 3) -> (2, 3)
    """The affine displacement that takes moved points back."""
    there = np.vstack([motion + np.eye(2, 3), [0, 0, 1]])
    return np.linalg.inv(there)[:2] - np.eye(2, 3) if abs(np.linalg.det(there)) > 0.1 else -motion


def _motion_vote(masks: _Pair, motions: _Pair, masks_then: _Pair) -> float:
    """+1 if, each carried on by its own motion, j's pixels end under i; -1 if i's end under j."""
    hidden_j = _landing(masks[1], motions[1], masks_then[0])
    hidden_i = _landing(masks[0], motions[0], masks_then[1])
    noise = 3.0 + 0.05 * float(np.sqrt(min(masks[0].sum(), masks[1].sum())))
    return (hidden_j - hidden_i) / (hidden_j + hidden_i + noise)


def _landing(mask: np.ndarray, motion: np.ndarray, other: np.ndarray) -> float:
    """How many of the mask's pixels, moved on by the affine motion, land on the other object."""
    y, x = np.nonzero(mask)
    moved = motion @ np.stack([x, y, np.ones(len(x))])
    column, row = np.rint(x + moved[0]).astype(int), np.rint(y + moved[1]).astype(int)
    h, w = mask.shape
    inside = (column >= 0) & (column < w) & (row >= 0) & (row < h)
    return float(other[row[inside], column[inside]].sum())


def _outline_vote(masks: _Pair, hulls: _Pair) -> float:
    """+1 if i lies in a notch of j's outline, -1 the other way round, near 0 when neither reaches in."""
    (mask_i, mask_j), (hull_i, hull_j) = masks, hulls
    i_in_j, j_in_i = float((hull_j & mask_i).sum()), float((hull_i & mask_j).sum())
    return (i_in_j - j_in_i) / (i_in_j + j_in_i + 0.05 * float(min(mask_i.sum(), mask_j.sum())) + 1.0)


def _row_vote(masks: _Pair) -> float:
    """+1 if i reaches down further than j by a tenth of the frame's height."""
    lowest_i, lowest_j = (np.nonzero(mask.any(axis=1))[0].max() for mask in masks)
    return float(np.clip((lowest_i - lowest_j) / (0.1 * len(masks[0])), -1, 1))


def _agree(votes: np.ndarray, touch: np.ndarray) -> np.ndarray:  # (T, K, K), (T, K, K) bool
    """Votes of a contact blended over neighbouring frames, so that one noisy frame does not turn the order."""
    frames = np.arange(len(votes))
    near = np.exp(-0.5 * ((frames[:, None] - frames[None]) / _MEMORY) ** 2) + _WHOLE_CONTACT
    blended = np.einsum("st,tij->sij", near, votes) / np.maximum(np.einsum("st,tij->sij", near, touch * 1.0), 1e-6)
    return np.where(touch & (np.abs(blended) > _UNSURE), blended, 0).astype(np.float32)
