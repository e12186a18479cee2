"""Front-to-back blending, one tile of 16 x 16 pixels at a time.

A tile is 32 blocks of 4 x 2 pixels; a block is one eight-lane vector. Per entry a 32-bit mask of the blocks inside the
splat's box (and still alive) is walked by its lowest set bit. Per block and splat

    e = log2(alpha) = log2(o) + A dx^2 + B dx dy + C dy^2      (A, B, C carry the conic and log2 e)
    seen = e >= log2(1/255) and T > 0                          (the cut comes before the exponential)
    alpha = min(0.99, 2^e);  rest = T - alpha T;  stop = rest <= 1e-4
    w = alpha T where seen and not stop;  out_c += w f_c;  T <- rest, or -T where stop

A negative T marks a finished pixel and keeps its final transmittance; a block whose pixels are all finished leaves the
mask, a tile without blocks ends. The blocks that were seen are stored per entry: backward needs no culling.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from genmojo_core.kernels.cache import inlined, kernel
from genmojo_core.kernels.scalars import larger, smaller
from genmojo_core.kernels.simd import (
    EXP2_FLOATS,
    any_lane,
    bits,
    broadcast8,
    exp2_8,
    fma,
    load8,
    min8,
    prefetch,
    prepare_exp2,
    select8,
    splat8,
    store4x2,
    store8,
    trailing_zeros,
)  # fmt: skip
from genmojo_core.render.cpu.bins import TILE, Bins
from genmojo_core.render.cpu.project import GEOMETRY
from genmojo_core.render.rasterizer import ALPHA_MAX, ALPHA_MIN, TRANSMITTANCE_MIN

BLOCKS = 32
BLOCK_WIDTH, BLOCK_HEIGHT = 4, 2
LANES = 8
CUT = np.float32(math.log2(ALPHA_MIN))
MOST = np.float32(ALPHA_MAX)
STOP = np.float32(TRANSMITTANCE_MIN)
AHEAD = 6  # entries
# A tile's scratch, in floats: constants of exp2, pixel centres, one entry's alphas, then the state of the blocks.
XS = EXP2_FLOATS
YS = XS + BLOCKS * LANES
ALPHAS = YS + BLOCKS * LANES
STATE = ALPHAS + BLOCKS * LANES


class Drawing(NamedTuple):
    """What the tile kernels read and write for one view and up to 16 channel slots."""

    records: np.ndarray  # (M * (6 + slots),) float32 by rank
    slots: int  # channels including depth, even
    attached: int  # the first of them that give gradient to geometry, even
    planes: np.ndarray  # ((1 + slots) * padded height * padded width,) float32: alpha, then slots
    hits: np.ndarray  # (E,) uint32 by slot: the blocks an entry was seen in
    width: int
    height: int


def drawing_floats(slots: int) -> int:
    """Size of the scratch of `draw_tiles`."""
    return STATE + BLOCKS * (1 + slots) * LANES


@inlined
def block_mask(box: np.ndarray, rank: int, left: int, top: int) -> int:
    """Blocks of the tile at pixel (left, top) that a splat's box touches; block = 4 row + column."""
    first_x, last_x = larger(box[rank, 0] - left, 0) >> 2, smaller(box[rank, 1] - left, TILE - 1) >> 2
    first_y, last_y = larger(box[rank, 2] - top, 0) >> 1, smaller(box[rank, 3] - top, TILE - 1) >> 1
    columns = (1 << (last_x + 1)) - (1 << first_x)
    rows = (1 << (4 * (last_y + 1))) - (1 << (4 * first_y))
    return (columns * 0x11111111) & rows


@inlined
def inside_mask(left: int, top: int, width: int, height: int) -> int:
    """Blocks of the tile with at least one pixel of the image."""
    columns = smaller((width - left + BLOCK_WIDTH - 1) // BLOCK_WIDTH, 4)
    rows = smaller((height - top + BLOCK_HEIGHT - 1) // BLOCK_HEIGHT, 8)
    return (((1 << columns) - 1) * 0x11111111) & ((1 << (4 * rows)) - 1)


@inlined
def prepare(scratch: np.ndarray) -> None:
    """Fill the head of a tile's scratch: constants of exp2, then x and y of the 32 x 8 pixel centres inside a tile."""
    prepare_exp2(scratch)
    for block in range(BLOCKS):
        for lane in range(LANES):
            at = block * LANES + lane
            scratch[XS + at] = (block & 3) * BLOCK_WIDTH + (lane & 3) + 0.5
            scratch[YS + at] = (block >> 2) * BLOCK_HEIGHT + (lane >> 2) + 0.5


@inlined
def add_channels(scratch: np.ndarray, at: int, records: np.ndarray, first: int, slots: int, w: object) -> None:
    """Eight pixels' sums, one vector per slot from `at` on, += w times the record's channels from `first` on."""
    for group in range(slots >> 3):
        for k in range(8):
            place = at + (8 * group + k) * LANES
            store8(scratch, place, fma(w, broadcast8(records, first + 8 * group + k), load8(scratch, place)))
    for pair in range((slots & ~7) >> 1, slots >> 1):
        for k in range(2):
            place = at + (2 * pair + k) * LANES
            store8(scratch, place, fma(w, broadcast8(records, first + 2 * pair + k), load8(scratch, place)))


@inlined
def write_alphas(records: np.ndarray, at: int, mask: int, corner: tuple, scratch: np.ndarray) -> None:
    """Alpha of the record at `at`, not clamped, 0 under the cut, block by block of `mask` from ALPHAS on."""
    x, y = broadcast8(records, at) - corner[0], broadcast8(records, at + 1) - corner[1]
    a, b, c = broadcast8(records, at + 2), broadcast8(records, at + 3), broadcast8(records, at + 4)
    log_opacity = broadcast8(records, at + 5)
    place = ALPHAS
    while mask != 0:
        block = trailing_zeros(mask)
        mask &= mask - 1
        dx, dy = load8(scratch, XS + block * LANES) - x, load8(scratch, YS + block * LANES) - y
        e = fma(dx, fma(a, dx, b * dy), fma(c * dy, dy, log_opacity))
        store8(scratch, place, select8(e >= CUT, exp2_8(e, scratch), np.float32(0)))
        place += LANES


@inlined
def blend(records: np.ndarray, first: int, slots: int, mask: int, scratch: np.ndarray) -> tuple:
    """Blend the channels from `first` on with the alphas just written; the blocks seen and the blocks now finished."""
    zero = splat8(np.float32(0))
    seen_blocks, finished, place = 0, 0, ALPHAS
    while mask != 0:
        block = trailing_zeros(mask)
        mask &= mask - 1
        cell = STATE + block * (1 + slots) * LANES
        t = load8(scratch, cell)
        part = min8(load8(scratch, place), MOST) * t
        place += LANES
        seen, rest = part > zero, t - part
        after = select8(rest > STOP, rest, zero - t)
        going = seen & (rest > STOP)
        store8(scratch, cell, select8(seen, after, t))
        seen_blocks |= any_lane(seen) << block
        add_channels(scratch, cell + LANES, records, first, slots, select8(going, part, zero))
        if bits(going) != bits(seen) and bits(load8(scratch, cell) > zero) == 0:
            finished |= 1 << block
    return seen_blocks, finished


@inlined
def write_tile(drawing: Drawing, scratch: np.ndarray, left: int, top: int, pitch: int, plane: int) -> None:
    """Copy a tile's state into the padded planes: alpha = 1 - |T|, then the slots."""
    slots = drawing.slots
    for block in range(BLOCKS):
        cell = STATE + block * (1 + slots) * LANES
        place = (top + (block >> 2) * BLOCK_HEIGHT) * pitch + left + (block & 3) * BLOCK_WIDTH
        t = load8(scratch, cell)
        t = select8(t > np.float32(0), t, np.float32(0) - t)
        store4x2(drawing.planes, place, place + pitch, np.float32(1) - t)
        for c in range(slots):
            here = (1 + c) * plane + place
            store4x2(drawing.planes, here, here + pitch, load8(scratch, cell + (1 + c) * LANES))


@kernel
def draw_tiles(start: int, stop: int, drawing: Drawing, bins: Bins, scratch: np.ndarray) -> None:
    """Blend tiles start..stop-1 into the planes and record which blocks each entry was seen in.

    scratch: `drawing_floats(slots)` float32, of any content.
    """
    slots = drawing.slots
    width = GEOMETRY + slots
    prepare(scratch)
    pitch = bins.tiles_x * TILE
    for tile in range(start, stop):
        left, top = (tile % bins.tiles_x) * TILE, (tile // bins.tiles_x) * TILE
        for i in range(STATE, STATE + BLOCKS * (1 + slots) * LANES, LANES):
            store8(scratch, i, splat8(np.float32(0)))
        for block in range(BLOCKS):
            store8(scratch, STATE + block * (1 + slots) * LANES, splat8(np.float32(1)))
        alive = inside_mask(left, top, drawing.width, drawing.height)
        corner = (np.float32(left), np.float32(top))
        last = bins.tile_start[tile + 1]
        for entry in range(bins.tile_start[tile], last):
            rank = bins.rank[entry]
            prefetch(drawing.records, bins.rank[smaller(entry + AHEAD, last - 1)] * width)
            mask = block_mask(bins.box, rank, left, top) & alive
            if mask != 0:
                write_alphas(drawing.records, rank * width, mask, corner, scratch)
                seen, finished = blend(drawing.records, rank * width + GEOMETRY, slots, mask, scratch)
                drawing.hits[bins.slot[entry]] = seen
                alive &= ~finished
                if alive == 0:
                    break
        write_tile(drawing, scratch, left, top, pitch, pitch * bins.tiles_y * TILE)
