"""Camera paths: they pass their keys, stand where they hold, and are smooth and rigid between."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from genmojo_core.clip.camera_path import CameraKey, CameraPath, key_of, key_view
from genmojo_core.clip.cameras import View
from genmojo_core.conventions import quaternion_to_matrix
from genmojo_core.errors import GenmojoError


def key(seconds, seed=0, hold=0.0, fov=50.0, scene_time=0.0):
    rng = np.random.default_rng(seed)
    pose = np.eye(4)
    pose[:3, :3] = quaternion_to_matrix(rng.normal(size=4))
    pose[:3, 3] = rng.normal(size=3)
    return CameraKey(pose, fov, scene_time, seconds, hold)


def centre(k):
    return -k.world_to_camera[:3, :3].T @ k.world_to_camera[:3, 3]


@given(st.lists(st.tuples(st.floats(0.1, 3), st.sampled_from([0.0, 0.5]), st.floats(0, 30)), min_size=1, max_size=5),
       st.booleans())  # fmt: skip
@settings(max_examples=50, deadline=None)
def test_keys_are_passed_and_poses_stay_rigid(rows, closed):
    keys, clock = [], 0.0
    for i, (wait, hold, scene_time) in enumerate(rows):
        keys.append(key(clock, i, hold, 40 + i, scene_time))
        clock += hold + wait
    path = CameraPath("p", tuple(keys), closed)
    for k in keys:
        for moment in {k.seconds, k.seconds + k.hold / 2}:
            if closed and moment >= path.seconds:
                continue
            found = path.at(moment)
            np.testing.assert_allclose(found.world_to_camera, k.world_to_camera, atol=1e-7)
            assert found.fov == pytest.approx(k.fov) and found.scene_time == pytest.approx(k.scene_time)
    for moment in np.linspace(-1, path.seconds + 1, 23):
        turn = path.at(float(moment)).world_to_camera[:3, :3]
        np.testing.assert_allclose(turn @ turn.T, np.eye(3), atol=1e-9)


def test_the_way_is_continuous_and_a_closed_one_comes_back():
    path = CameraPath("p", tuple(key(2.0 * i, i) for i in range(4)), closed=True)
    assert path.seconds == pytest.approx(8.0)
    clock = np.linspace(0, 16, 4001)
    places = np.array([centre(path.at(float(c))) for c in clock])
    assert np.abs(np.diff(places, axis=0)).max() < 0.02
    np.testing.assert_allclose(places[0], places[2000], atol=1e-6)


def test_a_straight_pan_is_straight_and_even():
    """Four keys on a line at even times: Catmull-Rom gives even motion between the middle two."""
    keys = []
    for i in range(4):
        pose = np.eye(4)
        pose[0, 3] = -i
        keys.append(CameraKey(pose, 50, 10.0 * i, float(i)))
    path = CameraPath("p", tuple(keys))
    for moment in (1.0, 1.25, 1.5, 1.9):
        assert centre(path.at(moment))[0] == pytest.approx(moment) and path.at(moment).scene_time == pytest.approx(
            10 * moment
        )


def test_json_round_trip_and_faults():
    path = CameraPath("p", (key(0), key(1, 1, hold=2)), True)
    assert CameraPath.from_json(path.to_json()).to_json() == path.to_json()
    wrong = np.eye(4)
    wrong[0, 0] = 2
    for keys in ((), (key(1), key(0)), (key(0, hold=2), key(1)), (CameraKey(wrong, 50, 0, 0),), (key(0, fov=0),)):
        with pytest.raises(GenmojoError):
            CameraPath("p", keys)
    for data in ({}, {"keys": 3}, {"keys": [{}]}, {"keys": [{**path.to_json()["keys"][0], "fov": "wide"}]}):
        with pytest.raises(GenmojoError):
            CameraPath.from_json(data)


def test_a_key_sees_what_its_camera_saw():
    view = View(key(0, 3).world_to_camera, 90.0, 100.0, 32.0, 24.0, 64, 48)
    back = key_view(key_of(view, 1.5, 0.0), view)
    np.testing.assert_allclose(back.K, view.K)
    np.testing.assert_allclose(back.world_to_camera, view.world_to_camera)
