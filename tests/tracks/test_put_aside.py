"""Tracks of rejected objects: kept, but nobody is asked about them and nobody gets them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from annotations import started

from genmojo_core.store.track_sheet import TrackSheet
from genmojo_core.tracks import edit_tracks, keys
from genmojo_core.tracks.annotation import Annotation
from genmojo_core.tracks.statistics import clip_figures
from genmojo_core.tracks.suspicion import assess


def _with_keys() -> Annotation:
    annotation = started(frames=6, objects=2, points=3)
    for n, track in enumerate(annotation.tracks):
        keys.set_key(annotation, track, 0, (10.0 + n, 20.0)).do(annotation)
    return annotation


def test_a_rejected_objects_tracks_are_nobodys_work_until_it_is_chosen_again() -> None:
    annotation = _with_keys()
    info = annotation.objects[2]
    rejected = edit_tracks.put_objects(annotation, [replace(info, status="rejected", order=0)])
    rejected.do(annotation)
    mine = {i.id for i in annotation.tracks_of(1)}
    assert {i.id for i in annotation.active()} == mine
    assert set(annotation.at(0).ids.tolist()) == mine
    assert set(assess(annotation)) == mine
    assert clip_figures(annotation)["tracks"] == 3
    assert np.unique(TrackSheet.of_annotation(annotation).tracks.object).tolist() == [1]
    assert len(annotation.tracks) == 6, "nothing is lost"
    rejected.undo(annotation)
    assert len(annotation.at(0).ids) == 6


def test_tracks_made_or_brought_back_while_their_object_is_rejected_are_aside() -> None:
    annotation = _with_keys()
    gone = edit_tracks.delete_track(annotation, annotation.tracks_of(2)[0].id)
    gone.do(annotation)
    edit_tracks.put_objects(annotation, [replace(annotation.objects[2], status="rejected", order=0)]).do(annotation)
    gone.undo(annotation)
    annotation.reserve(500)
    assert len(annotation.tracks) == 6
    assert {annotation.tracks[int(t)].object for t in annotation.at(0).ids} == {1}
