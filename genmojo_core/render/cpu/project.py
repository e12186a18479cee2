"""Splats to ellipses on the image, and the way back for their gradients.

Camera space t = W x + t0 with z = t_z; u = t_x / z, v = t_y / z; centre (f_x u + c_x, f_y v + c_y). The Jacobian of
the projection is taken at u, v clamped to the image's field of view plus 15 % of its size on each side (METHOD.md
section 5; the limits come from the principal point, so a crop clamps like the picture it was cut from). With
P = J W R diag(s), a 2 x 3 matrix, the ellipse is Sigma = P P' + d I, d the view's dilation, and its inverse is the
conic (a, b, c): alpha = o exp(-(a dx^2 + 2 b dx dy + c dy^2) / 2). The determinant of Sigma is the sum of the squared
2 x 2 minors of P plus d tr(P P') + d^2: no cancellation, so needles stay positive definite.

The box outside which alpha < 1/255 is exact: half-widths sqrt(2 ln(255 o) Sigma_xx), sqrt(2 ln(255 o) Sigma_yy).
Everything per splat is float64; what the pixel loops read is float32.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from genmojo_core.clip.cameras import View
from genmojo_core.kernels.cache import inlined, kernel
from genmojo_core.render.rasterizer import ALPHA_MIN, FRUSTUM_CLAMP

LOG2_E = 1.4426950408889634
SHORTEST_QUATERNION = 1e-12
GEOMETRY = 6  # floats per splat read by the pixel loops: centre x, y, three quadratic terms, log2 of the opacity


class Lens(NamedTuple):
    """A camera as the kernels read it; pixels, scene units, OpenCV axes."""

    rotation: np.ndarray  # (3, 3) float64, world to camera
    translation: np.ndarray  # (3,) float64
    focal: np.ndarray  # (4,) float64: fx, fy, cx, cy
    limits: np.ndarray  # (4,) float64: lowest and highest u, lowest and highest v of the Jacobian
    depths: np.ndarray  # (2,) float64: near, far
    width: int
    height: int
    dilation: float  # px^2


class Cloud(NamedTuple):
    """Splats as the kernels read them: float32, C order (`Splats` without its features)."""

    means: np.ndarray  # (N, 3)
    quats: np.ndarray  # (N, 4) wxyz
    scales: np.ndarray  # (N, 3)
    opacities: np.ndarray  # (N,)


class Ellipses(NamedTuple):
    """Projected splats; rows of splats that are not drawn have an empty box."""

    geometry: np.ndarray  # (N, 6) float32: centre x, y; log2(e) times -a/2, -b, -c/2; log2 opacity
    depth: np.ndarray  # (N,) float32 camera z
    box: np.ndarray  # (N, 4) int32: first and last column, first and last row of pixels that can reach 1/255


def lens_of(view: View, pose: np.ndarray | None = None) -> Lens:
    """The kernels' camera of a `View`; `pose` (4, 4) takes the place of its world_to_camera."""
    world_to_camera = np.asarray(view.world_to_camera if pose is None else pose, dtype=np.float64)
    margin = (FRUSTUM_CLAMP - 1.0) / 2
    limits = [
        -(view.cx + margin * view.width) / view.fx,
        (view.width - view.cx + margin * view.width) / view.fx,
        -(view.cy + margin * view.height) / view.fy,
        (view.height - view.cy + margin * view.height) / view.fy,
    ]
    return Lens(
        np.ascontiguousarray(world_to_camera[:3, :3]),
        np.ascontiguousarray(world_to_camera[:3, 3]),
        np.array([view.fx, view.fy, view.cx, view.cy], dtype=np.float64),
        np.array(limits, dtype=np.float64),
        np.array([view.near, view.far], dtype=np.float64),
        int(view.width),
        int(view.height),
        float(view.dilation),
    )


@inlined
def _rotation(quats: np.ndarray, i: int) -> tuple:
    """Inverse length of quaternion i (0 where it has none), its unit form and the nine entries of its matrix."""
    w, x, y, z = float(quats[i, 0]), float(quats[i, 1]), float(quats[i, 2]), float(quats[i, 3])
    length = math.sqrt(w * w + x * x + y * y + z * z)
    inverse = 1.0 / length if length > SHORTEST_QUATERNION and length < math.inf else 0.0
    w, x, y, z = w * inverse, x * inverse, y * inverse, z * inverse
    return (
        inverse, (w, x, y, z),
        (1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
        (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
        (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)),
    )  # fmt: skip


@inlined
def camera_point(lens: Lens, means: np.ndarray, i: int) -> tuple:
    """Camera coordinates (x, y, z) of mean i."""
    a, b, c = float(means[i, 0]), float(means[i, 1]), float(means[i, 2])
    r, t = lens.rotation, lens.translation
    return (
        r[0, 0] * a + r[0, 1] * b + r[0, 2] * c + t[0],
        r[1, 0] * a + r[1, 1] * b + r[1, 2] * c + t[1],
        r[2, 0] * a + r[2, 1] * b + r[2, 2] * c + t[2],
    )


@inlined
def footprint(lens: Lens, cloud: Cloud, i: int, point: tuple) -> tuple:
    """Everything both passes need of splat i in front of the camera.

    Returns (inverse quaternion length, unit quaternion), (u, v, u is free, v is free), V = W R as three rows, the rows
    Q = V_row - u V_z of P without focal length and scale, P's two rows, and Sigma (xx, xy, yy, determinant).
    """
    fx, fy = lens.focal[0], lens.focal[1]
    inverse, unit, r0, r1, r2 = _rotation(cloud.quats, i)
    w = lens.rotation
    s0, s1, s2 = float(cloud.scales[i, 0]), float(cloud.scales[i, 1]), float(cloud.scales[i, 2])
    u0, v0 = point[0] / point[2], point[1] / point[2]
    u = min(max(u0, lens.limits[0]), lens.limits[1])
    v = min(max(v0, lens.limits[2]), lens.limits[3])
    vx = (w[0, 0] * r0[0] + w[0, 1] * r1[0] + w[0, 2] * r2[0], w[0, 0] * r0[1] + w[0, 1] * r1[1] + w[0, 2] * r2[1],
          w[0, 0] * r0[2] + w[0, 1] * r1[2] + w[0, 2] * r2[2])  # fmt: skip
    vy = (w[1, 0] * r0[0] + w[1, 1] * r1[0] + w[1, 2] * r2[0], w[1, 0] * r0[1] + w[1, 1] * r1[1] + w[1, 2] * r2[1],
          w[1, 0] * r0[2] + w[1, 1] * r1[2] + w[1, 2] * r2[2])  # fmt: skip
    vz = (w[2, 0] * r0[0] + w[2, 1] * r1[0] + w[2, 2] * r2[0], w[2, 0] * r0[1] + w[2, 1] * r1[1] + w[2, 2] * r2[1],
          w[2, 0] * r0[2] + w[2, 1] * r1[2] + w[2, 2] * r2[2])  # fmt: skip
    jx, jy = fx / point[2], fy / point[2]
    px = (jx * s0 * (vx[0] - u * vz[0]), jx * s1 * (vx[1] - u * vz[1]), jx * s2 * (vx[2] - u * vz[2]))
    py = (jy * s0 * (vy[0] - v * vz[0]), jy * s1 * (vy[1] - v * vz[1]), jy * s2 * (vy[2] - v * vz[2]))
    xx = px[0] * px[0] + px[1] * px[1] + px[2] * px[2]
    xy = px[0] * py[0] + px[1] * py[1] + px[2] * py[2]
    yy = py[0] * py[0] + py[1] * py[1] + py[2] * py[2]
    m0, m1, m2 = px[0] * py[1] - px[1] * py[0], px[0] * py[2] - px[2] * py[0], px[1] * py[2] - px[2] * py[1]
    d = lens.dilation
    det = m0 * m0 + m1 * m1 + m2 * m2 + d * (xx + yy) + d * d
    sigma = (xx + d, xy, yy + d, det)
    return (inverse, unit), (u0, v0, u, v), (vx, vy, vz), (px, py), sigma


@inlined
def _span(centre: float, half: float, size: int) -> tuple:
    """First and last pixel whose centre lies within half of `centre`, inside 0..size-1 (first > last: none)."""
    first = math.ceil(max(centre - half - 0.5, 0.0))
    last = math.floor(min(centre + half - 0.5, size - 1.0))
    return int(min(first, float(size))), int(max(last, -1.0))


@kernel
def project_range(start: int, stop: int, lens: Lens, cloud: Cloud, out: Ellipses) -> None:
    """Project splats start..stop-1.

    Not drawn, with an empty box: depth outside near..far, opacity below 1/255, a quaternion without length, an ellipse
    off the image, anything not finite.
    """
    for i in range(start, stop):
        out.box[i, 0], out.box[i, 1], out.box[i, 2], out.box[i, 3] = 1, 0, 1, 0
        point = camera_point(lens, cloud.means, i)
        opacity = float(cloud.opacities[i])
        if not (point[2] >= lens.depths[0] and point[2] <= lens.depths[1] and opacity >= ALPHA_MIN):
            continue
        (inverse, _), (u0, v0, _, _), _, _, (xx, xy, yy, det) = footprint(lens, cloud, i, point)
        x, y = lens.focal[0] * u0 + lens.focal[2], lens.focal[1] * v0 + lens.focal[3]
        reach = 2 * math.log(opacity / ALPHA_MIN)
        half_x, half_y = math.sqrt(reach * xx), math.sqrt(reach * yy)
        if not (inverse > 0 and det < math.inf and abs(x) + half_x < 1e30 and abs(y) + half_y < 1e30):
            continue
        first_x, last_x = _span(x, half_x, lens.width)
        first_y, last_y = _span(y, half_y, lens.height)
        if first_x > last_x or first_y > last_y:
            continue
        out.box[i, 0], out.box[i, 1], out.box[i, 2], out.box[i, 3] = first_x, last_x, first_y, last_y
        out.depth[i] = point[2]
        scale = LOG2_E / det
        row = out.geometry[i]
        row[0], row[1] = x, y
        row[2], row[3], row[4], row[5] = -0.5 * scale * yy, scale * xy, -0.5 * scale * xx, math.log2(opacity)
