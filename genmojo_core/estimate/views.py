"""Carrying pixels from one camera of a clip into another through their depth."""

from __future__ import annotations

import numpy as np

from genmojo_core.clip.cameras import View


def carry(source: View, target: View, depth: np.ndarray) -> np.ndarray:  # (H, W) -> (H, W, 2) float32
    """Where the target camera sees the source's pixels, lifted by their depth, in OpenCV's pixel-centre coordinates.

    Pixels behind the target camera go to (-1e4, -1e4).
    """
    h, w = depth.shape
    x, y = np.meshgrid(np.arange(w) + 0.5, np.arange(h) + 0.5)
    motion = target.world_to_camera @ np.linalg.inv(source.world_to_camera)
    xyz = np.stack([(x - source.cx) / source.fx * depth, (y - source.cy) / source.fy * depth, depth], axis=-1)
    xyz = xyz @ motion[:3, :3].T + motion[:3, 3]
    z = xyz[..., 2]
    front = z > 1e-6
    z = np.where(front, z, 1.0)
    u = np.where(front, target.fx * xyz[..., 0] / z + target.cx - 0.5, -1e4)
    v = np.where(front, target.fy * xyz[..., 1] / z + target.cy - 0.5, -1e4)
    return np.stack([u, v], axis=-1).clip(-1e4, 1e4).astype(np.float32)


def depth_in(source: View, target: View, depth: np.ndarray) -> np.ndarray:  # (H, W) -> (H, W)
    """Depth, in the target camera, of the source's pixels lifted by their depth."""
    h, w = depth.shape
    x, y = np.meshgrid(np.arange(w) + 0.5, np.arange(h) + 0.5)
    row = (target.world_to_camera @ np.linalg.inv(source.world_to_camera))[2]
    return depth * (row[0] * (x - source.cx) / source.fx + row[1] * (y - source.cy) / source.fy + row[2]) + row[3]
