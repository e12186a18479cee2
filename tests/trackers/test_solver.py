"""Solving between keys: exact oracles on procedural clips, hard keys, corrected slips, late answers."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from genmojo_core.clip.synthetic import Truth, generate
from genmojo_core.clip.synthetic_specs import spec
from genmojo_core.errors import GenmojoError
from genmojo_core.store import npz
from genmojo_core.trackers import seeding
from genmojo_core.trackers.solver import SolveRequest, TrackSolver
from genmojo_core.tracks import edit_tracks, keys
from genmojo_core.tracks.annotation import TRACKER, Annotation, ObjectInfo
from genmojo_core.tracks.model import NONE, OCCLUDED, VISIBLE, PointTracks


@pytest.fixture(scope="module")
def made() -> tuple:
    """The procedural clip of two objects that cross, its solver and truth in source pixels."""
    clip, truth = generate(replace(spec("crossing-shapes"), frames=10, size=(112, 63), novel_every=0))
    return clip, points_of(truth, clip.source_size), TrackSolver(clip)


def points_of(truth: Truth, size: tuple[int, int]) -> PointTracks:
    """The truth's tracks."""
    state = np.where(truth.visible, VISIBLE, OCCLUDED).astype(np.uint8)
    return PointTracks(truth.tracks.astype(np.float32), state, truth.track_object, size)


def begun(clip, truth: PointTracks, points: int = 3) -> tuple[Annotation, dict[int, int]]:
    """Keys on points seen in frame 0; track -> row of the truth."""
    annotation = Annotation(len(clip), clip.source_size)
    rows = {}
    for owner in clip.object_ids:
        edit_tracks.put_objects(annotation, [ObjectInfo(int(owner), "thing", 1, "chosen")]).do(annotation)
        for number, row in enumerate(np.flatnonzero((truth.object == owner) & truth.visible[:, 0])[:points]):
            edit = edit_tracks.add_track(annotation, int(owner), number + 1)
            edit.do(annotation)
            rows[edit.track] = int(row)
            keys.set_key(annotation, edit.track, 0, tuple(truth.xy[row, 0])).do(annotation)
    return annotation, rows


def test_a_key_is_met_exactly_and_brings_its_neighbours_closer(made: tuple) -> None:
    clip, truth, solver = made
    annotation, rows = begun(clip, truth)
    for owner in clip.object_ids:
        solver.answer(SolveRequest.of(annotation, int(owner))).edit(annotation).do(annotation)

    def errors(track: int) -> np.ndarray:
        seen = truth.visible[rows[track]]
        return np.linalg.norm(annotation.track(track).xy - truth.xy[rows[track]], axis=1)[seen]

    before = {track: errors(track) for track in rows}
    assert all((annotation.track(track).state != NONE).all() for track in rows)
    for track, row in rows.items():
        worst = int(np.argmax(np.where(truth.visible[row], np.linalg.norm(annotation.track(track).xy - truth.xy[row],
                                                                          axis=1), 0)))  # fmt: skip
        place = tuple(float(v) for v in truth.xy[row, worst])
        keys.set_key(annotation, track, worst, place).do(annotation)
        answer = solver.answer(SolveRequest.of(annotation, annotation.tracks[track].object, (track, worst)))
        answer.edit(annotation).do(annotation)
        assert annotation.track(track).xy[worst].tolist() == pytest.approx(list(place))
    after = {track: errors(track) for track in rows}
    assert np.mean([e.mean() for e in after.values()]) < 0.6 * np.mean([e.mean() for e in before.values()])


def test_points_may_begin_in_different_frames(made: tuple) -> None:
    clip, truth, solver = made
    owner, annotation = int(clip.object_ids[0]), Annotation(len(clip), clip.source_size)
    edit_tracks.put_objects(annotation, [ObjectInfo(owner, "thing", 1, "chosen")]).do(annotation)
    rows = np.flatnonzero((truth.object == owner) & truth.visible[:, [0, 3, 4]].all(axis=1))[:2]
    for number, (row, t) in enumerate(zip(rows, (0, 4), strict=True)):
        edit = edit_tracks.add_track(annotation, owner, number + 1)
        edit.do(annotation)
        keys.set_key(annotation, edit.track, t, tuple(float(v) for v in truth.xy[row, t])).do(annotation)
    solver.answer(SolveRequest.of(annotation, owner)).edit(annotation).do(annotation)
    assert np.linalg.norm(annotation.track(2).xy[3] - truth.xy[rows[1], 3]) < 1.5
    assert np.linalg.norm(annotation.track(2).xy[0] - truth.xy[rows[1], 0]) < 6.0


def test_a_request_without_its_track_is_answered_with_nothing(made: tuple) -> None:
    clip, truth, solver = made
    annotation, rows = begun(clip, truth)
    owner = int(clip.object_ids[0])
    track = annotation.tracks_of(owner)[0].id
    keys.remove_key(annotation, track, 0).do(annotation)
    assert solver.answer(SolveRequest.of(annotation, owner, (track, 0))).found == {}


def test_an_answer_that_comes_too_late_changes_nothing(made: tuple) -> None:
    clip, truth, solver = made
    annotation, rows = begun(clip, truth)
    owner = int(clip.object_ids[0])
    track = annotation.tracks_of(owner)[0].id
    answer = solver.answer(SolveRequest.of(annotation, owner))
    keys.set_key(annotation, track, 7, (5.0, 6.0)).do(annotation)
    before = annotation.track(track).copy()
    answer.edit(annotation).do(annotation)
    assert np.array_equal(before.xy, annotation.track(track).xy)


def test_every_seeder_answers_in_source_pixels_and_fills_only_what_nobody_placed(made: tuple, tmp_path) -> None:
    clip, truth, _ = made
    annotation, rows = begun(clip, truth)
    npz.write_tracks(truth, tmp_path / "truth.npz")
    for seeder in (seeding.make("optical"), seeding.make("file", tmp_path / "truth.npz")):
        ids, queries = seeding.Queries.of(annotation)
        tracks = seeder.seed(clip, queries)
        assert tracks.size == clip.source_size
        assert seeder.forecast(clip, queries) > 0
        first = {track: annotation.track(track).xy[0].copy() for track in ids}
        keys.accept(annotation, seeding.proposals(tracks, ids, seeder.name), TRACKER).do(annotation)
        assert all((annotation.track(track).xy[0] == first[track]).all() for track in ids)
    for track, row in rows.items():
        seen = truth.visible[row]
        assert np.abs(annotation.track(track).xy - truth.xy[row])[seen].max() < 1e-3
        assert (annotation.track(track).state[seen] == VISIBLE).all()


def test_what_cannot_be_seeded_is_said(made: tuple, tmp_path) -> None:
    clip, _, _ = made
    with pytest.raises(GenmojoError, match="no tracker 'magic'"):
        seeding.make("magic")
    with pytest.raises(GenmojoError, match="needs a path"):
        seeding.make("scene")
    with pytest.raises(GenmojoError, match="has no masks"):
        TrackSolver(clip.with_channels(masks=None))
    asked = seeding.Queries(np.array([99]), np.zeros((1, 2)), np.array([1]))
    with pytest.raises(GenmojoError, match="frame 99"):
        seeding.make("optical").seed(clip, asked)


def test_one_frame_is_matched_to_the_pixels_and_keys_there_stay(made: tuple) -> None:
    clip, truth, solver = made
    annotation, rows = begun(clip, truth)
    errors = []
    for track, row in rows.items():
        cells = (annotation.track(track).copy(),)
        owner = annotation.tracks[track].object
        answer = solver.follow(SolveRequest(owner, clip.source_size, (track,), cells, (track, 0)), 1)
        frames, found = answer.found[track]
        assert frames.tolist() == [1] and found.state[0] == VISIBLE
        errors.append(np.linalg.norm(found.xy[0] - truth.xy[row, 1]))
        answer.edit(annotation).do(annotation)
        assert annotation.track(track).state[2] == NONE, "one frame and no more"
    assert np.median(errors) < 0.5
    track = next(iter(rows))
    keys.set_key(annotation, track, 1, (3.0, 4.0)).do(annotation)
    request = SolveRequest(annotation.tracks[track].object, clip.source_size, (track,),
                           (annotation.track(track).copy(),), (track, 0))  # fmt: skip
    assert not solver.follow(request, 1).edit(annotation).changes
