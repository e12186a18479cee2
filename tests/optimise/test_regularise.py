"""Neighbour terms: zero on rigid motion, not on a bend; neighbours right far from the origin (N24)."""

import numpy as np
import pytest
import torch

from genmojo_core.conventions import axis_angle_matrix, matrix_to_quaternion
from genmojo_core.optimise.regularise import nearest, rigidity, rigidity_torch, scale_terms
from genmojo_core.scene import safemath
from genmojo_core.scene.deform import Deformation
from genmojo_core.scene.scene4d import ObjectState


def state(means: torch.Tensor, quats: torch.Tensor) -> ObjectState:
    return ObjectState(means, quats, means, quats, torch.ones_like(means), torch.ones_like(means), None)


def cloud(count: int = 200) -> tuple[torch.Tensor, torch.Tensor]:
    generator = torch.Generator().manual_seed(0)
    return torch.rand(count, 3, generator=generator) - 0.5, safemath.normalise(
        torch.randn(count, 4, generator=generator)
    )


@pytest.mark.parametrize("angle", [0.0, 12.0, 95.0, 180.0])
def test_a_rigid_motion_with_matching_quaternions_costs_nothing(angle: float) -> None:
    means, quats = cloud()
    rotation = axis_angle_matrix(np.array([0.48, 0.6, 0.64]), angle)
    turn = torch.tensor(matrix_to_quaternion(rotation), dtype=torch.float32)
    after = state(
        means @ torch.tensor(rotation.T, dtype=torch.float32) + 2.0,
        safemath.quaternion_multiply(turn.expand_as(quats), quats),
    )
    move, spin = rigidity(state(means, quats), after, nearest(means, 15), torch.arange(len(means)))
    assert float(move) < 1e-4
    assert float(spin) < 1e-3


def test_a_bend_costs_something_and_its_gradient_is_finite() -> None:
    means, quats = cloud()
    bent = (means + torch.stack([means[:, 1] ** 2, means[:, 0] * 0, means[:, 0] * 0], 1)).requires_grad_()
    move, _ = rigidity(state(means, quats), state(bent, quats), nearest(means, 15), torch.arange(len(means)))
    move.backward()
    assert float(move.detach()) > 1e-2
    assert torch.isfinite(bent.grad).all()


@pytest.mark.parametrize("seed", range(5))
def test_the_kernel_and_its_gradients_equal_float64(seed: int) -> None:
    generator = torch.Generator().manual_seed(seed)
    means, quats = cloud()
    near, rows = nearest(means, 7), torch.randperm(200, generator=generator)[:90]
    moved = means + 0.1 * torch.randn(200, 3, generator=generator)
    turned = safemath.normalise(quats + 0.5 * torch.randn(200, 4, generator=generator)) * torch.tensor([[-1.0]])
    results = []
    for kind, term in ((torch.float32, rigidity), (torch.float64, rigidity_torch)):
        leaves = [part.detach().to(kind).requires_grad_() for part in (means, quats, moved, turned)]
        rigid, turn = term(state(*leaves[:2]), state(*leaves[2:]), near, rows)
        (0.7 * rigid + 0.2 * turn).backward()
        results.append([rigid.detach(), turn.detach(), *(leaf.grad for leaf in leaves)])
    for ours, exact in zip(*results, strict=True):
        assert float((ours.double() - exact).norm() / exact.norm()) < 5e-6


def test_n30_coincident_neighbours_have_finite_gradients() -> None:
    means = torch.zeros(20, 3, requires_grad=True)
    quats = cloud(20)[1]
    near = nearest(means, 5)
    move, spin = rigidity(state(means, quats), state(means, quats), near, torch.arange(20))
    (move + spin).backward()
    assert torch.isfinite(means.grad).all()


@pytest.mark.parametrize("offset", [0.0, 1e1, 1e3, 1e4])
def test_n24_neighbours_do_not_depend_on_where_the_cloud_is(offset: float) -> None:
    means = (cloud()[0] * 64).round() / 64  # exact in float32 at every offset
    here, there = nearest(means, 8), nearest(means + offset, 8)
    assert torch.allclose(here.weight, there.weight, atol=1e-3)


@pytest.mark.parametrize("count", [1, 2, 5])
def test_n23_fewer_points_than_neighbours(count: int) -> None:
    near = nearest(torch.zeros(count, 3), 15)
    assert near.index.shape == (count, max(1, count - 1))
    assert bool((near.index < count).all())


def test_scale_terms_see_size_and_difference() -> None:
    means, _ = cloud(50)
    near = nearest(means, 5)
    same = Deformation(means * 0, torch.full((50, 3), 0.2), torch.zeros(50, 4), None)
    local, size = scale_terms(same, near, torch.arange(50))
    assert float(local) < 1e-5
    assert float(size) == pytest.approx(0.2)
