"""Bilinear reads of feature planes and their gradients, eight channels at a time (METHOD.md section 4).

All arrays are flat float32 with the channels last and a multiple of eight. A coordinate in -1..1 runs from the first
node to the last; outside, the border holds. Gradients are scattered by jobs that own eight channels each (space) or
eight channels of one time each (lines), so that no two threads write the same number: same bits for any thread count.
"""

from __future__ import annotations

import numpy as np

from genmojo_core.kernels.cache import inlined, kernel
from genmojo_core.kernels.scalars import larger, smaller
from genmojo_core.kernels.simd import fma, load8, store8

LANES = 8


@inlined
def cell(position: float, nodes: int) -> tuple:
    """The two nodes beside a coordinate in -1..1 and the share of the second; not a number counts as -1."""
    x = (position + 1.0) * 0.5 * (nodes - 1)
    x = smaller(x, nodes - 1) if x > 0 else 0.0
    first = smaller(np.int64(x), larger(nodes - 2, 0))
    return first, smaller(first + 1, nodes - 1), np.float32(x - first)


@inlined
def corners(coords: np.ndarray, point: int, plane: int, shape: tuple) -> tuple:
    """Places of the four nodes around a point on plane 0 (x, y), 1 (x, z), 2 (y, z), and the two shares.

    The first coordinate of the pair runs along columns, the second along rows.
    """
    nodes, channels = shape
    across, down = (0 if plane < 2 else 1), (1 if plane == 0 else 2)
    c0, c1, fx = cell(np.float64(coords[point, across]), nodes)
    r0, r1, fy = cell(np.float64(coords[point, down]), nodes)
    upper, lower = (plane * nodes + r0) * nodes, (plane * nodes + r1) * nodes
    return (upper + c0) * channels, (upper + c1) * channels, (lower + c0) * channels, (lower + c1) * channels, fx, fy


@inlined
def read(planes: np.ndarray, at: tuple, channel: int) -> object:
    """Bilinear value (Float8) of eight channels at `corners`."""
    a, b = load8(planes, at[0] + channel), load8(planes, at[2] + channel)
    upper = fma(at[4], load8(planes, at[1] + channel) - a, a)
    lower = fma(at[4], load8(planes, at[3] + channel) - b, b)
    return fma(at[5], lower - upper, upper)


@inlined
def add(out: np.ndarray, place: int, share: float, value: object) -> None:
    """out[place..place+7] += share * value."""
    store8(out, place, fma(share, value, load8(out, place)))


@inlined
def spread(out: np.ndarray, at: tuple, channel: int, value: object) -> None:
    """Add a bilinear read's gradient to its four nodes."""
    fx, fy = at[4], at[5]
    one = np.float32(1)
    add(out, at[0] + channel, (one - fx) * (one - fy), value)
    add(out, at[1] + channel, fx * (one - fy), value)
    add(out, at[2] + channel, (one - fx) * fy, value)
    add(out, at[3] + channel, fx * fy, value)


@kernel
def sample_space(start: int, stop: int, planes: np.ndarray, coords: np.ndarray, shape: tuple, out: np.ndarray) -> None:
    """Product over the three planes for points start..stop-1; shape = (nodes, channels), out (N * channels,)."""
    channels = shape[1]
    for point in range(start, stop):
        p0, p1, p2 = (corners(coords, point, 0, shape), corners(coords, point, 1, shape),
                      corners(coords, point, 2, shape))  # fmt: skip
        for c in range(0, channels, LANES):
            store8(out, point * channels + c, read(planes, p0, c) * read(planes, p1, c) * read(planes, p2, c))


@kernel
def slope_space(
    c: int, planes: np.ndarray, coords: np.ndarray, shape: tuple, upstream: np.ndarray, out: np.ndarray
) -> None:
    """Gradient of `sample_space` for channels c..c+7, added to out (flat, like planes)."""
    channels = shape[1]
    for point in range(coords.shape[0]):
        p0, p1, p2 = (corners(coords, point, 0, shape), corners(coords, point, 1, shape),
                      corners(coords, point, 2, shape))  # fmt: skip
        a, b, d = read(planes, p0, c), read(planes, p1, c), read(planes, p2, c)
        g = load8(upstream, point * channels + c)
        ga = g * a
        spread(out, p0, c, g * b * d)
        spread(out, p1, c, ga * d)
        spread(out, p2, c, ga * b)


@kernel
def lines_of(planes: np.ndarray, time: float, shape: tuple, out: np.ndarray) -> None:
    """Space-time planes (3, nodes, times, channels) at one time: out (3 * nodes * channels,)."""
    nodes, times, channels = shape
    t0, t1, share = cell(time, times)
    for row in range(3 * nodes):
        for c in range(0, channels, LANES):
            a = load8(planes, (row * times + t0) * channels + c)
            b = load8(planes, (row * times + t1) * channels + c)
            store8(out, row * channels + c, fma(share, b - a, a))


@kernel
def slope_lines(time: float, shape: tuple, lines: np.ndarray, out: np.ndarray) -> None:
    """Gradient of `lines_of`: lines' gradient (3 * nodes * channels,) added to out (flat, like planes)."""
    nodes, times, channels = shape
    t0, t1, share = cell(time, times)
    for row in range(3 * nodes):
        for c in range(0, channels, LANES):
            g = load8(lines, row * channels + c)
            add(out, (row * times + t0) * channels + c, np.float32(1) - share, g)
            add(out, (row * times + t1) * channels + c, share, g)


@inlined
def ends(coords: np.ndarray, point: int, axis: int, nodes: int, channels: int) -> tuple:
    """Places of the two nodes of line `axis` beside a point, and the share of the second."""
    first, second, share = cell(np.float64(coords[point, axis]), nodes)
    return (axis * nodes + first) * channels, (axis * nodes + second) * channels, share


@inlined
def read_line(lines: np.ndarray, at: tuple, c: int) -> object:
    """Linear value (Float8) of eight channels between `ends`."""
    a = load8(lines, at[0] + c)
    return fma(at[2], load8(lines, at[1] + c) - a, a)


@kernel
def sample_lines(lines: np.ndarray, coords: np.ndarray, shape: tuple, out: np.ndarray) -> None:
    """Product over the three lines of one time; lines (3 * nodes * channels,), out (N * channels,)."""
    nodes, _, channels = shape
    for point in range(coords.shape[0]):
        x, y, z = (ends(coords, point, 0, nodes, channels), ends(coords, point, 1, nodes, channels),
                   ends(coords, point, 2, nodes, channels))  # fmt: skip
        for c in range(0, channels, LANES):
            store8(out, point * channels + c, read_line(lines, x, c) * read_line(lines, y, c) * read_line(lines, z, c))


@kernel
def slope_sampled(
    c: int, lines: np.ndarray, coords: np.ndarray, shape: tuple, upstream: np.ndarray, out: np.ndarray
) -> None:
    """Gradient of `sample_lines` for channels c..c+7, added to out (flat, like lines)."""
    nodes, _, channels = shape
    for point in range(coords.shape[0]):
        x, y, z = (ends(coords, point, 0, nodes, channels), ends(coords, point, 1, nodes, channels),
                   ends(coords, point, 2, nodes, channels))  # fmt: skip
        a, b, d = read_line(lines, x, c), read_line(lines, y, c), read_line(lines, z, c)
        g = load8(upstream, point * channels + c)
        ga = g * a
        for at, value in ((x, g * b * d), (y, ga * d), (z, ga * b)):
            add(out, at[0] + c, np.float32(1) - at[2], value)
            add(out, at[1] + c, at[2], value)
