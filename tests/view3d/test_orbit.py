"""Views by numbers: exactly the core's convention, exactly back, continuous over the poles."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scenes import small_scene

from genmojo_core.clip.cameras import View
from genmojo_core.conventions import axis_angle_matrix, orbit_camera
from genmojo_core.errors import GenmojoError
from genmojo_core.measure.views import orbit_target, orbit_view
from genmojo_studio.view3d.orbit import PRESETS, Orbit, Reference, between, parse, reference_of
from genmojo_studio.view3d.snapshot import SceneSnapshot

angle = st.floats(-179.5, 179.5)


def reference(pitch: float = 12.0, yaw: float = 40.0, roll: float = 0.0) -> Reference:
    """A camera looking down by `pitch`, rolled by `roll`, at a target that is not in its middle."""
    turn = axis_angle_matrix(np.array([0, 1.0, 0]), yaw) @ axis_angle_matrix(np.array([1.0, 0, 0]), -pitch)
    pose = np.eye(4)
    pose[:3, :3] = (turn @ axis_angle_matrix(np.array([0, 0, 1.0]), roll)).T
    pose[:3, 3] = (0.3, -0.2, 2.0)
    return Reference(View(pose, 300, 310, 170, 110, 320, 240), np.array([0.5, 0.1, 1.0]), np.array([0, -1.0, 0]))


@settings(max_examples=150, deadline=None)
@given(st.floats(-75, 75), angle, angle, st.floats(0.2, 9), st.floats(-20, 20))
def test_numbers_survive_the_way_to_a_camera_and_back(
    elevation: float, azimuth: float, roll: float, radius: float, pitch: float
) -> None:
    """Within 1e-6 degrees, whatever the input camera's own tilt, short of the poles, where numbers are not unique."""
    assume(abs(elevation + pitch) < 89)
    given_orbit = Orbit(elevation, azimuth, roll, radius)
    found = reference(pitch).orbit_of(reference(pitch).pose(given_orbit))
    assert found.elevation == pytest.approx(elevation, abs=1e-6)
    assert math.remainder(found.azimuth - azimuth, 360) == pytest.approx(0, abs=1e-6)
    assert math.remainder(found.roll - roll, 360) == pytest.approx(0, abs=1e-6)
    assert found.radius == pytest.approx(radius, rel=1e-9)
    assert np.abs(found.shift).max() < 1e-9


@settings(max_examples=100, deadline=None)
@given(angle, angle, angle, st.tuples(*[st.floats(-3, 3)] * 3))
def test_any_camera_survives_the_way_to_numbers_and_back(
    elevation: float, azimuth: float, roll: float, shift: tuple[float, float, float]
) -> None:
    """Also beyond the poles and shifted, where other numbers mean the same camera."""
    ref = reference()
    pose = ref.pose(Orbit(elevation, azimuth, roll, 2.0, None, shift))
    again = ref.pose(ref.orbit_of(pose))
    assert np.abs(again - pose).max() < 1e-9 * 10


@pytest.mark.parametrize("elevation", [-90.0, 90.0])
def test_straight_above_and_below(elevation: float) -> None:
    ref = Reference(View(np.eye(4), 300, 300, 160, 120, 320, 240), np.array([0, 0, 2.0]), np.array([0, -1.0, 0]))
    pose = ref.pose(Orbit(elevation, 35.0))
    found = ref.orbit_of(pose)
    assert found.roll == pytest.approx(0, abs=1e-6)
    assert found.azimuth == pytest.approx(35.0, abs=1e-6)
    assert np.abs(ref.pose(found) - pose).max() < 1e-9
    near = [ref.pose(Orbit(e, 35.0)) for e in np.linspace(elevation - 1, elevation + 1, 9)]
    assert max(np.abs(b - a).max() for a, b in zip(near, near[1:], strict=False)) < 0.02  # nothing flips


def test_it_is_the_cores_convention() -> None:
    """The same camera as `genmojo render --elevation 20 --azimuth -35`, and the input camera itself at (0, 0)."""
    scene = small_scene(frames=3)
    snapshot = SceneSnapshot.from_baked(scene, 1)
    ref = reference_of(snapshot)
    wanted = orbit_view(scene, 1, 20, -35, orbit_target(scene))
    got = ref.view_of(Orbit(20, -35), *scene.cameras.size)
    assert np.abs(got.world_to_camera - wanted.world_to_camera).max() < 1e-12
    assert (got.fx, got.fy, got.cx, got.cy, got.dilation) == pytest.approx(
        (wanted.fx, wanted.fy, wanted.cx, wanted.cy, wanted.dilation)
    )
    same = ref.view_of(Orbit(), *scene.cameras.size)
    assert np.abs(same.world_to_camera - scene.cameras.view(1).world_to_camera).max() < 1e-12


def test_signs() -> None:
    """+ azimuth: the camera moves to its right. + elevation: it looks from above."""
    ref = Reference(View(np.eye(4), 300, 300, 160, 120, 320, 240), np.array([0, 0, 2.0]), np.array([0, -1.0, 0]))
    centre = {name: -p[:3, :3].T @ p[:3, 3] for name in PRESETS for p in [ref.pose(PRESETS[name])]}
    assert centre["right_30"][0] > 0.5
    assert centre["left_90"] == pytest.approx([-2, 0, 2])
    assert centre["above_30"][1] < -0.5  # y is down
    assert centre["back"] == pytest.approx([0, 0, 4])
    rolled = ref.pose(Orbit(roll=90))
    assert rolled[:3, :3] @ np.array([0, -1.0, 0]) == pytest.approx([-1, 0, 0])  # camera clockwise: the world left


def test_the_clip_fits_the_window_and_keeps_its_place() -> None:
    """A wide window shows more at the sides; the clip's pixels lie centred and undistorted, also with pixel aspect."""
    ref = reference()
    view = ref.view_of(Orbit(), 1000, 480)
    assert view.fx / ref.view.fx == pytest.approx(2.0)
    assert (view.cx - 500) / 2 == pytest.approx(ref.view.cx - 160)
    wide = ref.view_of(Orbit(), 640, 240, pixel_aspect=2.0)
    assert wide.fx / wide.fy == pytest.approx(2 * ref.view.fx / ref.view.fy)
    narrow = ref.view_of(Orbit(fov=ref.fov / 2), 320, 240)
    assert narrow.fy == pytest.approx(0.5 * 240 / math.tan(math.radians(ref.fov / 4)))
    assert narrow.dilation / ref.view.dilation == pytest.approx((narrow.fy / ref.view.fy) ** 2)


def test_moving_cameras_are_interpolated() -> None:
    scene = small_scene(frames=2)
    poses = scene.cameras.world_to_camera.copy()
    poses[1] = orbit_camera(np.eye(4), np.array([0, 0, 4.0]), np.array([0, -1.0, 0]), 0, 40)
    from dataclasses import replace

    snapshot = SceneSnapshot.from_baked(replace(scene, cameras=replace(scene.cameras, world_to_camera=poses)), 0)
    middle = reference_of(snapshot, 0.5).view.world_to_camera
    assert middle[:3, :3] @ middle[:3, :3].T == pytest.approx(np.eye(3))
    turn = math.degrees(math.acos((np.trace(middle[:3, :3]) - 1) / 2))
    assert turn == pytest.approx(20)


def test_the_way_between_two_views_is_short_and_ends_exactly() -> None:
    ref = reference()
    a, b = Orbit(0, 170), Orbit(30, -170, 0, 5.0, 30.0, (1, 0, 0))
    azimuths = [between(a, b, s, ref).azimuth % 360 for s in np.linspace(0, 1, 11)]
    assert min(azimuths) >= 170 - 1e-9
    assert max(azimuths) <= 190 + 1e-9
    assert between(a, b, 0.0, ref).elevation == 0
    assert between(a, b, 1.0, ref) == b


def test_views_travel_as_text() -> None:
    orbit = Orbit(1 / 3, -12.5, 0.1, 2.7, 41.0, (0.5, -1e-7, 3.0))
    assert parse(orbit.text()) == orbit
    assert parse("azimuth=30, elevation: -5") == Orbit(-5, 30)
    for wrong in ("", "elevation", "elevation up", "elevation 3 4", "shift 1 2", "zoom 3", "elevation nan"):
        with pytest.raises(GenmojoError):
            parse(wrong)


def test_without_cameras_everything_is_in_view() -> None:
    from tests.view3d.scenes_gl import random_snapshot

    snapshot = random_snapshot(200)
    view = reference_of(snapshot).view_of(Orbit(), 640, 360)
    points = snapshot.positions @ view.world_to_camera[:3, :3].T + view.world_to_camera[:3, 3]
    x, y = view.fx * points[:, 0] / points[:, 2] + view.cx, view.fy * points[:, 1] / points[:, 2] + view.cy
    assert (points[:, 2] > 0).all()
    assert ((x > 0) & (x < 640) & (y > 0) & (y < 360)).mean() > 0.9
