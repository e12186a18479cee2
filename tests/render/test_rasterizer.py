"""The CPU rasteriser against the float64 oracle: pictures, every gradient, crops, sizes, threads."""

from __future__ import annotations

import numpy as np
import pytest
import torch

from genmojo_core.errors import GenmojoError
from genmojo_core.kernels import threads
from genmojo_core.render import autograd, reference, torch_tiles
from genmojo_core.render.cpu.rasterize import rasterize
from genmojo_core.render.rasterizer import Rendering, Splats
from tests.render.scenes import (
    NAMES,
    camera,
    pixels_near_the_cut,
    random_splats,
    relative_error,
    run,
    turned_pose,
    upstream,
    with_gradient,
)  # fmt: skip


def _masked(weights: Rendering, keep: torch.Tensor) -> Rendering:
    """Upstream gradients only where the cut is clear of rounding."""
    return Rendering(weights.features * keep[..., None], weights.depth * keep, weights.alpha * keep)


@pytest.mark.parametrize("seed", range(30))
def test_picture_and_gradients_equal_float64(seed: int) -> None:
    rng = np.random.default_rng(seed)
    channels = int(rng.integers(1, 14))
    splats = random_splats(int(rng.integers(20, 400)), channels, seed, size=float(rng.uniform(0.02, 0.15)))
    view = camera(int(rng.integers(20, 70)), int(rng.integers(20, 70)), shift=(3.0, -2.0)).with_pose(turned_pose())
    near = pixels_near_the_cut(splats, view)
    assert near.float().mean() < 0.2
    weights = _masked(upstream(view, channels, seed), ~near)
    ours, gradients = run(autograd.splat, splats, view, weights)
    oracle, expected = run(reference.splat, splats, view, weights)
    for part in ("features", "depth", "alpha"):
        assert (getattr(ours, part) - getattr(oracle, part)).abs()[~near].max() <= 2e-5
    for name in NAMES:
        assert expected[name].norm() > 0
        assert relative_error(gradients[name], expected[name]) <= 5e-6, name


def test_plain_torch_tiles_equal_float64() -> None:
    splats, view = random_splats(150, 5, 3), camera(37, 45).with_pose(turned_pose())
    near = pixels_near_the_cut(splats, view)
    weights = _masked(upstream(view, 5), ~near)
    ours, gradients = run(torch_tiles.splat, splats, view, weights, detached_channels=2)
    oracle, expected = run(reference.splat, splats, view, weights, detached_channels=2)
    assert (ours.features - oracle.features).abs()[~near].max() <= 2e-5
    for name in NAMES:
        assert relative_error(gradients[name], expected[name]) <= 2e-5, name


@pytest.mark.parametrize(("channels", "detached"), [(0, 0), (1, 1), (5, 2), (15, 0), (16, 0), (21, 3), (40, 17)])
def test_any_number_of_channels_attached_and_detached(channels: int, detached: int) -> None:
    splats, view = random_splats(120, channels, 5), camera(33, 29)
    near = pixels_near_the_cut(splats, view)
    weights = _masked(upstream(view, channels), ~near)
    ours, gradients = run(autograd.splat, splats, view, weights, detached_channels=detached)
    oracle, expected = run(reference.splat, splats, view, weights, detached_channels=detached)
    assert ours.features.shape == (29, 33, channels)
    assert torch.allclose(ours.features[~near].double(), oracle.features[~near], atol=2e-5)
    for name in NAMES:
        assert relative_error(gradients[name], expected[name]) <= 5e-6 or channels == 0 and name == "features", name


def test_detached_channels_never_move_geometry() -> None:
    splats, view = random_splats(60, 4, 8), camera(30, 30)
    weights = upstream(view, 4)
    weights = Rendering(weights.features * torch.tensor([0.0, 0, 1, 1]), 0 * weights.depth, 0 * weights.alpha)
    _, gradients = run(autograd.splat, splats, view, weights, detached_channels=2)
    assert gradients["features"][:, 2:].abs().sum() > 0
    for name in ("means", "quats", "scales", "opacities"):
        assert (gradients[name] == 0).all(), name


def test_pose_gradient_equals_float64() -> None:
    splats, view = random_splats(200, 3, 11), camera(50, 40)
    pose = torch.tensor(turned_pose())
    weights = _masked(upstream(view, 3), ~pixels_near_the_cut(splats, view, pose))
    found = []
    for draw in (autograd.splat, reference.splat):
        leaf = pose.clone().requires_grad_()
        run(draw, splats, view, weights, pose=leaf)
        found.append(leaf.grad)
    assert found[1].norm() > 0
    assert relative_error(found[0], found[1]) <= 5e-6


def test_depth_over_alpha_is_the_depth_of_a_plane() -> None:
    splats = random_splats(400, 3, 2, size=0.2)
    splats.means[:, 2] = 4.0
    picture = autograd.splat(splats, camera(40, 40))
    covered = picture.alpha > 1e-4
    assert covered.float().mean() > 0.5
    assert torch.allclose(picture.depth[covered] / picture.alpha[covered], torch.tensor(4.0), atol=1e-3)


@pytest.mark.parametrize("seed", range(20))
def test_n07_a_crop_is_a_slice_of_the_picture(seed: int) -> None:
    rng = np.random.default_rng(seed)
    splats, view = random_splats(400, 4, seed, size=0.01), camera(96, 80)
    left, top = int(rng.integers(-10, 60)), int(rng.integers(-10, 50))
    width, height = int(rng.integers(20, 96 - left)), int(rng.integers(20, 80 - top))
    full = autograd.splat(splats, view)
    crop = autograd.splat(splats, view.cropped(left, top, width, height))
    clear = ~pixels_near_the_cut(splats, view)
    # The Jacobian's clamp follows the crop, so splats centred outside it may differ: stay one splat's reach inside.
    reach = 8
    rows = slice(max(top + reach, 0), min(top + height - reach, 80))
    columns = slice(max(left + reach, 0), min(left + width - reach, 96))
    inner = (slice(rows.start - top, rows.stop - top), slice(columns.start - left, columns.stop - left))
    for part, limit in (("features", 1e-5), ("alpha", 1e-5), ("depth", 5e-5)):
        difference = (getattr(full, part)[rows, columns] - getattr(crop, part)[inner])[clear[rows, columns]].abs()
        assert full.alpha[rows, columns].max() > 0.1
        assert difference.max() <= limit, part


@pytest.mark.parametrize(
    "size",
    [
        (1, 1), (15, 17), (16, 16), (17, 31), (3, 200), (854, 480), (1920, 1080), (1920, 1200),
        pytest.param((3840, 2160), marks=pytest.mark.slow),
    ],
)  # fmt: skip
def test_n09_any_size_equals_brute_force(size: tuple[int, int]) -> None:
    splats = random_splats(50, 2, 7, size=0.03)
    view = camera(*size)
    picture = autograd.splat(splats, view)
    assert picture.features.shape == (size[1], size[0], 2)
    # Brute force in bands of rows keeps the oracle's memory small.
    worst, flipped = 0.0, 0
    step = max(1, 2_000_000 // (50 * size[0]))
    for top in list(range(0, size[1], step))[:: max(1, size[1] // step // 6)]:
        rows = min(step, size[1] - top)
        band = view.cropped(0, top, size[0], rows)
        oracle = _banded_oracle(splats, view, band)
        difference = (picture.features[top : top + rows] - oracle).abs().amax(dim=2)
        flipped += int((difference > 2e-3).sum())
        worst = max(worst, float(difference[difference <= 2e-3].max()))
    assert worst <= 5e-3
    assert flipped <= 1e-4 * size[0] * size[1]


def _banded_oracle(splats: Splats, view, band) -> torch.Tensor:
    """Features of a band of rows, with the frustum clamp of the whole picture."""
    whole = reference._covariance
    reference._covariance = lambda points, quats, scales, _, rotation: whole(points, quats, scales, view, rotation)
    try:
        return reference.splat(splats, band).features
    finally:
        reference._covariance = whole


def test_same_bits_for_any_number_of_threads_and_twice() -> None:
    splats, view = random_splats(6000, 9, 1, size=0.03), camera(150, 130)
    weights = upstream(view, 9)
    results = []
    try:
        for count in (1, 2, 4, 2):
            threads.set_threads(count)
            pose = torch.tensor(turned_pose()).requires_grad_()
            picture, gradients = run(autograd.splat, splats, view, weights, detached_channels=2, pose=pose)
            results.append((picture.features, picture.depth, picture.alpha, pose.grad, *gradients.values()))
    finally:
        threads.set_threads(0)
    for other in results[1:]:
        assert all(torch.equal(a, b) for a, b in zip(results[0], other, strict=True))


@pytest.mark.parametrize("count", [1, 2, 4])
def test_pictures_drawn_at_once_have_the_bits_of_pictures_drawn_alone(count: int) -> None:
    """Five pictures of different scenes and sizes, of which the loss looks at four."""
    views = [camera(40 + 20 * k, 50 + 9 * k) for k in range(5)]
    scenes = [random_splats(700, 9, k, size=0.03) for k in range(5)]
    try:
        threads.set_threads(count)
        leaves, poses = (
            [with_gradient(s) for s in scenes],
            [torch.tensor(turned_pose()).requires_grad_() for _ in views],
        )
        pictures = autograd.splat_frames(leaves, views, detached_channels=2, poses=poses)
        torch.stack([(p.features * upstream(v, 9).features).sum() + p.alpha.sum()
                     for p, v in zip(pictures[:4], views, strict=False)]).sum().backward()  # fmt: skip
        for k, (picture, view) in enumerate(zip(pictures, views, strict=True)):
            own, pose = with_gradient(scenes[k]), torch.tensor(turned_pose()).requires_grad_()
            alone = autograd.splat(own, view, detached_channels=2, pose=pose)
            assert torch.equal(picture.features, alone.features) and torch.equal(picture.depth, alone.depth)
            if k == 4:
                assert leaves[k].means.grad is None and poses[k].grad is None
                continue
            ((alone.features * upstream(view, 9).features).sum() + alone.alpha.sum()).backward()
            assert torch.equal(poses[k].grad, pose.grad)
            assert all(torch.equal(getattr(leaves[k], n).grad, getattr(own, n).grad) for n in NAMES)
    finally:
        threads.set_threads(0)


def test_numpy_and_torch_draw_the_same_bits() -> None:
    splats, view = random_splats(300, 20, 4), camera(60, 50)
    arrays = rasterize(Splats(*(getattr(splats, name).numpy() for name in NAMES)), view)
    picture = autograd.splat(splats, view)
    assert np.array_equal(arrays.features, picture.features.numpy())
    assert np.array_equal(arrays.alpha, picture.alpha.numpy())


def test_gradients_are_those_of_finite_differences() -> None:
    """float64 oracle against finite differences, so that both gradients cannot share one mistake."""
    splats, view = random_splats(3, 1, 12, size=0.3), camera(5, 4)
    leaves = [getattr(splats, name).double().requires_grad_() for name in NAMES]

    def total(*parts: torch.Tensor) -> torch.Tensor:
        picture = reference.splat(Splats(*parts), view)
        return torch.cat([picture.features.flatten(), picture.depth.flatten(), picture.alpha.flatten()])

    assert torch.autograd.gradcheck(total, leaves, eps=1e-7, atol=1e-4, rtol=1e-3)


def test_wrong_shapes_are_named() -> None:
    good = random_splats(5, 3, 0)
    bad = Splats(good.means, good.quats[:, :3], good.scales, good.opacities, good.features)
    with pytest.raises(GenmojoError, match="quats has shape"):
        autograd.splat(bad, camera(8, 8))
    with pytest.raises(GenmojoError, match="detached_channels"):
        autograd.splat(good, camera(8, 8), detached_channels=4)
