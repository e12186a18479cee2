"""Axes, units, quaternion order, pixel centres and time, on one page.

Pixels are raster coordinates: pixel (row i, column j) covers [j, j+1) x [i, i+1), its centre is (j + 0.5, i + 0.5);
x right, y down. Resizing an image multiplies coordinates by the ratio of the sizes, nothing else.

Cameras are OpenCV: x right, y down, z forward; `world_to_camera` is 4 x 4, `K` is 3 x 3 in raster pixels with the
principal point in raster coordinates. A clip with pixels that are not square has fx != fy.

Depth is z along the camera axis, in scene units, positive in front.

Quaternions are (w, x, y, z), unit length, and rotate column vectors.

The view (elevation, azimuth) = (0, 0) is the frame's input camera. A view turns that camera rigidly about a target:
azimuth about world up (+ = the camera moves to its right), elevation about the turned camera's right axis (+ = from
above). World up is the clip's, by default minus y of camera 0.

Time is the frame's position 0..T-1 in the clip as read; `frame_index` holds its number in the source.
"""

from __future__ import annotations

import numpy as np

DILATION = 0.3  # px^2 added to every projected covariance, at the size the scene was optimised at
SH_C0 = 0.28209479177387814  # value of the constant spherical harmonic: rgb = 0.5 + SH_C0 * dc

SHADE_LIMIT = 1.5  # of the logarithm of what shading does to a colour


def normalise_quaternions(quats: np.ndarray) -> np.ndarray:  # (..., 4) wxyz
    """Unit quaternions; a quaternion shorter than 1e-12 or not finite becomes the identity.

    Returns an array of the same shape and floating dtype.
    """
    norm = np.linalg.norm(quats, axis=-1, keepdims=True)
    good = np.isfinite(norm) & (norm > 1e-12)
    identity = np.zeros_like(quats)
    identity[..., 0] = 1.0
    return np.where(good, quats / np.where(good, norm, 1.0), identity)


def quaternion_to_matrix(quats: np.ndarray) -> np.ndarray:  # (..., 4) wxyz -> (..., 3, 3)
    """Rotation matrices of quaternions, which are normalised first."""
    w, x, y, z = np.moveaxis(normalise_quaternions(np.asarray(quats)), -1, 0)
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return np.stack([np.stack(r, axis=-1) for r in rows], axis=-2)


def matrix_to_quaternion(rotation: np.ndarray) -> np.ndarray:  # (..., 3, 3) -> (..., 4) wxyz
    """Unit quaternions with w >= 0 of rotation matrices, stable at any angle (largest of the four squares)."""
    m = np.asarray(rotation)
    m00, m11, m22 = m[..., 0, 0], m[..., 1, 1], m[..., 2, 2]
    squares = np.stack([1 + m00 + m11 + m22, 1 + m00 - m11 - m22, 1 - m00 + m11 - m22, 1 - m00 - m11 + m22], axis=-1)
    d = {
        "zy": m[..., 2, 1] - m[..., 1, 2], "xz": m[..., 0, 2] - m[..., 2, 0], "yx": m[..., 1, 0] - m[..., 0, 1],
        "xy": m[..., 1, 0] + m[..., 0, 1], "zx": m[..., 0, 2] + m[..., 2, 0], "yz": m[..., 2, 1] + m[..., 1, 2],
    }  # fmt: skip
    candidates = np.stack(
        [
            np.stack([squares[..., 0], d["zy"], d["xz"], d["yx"]], axis=-1),
            np.stack([d["zy"], squares[..., 1], d["xy"], d["zx"]], axis=-1),
            np.stack([d["xz"], d["xy"], squares[..., 2], d["yz"]], axis=-1),
            np.stack([d["yx"], d["zx"], d["yz"], squares[..., 3]], axis=-1),
        ],
        axis=-2,
    )
    best = np.argmax(squares, axis=-1)[..., None, None]
    quats = normalise_quaternions(np.take_along_axis(candidates, best, axis=-2)[..., 0, :])
    return np.where(quats[..., :1] < 0, -quats, quats)


def quaternion_multiply(a: np.ndarray, b: np.ndarray) -> np.ndarray:  # (..., 4), (..., 4) wxyz
    """Hamilton product: the rotation b followed by the rotation a."""
    aw, ax, ay, az = np.moveaxis(np.asarray(a), -1, 0)
    bw, bx, by, bz = np.moveaxis(np.asarray(b), -1, 0)
    return np.stack(
        [
            aw * bw - ax * bx - ay * by - az * bz,
            aw * bx + ax * bw + ay * bz - az * by,
            aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw,
        ],
        axis=-1,
    )


def rgb_to_dc(rgb: np.ndarray) -> np.ndarray:
    """Constant spherical-harmonic coefficient of a colour in 0..1."""
    return (np.asarray(rgb) - 0.5) / SH_C0


def dc_to_rgb(dc: np.ndarray) -> np.ndarray:
    """Colour (not clamped) of a constant spherical-harmonic coefficient."""
    return 0.5 + SH_C0 * np.asarray(dc)


def harmonics(normals: np.ndarray) -> np.ndarray:  # (N, 3) -> (N, 8)
    """Real spherical harmonics of order 1 and 2 of unit vectors, each about as large as x (not normalised)."""
    x, y, z = np.moveaxis(np.asarray(normals, dtype=np.float64), -1, 0)
    return np.stack([x, y, z, x * y, y * z, z * x, 1.5 * z * z - 0.5, 0.5 * (x * x - y * y)], axis=-1)


def shade_factors(before: np.ndarray, now: np.ndarray, light: np.ndarray) -> np.ndarray:  # (N, 3), (N, 3), (8,)
    """(N,) what colours are multiplied by when unit world normals turn from `before` to `now` (scene/shading.py)."""
    return np.exp(np.clip((harmonics(now) - harmonics(before)) @ light, -SHADE_LIMIT, SHADE_LIMIT))


def axis_angle_matrix(axis: np.ndarray, degrees: float) -> np.ndarray:  # (3,) -> (3, 3)
    """Right-handed rotation by an angle in degrees about a unit axis (Rodrigues)."""
    x, y, z = np.asarray(axis, dtype=np.float64)
    angle = np.deg2rad(degrees)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * (cross @ cross)


def orbit_camera(
    world_to_camera: np.ndarray,  # (4, 4) OpenCV
    target: np.ndarray,  # (3,) world
    world_up: np.ndarray,  # (3,) unit
    elevation: float,  # degrees, + = from above
    azimuth: float,  # degrees, + = the camera moves to its right
) -> np.ndarray:  # (4, 4) world_to_camera of the turned camera
    """The input camera turned rigidly about a target: azimuth about world up, then elevation about its right axis."""
    camera_to_world = np.linalg.inv(np.asarray(world_to_camera, dtype=np.float64))
    turn = axis_angle_matrix(np.asarray(world_up) / np.linalg.norm(world_up), azimuth)
    right = turn @ camera_to_world[:3, 0]
    turn = axis_angle_matrix(right / np.linalg.norm(right), -elevation) @ turn
    turned = np.eye(4)
    turned[:3, :3] = turn @ camera_to_world[:3, :3]
    turned[:3, 3] = target + turn @ (camera_to_world[:3, 3] - target)
    return np.linalg.inv(turned)
