"""Disparity brought to depth: exact fits, outliers, no slope, the floor, flicker."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from genmojo_core.estimate.depth_align import Alignment, fit_alignment, floor_alignment, steady

RNG = np.random.default_rng(0)
DEPTH = RNG.uniform(1.5, 9.0, (3, 20, 30))
ALL = np.ones(DEPTH.shape, bool)


@settings(max_examples=25, deadline=None)
@given(st.floats(0.01, 100), st.floats(-50, 50))
def test_any_scale_and_shift_is_found(scale, shift):
    disparity = (1 / DEPTH - shift) / scale
    fit = fit_alignment(disparity, DEPTH, ALL)
    assert fit is not None and np.abs(fit.depth(disparity) / DEPTH - 1).max() < 1e-3


def test_a_third_of_wrong_depth_does_not_matter():
    disparity, wrong = 2 / DEPTH + 0.4, DEPTH.copy()
    junk = RNG.random(DEPTH.shape) < 0.33
    wrong[junk] = 1.5
    fit = fit_alignment(disparity, wrong, ALL)
    assert np.abs(fit.depth(disparity) / DEPTH - 1).max() < 0.02


def test_noise_gives_its_error():
    disparity = 1 / (DEPTH * np.exp(RNG.normal(0, 0.05, DEPTH.shape)))
    fit = fit_alignment(disparity, DEPTH, ALL)
    assert fit.error == pytest.approx(0.05 * 0.6745, rel=0.3)


@pytest.mark.parametrize("disparity", [np.ones(DEPTH.shape), -1 / DEPTH, np.full(DEPTH.shape, np.nan)])
def test_disparity_that_says_nothing_or_the_opposite_is_no_fit(disparity):
    assert fit_alignment(disparity, DEPTH, ALL) is None
    depth = floor_alignment(disparity).depth(disparity)
    assert np.isfinite(depth).all() and (depth > 0).all()


def test_too_few_values_are_no_fit():
    few = np.zeros(DEPTH.shape, bool)
    few[0, 0, :15] = True
    assert fit_alignment(1 / DEPTH, DEPTH, few) is None


def test_the_floor_keeps_the_order_and_puts_the_median_at_three():
    disparity = 5 / DEPTH - 7
    depth = floor_alignment(disparity).depth(disparity)
    assert np.median(depth) == pytest.approx(3, rel=0.02)
    order = np.argsort(DEPTH, axis=None)
    assert (np.diff(depth.ravel()[order]) >= 0).all()


def test_depth_is_bounded_where_disparity_falls_to_zero_and_below():
    depth = Alignment(1.0, 0.0, 0.0).depth(np.array([-5.0, 0.0, 1e-9, 1.0, 1e9, np.nan]))
    assert np.isfinite(depth).all() and depth.max() / depth.min() <= 900.01


def test_flicker_is_taken_out():
    scene = np.repeat(1 / DEPTH[:1], 7, axis=0)
    scene[:, 5:9, 5:9] += np.linspace(0, 0.5, 7)[:, None, None]  # an object comes nearer
    flicker = scene * RNG.uniform(0.8, 1.3, (7, 1, 1)) + RNG.uniform(-0.2, 0.2, (7, 1, 1))
    free = np.ones(scene.shape, bool)
    free[:, 5:9, 5:9] = False
    calm = steady(flicker, free)
    assert np.abs(np.diff(calm[:, 0, 0])).max() < 1e-3 < np.abs(np.diff(flicker[:, 0, 0])).max()
    assert (np.diff(calm[:, 6, 6]) > 0).all()
