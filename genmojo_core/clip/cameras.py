"""Pinhole cameras of a clip: intrinsics and poses, with checks."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from genmojo_core.conventions import DILATION
from genmojo_core.errors import GenmojoError


@dataclass(frozen=True)
class View:
    """One pinhole camera: OpenCV axes, raster pixels.

    Args:
        world_to_camera: (4, 4) float64, rigid.
        fx, fy: focal lengths in pixels; they differ where pixels are not square.
        cx, cy: principal point in raster pixels; it may lie outside the image (a crop).
        width, height: image size in pixels.
        near, far: depths in scene units outside which nothing is drawn.
        dilation: px^2 of this image that a rasteriser adds to every projected covariance; it scales with the area
            when the image is resized.
    """

    world_to_camera: np.ndarray
    fx: float
    fy: float
    cx: float
    cy: float
    width: int
    height: int
    near: float = 0.01
    far: float = 1e4
    dilation: float = DILATION

    @property
    def K(self) -> np.ndarray:  # noqa: N802 - the field's name
        """(3, 3) float64 intrinsics in raster pixels."""
        return np.array([[self.fx, 0.0, self.cx], [0.0, self.fy, self.cy], [0.0, 0.0, 1.0]])

    def resized(self, width: int, height: int) -> View:
        """The same camera for an image of another size (x and y scaled on their own)."""
        sx, sy = width / self.width, height / self.height
        return View(self.world_to_camera, self.fx * sx, self.fy * sy, self.cx * sx, self.cy * sy, width, height,
                    self.near, self.far, self.dilation * sx * sy)  # fmt: skip

    def cropped(self, left: float, top: float, width: int, height: int) -> View:
        """The same camera looking at a window of its image; left and top in pixels, may be negative."""
        return View(self.world_to_camera, self.fx, self.fy, self.cx - left, self.cy - top, width, height,
                    self.near, self.far, self.dilation)  # fmt: skip

    def with_pose(self, world_to_camera: np.ndarray) -> View:
        """The same lens at another place."""
        return View(np.asarray(world_to_camera, dtype=np.float64), self.fx, self.fy, self.cx, self.cy, self.width,
                    self.height, self.near, self.far, self.dilation)  # fmt: skip


@dataclass(frozen=True)
class Cameras:
    """Cameras of all frames of a clip.

    Args:
        K: (T, 3, 3) float64, raster pixels of `size`.
        world_to_camera: (T, 4, 4) float64, OpenCV axes.
        size: (width, height) in pixels that K refers to.
        near, far: scene units.
        dilation: as in `View`, px^2 of `size`.
    """

    K: np.ndarray
    world_to_camera: np.ndarray
    size: tuple[int, int]
    near: float = 0.01
    far: float = 1e4
    dilation: float = DILATION

    def __len__(self) -> int:
        return len(self.world_to_camera)

    def view(self, t: int) -> View:
        """The camera of frame t (0..T-1)."""
        k = self.K[t]
        return View(self.world_to_camera[t], float(k[0, 0]), float(k[1, 1]), float(k[0, 2]), float(k[1, 2]),
                    self.size[0], self.size[1], self.near, self.far, self.dilation)  # fmt: skip

    def resized(self, width: int, height: int) -> Cameras:
        """The same cameras for images of another size."""
        sx, sy = width / self.size[0], height / self.size[1]
        return Cameras(np.diag([sx, sy, 1.0]) @ self.K, self.world_to_camera, (width, height), self.near, self.far,
                       self.dilation * sx * sy)  # fmt: skip

    def selected(self, indices: np.ndarray) -> Cameras:
        """Cameras of some of the frames."""
        return Cameras(self.K[indices], self.world_to_camera[indices], self.size, self.near, self.far,
                       self.dilation)  # fmt: skip


def check_cameras(cameras: Cameras, frames: int, where: str) -> None:
    """Raise GenmojoError("camera") where a camera is no camera.

    Checked per frame: finite values, positive focal lengths, rotation orthonormal within 1e-3 and right-handed, last
    row (0, 0, 0, 1); and that there are as many cameras as frames.
    """
    if cameras.K.shape != (frames, 3, 3) or cameras.world_to_camera.shape != (frames, 4, 4):
        raise GenmojoError("camera", f"holds {len(cameras.world_to_camera)} cameras for {frames} frames", where,
                           "give one camera per frame")  # fmt: skip
    for t in range(frames):
        k, pose = cameras.K[t], cameras.world_to_camera[t]
        fault = ""
        if not (np.isfinite(k).all() and np.isfinite(pose).all()):
            fault = "has values that are not finite"
        elif k[0, 0] <= 0 or k[1, 1] <= 0:
            fault = f"has a focal length that is not positive ({k[0, 0]:.4g}, {k[1, 1]:.4g})"
        elif np.abs(pose[:3, :3] @ pose[:3, :3].T - np.eye(3)).max() > 1e-3:
            fault = "has a rotation that is not orthonormal"
        elif np.linalg.det(pose[:3, :3]) < 0:
            fault = "has a left-handed rotation (determinant -1)"
        elif np.abs(pose[3] - np.array([0, 0, 0, 1])).max() > 1e-6:
            fault = "has a last row that is not (0, 0, 0, 1)"
        if fault:
            raise GenmojoError("camera", f"the camera of frame {t} {fault}", where, "check world_to_camera and K")
