"""Gradients of the blending, front to back like the forward pass.

Per pixel, with upstream gradients g_c and g_alpha, let q_i = g_alpha + sum_c g_c f_ic over the attached channels, and
S the part of sum_j w_j q_j still behind the current splat (at first the whole sum, which is known from the picture).
Then with S after taking off w_i q_i

    dL/dalpha_i = T_i q_i - S / (1 - alpha_i),      v_i = alpha_i dL/dalpha_i   (0 where alpha was clamped to 0.99)

and everything about the shape of splat i follows from six sums of v over its pixels: 1, dx, dy, dx^2, dx dy, dy^2.
The gradient of its channels is sum w g_c. These 6 + slots sums go to the entry's own row, so that no two threads ever
add to the same number and the result has the same bits for any number of threads.

Each entry takes two loops over its blocks, moments first and channels second, so that all sums stay in registers.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from genmojo_core.kernels.cache import inlined, kernel
from genmojo_core.kernels.simd import (
    broadcast8,
    exp2_8,
    fma,
    load4x2,
    load8,
    min8,
    prefetch,
    select8,
    splat8,
    store8,
    sum_rows,
    trailing_zeros,
)  # fmt: skip
from genmojo_core.render.cpu.bins import TILE, Bins
from genmojo_core.render.cpu.forward import (
    BLOCK_HEIGHT,
    BLOCK_WIDTH,
    BLOCKS,
    CUT,
    LANES,
    MOST,
    STOP,
    Drawing,
    exponent,
    pixel_centres,
)  # fmt: skip
from genmojo_core.render.cpu.project import GEOMETRY

MOMENTS = 6
AHEAD = 6  # entries
HEADER = 3  # vectors per block before the slots' gradients: T, S, gradient of alpha


class Slopes(NamedTuple):
    """What the backward tile kernel reads and writes besides the `Drawing`."""

    planes: np.ndarray  # like Drawing.planes, float32: upstream gradients, zero outside the image
    rows: np.ndarray  # (E * row,) float32 by slot: 6 moments, then the slots' sums
    row: int  # floats per row, a multiple of 8


@inlined
def read_tile(drawing: Drawing, slopes: Slopes, state: np.ndarray, place: tuple) -> None:
    """Fill a tile's state: T = 1, S = the whole sum of w q, and the upstream gradients."""
    left, top, pitch, plane = place
    for block in range(BLOCKS):
        cell = block * (HEADER + drawing.slots) * LANES
        upper = (top + (block >> 2) * BLOCK_HEIGHT) * pitch + left + (block & 3) * BLOCK_WIDTH
        g = load4x2(slopes.planes, upper, upper + pitch)
        s = g * load4x2(drawing.planes, upper, upper + pitch)
        store8(state, cell, splat8(np.float32(1)))
        store8(state, cell + 2 * LANES, g)
        for c in range(drawing.slots):
            here = (1 + c) * plane + upper
            g = load4x2(slopes.planes, here, here + pitch)
            store8(state, cell + (HEADER + c) * LANES, g)
            if c < drawing.attached:
                s = fma(g, load4x2(drawing.planes, here, here + pitch), s)
        store8(state, cell + LANES, s)


@inlined
def moments(drawing: Drawing, at: int, mask: int, corner: tuple, scratch: tuple) -> int:
    """First loop of one entry: replay the blending, write the six sums and the weights; returns the blocks' number."""
    state, places, weights, cells, sums = scratch
    records = drawing.records
    stride = (HEADER + drawing.slots) * LANES
    x, y = records[at] - corner[0], records[at + 1] - corner[1]
    zero = splat8(np.float32(0))
    m0, m1, m2, m3, m4, m5 = zero, zero, zero, zero, zero, zero
    count = 0
    while mask != 0:
        block = trailing_zeros(mask)
        mask &= mask - 1
        dx = load8(places, block * LANES) - x
        dy = load8(places, (BLOCKS + block) * LANES) - y
        e = exponent(records, at, dx, dy)
        cell = block * stride
        t = load8(state, cell)
        seen = (e >= CUT) & (t > np.float32(0))
        full = exp2_8(e)
        alpha = min8(full, MOST)
        part = alpha * t
        rest = t - part
        going = seen & (rest > STOP)
        store8(state, cell, select8(seen, select8(rest > STOP, rest, np.float32(0) - t), t))
        w = select8(going, part, zero)
        q, r = load8(state, cell + 2 * LANES), zero
        for c in range(drawing.attached >> 1):
            here = cell + (HEADER + 2 * c) * LANES
            f = at + GEOMETRY + 2 * c
            q = fma(broadcast8(records, f), load8(state, here), q)
            r = fma(broadcast8(records, f + 1), load8(state, here + LANES), r)
        q = q + r
        s = load8(state, cell + LANES) - w * q
        store8(state, cell + LANES, s)
        slope = t * q - s / (np.float32(1) - alpha)
        v = select8(going & (full <= MOST), alpha * slope, zero)
        store8(weights, count * LANES, w)
        cells[count] = cell
        count += 1
        vx, vy = v * dx, v * dy
        m0, m1, m2 = m0 + v, m1 + vx, m2 + vy
        m3, m4, m5 = fma(vx, dx, m3), fma(vx, dy, m4), fma(vy, dy, m5)
    for k, m in enumerate((m0, m1, m2, m3, m4, m5)):
        store8(sums, k * LANES, m)
    return count


@inlined
def channel_sums(slots: int, count: int, scratch: tuple) -> None:
    """Second loop of one entry: sum of w g_c for every slot, as vectors behind the moments."""
    state, _, weights, cells, sums = scratch
    zero = splat8(np.float32(0))
    for c in range(0, slots - 2, 4):
        s0, s1, s2, s3 = zero, zero, zero, zero
        for k in range(count):
            w = load8(weights, k * LANES)
            here = cells[np.uint64(k)] + (HEADER + c) * LANES
            s0 = fma(w, load8(state, here), s0)
            s1 = fma(w, load8(state, here + LANES), s1)
            s2 = fma(w, load8(state, here + 2 * LANES), s2)
            s3 = fma(w, load8(state, here + 3 * LANES), s3)
        for k, s in enumerate((s0, s1, s2, s3)):
            store8(sums, (MOMENTS + c + k) * LANES, s)
    if slots & 2:
        c = slots - 2
        s0, s1 = zero, zero
        for k in range(count):
            w = load8(weights, k * LANES)
            here = cells[np.uint64(k)] + (HEADER + c) * LANES
            s0 = fma(w, load8(state, here), s0)
            s1 = fma(w, load8(state, here + LANES), s1)
        store8(sums, (MOMENTS + c) * LANES, s0)
        store8(sums, (MOMENTS + c + 1) * LANES, s1)


@kernel
def slope_tiles(start: int, stop: int, drawing: Drawing, bins: Bins, slopes: Slopes) -> None:
    """Write the gradient rows of all entries of tiles start..stop-1 that forward saw."""
    slots = drawing.slots
    width = GEOMETRY + slots
    state = np.empty(BLOCKS * (HEADER + slots) * LANES, np.float32)
    places = np.empty(2 * BLOCKS * LANES, np.float32)
    weights = np.empty(BLOCKS * LANES, np.float32)
    sums = np.zeros(slopes.row * LANES, np.float32)
    scratch = (state, places, weights, np.empty(BLOCKS, np.int64), sums)
    pixel_centres(places)
    pitch = bins.tiles_x * TILE
    for tile in range(start, stop):
        left, top = (tile % bins.tiles_x) * TILE, (tile // bins.tiles_x) * TILE
        last = bins.tile_start[tile + 1]
        if bins.tile_start[tile] == last:
            continue
        read_tile(drawing, slopes, state, (left, top, pitch, pitch * bins.tiles_y * TILE))
        corner = (np.float32(left), np.float32(top))
        for entry in range(bins.tile_start[tile], last):
            slot = bins.slot[entry]
            mask = int(drawing.hits[slot])
            if mask == 0:
                continue
            prefetch(drawing.records, bins.rank[min(entry + AHEAD, last - 1)] * width)
            count = moments(drawing, bins.rank[entry] * width, mask, corner, scratch)
            channel_sums(slots, count, scratch)
            for k in range(0, slopes.row, LANES):
                store8(slopes.rows, slot * slopes.row + k, sum_rows(sums, k * LANES))
