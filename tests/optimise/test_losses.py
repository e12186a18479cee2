"""Data terms: zero on a perfect render, finite and differentiable at the edges, blind to what is void or held out."""

from dataclasses import replace

import numpy as np
import pytest
import torch

from genmojo_core.optimise import losses
from genmojo_core.optimise.targets import FrameTargets, held_out_blocks
from genmojo_core.render.rasterizer import Rendering
from genmojo_core.scene.scene4d import Layout

H, W = 24, 32
LAYOUT = Layout(labels=2, flow=True)


def target(seen: torch.Tensor | None = None, depth_scaled: bool = True) -> FrameTargets:
    labels = torch.zeros(H, W, dtype=torch.int64)
    labels[4:14, 3:15] = 1
    labels[8:20, 18:30] = 2
    rgb = torch.rand(H, W, 3, generator=torch.Generator().manual_seed(0))
    ramp = 2.0 + torch.linspace(0, 1, W).repeat(H, 1)
    seen = torch.ones(H, W) if seen is None else seen
    flow = torch.full((H, W, 2), 1.5)
    return FrameTargets(rgb, labels, seen, torch.zeros(H, W, dtype=torch.bool), ramp, seen.clone(), flow, seen.clone(),
                        depth_scaled)  # fmt: skip


def perfect(t: FrameTargets) -> Rendering:
    alpha = torch.full((H, W), 0.995)
    one_hot = torch.stack([(t.labels == 1).float(), (t.labels == 2).float()], dim=-1)
    flow = t.flow * (t.labels > 0)[..., None]
    return Rendering(torch.cat([t.rgb, one_hot, flow], dim=-1).requires_grad_(), alpha * t.depth, alpha)


def all_terms(rendering: Rendering, t: FrameTargets) -> dict[str, torch.Tensor]:
    inside = (t.labels > 0).float()
    return {
        "rgb": losses.color_loss(rendering, t, inside, True),
        "alpha": losses.coverage_loss(rendering, LAYOUT, t, inside),
        "labels": losses.label_loss(rendering, LAYOUT, t),
        "spill": losses.spill_loss(rendering, LAYOUT, t),
        "depth": losses.depth_loss(rendering, LAYOUT, t),
        "flow": losses.flow_loss(rendering, LAYOUT, t),
    }


@pytest.mark.parametrize("name", ["rgb", "alpha", "labels", "spill", "depth", "flow"])
def test_a_perfect_render_costs_nothing(name: str) -> None:
    t = target()
    assert float(all_terms(perfect(t), t)[name].detach()) == pytest.approx(0.0, abs=1e-5)


@pytest.mark.parametrize("name", ["rgb", "alpha", "labels", "spill", "depth", "flow"])
def test_pixels_that_are_not_seen_do_not_count(name: str) -> None:
    seen = torch.ones(H, W)
    seen[:, 16:] = 0.0
    t = target(seen)
    clean, spoiled = perfect(t), perfect(t)
    features = spoiled.features.detach().clone()
    features[:, 16:] = 7.0
    depth = spoiled.depth.clone()
    depth[:, 16:] = 1e3
    spoiled = Rendering(features.requires_grad_(), depth, spoiled.alpha)
    assert float(all_terms(clean, t)[name].detach()) == pytest.approx(float(all_terms(spoiled, t)[name].detach()))


def test_nothing_seen_is_a_differentiable_zero() -> None:
    t = target(torch.zeros(H, W))
    rendering = perfect(t)
    total = sum(all_terms(rendering, t).values())
    total.backward()
    assert float(total.detach()) == 0.0
    assert torch.isfinite(rendering.features.grad).all()


def test_n14_an_uncovered_pixel_costs_a_bounded_amount_and_still_pulls() -> None:
    t = target()
    features = torch.zeros(H, W, LAYOUT.channels, requires_grad=True)
    loss = losses.label_loss(Rendering(features, torch.zeros(H, W), torch.zeros(H, W)), LAYOUT, t)
    loss.backward()
    assert 0 < float(loss.detach()) < 9.3
    pull = features.grad[..., 3][t.labels == 1]
    assert bool((pull < 0).all())


def test_n16_depth_where_nothing_is_drawn_is_ignored() -> None:
    t = target()
    empty = Rendering(torch.zeros(H, W, LAYOUT.channels), torch.zeros(H, W), torch.zeros(H, W))
    assert float(losses.depth_loss(empty, LAYOUT, t)) == 0.0


def test_guessed_depth_is_compared_up_to_scale_and_shift() -> None:
    t = target(depth_scaled=False)
    rendering = perfect(t)
    other = Rendering(rendering.features, rendering.alpha * (3.0 * t.depth + 5.0), rendering.alpha)
    upside_down = Rendering(rendering.features, rendering.alpha * (9.0 - t.depth), rendering.alpha)
    assert float(losses.depth_loss(other, LAYOUT, t)) == pytest.approx(0.0, abs=1e-4)
    assert float(losses.depth_loss(upside_down, LAYOUT, t)) == pytest.approx(0.2, abs=1e-3)


def test_order_pushes_back_only_what_stands_before_another_objects_pixels() -> None:
    t = target()
    rendering = perfect(t)
    pixels = torch.tensor([[6.5, 9.5], [6.5, 9.5], [22.5, 12.5], [0.5, 0.5]])
    depths = torch.tensor([1.0, 9.0, 1.0, 1.0], requires_grad=True)
    owner = torch.tensor([1, 1, 1, 1])  # all belong to object 2
    losses.order_loss(pixels, depths, owner, rendering, t, LAYOUT).backward()
    assert depths.grad[0] < 0  # in front of object 1's pixels: back
    assert depths.grad[1:].tolist() == [0.0, 0.0, 0.0]  # behind, on its own pixels, on background


def test_tracks_far_away_do_not_dominate() -> None:
    expected = torch.zeros(3, 2)
    pixels = torch.tensor([[0.0, 0.0], [1.0, 0.0], [400.0, 300.0]], requires_grad=True)
    losses.track_loss(pixels, expected, torch.ones(3), diagonal=300.0).backward()
    assert float(pixels.grad[2].norm()) == pytest.approx(1 / 3 / 3.0, rel=1e-4)
    assert torch.isfinite(pixels.grad).all()


def test_held_out_blocks_lie_in_the_foreground_and_repeat() -> None:
    masks = np.zeros((3, 64, 64), np.uint8)
    masks[:, 16:56, 8:60] = 1
    held = held_out_blocks(masks, 0.1, seed=4)
    assert np.array_equal(held, held_out_blocks(masks, 0.1, seed=4))
    assert 0.05 < held.sum() / (masks > 0).sum() < 0.16
    assert not held[masks == 0].any()
    assert not held_out_blocks(masks, 0.0, 0).any()


def test_gaussians_beside_their_silhouette_are_drawn_to_it_from_afar() -> None:
    """Object 1 fills rows 4 to 13, columns 3 to 14; object 2 may hide it, void may hold it, the rest may not."""
    seen = torch.ones(H, W)
    seen[22:, :] = 0.0
    far = losses.hull_map(target(seen), 0)
    assert far is not None
    unit = 0.01 * float(np.hypot(H, W))
    assert float(far[6, 5]) == 0.0  # its own mask
    assert float(far[18, 25]) == 0.0  # the other's
    assert float(far[23, 2]) == 0.0  # void
    assert float(far[6, 15]) == 0.0  # its rim
    assert float(far[5, 16]) == pytest.approx((2 - losses.HULL_MARGIN) / unit, rel=1e-5)
    places = torch.tensor([[16.5, 5.5], [6.0, 8.0], [-5.0, 6.5], [16.5, 5.5]], requires_grad=True)
    depths, opacities = torch.tensor([2.0, 2.0, 2.0, -1.0]), torch.ones(4)
    loss = losses.hull_loss(places, depths, opacities, far)
    loss.backward()
    assert places.grad is not None
    assert float(loss.detach()) > 0.0
    assert float(places.grad[0, 0]) > 0.0  # downhill is to the left
    assert not places.grad[1:].any()  # inside, outside the picture, behind the camera


def test_an_empty_mask_does_not_tell_where_an_object_is() -> None:
    assert losses.hull_map(target(), 2) is None


def test_a_thin_veil_beside_the_masks_costs_its_area_and_their_rim_nothing() -> None:
    """Objects fill 264 pixels. Coverage of .3 weighs three tenths of its area, not nine hundredths."""
    t = target()
    rendering = perfect(t)
    features = rendering.features.detach().clone()
    features[3, 3:15, 3] = 0.9  # the rim above object 1
    features[20:22, 2:12, 4] = 0.3  # a veil of 20 pixels below it
    features.requires_grad_()
    loss = losses.spill_loss(Rendering(features, rendering.depth, rendering.alpha), LAYOUT, t)
    loss.backward()
    assert float(loss.detach()) == pytest.approx(0.3 * 20 / 264, rel=1e-5)
    assert float(features.grad[21, 5, 4]) == pytest.approx(1 / 264, rel=1e-5)
    assert not features.grad[3:14, 3:15].any()


def test_spill_is_bounded_where_no_object_shows() -> None:
    t = replace(target(), labels=torch.zeros(H, W, dtype=torch.int64))
    weight = losses.beside(t)
    assert float(weight.max()) == pytest.approx(1 / (losses.LEAST_MASKS * H * W), rel=1e-5)


def test_gaps_are_counted_where_the_picture_is_seen_and_close() -> None:
    seen = torch.ones(H, W)
    seen[:, 16:] = 0.0
    alpha = torch.full((H, W), 0.5)
    alpha[:, 16:] = 0.0
    alpha.requires_grad_()
    loss = losses.gap_loss(alpha, seen)
    loss.backward()
    assert float(loss.detach()) == pytest.approx(0.25)
    assert (alpha.grad[:, :16] < 0).all() and (alpha.grad[:, 16:] == 0).all()
