"""Depth of every pixel: the given one cleaned, or an honest guess from ground contact, occlusion and shape.

Scene units of a guess are heights of the camera above the ground: only the order of objects is meant.
"""

from __future__ import annotations

from dataclasses import replace

import cv2
import numpy as np

from genmojo_core.clip.cameras import Cameras
from genmojo_core.estimate.ground import PointStage, Stage, guess_ground
from genmojo_core.estimate.shapes import Shapes, measure_shapes, rounded
from genmojo_core.estimate.views import carry, depth_in
from genmojo_core.sentences import say

METHOD = say("depth_method")
_RELIEF = 0.7  # how far a body bulges, relative to its radius in the image
_GAP = 0.02  # log depth left between two bodies where they touch
_MOST_CHANGE = 0.05  # of the depth per frame, METHOD.md section 3
_OWN_CHANGE = 0.02  # of it for an object's own approach; the rest is left for keeping the order
_BEHIND = 1.25  # how much further than the furthest object the wall stands
_MOST_APPROACH = 0.5  # log depth an object may wander from its usual place


def clean_depth(depth: np.ndarray, valid: np.ndarray, labels: np.ndarray) -> np.ndarray:
    """Given depth with every invalid pixel filled: by the median of its object in that frame, background by nearest.

    Args:
        depth: (T, H, W) scene units. valid: (T, H, W) bool. labels: (T, H, W) uint8, 0 background.
    Returns:
        (T, H, W) float32, finite and positive. An object without one valid pixel in a frame takes its median over
        all frames, then the median of everything.
    """
    valid = valid & np.isfinite(depth) & (depth > 0)
    filled = np.where(valid, depth, 0).astype(np.float32)
    everything = float(np.median(depth[valid])) if valid.any() else 1.0
    for label in np.unique(labels):
        chosen = labels == label
        known = chosen & valid
        usual = float(np.median(depth[known])) if known.any() else everything
        for t in range(len(depth)):
            missing = chosen[t] & ~valid[t]
            if not missing.any():
                continue
            if label == 0 and known[t].any():
                filled[t] = np.where(missing, nearest_fill(filled[t], known[t]), filled[t])
            else:
                filled[t][missing] = np.median(depth[t][known[t]]) if known[t].any() else usual
    return filled


def nearest_fill(values: np.ndarray, known: np.ndarray) -> np.ndarray:  # (H, W), (H, W) bool -> (H, W)
    """Every pixel takes the value of the nearest known one; without any known pixel the values stay."""
    if not known.any():
        return values
    _, nearest = cv2.distanceTransformWithLabels(
        (~known).astype(np.uint8), cv2.DIST_L2, 5, labelType=cv2.DIST_LABEL_PIXEL
    )
    lookup = np.zeros(int(nearest.max()) + 1, values.dtype)
    lookup[nearest[known]] = values[known]
    return lookup[nearest]


def guess_depth(
    labels: np.ndarray,  # (T, H, W) uint8, k + 1 on object k
    objects: int,
    cameras: Cameras,
    votes: np.ndarray,  # (T, K, K), positive: i in front of j
    reference: int = 0,
    points: np.ndarray | None = None,  # (N, 3) world, of the background
) -> tuple[np.ndarray, np.ndarray]:  # (T, H, W) float32, (H, W) float32
    """Guessed depth of what is seen in every frame, and of the background in the reference frame's camera.

    Objects stand on a guessed ground by their lowest row; they come nearer only as far as their size and their lowest
    row agree; where they touch, the order of the votes holds; bodies are rounded. Depth changes by at most 5 % a frame
    (METHOD.md section 3).
    """
    aspect = float(cameras.K[0, 1, 1] / cameras.K[0, 0, 0])
    shapes = measure_shapes(labels, objects, aspect)
    stage: Stage | PointStage = guess_stage(shapes, cameras)
    if points is not None and len(points):
        stage = PointStage(points, guess_stage(shapes, cameras))
    thickness = _thickness(shapes, cameras)
    log_depth = _on_ground(stage, shapes, cameras)
    if isinstance(stage, PointStage):
        log_depth = _in_front(log_depth, stage, labels, cameras, thickness)
    log_depth = keep_order(log_depth, votes, thickness)
    if isinstance(stage, Stage):
        stage = replace(stage, wall=max(stage.wall, _BEHIND * float(np.exp(log_depth + thickness).max(initial=1.0))))
    depth = np.stack([stage.depth(cameras.view(t)) for t in range(len(labels))])
    plate = stage.depth(cameras.view(reference))
    for t, k in np.argwhere(shapes.seen).tolist():
        mask = labels[t] == k + 1
        in_front = np.isin(labels[t], np.flatnonzero(votes[t, :, k] > 0) + 1)
        base = float(np.exp(log_depth[t, k]))
        depth[t][mask] = (base * (1 - thickness[k] * rounded(mask, in_front, aspect)))[mask]
        plate = _behind(plate, cameras, (t, reference), mask, base * (1 + thickness[k] + _GAP))
    return depth.astype(np.float32), plate.astype(np.float32)


def guess_stage(shapes: Shapes, cameras: Cameras) -> Stage:
    """Ground under the objects' lowest rows, and a wall a quarter further than the furthest object on it."""
    ground = Stage(guess_ground(cameras.view(0), shapes.usual_row()), 1.0)
    furthest = _on_ground(ground, shapes, cameras) + _thickness(shapes, cameras)
    return replace(ground, wall=_BEHIND * float(np.exp(furthest).max(initial=1.0)))


def keep_order(log_depth: np.ndarray, votes: np.ndarray, thickness: np.ndarray) -> np.ndarray:
    """Log depths (T, K) moved as little as need be so that who is in front is nearer by both thicknesses and a gap.

    Args:
        log_depth: (T, K) of the objects' outlines. votes: (T, K, K) positive where i is in front of j.
        thickness: (K,) half depth of a body relative to its distance.
    Half of a fault moves the front object forward, half the other back; moves spread over the frames around so that
    none is faster than the clamp allows. A circle of votes (a over b over c over a) is left as near as it can be.
    """
    result = log_depth.copy()
    margin = thickness[:, None] + thickness[None] + _GAP
    objects = result.shape[1]
    for attempt in range(3 * objects):
        fault = np.where(votes > 0, result[:, :, None] - result[:, None, :] + margin, 0).clip(0)  # (T, i, j)
        if fault.max(initial=0.0) < 1e-6:
            break
        share = 0.5 if attempt == 0 else 0.0  # later rounds only push back, which ends
        result -= share * spread(fault.max(axis=2))
        result += (1 - share) * spread(fault.max(axis=1))
    return result


def spread(need: np.ndarray) -> np.ndarray:  # (T, K) >= 0 -> (T, K)
    """The smallest curve over `need` that changes by no more than the clamp per frame."""
    step = _MOST_CHANGE - _OWN_CHANGE
    result = need.copy()
    for t in range(1, len(result)):
        result[t] = np.maximum(result[t], result[t - 1] - step)
    for t in range(len(result) - 2, -1, -1):
        result[t] = np.maximum(result[t], result[t + 1] - step)
    return result


def smooth_series(values: np.ndarray, most_change: float = _MOST_CHANGE) -> np.ndarray:  # (T,) or (T, K)
    """Gaussian over 5 frames (sigma 1, ends repeated), then changes clamped per frame and summed up again."""
    kernel = np.exp(-0.5 * np.arange(-2, 3) ** 2)
    kernel /= kernel.sum()
    columns = values.reshape(len(values), -1)
    padded = np.pad(columns, ((2, 2), (0, 0)), mode="edge")
    smooth = sum(weight * padded[i : i + len(columns)] for i, weight in enumerate(kernel))
    change = np.clip(np.diff(smooth, axis=0), -most_change, most_change)
    return np.concatenate([smooth[:1], smooth[:1] + np.cumsum(change, axis=0)]).reshape(values.shape)


def _thickness(shapes: Shapes, cameras: Cameras) -> np.ndarray:  # (K,)
    """Half depth of every body relative to its distance."""
    return np.clip(_RELIEF * shapes.radius / cameras.K[0, 1, 1], 1e-3, 0.3)


def _on_ground(stage: Stage | PointStage, shapes: Shapes, cameras: Cameras) -> np.ndarray:  # (T, K) log depth
    """Log depth of every object in every frame, seen or not, by its lowest row and its size."""
    t, objects = shapes.seen.shape
    result = np.zeros((t, objects))
    for k in range(objects):
        frames = np.flatnonzero(shapes.seen[:, k]).tolist()
        if len(frames) == 0:
            continue
        contact = np.full(t, np.nan)
        for f in frames:
            row = np.array([shapes.lowest_any[f, k]])
            column = np.array([shapes.column[f, k]])
            contact[f] = np.log(max(float(stage.ground_depth(cameras.view(f), column, row)[0]), 0.2))
        trusted = np.isfinite(shapes.lowest[:, k])
        usual = float(np.median(contact[trusted] if trusted.any() else contact[frames]))
        by_row = np.where(trusted, contact - usual, np.nan)
        size = np.log(shapes.size[:, k])
        by_size = -(size - np.median(size[np.isfinite(size)])) if np.isfinite(size).any() else np.full(t, np.nan)
        agreed = np.where(by_row * by_size > 0, np.sign(by_row) * np.minimum(abs(by_row), abs(by_size)), 0.0)
        known = np.isfinite(by_row) & np.isfinite(by_size)
        approach = np.interp(np.arange(t), np.flatnonzero(known), agreed[known]) if known.any() else np.zeros(t)
        result[:, k] = usual + smooth_series(np.clip(approach, -_MOST_APPROACH, _MOST_APPROACH), _OWN_CHANGE)
    return result


def _in_front(
    log_depth: np.ndarray, stage: PointStage, labels: np.ndarray, cameras: Cameras, thickness: np.ndarray
) -> np.ndarray:  # (T, K)
    """Objects pulled in front of the measured background that their masks cover (its nearest tenth left aside)."""
    need = np.zeros_like(log_depth)
    for t in range(len(labels)):
        plane = stage.depth(cameras.view(t))
        for k in np.unique(labels[t][labels[t] > 0]) - 1:
            nearest = float(np.percentile(plane[labels[t] == k + 1], 10))
            need[t, k] = max(0.0, log_depth[t, k] + thickness[k] - np.log(nearest))
    return log_depth - spread(need)


def _behind(
    plate: np.ndarray, cameras: Cameras, frames: tuple[int, int], mask: np.ndarray, depth: float
) -> np.ndarray:  # (H, W)
    """The plate pushed behind an object: its pixels of one frame, carried into the reference, are at least this deep.

    Args:
        plate: (H, W) depth in the reference camera. frames: the object's frame and the reference frame.
        mask: (H, W) bool in the object's frame. depth: of the object's far side, in its frame's camera.
    """
    source, target = cameras.view(frames[0]), cameras.view(frames[1])
    constant = np.full(mask.shape, depth, np.float32)
    where = np.rint(carry(source, target, constant)[mask]).astype(int)
    z = depth_in(source, target, constant)[mask]
    h, w = plate.shape
    inside = (where[:, 0] >= 0) & (where[:, 0] < w) & (where[:, 1] >= 0) & (where[:, 1] < h)
    pushed = np.zeros_like(plate)
    pushed[where[inside, 1], where[inside, 0]] = z[inside]
    return np.maximum(plate, cv2.dilate(pushed, np.ones((3, 3), np.uint8)))
