"""The loss's gradients with respect to a picture, brought into the padded planes that the tile kernels read."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from genmojo_core.kernels.cache import inlined, kernel
from genmojo_core.kernels.scalars import smaller
from genmojo_core.kernels.simd import load8, splat8, store8
from genmojo_core.kernels.stage import Stage, begin, claim, meet
from genmojo_core.render.cpu.project import TILE
from genmojo_core.render.rasterizer import Rendering

LANES = 8


class Upstream(NamedTuple):
    """Gradients as they came, in any order in memory: each as all its memory, flat float32, and its steps there."""

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
    nothing = np.broadcast_to(np.zeros(1, np.float32), gradients.alpha.shape)
    arrays = (
        gradients.alpha if first else nothing,
        gradients.depth if first else nothing,
        gradients.features,
    )
    steps, flat = np.zeros((3, 3), np.int64), []
    for k, array in enumerate(arrays):
        values = np.asarray(array, np.float32)
        if not values.size:
            values = np.zeros((1,) * values.ndim, np.float32)
        if min(values.strides) < 0 or any(s % 4 for s in values.strides):
            values = np.ascontiguousarray(values)
        steps[k, : values.ndim] = [s // 4 for s in values.strides]
        reach = 1 + sum((n - 1) * int(s) for n, s in zip(values.shape, steps[k], strict=False))
        memory = np.lib.stride_tricks.as_strided(values, (reach,), (4,))
        flat.append(memory if memory.flags.writeable else memory.copy())  # kernels know one kind of array
    return Upstream(flat[0], flat[1], flat[2], steps)


@inlined
def spread_plane(source: np.ndarray, start: int, steps: np.ndarray, planes: Planes, place: int, rows: int) -> None:
    """Fill TILE rows of a plane from `place` on: `rows` of the source from `start` on, and 0 around them."""
    for y in range(TILE):
        at, here, x = place + y * planes.pitch, start + y * steps[0], 0
        columns = planes.columns if y < rows else 0
        if steps[1] == 1:
            while x + LANES <= columns:
                store8(planes.values, at + x, load8(source, here + x))
                x += LANES
        while x < columns:
            planes.values[at + x] = source[here + x * steps[1]]
            x += 1
        while x < planes.pitch:
            planes.values[at + x] = 0
            x += 1


@inlined
def clear_share(values: np.ndarray, share: int, shares: int) -> None:
    """Set one of equal shares of a flat float32 array to 0."""
    size = -(-values.size // (LANES * shares)) * LANES
    i, end = share * size, smaller((share + 1) * size, values.size)
    while i + LANES <= end:
        store8(values, i, splat8(np.float32(0)))
        i += LANES
    while i < end:
        values[i] = 0
        i += 1


@kernel
def spread_upstream(stage: Stage, upstream: Upstream, planes: Planes, gradients: np.ndarray) -> None:
    """Fill the planes, row of tiles by row of tiles, and clear the gradients that are added to later."""
    begin(stage)
    size = planes.height * planes.pitch
    piece = claim(stage)
    while piece < stage.size:
        top = piece * TILE
        rows, place, steps = smaller(planes.rows - top, TILE), top * planes.pitch, upstream.steps
        spread_plane(upstream.alpha, top * steps[0, 0], steps[0], planes, place, rows)
        for c in range(1, planes.features.size):
            feature = planes.features[c]
            if feature >= 0:
                start = top * steps[2, 0] + feature * steps[2, 2]
                spread_plane(upstream.features, start, steps[2], planes, c * size + place, rows)
            else:
                spread_plane(upstream.depth, top * steps[1, 0], steps[1], planes, c * size + place, rows * (c == 1))
        clear_share(gradients, piece, stage.size)
        piece = claim(stage)
    meet(stage)
