"""From the pixel sums of each splat back to its mean, quaternion, scales, opacity, channels, and to the camera.

With the moments M of v (backward.py), dx = pixel - centre and the conic (a, b, c):

    dL/dcentre = (a M_x + b M_y, b M_x + c M_y)
    dL/dSigma = conic (1/2 [[M_xx, M_xy], [M_xy, M_yy]]) conic
    dL/dopacity = M_1 / opacity
    dL/dP = 2 dL/dSigma P,  and P = J W R diag(s) is taken apart row by row (project.py).

Where u or v was clamped, the Jacobian gives no gradient to the position; the centre always does. Eight splats are done
at once, one per lane: their numbers are collected into rows of eight, and the results handed out again.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from genmojo_core.kernels.cache import inlined
from genmojo_core.kernels.scalars import larger, smaller
from genmojo_core.kernels.simd import fma, load8, prefetch, select8, splat8, store8, store_rows
from genmojo_core.kernels.stage import Stage, begin, claim, end_of, meet
from genmojo_core.render.cpu.bins import Bins
from genmojo_core.render.cpu.project import Cloud, Lens

LANES = 8
MOMENTS = 6
AHEAD = 8  # splats
# Rows of eight lanes in a group's scratch.
MEAN, QUAT, SCALE, SUMS = 0, 3, 7, 10  # 3, 4 (unit), 3 and 7 rows of input
ALONG, POSE = 17, 28  # results: mean 3, quaternion 4 (before the normalisation), scales 3, spare; then pose 12
TOTAL = 40 * LANES  # a splat's summed row, up to 24 floats
PLACES = TOTAL + 24  # the splat in each lane, counted from the job's first
INVERSES = PLACES + LANES  # 1 / length of its quaternion
SCRATCH = INVERSES + LANES


class Gradients(NamedTuple):
    """Gradients of a scalar with respect to everything the rasteriser took in; kernels add to them. N splats."""

    means: np.ndarray  # (N, 3) float32
    quats: np.ndarray  # (N, 4) float32
    scales: np.ndarray  # (N, 3) float32
    opacities: np.ndarray  # (N,) float32
    features: np.ndarray  # (N, C) float32
    pose: np.ndarray  # (jobs, 12) float64: partial sums for world_to_camera's upper three rows; (0, 12): not wanted


class Sums(NamedTuple):
    """Gradient rows of one pass's entries, by slot."""

    rows: np.ndarray  # (E * row,) float32
    row: int
    hits: np.ndarray  # (E,) uint32 by entry; rows of entries without hits were never written
    columns: np.ndarray  # (slots,) int64: the feature each channel slot belongs to, -1 for none


@inlined
def add_rows(sums: Sums, bins: Bins, rank: int, scratch: np.ndarray) -> bool:
    """Sum the rows of a splat into the scratch's TOTAL; False where none was hit."""
    hit = False
    for slot in range(bins.first_slot[rank], bins.first_slot[rank + 1]):
        if sums.hits[bins.entry[slot]] == 0:
            continue
        for k in range(0, sums.row, LANES):
            value = load8(sums.rows, slot * sums.row + k)
            if hit:
                value = value + load8(scratch, TOTAL + k)
            store8(scratch, TOTAL + k, value)
        hit = True
    return hit


@inlined
def collect(scratch: np.ndarray, lane: int, cloud: Cloud, i: int, inverse: float) -> None:
    """Write splat i's numbers and its total into one lane; a lane without a splat (i < 0) computes harmlessly."""
    for k in range(3):
        scratch[(MEAN + k) * LANES + lane] = cloud.means[i, k]
        scratch[(SCALE + k) * LANES + lane] = cloud.scales[i, k]
    for k in range(4):
        scratch[(QUAT + k) * LANES + lane] = cloud.quats[i, k] * inverse
    for k in range(MOMENTS + 1):
        scratch[(SUMS + k) * LANES + lane] = scratch[TOTAL + k]


@inlined
def row(scratch: np.ndarray, index: int) -> object:
    """One row (Float8) of the scratch."""
    return load8(scratch, index * LANES)


@inlined
def dot3(a: tuple, b: tuple) -> object:
    """Sum of three products."""
    return fma(a[0], b[0], fma(a[1], b[1], a[2] * b[2]))


@inlined
def matrix(scratch: np.ndarray) -> tuple:
    """Rows of R from the unit quaternions."""
    w, x, y, z = row(scratch, QUAT), row(scratch, QUAT + 1), row(scratch, QUAT + 2), row(scratch, QUAT + 3)
    x2, y2, z2 = x + x, y + y, z + z
    one = splat8(np.float32(1))
    return (
        (one - y * y2 - z * z2, x * y2 - w * z2, x * z2 + w * y2),
        (x * y2 + w * z2, one - x * x2 - z * z2, y * z2 - w * x2),
        (x * z2 - w * y2, y * z2 + w * x2, one - x * x2 - y * y2),
    )


@inlined
def turned(w: tuple, m: tuple) -> tuple:
    """One row of V = W R: the row w of W times the rows m of R."""
    return (
        fma(m[0][0], w[0], fma(m[1][0], w[1], m[2][0] * w[2])),
        fma(m[0][1], w[0], fma(m[1][1], w[1], m[2][1] * w[2])),
        fma(m[0][2], w[0], fma(m[1][2], w[1], m[2][2] * w[2])),
    )


@inlined
def shape_slopes(scratch: np.ndarray, px: tuple, py: tuple, dilation: float) -> tuple:
    """dL/dcentre (x, y) and twice the symmetric dL/dSigma (xx, xy, yy)."""
    xx, xy, yy = dot3(px, px), dot3(px, py), dot3(py, py)
    m0, m1, m2 = px[0] * py[1] - px[1] * py[0], px[0] * py[2] - px[2] * py[0], px[1] * py[2] - px[2] * py[1]
    d = np.float32(dilation)
    det = fma(m0, m0, fma(m1, m1, m2 * m2)) + (xx + yy) * d + d * d
    scale = np.float32(1) / det
    a, b, c = (yy + d) * scale, splat8(np.float32(0)) - xy * scale, (xx + d) * scale
    mx, my = row(scratch, SUMS + 1), row(scratch, SUMS + 2)
    mxx, mxy, myy = row(scratch, SUMS + 3), row(scratch, SUMS + 4), row(scratch, SUMS + 5)
    p, q = a * mxx + b * mxy, a * mxy + b * myy
    r, s = b * mxx + c * mxy, b * mxy + c * myy
    return (a * mx + b * my, b * mx + c * my), (p * a + q * b, p * b + q * c, r * b + s * c)


@inlined
def position_slopes(lens: Lens, point: tuple, uv: tuple, vz: tuple, slopes: tuple) -> tuple:
    """dL/dt, the camera coordinates, from dL/dcentre, dL/dV's upper rows and sum gP P."""
    u0, v0, inverse = uv
    centre, gx, gy, depth, stretch = slopes
    gu, gv = centre[0] * lens.focal[0], centre[1] * lens.focal[1]
    zero = splat8(np.float32(0))
    free_u = (u0 >= lens.limits[0]) & (u0 <= lens.limits[1])
    free_v = (v0 >= lens.limits[2]) & (v0 <= lens.limits[3])
    gu = (gu - select8(free_u, dot3(gx, vz), zero)) * inverse
    gv = (gv - select8(free_v, dot3(gy, vz), zero)) * inverse
    return gu, gv, depth - stretch * inverse - gu * u0 - gv * v0


@inlined
def quaternion_slopes(scratch: np.ndarray, g: tuple) -> None:
    """Rows ALONG + 3..6: gradient of R (its columns g) to the unit quaternion, without the part along it."""
    w, x, y, z = row(scratch, QUAT), row(scratch, QUAT + 1), row(scratch, QUAT + 2), row(scratch, QUAT + 3)
    a, b, c = g[1][2] - g[2][1], g[2][0] - g[0][2], g[0][1] - g[1][0]
    d, e, f = g[0][1] + g[1][0], g[0][2] + g[2][0], g[1][2] + g[2][1]
    two = np.float32(2)
    gw = (x * a + y * b + z * c) * two
    gx = (w * a + y * d + z * e - x * (g[1][1] + g[2][2]) * two) * two
    gy = (w * b + x * d + z * f - y * (g[0][0] + g[2][2]) * two) * two
    gz = (w * c + x * e + y * f - z * (g[0][0] + g[1][1]) * two) * two
    along = w * gw + x * gx + y * gy + z * gz
    free = (gw - w * along, gx - x * along, gy - y * along, gz - z * along)
    store_rows(scratch, (ALONG + 3) * LANES, free)


@inlined
def slopes_of_eight(lens: Lens, scratch: np.ndarray) -> None:
    """All geometry gradients of the eight splats of a group, into the rows from ALONG and POSE on."""
    r, t = lens.rotation, lens.translation
    w0, w1, w2 = (r[0, 0], r[0, 1], r[0, 2]), (r[1, 0], r[1, 1], r[1, 2]), (r[2, 0], r[2, 1], r[2, 2])
    mean = (row(scratch, MEAN), row(scratch, MEAN + 1), row(scratch, MEAN + 2))
    m = matrix(scratch)
    vx, vy, vz = turned(w0, m), turned(w1, m), turned(w2, m)
    point = (dot3(mean, w0) + t[0], dot3(mean, w1) + t[1], dot3(mean, w2) + t[2])
    inverse = np.float32(1) / point[2]
    u0, v0 = point[0] * inverse, point[1] * inverse
    u, v = clamped(u0, lens.limits[0], lens.limits[1]), clamped(v0, lens.limits[2], lens.limits[3])
    jx, jy = inverse * lens.focal[0], inverse * lens.focal[1]
    s = (row(scratch, SCALE), row(scratch, SCALE + 1), row(scratch, SCALE + 2))
    qx = (jx * (vx[0] - u * vz[0]), jx * (vx[1] - u * vz[1]), jx * (vx[2] - u * vz[2]))
    qy = (jy * (vy[0] - v * vz[0]), jy * (vy[1] - v * vz[1]), jy * (vy[2] - v * vz[2]))
    px, py = (qx[0] * s[0], qx[1] * s[1], qx[2] * s[2]), (qy[0] * s[0], qy[1] * s[1], qy[2] * s[2])
    centre, h = shape_slopes(scratch, px, py, lens.dilation)
    gpx = (h[0] * px[0] + h[1] * py[0], h[0] * px[1] + h[1] * py[1], h[0] * px[2] + h[1] * py[2])  # dL/dP
    gpy = (h[1] * px[0] + h[2] * py[0], h[1] * px[1] + h[2] * py[1], h[1] * px[2] + h[2] * py[2])
    along = (gpx[0] * qx[0] + gpy[0] * qy[0], gpx[1] * qx[1] + gpy[1] * qy[1], gpx[2] * qx[2] + gpy[2] * qy[2])
    store_rows(scratch, (ALONG + 7) * LANES, along)
    gx = (gpx[0] * jx * s[0], gpx[1] * jx * s[1], gpx[2] * jx * s[2])
    gy = (gpy[0] * jy * s[0], gpy[1] * jy * s[1], gpy[2] * jy * s[2])
    zero = splat8(np.float32(0))
    gz = (zero - u * gx[0] - v * gy[0], zero - u * gx[1] - v * gy[1], zero - u * gx[2] - v * gy[2])
    stretch = dot3(gpx, px) + dot3(gpy, py)
    gt = position_slopes(lens, point, (u0, v0, inverse), vz, (centre, gx, gy, row(scratch, SUMS + 6), stretch))
    store_rows(scratch, ALONG * LANES, back((w0, w1, w2), gt))
    turn_slopes(scratch, (w0, w1, w2), m, (gx, gy, gz), (gt, mean))


@inlined
def clamped(value: Any, low: float, high: float) -> object:
    """Per lane, the nearest value within low..high."""
    return select8(value < low, low, select8(value > high, high, value))


@inlined
def turn_slopes(scratch: np.ndarray, w: tuple, m: tuple, g: tuple, splat: tuple) -> None:
    """From g = dL/dV, V = W R: dL/dR = W' g to the quaternion; pose rows dL/dW = gt mean' + g R', dL/dt0 = gt."""
    columns = (
        back(w, (g[0][0], g[1][0], g[2][0])),
        back(w, (g[0][1], g[1][1], g[2][1])),
        back(w, (g[0][2], g[1][2], g[2][2])),
    )
    quaternion_slopes(scratch, columns)
    gt, mean = splat
    pose_slopes(scratch, POSE, g[0], gt[0], m, mean)
    pose_slopes(scratch, POSE + 4, g[1], gt[1], m, mean)
    pose_slopes(scratch, POSE + 8, g[2], gt[2], m, mean)


@inlined
def pose_slopes(scratch: np.ndarray, first: int, gi: tuple, gti: object, m: tuple, mean: tuple) -> None:
    """One row of the pose's gradient, from row `first` on."""
    turned_row = (
        gti * mean[0] + dot3(gi, m[0]), gti * mean[1] + dot3(gi, m[1]), gti * mean[2] + dot3(gi, m[2]), gti,
    )  # fmt: skip
    store_rows(scratch, first * LANES, turned_row)


@inlined
def back(w: tuple, g: tuple) -> tuple:
    """W' g of a column g."""
    return (
        g[0] * w[0][0] + g[1] * w[1][0] + g[2] * w[2][0],
        g[0] * w[0][1] + g[1] * w[1][1] + g[2] * w[2][1],
        g[0] * w[0][2] + g[1] * w[1][2] + g[2] * w[2][2],
    )


@inlined
def hand_out(scratch: np.ndarray, lane: int, i: int, inverse: float, out: Gradients, job: int) -> None:
    """Add one lane's results to splat i and to the job's pose."""
    for k in range(3):
        out.means[i, k] += scratch[(ALONG + k) * LANES + lane]
        out.scales[i, k] += scratch[(ALONG + 7 + k) * LANES + lane]
    for k in range(4):
        out.quats[i, k] += scratch[(ALONG + 3 + k) * LANES + lane] * inverse
    for k in range(12 if out.pose.shape[0] > 0 else 0):
        out.pose[job, k] += scratch[(POSE + k) * LANES + lane]


@inlined
def gather_gradients(stage: Stage, bins: Bins, scene: tuple, sums: Sums, out: Gradients, scratch: np.ndarray) -> int:
    """Add the gradients of the splats of a stage, a job per piece; scene = (lens, cloud).

    scratch: SCRATCH float32, of any content.
    """
    begin(stage)
    lens, cloud = scene
    first = claim(stage)
    while first < stage.size:
        last, filled = end_of(stage, first) - 1, 0
        for k in range(0, SCRATCH, LANES):
            store8(scratch, k, splat8(np.float32(1)))  # lanes never filled stay harmless
        for i in range(first, last + 1):
            rank = bins.rank_of[i]
            slot = bins.first_slot[larger(bins.rank_of[smaller(i + AHEAD, last)], 0)]
            prefetch(bins.entry, slot)  # entries and rows lie by depth: memory to jump about in
            prefetch(sums.rows, slot * sums.row)
            prefetch(sums.rows, (slot + 1) * sums.row)
            if rank >= 0 and add_rows(sums, bins, rank, scratch):
                out.opacities[i] += scratch[TOTAL] / cloud.opacities[i]
                for k in range(1, sums.columns.size):
                    if sums.columns[k] >= 0:
                        out.features[i, sums.columns[k]] = scratch[TOTAL + MOMENTS + k]
                square = 0.0
                for k in range(4):
                    square += float(cloud.quats[i, k]) * float(cloud.quats[i, k])
                inverse = np.float32(1.0 / math.sqrt(square))
                scratch[PLACES + filled], scratch[INVERSES + filled] = i - first, inverse
                collect(scratch, filled, cloud, i, inverse)
                filled += 1
            if filled == LANES or (i == last and filled > 0):
                slopes_of_eight(lens, scratch)
                for lane in range(filled):
                    at = first + np.int64(scratch[PLACES + lane])
                    hand_out(scratch, lane, at, scratch[INVERSES + lane], out, first // stage.chunk)
                filled = 0
        first = claim(stage)
    return meet(stage)
