"""The rigid path of one object through a clip, the matches it is found from, and the geometry of both."""

from __future__ import annotations

from dataclasses import dataclass, replace

import cv2
import numpy as np

from genmojo_core.clip.cameras import Cameras


@dataclass(frozen=True)
class Path:
    """Where the object is: X at frame t = rotation[t] (X_ref - centre) + position[t], world coordinates.

    Args:
        rotation: (T, 3, 3) float64.
        position: (T, 3) float64, where the centre goes.
        centre: (3,) float64 world, the object's centre at the reference frame.
        ref: reference frame; there the rotation is the identity and the position the centre.
    """

    rotation: np.ndarray
    position: np.ndarray
    centre: np.ndarray
    ref: int

    def between(self, s: int, t: int, points: np.ndarray) -> np.ndarray:
        """World points (..., 3) on the object at frame s, carried to frame t."""
        return (points - self.position[s]) @ (self.rotation[t] @ self.rotation[s].T).T + self.position[t]

    def matrices(self) -> np.ndarray:
        """(T, 4, 4) maps from world points at the reference frame to world points at each frame."""
        out = np.tile(np.eye(4), (len(self.position), 1, 1))
        out[:, :3, :3] = self.rotation
        out[:, :3, 3] = self.position - self.rotation @ self.centre
        return out

    def moved(self, t: int, rotation: np.ndarray, position: np.ndarray) -> Path:
        """The same path with another pose in frame t; its rotation is made exact.

        Predictions multiply rotations of earlier frames: a rounding error not taken out grows with every frame.
        """
        rotations, positions = self.rotation.copy(), self.position.copy()
        rotations[t], positions[t] = exp_rotation(log_rotation(rotation)), position
        return replace(self, rotation=rotations, position=positions)


@dataclass(frozen=True)
class Sight:
    """Points of the object in a source frame as matched in a target frame.

    Args:
        source, target: frames.
        index: (N,) int64 places of the points in the problem's list of depths.
        xy: (N, 2) raster pixels in the target frame.
        weight: (N,) 0..1.
        surface: (N, 3) world points of the target's surface at xy.
        normal: (N, 3) unit normals there; zero where unknown.
        facing: (N, 2) image normals if the points lie on an outline, which says nothing along itself; else None.
    """

    source: int
    target: int
    index: np.ndarray
    xy: np.ndarray
    weight: np.ndarray
    surface: np.ndarray
    normal: np.ndarray
    facing: np.ndarray | None = None

    @property
    def shares(self) -> np.ndarray:  # (N,)
        """Weights scaled so that one sight counts as at most 40 independent points."""
        return self.weight * min(1.0, 40.0 / max(len(self.weight), 1))


@dataclass(frozen=True)
class Problem:
    """What a solve needs besides the path.

    Args:
        cameras: of all frames.
        origin: (M, 3) camera centre of each source point's frame. ray: (M, 3) world ray of depth 1.
        depth: (M,) depth along the ray. size: scene units across the object.
        sights: the matches.
        pixel_sigma, outline_sigma: pixels; robust scale of the matches of texture and of outlines.
        surface_sigma: scene units; robust scale of the distance to the target's surface (0: do not use it).
        depth_sigma: scene units; how far depths may move (0: they are exact and stay).
        turn_weight: cost per rad^2 of turning between neighbouring frames.
        anchor, anchor_weight: (T, 3) world and (T,) per unit^2: where the centre lies by the mask alone, to hold frames
            together that no match connects; None: nothing is known.
        stride: frames of the clip from one frame to the next; motion between them may be as many times less even.
    """

    cameras: Cameras
    origin: np.ndarray
    ray: np.ndarray
    depth: np.ndarray
    size: float
    sights: tuple[Sight, ...]
    pixel_sigma: float = 1.0
    outline_sigma: float = 2.0
    surface_sigma: float = 0.0
    depth_sigma: float = 0.0
    turn_weight: float = 0.0
    anchor: np.ndarray | None = None
    anchor_weight: np.ndarray | None = None
    stride: int = 1


def still_path(frames: int, centre: np.ndarray, ref: int) -> Path:
    """A path that does not move."""
    return Path(np.tile(np.eye(3), (frames, 1, 1)), np.tile(centre, (frames, 1)), centre, ref)


def project(cameras: Cameras, t: int, points: np.ndarray) -> np.ndarray:  # (..., 3) world -> (..., 2) raster pixels
    """Image places of world points in frame t; points behind the camera land far outside."""
    pose, k = cameras.world_to_camera[t], cameras.K[t]
    x = points @ pose[:3, :3].T + pose[:3, 3]
    z = np.maximum(x[..., 2:], 1e-6)
    return x[..., :2] / z * [k[0, 0], k[1, 1]] + k[:2, 2]


def rays(cameras: Cameras, t: int, xy: np.ndarray) -> np.ndarray:  # (..., 2) raster pixels -> (..., 3) world
    """World directions through image places, of length such that depth (z) is 1."""
    k, rotation = cameras.K[t], cameras.world_to_camera[t][:3, :3]
    local = np.concatenate([(xy - k[:2, 2]) / [k[0, 0], k[1, 1]], np.ones((*xy.shape[:-1], 1))], axis=-1)
    return local @ rotation


def camera_centre(cameras: Cameras, t: int) -> np.ndarray:  # (3,) world
    """Where the camera of frame t is."""
    pose = cameras.world_to_camera[t]
    return -pose[:3, :3].T @ pose[:3, 3]


def log_rotation(rotation: np.ndarray) -> np.ndarray:  # (3, 3) -> (3,)
    """Rotation vector of a rotation matrix."""
    return cv2.Rodrigues(np.ascontiguousarray(rotation))[0][:, 0]


def exp_rotation(vector: np.ndarray) -> np.ndarray:  # (3,) -> (3, 3)
    """Rotation matrix of a rotation vector."""
    return cv2.Rodrigues(np.asarray(vector, np.float64))[0]
