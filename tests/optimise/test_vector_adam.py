"""Steps of positions: along their gradient however the axes lie; AdamW's where all coordinates weigh alike."""

from __future__ import annotations

import numpy as np
import pytest
import torch
from hypothesis import given, settings
from hypothesis import strategies as st
from torch import Tensor

from genmojo_core.conventions import quaternion_to_matrix
from genmojo_core.optimise.vector_adam import VectorAdamW

RATE = 0.01


def walked(gradients: Tensor, vectors: bool = True) -> Tensor:  # (steps, N, 3) -> (steps, N, 3) places
    """Where points that start at the origin are after every step."""
    points = torch.nn.Parameter(torch.zeros(gradients.shape[1:]))
    options = {"eps": 1e-15, "betas": (0.9, 0.99), "weight_decay": 0.0}
    optimiser = VectorAdamW([{"params": [points], "lr": RATE, "vectors": vectors}], **options)
    places = []
    for gradient in gradients:
        points.grad = gradient.clone()
        optimiser.step()
        assert torch.equal(points.grad, gradient)
        places.append(points.detach().clone())
    return torch.stack(places)


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 2**31 - 1))
def test_turned_gradients_give_turned_steps(seed: int) -> None:
    rng = np.random.default_rng(seed)
    gradients = torch.tensor(rng.normal(size=(12, 5, 3)), dtype=torch.float32)
    quat = rng.normal(size=4)
    turn = torch.tensor(quaternion_to_matrix(quat / np.linalg.norm(quat)), dtype=torch.float32)
    assert torch.allclose(walked(gradients @ turn.T), walked(gradients) @ turn.T, atol=1e-5)


def test_what_hardly_counts_hardly_moves() -> None:
    """A depth whose gradient is noise, a thousandth of the others', stays; on its own step size it walks off."""
    generator = torch.Generator().manual_seed(0)
    gradients = torch.randn(300, 50, 3, generator=generator) * torch.tensor([1.0, 1.0, 1e-3])
    apart, together = walked(gradients, False)[-1, :, 2], walked(gradients)[-1, :, 2]
    assert apart.abs().mean() > 0.05
    assert together.abs().mean() < 1e-3


def test_a_first_step_is_as_long_as_the_rate_says() -> None:
    first = walked(torch.tensor([[[3.0, 0.0, 4.0]]]))[0, 0]
    assert first.tolist() == pytest.approx([-RATE * 3**0.5 * 0.6, 0.0, -RATE * 3**0.5 * 0.8], rel=1e-5)
    even = torch.full((4, 2, 3), 0.3)
    assert torch.allclose(walked(even), walked(even, False), atol=1e-6)


def test_nothing_is_nan_without_gradient() -> None:
    assert torch.equal(walked(torch.zeros(3, 4, 3)), torch.zeros(3, 4, 3))
