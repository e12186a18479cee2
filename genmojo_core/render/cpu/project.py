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
from genmojo_core.kernels.scalars import larger, smaller
from genmojo_core.kernels.stage import Stage, begin, claim, end_of, fetch_add, meet
from genmojo_core.render.rasterizer import ALPHA_MIN, FRUSTUM_CLAMP

LOG2_E = 1.4426950408889634
LOG_ALPHA_MIN = math.log(ALPHA_MIN)
SHORTEST_QUATERNION = 1e-12
WIDEST = 1e7  # pixels: an ellipse that reaches further is a fault, and would overflow float32 in backward
TILE = 16  # pixels
SHIFT = 4  # TILE as a power of two
DRAWN, ENTRIES = 0, 1  # places in Ellipses.totals
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
    totals: np.ndarray  # (2,) int64, zero at first: splats drawn, and the tiles that they touch


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
    """Length of quaternion i and the rows of its matrix (of no meaning where it has no length)."""
    w, x, y, z = float(quats[i, 0]), float(quats[i, 1]), float(quats[i, 2]), float(quats[i, 3])
    square = w * w + x * x + y * y + z * z
    k = 2.0 / larger(square, 1e-300)
    return (
        math.sqrt(square),
        (1 - k * (y * y + z * z), k * (x * y - w * z), k * (x * z + w * y)),
        (k * (x * y + w * z), 1 - k * (x * x + z * z), k * (y * z - w * x)),
        (k * (x * z - w * y), k * (y * z + w * x), 1 - k * (x * x + y * y)),
    )


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
def _across(g: tuple, r0: tuple, r1: tuple, r2: tuple, s: tuple) -> tuple:
    """Row vector g times the matrix with rows r0, r1, r2, its columns scaled by s."""
    return (
        s[0] * (g[0] * r0[0] + g[1] * r1[0] + g[2] * r2[0]),
        s[1] * (g[0] * r0[1] + g[1] * r1[1] + g[2] * r2[1]),
        s[2] * (g[0] * r0[2] + g[1] * r1[2] + g[2] * r2[2]),
    )


@inlined
def ellipse(lens: Lens, cloud: Cloud, i: int, point: tuple) -> tuple:
    """Sigma of splat i in front of the camera: xx, xy, yy with dilation, determinant, and the quaternion's length."""
    length, r0, r1, r2 = _rotation(cloud.quats, i)
    w = lens.rotation
    s = (float(cloud.scales[i, 0]), float(cloud.scales[i, 1]), float(cloud.scales[i, 2]))
    u = smaller(larger(point[0] / point[2], lens.limits[0]), lens.limits[1])
    v = smaller(larger(point[1] / point[2], lens.limits[2]), lens.limits[3])
    jx, jy = lens.focal[0] / point[2], lens.focal[1] / point[2]
    # rows of J W, then of P = J W R diag(s)
    gx = (jx * (w[0, 0] - u * w[2, 0]), jx * (w[0, 1] - u * w[2, 1]), jx * (w[0, 2] - u * w[2, 2]))
    gy = (jy * (w[1, 0] - v * w[2, 0]), jy * (w[1, 1] - v * w[2, 1]), jy * (w[1, 2] - v * w[2, 2]))
    px, py = _across(gx, r0, r1, r2, s), _across(gy, r0, r1, r2, s)
    xx = px[0] * px[0] + px[1] * px[1] + px[2] * px[2]
    xy = px[0] * py[0] + px[1] * py[1] + px[2] * py[2]
    yy = py[0] * py[0] + py[1] * py[1] + py[2] * py[2]
    m0, m1, m2 = px[0] * py[1] - px[1] * py[0], px[0] * py[2] - px[2] * py[0], px[1] * py[2] - px[2] * py[1]
    d = lens.dilation
    det = m0 * m0 + m1 * m1 + m2 * m2 + d * (xx + yy) + d * d
    return (xx + d, xy, yy + d, det), length


@inlined
def _span(centre: float, half: float, size: int) -> tuple:
    """First and last pixel whose centre lies within half of `centre`, inside 0..size-1 (first > last: none)."""
    first = math.ceil(larger(centre - half - 0.5, 0.0))
    last = math.floor(smaller(centre + half - 0.5, size - 1.0))
    return np.int64(smaller(first, size)), np.int64(larger(last, -1))


@inlined
def project_range(start: int, stop: int, lens: Lens, cloud: Cloud, out: Ellipses) -> tuple:
    """Project splats start..stop-1; how many are drawn, and how many tiles they touch.

    Not drawn, with an empty box: depth outside near..far, opacity below 1/255, a quaternion without length, an ellipse
    off the image or reaching further than WIDEST, anything not finite.
    """
    drawn, entries = 0, 0
    for i in range(start, stop):
        out.box[i, 0], out.box[i, 1], out.box[i, 2], out.box[i, 3] = 1, 0, 1, 0
        point = camera_point(lens, cloud.means, i)
        opacity = float(cloud.opacities[i])
        if not (point[2] >= lens.depths[0] and point[2] <= lens.depths[1] and opacity >= ALPHA_MIN):
            continue
        (xx, xy, yy, det), length = ellipse(lens, cloud, i, point)
        x = lens.focal[0] * (point[0] / point[2]) + lens.focal[2]
        y = lens.focal[1] * (point[1] / point[2]) + lens.focal[3]
        log_opacity = math.log(opacity)
        reach = 2 * (log_opacity - LOG_ALPHA_MIN)
        half_x, half_y = math.sqrt(reach * xx), math.sqrt(reach * yy)
        fits = half_x <= WIDEST and half_y <= WIDEST and abs(x) < 1e30 and abs(y) < 1e30
        if not (fits and length > SHORTEST_QUATERNION and length < math.inf):
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
        row[2], row[3], row[4], row[5] = -0.5 * scale * yy, scale * xy, -0.5 * scale * xx, log_opacity * LOG2_E
        drawn += 1
        entries += ((last_x >> SHIFT) - (first_x >> SHIFT) + 1) * ((last_y >> SHIFT) - (first_y >> SHIFT) + 1)
    return drawn, entries


@kernel
def project_splats(stage: Stage, lens: Lens, cloud: Cloud, out: Ellipses) -> None:
    """Project the splats of a stage."""
    begin(stage)
    first = claim(stage)
    while first < stage.size:
        drawn, entries = project_range(first, end_of(stage, first), lens, cloud, out)
        fetch_add(out.totals, DRAWN, drawn)
        fetch_add(out.totals, ENTRIES, entries)
        first = claim(stage)
    meet(stage)
