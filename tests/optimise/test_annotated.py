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
from genmojo_core.tracks.model import OCCLUDED, VISIBLE, PointTracks


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
        share = after.track_conf[new].sum() / before.track_conf.sum()
        assert share >= 0.39, "few annotated tracks must be heard beside hundreds of the motion's own"
        error = np.linalg.norm(after.track_xyz[new] - truth.track_xyz[rows, before.ref_frame], axis=1)
        assert np.median(error) < 0.05
        assert after.track_xy[new][truth.visible[rows]] == pytest.approx(
            truth.tracks[rows][truth.visible[rows]], abs=1e-3
        )
