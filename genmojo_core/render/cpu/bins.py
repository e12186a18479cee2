"""Which splats touch which tile, in depth order, without sorting (tile, depth) pairs.

The splats drawn are sorted once by depth (`rank` = place in that order); a counting sort by tile that walks the ranks
upwards is stable, so every tile lists its splats front to back. An entry is one splat on one tile. Its `slot` counts
the tiles of a splat one after the other (first_slot[rank] + place of the tile in the splat's rectangle of tiles), so
that backward finds all gradient rows of a splat side by side, whatever thread wrote them.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from genmojo_core.errors import GenmojoError
from genmojo_core.kernels.buffers import take
from genmojo_core.kernels.cache import inlined, kernel
from genmojo_core.kernels.scalars import larger, smaller
from genmojo_core.kernels.simd import prefetch
from genmojo_core.kernels.threads import get_threads, run_ranges
from genmojo_core.render.cpu.project import GEOMETRY, Ellipses, Lens

TILE = 16  # pixels
SHIFT = 4  # TILE as a power of two
ENTRY_LIMIT = 2**24  # entries of one view: 1 GiB of gradient rows
FEW = 2**16  # entries
RADIX_BITS, DIGITS = 11, 3  # 33 bits
AHEAD = 8  # splats


class Bins(NamedTuple):
    """Splats of one view by depth and by tile. M drawn splats, E entries, T tiles (row by row)."""

    order: np.ndarray  # (M,) int64 index of the splat at each rank
    box: np.ndarray  # (M, 4) int32 as in Ellipses, by rank
    first_slot: np.ndarray  # (M + 1,) int64
    tile_start: np.ndarray  # (T + 1,) int64 first entry of each tile
    rank: np.ndarray  # (E,) int32 splat of the entry
    slot: np.ndarray  # (E,) int32 gradient row of the entry
    tiles_x: int
    tiles_y: int


def depth_order(depth: np.ndarray, box: np.ndarray) -> np.ndarray:
    """Indices of the splats that are drawn, by rising depth, ties by index: LSD radix sort of the float's bits.

    Depths are positive, so their bits as unsigned integers rise with them.
    """
    order, other = take(depth.shape, np.int64), take(depth.shape, np.int64)
    starts = np.zeros((DIGITS, (1 << RADIX_BITS) + 1), np.int64)
    return other[: sort_drawn(depth.view(np.uint32), box, starts, order, other)]


@inlined
def digit(key: np.uint32, place: int) -> np.int64:
    """One digit of a key."""
    return (np.int64(key) >> (place * RADIX_BITS)) & ((1 << RADIX_BITS) - 1)


@kernel
def sort_drawn(keys: np.ndarray, box: np.ndarray, starts: np.ndarray, order: np.ndarray, other: np.ndarray) -> int:
    """Fill `other` with the drawn splats by rising key, stably, and return their number; `order` is spoilt.

    starts: (DIGITS, digits + 1) int64, zero on entry. DIGITS is odd, so the last pass ends in `other`.
    """
    count = 0
    for i in range(box.shape[0]):
        if box[i, 0] <= box[i, 1]:
            order[count] = i
            count += 1
            for place in range(DIGITS):
                starts[place, digit(keys[i], place) + 1] += 1
    for place in range(DIGITS):
        for value in range(starts.shape[1] - 1):
            starts[place, value + 1] += starts[place, value]
        for k in range(count):
            i = order[k] if place & 1 == 0 else other[k]
            value = digit(keys[i], place)
            if place & 1 == 0:
                other[starts[place, value]] = i
            else:
                order[starts[place, value]] = i
            starts[place, value] += 1
    return count


@kernel
def gather(start: int, stop: int, order: np.ndarray, ellipses: Ellipses, source: tuple, records: np.ndarray) -> None:
    """Copy ranks start..stop-1 into depth order: records (M, 6 + slots) float32.

    Slot 0 holds the depth. source = features (N, C) float32, and the feature (slots,) int64 of each slot, -1: zero.
    """
    features, columns = source
    for rank in range(start, stop):
        coming = order[smaller(rank + AHEAD, stop - 1)]
        prefetch(ellipses.geometry, GEOMETRY * coming)
        prefetch(features, features.shape[1] * coming)
        i = order[rank]
        for k in range(GEOMETRY):
            records[rank, k] = ellipses.geometry[i, k]
        records[rank, GEOMETRY] = ellipses.depth[i]
        for k in range(1, columns.size):
            records[rank, GEOMETRY + k] = features[i, columns[k]] if columns[k] >= 0 else np.float32(0)


@inlined
def _tiles(box: np.ndarray, rank: int) -> tuple:
    """First and last tile column, first and last tile row of a splat."""
    return box[rank, 0] >> SHIFT, box[rank, 1] >> SHIFT, box[rank, 2] >> SHIFT, box[rank, 3] >> SHIFT


@kernel
def count_slots(box: np.ndarray, first_slot: np.ndarray) -> tuple:
    """Fill first_slot (M + 1,) int64; the number of all entries and the rank of the widest splat."""
    first_slot[0] = 0
    worst, most = 0, 0
    for rank in range(box.shape[0]):
        x0, x1, y0, y1 = _tiles(box, rank)
        tiles = (x1 - x0 + 1) * (y1 - y0 + 1)
        first_slot[rank + 1] = first_slot[rank] + tiles
        if tiles > most:
            worst, most = rank, tiles
    return first_slot[box.shape[0]], worst


@kernel
def count_entries(first: int, stop: int, box: np.ndarray, tiles_x: int, tile_start: np.ndarray) -> None:
    """Count the entries of every tile in tile rows first..stop-1 into tile_start (T + 1,) int64, zero on entry."""
    for rank in range(box.shape[0]):
        x0, x1, y0, y1 = _tiles(box, rank)
        for y in range(larger(y0, first), smaller(y1 + 1, stop)):
            for x in range(x0, x1 + 1):
                tile_start[y * tiles_x + x + 1] += 1


@kernel
def scatter_entries(first: int, stop: int, bins: Bins, following: np.ndarray) -> None:
    """Fill rank and slot of the entries in tile rows first..stop-1, tile by tile in depth order.

    following (T,): a copy of tile_start.
    """
    for rank in range(bins.box.shape[0]):
        x0, x1, y0, y1 = _tiles(bins.box, rank)
        for y in range(larger(y0, first), smaller(y1 + 1, stop)):
            slot = bins.first_slot[rank] + (y - y0) * (x1 - x0 + 1)
            for x in range(x0, x1 + 1):
                entry = following[y * bins.tiles_x + x]
                following[y * bins.tiles_x + x] = entry + 1
                bins.rank[entry] = rank
                bins.slot[entry] = slot
                slot += 1


def bin_splats(lens: Lens, order: np.ndarray, box: np.ndarray) -> Bins:
    """The bins of M splats by depth: order (M,) int64, box (M, 4) int32 by rank.

    Raises GenmojoError("budget") where splats cover so many tiles that the gradients would not fit into memory.
    """
    tiles_x, tiles_y = -(-lens.width // TILE), -(-lens.height // TILE)
    first_slot = take((len(order) + 1,), np.int64)
    entries, worst = count_slots(box, first_slot)
    if entries > ENTRY_LIMIT:
        tiles = int(first_slot[worst + 1] - first_slot[worst])
        raise GenmojoError(
            "budget",
            f"{len(order)} splats cover {entries} tiles of a {lens.width} x {lens.height} image, the limit is"
            f" {ENTRY_LIMIT}; the widest is splat {int(order[worst])} with {tiles} tiles",
            "rasteriser",
            "remove or shrink splats that fill the view, or render a smaller image",
        )
    tile_start = np.zeros(tiles_x * tiles_y + 1, np.int64)
    # Every thread walks all splats, for a band of tile rows; few entries are done before another thread has woken.
    band = -(-tiles_y // (get_threads() if entries > FEW else 1))
    run_ranges(lambda a, b: count_entries(a, b, box, tiles_x, tile_start), tiles_y, band)
    np.cumsum(tile_start, out=tile_start)
    rank, slot = take((entries,), np.int32), take((entries,), np.int32)
    bins = Bins(order, box, first_slot, tile_start, rank, slot, tiles_x, tiles_y)
    following = tile_start.copy()
    run_ranges(lambda a, b: scatter_entries(a, b, bins, following), tiles_y, band)
    return bins
