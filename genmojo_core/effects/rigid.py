"""The rigid motion that explains an object's flow best; numpy only.

Points of the object are lifted by depth, carried by the flow over a few frames and matched by a rigid motion (robust
Gauss-Newton on pixels). It tells which sides of the object are seen (`sides`), not whether it bends: a flow that
follows a turning, shaded surface is off by as much as bending moves it.
"""

from __future__ import annotations

import math

import numpy as np

from genmojo_core.clip.clip import Clip
from genmojo_core.conventions import axis_angle_matrix
from genmojo_core.effects.follow import follow, window_starts

_WINDOW = 7  # frames that points are followed
_SHORTER = (7, 4, 2)  # tried in turn where too few points last
_MOST_POINTS, _FEWEST_POINTS = 300, 16
_ITERATIONS = 8


def turning(clip: Clip, k: int) -> np.ndarray:  # (T, 3, 3)
    """Rotations from object k (as in frame 0) to the camera, chained over windows of a few frames.

    Needs flow, depth and cameras; without one of them, and where too little is followed, nothing is said to turn.
    """
    frames = len(clip)
    sight = np.tile(np.eye(3), (frames, 1, 1))
    window = min(_WINDOW, frames)
    if clip.flow is None or clip.depth is None or clip.cameras is None or window < 2:
        return sight
    masks = clip.object_mask(k)
    for start in window_starts(frames, window):
        span = range(start, min(start + window, frames))
        sight[start:] = sight[start]
        for length in _SHORTER:
            tracks = follow(masks, clip.flow.value, clip.flow.valid, span[:length], _MOST_POINTS)
            if len(tracks) >= _FEWEST_POINTS:
                break
        if len(tracks) < _FEWEST_POINTS or len(span) < 2:
            continue
        span = span[: tracks.shape[1]]
        turns = _fit_window(clip, tracks, span)
        for t, turn in zip(span, turns, strict=True):
            sight[t:] = turn @ sight[start]
    return sight


def world_turn(sight: np.ndarray, world_to_camera: np.ndarray) -> float:  # (T, 3, 3), (T, 4, 4)
    """Most degrees that an object with such `turning` is turned in the world against how it stands in frame 0."""
    turns = np.swapaxes(world_to_camera[:, :3, :3], 1, 2) @ sight
    cosines = (np.einsum("tij,ij->t", turns, turns[0]) - 1.0) / 2.0
    return float(np.degrees(np.arccos(np.clip(cosines, -1.0, 1.0))).max())


def _fit_window(clip: Clip, tracks: np.ndarray, span: range) -> list[np.ndarray]:
    """Rotations from the first frame of a window to each.

    Depth counts where it was measured: a body that stretches could pass for a flat one that turns without it.
    """
    view = clip.cameras.value.view(span[0])  # type: ignore[union-attr]
    lens = np.array([view.fx, view.fy, view.cx, view.cy])
    places = [_lookup(clip.depth.value[t], tracks[:, f]) for f, t in enumerate(span)]  # type: ignore[union-attr]
    usual = np.median(places, axis=1)[:, None]
    depth = np.clip(places, 0.5 * usual, 2.0 * usual).T
    rays = np.column_stack([(tracks[:, 0] + 0.5 - lens[2:]) / lens[:2], np.ones(len(tracks))])
    measured = depth if clip.depth.given else None  # type: ignore[union-attr]
    return _follow_poses(rays * depth[:, :1], tracks + 0.5, measured, lens)


def _lookup(image: np.ndarray, places: np.ndarray) -> np.ndarray:  # (H, W), (P, 2) -> (P,)
    """Values of an image at the nearest pixels."""
    column, row = np.round(places).astype(int).T
    inside = np.clip(row, 0, image.shape[0] - 1), np.clip(column, 0, image.shape[1] - 1)
    return np.asarray(image[inside], np.float64)


def _follow_poses(points: np.ndarray, xy: np.ndarray, depth: np.ndarray | None, lens: np.ndarray) -> list[np.ndarray]:
    """Rotation of every frame of a window; each frame starts from the one before."""
    turn, shift = np.eye(3), np.zeros(3)
    turns = []
    for f in range(xy.shape[1]):
        if f:
            guess = np.median(xy[:, f] - xy[:, f - 1], axis=0) / lens[:2] * np.median(points[:, 2])
            shift = shift + np.array([*guess, 0.0])
        wanted = np.column_stack([xy[:, f], np.zeros(len(xy)) if depth is None else depth[:, f]])
        unit = 0.0 if depth is None else float(lens[0] / np.median(points[:, 2]))
        turn, shift = _fit(points, wanted, unit, lens, (turn, shift))
        turns.append(turn)
    return turns


def _fit(
    points: np.ndarray, wanted: np.ndarray, unit: float, lens: np.ndarray, start: tuple[np.ndarray, np.ndarray]
) -> tuple[np.ndarray, np.ndarray]:
    """Rotation and translation of the rigid motion that brings points to pixels and depth (robust).

    unit: pixels that a unit of depth counts as; 0 where depth is not known.
    """
    turn, shift = start
    centre = points.mean(axis=0)
    shift = shift + turn @ centre  # of the centre, so that turn and shift do not mix
    local = points - centre
    for _ in range(_ITERATIONS):
        arm = local @ turn.T
        place = arm + shift
        z = np.maximum(place[:, 2], 1e-3 * abs(shift[2]) + 1e-9)
        left = np.column_stack([place[:, :2] / z[:, None] * lens[:2] + lens[2:] - wanted[:, :2],
                                unit * (place[:, 2] - wanted[:, 2])])  # fmt: skip
        size = np.linalg.norm(left, axis=1)
        scale = max(1.5 * float(np.median(size)), 0.15)
        weight = np.repeat(1.0 / (1.0 + (size / scale) ** 2), 3)
        gradient = np.zeros((len(points), 3, 3))
        gradient[:, 0, 0], gradient[:, 1, 1], gradient[:, 2, 2] = lens[0] / z, lens[1] / z, unit
        gradient[:, :2, 2] = -lens[:2] * place[:, :2] / z[:, None] ** 2
        rows = np.concatenate([np.cross(arm[:, None], gradient), gradient], axis=2).reshape(-1, 6)
        normal = rows.T @ (weight[:, None] * rows)
        damping = 1e-6 * np.diag(np.diag(normal)) + 1e-12 * np.eye(6)
        step = np.linalg.solve(normal + damping, -rows.T @ (weight * left.reshape(-1)))
        angle = float(np.linalg.norm(step[:3]))
        if angle > 0:
            turn = axis_angle_matrix(step[:3] / angle, math.degrees(min(angle, 0.3))) @ turn
        shift = shift + step[3:]
    return turn, shift - turn @ centre
