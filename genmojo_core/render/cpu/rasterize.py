"""The CPU rasteriser on numpy arrays: project -> bins -> forward, and upstream -> backward -> project_backward.

`rasterize` draws. `draw` also returns what `backward` needs. Features beyond 15 are drawn in further passes over the
same bins; their contributions to the geometry's gradient add up.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property, lru_cache

import numpy as np

from genmojo_core.clip.cameras import View
from genmojo_core.errors import GenmojoError
from genmojo_core.kernels.buffers import take, take_together
from genmojo_core.kernels.team import Team
from genmojo_core.kernels.threads import scratch
from genmojo_core.render.cpu.backward import Slopes, slope_floats
from genmojo_core.render.cpu.bins import (
    HALVES,
    Bins,
    Pieces,
    Records,
    Sorting,
    empty_bins,
)
from genmojo_core.render.cpu.forward import (
    LANES,
    MARKS,
    Drawing,
    drawing_floats,
    state_floats,
)
from genmojo_core.render.cpu.passes import bin_and_draw, find_gradients
from genmojo_core.render.cpu.project import GEOMETRY, TILE, Cloud, Ellipses, Lens, lens_of, project_splats
from genmojo_core.render.cpu.project_backward import MOMENTS, SCRATCH, Gradients, Sums
from genmojo_core.render.cpu.upstream import Planes, Upstream, upstream_of
from genmojo_core.render.rasterizer import Rendering, Splats

MAX_SLOTS = 16  # channels of one pass, depth included
SPLATS_PER_JOB, RANKS_PER_JOB = 512, 1024


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

    @cached_property
    def feature_of_plane(self) -> np.ndarray:
        """(1 + slots,) int64 column of the features in alpha and each slot, -1 for alpha, depth and empty slots."""
        found = np.full(1 + self.slots, -1, np.int64)
        for columns, places in self.columns():
            found[1 + places.start : 1 + places.stop] = np.arange(columns.start, columns.stop)
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
    with Team() as team:
        cloud, features = _checked(splats)
        lens, count = lens_of(view, pose), len(features)
        kinds = ((count, GEOMETRY), np.float32), ((count,), np.float32), ((count, 4), np.int32)
        geometry, depth, box, _ = take_together(*kinds)
        ellipses = Ellipses(geometry, depth, box, np.zeros(2, np.int64))
        team.run(lambda stage: project_splats(stage, lens, cloud, ellipses), count, SPLATS_PER_JOB)
        bins, sorting = empty_bins(lens, ellipses)
        drawn = Drawn(lens, cloud, bins, features.shape[1])
        for layout in layouts(features.shape[1], detached_channels):
            drawn.passes.append(_draw_pass(team, drawn, layout, (ellipses, features), sorting))
    return drawn


def backward(
    drawn: Drawn, upstream: Rendering[np.ndarray], *, with_pose: bool = False
) -> tuple[Splats[np.ndarray], np.ndarray]:
    """Gradients of sum(upstream * rendering): for the splats (float32) and for the pose (4, 4) float64.

    The pose's gradient is 0 unless `with_pose`.
    """
    with Team() as team:
        out, numbers = _empty_gradients(drawn, with_pose=with_pose)
        for index, one in enumerate(drawn.passes):
            first = index == 0
            _add_gradients(team, drawn, one, upstream_of(upstream, first=first), out, numbers[: None if first else 0])
    pose = np.zeros((4, 4))
    if with_pose:
        pose[:3] = out.pose.sum(axis=0).reshape(3, 4)
    return Splats(out.means, out.quats, out.scales, out.opacities, out.features), pose


@lru_cache(maxsize=64)
def layouts(features: int, detached: int) -> tuple[Layout, ...]:
    """Passes for that many feature channels of which the last `detached` are detached."""
    if not 0 <= detached <= features:
        raise GenmojoError("argument", f"detached_channels is {detached} of {features} channels", "rasteriser")
    attached = features - detached
    if Layout(range(attached), range(attached, features)).slots <= MAX_SLOTS:
        return (Layout(range(attached), range(attached, features)),)
    step = MAX_SLOTS - 1
    found = [Layout(range(i, min(i + step, attached)), range(0)) for i in range(0, attached, step)]
    found = found or [Layout(range(0), range(0))]
    step = MAX_SLOTS - 2
    found += [Layout(range(0), range(i, min(i + step, features))) for i in range(attached, features, step)]
    return tuple(found)


def _draw_pass(
    team: Team, drawn: Drawn, layout: Layout, source: tuple[Ellipses, np.ndarray], sorting: Sorting
) -> Pass:  # fmt: skip
    """Blend the features of one pass, the first of which also fills the bins."""
    bins, lens, (ellipses, features) = drawn.bins, drawn.lens, source
    count, slots = len(bins.order), layout.slots
    numbers = count * (GEOMETRY + slots) + LANES  # the tile kernels copy eight at a time, over the end
    flat, hits, _ = take_together(((numbers,), np.float32), ((len(bins.rank),), np.uint32))
    planes = take((1 + slots, bins.tiles_y * TILE, bins.tiles_x * TILE))
    table = flat[:-LANES].reshape(count, GEOMETRY + slots)
    records = Records(features, layout.feature_of_plane[1:], table)
    bands = 0 if drawn.passes else min(team.threads, bins.tiles_y)  # for each of them all splats are walked
    sizes = Pieces(bands, -(-bins.tiles_y // max(bands, 1)), RANKS_PER_JOB)
    drawing = Drawing(
        flat, slots, state_floats(slots), layout.attached_slots, planes.ravel(), hits, lens.width, lens.height
    )  # fmt: skip
    binning, splats, floats = (bins, sorting, sizes), (ellipses, records), drawing_floats(slots)
    first, pieces = 0 if drawn.passes else HALVES, bands + -(-count // RANKS_PER_JOB)
    ranges = [(first, 1), (pieces, 1), (len(bins.tile_start) - 1, 1)]
    team.run_all(lambda stages, done: bin_and_draw(stages, done, binning, splats, drawing, _room(floats)), ranges)
    return Pass(layout, drawing, planes)


def _empty_gradients(drawn: Drawn, *, with_pose: bool) -> tuple[Gradients, np.ndarray]:
    """Gradients of any content, and all numbers of the splats' side by side."""
    count = len(drawn.cloud.means)
    shapes = ((count, 3), (count, 4), (count, 3), (count,), (count, drawn.features))
    means, quats, scales, opacities, features, block = take_together(*((shape, np.float32) for shape in shapes))
    jobs = -(-count // SPLATS_PER_JOB) if with_pose else 0
    return Gradients(means, quats, scales, opacities, features, np.zeros((jobs, 12))), block.view(np.float32)


def _add_gradients(
    team: Team, drawn: Drawn, one: Pass, upstream: Upstream, out: Gradients, clear: np.ndarray
) -> None:  # fmt: skip
    """Add the gradients of one pass to `out`, whose numbers `clear` are of any content before."""
    bins, layout, drawing = drawn.bins, one.layout, one.drawing
    height, pitch = one.planes.shape[1:]
    row = -(-(MOMENTS + layout.slots) // 8) * 8
    values, rows, _ = take_together(((one.planes.size,), np.float32), ((len(bins.rank) * row,), np.float32))
    planes = Planes(values, layout.feature_of_plane, height, pitch, drawing.height, drawing.width)
    slopes, floats = Slopes(values, rows, row), slope_floats(layout.slots)
    sums, scene = Sums(rows, row, drawing.hits, layout.feature_of_plane[1:]), (drawn.lens, drawn.cloud)
    given, tiles, splats = (upstream, planes, clear), (drawing, bins, slopes), (scene, sums, out)
    ranges = [(bins.tiles_y, 1), (len(bins.tile_start) - 1, 1), (len(drawn.cloud.means), SPLATS_PER_JOB)]
    team.run_all(
        lambda stages, done: find_gradients(stages, done, given, tiles, splats, (scratch(floats), scratch(SCRATCH))),
        ranges,
    )


def _room(floats: int) -> tuple[np.ndarray, np.ndarray]:
    """The calling thread's scratch for `draw_tiles`: (floats,) float32 and (MARKS,) int64."""
    whole = scratch(2 * MARKS + floats)
    return whole[2 * MARKS :], whole[: 2 * MARKS].view(np.int64)


def _even(number: int) -> int:
    """Rounded up to an even number."""
    return number + number % 2


def _checked(splats: Splats[np.ndarray]) -> tuple[Cloud, np.ndarray]:
    """Splats as contiguous float32 arrays of matching shapes, or GenmojoError("schema")."""
    count = len(splats.means)
    wanted = {"means": (count, 3), "quats": (count, 4), "scales": (count, 3), "opacities": (count,)}
    arrays = []
    for name, shape in wanted.items():
        array = _plain(getattr(splats, name))
        if array.shape != shape:
            raise GenmojoError("schema", f"{name} has shape {array.shape}, expected {shape}", "rasteriser")
        arrays.append(array)
    features = _plain(splats.features)
    if features.ndim != 2 or len(features) != count:
        raise GenmojoError("schema", f"features have shape {features.shape}, expected ({count}, C)", "rasteriser")
    return Cloud(*arrays), features


def _plain(array: np.ndarray) -> np.ndarray:
    """Float32 in C order and writable, because kernels know one kind of array; itself where it is that."""
    return array if array.dtype == np.float32 and array.flags.carray else np.require(array, np.float32, ["C", "W"])
