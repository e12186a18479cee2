"""Density control: each rule acts alone (N22), never empties an object (N21), carries the optimiser's moments."""

import torch

from genmojo_core.optimise import density
from genmojo_core.scene.gaussians import Gaussians


def gaussians(count: int = 100) -> Gaussians:
    generator = torch.Generator().manual_seed(0)
    return Gaussians.from_points(
        torch.rand(count, 3, generator=generator), torch.rand(count, 3, generator=generator), torch.full((count,), 0.02)
    )


def run_control(g: Gaussians, gradient: torch.Tensor, cap: int = 1000) -> tuple[int, int]:
    optimiser = torch.optim.AdamW(g.parameters(), lr=1e-3)
    statistics = density.GradientStatistics(len(g))
    statistics.add(gradient)
    return density.control(g, statistics, cap, optimiser, torch.Generator().manual_seed(0))


def test_nothing_to_do_changes_nothing() -> None:
    g = gaussians()
    before = g.means.detach().clone()
    assert run_control(g, torch.zeros(100, 3)) == (0, 0)
    assert torch.equal(g.means, before)


def test_n22_a_transparent_one_is_pruned_and_only_that() -> None:
    g = gaussians()
    with torch.no_grad():
        g.logit_opacities[7] = -9.0
    assert run_control(g, torch.zeros(100, 3)) == (0, 1)
    assert 7 not in g.uid.tolist()
    assert len(g) == 99


def test_n22_one_too_big_is_pruned_and_only_that() -> None:
    g = gaussians()
    with torch.no_grad():
        g.log_scales[3, 1] = 1.0
    assert run_control(g, torch.zeros(100, 3)) == (0, 1)
    assert 3 not in g.uid.tolist()


def test_n22_a_high_gradient_grows_and_only_there() -> None:
    g = gaussians()
    with torch.no_grad():
        g.log_scales[5] += 1.0  # bigger than the median: split
    gradient = torch.zeros(100, 3)
    gradient[5] = 1.0
    gradient[6] = 0.5
    parent = g.means[5].detach().clone()
    added, removed = run_control(g, gradient)
    assert (added, removed) == (3, 1)  # 5 becomes two, 6 gets a clone
    assert 5 not in g.uid.tolist()
    assert 6 in g.uid.tolist()
    assert len(set(g.uid.tolist())) == len(g)
    assert bool(((g.means[-3:] - parent).norm(dim=1) < 1.0).all())


def test_the_cap_holds() -> None:
    g = gaussians()
    for _ in range(30):
        run_control(g, torch.rand(len(g), 3), cap=120)
    assert len(g) <= 120


def test_n21_transparent_everywhere_keeps_some() -> None:
    g = gaussians()
    with torch.no_grad():
        g.logit_opacities.fill_(-13.0)
    run_control(g, torch.zeros(100, 3))
    assert len(g) == density.KEEP_AT_LEAST


def test_moments_follow_their_rows() -> None:
    g = gaussians(40)
    optimiser = torch.optim.AdamW(g.parameters(), lr=1e-3)
    (g.means.sum() * 2 + g.logit_opacities.sum()).backward()
    optimiser.step()
    optimiser.state[g.means]["exp_avg"][:] = torch.arange(40.0)[:, None]
    keep = torch.tensor([30, 2, 11])
    added = {name: getattr(g, name).detach()[:2] for name in Gaussians.NAMES}
    density.replace_rows(g, keep, added, optimiser)
    assert optimiser.state[g.means]["exp_avg"][:, 0].tolist() == [30.0, 2.0, 11.0, 0.0, 0.0]
    assert g.uid.tolist() == [30, 2, 11, 40, 41]
    (g.means.sum()).backward()
    optimiser.step()  # the groups hold the new parameters
    assert torch.isfinite(g.means).all()
