"""The CPU rasteriser on numpy arrays: project -> bins -> forward, and backward -> project_backward.

`rasterize` draws. `draw` also returns what `backward` needs. Features beyond 15 are drawn in further passes over the
same bins; their contributions to the geometry's gradient add up.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from genmojo_core.clip.cameras import View
from genmojo_core.errors import GenmojoError
from genmojo_core.kernels.buffers import take, zeros
from genmojo_core.kernels.threads import run_jobs, run_ranges, scratch
from genmojo_core.render.cpu.backward import Slopes, slope_floats, slope_tiles
from genmojo_core.render.cpu.bins import TILE, Bins, bin_splats, depth_order, gather
from genmojo_core.render.cpu.forward import (
    LANES,
    MARKS,
    Drawing,
    draw_tiles,
    drawing_floats,
    state_floats,
)
from genmojo_core.render.cpu.project import GEOMETRY, Cloud, Ellipses, Lens, lens_of, project_range
from genmojo_core.render.cpu.project_backward import MOMENTS, SCRATCH, Gradients, Sums, gather_gradients
from genmojo_core.render.rasterizer import Rendering, Splats

MAX_SLOTS = 16  # channels of one pass, depth included
SPLATS_PER_JOB, SPLAT_JOBS = 2048, 8
COPIES_PER_JOB = 2**14  # splats: fewer are copied before another thread has woken
ROWS_PER_JOB = 64


@dataclass(frozen=True)
class Layout:
    """Where the features of one pass lie among its slots.

    Slot 0 is depth, then one empty slot if that makes the attached ones even, the attached features, the detached ones,
    and again an empty one up to an even number. So all features lie side by side.
    """

    attached: range  # columns of the features
    detached: range

    @property
    def attached_slots(self) -> int:
        """Depth and attached features, rounded up to even."""
        return _even(1 + len(self.attached))

    @property
    def slots(self) -> int:
        """All slots of the pass."""
        return self.attached_slots + _even(len(self.detached))

    def columns(self) -> list[tuple[slice, slice]]:
        """(columns of the features, slots) pairs."""
        pairs = []
        for columns, first in (
            (self.attached, self.attached_slots - len(self.attached)),
            (self.detached, self.attached_slots),
        ):
            if len(columns):
                pairs.append((slice(columns.start, columns.stop), slice(first, first + len(columns))))
        return pairs

    def feature_slots(self) -> slice:
        """Where all features lie, in their order."""
        first = self.attached_slots - len(self.attached)
        return slice(first, first + len(self.attached) + len(self.detached))

    def feature_of_slot(self) -> np.ndarray:
        """(slots,) int64 column of the features in each slot, -1 for depth and empty slots."""
        found = np.full(self.slots, -1, np.int64)
        for columns, places in self.columns():
            found[places] = np.arange(columns.start, columns.stop)
        return found


@dataclass
class Pass:
    """One pass over the tiles: layout, kernel arguments, planes (1 + slots, padded height, padded width)."""

    layout: Layout
    drawing: Drawing
    planes: np.ndarray


@dataclass
class Drawn:
    """A picture and what its backward pass needs."""

    lens: Lens
    cloud: Cloud
    bins: Bins
    features: int
    passes: list[Pass] = field(default_factory=list)

    def rendering(self) -> Rendering[np.ndarray]:
        """Views into the planes: features (H, W, C), depth (H, W), alpha (H, W), float32."""
        height, width = self.lens.height, self.lens.width
        first = self.passes[0].planes[:, :height, :width]
        planes = []
        for one in self.passes:
            slots = one.layout.feature_slots()
            planes.append(one.planes[1 + slots.start : 1 + slots.stop, :height, :width])
        features = planes[0] if len(planes) == 1 else np.concatenate(planes)
        return Rendering(features.transpose(1, 2, 0), first[1], first[0])


def rasterize(splats: Splats[np.ndarray], view: View) -> Rendering[np.ndarray]:
    """Draw splats; semantics in render/rasterizer.py, arrays of any float dtype in, float32 out.

    At the edges: no splat, or none in view, gives zeros. Raises GenmojoError("schema") for shapes that do not fit and
    GenmojoError("budget") where splats cover too many tiles (bins.py).
    """
    return draw(splats, view).rendering()


def draw(
    splats: Splats[np.ndarray], view: View, *, detached_channels: int = 0, pose: np.ndarray | None = None
) -> Drawn:
    """Draw splats and keep what `backward` needs.

    Args:
        splats: as in render/rasterizer.py.
        view: the camera; `pose` (4, 4) takes the place of its world_to_camera.
        detached_channels: that many last feature channels give gradient to the features only.
    """
    cloud, features = _checked(splats)
    lens = lens_of(view, pose)
    ellipses = Ellipses(
        take((len(features), GEOMETRY)),
        take((len(features),)),
        take((len(features), 4), np.int32),
    )
    run_ranges(lambda a, b: project_range(a, b, lens, cloud, ellipses), len(features), _splat_chunk(len(features)))
    order = depth_order(ellipses.depth, ellipses.box)
    box = np.take(ellipses.box, order, axis=0, out=take((len(order), 4), np.int32), mode="clip")
    bins = bin_splats(lens, order, box)
    drawn = Drawn(lens, cloud, bins, features.shape[1])
    for layout in layouts(features.shape[1], detached_channels):
        drawn.passes.append(_draw_pass(drawn, layout, ellipses, features))
    return drawn


def backward(
    drawn: Drawn, upstream: Rendering[np.ndarray], *, with_pose: bool = False
) -> tuple[Splats[np.ndarray], np.ndarray]:
    """Gradients of sum(upstream * rendering): for the splats (float32) and for the pose (4, 4) float64.

    The pose's gradient is 0 unless `with_pose`.
    """
    count = len(drawn.cloud.means)
    jobs = -(-len(drawn.bins.order) // _splat_chunk(len(drawn.bins.order)))
    out = Gradients(
        zeros((count, 3)),
        zeros((count, 4)),
        zeros((count, 3)),
        zeros((count,)),
        zeros((count, drawn.features)),
        np.zeros((jobs if with_pose else 0, 12)),
    )
    for index, one in enumerate(drawn.passes):
        _add_gradients(drawn, one, upstream, out, first=index == 0)
    pose = np.zeros((4, 4))
    pose[:3] = out.pose.sum(axis=0).reshape(3, 4)
    return Splats(out.means, out.quats, out.scales, out.opacities, out.features), pose


def layouts(features: int, detached: int) -> list[Layout]:
    """Passes for that many feature channels of which the last `detached` are detached."""
    if not 0 <= detached <= features:
        raise GenmojoError("argument", f"detached_channels is {detached} of {features} channels", "rasteriser")
    attached = features - detached
    if Layout(range(attached), range(attached, features)).slots <= MAX_SLOTS:
        return [Layout(range(attached), range(attached, features))]
    step = MAX_SLOTS - 1
    found = [Layout(range(i, min(i + step, attached)), range(0)) for i in range(0, attached, step)]
    found = found or [Layout(range(0), range(0))]
    step = MAX_SLOTS - 2
    found += [Layout(range(0), range(i, min(i + step, features))) for i in range(attached, features, step)]
    return found


def _draw_pass(drawn: Drawn, layout: Layout, ellipses: Ellipses, features: np.ndarray) -> Pass:
    """Blend the features of one pass."""
    bins, lens = drawn.bins, drawn.lens
    count, slots = len(bins.order), layout.slots
    records = take((count * (GEOMETRY + slots) + LANES,))  # the tile kernels copy eight at a time, over the end
    table = records[:-LANES].reshape(count, GEOMETRY + slots)
    source = (features, layout.feature_of_slot())
    run_ranges(lambda a, b: gather(a, b, bins.order, ellipses, source, table), count, COPIES_PER_JOB)
    planes = take((1 + slots, bins.tiles_y * TILE, bins.tiles_x * TILE))
    tiles = bins.tiles_x * bins.tiles_y
    hits = zeros((len(bins.rank),), np.uint32)
    drawing = Drawing(
        records, slots, state_floats(slots), layout.attached_slots, planes.ravel(), hits, lens.width, lens.height
    )  # fmt: skip
    floats = drawing_floats(slots)
    run_ranges(lambda a, b: draw_tiles(a, b, drawing, bins, *room(floats, MARKS)), tiles, _tile_chunk(bins))
    return Pass(layout, drawing, planes)


def _add_gradients(
    drawn: Drawn, one: Pass, upstream: Rendering[np.ndarray], out: Gradients, *, first: bool
) -> None:  # fmt: skip
    """Add the gradients of one pass to `out`; depth and alpha count in the first pass only."""
    bins, layout = drawn.bins, one.layout
    planes = take(one.planes.shape)
    run_ranges(lambda a, b: _fill(planes, (a, b), drawn, layout, upstream, first), planes.shape[1], ROWS_PER_JOB)
    row = -(-(MOMENTS + layout.slots) // 8) * 8
    slopes = Slopes(planes.ravel(), take((len(bins.rank) * row,)), row)
    tiles = bins.tiles_x * bins.tiles_y
    floats = slope_floats(layout.slots)
    run_ranges(lambda a, b: slope_tiles(a, b, one.drawing, bins, slopes, scratch(floats)), tiles, _tile_chunk(bins))
    ranks = len(bins.order)
    chunk = _splat_chunk(ranks)
    sums, scene = Sums(slopes.rows, row, one.drawing.hits, layout.feature_of_slot()), (drawn.lens, drawn.cloud)

    def job(index: int) -> None:
        span = (index * chunk, min((index + 1) * chunk, ranks))
        gather_gradients(index, span, bins, scene, sums, out, scratch(SCRATCH))

    run_jobs(job, -(-ranks // chunk))


def _fill(
    planes: np.ndarray,
    rows: tuple[int, int],
    drawn: Drawn,
    layout: Layout,
    upstream: Rendering[np.ndarray],
    first: bool,
) -> None:
    """Rows of the planes of a pass's upstream gradients: 0 outside the picture and in empty slots."""
    width, slots = drawn.lens.width, layout.feature_slots()
    band, inside = planes[:, rows[0] : rows[1]], slice(rows[0], min(rows[1], drawn.lens.height))
    height = max(inside.stop - inside.start, 0)
    band[:, height:] = 0
    band[:, :height, width:] = 0
    band[2 if first else 0 : 1 + slots.start] = 0
    band[1 + slots.stop :] = 0
    if first:
        band[0, :height, :width] = upstream.alpha[inside]
        band[1, :height, :width] = upstream.depth[inside]
    features = np.moveaxis(np.asarray(upstream.features)[inside], 2, 0)
    for columns, places in layout.columns():
        band[1 + places.start : 1 + places.stop, :height, :width] = features[columns]


def room(floats: int, marks: int) -> tuple[np.ndarray, np.ndarray]:
    """The calling thread's scratch for a tile kernel: (floats,) float32 and (marks,) int64."""
    whole = scratch(2 * marks + floats)
    return whole[2 * marks :], whole[: 2 * marks].view(np.int64)


def _splat_chunk(count: int) -> int:
    """Splats per job: as many jobs as several threads can share evenly, few where there is little to do."""
    return min(SPLATS_PER_JOB, max(SPLATS_PER_JOB // SPLAT_JOBS, -(-count // SPLAT_JOBS)))


def _tile_chunk(bins: Bins) -> int:
    """Tiles per job: about 32 jobs, so that threads end together."""
    return max(1, bins.tiles_x * bins.tiles_y // 32)


def _even(number: int) -> int:
    """Rounded up to an even number."""
    return number + number % 2


def _checked(splats: Splats[np.ndarray]) -> tuple[Cloud, np.ndarray]:
    """Splats as contiguous float32 arrays of matching shapes, or GenmojoError("schema")."""
    count = len(splats.means)
    wanted = {"means": (count, 3), "quats": (count, 4), "scales": (count, 3), "opacities": (count,)}
    arrays = []
    for name, shape in wanted.items():
        array = np.require(getattr(splats, name), np.float32, ["C", "W"])  # writable: kernels know one kind of array
        if array.shape != shape:
            raise GenmojoError("schema", f"{name} has shape {array.shape}, expected {shape}", "rasteriser")
        arrays.append(array)
    features = np.require(splats.features, np.float32, ["C", "W"])
    if features.ndim != 2 or len(features) != count:
        raise GenmojoError("schema", f"features have shape {features.shape}, expected ({count}, C)", "rasteriser")
    return Cloud(*arrays), features
