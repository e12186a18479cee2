"""RELIABILITY.md rows N01-N13, N20, N31 for the rasterisers: what broke elsewhere must not break here."""

from __future__ import annotations

import math

import numpy as np
import pytest
import torch
from hypothesis import given, settings
from hypothesis import strategies as st

from genmojo_core.errors import GenmojoError
from genmojo_core.kernels.cache import kernel
from genmojo_core.kernels.stage import Stage, alone
from genmojo_core.render import autograd, reference, torch_tiles
from genmojo_core.render.cpu.bins import HALVES, Bins, Sorting, empty_bins, sort_and_count
from genmojo_core.render.cpu.project import Ellipses, lens_of
from genmojo_core.render.cpu.rasterize import rasterize
from genmojo_core.render.rasterizer import Splats
from tests.render.scenes import NAMES, camera, random_splats, relative_error, run, upstream

RASTERISERS = [autograd.splat, torch_tiles.splat]


def _joined(*clouds: Splats) -> Splats:
    return Splats(*(torch.cat([getattr(c, name) for c in clouds]) for name in NAMES))


def _one(mean=(0.0, 0.0, 3.0), quat=(1.0, 0, 0, 0), scale=(0.1, 0.1, 0.1), opacity=0.8, feature=(1.0, 0.5)) -> Splats:
    return Splats(*(torch.tensor([v], dtype=torch.float32) for v in (mean, quat, scale, opacity, feature)))


def _finite(picture, gradients) -> bool:
    parts = [picture.features, picture.depth, picture.alpha, *gradients.values()]
    return all(bool(torch.isfinite(p).all()) for p in parts)


@pytest.mark.parametrize("draw", RASTERISERS)
def test_n01_culled_depths_give_no_gradient_and_disturb_nobody(draw) -> None:
    view = camera(40, 30)
    visible = random_splats(80, 2, 1)
    depths = (-1.0, 0.0, 1e-9, view.near / 2, 1e9)
    culled = _joined(*(_one((0.01 * k, 0.02, z)) for k, z in enumerate(depths)))
    kept = _joined(visible, *(_one((0.0, 0.0, z)) for z in (5.0,)))
    weights = upstream(view, 2)
    alone, expected = run(draw, kept, view, weights)
    picture, gradients = run(draw, _joined(kept, culled), view, weights)
    assert _finite(picture, gradients)
    assert torch.equal(picture.features, alone.features)
    for name in NAMES:
        assert (gradients[name][81:] == 0).all(), name
        torch.testing.assert_close(gradients[name][:81], expected[name], rtol=1e-6, atol=0)


@pytest.mark.parametrize("depth", [0.01, 0.01001])
def test_n01_a_splat_just_behind_the_near_plane_stays_finite(depth: float) -> None:
    picture, gradients = run(autograd.splat, _one((0.0, 0.0, depth)), camera(20, 20), upstream(camera(20, 20), 2))
    assert _finite(picture, gradients)


@pytest.mark.parametrize("draw", RASTERISERS)
@pytest.mark.parametrize("length", [0.0, 1e-20, 1e-40, math.nan, math.inf])
def test_n02_quaternions_without_length_are_not_drawn(draw, length: float) -> None:
    view = camera(20, 20)
    picture, gradients = run(draw, _one(quat=(length, 0.0, 0.0, 0.0)), view, upstream(view, 2))
    assert _finite(picture, gradients)
    assert (picture.alpha == 0).all()
    assert all((g == 0).all() for g in gradients.values())


def test_n02_quaternions_of_any_length_draw_the_same_and_gradients_shrink_with_it() -> None:
    view = camera(30, 30)
    weights = upstream(view, 2)
    unit, unit_gradients = run(autograd.splat, _one(quat=(0.6, 0.0, 0.8, 0.0), scale=(0.3, 0.1, 0.05)), view, weights)
    for length in (1e-6, 1e3, 1e18):
        long = _one(quat=(0.6 * length, 0.0, 0.8 * length, 0.0), scale=(0.3, 0.1, 0.05))
        picture, gradients = run(autograd.splat, long, view, weights)
        torch.testing.assert_close(picture.features, unit.features, rtol=1e-5, atol=1e-6)
        torch.testing.assert_close(gradients["quats"] * length, unit_gradients["quats"], rtol=1e-3, atol=1e-4)


@pytest.mark.parametrize("log_scale", [-math.inf, -100.0, 11.1, 89.0, math.inf, math.nan])
def test_n03_any_scale_leaves_the_picture_finite(log_scale: float) -> None:
    view = camera(25, 35)
    with np.errstate(over="ignore"):
        scale = float(np.exp(np.float32(log_scale)))
    wild = _one(scale=(scale, 0.1, 0.1), mean=(0.1, 0.0, 2.5))
    visible = random_splats(30, 2, 2)
    picture, gradients = run(autograd.splat, _joined(visible, wild), view, upstream(view, 2))
    assert _finite(picture, gradients)
    if not math.isfinite(log_scale) and log_scale != -math.inf:
        alone, _ = run(autograd.splat, visible, view, upstream(view, 2))
        assert torch.equal(picture.features, alone.features)


@pytest.mark.parametrize("channels", range(1, 10))
def test_n04_memory_that_nobody_wrote_never_shows(channels: int, monkeypatch: pytest.MonkeyPatch) -> None:
    splats, view = random_splats(40, channels, 3, size=0.02), camera(40, 30)
    splats.means[:20, 0] -= 5.0  # half of them left of the picture
    expected, expected_gradients = run(autograd.splat, splats, view, upstream(view, channels))
    fresh = np.empty

    def poisoned(shape: object, dtype: object = float) -> np.ndarray:
        array = fresh(shape, dtype)
        array.view(np.uint8)[...] = 255  # not a number, or the largest index
        return array

    monkeypatch.setattr(np, "empty", poisoned)
    picture, gradients = run(autograd.splat, splats, view, upstream(view, channels))
    assert torch.equal(picture.features, expected.features)
    assert torch.equal(picture.depth, expected.depth)
    assert all(torch.equal(gradients[n], expected_gradients[n]) for n in NAMES)
    assert all((g[:20] == 0).all() for g in gradients.values())


@pytest.mark.parametrize("aspect", [1.0, 10.0, 1e3, 1e5])
def test_n05_needles_stay_ellipses_at_any_angle(aspect: float) -> None:
    view = camera(64, 64)
    for k in range(16):
        angle = math.pi * k / 16
        # turned about z: the needle lies in the image plane, its long axis at `angle`
        needle = _one(
            quat=(math.cos(angle / 2), 0, 0, math.sin(angle / 2)), scale=(0.002 * aspect, 0.002, 0.002),
            mean=(0.5 * 3 / 64, 0.5 * 3 / 64, 3.0), opacity=0.9,
        )  # fmt: skip
        picture = autograd.splat(needle, view)
        assert float(picture.alpha[32, 32]) == pytest.approx(0.9, rel=1e-2)
        off = (32 + 4.5 * math.cos(angle), 32 - 4.5 * math.sin(angle))  # 4.5 pixels off the axis: (row, column)
        assert float(picture.alpha[round(off[0]), round(off[1])]) < 1 / 255
        oracle = reference.splat(needle, view)
        assert (picture.alpha - oracle.alpha).abs().quantile(0.95) <= 1e-3


def test_n06_a_splat_passing_the_near_plane_fades_without_a_jump_back() -> None:
    view = camera(32, 32)
    seen = []
    for z in np.linspace(0.02, -0.02, 200):
        picture = autograd.splat(_one((0.0, 0.0, float(z)), scale=(0.001, 0.001, 0.001)), view)
        seen.append(float(picture.alpha[16, 16]))
        assert np.isfinite(seen[-1])
    behind = [a for z, a in zip(np.linspace(0.02, -0.02, 200), seen, strict=True) if z < view.near]
    assert max(behind) == 0.0


def test_n08_screens_full_of_splats_are_refused_by_name_and_at_once() -> None:
    count = 300_000
    rng = np.random.default_rng(0)
    splats = Splats(
        rng.normal(size=(count, 3)).astype(np.float32) * 0.01 + np.float32([0, 0, 3]),
        np.tile(np.float32([1, 0, 0, 0]), (count, 1)),
        np.full((count, 3), 5.0, np.float32),
        np.full(count, 0.5, np.float32),
        np.ones((count, 1), np.float32),
    )
    small = random_splats(4, 1, 0)
    rasterize(Splats(*(getattr(small, n).numpy() for n in NAMES)), camera(32, 32))  # compile
    with pytest.raises(GenmojoError, match="the widest is splat") as error:
        rasterize(splats, camera(1920, 1080))
    assert error.value.code == "budget"


@kernel
def _sort_and_count(stage: Stage, box: np.ndarray, bins: Bins, sorting: Sorting) -> None:
    sort_and_count(stage, box, bins, sorting)


@given(width=st.integers(1, 2**20), height=st.integers(1, 2**20), seed=st.integers(0, 999))
@settings(max_examples=50, deadline=None)
def test_n09_index_maths_holds_for_sizes_that_overflow_32_bits(width: int, height: int, seed: int) -> None:
    """Entries are counted before anything of the image's size is allocated."""
    rng = np.random.default_rng(seed)
    box = np.sort(rng.integers(0, [[width], [height]], size=(2000, 2, 2)), axis=2).reshape(-1, 4).astype(np.int32)
    view = camera(16, 16)
    lens = lens_of(view)._replace(width=width, height=height)
    spans = box.astype(object) // 16
    expected = sum((b[1] - b[0] + 1) * (b[3] - b[2] + 1) for b in spans)
    depth = np.arange(1, 2001, dtype=np.float32)
    ellipses = Ellipses(np.zeros((2000, 6), np.float32), depth, box, np.array([2000, expected], np.int64))
    if expected > 2**24:
        with pytest.raises(GenmojoError, match=f"cover {expected} tiles"):
            empty_bins(lens, ellipses)
    elif width * height < 2**30:
        bins, sorting = empty_bins(lens, ellipses)
        _sort_and_count(alone(HALVES, 1), box, bins, sorting)
        assert len(bins.rank) == bins.tile_start[-1] == bins.first_slot[-1] == expected


@pytest.mark.parametrize("padding", [1, 5, 15, 16, 31])
def test_n10_padding_right_and_below_changes_no_bit(padding: int) -> None:
    splats, view = random_splats(200, 3, 6, size=0.03), camera(37, 41)
    wider = view.cropped(0, 0, 37 + padding, 41 + padding)
    small, large = autograd.splat(splats, view), autograd.splat(splats, wider)
    # Only splats beyond 15 % of the border see another frustum clamp; none of these reaches back into the picture.
    inside = (slice(0, 33), slice(0, 30))
    for part in ("features", "depth", "alpha"):
        assert torch.equal(getattr(small, part)[inside], getattr(large, part)[inside]), part


@pytest.mark.parametrize("count", [1, 2, 23, 150, 2000])
@pytest.mark.parametrize("opacity", [1 / 255 + 1e-6, 0.5, 0.99, 1.0])
def test_n13_stacks_of_any_height_stay_finite_and_sum_to_at_most_one(count: int, opacity: float) -> None:
    layer = torch.linspace(2, 4, count)
    stack = Splats(
        torch.stack([torch.zeros(count), torch.zeros(count), layer], dim=1),
        torch.tensor([[1.0, 0, 0, 0]]).expand(count, 4),
        torch.full((count, 3), 0.5),
        torch.full((count,), opacity),
        torch.ones(count, 1),
    )
    view = camera(17, 9)
    picture, gradients = run(autograd.splat, stack, view, upstream(view, 1))
    assert _finite(picture, gradients)
    assert float(picture.features.min()) >= 0
    assert float(picture.features.max()) <= 1 + 1e-6
    assert float((picture.features[..., 0] - picture.alpha).abs().max()) <= 1e-5


@pytest.mark.parametrize("draw", RASTERISERS)
def test_n20_no_splat_at_all_gives_background_and_zero_gradients(draw) -> None:
    view = camera(20, 30)
    empty = Splats(*(getattr(random_splats(3, 2, 0), n)[:0] for n in NAMES))
    picture, gradients = run(draw, empty, view, upstream(view, 2))
    assert picture.features.shape == (30, 20, 2)
    assert (picture.features == 0).all()
    assert (picture.depth == 0).all()
    assert [g.shape for g in gradients.values()] == [(0, 3), (0, 4), (0, 3), (0,), (0, 2)]


def test_n20_all_behind_the_camera_or_one_tile_of_64_gives_exact_background_elsewhere() -> None:
    view = camera(128, 128)
    splats = random_splats(20, 2, 1)
    splats.means[:, 2] *= -1
    picture, gradients = run(autograd.splat, splats, view, upstream(view, 2))
    assert (picture.alpha == 0).all()
    assert all((g == 0).all() for g in gradients.values())
    speck, _ = run(autograd.splat, _one((0.2, 0.2, 3.0), scale=(0.01,) * 3), view, upstream(view, 2))
    assert int((speck.alpha > 0).sum()) > 0
    assert (speck.alpha[:64] == 0).all()


def test_n31_equal_depths_are_blended_by_index_and_repeat_bit_for_bit() -> None:
    view = camera(48, 48)
    splats = random_splats(300, 3, 9)
    splats.means[:, 2] = 3.0
    first, second = (run(autograd.splat, splats, view, upstream(view, 3)) for _ in range(2))
    assert torch.equal(first[0].features, second[0].features)
    assert all(torch.equal(first[1][n], second[1][n]) for n in NAMES)
    oracle, _ = run(reference.splat, splats, view, upstream(view, 3))
    assert (first[0].features - oracle.features).abs().quantile(0.999) <= 2e-5


def test_n31_swapping_two_splats_of_other_depths_changes_nothing_but_the_order_of_gradients() -> None:
    view = camera(48, 48)
    splats = random_splats(200, 3, 10)
    order = torch.randperm(200, generator=torch.Generator().manual_seed(0))
    shuffled = Splats(*(getattr(splats, n)[order] for n in NAMES))
    a, ga = run(autograd.splat, splats, view, upstream(view, 3))
    b, gb = run(autograd.splat, shuffled, view, upstream(view, 3))
    assert torch.equal(a.features, b.features)
    assert all(torch.equal(ga[n][order], gb[n]) for n in NAMES)


def test_no_gradient_is_missing_where_it_is_small() -> None:
    """Per splat, not only in sum: a gradient of zero must not hide behind large neighbours."""
    view = camera(40, 40)
    splats = random_splats(60, 3, 14, size=0.1)
    _, ours = run(autograd.splat, splats, view, upstream(view, 3))
    _, oracle = run(reference.splat, splats, view, upstream(view, 3))
    for name in NAMES:
        mine, right = ours[name].reshape(60, -1).norm(dim=1), oracle[name].reshape(60, -1).norm(dim=1)
        seen = right > 1e-3 * right.max()
        assert seen.sum() > 20
        assert ((mine[seen] / right[seen] - 1).abs() < 5e-2).all(), name
        assert relative_error(ours[name], oracle[name]) < 1e-2
