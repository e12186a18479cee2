"""What is open per frame, keys and gaps: equal to counting cell by cell, over edits of every kind."""

import numpy as np
from annotations import random_edit, started

from genmojo_core.tracks import coverage, edit_tracks
from genmojo_core.tracks.annotation import CONFIRMED, KEY


def test_open_points_and_key_figures_equal_counting_one_by_one():
    annotation, rng = started(frames=1300, objects=2, points=3), np.random.default_rng(4)
    for _ in range(120):
        random_edit(annotation, rng).do(annotation)
    frames = np.arange(0, annotation.frames, 3)
    tracks = coverage.open_tracks(annotation)
    counted = [sum(not annotation.track(t).flags[f] & (KEY | CONFIRMED) for t in tracks) for f in frames]
    np.testing.assert_array_equal(coverage.open_points(annotation, tracks, frames), counted)
    counts, gaps = coverage.key_figures(annotation, tracks)
    for n, track in enumerate(tracks):
        keys = annotation.keys(track)
        edges = np.concatenate([[-1], keys, [annotation.frames]])
        assert counts[n] == len(keys) and gaps[n] == np.diff(edges).max() - 1


def test_locked_tracks_and_those_put_aside_are_not_open():
    annotation = started(frames=4, objects=2, points=2)
    edit_tracks.update_track(annotation, 1, locked=True).do(annotation)
    assert coverage.open_tracks(annotation) == [2, 3, 4]
    assert coverage.open_points(annotation, [], np.arange(4)).tolist() == [0, 0, 0, 0]
    assert [len(figure) for figure in coverage.key_figures(annotation, [])] == [0, 0]
