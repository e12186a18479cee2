"""RELIABILITY.md rows N11, N12 and N14: opacities that saturate, splats that vanish for good, masks that are missed."""

from __future__ import annotations

import copy
import math
from types import SimpleNamespace

import pytest
import torch

from genmojo_core.clip.cameras import View
from genmojo_core.conventions import SH_C0
from genmojo_core.optimise import density, losses
from genmojo_core.optimise.guard import Guard
from genmojo_core.optimise.targets import FrameTargets
from genmojo_core.render import autograd
from genmojo_core.render.rasterizer import ALPHA_MIN, Rendering, Splats
from genmojo_core.scene import safemath
from genmojo_core.scene.gaussians import Gaussians
from genmojo_core.scene.scene4d import Layout
from tests.render.scenes import camera, random_splats

RESET = 0.02  # what other programs do to opacities now and then


def _guarded(gaussians: Gaussians, optimiser: torch.optim.Optimizer) -> Guard:
    """A guard over one set of Gaussians."""
    owner = SimpleNamespace(name="ball", gaussians=gaussians)
    return Guard(SimpleNamespace(objects=[owner], background=None), optimiser)


@pytest.mark.parametrize("seed", range(4))
def test_n11_opacities_stay_finite_through_ten_thousand_operations(seed: int) -> None:
    """2,500 operations each: steps, clones and splits, pruning, resets, relocations, saving and loading."""
    generator = torch.Generator().manual_seed(seed)
    start = Gaussians.from_points(torch.rand(24, 3), torch.rand(24, 3), torch.full((24,), 0.02))
    with torch.no_grad():
        start.logit_opacities.copy_(torch.tensor([1e3, -1e3, 16.7, -200.0, math.inf, -math.inf]).repeat(4))
    optimiser = torch.optim.AdamW(start.parameters(), lr=5.0, eps=1e-15, betas=(0.9, 0.99))
    guard = _guarded(start, optimiser)
    logits = start.logit_opacities
    for operation in torch.randint(0, 6, (2500,), generator=generator).tolist():
        if operation == 0:
            start.logit_opacities.grad = torch.sign(torch.randn(len(start), generator=generator) + 0.5)
            optimiser.step()
        elif operation == 1:
            density.control(start, _statistics(start, generator), 40, optimiser, generator)
        elif operation == 2:
            with torch.no_grad():  # reset
                start.logit_opacities.copy_(safemath.logit(start.opacities().clamp(max=RESET)))
        elif operation == 3:
            with torch.no_grad():  # relocation: dead ones take half of the most opaque one's opacity
                dead = start.opacities() < RESET
                start.logit_opacities[dead] = safemath.logit(1 - torch.sqrt(1 - start.opacities().max()))
        elif operation == 4:
            with torch.no_grad():  # saved as an opacity, loaded as a logit
                start.logit_opacities.copy_(safemath.logit(start.opacities().half().float()))
        else:
            copy.deepcopy(start)
        guard.quarantine()
        logits = start.logit_opacities.detach()
        assert torch.isfinite(logits).all()
        assert logits.abs().max() <= safemath.LOGIT_LIMIT
        assert ((start.opacities() > 0) & (start.opacities() < 1)).all()
    assert len(logits) >= density.KEEP_AT_LEAST


def _statistics(gaussians: Gaussians, generator: torch.Generator) -> density.GradientStatistics:
    """Some gradients, so that growth has something to choose from."""
    statistics = density.GradientStatistics(len(gaussians))
    statistics.add(torch.rand(len(gaussians), 3, generator=generator))
    return statistics


def test_n12_what_density_control_leaves_can_still_be_pulled_at() -> None:
    """Nothing resets opacities here; the nearest thing is density control, which prunes the faint and makes children.

    A third of the Gaussians is as faint as one may be to survive it, a third is fainter.
    """
    view, splats = camera(64, 64), random_splats(600, 3, 3, size=0.02)
    wanted = autograd.splat(splats, view).features
    gaussians = Gaussians.from_points(splats.means, splats.features, splats.scales.mean(dim=1))
    opacities = splats.opacities.clone()
    opacities[::3], opacities[1::3] = 1.001 * density.MIN_OPACITY, 0.5 * density.MIN_OPACITY
    with torch.no_grad():
        gaussians.logit_opacities.copy_(safemath.logit(opacities))
    optimiser = torch.optim.AdamW(gaussians.parameters(), lr=0.05)
    _drawn(gaussians, view).sum().backward()
    visible = gaussians.logit_opacities.grad != 0
    survivors = visible & (opacities >= density.MIN_OPACITY)
    assert survivors[::3].sum() > 100
    statistics = density.GradientStatistics(600)
    statistics.add(gaussians.means.grad)
    added, removed = density.control(gaussians, statistics, 700, optimiser, torch.Generator().manual_seed(0))
    assert added > 40
    assert removed >= 200
    assert gaussians.opacities().min() >= density.MIN_OPACITY
    alive = torch.zeros(len(gaussians), dtype=torch.bool)
    for _ in range(50):
        optimiser.zero_grad()
        ((_drawn(gaussians, view) - wanted) ** 2).mean().backward()
        alive |= gaussians.logit_opacities.grad != 0
        optimiser.step()
    kept = gaussians.uid < 600
    assert alive[kept][survivors[gaussians.uid[kept]]].float().mean() >= 0.99
    assert alive[~kept].float().mean() >= 0.99


def _drawn(gaussians: Gaussians, view: View) -> torch.Tensor:
    """Colours of Gaussians as the optimiser draws them."""
    rgb = 0.5 + SH_C0 * gaussians.dc
    splats = Splats(gaussians.means, gaussians.quats, gaussians.scales(), gaussians.opacities(), rgb)
    return autograd.splat(splats, view).features


@pytest.mark.parametrize("opacity", [0.0, 1e-30, ALPHA_MIN * 0.999, ALPHA_MIN, ALPHA_MIN * 1.001])
def test_n12_opacities_about_the_cut_are_drawn_or_dropped_without_harm(opacity: float) -> None:
    view, splats = camera(20, 20), random_splats(30, 2, 0)
    splats.opacities.fill_(opacity)
    leaf = splats.opacities.requires_grad_()
    picture = autograd.splat(splats, view)
    picture.features.sum().backward()
    assert torch.isfinite(picture.features).all()
    assert torch.isfinite(leaf.grad).all()
    assert picture.alpha.max() <= (30 * 1.01 * opacity if opacity >= ALPHA_MIN else 0.0)


def _mask_apart() -> tuple[FrameTargets, Splats]:
    """A mask on the right of the picture, and an object's splats on its left."""
    labels = torch.zeros(48, 64, dtype=torch.int64)
    labels[16:30, 44:58] = 1
    ones = torch.ones(48, 64)
    nothing = torch.zeros(48, 64, dtype=torch.bool)
    flow = torch.zeros(48, 64, 2)
    target = FrameTargets(torch.zeros(48, 64, 3), labels, ones, nothing, ones, ones, flow, ones, True)
    generator = torch.Generator().manual_seed(0)
    means = 0.15 * torch.randn(60, 3, generator=generator) + torch.tensor([-1.0, 0.0, 3.0])
    features = torch.cat([torch.rand(60, 3, generator=generator), torch.ones(60, 1)], dim=1)
    quats = torch.tensor([1.0, 0, 0, 0]).repeat(60, 1)
    return target, Splats(means, quats, torch.full((60, 3), 0.05), torch.full((60,), 0.9), features)


def _loss(shown: Rendering, target: FrameTargets, means: torch.Tensor, view) -> torch.Tensor:
    layout = Layout(labels=1, flow=False)
    inside = (target.labels > 0).float()
    pose, intrinsics = torch.eye(4), torch.from_numpy(view.K).float()
    centre = safemath.project(means.mean(dim=0, keepdim=True), pose, intrinsics, view.near)[0]
    return (
        losses.coverage_loss(shown, layout, target, inside)
        + losses.label_loss(shown, layout, target)
        + losses.miss_loss(shown, layout, target, centre)
    )


def test_n14_an_object_beside_its_mask_finds_it() -> None:
    target, splats = _mask_apart()
    view = camera(64, 48)
    offset = torch.zeros(3, requires_grad=True)
    optimiser = torch.optim.Adam([offset], lr=0.03)
    for _ in range(100):
        optimiser.zero_grad()
        means = splats.means + offset
        shown = autograd.splat(Splats(means, splats.quats, splats.scales, splats.opacities, splats.features), view)
        loss = _loss(shown, target, means, view)
        assert torch.isfinite(loss)
        loss.backward()
        optimiser.step()
    inside, drawn = target.labels == 1, shown.alpha.detach() > 0.5
    assert float((inside & drawn).sum() / (inside | drawn).sum()) > 0.2


def test_n14_an_object_that_reaches_its_mask_is_left_to_the_other_terms() -> None:
    target, _ = _mask_apart()
    features = torch.zeros(48, 64, 4)
    features[20, 50, 3] = 0.5
    shown = Rendering(features, torch.zeros(48, 64), torch.zeros(48, 64))
    assert float(losses.miss_loss(shown, Layout(labels=1, flow=False), target, torch.zeros(1, 2))) == 0.0
