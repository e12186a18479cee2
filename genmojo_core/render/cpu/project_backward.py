"""From the pixel sums of one splat back to its mean, quaternion, scales, opacity, channels, and to the camera.

With the moments M of v (backward.py), dx = pixel - centre and the conic (a, b, c):

    dL/dcentre = (a M_x + b M_y, b M_x + c M_y)
    dL/dSigma = conic (1/2 [[M_xx, M_xy], [M_xy, M_yy]]) conic
    dL/dopacity = M_1 / opacity
    dL/dP = 2 dL/dSigma P,  and P = J W R diag(s) is taken apart row by row (project.py).

Where u or v was clamped, the Jacobian gives no gradient to the position; the centre always does.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from genmojo_core.kernels.cache import inlined, kernel
from genmojo_core.render.cpu.bins import Bins
from genmojo_core.render.cpu.project import Cloud, Lens, camera_point, footprint

MOMENTS = 6


class Gradients(NamedTuple):
    """Gradients of a scalar with respect to everything the rasteriser took in. N splats."""

    means: np.ndarray  # (N, 3) float32
    quats: np.ndarray  # (N, 4) float32
    scales: np.ndarray  # (N, 3) float32
    opacities: np.ndarray  # (N,) float32
    channels: np.ndarray  # (N, slots) float32; slot 0 (depth) already went to the means and stays 0
    pose: np.ndarray  # (jobs, 3, 4) float64: partial sums for world_to_camera's upper three rows


class Sums(NamedTuple):
    """Gradient rows of one view's entries, by slot."""

    rows: np.ndarray  # (E * row,) float32
    row: int
    hits: np.ndarray  # (E,) uint32; rows of entries without hits were never written


@inlined
def add_rows(sums: Sums, first: int, last: int, total: np.ndarray) -> bool:
    """Sum the rows of slots first..last-1 into total (row,) float64; False where none was hit."""
    total[:] = 0
    hit = False
    for slot in range(first, last):
        if sums.hits[slot] != 0:
            hit = True
            for k in range(sums.row):
                total[k] += sums.rows[slot * sums.row + k]
    return hit


@inlined
def shape_gradient(total: np.ndarray, sigma: tuple) -> tuple:
    """Moments to dL/dcentre (x, y) and the symmetric dL/dSigma (xx, xy, yy)."""
    xx, xy, yy, det = sigma
    a, b, c = yy / det, -xy / det, xx / det
    mx, my, mxx, mxy, myy = total[1], total[2], 0.5 * total[3], 0.5 * total[4], 0.5 * total[5]
    # conic M conic, written out
    p, q = a * mxx + b * mxy, a * mxy + b * myy
    r, s = b * mxx + c * mxy, b * mxy + c * myy
    return (a * mx + b * my, b * mx + c * my), (p * a + q * b, p * b + q * c, r * b + s * c)


@inlined
def write_quaternion(out: np.ndarray, i: int, quaternion: tuple, g: tuple) -> None:
    """Gradient of the rotation matrix, g[row][column], to the quaternion before it was normalised."""
    inverse, (w, x, y, z) = quaternion
    gw = 2 * (x * (g[2][1] - g[1][2]) + y * (g[0][2] - g[2][0]) + z * (g[1][0] - g[0][1]))
    gx = 2 * (w * (g[2][1] - g[1][2]) + y * (g[0][1] + g[1][0]) + z * (g[0][2] + g[2][0])
              - 2 * x * (g[1][1] + g[2][2]))  # fmt: skip
    gy = 2 * (w * (g[0][2] - g[2][0]) + x * (g[0][1] + g[1][0]) + z * (g[1][2] + g[2][1])
              - 2 * y * (g[0][0] + g[2][2]))  # fmt: skip
    gz = 2 * (w * (g[1][0] - g[0][1]) + x * (g[0][2] + g[2][0]) + y * (g[1][2] + g[2][1])
              - 2 * z * (g[0][0] + g[1][1]))  # fmt: skip
    along = w * gw + x * gx + y * gy + z * gz
    out[i, 0], out[i, 1] = (gw - w * along) * inverse, (gx - x * along) * inverse
    out[i, 2], out[i, 3] = (gy - y * along) * inverse, (gz - z * along) * inverse


@inlined
def splat_gradient(lens: Lens, cloud: Cloud, i: int, total: np.ndarray, out: Gradients, job: int) -> None:
    """All gradients of splat i from its summed row."""
    point = camera_point(lens, cloud.means, i)
    quaternion, (u0, v0, u, v), (vx, vy, vz), (px, py), sigma = footprint(lens, cloud, i, point)
    centre, (hxx, hxy, hyy) = shape_gradient(total, sigma)
    z = point[2]
    jx, jy = lens.focal[0] / z, lens.focal[1] / z
    gz, gu, gv = total[MOMENTS], lens.focal[0] * centre[0], lens.focal[1] * centre[1]
    gm = np.empty((3, 3))  # gradient of V = W R
    for k in range(3):
        s = float(cloud.scales[i, k])
        gpx, gpy = 2 * (hxx * px[k] + hxy * py[k]), 2 * (hxy * px[k] + hyy * py[k])
        qx, qy = jx * (vx[k] - u * vz[k]), jy * (vy[k] - v * vz[k])
        out.scales[i, k] = gpx * qx + gpy * qy
        gm[0, k], gm[1, k] = gpx * jx * s, gpy * jy * s
        gm[2, k] = -u * gm[0, k] - v * gm[1, k]
        gz -= (gpx * px[k] + gpy * py[k]) / z
        if u == u0:
            gu -= gm[0, k] * vz[k]
        if v == v0:
            gv -= gm[1, k] * vz[k]
    gt = (gu / z, gv / z, gz - (gu * u0 + gv * v0) / z)
    w = lens.rotation
    for k in range(3):
        out.means[i, k] = w[0, k] * gt[0] + w[1, k] * gt[1] + w[2, k] * gt[2]
    write_pose(out.pose[job], w, gt, gm, (cloud.means[i], (vx, vy, vz)))
    rotation = (
        (w[0, 0] * gm[0, 0] + w[1, 0] * gm[1, 0] + w[2, 0] * gm[2, 0],
         w[0, 0] * gm[0, 1] + w[1, 0] * gm[1, 1] + w[2, 0] * gm[2, 1],
         w[0, 0] * gm[0, 2] + w[1, 0] * gm[1, 2] + w[2, 0] * gm[2, 2]),
        (w[0, 1] * gm[0, 0] + w[1, 1] * gm[1, 0] + w[2, 1] * gm[2, 0],
         w[0, 1] * gm[0, 1] + w[1, 1] * gm[1, 1] + w[2, 1] * gm[2, 1],
         w[0, 1] * gm[0, 2] + w[1, 1] * gm[1, 2] + w[2, 1] * gm[2, 2]),
        (w[0, 2] * gm[0, 0] + w[1, 2] * gm[1, 0] + w[2, 2] * gm[2, 0],
         w[0, 2] * gm[0, 1] + w[1, 2] * gm[1, 1] + w[2, 2] * gm[2, 1],
         w[0, 2] * gm[0, 2] + w[1, 2] * gm[1, 2] + w[2, 2] * gm[2, 2]),
    )  # fmt: skip
    write_quaternion(out.quats, i, quaternion, rotation)


@inlined
def write_pose(out: np.ndarray, w: np.ndarray, gt: tuple, gm: np.ndarray, splat: tuple) -> None:
    """Add one splat's part to the pose gradient (3, 4): dL/dW = gt x' + gV R', dL/dt0 = gt.

    R = W' V, so (gV R')_ij = sum_k gV_ik (W' V)_jk.
    """
    mean, v = splat
    for j in range(3):
        for k in range(3):
            r = w[0, j] * v[0][k] + w[1, j] * v[1][k] + w[2, j] * v[2][k]
            for i in range(3):
                out[i, j] += gm[i, k] * r
        for i in range(3):
            out[i, j] += gt[i] * mean[j]
    for i in range(3):
        out[i, 3] += gt[i]


@kernel
def gather_gradients(job: int, span: tuple, bins: Bins, scene: tuple, sums: Sums, out: Gradients) -> None:
    """Gradients of the splats at ranks span[0]..span[1]-1; scene = (lens, cloud). `out` is zero on entry."""
    lens, cloud = scene
    total = np.empty(sums.row)
    for rank in range(span[0], span[1]):
        if not add_rows(sums, bins.first_slot[rank], bins.first_slot[rank + 1], total):
            continue
        i = bins.order[rank]
        out.opacities[i] = total[0] / float(cloud.opacities[i])
        for k in range(1, out.channels.shape[1]):
            out.channels[i, k] = total[MOMENTS + k]
        splat_gradient(lens, cloud, i, total, out, job)
