"""Values and gradients at the edges: rows N01, N02, N03, N11 and N30 of the reliability study."""

import math

import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st

from genmojo_core.scene import safemath


def test_n01_division_by_zero_gives_zero_and_no_gradient() -> None:
    top = torch.tensor([1.0, 2.0, -3.0], requires_grad=True)
    bottom = torch.tensor([0.0, 1e-12, 2.0], requires_grad=True)
    value = safemath.safe_divide(top, bottom)
    value.sum().backward()
    assert value.tolist() == [0.0, 0.0, -1.5]
    assert top.grad.tolist() == [0.0, 0.0, 0.5]
    assert bottom.grad.tolist() == [0.0, 0.0, 0.75]


@pytest.mark.parametrize("length", [0.0, 1e-20, 1e-3, 1.0, 1e18])
def test_n02_quaternions_of_any_length_become_unit_with_small_gradients(length: float) -> None:
    quats = torch.tensor([[0.1, 0.7, -0.5, 0.5]]) * length
    quats.requires_grad_()
    unit = safemath.normalise(quats)
    unit[0, 1].backward()
    assert float(unit.norm()) == pytest.approx(1.0, abs=1e-5)
    assert torch.isfinite(quats.grad).all()
    if length < 1e-8:
        assert unit.tolist() == [[1.0, 0.0, 0.0, 0.0]]
        assert float(quats.grad.abs().max()) == 0.0


@pytest.mark.parametrize("log_scale", [-math.inf, -100.0, 11.1, 89.0, math.inf])
def test_n03_scales_stay_finite(log_scale: float) -> None:
    assert torch.isfinite(safemath.exp_scale(torch.tensor(log_scale)))


@given(st.floats(0.0, 1.0))
def test_n11_logit_is_finite_and_inverts_the_sigmoid(probability: float) -> None:
    value = safemath.logit(torch.tensor(probability))
    assert abs(float(value)) <= safemath.LOGIT_LIMIT
    assert float(torch.sigmoid(value)) == pytest.approx(probability, abs=1e-5)


def test_log_continues_below_its_floor_with_a_gradient() -> None:
    value = torch.tensor([0.0, 1e-6, 0.5], requires_grad=True)
    out = safemath.safe_log(value, 1e-4)
    out.sum().backward()
    assert torch.isfinite(out).all()
    assert value.grad[0] == pytest.approx(1e4)  # a pixel nobody covers still pulls
    assert value.grad[2] == pytest.approx(2.0)
    assert bool((out.diff() > 0).all())


@pytest.mark.parametrize("angle", [0.0, 1e-9, 1e-5, 1.0, math.pi])
def test_n30_rotation_vectors_have_exact_gradients_from_zero_to_half_a_turn(angle: float) -> None:
    vector = torch.tensor([0.36, -0.48, 0.8], dtype=torch.float64) * angle
    vector.requires_grad_()
    assert torch.autograd.gradcheck(safemath.rotation_vector_to_quaternion, (vector,), atol=1e-7)


def test_rotate_agrees_with_the_matrix_of_the_quaternion() -> None:
    from genmojo_core.conventions import quaternion_to_matrix

    generator = torch.Generator().manual_seed(0)
    quats = safemath.normalise(torch.randn(50, 4, generator=generator, dtype=torch.float64))
    vectors = torch.randn(50, 3, generator=generator, dtype=torch.float64)
    expected = torch.tensor(quaternion_to_matrix(quats.numpy())) @ vectors[..., None]
    assert torch.allclose(safemath.rotate(quats, vectors), expected[..., 0], atol=1e-12)
