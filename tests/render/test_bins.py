"""Bins against numpy's sorts, and upstream gradients in every order in memory, for any number of threads."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

from genmojo_core.kernels import threads
from genmojo_core.render.cpu import rasterize
from genmojo_core.render.cpu.project import TILE
from genmojo_core.render.cpu.upstream import upstream_of
from genmojo_core.render.rasterizer import Rendering, Splats
from tests.render.scenes import NAMES, camera, random_splats, upstream


@pytest.fixture(autouse=True)
def _usual_threads() -> Iterator[None]:
    yield
    threads.set_threads(0)


def _arrays(count: int, channels: int, seed: int) -> Splats[np.ndarray]:
    """Random splats, some of them at the same depth, behind the camera, or without opacity."""
    splats = Splats(*(getattr(random_splats(count, channels, seed), name).numpy() for name in NAMES))
    splats.means[::3, 2] = np.round(splats.means[::3, 2], 1)
    splats.opacities[1::17] = 0
    return splats


@pytest.mark.parametrize("count", [0, 1, 7, 1023, 1025, 4099])
@pytest.mark.parametrize("helpers", [0, 1, 3])
def test_tiles_list_their_splats_by_depth_and_rows_lie_splat_by_splat(count: int, helpers: int) -> None:
    threads.set_threads(1 + helpers)
    splats, view = _arrays(count, 3, count), camera(90, 75)
    bins = rasterize.draw(splats, view).bins
    depth = splats.means[:, 2]
    assert bins.order.tolist() == sorted(bins.order, key=lambda i: (depth[i], i))
    drawn = (splats.opacities >= 1 / 255) & (depth >= view.near) & (depth <= view.far)
    assert set(bins.order) <= set(np.flatnonzero(drawn))
    wanted: dict[tuple[int, int], list[tuple[int, int]]] = {}
    slot = 0
    for rank, (x0, x1, y0, y1) in enumerate(bins.box // TILE):
        for y in range(y0, y1 + 1):
            for x in range(x0, x1 + 1):
                wanted.setdefault((y, x), []).append((rank, slot))
                slot += 1
    assert slot == len(bins.slot) == bins.first_slot[-1]
    for tile in range(bins.tiles_x * bins.tiles_y):
        span = slice(bins.tile_start[tile], bins.tile_start[tile + 1])
        found = list(zip(bins.rank[span].tolist(), bins.slot[span].tolist(), strict=True))
        assert found == wanted.get(divmod(tile, bins.tiles_x), []), tile


@pytest.mark.parametrize("channels", [0, 1, 9, 21])
def test_gradients_do_not_depend_on_how_the_upstream_ones_lie_in_memory(channels: int) -> None:
    splats, view = _arrays(300, channels, 5), camera(53, 41)
    drawn = rasterize.draw(splats, view, detached_channels=min(channels, 2))
    given = Rendering(*(part.numpy() for part in vars(upstream(view, channels)).values()))
    plain = rasterize.backward(drawn, given, with_pose=True)
    for form in (
        lambda a: np.moveaxis(np.ascontiguousarray(np.moveaxis(a, -1, 0)), 0, -1),  # plane by plane
        np.asfortranarray,
        lambda a: np.repeat(a, 2, axis=0)[::2],
        lambda a: np.ascontiguousarray(a[:, ::-1])[:, ::-1],
        lambda a: a.astype(np.float64),
        lambda a: np.frombuffer(a.tobytes(), np.float32).reshape(a.shape),  # read-only
    ):
        threads.set_threads(2)
        other = rasterize.backward(drawn, Rendering(*(form(part) for part in vars(given).values())), with_pose=True)
        assert all(np.array_equal(getattr(plain[0], n), getattr(other[0], n)) for n in NAMES)
        assert np.array_equal(plain[1], other[1])


def test_planes_are_read_where_they_are() -> None:
    """The losses of an optimiser give features plane by plane: nothing is copied."""
    planes = np.zeros((5, 40, 30), np.float32)
    whole = Rendering(planes.transpose(1, 2, 0), planes[0], planes[1])
    assert np.shares_memory(upstream_of(whole, first=True).features, planes)
