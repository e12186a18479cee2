"""Structural similarity and its derivative, one colour plane per job, rows in a ring of eleven.

With window averages m (11 x 11 Gaussian, sigma 1.5, applied as rows then columns; pictures continued by reflection)

    S = (2 m_x m_y + c1)(2 s_xy + c2) / ((m_x^2 + m_y^2 + c1)(s_xx + s_yy + c2)),   s_ab = m(ab) - m_a m_b

The forward pass also keeps dS/dm_x, dS/dm(xx), dS/dm(xy). The gradient of sum(g S) with respect to x is then
M'(g dS/dm_x) + 2 x M'(g dS/dm(xx)) + y M'(g dS/dm(xy)), where M' is the transposed average: the same window over a
picture continued by zeros, its outer margin folded back to where the reflection had taken it from.
"""

from __future__ import annotations

import numpy as np

from genmojo_core.kernels.buffers import take
from genmojo_core.kernels.cache import inlined, kernel
from genmojo_core.kernels.scalars import smaller
from genmojo_core.kernels.simd import fma, load8, splat8, store8
from genmojo_core.kernels.threads import run_jobs, scratch

RADIUS = 5
TAPS = 2 * RADIUS + 1
LANES = 8
C1 = np.float32(0.01**2)
C2 = np.float32(0.03**2)
FIELDS = 5  # x, y, xx, yy, xy
_shape = np.exp(-0.5 * (np.arange(-RADIUS, RADIUS + 1) / 1.5) ** 2)
WINDOW = (_shape / _shape.sum()).astype(np.float32)  # (11,)


def ssim_forward(prediction: np.ndarray, target: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Map (B, H, W, C) of two contiguous float32 pictures in 0..1, and its derivatives (B, C, 3, H, W rounded up)."""
    count, height, width, channels = prediction.shape
    out = take(prediction.shape)
    slopes = take((count * channels, 3, height, -(-width // LANES) * LANES))

    def job(index: int) -> None:
        b, c = divmod(index, channels)
        own = scratch(similarity_floats(width))
        similarity_plane((prediction[b], target[b], out[b]), c, WINDOW, slopes[index].reshape(-1), own)

    run_jobs(job, count * channels)
    return out, slopes


def ssim_backward(
    prediction: np.ndarray, target: np.ndarray, slopes: np.ndarray, upstream: np.ndarray
) -> np.ndarray:  # fmt: skip
    """Gradient (B, H, W, C) of sum(upstream * map) with respect to the prediction."""
    channels = prediction.shape[3]
    out = take(prediction.shape)

    def job(index: int) -> None:
        b, c = divmod(index, channels)
        pictures = (prediction[b], target[b], upstream[b], out[b])
        gradient_plane(pictures, c, WINDOW, slopes[index].reshape(-1), scratch(gradient_floats(prediction.shape[2])))

    run_jobs(job, prediction.shape[0] * channels)
    return out


def similarity_floats(width: int) -> int:
    """Size of the scratch of `similarity_plane`."""
    wide = -(-width // LANES) * LANES
    return 3 * wide + 4 * LANES + FIELDS * TAPS * wide


def gradient_floats(width: int) -> int:
    """Size of the scratch of `gradient_plane`."""
    return (2 + 3 * TAPS) * (-(-(width + 2 * RADIUS) // LANES) * LANES) + 3 * LANES


@inlined
def reflected(i: int, size: int) -> int:
    """Index inside 0..size-1 of a position outside, mirrored about the first and last pixel as often as needed."""
    if size == 1:
        return 0
    period = 2 * (size - 1)
    i = abs(i) % period
    return smaller(i, period - i)


@inlined
def blur_row(scratch: np.ndarray, at: int, window: np.ndarray) -> object:
    """Average (Float8) of a row over the window that starts at `at`, for eight neighbouring starts."""
    total = load8(scratch, at) * window[0]
    for k in range(1, TAPS):
        total = fma(window[k], load8(scratch, at + k), total)
    return total


@inlined
def blur_products(scratch: np.ndarray, lines: tuple, window: np.ndarray, place: tuple) -> None:
    """Row averages of x, y, xx, yy, xy at eight pixels, written to the ring's five fields; lines = starts of x, y."""
    zero = splat8(np.float32(0))
    x0, y0, xx, yy, xy = zero, zero, zero, zero, zero
    for k in range(TAPS):
        x, y, w = load8(scratch, lines[0] + k), load8(scratch, lines[1] + k), window[k]
        wx, wy = x * w, y * w
        x0, y0 = x0 + wx, y0 + wy
        xx, yy, xy = fma(wx, x, xx), fma(wy, y, yy), fma(wx, y, xy)
    first, step = place
    store8(scratch, first, x0)
    store8(scratch, first + step, y0)
    store8(scratch, first + 2 * step, xx)
    store8(scratch, first + 3 * step, yy)
    store8(scratch, first + 4 * step, xy)


@inlined
def blur_column(scratch: np.ndarray, row: int, at: int, step: int, window: np.ndarray) -> object:
    """Average (Float8) down the ring's eleven rows, the oldest being `row`, of the field whose pixels start at `at`."""
    total = splat8(np.float32(0))
    for k in range(TAPS):
        total = fma(window[k], load8(scratch, at + ((row + k) % TAPS) * step), total)
    return total


@inlined
def similarity(scratch: np.ndarray, row: int, at: int, step: tuple, window: np.ndarray) -> tuple:
    """S and its three derivatives (Float8) at eight pixels."""
    field, line = step
    mx, my = blur_column(scratch, row, at, line, window), blur_column(scratch, row, at + field, line, window)
    sxx = blur_column(scratch, row, at + 2 * field, line, window) - mx * mx
    syy = blur_column(scratch, row, at + 3 * field, line, window) - my * my
    sxy = blur_column(scratch, row, at + 4 * field, line, window) - mx * my
    two, one = np.float32(2), np.float32(1)
    a1, a2 = fma(two, mx * my, C1), fma(two, sxy, C2)
    b1, b2 = mx * mx + my * my + C1, sxx + syy + C2
    inverse1, inverse2 = one / b1, one / b2
    both = inverse1 * inverse2
    s = a1 * a2 * both
    slope_xx = np.float32(-1) * s * inverse2
    slope_mean = two * my * both * (a2 - a1) - two * mx * s * (inverse1 - inverse2)
    return s, slope_mean, slope_xx, two * a1 * both


@kernel
def similarity_plane(
    pictures: tuple, channel: int, window: np.ndarray, slopes: np.ndarray, scratch: np.ndarray
) -> None:  # fmt: skip
    """One colour plane: pictures = prediction, target, out, each (H, W, C); slopes (3 * H * W rounded up to 8,).

    scratch: `similarity_floats(W)` float32 of any content: a row of x, of y, of S, then the ring.
    """
    prediction, target, out = pictures
    height, width = prediction.shape[0], prediction.shape[1]
    wide = -(-width // LANES) * LANES
    row_y, row_s = wide + 2 * LANES, 2 * (wide + 2 * LANES)
    ring, plane = row_s + wide, height * wide
    for i in range(0, ring, LANES):
        store8(scratch, i, splat8(np.float32(0)))
    for row in range(-RADIUS, height + RADIUS):
        source = reflected(row, height)
        for i in range(width + 2 * RADIUS):
            column = reflected(i - RADIUS, width)
            scratch[i] = prediction[source, column, channel]
            scratch[row_y + i] = target[source, column, channel]
        slot = (row + RADIUS) % TAPS
        for at in range(0, wide, LANES):
            blur_products(scratch, (at, row_y + at), window, (ring + slot * wide + at, TAPS * wide))
        done = row - RADIUS
        if done < 0:
            continue
        for at in range(0, wide, LANES):
            s, mean, xx, xy = similarity(scratch, done % TAPS, ring + at, (TAPS * wide, wide), window)
            store8(scratch, row_s + at, s)
            place = done * wide + at
            store8(slopes, place, mean)
            store8(slopes, plane + place, xx)
            store8(slopes, 2 * plane + place, xy)
        for i in range(width):
            out[done, i, channel] = scratch[row_s + i]


@inlined
def fold(scratch: np.ndarray, first: int, width: int) -> None:
    """Add what lies on the margins of a row (RADIUS pixels each side, then the row) to its reflected places."""
    row = first + RADIUS
    for i in range(RADIUS):
        scratch[row + reflected(i - RADIUS, width)] += scratch[first + i]
        scratch[row + reflected(width + i, width)] += scratch[row + width + i]


@kernel
def gradient_plane(
    pictures: tuple, channel: int, window: np.ndarray, slopes: np.ndarray, scratch: np.ndarray
) -> None:  # fmt: skip
    """One colour plane: pictures = prediction, target, upstream, out, each (H, W, C); slopes as kept by forward.

    scratch: `gradient_floats(W)` float32 of any content: a row, its folded average, then the ring.
    """
    prediction, target, upstream, out = pictures
    height, width = prediction.shape[0], prediction.shape[1]
    wide = -(-width // LANES) * LANES
    long = -(-(width + 2 * RADIUS) // LANES) * LANES  # a row with both margins
    folded = long + 3 * LANES
    ring = folded + long
    for i in range(0, ring + 3 * TAPS * long, LANES):
        store8(scratch, i, splat8(np.float32(0)))
    for row in range(height):
        for i in range(width):
            out[row, i, channel] = 0
    for row in range(-RADIUS, height + RADIUS):
        newest = row + RADIUS  # the row of the picture that enters the window now
        source = reflected(row, height)
        for f in range(3):
            at = ring + (f * TAPS + newest % TAPS) * long
            for i in range(width if newest < height else 0):
                scratch[2 * RADIUS + i] = upstream[newest, i, channel] * slopes[(f * height + newest) * wide + i]
            for i in range(0, long, LANES):
                store8(scratch, at + i, blur_row(scratch, i, window) if newest < height else splat8(np.float32(0)))
            for i in range(0, long, LANES):
                average = blur_column(scratch, (newest + 1) % TAPS, ring + f * TAPS * long + i, long, window)
                store8(scratch, folded + i, average)
            fold(scratch, folded, width)
            add_row((prediction, target, out), (source, channel, f), scratch, folded + RADIUS)


@inlined
def add_row(pictures: tuple, place: tuple, scratch: np.ndarray, first: int) -> None:
    """Add one field's part of a row of the gradient: times 1, 2 x or y."""
    prediction, target, out = pictures
    row, channel, f = place
    for i in range(prediction.shape[1]):
        factor = np.float32(1)
        if f == 1:
            factor = np.float32(2) * prediction[row, i, channel]
        elif f == 2:
            factor = target[row, i, channel]
        out[row, i, channel] += factor * scratch[first + i]
