"""Object to world: the dolly, the similarity and their baking (METHOD.md appendix B)."""

import numpy as np
import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st

from genmojo_core.conventions import axis_angle_matrix
from genmojo_core.scene import safemath
from genmojo_core.scene.placement import DOLLY_STEP, Placement, limited_dolly


def placement(frames: int = 3) -> Placement:
    pose = np.tile(np.eye(4), (frames, 1, 1))
    for t in range(frames):
        pose[t, :3, :3] = 0.7 * axis_angle_matrix(np.array([0.0, 0.6, 0.8]), 20.0 * t)
        pose[t, :3, 3] = [0.1 * t, -0.2, 4.0]
    centres = np.tile(np.array([0.3, 0.1, -0.5]), (frames, 1))
    return Placement(pose, centres)


@given(st.floats(0.3, 3.0))
def test_dolly_moves_in_depth_and_leaves_the_projection_alone(k: float) -> None:
    place = placement()
    points = torch.tensor(np.random.default_rng(0).uniform(-0.4, 0.4, (40, 3)), dtype=torch.float32)
    camera = torch.eye(4)
    camera[:3, 3] = -place.centres[1]
    K = torch.tensor([[300.0, 0, 64], [0, 300, 48], [0, 0, 1]])

    def seen() -> tuple[torch.Tensor, torch.Tensor, float]:
        size, turn, origin = place.similarity(1)
        pixels, depth = safemath.project(size * safemath.rotate(turn, points) + origin, camera, K, 0.01)
        return pixels, depth, float(size)

    pixels, depth, size = seen()
    with torch.no_grad():
        place.log_dolly[1] = float(np.log(k))
    moved, farther, larger = seen()
    assert torch.allclose(pixels, moved, atol=2e-3)
    assert torch.allclose(farther, depth * k, rtol=1e-4)
    assert larger == pytest.approx(size * k, rel=1e-5)  # sigma grows with the same frame's k


def test_baked_rows_place_points_as_the_trainable_placement_does() -> None:
    place = placement()
    with torch.no_grad():
        place.turn[2] = torch.tensor([0.1, -0.2, 0.05])
        place.shift[2] = torch.tensor([0.3, 0.0, -0.1])
        place.log_dolly[2] = 0.2
    rows, dolly = place.baked()
    size, turn, origin = place.similarity(2)
    point = torch.tensor([0.2, -0.3, 0.4])
    expected = (size * safemath.rotate(turn, point) + origin).detach().numpy()
    assert np.allclose(rows[2, :, :3] @ point.numpy() + rows[2, :, 3], expected, atol=1e-5)
    assert dolly[2] == pytest.approx(np.exp(0.2), rel=1e-5)


def test_depth_steps_are_limited_outward_from_the_canonical_frame() -> None:
    slow = np.linspace(1.0, 1.4, 30)
    assert np.array_equal(limited_dolly(slow, 12), slow)
    jump = limited_dolly(np.where(np.arange(40) < 15, 1.0, 2.0), 3)
    assert np.abs(np.diff(jump)).max() <= DOLLY_STEP + 1e-12
    assert jump[-1] == pytest.approx(2.0)
    back = limited_dolly(np.where(np.arange(40) < 5, 2.0, 1.0), 30)
    assert back[30] == 1.0
    assert back[0] == pytest.approx(1.25)  # five steps to go, all of them taken


@pytest.mark.parametrize("frames", [1, 2, 3])
def test_n19_short_clips_have_a_finite_smoothness(frames: int) -> None:
    place = placement(frames)
    value = place.smoothness()
    value.backward()
    assert float(value) == 0.0
    assert torch.isfinite(place.turn.grad).all()
