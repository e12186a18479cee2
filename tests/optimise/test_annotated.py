"""Annotated tracks as supervision: their places in space are exact where depth and cameras are, and hidden frames stay
silent. Not covered: how much better a scene gets by them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from genmojo_core.clip.clip import Channel
from genmojo_core.clip.synthetic import generate
from genmojo_core.clip.synthetic_specs import spec
from genmojo_core.estimate.complete import complete
from genmojo_core.optimise.annotated import with_annotated
from genmojo_core.optimise.motion import initial_motion
from genmojo_core.tracks.annotation import CONFIRMED, KEY, UNCERTAIN
from genmojo_core.tracks.model import NONE, OCCLUDED, VISIBLE, PointTracks
from genmojo_core.tracks.supervision import sure


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
