"""Image figures against hand-computed values and the textbook sums."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from genmojo_core.measure.images import PSNR_MAX, instance_ious, iou, psnr, ssim


def test_psnr_of_a_constant_error():
    """An error of 0.1 everywhere is 20 dB; equal pictures report the cap."""
    a = np.full((8, 9, 3), 0.5)
    assert psnr(a, a + 0.1) == pytest.approx(20)
    assert psnr(a, a) == PSNR_MAX


def test_masked_psnr_is_the_sum_over_the_mask():
    """-10 log10(sum m e^2 / (3 sum m)): what lies outside does not count."""
    rng = np.random.default_rng(0)
    a, b, mask = rng.random((8, 9, 3)), rng.random((8, 9, 3)), rng.random((8, 9)) > 0.5
    expected = -10 * np.log10(np.sum(mask[..., None] * (a - b) ** 2) / (3 * mask.sum()))
    assert psnr(a, b, mask) == pytest.approx(expected)
    b[~mask] = 0
    assert psnr(a, b, mask) == pytest.approx(expected)
    assert np.isnan(psnr(a, b, np.zeros((8, 9), bool)))


@settings(max_examples=10, deadline=None)
@given(st.integers(0, 1000), st.integers(11, 20))
def test_ssim_equals_its_definition(seed, side):
    """Sums over every whole 11 x 11 window with Gaussian weights, sigma 1.5."""
    rng = np.random.default_rng(seed)
    a = rng.random((side, side, 3))
    b = np.clip(a + rng.normal(0, 0.2, a.shape), 0, 1)
    g = np.exp(-np.square(np.arange(11) - 5) / (2 * 1.5**2))
    window = np.outer(g, g) / np.outer(g, g).sum()
    values = []
    for i in range(side - 10):
        for j in range(side - 10):
            for c in range(3):
                p, q = a[i : i + 11, j : j + 11, c], b[i : i + 11, j : j + 11, c]
                mp, mq = (window * p).sum(), (window * q).sum()
                vp, vq = (window * (p - mp) ** 2).sum(), (window * (q - mq) ** 2).sum()
                cov = (window * (p - mp) * (q - mq)).sum()
                values.append((2 * mp * mq + 1e-4) * (2 * cov + 9e-4) / ((mp**2 + mq**2 + 1e-4) * (vp + vq + 9e-4)))
    assert ssim(a, b) == pytest.approx(np.mean(values), abs=1e-9)
    assert ssim(a, a) == pytest.approx(1)


def test_ssim_of_tiny_pictures():
    a = np.random.default_rng(0).random((4, 5, 3))
    assert ssim(a, a) == pytest.approx(1) and ssim(a, 1 - a) < 0.5


def test_iou():
    a, b = np.zeros((4, 4), bool), np.zeros((4, 4), bool)
    assert iou(a, b) == 1
    a[:2], b[1:3] = True, True
    assert iou(a, b) == pytest.approx(4 / 12)


def test_instance_ious_leave_void_and_absent_objects_out():
    masks = np.zeros((4, 4), int)
    masks[0], masks[1] = 1, 2
    labels = masks.copy()
    labels[0, 0] = 2
    valid = np.ones((4, 4), bool)
    found = instance_ious(labels, masks, valid, 3)
    assert found[0] == pytest.approx(3 / 4) and found[1] == pytest.approx(4 / 5) and np.isnan(found[2])
    valid[0, 0] = False
    np.testing.assert_allclose(instance_ious(labels, masks, valid, 2), [1, 1])
