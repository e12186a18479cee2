"""Background Gaussians: the plate and what other cameras see of it, unprojected; positions stay fixed (METHOD.md 6).

What objects hide in every frame keeps the plate's colours: a loss sees it only through the objects' soft rims, and
would make it whatever mends those.
"""

from __future__ import annotations

import cv2
import numpy as np

from genmojo_core.clip.clip import Clip
from genmojo_core.scene.initialise import Points, points_of_image, project, uncovered

STEEPEST = 12.0  # depth steps per pixel, in pixel widths, over which the ground is followed at grazing angles
MARGIN = 1.02  # background stays at least 2 % behind the objects that pass in front of it


def background_points(clip: Clip, count: int) -> Points:
    """World points of the background plate, plus parts only other frames see when the camera moves.

    Args:
        clip: a complete clip (estimate.complete). count: most points wanted.
    """
    cameras, plate, depth = clip.cameras.value, clip.background.value, clip.background_depth.value
    view = cameras.view(clip.background_frame)
    everywhere = np.ones(depth.shape, bool)
    moving = np.abs(cameras.world_to_camera - cameras.world_to_camera[:1]).max() > 1e-6
    if not moving:
        depth = _behind_objects(clip, depth)
    first = points_of_image(plate, depth, everywhere, view, count if not moving else int(count * 0.75), STEEPEST)
    if not moving:
        return first
    points = first
    for t in sorted({0, len(clip) // 3, 2 * len(clip) // 3, len(clip) - 1} - {clip.background_frame}):
        left = count - len(points)
        if left < 16:
            break
        objects = cv2.dilate((clip.masks.value[t] > 0).astype(np.uint8), np.ones((5, 5), np.uint8)) > 0
        holes = uncovered(points, cameras.view(t), ~objects & clip.depth.valid[t])
        holes = cv2.morphologyEx(holes.astype(np.uint8), cv2.MORPH_OPEN, np.ones((3, 3), np.uint8)) > 0
        share = max(16, left // 2)
        points = points.joined(
            points_of_image(clip.frames[t], clip.depth.value[t], holes, cameras.view(t), min(share, left), STEEPEST)
        )
    return points


def _behind_objects(clip: Clip, depth: np.ndarray) -> np.ndarray:
    """Plate depth pushed back where it would stand in front of an object's own depth (static camera)."""
    if clip.masks is None or clip.depth is None:
        return depth
    nearest = np.where(clip.masks.value > 0, clip.depth.value, 0.0).max(axis=0)
    return np.maximum(depth, (nearest * MARGIN).astype(depth.dtype))


def never_shown(xyz: np.ndarray, clip: Clip) -> np.ndarray:  # (N, 3) world -> (N,) bool
    """Points of the background that fall on an object's mask, on void or outside the picture in every frame."""
    shown = np.zeros(len(xyz), bool)
    for t in range(len(clip)):
        free = clip.masks.valid[t] & (clip.masks.value[t] == 0)
        xy, _ = project(xyz, clip.cameras.value.view(t))
        inside = np.all((xy >= 0) & (xy < clip.size), axis=1)
        column, row = np.where(inside[:, None], xy, 0).astype(int).T
        shown |= inside & free[row, column]
    return ~shown
