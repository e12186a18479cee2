"""Motion of long clips and motion in a hurry: rotations stay rotations, key frames are enough, deadlines are kept."""

from __future__ import annotations

import math
import time
from dataclasses import replace

import numpy as np
import pytest

from genmojo_core.clip.clip import Clip
from genmojo_core.clip.synthetic import Truth, generate
from genmojo_core.clip.synthetic_specs import spec
from genmojo_core.estimate.complete import complete
from genmojo_core.optimise import motion_solver
from genmojo_core.optimise.deadline import NO_DEADLINE, Deadline
from genmojo_core.optimise.keyframes import MOST_KEYS, key_frames, spread_path
from genmojo_core.optimise.motion import ObjectMotion, carry, initial_motion
from genmojo_core.optimise.motion_solver import _continued
from genmojo_core.optimise.poses import exp_rotation, log_rotation, still_path


def small_clip(frames: int) -> tuple[Clip, Truth]:
    return generate(replace(spec("crossing-shapes"), frames=frames, size=(96, 54), novel_every=0))


def errors(clip: Clip, truth: Truth, motions: list[ObjectMotion]) -> np.ndarray:
    """(P, T) distance in pixels of carried frame-0 queries to the truth."""
    first = truth.visible[:, 0]
    queries, owner = truth.tracks[first, 0], truth.track_object[first] - 1
    xy = carry(motions, clip, np.zeros(len(queries), int), queries, owner)
    return np.linalg.norm(xy - truth.tracks[first], axis=-1)


def test_a_rotation_predicted_over_a_thousand_frames_stays_a_rotation() -> None:
    path = still_path(1000, np.zeros(3), 0)
    path = path.moved(1, exp_rotation(np.array([0.05, 0.02, -0.03])), np.ones(3))
    for t in range(2, 1000):
        path = path.moved(t, *_continued(path, t, 1))
    assert np.abs(path.rotation @ path.rotation.transpose(0, 2, 1) - np.eye(3)).max() < 1e-12


def test_key_frames_hold_the_reference_and_are_few() -> None:
    for frames, ref in ((24, 5), (48, 0), (49, 48), (300, 17), (5000, 4999)):
        keys = key_frames(frames, ref)
        assert ref in keys and len(keys) <= MOST_KEYS and keys[0] >= 0 and keys[-1] < frames
    assert len(key_frames(48, 3)) == 48


def test_a_path_spread_from_its_keys_goes_through_them_and_turns_evenly() -> None:
    keys = np.array([1, 4, 7])
    path = still_path(3, np.zeros(3), 1).moved(0, exp_rotation(np.array([0.0, 0.0, 0.3])), np.array([3.0, 0.0, 0.0]))
    path = path.moved(2, exp_rotation(np.array([0.6, 0.0, 0.0])), np.array([0.0, 6.0, 0.0]))
    whole = spread_path(path, keys, 9)
    assert whole.ref == 4
    assert np.allclose(whole.rotation[keys], path.rotation) and np.allclose(whole.position[keys], path.position)
    assert np.allclose(log_rotation(whole.rotation[6]), [0.4, 0.0, 0.0])
    assert np.allclose(whole.position[2], [2.0, 0.0, 0.0])
    assert np.allclose(whole.rotation[8], whole.rotation[7]) and np.allclose(whole.position[0], whole.position[1])


def test_objects_of_a_long_clip_are_followed_between_its_key_frames() -> None:
    clip, truth = small_clip(60)
    clip = complete(clip)
    motions = initial_motion(clip)
    assert not any(m.hurried for m in motions)
    assert np.median(errors(clip, truth, motions)) < 1.0
    assert (errors(clip, truth, motions) < 4.0).mean() > 0.9


def test_without_time_every_object_still_goes_where_its_pixels_are() -> None:
    clip, truth = small_clip(24)
    clip = complete(clip)
    began = time.perf_counter()
    motions = initial_motion(clip, deadline=Deadline(time.perf_counter()))
    hurried = time.perf_counter() - began
    assert all(m.hurried and np.isfinite(m.pose).all() for m in motions)
    stays = np.linalg.norm(truth.tracks - truth.tracks[:, :1], axis=-1)[truth.visible[:, 0]]
    assert errors(clip, truth, motions).mean() < 0.5 * stays.mean()
    initial_motion(clip)
    assert hurried < 0.5 * (time.perf_counter() - began - hurried)


def test_with_little_time_poses_are_solved_together_once_and_the_bend_is_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    """A search that may not match at full resolution does so at half: near the whole search, far from none."""
    clip, truth = small_clip(24)
    clip = complete(clip)
    whole = errors(clip, truth, initial_motion(clip)).mean()
    rough = errors(clip, truth, initial_motion(clip, deadline=Deadline(time.perf_counter()))).mean()
    monkeypatch.setattr(motion_solver, "_FINE_COST", math.inf)
    motions = initial_motion(clip, deadline=Deadline(time.perf_counter() + 600.0))
    assert all(m.hurried for m in motions)
    assert errors(clip, truth, motions).mean() < whole + 0.3 * (rough - whole)


def test_an_end_that_is_asked_for_comes_as_soon_as_a_deadline() -> None:
    clip, _ = small_clip(12)
    asked = []

    def stopped() -> bool:
        asked.append(1)
        return len(asked) > 5

    motions = initial_motion(complete(clip), deadline=Deadline(stopped=stopped))
    assert any(m.hurried for m in motions)


def test_a_part_of_no_deadline_is_none() -> None:
    assert not NO_DEADLINE.part(0.3).over()
