"""The loss's gradients with respect to a picture, brought into the padded planes that the tile kernels read."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from genmojo_core.kernels.cache import inlined
from genmojo_core.kernels.lane_bits import gather8
from genmojo_core.kernels.scalars import smaller
from genmojo_core.kernels.simd import load8, splat8, store8
from genmojo_core.kernels.stage import Stage, begin, claim, meet
from genmojo_core.render.cpu.project import TILE
from genmojo_core.render.rasterizer import Rendering

LANES = 8


class Upstream(NamedTuple):
    """Gradients, each as all its memory, flat float32, and its steps there; of one number where there are none."""

    alpha: np.ndarray
    depth: np.ndarray
    features: np.ndarray
    steps: np.ndarray  # (3, 3) int64: of alpha, depth, features from row to row, column to column, channel to channel


class Planes(NamedTuple):
    """Padded planes of one pass: alpha, then slots."""

    values: np.ndarray  # (planes * height * pitch,) float32
    features: np.ndarray  # (planes,) int64: the feature in each, -1: none; of depth and alpha -1 as well
    height: int  # with padding, like pitch a multiple of TILE
    pitch: int
    rows: int  # of the picture
    columns: int


def upstream_of(gradients: Rendering[np.ndarray], *, first: bool) -> Upstream:
    """The gradients of one pass; depth and alpha count in the first only, and are 0 in the others."""
    steps, flat = np.zeros((3, 3), np.int64), []
    for k, array in enumerate((gradients.alpha, gradients.depth, gradients.features)):
        if array.size and (first or k == 2):
            values = array if _is_plain(array) else np.require(array, np.float32, ["C", "W"])
            steps[k, : values.ndim] = [step // values.itemsize for step in values.strides]
            flat.append(values.ravel("K"))
        else:
            flat.append(np.zeros(1, np.float32))
    return Upstream(flat[0], flat[1], flat[2], steps)


def _is_plain(array: np.ndarray) -> bool:
    """Float32 without gaps, its channels together or each by itself; writable: kernels know one kind of array."""
    flags = array.flags
    together = flags.c_contiguous or (array.ndim == 3 and array.transpose(2, 0, 1).flags.c_contiguous)
    return bool(together and flags.writeable and flags.aligned and array.dtype == np.float32)


@inlined
def spread_row(source: np.ndarray, start: int, step: int, target: np.ndarray, at: int, columns: int) -> None:
    """Copy one row of one channel: `columns` numbers that lie `step` apart from `start` on."""
    end = at + columns
    while at + LANES <= end:
        store8(target, at, load8(source, start) if step == 1 else gather8(source, start, step))
        at += LANES
        start += LANES * step
    while at < end:
        target[at] = source[start]
        at += 1
        start += step


@inlined
def clear(values: np.ndarray, i: int, end: int) -> None:
    """Set elements i..end-1 of a flat float32 array to 0."""
    while i + LANES <= end:
        store8(values, i, splat8(np.float32(0)))
        i += LANES
    while i < end:
        values[i] = 0
        i += 1


@inlined
def spread_line(y: int, upstream: Upstream, planes: Planes) -> None:
    """Fill row y of all planes: channels of a row lie close together, rows do not."""
    steps, size, at = upstream.steps, planes.height * planes.pitch, y * planes.pitch
    columns = planes.columns if y < planes.rows else 0
    spread_row(upstream.alpha, y * steps[0, 0], steps[0, 1], planes.values, at, columns)
    clear(planes.values, at + columns, at + planes.pitch)
    for c in range(1, planes.features.size):
        feature, place = planes.features[c], c * size + at
        filled = columns if c == 1 or feature >= 0 else 0
        if feature >= 0:
            start = y * steps[2, 0] + feature * steps[2, 2]
            spread_row(upstream.features, start, steps[2, 1], planes.values, place, filled)
        else:
            spread_row(upstream.depth, y * steps[1, 0], steps[1, 1], planes.values, place, filled)
        clear(planes.values, place + filled, place + planes.pitch)


@inlined
def spread_upstream(stage: Stage, upstream: Upstream, planes: Planes, gradients: np.ndarray) -> int:
    """Fill the planes, a row of tiles per piece, and clear the gradients that are added to later, a share per piece."""
    begin(stage)
    share = -(-gradients.size // (LANES * stage.size)) * LANES
    piece = claim(stage)
    while piece < stage.size:
        for y in range(piece * TILE, (piece + 1) * TILE):
            spread_line(y, upstream, planes)
        clear(gradients, piece * share, smaller((piece + 1) * share, gradients.size))
        piece = claim(stage)
    return meet(stage)
