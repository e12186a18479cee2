"""Structural similarity and its derivative, one colour plane per job, rows in a ring of eleven.

With window averages m (11 x 11 Gaussian, sigma 1.5, applied as rows then columns; pictures continued by reflection)

    S = (2 m_x m_y + c1)(2 s_xy + c2) / ((m_x^2 + m_y^2 + c1)(s_xx + s_yy + c2)),   s_ab = m(ab) - m_a m_b

The forward pass also keeps dS/dm_x, dS/dm(xx), dS/dm(xy). The gradient of sum(g S) with respect to x is then
M'(g dS/dm_x) + 2 x M'(g dS/dm(xx)) + y M'(g dS/dm(xy)), where M' is the transposed average: the same window over a
picture continued by zeros, its outer margin folded back to where the reflection had taken it from.
"""

from __future__ import annotations

import numpy as np

from genmojo_core.kernels.cache import inlined, kernel
from genmojo_core.kernels.simd import fma, load8, splat8, store8
from genmojo_core.kernels.threads import run_jobs

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
    out = np.empty_like(prediction)
    slopes = np.empty((count * channels, 3, height, -(-width // LANES) * LANES), np.float32)

    def job(index: int) -> None:
        b, c = divmod(index, channels)
        similarity_plane((prediction[b], target[b], out[b]), c, WINDOW, slopes[index].reshape(-1))

    run_jobs(job, count * channels)
    return out, slopes


def ssim_backward(
    prediction: np.ndarray, target: np.ndarray, slopes: np.ndarray, upstream: np.ndarray
) -> np.ndarray:  # fmt: skip
    """Gradient (B, H, W, C) of sum(upstream * map) with respect to the prediction."""
    channels = prediction.shape[3]
    out = np.empty_like(prediction)

    def job(index: int) -> None:
        b, c = divmod(index, channels)
        gradient_plane((prediction[b], target[b], upstream[b], out[b]), c, WINDOW, slopes[index].reshape(-1))

    run_jobs(job, prediction.shape[0] * channels)
    return out


@inlined
def reflected(i: int, size: int) -> int:
    """Index inside 0..size-1 of a position outside, mirrored about the first and last pixel as often as needed."""
    if size == 1:
        return 0
    period = 2 * (size - 1)
    i = abs(i) % period
    return min(i, period - i)


@inlined
def blur_row(line: np.ndarray, at: int, window: np.ndarray) -> object:
    """Average (Float8) of `line` over the window that starts at `at`, for eight neighbouring starts."""
    total = load8(line, at) * window[0]
    for k in range(1, TAPS):
        total = fma(window[k], load8(line, at + k), total)
    return total


@inlined
def blur_products(lines: tuple, at: int, window: np.ndarray, ring: np.ndarray, place: tuple) -> None:
    """Row averages of x, y, xx, yy, xy at eight pixels, written to the ring's five fields."""
    zero = splat8(np.float32(0))
    x0, y0, xx, yy, xy = zero, zero, zero, zero, zero
    for k in range(TAPS):
        x, y, w = load8(lines[0], at + k), load8(lines[1], at + k), window[k]
        wx, wy = x * w, y * w
        x0, y0 = x0 + wx, y0 + wy
        xx, yy, xy = fma(wx, x, xx), fma(wy, y, yy), fma(wx, y, xy)
    first, step = place
    store8(ring, first, x0)
    store8(ring, first + step, y0)
    store8(ring, first + 2 * step, xx)
    store8(ring, first + 3 * step, yy)
    store8(ring, first + 4 * step, xy)


@inlined
def blur_column(ring: np.ndarray, row: int, at: int, step: int, window: np.ndarray) -> object:
    """Average (Float8) down the ring's eleven rows, the oldest being `row`, of the field whose pixels start at `at`."""
    total = splat8(np.float32(0))
    for k in range(TAPS):
        total = fma(window[k], load8(ring, at + ((row + k) % TAPS) * step), total)
    return total


@inlined
def similarity(ring: np.ndarray, row: int, at: int, step: tuple, window: np.ndarray) -> tuple:
    """S and its three derivatives (Float8) at eight pixels."""
    field, line = step
    mx, my = blur_column(ring, row, at, line, window), blur_column(ring, row, at + field, line, window)
    sxx = blur_column(ring, row, at + 2 * field, line, window) - mx * mx
    syy = blur_column(ring, row, at + 3 * field, line, window) - my * my
    sxy = blur_column(ring, row, at + 4 * field, line, window) - mx * my
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
def similarity_plane(pictures: tuple, channel: int, window: np.ndarray, slopes: np.ndarray) -> None:
    """One colour plane: pictures = prediction, target, out, each (H, W, C); slopes (3 * H * W rounded up to 8,)."""
    prediction, target, out = pictures
    height, width = prediction.shape[0], prediction.shape[1]
    wide = -(-width // LANES) * LANES
    x, y, s_row = (
        np.zeros(wide + 2 * LANES, np.float32),
        np.zeros(wide + 2 * LANES, np.float32),
        np.empty(wide, np.float32),
    )
    ring = np.empty(FIELDS * TAPS * wide, np.float32)
    plane = height * wide
    for row in range(-RADIUS, height + RADIUS):
        source = reflected(row, height)
        for i in range(width + 2 * RADIUS):
            column = reflected(i - RADIUS, width)
            x[i], y[i] = prediction[source, column, channel], target[source, column, channel]
        slot = (row + RADIUS) % TAPS
        for at in range(0, wide, LANES):
            blur_products((x, y), at, window, ring, (slot * wide + at, TAPS * wide))
        done = row - RADIUS
        if done < 0:
            continue
        for at in range(0, wide, LANES):
            s, mean, xx, xy = similarity(ring, done % TAPS, at, (TAPS * wide, wide), window)
            store8(s_row, at, s)
            place = done * wide + at
            store8(slopes, place, mean)
            store8(slopes, plane + place, xx)
            store8(slopes, 2 * plane + place, xy)
        for i in range(width):
            out[done, i, channel] = s_row[i]


@inlined
def fold(line: np.ndarray, width: int) -> None:
    """Add what lies on the margins of a row (RADIUS pixels each side, then the row) to its reflected places."""
    for i in range(RADIUS):
        line[RADIUS + reflected(i - RADIUS, width)] += line[i]
        line[RADIUS + reflected(width + i, width)] += line[RADIUS + width + i]


@kernel
def gradient_plane(pictures: tuple, channel: int, window: np.ndarray, slopes: np.ndarray) -> None:
    """One colour plane: pictures = prediction, target, upstream, out, each (H, W, C); slopes as kept by forward."""
    prediction, target, upstream, out = pictures
    height, width = prediction.shape[0], prediction.shape[1]
    wide = -(-width // LANES) * LANES
    long = -(-(width + 2 * RADIUS) // LANES) * LANES  # a row with both margins
    line = np.zeros(long + 3 * LANES, np.float32)
    ring = np.zeros(3 * TAPS * long, np.float32)
    folded = np.empty(long, np.float32)
    for row in range(height):
        for i in range(width):
            out[row, i, channel] = 0
    for row in range(-RADIUS, height + RADIUS):
        newest = row + RADIUS  # the row of the picture that enters the window now
        for f in range(3):
            at = (f * TAPS + newest % TAPS) * long
            if newest >= height:
                for i in range(long):
                    ring[at + i] = 0
                continue
            for i in range(width):
                line[2 * RADIUS + i] = upstream[newest, i, channel] * slopes[(f * height + newest) * wide + i]
            for i in range(0, long, LANES):
                store8(ring, at + i, blur_row(line, i, window))
        target_row = reflected(row, height)
        for f in range(3):
            for i in range(0, long, LANES):
                store8(folded, i, blur_column(ring, (newest + 1) % TAPS, f * TAPS * long + i, long, window))
            fold(folded, width)
            for i in range(width):
                factor = np.float32(1)
                if f == 1:
                    factor = np.float32(2) * prediction[target_row, i, channel]
                elif f == 2:
                    factor = target[target_row, i, channel]
                out[target_row, i, channel] += factor * folded[RADIUS + i]
