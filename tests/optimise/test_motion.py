"""First motion on procedural clips with exact tracks: rigid, swaying, hidden, absent; measured and guessed depth."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import cv2
import numpy as np
import pytest

from genmojo_core.clip.clip import Channel, Clip
from genmojo_core.clip.synthetic import Truth, generate
from genmojo_core.clip.synthetic_specs import spec
from genmojo_core.errors import GenmojoError
from genmojo_core.estimate.complete import complete
from genmojo_core.optimise.bend import Bend
from genmojo_core.optimise.motion import ObjectMotion, carry, default_reference, improved_depth, initial_motion
from genmojo_core.optimise.poses import Path, exp_rotation, log_rotation
from genmojo_core.trackers.stabilise import layer_of


@cache
def crossing(given: bool = True) -> tuple[Clip, Truth, list[ObjectMotion]]:
    """Ball and cube pass each other, half size and 12 frames, with their motion."""
    what = replace(spec("crossing-shapes"), frames=12, size=(144, 80), novel_every=0)
    clip, truth = generate(what if given else replace(what, given=()))
    clip = complete(clip)
    return clip, truth, initial_motion(clip)


def carried_error(clip: Clip, truth: Truth, motions: list[ObjectMotion]) -> np.ndarray:
    """(P, T) distance in pixels of carried frame-0 queries to the truth."""
    first = truth.visible[:, 0]
    queries, owner = truth.tracks[first, 0], truth.track_object[first] - 1
    xy = carry(motions, clip, np.zeros(len(queries), int), queries, owner)
    return np.linalg.norm(xy - truth.tracks[first], axis=-1)


def test_points_of_turning_objects_are_carried_within_two_pixels_also_while_hidden() -> None:
    clip, truth, motions = crossing()
    error = carried_error(clip, truth, motions)
    assert error[:, 0].max() < 0.01
    assert error.mean() < 2.0
    assert np.median(error, axis=1).mean() < 1.5


def test_without_depth_and_cameras_points_still_follow_their_object() -> None:
    clip, truth, motions = crossing(given=False)
    error = carried_error(clip, truth, motions)
    stays = np.linalg.norm(truth.tracks - truth.tracks[:, :1], axis=-1)[truth.visible[:, 0]]
    assert error.mean() < 0.2 * stays.mean()


def test_poses_are_rigid_and_the_identity_at_the_reference_frame() -> None:
    for motion in crossing()[2]:
        rotation = motion.pose[:, :3, :3]
        assert np.abs(rotation @ rotation.transpose(0, 2, 1) - np.eye(3)).max() < 1e-9
        assert np.abs(motion.pose[motion.ref_frame] - np.eye(4)).max() < 1e-9
        assert motion.pose.shape == (12, 4, 4)


def test_tracks_lie_on_the_object_where_they_are_said_to_be_seen() -> None:
    clip, _, motions = crossing()
    for k, motion in enumerate(motions):
        near = np.stack([cv2.dilate(m.astype(np.uint8), np.ones((5, 5))) for m in clip.object_mask(k)])
        sure = motion.track_conf > 0.5
        assert sure.mean() > 0.2
        point, frame = np.nonzero(sure)
        x, y = np.floor(motion.track_xy[point, frame]).astype(int).T
        assert near[frame, y, x].all()


def test_an_object_out_of_view_has_no_confidence_and_comes_back_to_its_place() -> None:
    clip, truth = generate(replace(spec("leaves-and-returns"), frames=16, size=(144, 80), novel_every=0))
    clip = complete(clip)
    motions = initial_motion(clip)
    absent = ~clip.object_mask(0).any(axis=(1, 2))
    assert absent.any()
    assert (motions[0].confidence[absent] == 0).all()
    assert np.isfinite(motions[0].pose).all()
    assert truth.visible[:, -1].any()
    middle = np.argwhere(clip.object_mask(0)[-1]).mean(axis=0)[::-1]
    assert np.linalg.norm(np.median(motions[0].track_xy[:, -1], axis=0) - middle) < 8


def test_an_object_that_is_never_seen_gets_a_motion_without_points() -> None:
    clip, _, _ = crossing()
    masks = Channel(np.where(clip.masks.value == 2, 0, clip.masks.value), clip.masks.valid, clip.masks.source)
    motion = initial_motion(clip.with_channels(masks=masks))[1]
    assert motion.track_xyz.shape == (0, 3)
    assert (motion.confidence == 0).all()
    assert np.array_equal(motion.pose, np.tile(np.eye(4), (12, 1, 1)))


def test_a_single_frame_has_motion_of_nothing() -> None:
    clip, _ = generate("still")
    clip = complete(clip)
    for motion in initial_motion(clip):
        assert motion.pose.shape == (1, 4, 4)
        assert np.abs(motion.pose[0] - np.eye(4)).max() < 1e-12
        assert len(motion.track_xyz) > 0


def test_a_clip_without_depth_is_refused_in_one_sentence() -> None:
    clip = replace(crossing()[0], depth=None)
    with pytest.raises(GenmojoError, match="has no depth"):
        initial_motion(clip)


def test_measured_depth_is_left_alone_and_guessed_depth_is_improved_inside_masks_only() -> None:
    clip, _, motions = crossing()
    assert improved_depth(clip, motions) is clip
    guessed, _, motions = crossing(given=False)
    better = improved_depth(guessed, motions)
    changed = better.depth.value != guessed.depth.value
    assert changed.any()
    assert not changed[guessed.masks.value == 0].any()
    assert not better.depth.given


def test_the_reference_frame_is_one_where_nothing_hides_the_object() -> None:
    masks = np.zeros((3, 40, 40), np.uint8)
    masks[:, 10:30, 10:30] = 1
    masks[0, 10:30, 18:34] = 2  # hides more than half in frame 0
    frames = np.zeros((3, 40, 40, 3), np.uint8)
    assert default_reference(layer_of(frames, masks, 1, np.ones(masks.shape, bool))) == 1


def test_between_frames_is_the_difference_of_poses() -> None:
    rng = np.random.default_rng(0)
    rotation = np.stack([np.eye(3), exp_rotation(rng.normal(size=3)), exp_rotation(rng.normal(size=3))])
    path = Path(rotation, rng.normal(size=(3, 3)), np.zeros(3), 0)
    path = path.moved(0, np.eye(3), path.centre)
    points = rng.normal(size=(5, 3))
    there = path.between(0, 1, points)
    assert np.allclose(path.between(1, 2, there), path.between(0, 2, points))
    moved = points @ path.matrices()[2, :3, :3].T + path.matrices()[2, :3, 3]
    assert np.allclose(moved, path.between(0, 2, points))
    assert np.allclose(exp_rotation(log_rotation(rotation[1])), rotation[1])


def test_a_bend_is_undone_exactly() -> None:
    rng = np.random.default_rng(1)
    bend = Bend(np.array([1.0, 2.0, 3.0]), 2.0, rng.normal(size=(2, 10, 3)) * 0.02)
    points = bend.centre + rng.uniform(-1, 1, size=(50, 3))
    assert np.abs(bend.undone(1, bend.at(1, points)) - points).max() < 1e-5
