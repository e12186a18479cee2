"""Guessed and cleaned depth: never NaN, in the order of occlusion, smooth in time."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from genmojo_core.clip.cameras import Cameras
from genmojo_core.estimate.depth import clean_depth, guess_depth, keep_order, nearest_fill, smooth_series, spread
from genmojo_core.estimate.ground import PointStage, Stage, guess_ground
from genmojo_core.estimate.order import front_votes, object_motion
from genmojo_core.estimate.shapes import inside_distance, measure_shapes, rounded


def rig(count, height=64, width=64):
    lens = np.array([[70.0, 0, width / 2], [0, 70, height / 2], [0, 0, 1]])
    return Cameras(np.tile(lens, (count, 1, 1)), np.tile(np.eye(4), (count, 1, 1)), (width, height))


def passing(count=9, front_moves=True):
    """Labels and flow of object 1 (square) passing in front of object 2 (bar)."""
    labels, flow = np.zeros((count, 64, 96), np.uint8), np.zeros((count, 64, 96, 2), np.float32)
    for t in range(count):
        bar = slice(40, 60) if front_moves else slice(60 - 4 * t, 80 - 4 * t)
        square = slice(16 + 4 * t, 36 + 4 * t) if front_moves else slice(36, 56)
        labels[t, 10:50, bar] = 2
        flow[t, 10:50, bar, 0] = 0 if front_moves else -4
        labels[t, 20:40, square] = 1
        flow[t, 20:40, square, 0] = 4 if front_moves else 0
    return labels, flow


@pytest.mark.parametrize("front_moves", [True, False])
def test_the_one_that_hides_the_other_is_in_front(front_moves):
    labels, flow = passing(front_moves=front_moves)
    votes = front_votes(labels, 2, flow)
    touching = votes[:, 0, 1] != 0
    assert touching.sum() >= 4
    assert (votes[touching, 0, 1] > 0).all()
    assert np.array_equal(votes, -votes.transpose(0, 2, 1))


def test_a_still_notch_tells_the_order_without_motion():
    labels, flow = passing(count=1)
    labels[:] = 0
    labels[0, 10:50, 30:70] = 2
    labels[0, 20:40, 45:80] = 1
    assert front_votes(labels, 2, flow)[0, 0, 1] > 0


def test_affine_motion_is_recovered_despite_a_third_of_junk():
    y, x = np.mgrid[:60, :60].astype(float)
    flow = np.stack([0.05 * x + 2, -0.02 * y - 1], -1).astype(np.float32)
    flow[:20] = 9
    motion = object_motion(np.ones((60, 60), bool), flow)
    at = motion @ [30, 40, 1]
    assert np.abs(at - [0.05 * 30 + 2, -0.02 * 40 - 1]).max() < 0.25


def test_guess_keeps_the_order_where_masks_touch_and_is_finite():
    labels, flow = passing()
    votes = front_votes(labels, 2, flow)
    depth, plate = guess_depth(labels, 2, rig(len(labels), 64, 96), votes)
    assert np.isfinite(depth).all() and (depth > 0).all() and np.isfinite(plate).all()
    for t in np.flatnonzero(votes[:, 0, 1] > 0):
        assert depth[t][labels[t] == 1].max() < depth[t][labels[t] == 2].min()
    assert (plate > depth.max(axis=0) * (labels > 0).any(axis=0) * 0.999).all()


def test_guess_changes_by_at_most_five_percent_a_frame():
    labels, flow = passing(count=14)
    depth, _ = guess_depth(labels, 2, rig(14, 64, 96), front_votes(labels, 2, flow))
    for k in (1, 2):
        series = np.log([np.median(depth[t][labels[t] == k]) for t in range(14)])
        assert np.abs(np.diff(series)).max() < 0.08  # the clamp, and what the median moves over the relief


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 10_000))
def test_order_is_kept_exactly_for_any_acyclic_votes(seed):
    rng = np.random.default_rng(seed)
    frames, objects = int(rng.integers(1, 12)), int(rng.integers(1, 5))
    rank = rng.permutation(objects)
    ahead = np.sign(rank[None] - rank[:, None])
    votes = ahead[None] * (rng.random((frames, 1, 1)) < 0.5)
    thickness = rng.uniform(0.01, 0.2, objects)
    found = keep_order(rng.normal(0, 1, (frames, objects)), votes, thickness)
    gap = found[:, None, :] - found[:, :, None] - thickness[:, None] - thickness[None]
    assert (gap[votes > 0] > 0).all() and np.isfinite(found).all()


def test_votes_in_a_circle_still_end():
    votes = np.array([[[0, 1, -1], [-1, 0, 1], [1, -1, 0]]], float)
    assert np.isfinite(keep_order(np.zeros((1, 3)), votes, np.full(3, 0.1))).all()


def test_spread_is_over_the_need_and_slow():
    need = np.zeros((9, 1))
    need[4] = 0.1
    curve = spread(need)
    assert (curve >= need).all() and curve[4] == 0.1
    assert np.abs(np.diff(curve[:, 0])).max() <= 0.03 + 1e-12


def test_smoothing_of_a_constant_and_of_a_step():
    assert np.allclose(smooth_series(np.full(7, 2.0)), 2.0)
    step = np.concatenate([np.zeros(5), np.ones(30)])
    smooth = smooth_series(step)
    assert np.abs(np.diff(smooth)).max() <= 0.05 + 1e-12 and np.allclose(smooth_series(np.zeros(1)), 0)


def test_given_depth_is_filled_by_its_object():
    labels = np.zeros((2, 8, 8), np.uint8)
    labels[:, 2:6, 2:6] = 1
    depth = np.where(labels == 1, 3.0, 9.0).astype(np.float32)
    valid = np.ones(depth.shape, bool)
    depth[0, 2, 2], depth[0, 3, 3], depth[0, 4, 4] = np.nan, 0, -1
    depth[1, labels[1] == 1], valid[1, labels[1] == 1] = np.inf, False
    depth[0, 0, 0] = np.nan
    clean = clean_depth(depth, valid, labels)
    assert (clean[labels == 1] == 3).all() and (clean[labels == 0] == 9).all()


def test_depth_without_a_valid_value_is_finite():
    clean = clean_depth(np.full((1, 4, 4), np.nan), np.zeros((1, 4, 4), bool), np.zeros((1, 4, 4), np.uint8))
    assert (clean == 1).all()


def test_nearest_fill():
    values, known = np.array([[5.0, 0, 0, 0, 7]], np.float32), np.array([[True, False, False, False, True]])
    assert nearest_fill(values, known)[0, [1, 3]].tolist() == [5, 7]


@pytest.mark.parametrize("pixels", [[], [(10, 10)], [(63, 0)], [(r, c) for r in range(64) for c in range(64)]])
def test_odd_masks(pixels):
    labels = np.zeros((3, 64, 64), np.uint8)
    for r, c in pixels:
        labels[1, r, c] = 1
    labels[:, 30:34, 40:44] = 2
    depth, plate = guess_depth(labels, 3, rig(3), front_votes(labels, 3, np.zeros((3, 64, 64, 2), np.float32)))
    assert np.isfinite(depth).all() and (depth > 0).all() and (plate > 0).all()


def test_a_disc_bulges_like_a_ball_and_a_hidden_edge_does_not():
    y, x = np.mgrid[:60, :60] - 29.5
    disc = np.hypot(x, y) < 20
    relief = rounded(disc, np.zeros_like(disc))
    ball = np.sqrt(np.clip(1 - (np.hypot(x, y) / 20) ** 2, 0, 1))
    assert np.abs(relief - ball)[disc].mean() < 0.06
    cover = disc & (x > 0)
    half = rounded(disc & ~cover, cover)
    assert half[30, 28] > 0.9  # at the cut, deep inside the whole disc
    assert inside_distance(np.ones((6, 6), bool)).max() > 0


def test_oblong_pixels_make_a_thin_person_as_thick_as_it_is():
    mask = np.zeros((1, 80, 80), np.uint8)
    mask[0, 20:60, 35:45] = 1
    thin, wide = (measure_shapes(mask, 1, aspect).radius[0] for aspect in (1.0, 2.0))
    assert wide == pytest.approx(2 * thin, rel=0.15)


def test_ground_depth_is_the_plane_s():
    view = rig(1, 100, 100).view(0)
    stage = Stage(guess_ground(view, np.array([np.nan])), 50.0)
    horizon = 35.0
    for row in (60.0, 90.0):
        ray = np.array([0, (row - 50) / 70, 1.0])
        depth = float(stage.ground_depth(view, np.array([50.0]), np.array([row]))[0])
        assert stage.normal @ (ray * depth) == pytest.approx(1.0)
    assert float(stage.ground_depth(view, np.array([50.0]), np.array([horizon]))[0]) >= 30


def test_points_of_a_slanted_wall_give_its_depth():
    rng = np.random.default_rng(0)
    xy = rng.uniform(-2, 2, (300, 2))
    points = np.column_stack([xy, 4 + 0.5 * xy[:, 0]])
    view = rig(1, 64, 64).view(0)
    x, y = np.meshgrid(np.arange(64) + 0.5, np.arange(64) + 0.5)
    truth = 4 / (1 - 0.5 * (x - 32) / 70)
    found = PointStage(points, Stage(np.array([0.0, 1, 0]), 9.0)).depth(view)
    assert np.abs(found / truth - 1).mean() < 0.01
