"""A stage for guessed depth: a ground plane under a horizon and a wall behind everything, or measured points.

World = camera 0; the camera stands one scene unit above the ground, so a guess has a unit but no true scale.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import cv2
import numpy as np

from genmojo_core.clip.cameras import View

_USUAL_HORIZON = 0.35  # share of the frame's height
_CLEARANCE = 0.12  # an object standing on the ground ends at least this far under the horizon, same unit
_FURTHEST = 30.0  # camera heights
_GRID = 24  # nodes on the short side at which measured points are blended
_REACH = 0.12  # of the short side: how far a point speaks
_FEWEST_SEEN = 20  # points in view, without which they say nothing


@dataclass(frozen=True)
class Stage:
    """Ground plane normal . X = 1 and wall X_z = wall, both in world coordinates.

    Args:
        normal: (3,) unit vector, pointing down. wall: depth of the wall from camera 0, scene units.
    """

    normal: np.ndarray
    wall: float

    def ground_depth(self, view: View, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Depth at which rays of raster pixels (x, y) meet the ground; `_FURTHEST` where they do not."""
        return _meet(view, x, y, self.normal, 1.0)

    def depth(self, view: View) -> np.ndarray:  # (H, W) float32
        """Depth of ground and wall, whichever comes first, at every pixel of a view."""
        x, y = np.meshgrid(np.arange(view.width) + 0.5, np.arange(view.height) + 0.5)
        wall = _meet(view, x, y, np.array([0.0, 0.0, 1.0]), self.wall)
        return np.minimum(self.ground_depth(view, x, y), np.minimum(wall, 2 * self.wall)).astype(np.float32)


@dataclass(frozen=True)
class PointStage:
    """Background known at points (N, 3) of the world, blended smoothly between them; a stage where there are none."""

    points: np.ndarray
    otherwise: Stage
    _seen: dict[bytes, np.ndarray] = field(default_factory=dict, compare=False, repr=False)

    def ground_depth(self, view: View, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Depth of the background at raster pixels (x, y)."""
        column = np.clip(np.asarray(x).astype(int), 0, view.width - 1)
        row = np.clip(np.asarray(y).astype(int), 0, view.height - 1)
        return self.depth(view)[row, column]

    def depth(self, view: View) -> np.ndarray:  # (H, W) float32
        """Depth at every pixel of a view: a plane in inverse depth fitted round every node of a grid.

        Inverse depth of a plane is linear in the image, so walls and floors are exact and nothing can turn infinite:
        values stay within what the points in view show, and half as much again.
        """
        key = view.world_to_camera.tobytes() + np.array([view.fx, view.width, view.height], float).tobytes()
        if key not in self._seen:
            self._seen[key] = self._blend(view)
        return self._seen[key]

    def _blend(self, view: View) -> np.ndarray:
        here = self.points @ view.world_to_camera[:3, :3].T + view.world_to_camera[:3, 3]
        here = here[here[:, 2] > 1e-2]
        uv = here[:, :2] / here[:, 2:] * [view.fx, view.fy] + [view.cx, view.cy]
        margin = 0.2 * np.array([view.width, view.height])
        near = ((uv > -margin) & (uv < np.array([view.width, view.height]) + margin)).all(axis=1)
        if near.sum() < _FEWEST_SEEN:
            return self.otherwise.depth(view)
        uv, inverse = uv[near], 1.0 / here[near, 2]
        short = min(view.width, view.height)
        nodes = (max(2, round(_GRID * view.width / short)), max(2, round(_GRID * view.height / short)))
        x, y = ((np.arange(n) + 0.5) * size / n for n, size in zip(nodes, (view.width, view.height), strict=True))
        grid = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
        offset = (uv[None] - grid[:, None]) / (_REACH * short)  # (G, N, 2)
        weight = np.exp(-0.5 * np.minimum((offset**2).sum(axis=-1), 80.0)) + 1e-6
        design = np.concatenate([np.ones((*offset.shape[:2], 1)), offset], axis=-1)
        normal = np.einsum("gn,gni,gnj->gij", weight, design, design) + np.diag([0, 0.1, 0.1])
        value = np.linalg.solve(normal, np.einsum("gn,gni,n->gi", weight, design, inverse)[..., None])[:, 0, 0]
        low, high = np.percentile(inverse, [1, 99])
        plane = np.clip(value, low / 1.5, high * 1.5).reshape(nodes[1], nodes[0])
        return (1.0 / cv2.resize(plane, (view.width, view.height), interpolation=cv2.INTER_LINEAR)).astype(np.float32)


def guess_ground(view: View, lowest_rows: np.ndarray) -> np.ndarray:  # (K,) raster rows -> (3,)
    """Normal of a ground plane whose horizon lies a third down the frame, or higher if an object stands higher up.

    Args:
        view: camera 0. lowest_rows: usual lowest mask row of every object, NaN where unknown.
    """
    horizon = _USUAL_HORIZON * view.height
    if np.isfinite(lowest_rows).any():
        horizon = min(horizon, float(np.nanmin(lowest_rows)) - _CLEARANCE * view.height)
    normal = np.array([0.0, view.fy, view.cy - horizon])
    return normal / np.linalg.norm(normal)


def _meet(view: View, x: np.ndarray, y: np.ndarray, normal: np.ndarray, offset: float) -> np.ndarray:
    """Depth where rays meet the plane normal . X = offset of the world; `_FURTHEST` times |offset| where never."""
    to_world = np.linalg.inv(view.world_to_camera)
    in_camera = normal @ to_world[:3, :3]
    distance = offset - normal @ to_world[:3, 3]
    slope = in_camera[0] * (x - view.cx) / view.fx + in_camera[1] * (y - view.cy) / view.fy + in_camera[2]
    furthest = _FURTHEST * abs(offset)
    meets = slope * np.sign(distance) > abs(distance) / furthest
    return np.where(meets, distance / np.where(meets, slope, 1.0), furthest)
