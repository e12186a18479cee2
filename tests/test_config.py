"""Presets and their faults, conventions of views and rotations, events as plain data."""

import json
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from genmojo_core import conventions
from genmojo_core.config import PRESETS, Goal, goal_of, preset
from genmojo_core.errors import GenmojoError
from genmojo_core.events import Step

UNITS = st.lists(st.floats(-1, 1), min_size=4, max_size=4).filter(lambda q: np.linalg.norm(q) > 1e-3)


@pytest.mark.parametrize("name", sorted(PRESETS))
def test_every_preset_is_valid_and_json(name: str) -> None:
    assert preset(name).preset == name
    json.dumps(preset(name).to_json())


def test_all_faults_are_told_together() -> None:
    with pytest.raises(GenmojoError) as caught:
        preset("draft", short_side=-3, motion_bases=0, ignore=("sound",), prior="sketch")
    for part in ("short_side is -3", "motion_bases is 0", "cannot ignore 'sound'", "no prior 'sketch'"):
        assert part in caught.value.sentence()
    assert "\n" not in caught.value.sentence()


def test_a_draft_of_rigid_objects_has_more_steps_unless_steps_are_asked_for() -> None:
    draft = preset("draft")
    assert draft.joint_steps_of(bends=False) > draft.joint_steps_of(bends=True) == draft.joint_steps
    assert preset("draft", joint_steps=10).joint_steps_of(bends=False) == 10
    assert preset("draft", joint_steps=10, rigid_steps=15).joint_steps_of(bends=False) == 15
    assert preset("full").joint_steps_of(bends=False) == preset("full").joint_steps


def test_goals_are_read_as_a_person_writes_them() -> None:
    assert goal_of("") is None
    assert goal_of("psnr>=26") == goal_of(" PSNR >= 26.0 dB ") == Goal("psnr", 26.0)
    assert goal_of("gain<0.1dB/min") == goal_of("gain < .1 dB/min") == Goal("gain", 0.1)
    for wrong in ("psnr>26", "gain<0.1", "psnr>=", "ssim>=0.9"):
        with pytest.raises(GenmojoError, match="no goal"):
            preset("draft", until=wrong)


@pytest.mark.parametrize("value", [math.nan, math.inf, "many", 0])
def test_a_number_that_is_none_is_refused(value: object) -> None:
    with pytest.raises(GenmojoError, match="short_side"):
        preset("draft", short_side=value)


def test_unknown_names_are_refused() -> None:
    with pytest.raises(GenmojoError, match="draft, standard, full"):
        preset("fast")
    with pytest.raises(GenmojoError, match="no setting sharpness"):
        preset("draft", sharpness=2)


@given(UNITS)
def test_quaternions_and_matrices_are_inverse(quat: list[float]) -> None:
    rotation = conventions.quaternion_to_matrix(np.array(quat))
    assert np.allclose(rotation @ rotation.T, np.eye(3), atol=1e-9)
    back = conventions.quaternion_to_matrix(conventions.matrix_to_quaternion(rotation))
    assert np.allclose(back, rotation, atol=1e-9)


@given(UNITS, UNITS)
def test_multiplying_quaternions_multiplies_rotations(a: list[float], b: list[float]) -> None:
    first, second = (conventions.normalise_quaternions(np.array(q)) for q in (a, b))
    product = conventions.quaternion_to_matrix(conventions.quaternion_multiply(first, second))
    expected = conventions.quaternion_to_matrix(first) @ conventions.quaternion_to_matrix(second)
    assert np.allclose(product, expected, atol=1e-9)


def test_positive_azimuth_moves_the_camera_to_its_right_and_positive_elevation_up() -> None:
    camera = np.eye(4)
    camera[2, 3] = 4.0  # at z = -4, looks along +z at the origin; up is -y
    up = np.array([0.0, -1.0, 0.0])
    here = np.linalg.inv(camera)
    right = np.linalg.inv(conventions.orbit_camera(camera, np.zeros(3), up, 0, 30))
    above = np.linalg.inv(conventions.orbit_camera(camera, np.zeros(3), up, 30, 0))
    assert (right[:3, 3] - here[:3, 3]) @ here[:3, 0] > 0
    assert (above[:3, 3] - here[:3, 3]) @ up > 0
    for turned in (right, above):
        assert np.linalg.norm(turned[:3, 3]) == pytest.approx(4.0)  # rigid about the target
        assert np.allclose(turned[:3, 2], -turned[:3, 3] / 4.0)  # and it still looks at it


def test_no_turn_is_the_input_camera() -> None:
    camera = np.eye(4)
    camera[:3, 3] = [0.3, -0.2, 5.0]
    same = conventions.orbit_camera(camera, np.array([0.1, 0.2, 3.0]), np.array([0.0, -1.0, 0.0]), 0, 0)
    assert np.allclose(same, camera)


def test_events_are_plain_data() -> None:
    event = Step(1.5, 2.5, "joint", 3, 10, 0.25, {"rgb": 0.2}, 100, 24.0, 0.3, 3.5)
    assert json.loads(json.dumps(event.to_json()))["losses"] == {"rgb": 0.2}
    assert event.to_json()["event"] == "Step"
