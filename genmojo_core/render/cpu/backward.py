"""Gradients of the blending, front to back like the forward pass.

Per pixel, with upstream gradients g_c and g_alpha, let q_i = g_alpha + sum_c g_c f_ic over the attached channels, and
S the part of sum_j w_j q_j still behind the current splat (at first the whole sum, which is known from the picture).
Then with S after taking off w_i q_i

    dL/dalpha_i = T_i q_i - S / (1 - alpha_i),      v_i = alpha_i dL/dalpha_i   (0 where alpha was clamped to 0.99)

and everything about the shape of splat i follows from six sums of v over its pixels: 1, dx, dy, dx^2, dx dy, dy^2.
The gradient of its channels is sum w g_c. These 6 + slots sums go to the entry's own row, so that no two threads ever
add to the same number and the result has the same bits for any number of threads.

Each entry takes short loops over its blocks, one after the other: alphas, replay, moments, channels. So all sums stay
in registers, and the processor works on several blocks at once instead of waiting for the long chain of one.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from genmojo_core.kernels.cache import inlined
from genmojo_core.kernels.lane_bits import trailing_zeros
from genmojo_core.kernels.scalars import smaller
from genmojo_core.kernels.simd import (
    broadcast8,
    fma,
    load4x2,
    load8,
    min8,
    prefetch,
    select8,
    splat8,
    store8,
    store_rows,
    sum_rows,
)  # fmt: skip
from genmojo_core.kernels.stage import Stage, begin, claim, meet
from genmojo_core.render.cpu.bins import Bins
from genmojo_core.render.cpu.forward import (
    AHEAD,
    ALPHAS,
    BLOCKS,
    LANES,
    MOST,
    STOP,
    XS,
    YS,
    Drawing,
    column,
    line,
    prepare,
    write_alphas,
)  # fmt: skip
from genmojo_core.render.cpu.project import GEOMETRY, TILE

MOMENTS = 6
HEADER = 3  # vectors per block before the slots' gradients: T, S, gradient of alpha
LONGEST_ROW = 24  # floats: moments and at most 16 slots, rounded up to 8
# A tile's scratch, in floats: the forward pass's head, then weights, sums and the state of the blocks.
WEIGHTS = ALPHAS + BLOCKS * LANES
SUMS = WEIGHTS + BLOCKS * LANES
STATE = SUMS + LONGEST_ROW * LANES
FIRST_GRADIENT = STATE + HEADER * LANES


class Slopes(NamedTuple):
    """What the backward tile kernel reads and writes besides the `Drawing`."""

    planes: np.ndarray  # like Drawing.planes, float32: upstream gradients, zero outside the image
    rows: np.ndarray  # (E * row,) float32 by slot: 6 moments, then the slots' sums
    row: int  # floats per row, a multiple of 8


def slope_floats(slots: int) -> int:
    """Size of the scratch of `slope_tiles`; some to spare: loops over several slots read over the end."""
    return STATE + BLOCKS * (HEADER + slots) * LANES + 8 * LANES


@inlined
def read_tile(drawing: Drawing, slopes: Slopes, scratch: np.ndarray, place: tuple) -> None:
    """Fill a tile's state: T = 1, S = the whole sum of w q, and the upstream gradients."""
    left, top, pitch, plane = place
    for block in range(BLOCKS):
        cell = STATE + block * (HEADER + drawing.slots) * LANES
        upper = (top + line(block)) * pitch + left + column(block)
        g = load4x2(slopes.planes, upper, upper + pitch)
        s = g * load4x2(drawing.planes, upper, upper + pitch)
        store8(scratch, cell, splat8(np.float32(1)))
        store8(scratch, cell + 2 * LANES, g)
        for c in range(drawing.slots):
            here = (1 + c) * plane + upper
            g = load4x2(slopes.planes, here, here + pitch)
            store8(scratch, cell + (HEADER + c) * LANES, g)
            if c < drawing.attached:
                s = fma(g, load4x2(drawing.planes, here, here + pitch), s)
        store8(scratch, cell + LANES, s)


@inlined
def replay(records: np.ndarray, first: int, mask: int, sizes: tuple, scratch: np.ndarray) -> None:
    """Second loop of one entry: blend again with the alphas just written; leave w and v block by block.

    q = g_alpha + sum of g_c f_c over the attached channels: eight of them stay in registers, those that are not
    attached being 0; the rest follows in a loop.
    """
    attached, stride = sizes
    zero, one = splat8(np.float32(0)), splat8(np.float32(1))
    f0, f1 = broadcast8(records, first), broadcast8(records, first + 1)
    f2, f3, f4, f5, f6, f7 = zero, zero, zero, zero, zero, zero
    if attached > 2:
        f2, f3 = broadcast8(records, first + 2), broadcast8(records, first + 3)
    if attached > 4:
        f4, f5 = broadcast8(records, first + 4), broadcast8(records, first + 5)
    if attached > 6:
        f6, f7 = broadcast8(records, first + 6), broadcast8(records, first + 7)
    place = 0
    while mask != 0:
        cell = STATE + trailing_zeros(mask) * stride
        mask &= mask - 1
        t, full = load8(scratch, cell), load8(scratch, ALPHAS + place)
        alpha = min8(full, MOST)
        part = alpha * t
        rest = t - part
        going = rest > STOP
        store8(scratch, cell, select8(going, rest, zero))
        w = select8(going, part, zero)
        g = cell + HEADER * LANES
        q = fma(f0, load8(scratch, g), load8(scratch, cell + 2 * LANES))
        r = f1 * load8(scratch, g + 8)
        q, r = fma(f2, load8(scratch, g + 16), q), fma(f3, load8(scratch, g + 24), r)
        q, r = fma(f4, load8(scratch, g + 32), q), fma(f5, load8(scratch, g + 40), r)
        q, r = fma(f6, load8(scratch, g + 48), q), fma(f7, load8(scratch, g + 56), r)
        for c in range(8, attached):
            q = fma(broadcast8(records, first + c), load8(scratch, g + c * LANES), q)
        q = q + r
        s = load8(scratch, cell + LANES) - w * q
        store8(scratch, cell + LANES, s)
        store8(scratch, WEIGHTS + place, w)
        v = alpha * (t * q - s / (one - alpha))
        store8(scratch, ALPHAS + place, select8(going & (full <= MOST), v, zero))
        place += LANES


@inlined
def moments(records: np.ndarray, at: int, hit: int, stride: int, corner: tuple, scratch: np.ndarray) -> None:
    """Third loop of one entry: the six sums of v, and the sums of w g_c of the first two slots."""
    x, y = broadcast8(records, at) - corner[0], broadcast8(records, at + 1) - corner[1]
    zero = splat8(np.float32(0))
    m0, m1, m2, m3, m4, m5, m6, m7 = zero, zero, zero, zero, zero, zero, zero, zero
    mask, place = hit, 0
    while mask != 0:
        block = trailing_zeros(mask)
        mask &= mask - 1
        dx, dy = load8(scratch, XS + block * LANES) - x, load8(scratch, YS + block * LANES) - y
        v, w = load8(scratch, ALPHAS + place), load8(scratch, WEIGHTS + place)
        place += LANES
        vx, vy = v * dx, v * dy
        m0, m1, m2 = m0 + v, m1 + vx, m2 + vy
        m3, m4, m5 = fma(vx, dx, m3), fma(vx, dy, m4), fma(vy, dy, m5)
        cell = FIRST_GRADIENT + block * stride
        m6, m7 = fma(w, load8(scratch, cell), m6), fma(w, load8(scratch, cell + LANES), m7)
    store_rows(scratch, SUMS, (m0, m1, m2, m3, m4, m5, m6, m7))


@inlined
def channel_sums(scratch: np.ndarray, hit: int, slots: int, stride: int) -> None:
    """Last loops of one entry: sum of w g_c over the blocks `hit` for slots 2, 3, ...; eight, four, two at a time."""
    zero = splat8(np.float32(0))
    first = 2
    while slots - first >= 8:
        s0, s1, s2, s3, s4, s5, s6, s7 = zero, zero, zero, zero, zero, zero, zero, zero
        mask, weights = hit, WEIGHTS
        while mask != 0:
            cell = FIRST_GRADIENT + trailing_zeros(mask) * stride + first * LANES
            mask &= mask - 1
            w = load8(scratch, weights)
            weights += LANES
            s0, s1 = fma(w, load8(scratch, cell), s0), fma(w, load8(scratch, cell + 8), s1)
            s2, s3 = fma(w, load8(scratch, cell + 16), s2), fma(w, load8(scratch, cell + 24), s3)
            s4, s5 = fma(w, load8(scratch, cell + 32), s4), fma(w, load8(scratch, cell + 40), s5)
            s6, s7 = fma(w, load8(scratch, cell + 48), s6), fma(w, load8(scratch, cell + 56), s7)
        store_rows(scratch, SUMS + (MOMENTS + first) * LANES, (s0, s1, s2, s3, s4, s5, s6, s7))
        first += 8
    while first < slots:  # of the last four, two may lie behind the slots: they are summed and never read
        s0, s1, s2, s3 = zero, zero, zero, zero
        mask, weights = hit, WEIGHTS
        while mask != 0:
            cell = FIRST_GRADIENT + trailing_zeros(mask) * stride + first * LANES
            mask &= mask - 1
            w = load8(scratch, weights)
            weights += LANES
            s0, s1 = fma(w, load8(scratch, cell), s0), fma(w, load8(scratch, cell + 8), s1)
            s2, s3 = fma(w, load8(scratch, cell + 16), s2), fma(w, load8(scratch, cell + 24), s3)
        store_rows(scratch, SUMS + (MOMENTS + first) * LANES, (s0, s1, s2, s3))
        first += 4


@inlined
def slope_tiles(stage: Stage, drawing: Drawing, bins: Bins, slopes: Slopes, scratch: np.ndarray) -> int:
    """Write the gradient rows of all entries that forward saw of the tiles of a stage.

    scratch: `slope_floats(slots)` float32, of any content.
    """
    begin(stage)
    slots, pitch = drawing.slots, bins.tiles_x * TILE
    width, stride = GEOMETRY + slots, (HEADER + slots) * LANES
    for i in range(0, scratch.size, LANES):
        store8(scratch, i, splat8(np.float32(0)))
    prepare(scratch)
    tile = claim(stage)
    while tile < stage.size:
        left, top = (tile % bins.tiles_x) * TILE, (tile // bins.tiles_x) * TILE
        last = bins.tile_start[tile + 1]
        if bins.tile_start[tile] < last:
            read_tile(drawing, slopes, scratch, (left, top, pitch, pitch * bins.tiles_y * TILE))
        corner = (np.float32(left), np.float32(top))
        for entry in range(bins.tile_start[tile], last):
            hit = np.int64(drawing.hits[entry])
            if hit == 0:
                continue
            slot, coming = bins.slot[entry], smaller(entry + AHEAD, last - 1)
            prefetch(drawing.records, bins.rank[coming] * width)
            prefetch(slopes.rows, bins.slot[coming] * slopes.row)
            at = bins.rank[entry] * width
            write_alphas(drawing.records, at, hit, corner, scratch)
            replay(drawing.records, at + GEOMETRY, hit, (drawing.attached, stride), scratch)
            moments(drawing.records, at, hit, stride, corner, scratch)
            channel_sums(scratch, hit, slots, stride)
            for k in range(0, slopes.row, LANES):
                store8(slopes.rows, slot * slopes.row + k, sum_rows(scratch, SUMS + k * LANES))
        tile = claim(stage)
    return meet(stage)
