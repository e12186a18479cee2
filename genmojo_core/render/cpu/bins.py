"""Which splats touch which tile, in depth order, without sorting (tile, depth) pairs.

The splats drawn are sorted once by depth (`rank` = place in that order); a counting sort by tile that walks the ranks
upwards is stable, so every tile lists its splats front to back. An entry is one splat on one tile. Its `slot` counts
the tiles of a splat one after the other (first_slot[rank] + place of the tile in the splat's rectangle of tiles), so
that backward finds all gradient rows of a splat side by side, whatever thread wrote them.

Two stages: one thread sorts while another counts the entries of the tiles, which asks for no order; then some threads
hand the entries out, each in a band of tile rows, while others copy the records into depth order.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from genmojo_core.errors import GenmojoError
from genmojo_core.kernels.buffers import take_together
from genmojo_core.kernels.cache import inlined
from genmojo_core.kernels.scalars import larger, smaller
from genmojo_core.kernels.simd import prefetch
from genmojo_core.kernels.stage import Stage, begin, claim, meet
from genmojo_core.render.cpu.project import DRAWN, ENTRIES, GEOMETRY, SHIFT, TILE, Ellipses, Lens

ENTRY_LIMIT = 2**24  # entries of one view: 1 GiB of gradient rows
RADIX_BITS, DIGITS = 11, 3  # 33 bits
AHEAD = 8  # splats
SORT, COUNT, HALVES = 0, 1, 2  # the pieces of the first stage, and how many they are


class Bins(NamedTuple):
    """Splats of one view by depth and by tile. M drawn splats, E entries, T tiles (row by row)."""

    order: np.ndarray  # (M,) int64 index of the splat at each rank
    rank_of: np.ndarray  # (N,) int32 the other way round, -1 for splats that are not drawn
    box: np.ndarray  # (M, 4) int32 as in Ellipses, by rank
    first_slot: np.ndarray  # (M + 1,) int64
    tile_start: np.ndarray  # (T + 1,) int64 first entry of each tile
    rank: np.ndarray  # (E,) int32 splat of the entry
    slot: np.ndarray  # (E,) int32 gradient row of the entry
    entry: np.ndarray  # (E,) int32 the other way round: entry of each gradient row
    tiles_x: int
    tiles_y: int


class Sorting(NamedTuple):
    """What binning needs besides the bins."""

    keys: np.ndarray  # (N,) uint32 bits of the depths
    other: np.ndarray  # (M,) int64 of any content
    starts: np.ndarray  # (DIGITS, digits + 1) int64, zero at first
    following: np.ndarray  # (T,) int64: the entry of each tile that is handed out next


class Records(NamedTuple):
    """What a pass reads of the splats, by rank, and where it comes from."""

    features: np.ndarray  # (N, C) float32
    columns: np.ndarray  # (slots,) int64: the feature of each slot, -1: zero; the first is depth's
    table: np.ndarray  # (M, 6 + slots) float32


class Pieces(NamedTuple):
    """The second stage's pieces: so many bands of tile rows to scatter come first, then ranks to gather."""

    bands: int
    rows: int  # of tiles in a band
    ranks: int  # of a piece


def empty_bins(lens: Lens, ellipses: Ellipses) -> tuple[Bins, Sorting]:
    """Arrays for the splats that a view has, still to be filled: tile_start is 0, the rest of any content.

    Raises GenmojoError("budget") where splats cover so many tiles that the gradients would not fit into memory.
    """
    drawn, entries = int(ellipses.totals[DRAWN]), int(ellipses.totals[ENTRIES])
    if entries > ENTRY_LIMIT:
        first_x, last_x, first_y, last_y = (ellipses.box.astype(np.int64) >> SHIFT).T
        seen = ellipses.box[:, 0] <= ellipses.box[:, 1]
        tiles = np.where(seen, (last_x - first_x + 1) * (last_y - first_y + 1), 0)
        raise GenmojoError(
            "budget",
            f"{drawn} splats cover {entries} tiles of a {lens.width} x {lens.height} image, the limit is"
            f" {ENTRY_LIMIT}; the widest is splat {tiles.argmax()} with {tiles.max()} tiles",
            "rasteriser",
            "remove or shrink splats that fill the view, or render a smaller image",
        )
    tiles_x, tiles_y = -(-lens.width // TILE), -(-lens.height // TILE)
    order, other, first_slot, rank_of, box, rank, slot, entry, _ = take_together(
        ((drawn,), np.int64), ((drawn,), np.int64), ((drawn + 1,), np.int64), (ellipses.depth.shape, np.int32),
        ((drawn, 4), np.int32), ((entries,), np.int32), ((entries,), np.int32), ((entries,), np.int32),
    )  # fmt: skip
    start = np.zeros(tiles_x * tiles_y + 1, np.int64)
    starts = np.zeros((DIGITS, (1 << RADIX_BITS) + 1), np.int64)
    following = np.empty(tiles_x * tiles_y, np.int64)
    bins = Bins(order, rank_of, box, first_slot, start, rank, slot, entry, tiles_x, tiles_y)
    return bins, Sorting(ellipses.depth.view(np.uint32), other, starts, following)


@inlined
def digit(key: np.uint32, place: int) -> np.int64:
    """One digit of a key."""
    return (np.int64(key) >> (place * RADIX_BITS)) & ((1 << RADIX_BITS) - 1)


@inlined
def sort_drawn(box: np.ndarray, sorting: Sorting, order: np.ndarray) -> None:
    """Fill `order` with the drawn splats by rising depth, ties by index: LSD radix sort of the float's bits.

    Depths are positive, so their bits as unsigned integers rise with them. DIGITS is odd: the last pass ends in
    `order`.
    """
    other, starts, count = sorting.other, sorting.starts, 0
    for i in range(box.shape[0]):
        if box[i, 0] <= box[i, 1]:
            other[count] = i
            count += 1
            for place in range(DIGITS):
                starts[place, digit(sorting.keys[i], place) + 1] += 1
    for place in range(DIGITS):
        for value in range(starts.shape[1] - 1):
            starts[place, value + 1] += starts[place, value]
        for k in range(count):
            i = other[k] if place & 1 == 0 else order[k]
            value = digit(sorting.keys[i], place)
            if place & 1 == 0:
                order[starts[place, value]] = i
            else:
                other[starts[place, value]] = i
            starts[place, value] += 1


@inlined
def _tiles(box: np.ndarray, row: int) -> tuple:
    """First and last tile column, first and last tile row of a splat."""
    return box[row, 0] >> SHIFT, box[row, 1] >> SHIFT, box[row, 2] >> SHIFT, box[row, 3] >> SHIFT


@inlined
def count_slots(box: np.ndarray, bins: Bins) -> None:
    """Copy the boxes into depth order, count their tiles into first_slot, and fill rank_of."""
    bins.first_slot[0] = 0
    for i in range(box.shape[0]):
        bins.rank_of[i] = -1
    for rank in range(bins.order.size):
        i = bins.order[rank]
        bins.rank_of[i] = rank
        prefetch(box, 4 * bins.order[smaller(rank + AHEAD, bins.order.size - 1)])
        for k in range(4):
            bins.box[rank, k] = box[i, k]
        x0, x1, y0, y1 = _tiles(bins.box, rank)
        bins.first_slot[rank + 1] = bins.first_slot[rank] + (x1 - x0 + 1) * (y1 - y0 + 1)


@inlined
def count_entries(box: np.ndarray, bins: Bins, following: np.ndarray) -> None:
    """The first entry of every tile, into tile_start and `following`."""
    start = bins.tile_start
    for i in range(box.shape[0]):
        if box[i, 0] <= box[i, 1]:
            x0, x1, y0, y1 = _tiles(box, i)
            for y in range(y0, y1 + 1):
                for x in range(x0, x1 + 1):
                    start[y * bins.tiles_x + x + 1] += 1
    for tile in range(following.size):
        following[tile] = start[tile]
        start[tile + 1] += start[tile]


@inlined
def sort_and_count(stage: Stage, box: np.ndarray, bins: Bins, sorting: Sorting) -> int:
    """The first stage of binning, its pieces SORT and COUNT."""
    begin(stage)
    piece = claim(stage)
    while piece < stage.size:
        if piece == SORT:
            sort_drawn(box, sorting, bins.order)
            count_slots(box, bins)
        if piece == COUNT:
            count_entries(box, bins, sorting.following)
        piece = claim(stage)
    return meet(stage)


@inlined
def scatter_entries(first: int, stop: int, bins: Bins, following: np.ndarray) -> None:
    """Fill rank and slot of the entries, and entry, in tile rows first..stop-1, tile by tile in depth order."""
    for rank in range(bins.box.shape[0]):
        x0, x1, y0, y1 = _tiles(bins.box, rank)
        for y in range(larger(y0, first), smaller(y1 + 1, stop)):
            slot = bins.first_slot[rank] + (y - y0) * (x1 - x0 + 1)
            for x in range(x0, x1 + 1):
                entry = following[y * bins.tiles_x + x]
                following[y * bins.tiles_x + x] = entry + 1
                bins.rank[entry] = rank
                bins.slot[entry] = slot
                bins.entry[slot] = entry
                slot += 1


@inlined
def gather(start: int, stop: int, bins: Bins, ellipses: Ellipses, records: Records) -> None:
    """Copy ranks start..stop-1 into depth order; slot 0 holds the depth."""
    features, columns = records.features, records.columns
    for rank in range(start, stop):
        coming = bins.order[smaller(rank + AHEAD, stop - 1)]
        prefetch(ellipses.geometry, GEOMETRY * coming)
        prefetch(features, features.shape[1] * coming)
        i = bins.order[rank]
        for k in range(GEOMETRY):
            records.table[rank, k] = ellipses.geometry[i, k]
        records.table[rank, GEOMETRY] = ellipses.depth[i]
        for k in range(1, columns.size):
            records.table[rank, GEOMETRY + k] = features[i, columns[k]] if columns[k] >= 0 else np.float32(0)


@inlined
def scatter_and_gather(
    stage: Stage, pieces: Pieces, bins: Bins, following: np.ndarray, ellipses: Ellipses, records: Records
) -> int:
    """The second stage of binning, a piece at a time. following: `Sorting.following`."""
    begin(stage)
    piece = claim(stage)
    while piece < stage.size:
        if piece < pieces.bands:
            scatter_entries(piece * pieces.rows, (piece + 1) * pieces.rows, bins, following)
        else:
            start = (piece - pieces.bands) * pieces.ranks
            gather(start, smaller(start + pieces.ranks, bins.order.size), bins, ellipses, records)
        piece = claim(stage)
    return meet(stage)
