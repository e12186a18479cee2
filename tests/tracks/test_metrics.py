"""Track metrics against hand-computed cases and their own definitions (METHOD.md section 8 and appendix B)."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from genmojo_core.errors import GenmojoError
from genmojo_core.tracks.metrics import THRESHOLDS, fit_similarity, select, space_metrics, track_metrics
from genmojo_core.tracks.model import NONE, OCCLUDED, VISIBLE, PointTracks


def make(xy, state=None, size=(256, 256)) -> PointTracks:
    xy = np.asarray(xy, np.float32)
    state = np.full(xy.shape[:2], VISIBLE) if state is None else np.asarray(state)
    return PointTracks(xy, state.astype(np.uint8), np.ones(len(xy), np.int64), size)


def line(points: int = 4, frames: int = 12) -> np.ndarray:
    t = np.arange(frames)[None, :, None]
    return 20.0 * np.arange(points)[:, None, None] + np.array([3.0, 1.0]) * t + 10


def shifted(truth: PointTracks, offsets) -> PointTracks:
    """The truth moved by offsets (P, T) to the right."""
    xy = truth.xy.astype(np.float64).copy()
    xy[..., 0] += np.asarray(offsets)
    return make(xy, truth.state, truth.size)


def test_perfect_prediction():
    truth = make(line())
    found = track_metrics(truth, truth)
    assert found["ate"] == found["mte"] == found["a_epe"] == found["m_epe"] == 0
    assert found["aj"] == found["delta"] == found["oa"] == found["survival"] == 100
    assert found["aj_strided"] == found["delta_strided"] == found["oa_strided"] == 100


def test_right_places_all_claimed_hidden():
    """Appendix B: AJ 0, delta 1."""
    truth = make(line())
    found = track_metrics(make(line(), np.full((4, 12), OCCLUDED)), truth)
    assert found["aj"] == 0 and found["delta"] == 100 and found["oa"] == 0


def test_within_is_strict():
    """Appendix B: an error of exactly d pixels is not within d."""
    truth = make(line())
    for d in THRESHOLDS:
        at = track_metrics(shifted(truth, np.full((4, 12), float(d))), truth)
        below = track_metrics(shifted(truth, np.full((4, 12), d - 0.01)), truth)
        assert at[f"delta_{d}"] == 0 and below[f"delta_{d}"] == 100


def test_one_lost_track_moves_the_mean_not_the_median():
    """Appendix B: a track lost in a third of its frames changes ATE, not MTE."""
    offsets = np.zeros((4, 12))
    offsets[0, 8:] = 90
    found = track_metrics(shifted(make(line()), offsets), make(line()))
    assert found["ate"] == pytest.approx(90 * 4 / 48) and found["mte"] == 0 and found["mte_pooled"] == 0
    assert found["a_epe"] == pytest.approx(90 / 4) and found["m_epe"] == 0
    assert found["survival"] == pytest.approx(100 * 44 / 48)


def test_median_is_per_track_then_mean():
    """MTE is the mean of per-track medians; the pooled median differs."""
    offsets = np.array([[0, 0, 0], [0, 6, 9], [0, 8, 30]], float)
    truth = make(line(3, 3))
    found = track_metrics(shifted(truth, offsets), truth)
    assert found["mte"] == pytest.approx((0 + 6 + 8) / 3)
    assert found["mte_pooled"] == 0
    assert found["ate"] == pytest.approx(53 / 9)
    assert found["a_epe"] == pytest.approx(13) and found["m_epe"] == pytest.approx(9)


def test_x_and_y_are_scaled_on_their_own():
    """1920 x 1080: 7.5 px in x and 4.21875 px in y are each 1 px at 256."""
    truth = make(line(), size=(1920, 1080))
    right, down = truth.xy + np.float32([7.5, 0]), truth.xy + np.float32([0, 4.21875])
    assert track_metrics(make(right, size=(1920, 1080)), truth)["ate"] == pytest.approx(1, abs=1e-5)
    assert track_metrics(make(down, size=(1920, 1080)), truth)["ate"] == pytest.approx(1, abs=1e-5)


def test_sizes_may_differ():
    truth = make(line(), size=(256, 256))
    assert track_metrics(make(line() * [2, 4], size=(512, 1024)), truth)["ate"] == pytest.approx(0, abs=1e-5)


def test_hidden_frames_are_scored_on_their_own():
    state = np.full((2, 4), VISIBLE)
    state[:, 2] = OCCLUDED
    offsets = np.array([[0, 0, 10, 0], [0, 2, 20, 0]], float)
    truth = make(line(2, 4), state)
    found = track_metrics(shifted(make(line(2, 4)), offsets), truth)
    assert found["hidden"] == 15 and found["ate_visible"] == pytest.approx(2 / 6) and found["ate"] == 4


def test_jaccard_by_hand():
    """One track, query at 0, frames 1..4. Truth visible in 1, 2, 4; claimed in 1, 2, 3; frame 2 is 3 px off.

    d = 4: TP 2 (frames 1, 2), FP 1 (frame 3), positives 3 -> 2/4. d = 2: TP 1, FP 2 -> 1/5. OA = 2/4.
    """
    truth = make(line(1, 5), [[1, 1, 1, 2, 1]])
    guess = make(shifted(make(line(1, 5)), [[0, 0, 3, 0, 0]]).xy, [[1, 1, 1, 1, 2]])
    found = track_metrics(guess, truth)
    expected = np.mean([1 / 5, 1 / 5, 2 / 4, 2 / 4, 2 / 4])
    assert found["aj"] == pytest.approx(100 * expected)
    assert found["oa"] == pytest.approx(50)
    assert found["delta"] == pytest.approx(100 * np.mean([2 / 3, 2 / 3, 1, 1, 1]))


def test_frames_before_the_query_do_not_count_in_first():
    """A point first seen in frame 3: what is claimed before is not scored by TAP-Vid "first"."""
    truth = make(line(1, 6), [[2, 2, 2, 1, 1, 1]])
    found = track_metrics(make(line(1, 6)), truth)
    assert found["oa"] == 100
    assert found["oa_strided"] == pytest.approx(100 * 2 / 5)  # one query, at frame 5


def test_missing_predictions_cost():
    """Leaving points out gains nothing: the last known place counts."""
    truth = make(line(1, 4))
    xy = truth.xy.copy()
    xy[0, 2:] = np.nan
    found = track_metrics(make(xy, [[1, 1, NONE, NONE]]), truth)
    step = np.hypot(3, 1)
    assert found["missing"] == 2 and found["ate"] == pytest.approx((step + 2 * step) / 4, rel=1e-5)
    nothing = track_metrics(make(np.full((1, 4, 2), np.nan), np.zeros((1, 4))), truth)
    assert nothing["missing"] == 4 and nothing["ate"] > 50


def test_truth_without_a_last_frame_is_skipped_and_counted():
    state = np.full((2, 3), VISIBLE)
    state[0, 2] = NONE
    truth = make(line(2, 3), state)
    found = track_metrics(shifted(make(line(2, 3)), [[0, 0, 50], [0, 0, 4]]), truth)
    assert found["epe_skipped"] == 1 and found["a_epe"] == 4 and found["ate"] == pytest.approx(4 / 5)


def test_other_counts_are_refused():
    with pytest.raises(GenmojoError, match="4 tracks over 12 frames are compared with 3 over 12"):
        track_metrics(make(line()), make(line(3)))
    with pytest.raises(GenmojoError):
        track_metrics(make(line()), make(line(), np.zeros((4, 12))))


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_tap_figures_equal_their_definition(seed):
    """AJ, delta and OA, first and strided, against loops written from the definition."""
    rng = np.random.default_rng(seed)
    points, frames = 3, 11
    truth = make(rng.uniform(0, 60, (points, frames, 2)), rng.choice([0, 1, 1, 2], (points, frames)))
    truth.state[:, 0] = VISIBLE
    guess = make(truth.xy + rng.normal(0, 6, truth.xy.shape), rng.choice([1, 1, 2], (points, frames)))
    found = track_metrics(guess, truth)
    for suffix, queries in (("", lambda p: [int(np.argmax(truth.visible[p]))]), ("_strided", _asked(truth))):
        right = total = positives = 0
        hits, false, within_visible = (np.zeros(len(THRESHOLDS)) for _ in range(3))
        for p in range(points):
            for q in queries(p):
                for t in range(frames):
                    if truth.state[p, t] == NONE or (t <= q if suffix == "" else t == q):
                        continue
                    v, w = bool(truth.visible[p, t]), bool(guess.visible[p, t])
                    error = np.linalg.norm(guess.xy[p, t].astype(float) - truth.xy[p, t].astype(float))
                    within = np.array([error < d for d in THRESHOLDS])
                    total, right, positives = total + 1, right + (v == w), positives + v
                    hits += within & v & w
                    false += w & (~within | (not v))
                    within_visible += within & v
        assert found[f"oa{suffix}"] == pytest.approx(100 * right / total)
        if positives:
            assert found[f"aj{suffix}"] == pytest.approx(100 * np.mean(hits / (positives + false)))
            assert found[f"delta{suffix}"] == pytest.approx(100 * np.mean(within_visible / positives))


def _asked(truth):
    return lambda p: [t for t in range(0, truth.state.shape[1], 5) if truth.visible[p, t]]


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 2**32 - 1), st.floats(0.1, 10))
def test_similarity_fit_finds_a_known_one(seed, scale):
    """Umeyama: any rotation, scale and shift is found; errors in space vanish after the fit only."""
    rng = np.random.default_rng(seed)
    source = rng.normal(size=(20, 3))
    turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    turn *= np.sign(np.linalg.det(turn))
    target = scale * source @ turn.T + rng.normal(size=3)
    s, r, t = fit_similarity(source, target)
    assert s == pytest.approx(scale) and np.allclose(r, turn, atol=1e-6)
    found = space_metrics(source.reshape(4, 5, 3), target.reshape(4, 5, 3), fit=True)
    assert found["ate_3d"] == pytest.approx(0, abs=1e-6) and found["fit_scale"] == pytest.approx(scale)
    assert space_metrics(source.reshape(4, 5, 3), target.reshape(4, 5, 3), fit=False)["ate_3d"] == pytest.approx(
        np.linalg.norm(source - target, axis=1).mean()
    )
    assert np.allclose(s * source @ r.T + t, target, atol=1e-6)


def test_errors_in_space_as_a_share_of_the_objects():
    """Two objects of sizes 2 and 4 that drift: an error of 0.3 is 10 % of their mean size, wherever they are."""
    rod = np.array([[-1.0, 0, 0], [0, 0, 0], [1, 0, 0]])
    drift = np.arange(5)[None, :, None] * np.ones(3)
    truth = np.concatenate([rod[:, None] + drift, 2 * rod[:, None] - drift])
    found = space_metrics(truth + [0, 0.3, 0], truth, False, np.array([1, 1, 1, 2, 2, 2]))
    assert found["ate_3d"] == pytest.approx(0.3) and found["ate_3d_percent"] == pytest.approx(10.0)
    assert "ate_3d_percent" not in space_metrics(truth[:1], truth[:1], False, np.array([1])), "a point has no size"


def test_a_mirror_is_not_a_rotation():
    """Mirrored points cannot be fitted: R stays right-handed."""
    source = np.random.default_rng(0).normal(size=(30, 3))
    _, rotation, _ = fit_similarity(source, source * [-1, 1, 1])
    assert np.linalg.det(rotation) == pytest.approx(1)
    assert fit_similarity(source[:1], source[:1] + 3)[0] == 1.0


def test_select_keeps_rows_together():
    tracks = make(line(), np.arange(48).reshape(4, 12) % 4)
    part = select(tracks, np.array([True, False, True, False]), np.array([0, 5]))
    np.testing.assert_array_equal(part.xy, tracks.xy[[0, 2]][:, [0, 5]])
    np.testing.assert_array_equal(part.state, tracks.state[[0, 2]][:, [0, 5]])
