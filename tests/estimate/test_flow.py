"""Flow between frames: exact shifts, occlusion found invalid, degenerate sizes."""

import numpy as np
import pytest
from estimate_pictures import squares, texture, window
from hypothesis import given, settings
from hypothesis import strategies as st

from genmojo_core.estimate.flow import FlowOnDemand, closes, forward_backward, sequence_flow, warp


@pytest.mark.parametrize("shift", [(0, 0), (3, -2), (7.5, 1.25)])
def test_a_shifted_texture_gives_its_shift(shift):
    big = texture(160, 180)
    a, b = window(big, 20, 20, 128, 112), window(big, 20 - shift[0], 20 - shift[1], 128, 112)
    pair = forward_backward(a, b)
    inner = (slice(16, -16), slice(16, -16))
    assert np.abs(pair.forward[inner] - shift).mean() < 0.12
    assert np.abs(pair.backward[inner] + shift).mean() < 0.12
    assert pair.forward_valid[inner].mean() > 0.98


def test_what_gets_covered_is_invalid_and_the_rest_is_valid():
    frames, labels, _ = squares(step=8)
    pair = forward_backward(frames[0], frames[1])
    covered = (labels[1] > 0) & (labels[0] == 0)
    far = np.zeros_like(covered)
    far[:20] = far[-20:] = True
    assert pair.forward_valid[covered].mean() < 0.5
    assert pair.forward_valid[far].mean() > 0.98


def test_leaving_the_frame_is_invalid():
    there = np.zeros((8, 8, 2), np.float32)
    there[..., 0] = 100
    assert not closes(there, -there).any()


def test_the_tolerance_is_the_method_s():
    there, back = np.zeros((8, 8, 2), np.float32), np.zeros((8, 8, 2), np.float32)
    back[..., 0] = 0.5  # |F + B| = 0.5 against 0.01 * 0.5 + 0.5
    assert closes(there, back).all()
    back[..., 0] = 0.52
    assert not closes(there, back).any()


def test_a_still_has_no_flow():
    flows = sequence_flow(texture(40, 50)[None])
    assert flows.forward.shape == (1, 40, 50, 2)
    assert not flows.forward_valid.any() and not flows.backward_valid.any() and not flows.forward.any()


def test_the_last_frame_points_nowhere_and_both_ways_are_inverse():
    frames, _, _ = squares(count=3)
    flows = sequence_flow(frames)
    assert not flows.forward_valid[-1].any() and not flows.backward_valid[0].any()
    error = np.linalg.norm(flows.forward[0] + warp(flows.backward[1], flows.forward[0]), axis=-1)
    assert np.median(error[flows.forward_valid[0]]) < 0.2


@settings(max_examples=12, deadline=None)
@given(st.integers(1, 40), st.integers(1, 40), st.integers(0, 3))
def test_any_size_and_flat_pictures_are_finite(height, width, kind):
    rng = np.random.default_rng(height * 41 + width)
    a = np.full((height, width, 3), 255 * (kind % 2), np.uint8)
    b = a if kind < 2 else rng.integers(0, 256, (height, width, 3), dtype=np.uint8)
    pair = forward_backward(a, b)
    assert pair.forward.shape == (height, width, 2) and np.isfinite(pair.forward).all()


def test_flow_on_demand_is_the_flow_of_the_sequence(monkeypatch):
    rng = np.random.default_rng(2)
    picture = rng.integers(0, 255, (48, 90, 3), np.uint8)
    frames = np.stack([picture[:, 3 * t : 3 * t + 64] for t in range(6)])
    whole, lazy = sequence_flow(frames), FlowOnDemand(frames)
    monkeypatch.setattr("genmojo_core.estimate.flow._KEPT", 2)  # so that some are found twice
    for a, b in ((0, 1), (1, 0), (4, 5), (5, 4), (0, 1)):
        np.testing.assert_array_equal(lazy.between(a, b), whole.between(a, b))
        np.testing.assert_array_equal(whole.between(a, b), (whole.forward if b > a else whole.backward)[a])
