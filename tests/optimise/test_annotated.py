"""Annotated tracks as supervision: their places in space are exact where depth and cameras are, and hidden frames stay
silent, but for places that a person gave behind something. Not covered: how much better a scene gets by them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import torch

from genmojo_core.clip.clip import Channel, Clip
from genmojo_core.clip.synthetic import Truth, generate
from genmojo_core.clip.synthetic_specs import spec
from genmojo_core.estimate.complete import complete
from genmojo_core.optimise.annotated import with_annotated
from genmojo_core.optimise.motion import initial_motion
from genmojo_core.optimise.run import Run
from genmojo_core.scene.safemath import project
from genmojo_core.tracks.annotation import CONFIRMED, KEY, UNCERTAIN
from genmojo_core.tracks.model import NONE, OCCLUDED, VISIBLE, PointTracks
from genmojo_core.tracks.supervision import hidden_by_people, sure
from tests.optimise.small_runs import small_run


def test_given_tracks_join_the_motions_own_with_their_true_places() -> None:
    clip, truth = generate(replace(spec("crossing-shapes"), frames=5, novel_every=0, size=(128, 72)))
    state = np.where(truth.visible, VISIBLE, OCCLUDED).astype(np.uint8)
    tracks = PointTracks(truth.tracks.astype(np.float32), state, truth.track_object, clip.source_size)
    clip = complete(clip)
    motions = initial_motion(clip)
    assert with_annotated(clip, motions)[0] is motions[0]
    given = clip.with_channels(tracks=Channel(tracks, state > 0, "given: test"))
    for k, (before, after) in enumerate(zip(motions, with_annotated(given, motions), strict=True)):
        rows = np.flatnonzero(truth.track_object == clip.object_ids[k])
        rows = rows[truth.visible[rows].any(axis=1)]
        assert len(after.track_xyz) == len(before.track_xyz) + len(rows)
        new = slice(len(before.track_xyz), None)
        assert np.array_equal(after.track_conf[new] > 0, truth.visible[rows])
        error = np.linalg.norm(after.track_xyz[new] - truth.track_xyz[rows, before.ref_frame], axis=1)
        assert np.median(error) < 0.05
        assert after.track_xy[new][truth.visible[rows]] == pytest.approx(
            truth.tracks[rows][truth.visible[rows]], abs=1e-3
        )


def test_people_who_contradict_the_motion_are_heard_beside_its_hundreds_of_tracks() -> None:
    clip, _ = generate(replace(spec("crossing-shapes"), frames=5, novel_every=0, size=(128, 72)))
    clip = complete(clip)
    motions = initial_motion(clip)
    before, rows = motions[0], np.arange(0, 60, 6)
    state = np.where(before.track_conf[rows] > 0.5, VISIBLE, OCCLUDED).astype(np.uint8)
    owner = np.full(len(rows), clip.object_ids[0])
    for off, least, most in ((0.0, 0.0, 0.15), (6.0, 0.25, 0.45)):
        xy = before.track_xy[rows] + np.where(np.arange(5) == before.ref_frame, 0.0, off)[:, None]
        tracks = PointTracks(xy.astype(np.float32), state, owner, clip.size)
        after = with_annotated(clip.with_channels(tracks=Channel(tracks, state > 0, "given: test")), motions)[0]
        share = after.track_conf[len(before.track_conf) :].sum() / before.track_conf.sum()
        assert least < share < most


def test_only_what_a_person_said_leads_where_flags_tell_it() -> None:
    clip, truth = generate(replace(spec("crossing-shapes"), frames=5, novel_every=0, size=(128, 72)))
    state = np.where(truth.visible, VISIBLE, OCCLUDED).astype(np.uint8)
    flags = np.zeros(state.shape, np.uint8)
    flags[:, 0], flags[:, 1], flags[:, 2] = KEY, CONFIRMED, KEY | UNCERTAIN
    told = sure(PointTracks(truth.tracks.astype(np.float32), state, truth.track_object, clip.source_size, flags=flags))
    assert (told.state[:, :2] == state[:, :2]).all() and (told.state[:, 2:] == NONE).all()
    assert sure(replace(told, flags=np.zeros_like(flags))).state is told.state, "nobody said anything: all counts"


def test_a_hidden_place_that_a_person_gave_counts_for_less_and_others_not_at_all() -> None:
    xy, state = np.full((4, 5, 2), 9.0, np.float32), np.full((4, 5), OCCLUDED, np.uint8)
    flags = np.zeros(state.shape, np.uint8)
    state[:, 0], flags[:, 0] = VISIBLE, KEY
    state[0, 2], flags[0, 2] = VISIBLE, KEY
    flags[0, 1], flags[1, 1], flags[2, 1] = KEY, CONFIRMED, KEY | UNCERTAIN
    tracks = PointTracks(xy, state, np.ones(4, np.int64), (128, 72), flags=flags)
    expected = np.zeros(state.shape, bool)
    expected[0, 1] = True
    assert (hidden_by_people(tracks) == expected).all() and (hidden_by_people(sure(tracks)) == expected).all()
    assert not hidden_by_people(replace(tracks, flags=None)).any()
    clip, _ = generate(replace(spec("crossing-shapes"), frames=5, novel_every=0, size=(128, 72)))
    clip = complete(clip)
    motions = initial_motion(clip)
    centre = np.argwhere(clip.object_mask(0)[0]).mean(axis=0)[::-1]
    xy[:], xy[0, 1:] = centre + 0.5, centre + 25.0  # where no motion brings it
    given = clip.with_channels(tracks=Channel(replace(tracks, xy=xy), state > 0, "given: test"))
    after = with_annotated(given, motions)[0]
    conf, places = after.track_conf[-4:], after.track_xy[-4:]
    assert (conf[1:, 1:] == 0).all() and (conf[0, 3:] == 0).all()
    assert 0 < conf[0, 1] < 0.5 * conf[0, 2], "less than a seen one"
    assert places[0, 1] == pytest.approx(xy[0, 1])
    centres = [np.argwhere(clip.object_mask(0)[t]).mean(axis=0)[::-1] for t in range(1, 5)]
    assert np.linalg.norm(places[1, 1:] - centres, axis=1).max() < 15, "silent ones go with the object"


@pytest.fixture(scope="module")
def carried() -> dict[float, tuple[np.ndarray, np.ndarray]]:
    """By how far (px) hidden keys were placed off (below) the truth, None for no such keys: how far the optimised
    surface points are from the truth in the frames with hidden places (n, 2), and in the others (m, 2)."""
    clip, truth = generate(replace(spec("crossing-shapes"), frames=9, size=(128, 72), tracks=12))
    clip = complete(clip)
    hidden = ~truth.visible & ((truth.tracks > 0) & (truth.tracks < np.array(clip.source_size))).all(axis=2)
    found = {}
    for off in (None, 4.0):
        xy, flags = truth.tracks.astype(np.float32), np.zeros(hidden.shape, np.uint8)
        flags[:, ::2] = KEY * truth.visible[:, ::2]
        if off is not None:
            flags[hidden] = KEY
            xy[hidden] += (0.0, off)
        state = np.where(truth.visible, VISIBLE, OCCLUDED).astype(np.uint8)
        tracks = PointTracks(xy, state, truth.track_object, clip.source_size, flags=flags)
        run = small_run(clip.with_channels(tracks=Channel(tracks, state > 0, "given: test")), joint_steps=40)
        for _ in run:
            pass
        found[off] = _missed(run, clip, truth, hidden)
    return found


def _missed(run: Run, clip: Clip, truth: Truth, hidden: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    behind, seen = [], []
    for k, (model, tracks) in enumerate(zip(run.scene.objects, run.objective.tracks, strict=True)):
        every = list(range(len(clip)))
        there = model.carry(tracks.points, every)
        pixels = torch.stack([project(there[t], run.scene.w2c[t], run.scene.K[t], 0.01)[0] for t in every], 1)
        rows = np.flatnonzero((truth.track_object == clip.object_ids[k]) & truth.visible[:, ::2].any(axis=1))
        gap = pixels.detach().numpy()[-len(rows) :] - truth.tracks[rows]
        behind.append(gap[hidden[rows]])
        seen.append(gap[truth.visible[rows]])
    return np.concatenate(behind), np.concatenate(seen)


def test_hidden_keys_move_the_hidden_surface_and_leave_what_is_seen(carried: dict) -> None:
    (before, seen_before), (after, seen_after) = carried[None], carried[4.0]
    assert np.median(after[:, 1]) > np.median(before[:, 1]) + 0.2, "towards the keys, which are below"
    assert abs(np.median(after[:, 0]) - np.median(before[:, 0])) < 0.2, "and not sideways"
    off_before, off_after = (np.median(np.linalg.norm(gap, axis=1)) for gap in (seen_before, seen_after))
    assert off_after < off_before + 0.15, "what is seen stays where it is"
