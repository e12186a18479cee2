"""Pictures of baked scenes: where things land, that shares add up, and what files without a scene say."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scenes import small_scene

from genmojo_core.clip.cameras import Cameras
from genmojo_core.errors import GenmojoError
from genmojo_core.measure.views import Look, orbit_target, orbit_view, render_frame, short_side_size


def centroid(mask: np.ndarray) -> np.ndarray:
    rows, columns = np.nonzero(mask)
    return np.array([columns.mean() + 0.5, rows.mean() + 0.5])


def test_discs_are_where_their_cameras_put_them():
    """Disc 1 at (-0.6, 0, 4) moves right 0.1 a frame: 76.8 * 0.1 / 4 px; shares add up to alpha; colours are theirs."""
    scene = small_scene(size=(96, 72), per_object=400)
    for t in (0, 3):
        picture = render_frame(scene, t, scene.cameras.view(t))
        np.testing.assert_allclose(picture.labels.sum(-1), picture.alpha, atol=1e-4)
        where = picture.instance() == 1
        expected = 96 / 2 + 1.2 * 96 * (-0.6 + 0.1 * t) / 4
        assert centroid(where)[0] == pytest.approx(expected, abs=0.7)
        assert picture.on()[where].mean(axis=0)[0] > 0.8
        row, column = centroid(where)[::-1].astype(int)
        assert picture.depth[row, column] == pytest.approx(4, abs=0.05)


def test_nearer_hides_farther():
    """When the discs meet, the nearer one's label wins."""
    scene = small_scene(frames=8, shift=0.085, per_object=400)
    t = 7
    both = render_frame(scene, t, scene.cameras.view(t))
    centre = np.array([64 / 2 + 76.8 * (-0.6 + 0.085 * t) / 4, 24]).astype(int)
    assert both.instance()[centre[1], centre[0]] == 1


def test_objects_only_and_backdrops():
    scene = small_scene()
    picture = render_frame(scene, 0, scene.cameras.view(0), Look(objects_only=True))
    assert picture.alpha[0, 0] < 0.01 and picture.instance()[0, 0] == -1
    np.testing.assert_allclose(picture.on()[0, 0], 1, atol=0.01)
    np.testing.assert_allclose(picture.on((0.0, 0.0, 0.0))[0, 0], 0, atol=0.01)
    rgba = picture.straight_rgba()
    disc = picture.instance() == 1
    assert rgba[disc][:, 3].min() > 120 and rgba[disc][:, 0].mean() > 230 and rgba[0, 0].tolist() == [0, 0, 0, 0]
    without = small_scene(background=False)
    np.testing.assert_allclose(render_frame(without, 0, without.cameras.view(0)).on()[0, 0], 1, atol=0.01)


def test_flow_is_the_discs_motion():
    scene = small_scene(size=(96, 72), per_object=400)
    view = scene.cameras.view(1)
    picture = render_frame(scene, 1, view, Look(flow_to=view))
    disc = picture.labels[..., 1] > 0.98 * picture.alpha
    np.testing.assert_allclose(np.median(picture.flow[disc], axis=0), [1.2 * 96 * 0.1 / 4, 0], atol=0.05)
    last = render_frame(scene, 3, view, Look(flow_to=view))
    assert np.abs(last.flow).max() < 1e-3


def test_resized_views_show_the_same():
    """Half the size is the same picture, area-averaged."""
    scene = small_scene(size=(96, 72), per_object=400)
    big = render_frame(scene, 0, scene.cameras.view(0)).on()
    small = render_frame(scene, 0, scene.cameras.view(0).resized(48, 36)).on()
    assert np.abs(big.reshape(36, 2, 48, 2, 3).mean(axis=(1, 3)) - small).mean() < 0.03


def test_orbit_turns_about_the_objects():
    """The target stays in the middle of the picture's motion: it projects to the same pixel from every side."""
    scene = small_scene()
    target = orbit_target(scene)
    assert target == pytest.approx([0.05, 0.05, 4.5], abs=0.5)
    view = scene.cameras.view(0)
    pixels = []
    for elevation, azimuth in ((0, 0), (0, 30), (30, 0), (0, 180)):
        turned = orbit_view(scene, 0, elevation, azimuth, target)
        x, y, z = turned.world_to_camera[:3, :3] @ target + turned.world_to_camera[:3, 3]
        pixels.append((view.fx * x / z + view.cx, view.fy * y / z + view.cy, z))
    np.testing.assert_allclose(pixels, [pixels[0]] * 4, atol=1e-6)
    above = orbit_view(scene, 0, 30, 0, target)
    assert np.linalg.inv(above.world_to_camera)[1, 3] < -1  # y is down: above is negative


def test_colour_change_can_be_dropped():
    scene = small_scene()
    d_dc = np.zeros((4, len(scene.xyz), 3), np.float32)
    d_dc[2] = 1.0
    changed = replace(scene, d_dc=d_dc)
    view = scene.cameras.view(2)
    plain = render_frame(scene, 2, view).on()
    np.testing.assert_array_equal(render_frame(changed, 2, view, Look(color_change="none")).on(), plain)
    assert np.abs(render_frame(changed, 2, view).on() - plain).mean() > 0.02


def test_nothing_to_draw():
    scene = small_scene()
    with pytest.raises(GenmojoError, match="there is no frame 9"):
        render_frame(scene, 9, scene.cameras.view(0))
    empty = replace(scene, xyz=scene.xyz[:0])
    with pytest.raises(GenmojoError, match="no Gaussians"):
        render_frame(empty, 0, scene.cameras.view(0))
    away = Cameras(scene.cameras.K, scene.cameras.world_to_camera @ np.diag([1, -1, -1, 1.0]), (64, 48))
    picture = render_frame(scene, 0, away.view(0))
    assert picture.alpha.max() == 0 and np.isfinite(picture.depth).all() and (picture.instance() == -1).all()


def test_short_side_size():
    assert short_side_size((1920, 1080), 256) == (455, 256) and short_side_size((512, 512), 256) == (256, 256)
