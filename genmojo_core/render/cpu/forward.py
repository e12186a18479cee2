"""Front-to-back blending, one tile of 16 x 16 pixels at a time.

A tile is 32 blocks of 4 x 2 pixels, numbered down its four columns; a block is one eight-lane vector. A tile's splats
are taken in chunks: their records are copied side by side, each with the blocks that its ellipse reaches, found for
the eight rows of blocks at once. Bit b of those masks, for all splats of the chunk, tells the splats of block b, walked
by the lowest set bit while the block's pixels stay in registers. Per block and splat

    e = log2(alpha) = log2(o) + A dx^2 + B dx dy + C dy^2      (A, B, C carry the conic and log2 e)
    alpha = min(0.99, 2^e) where e >= log2(1/255), else 0;  rest = T - alpha T;  stop = rest <= 1e-4
    w = alpha T, or 0 where stop;  out_c += w f_c;  out_alpha += w;  T <- rest, or 0 where stop

T = 0 marks a finished pixel; a block whose pixels are all finished is left out from then on, a tile without blocks
ends. The blocks that an entry reached while they had pixels left are stored: backward needs no culling.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from genmojo_core.kernels.cache import inlined
from genmojo_core.kernels.lane_bits import any_lane, bits, lanes_with_bit, store_bits, trailing_zeros
from genmojo_core.kernels.scalars import smaller
from genmojo_core.kernels.simd import (
    EXP2_FLOATS,
    broadcast8,
    exp2_8,
    exp2_table,
    fma,
    load8,
    max8,
    min8,
    prefetch,
    prepare_exp2,
    select8,
    splat8,
    sqrt8,
    store4x2,
    store8,
    store_rows,
)  # fmt: skip
from genmojo_core.kernels.stage import Stage, begin, claim, meet
from genmojo_core.render.cpu.bins import Bins
from genmojo_core.render.cpu.project import GEOMETRY, TILE
from genmojo_core.render.rasterizer import ALPHA_MAX, ALPHA_MIN, TRANSMITTANCE_MIN

BLOCKS = 32
BLOCK_WIDTH, BLOCK_HEIGHT = 4, 2
LANES = 8
CUT = np.float32(math.log2(ALPHA_MIN))
MOST = np.float32(ALPHA_MAX)
STOP = np.float32(TRANSMITTANCE_MIN)
AHEAD = 8  # entries
CHUNK = 56  # splats of a tile taken at once: as many bits fit into an int64 with some to spare
# Pixels added to an ellipse's reach, once and for each pixel that its centre is away from the tile's corner; a factor
# just above 1 on what nearly cancels in needles; a reach that touches nothing.
MARGIN, MARGIN_OF_X, ROUNDING = np.float32(0.01), np.float32(1e-6), np.float32(1 + 1e-6)
NOWHERE = np.float32(-1e30)
ROW = 24  # floats of a copied record: geometry and at most 16 slots, rounded up to 8
WIDE = 10  # slots blended along with the transmittance; the others follow in loops of their own
# A tile's scratch, in floats: constants of exp2, pixel centres, the first pixel's y in each row of blocks, records and
# masks of the chunk, one block's weights, the state of the blocks.
XS = EXP2_FLOATS
YS = XS + BLOCKS * LANES
LINES = YS + BLOCKS * LANES
ROWS = LINES + LANES
ALPHAS = ROWS  # of the backward pass, which copies no records
MASKS = ROWS + CHUNK * ROW
WEIGHTS = MASKS + CHUNK
STATE = WEIGHTS + CHUNK * LANES
MARKS = CHUNK  # a tile's marks, in int64: the blocks that each splat of the chunk reached in time


class Drawing(NamedTuple):
    """What the tile kernels read and write for one view and up to 16 channel slots."""

    records: np.ndarray  # (M * (6 + slots) + 8,) float32 by rank, the last eight of any content
    slots: int  # channels including depth, even
    stride: int  # floats of a block's state, state_floats(slots)
    attached: int  # the first of them that give gradient to geometry, even
    planes: np.ndarray  # ((1 + slots) * padded height * padded width,) float32: alpha, then slots
    hits: np.ndarray  # (E,) uint32 the blocks an entry reached in time; by entry, so that tiles share no cache lines
    width: int
    height: int


def state_floats(slots: int) -> int:
    """Floats of one block's state: T, alpha and the slots, at least WIDE of them."""
    return (2 + max(slots, WIDE)) * LANES


def drawing_floats(slots: int) -> int:
    """Size of the scratch of `draw_tiles`."""
    return STATE + BLOCKS * state_floats(slots)


@inlined
def column(block: int) -> int:
    """First pixel column of a block inside its tile."""
    return (block >> 3) * BLOCK_WIDTH


@inlined
def line(block: int) -> int:
    """First pixel row of a block inside its tile."""
    return (block & 7) * BLOCK_HEIGHT


@inlined
def inside_mask(left: int, top: int, width: int, height: int) -> int:
    """Blocks of the tile with at least one pixel of the image."""
    columns = smaller((width - left + BLOCK_WIDTH - 1) // BLOCK_WIDTH, 4)
    rows = smaller((height - top + BLOCK_HEIGHT - 1) // BLOCK_HEIGHT, 8)
    return (((1 << rows) - 1) * 0x01010101) & ((1 << (8 * columns)) - 1)


@inlined
def prepare(scratch: np.ndarray) -> None:
    """Fill the head of a tile's scratch: constants of exp2, then x and y of the 32 x 8 pixel centres inside a tile."""
    prepare_exp2(scratch)
    for block in range(BLOCKS):
        for lane in range(LANES):
            at = block * LANES + lane
            scratch[XS + at] = column(block) + (lane & 3) + 0.5
            scratch[YS + at] = line(block) + (lane >> 2) + 0.5
    for row in range(LANES):
        scratch[LINES + row] = line(row) + 0.5


@inlined
def reached(scratch: np.ndarray, row: int) -> int:
    """The blocks where a copied record may pass the cut: those its ellipse touches in either of their pixel rows.

    In a pixel row dy from the centre the ellipse reaches from s dy - h to s dy + h with s = -B / 2A and
    h^2 = (s^2 - C / A) dy^2 + (log2(1/255) - log2 o) / A; a little is added for rounding.
    """
    inverse = np.float32(1) / scratch[row + 2]
    slope = np.float32(-0.5) * scratch[row + 3] * inverse
    most = (CUT - scratch[row + 5]) * inverse
    bend = slope * slope * ROUNDING - scratch[row + 4] * inverse
    margin = MARGIN + MARGIN_OF_X * abs(scratch[row])
    zero, none = splat8(np.float32(0)), splat8(NOWHERE)
    first = load8(scratch, LINES) - scratch[row + 1]
    second = first + np.float32(1)
    square0, square1 = fma(first * first, bend, most), fma(second * second, bend, most)
    half0, half1 = sqrt8(max8(square0, zero)) + margin, sqrt8(max8(square1, zero)) + margin
    half0, half1 = select8(square0 >= zero, half0, none), select8(square1 >= zero, half1, none)
    middle0, middle1 = fma(slope, first, scratch[row]), fma(slope, second, scratch[row])
    low, high = min8(middle0 - half0, middle1 - half1), max8(middle0 + half0, middle1 + half1)
    mask = 0
    for block in range(0, BLOCKS, 8):
        mask |= bits((low <= np.float32(column(block) + 3.5)) & (high >= np.float32(column(block) + 0.5))) << block
    return mask


@inlined
def take_chunk(drawing: Drawing, bins: Bins, span: tuple, place: tuple, scratch: np.ndarray, marks: np.ndarray) -> None:
    """Copy the records of entries span[0]..span[1]-1 into the scratch, with their masks, which are their first marks.

    place: the tile's left and top pixel, from which the copied centres count, and the blocks still alive.
    """
    left, top, alive = place
    width = GEOMETRY + drawing.slots
    for k in range(span[1] - span[0]):
        rank = bins.rank[span[0] + k]
        prefetch(drawing.records, bins.rank[smaller(span[0] + k + AHEAD, bins.rank.size - 1)] * width)
        row = ROWS + k * ROW
        for i in range(0, width, LANES):
            store8(scratch, row + i, load8(drawing.records, rank * width + i))
        for i in range(width, GEOMETRY + WIDE):
            scratch[row + i] = 0
        scratch[row] -= np.float32(left)
        scratch[row + 1] -= np.float32(top)
        marks[k] = reached(scratch, row) & alive
        store_bits(scratch, MASKS + k, marks[k])
    for k in range(span[1] - span[0], CHUNK):
        store_bits(scratch, MASKS + k, 0)


@inlined
def write_alphas(records: np.ndarray, at: int, mask: int, corner: tuple, scratch: np.ndarray) -> None:
    """Alpha of the record at `at`, not clamped, 0 under the cut, block by block of `mask` from ALPHAS on."""
    x, y = broadcast8(records, at) - corner[0], broadcast8(records, at + 1) - corner[1]
    a, b, c = broadcast8(records, at + 2), broadcast8(records, at + 3), broadcast8(records, at + 4)
    log_opacity = broadcast8(records, at + 5)
    place, powers = ALPHAS, exp2_table(scratch)
    while mask != 0:
        block = trailing_zeros(mask)
        mask &= mask - 1
        dx, dy = load8(scratch, XS + block * LANES) - x, load8(scratch, YS + block * LANES) - y
        e = fma(dx, fma(a, dx, b * dy), fma(c * dy, dy, log_opacity))
        store8(scratch, place, select8(e >= CUT, exp2_8(e, powers), np.float32(0)))
        place += LANES


@inlined
def alphas(scratch: np.ndarray, row: int, x: object, y: object, powers: tuple) -> object:
    """Alpha of a copied record at eight pixels, not clamped, 0 under the cut."""
    dx, dy = x - broadcast8(scratch, row), y - broadcast8(scratch, row + 1)
    a, b, c = broadcast8(scratch, row + 2), broadcast8(scratch, row + 3), broadcast8(scratch, row + 4)
    e = fma(dx, fma(a, dx, b * dy), fma(c * dy, dy, broadcast8(scratch, row + 5)))
    return select8(e >= CUT, exp2_8(e, powers), np.float32(0))


@inlined
def blend(scratch: np.ndarray, block: int, mask: int, cell: int) -> tuple:
    """Blend the splats `mask`, at least one, of the chunk on one block, WIDE slots, until its pixels are finished.

    Their weights are left in the scratch, one after the other. Returns where they end, and the splats not looked at.
    """
    zero = splat8(np.float32(0))
    x, y, powers = load8(scratch, XS + block * LANES), load8(scratch, YS + block * LANES), exp2_table(scratch)
    t, a, c0, c1 = load8(scratch, cell), load8(scratch, cell + 8), load8(scratch, cell + 16), load8(scratch, cell + 24)
    c2, c3, c4 = load8(scratch, cell + 32), load8(scratch, cell + 40), load8(scratch, cell + 48)
    c5, c6, c7 = load8(scratch, cell + 56), load8(scratch, cell + 64), load8(scratch, cell + 72)
    c8, c9 = load8(scratch, cell + 80), load8(scratch, cell + 88)
    place = WEIGHTS
    while True:
        k = trailing_zeros(mask)
        mask &= mask - 1
        row = ROWS + k * ROW
        part = min8(alphas(scratch, row, x, y, powers), MOST) * t
        rest = t - part
        going = rest > STOP
        w, t = select8(going, part, zero), select8(going, rest, zero)
        a = a + w
        f = row + GEOMETRY
        c0, c1 = fma(w, broadcast8(scratch, f), c0), fma(w, broadcast8(scratch, f + 1), c1)
        c2, c3 = fma(w, broadcast8(scratch, f + 2), c2), fma(w, broadcast8(scratch, f + 3), c3)
        c4, c5 = fma(w, broadcast8(scratch, f + 4), c4), fma(w, broadcast8(scratch, f + 5), c5)
        c6, c7 = fma(w, broadcast8(scratch, f + 6), c6), fma(w, broadcast8(scratch, f + 7), c7)
        c8, c9 = fma(w, broadcast8(scratch, f + 8), c8), fma(w, broadcast8(scratch, f + 9), c9)
        store8(scratch, place, w)
        place += LANES
        if mask == 0 or any_lane(going) == 0:
            break
    store_rows(scratch, cell, (t, a, c0, c1, c2, c3, c4, c5, c6, c7, c8, c9))
    return place, mask


@inlined
def add_channels(scratch: np.ndarray, mask: int, cell: int, end: int, slots: int) -> None:
    """Blend slots WIDE, ... of one block, two at a time, with the weights just written, which end at `end`."""
    for slot in range(WIDE, slots, 2):
        at, place, coming = cell + (2 + slot) * LANES, WEIGHTS, mask
        c0, c1 = load8(scratch, at), load8(scratch, at + LANES)
        while place != end:
            f = ROWS + trailing_zeros(coming) * ROW + GEOMETRY + slot
            coming &= coming - 1
            w = load8(scratch, place)
            place += LANES
            c0, c1 = fma(w, broadcast8(scratch, f), c0), fma(w, broadcast8(scratch, f + 1), c1)
        store_rows(scratch, at, (c0, c1))


@inlined
def draw_chunk(drawing: Drawing, alive: int, count: int, scratch: np.ndarray, marks: np.ndarray) -> int:
    """Blend a chunk of `count` splats on all blocks `alive`; the blocks that stay alive."""
    left = alive
    while left != 0:
        block = trailing_zeros(left)
        left &= left - 1
        mask = 0
        for k in range(0, count, LANES):
            mask |= lanes_with_bit(scratch, MASKS + k, block) << k
        if mask != 0:
            cell = STATE + block * drawing.stride
            end, unseen = blend(scratch, block, mask, cell)
            add_channels(scratch, mask, cell, end, drawing.slots)
            if any_lane(load8(scratch, cell) > np.float32(0)) == 0:
                alive &= ~(1 << block)
                while unseen != 0:
                    marks[trailing_zeros(unseen)] &= ~(1 << block)
                    unseen &= unseen - 1
    return alive


@inlined
def write_tile(drawing: Drawing, scratch: np.ndarray, left: int, top: int, pitch: int, plane: int) -> None:
    """Copy a tile's alpha and slots into the padded planes.

    Plane by plane: planes often lie a power of two apart, where a cache holds few lines at once.
    """
    corner = top * pitch + left
    for c in range(1 + drawing.slots):
        for block in range(BLOCKS):
            place = c * plane + corner + line(block) * pitch + column(block)
            value = load8(scratch, STATE + block * drawing.stride + (1 + c) * LANES)
            store4x2(drawing.planes, place, place + pitch, value)


@inlined
def draw_tiles(stage: Stage, drawing: Drawing, bins: Bins, scratch: np.ndarray, marks: np.ndarray) -> int:
    """Blend the tiles of a stage into the planes and record what each block has seen.

    scratch: `drawing_floats(slots)` float32, marks: MARKS int64, of any content.
    """
    begin(stage)
    stride, pitch = drawing.stride, bins.tiles_x * TILE
    prepare(scratch)
    tile = claim(stage)
    while tile < stage.size:
        left, top = (tile % bins.tiles_x) * TILE, (tile // bins.tiles_x) * TILE
        for i in range(STATE, STATE + BLOCKS * stride, LANES):
            store8(scratch, i, splat8(np.float32(0)))
        for block in range(BLOCKS):
            store8(scratch, STATE + block * stride, splat8(np.float32(1)))
        alive = inside_mask(left, top, drawing.width, drawing.height)
        first, last = bins.tile_start[tile], bins.tile_start[tile + 1]
        while first < last and alive != 0:
            count = smaller(CHUNK, last - first)
            take_chunk(drawing, bins, (first, first + count), (left, top, alive), scratch, marks)
            alive = draw_chunk(drawing, alive, count, scratch, marks)
            for k in range(count):
                drawing.hits[first + k] = marks[k]
            first += count
        for entry in range(first, last):
            drawing.hits[entry] = 0
        write_tile(drawing, scratch, left, top, pitch, pitch * bins.tiles_y * TILE)
        tile = claim(stage)
    return meet(stage)
