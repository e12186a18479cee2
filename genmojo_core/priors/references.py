"""Crops of a clip as references for a prior, and where the prior's space lies in the world.

The crop is taken by a virtual camera in the place of the frame's own, turned so that it looks at the object, with a
lens that lets the object's box fill 65 % of the picture (METHOD.md section 11, rows 15, 16 and 20). What nearer objects
cover is marked as hidden, never as empty.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np
import torch

from genmojo_core.clip.cameras import View
from genmojo_core.clip.clip import Clip
from genmojo_core.priors.generator import FILL, FRONT
from genmojo_core.priors.prior import Reference
from genmojo_core.priors.solids import HALF_EXTENT

SIDE = 256  # pixels of a reference picture
SMALLEST = 12  # pixels of the longer side of the object's box
LEAST_VISIBLE = 0.25  # share of the object's area that must show (measured: resources/prior.md)
_TOUCH = 2  # pixels from the frame's border


@dataclass(frozen=True)
class PlacedReference:
    """A reference and where it was taken.

    Args:
        to_world: (4, 4) similarity from the prior's space to the world of its frame. unit: world length of one unit.
        visible: 0..1 share of the object that shows.
    """

    reference: Reference
    to_world: np.ndarray
    unit: float
    visible: float


def reference_of(clip: Clip, objects: tuple[int, ...], t: int) -> PlacedReference | str:
    """The reference of one object, or of several as one, in frame t, or one plain sentence why there is none.

    Args:
        clip: complete. objects: their indices 0..K-1.
    """
    mask = np.isin(clip.masks.value[t], np.array(objects) + 1) & clip.masks.valid[t]
    depth = clip.depth.value[t]
    usable = mask & clip.depth.valid[t] & (depth > 0)
    reason = _unfit(mask, usable)
    if reason:
        return reason
    view = clip.cameras.value.view(t)
    turn, half = aim(mask, view)
    distance = HALF_EXTENT / half
    x, y = crop_map(view, turn, half)
    inside = cv2.remap(mask.astype(np.float32), x, y, cv2.INTER_LINEAR)
    color = clip.frames[t].astype(np.float32) / 255.0 * mask[..., None]
    rgb = cv2.remap(color, x, y, cv2.INTER_LINEAR) / np.maximum(inside, 1e-3)[..., None]
    along = _depth_along(view, turn, depth)
    near = float(np.median(along[usable]))
    unit = near / (distance - FRONT)
    relative = cv2.remap((along / unit - distance).astype(np.float32), x, y, cv2.INTER_NEAREST)
    known = cv2.remap(usable.astype(np.float32), x, y, cv2.INTER_NEAREST)
    hidden = cv2.remap(_hiders(clip, mask, t, along < near).astype(np.float32), x, y, cv2.INTER_NEAREST)
    up = turn @ view.world_to_camera[:3, :3] @ clip.world_up
    up /= max(float(np.linalg.norm(up)), 1e-9)
    picture = np.concatenate([np.moveaxis(rgb * (inside > 0.02)[..., None], -1, 0), inside[None]])
    reference = Reference(
        _tensor(picture), _tensor(hidden), _tensor(np.clip(relative, -1.5, 1.5) * known), _tensor(known),
        math.degrees(math.asin(float(np.clip(-up[2], -1, 1)))), distance, (float(up[0]), float(up[1]), float(up[2])),
    )  # fmt: skip
    visible = visible_share(clip, objects[0], t) if len(objects) == 1 else 1.0
    return PlacedReference(reference, _to_world(view, turn, unit, distance), unit, visible)


def visible_share(clip: Clip, k: int, t: int) -> float:
    """Share 0..1 of object k that shows in frame t; 1 where nothing nearer touches it.

    Judged by the area of its pixels in the world, against the largest of a few frames.
    """
    mask = clip.object_mask(k)
    others = (clip.masks.value[t] > 0) & ~mask[t]
    touched = cv2.dilate(mask[t].astype(np.uint8), np.ones((5, 5), np.uint8)).astype(bool) & others
    if not touched.any():
        return 1.0
    own = float(np.median(clip.depth.value[t][mask[t]]))
    if not (clip.depth.value[t][touched] < own).any():
        return 1.0
    frames = np.unique(np.linspace(0, len(clip) - 1, 12).astype(int))
    areas = [_area(clip, mask[f], f) for f in (*frames, t)]
    return float(min(1.0, areas[-1] / max(max(areas), 1e-12)))


def aim(mask: np.ndarray, view: View) -> tuple[np.ndarray, float]:
    """A virtual camera on the object: rotation (3, 3) from the frame's camera axes, and half its picture's slope."""
    rows, columns = np.nonzero(mask)
    edge = np.concatenate([np.column_stack([columns + a, rows + b]) for a in (0, 1) for b in (0, 1)])
    rays = np.column_stack([(edge[:, 0] - view.cx) / view.fx, (edge[:, 1] - view.cy) / view.fy, np.ones(len(edge))])
    turn = np.eye(3)
    for _ in range(3):
        local = rays @ turn.T
        slopes = local[:, :2] / local[:, 2:]
        middle = (slopes.min(axis=0) + slopes.max(axis=0)) / 2
        turn = _facing(np.array([*middle, 1.0])) @ turn
    local = rays @ turn.T
    reach = np.abs(local[:, :2] / local[:, 2:]).max()
    return turn, float(max(reach / FILL, 1e-4))


def crop_map(view: View, turn: np.ndarray, half: float) -> tuple[np.ndarray, np.ndarray]:
    """Where each pixel of the virtual camera's picture lies in the frame, as cv2.remap wants it (pixel centres)."""
    ticks = ((np.arange(SIDE) + 0.5) / SIDE * 2 - 1) * half
    rays = np.stack(np.broadcast_arrays(ticks[None, :], ticks[:, None], 1.0), axis=-1) @ turn
    z = np.maximum(rays[..., 2], 1e-6)
    x = rays[..., 0] / z * view.fx + view.cx - 0.5
    y = rays[..., 1] / z * view.fy + view.cy - 0.5
    return x.clip(-1e4, 1e4).astype(np.float32), y.clip(-1e4, 1e4).astype(np.float32)


def _unfit(mask: np.ndarray, usable: np.ndarray) -> str:
    """Why a frame's mask cannot be a reference; empty if it can."""
    if not mask.any():
        return "the object does not show"
    rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    if max(rows[-1] - rows[0], columns[-1] - columns[0]) + 1 < SMALLEST:
        return f"the object is smaller than {SMALLEST} pixels"
    height, width = mask.shape
    sides = (rows[0] < _TOUCH, rows[-1] >= height - _TOUCH, columns[0] < _TOUCH, columns[-1] >= width - _TOUCH)
    if sum(sides) >= 2:
        return "the object is cut by two sides of the frame"
    if usable.sum() < 0.5 * mask.sum():
        return "less than half of the object has a depth"
    return ""


def _hiders(clip: Clip, mask: np.ndarray, t: int, nearer: np.ndarray) -> np.ndarray:
    """(H, W) bool: pixels of other objects that are nearer, and pixels nobody labelled."""
    other = (clip.masks.value[t] > 0) & ~mask
    return (other & nearer & clip.depth.valid[t]) | ~clip.masks.valid[t]


def _depth_along(view: View, turn: np.ndarray, depth: np.ndarray) -> np.ndarray:
    """(H, W) depth along the virtual camera's axis of the frame's pixels."""
    x = (np.arange(view.width) + 0.5 - view.cx) / view.fx
    y = (np.arange(view.height) + 0.5 - view.cy) / view.fy
    return depth * (turn[2, 0] * x[None, :] + turn[2, 1] * y[:, None] + turn[2, 2])


def _area(clip: Clip, mask: np.ndarray, t: int) -> float:
    """World area of a mask's pixels, seen face on."""
    if not mask.any():
        return 0.0
    view = clip.cameras.value.view(t)
    return float(mask.sum() * np.median(clip.depth.value[t][mask]) ** 2 / (view.fx * view.fy))


def _facing(direction: np.ndarray) -> np.ndarray:
    """(3, 3) smallest rotation that takes a direction to the z axis."""
    z = direction / np.linalg.norm(direction)
    axis = np.array([z[1], -z[0], 0.0])  # z x (0, 0, 1)
    sine = np.linalg.norm(axis)
    if sine < 1e-9:
        return np.eye(3)
    cross = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return np.eye(3) + cross + cross @ cross / (1 + z[2])


def _to_world(view: View, turn: np.ndarray, unit: float, distance: float) -> np.ndarray:
    """(4, 4) similarity from the prior's space to the world."""
    local = np.eye(4)
    local[:3, :3] = unit * turn.T
    local[:3, 3] = turn.T @ np.array([0.0, 0.0, unit * distance])
    return np.linalg.inv(view.world_to_camera) @ local


def _tensor(array: np.ndarray) -> torch.Tensor:
    return torch.from_numpy(np.ascontiguousarray(array, np.float32))
