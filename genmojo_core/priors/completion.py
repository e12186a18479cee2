"""First Gaussians for unseen sides: the surface of the volume a prior predicts, cut by what frames deny."""

from __future__ import annotations

import cv2
import numpy as np
import torch

from genmojo_core.clip.cameras import View
from genmojo_core.clip.clip import Clip
from genmojo_core.priors.embedded import Condition, EmbeddedPrior, view_cameras
from genmojo_core.priors.prior import ViewOffsets
from genmojo_core.priors.references import PlacedReference
from genmojo_core.priors.solids import HALF_EXTENT
from genmojo_core.scene.initialise import Points, points_of_image, project

SIDE = 64  # pixels of the pictures the surface is read from
AROUND = ((0, 45), (0, -45), (0, 90), (0, -90), (0, 135), (0, -135), (0, 180), (30, 0), (-30, 0), (30, 180), (-30, 180))
SURE = 0.8  # coverage from which a view is sure of a surface: half of it is where a fuzzy body ends, and too far out
CELL = 0.055  # prior's units: no two points of one cell are kept
CLEAR = 0.08  # of the object's distance: how far in front of a seen surface a point contradicts it


def surface_points(prior: EmbeddedPrior, condition: Condition) -> Points:
    """Pieces of the predicted surface in the prior's space, from views all around it, a CELL apart.

    Every view must be SURE of a piece: one view's depth is a mean along its ray and may lie beside a fuzzy body.
    """
    distance = condition.reference.distance
    offsets = torch.tensor(AROUND, dtype=torch.float32)
    directions = ViewOffsets(offsets[:, 0], offsets[:, 1], torch.zeros(len(AROUND)))
    pictures = prior.surface(condition, directions, SIDE).movedim(1, -1).double().numpy()
    focal = SIDE / 2 * distance / HALF_EXTENT
    poses = view_cameras(condition.reference, directions, distance)
    views = [View(pose, focal, focal, SIDE / 2, SIDE / 2, SIDE, SIDE) for pose in poses]
    points = _nothing()
    for view, picture in zip(views, pictures, strict=True):
        alpha = np.maximum(picture[..., 3], 1e-6)
        mask = picture[..., 3] > SURE
        if mask.sum() < 4:
            continue
        rgb = np.round(np.clip(picture[..., :3] / alpha[..., None], 0, 1) * 255).astype(np.uint8)
        depth = picture[..., 4] / alpha + distance
        found = points_of_image(rgb, depth, mask, view, SIDE * SIDE)
        by_view = [_looked_up(other[..., 3], found.xyz, seen) for seen, other in zip(views, pictures, strict=True)]
        points = points.joined(found.chosen(np.min(by_view, axis=0) > SURE))
    return thinned(points, len(points), CELL)


def thinned(points: Points, count: int, cell: float) -> Points:
    """At most `count` of the points, one per cell of a grid; each is made as wide as its cell, so that no gap is left.

    Args:
        cell: least side of a cell, in the points' units; it grows until `count` is enough.
    """
    if not len(points) or count < 1:
        return points.chosen(np.zeros(len(points), bool))
    first = _one_per_cell(points.xyz, cell)
    while len(first) > count:
        cell *= 1.1
        first = _one_per_cell(points.xyz, cell)
    chosen = selected(points, np.sort(first))
    length = np.linalg.norm(chosen.tangents, axis=2, keepdims=True)
    wider = np.maximum(length, 0.5 * cell) / np.maximum(length, 1e-12)
    return Points(chosen.xyz, chosen.rgb, np.maximum(chosen.sigma, 0.5 * cell), chosen.tangents * wider)


def _one_per_cell(xyz: np.ndarray, cell: float) -> np.ndarray:
    """Indices of the first point of every cell."""
    return np.unique(np.floor((xyz - xyz.min(axis=0)) / cell).astype(np.int64), axis=0, return_index=True)[1]


def _looked_up(coverage: np.ndarray, xyz: np.ndarray, view: View) -> np.ndarray:  # (N,)
    """A view's coverage where points fall, fewer than 32,767 (cv2.remap); 0 outside the picture."""
    x, y = (project(xyz, view)[0] - 0.5).astype(np.float32).T.reshape(2, 1, -1)
    return np.asarray(cv2.remap(coverage.astype(np.float32), x, y, cv2.INTER_LINEAR))[0]


def in_world(points: Points, placed: PlacedReference) -> Points:
    """Points of the prior's space in the world of the reference's frame."""
    return points.moved(placed.to_world)


def unseen_only(xyz: np.ndarray, clip: Clip, k: int, t: int) -> np.ndarray:  # (N, 3) world at frame t -> (N,) bool
    """Points that frame t does not contradict: not where it shows something else, not in front of what it shows.

    A point also goes where it would lie *on* the surface that the frame shows: that one is known better. Outside the
    picture and behind nearer objects everything is possible.
    """
    view = clip.cameras.value.view(t)
    xy, z = project(xyz, view)
    x, y = np.nan_to_num(xy[:, 0], nan=-1).astype(int), np.nan_to_num(xy[:, 1], nan=-1).astype(int)
    inside = np.isfinite(xy).all(axis=1) & (x >= 0) & (y >= 0) & (x < view.width) & (y < view.height)
    x, y = np.clip(x, 0, view.width - 1), np.clip(y, 0, view.height - 1)
    mask = clip.object_mask(k)[t]
    grown = cv2.dilate(mask.astype(np.uint8), np.ones((3, 3), np.uint8)).astype(bool)
    depth = clip.depth.value[t]
    other = (clip.masks.value[t] > 0) & ~mask & clip.masks.valid[t] & clip.depth.valid[t]
    behind_other = other[y, x] & (depth[y, x] < z)
    unlabelled = ~clip.masks.valid[t][y, x]
    denied = ~grown[y, x] & ~behind_other & ~unlabelled
    shown = mask[y, x] & clip.depth.valid[t][y, x]
    denied |= shown & (z < depth[y, x] * (1 + 0.5 * CLEAR * _thickness(clip, mask, t)))
    return ~(inside & denied)


def _thickness(clip: Clip, mask: np.ndarray, t: int) -> float:
    """Angular size of an object in a frame: tolerances in depth follow it."""
    view = clip.cameras.value.view(t)
    rows, columns = np.nonzero(mask)
    if not len(rows):
        return 0.0
    return float(max(np.ptp(rows) + 1, np.ptp(columns) + 1) / max(view.fx, view.fy))


def _nothing() -> Points:
    return Points(np.zeros((0, 3)), np.zeros((0, 3)), np.zeros(0), np.zeros((0, 2, 3)))


def selected(points: Points, rows: np.ndarray) -> Points:
    """Some of the points."""
    return Points(points.xyz[rows], points.rgb[rows], points.sigma[rows], points.tangents[rows])
