"""A stage for guessed depth: a ground plane under a horizon, and a wall behind everything.

World = camera 0; the camera stands one scene unit above the ground, so a guess has a unit but no true scale.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from genmojo_core.clip.cameras import View

_USUAL_HORIZON = 0.35  # share of the frame's height
_CLEARANCE = 0.12  # an object standing on the ground ends at least this far under the horizon, same unit
_FURTHEST = 30.0  # camera heights


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
