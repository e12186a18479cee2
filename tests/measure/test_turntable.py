"""Flicker, holes and thickness of scenes in which each is known."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from genmojo_core.errors import GenmojoError
from genmojo_core.measure.turntable import thickness, turntable_figures
from tests.scenes import small_scene


def test_what_motion_explains_is_no_flicker_and_what_blinks_is():
    scene = small_scene(per_object=300, turn=4.0)
    blinking = np.zeros((4, len(scene.xyz), 3), np.float32)
    blinking[1::2] = 0.3  # 0.28 * 0.3 of 255 is 22 levels; colours that are full already stay
    steady = turntable_figures(scene, (0.0, 30.0))["turntable"]
    flickers = turntable_figures(replace(scene, d_dc=blinking), (0.0, 30.0))["turntable"]
    for azimuth in ("0", "30"):
        assert steady[azimuth]["flicker"] < 4.0
        assert 12.0 < flickers[azimuth]["flicker"] - steady[azimuth]["flicker"] < 22.0


def test_a_card_is_flat_and_a_ball_is_not():
    scene = small_scene(per_object=400)
    assert all(share < 0.1 for share in thickness(scene).values())
    rng = np.random.default_rng(1)
    ball = rng.normal(size=scene.xyz.shape)
    ball *= 0.5 / np.linalg.norm(ball, axis=1, keepdims=True)
    assert all(share > 0.9 for share in thickness(replace(scene, xyz=ball.astype(np.float32))).values())


def test_holes_are_seen():
    scene = small_scene(per_object=1500, shift=0.0)
    scene = replace(scene, scale=0.3 * scene.scale)
    closed = turntable_figures(scene, (0.0,))["turntable"]["0"]["holes"]
    apart = np.linalg.norm(scene.xyz[:, :2], axis=1) > 0.3
    ring = turntable_figures(replace(scene, opacity=np.where(apart, scene.opacity, 0.0)), (0.0,))["turntable"]["0"]
    assert closed < 1.0
    assert ring["holes"] > 5.0


def test_nothing_to_look_at():
    scene = small_scene()
    with pytest.raises(GenmojoError, match="no Gaussians"):
        turntable_figures(replace(scene, xyz=scene.xyz[:0]))
    alone = turntable_figures(small_scene(frames=1), (0.0,))["turntable"]["0"]
    assert np.isnan(alone["flicker"])
