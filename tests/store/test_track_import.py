"""Tracks of a file into an annotation: all of it comes back into an empty one, a person's word stays, every track gets
an object that can be reached, and hidden points never jump to the corner."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import annotations
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from genmojo_core.errors import GenmojoError
from genmojo_core.store import deeplabcut, sleap, track_npz
from genmojo_core.store.track_import import import_tracks
from genmojo_core.store.track_sheet import TrackSheet
from genmojo_core.trackers import guide
from genmojo_core.tracks import edit_tracks, keys
from genmojo_core.tracks.annotation import PROPOSED, Annotation, ObjectInfo, Proposal
from genmojo_core.tracks.interpolate import placed
from genmojo_core.tracks.model import NONE, OCCLUDED, OUT_OF_VIEW, VISIBLE, PointTracks


def bare(frames: int = 24, status: str = "candidate") -> Annotation:
    """Objects as the masks offer them, no track."""
    annotation = Annotation(frames, annotations.SIZE)
    infos = [ObjectInfo(k, f"thing {k}", 0, status) for k in (1, 2)]  # type: ignore[arg-type]
    edit_tracks.put_objects(annotation, infos).do(annotation)
    return annotation


def seen(*places: tuple[float, float], frames: int = 24, owners: tuple[int, ...] = ()) -> PointTracks:
    """Points that stand still, visible throughout."""
    xy = np.repeat(np.array(places, np.float32)[:, None], frames, axis=1)
    owner = np.array(owners or (0,) * len(places), np.int64)
    return PointTracks(xy, np.ones(xy.shape[:2], np.uint8), owner, annotations.SIZE)


def masks(_frame: int) -> np.ndarray:
    """Object 1 in the left third, 2 in the right third, at a quarter of the size."""
    labels = np.zeros((270, 480), np.uint8)
    labels[:, :160], labels[:, 320:] = 1, 2
    return labels


@settings(max_examples=15, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(seed=st.integers(0, 2**32 - 1))
def test_an_annotation_goes_through_a_file_into_an_empty_one_whole(tmp_path: Path, seed: int) -> None:
    rng = np.random.default_rng(seed)
    annotation = annotations.started()
    for _ in range(25):
        annotations.random_edit(annotation, rng).do(annotation)
    edit_tracks.update_track(annotation, next(iter(annotation.tracks)), name="nose").do(annotation)
    track_npz.write(TrackSheet.of_annotation(annotation), tmp_path / "t.npz")
    other = Annotation(annotation.frames, annotation.size)
    done = import_tracks(other, track_npz.read(tmp_path / "t.npz", annotation.size))
    before = other.digest()
    done.edit.do(other)
    known = [i for i in annotation.tracks.values() if (annotation.track(i.id).state != NONE).any()]
    assert done.made == len(known)
    there = {(i.object, i.number): i for i in other.tracks.values()}
    for info in known:
        mine, theirs = annotation.track(info.id), other.track(there[info.object, info.number].id)
        for name in ("xy", "state", "flags", "source", "conf"):
            there_is = mine.state != NONE
            expected = getattr(mine, name)[there_is]
            assert np.array_equal(getattr(theirs, name)[there_is], expected), name
        assert there[info.object, info.number].name == info.name
    assert {o.name for o in other.chosen_objects()} == {annotation.objects[i.object].name for i in known}
    done.edit.undo(other)
    assert other.digest() == before


@pytest.mark.parametrize("tracker", list(PROPOSED))
def test_what_was_proposed_goes_on_to_lead_and_nothing_that_is_proposed_here(tmp_path: Path, tracker: str) -> None:
    rng = np.random.default_rng(1)

    def seeded() -> Annotation:
        annotation = annotations.started(24, 1, 2)
        for track in (1, 2):
            xy = rng.uniform(0, 900, (24, 2)).astype(np.float32)
            state = rng.integers(1, 4, 24).astype(np.uint8)
            annotation.propose(track, Proposal(tracker, xy, state, np.full(24, 0.75, np.float32)))
            accepted = {track: annotation.proposals[track][tracker]}
            keys.accept(annotation, accepted, PROPOSED[tracker]).do(annotation)
        return annotation

    theirs, mine = seeded(), seeded()
    keys.set_key(mine, 2, 5, (3.0, 4.0)).do(mine)
    track_npz.write(TrackSheet.of_annotation(theirs), tmp_path / "t.npz")
    sheet = track_npz.read(tmp_path / "t.npz", mine.size)
    before = mine.proposals[2][tracker]
    for side in (mine, Annotation(24, mine.size)):
        import_tracks(side, sheet).edit.do(side)
        for track in (1, 2):
            led, cells = guide.taken(side, track), side.track(track)
            others = cells.source == PROPOSED[tracker]
            assert led is not None and others.sum() >= 23
            assert np.array_equal(led.xy[others], cells.xy[others])
            assert np.array_equal(led.state[others], cells.state[others])
    assert np.array_equal(mine.proposals[2][tracker].xy[5], before.xy[5])


def test_tracks_of_nobody_go_to_the_objects_they_lie_on_and_those_are_chosen() -> None:
    annotation = bare()
    sheet = TrackSheet.of_tracks(seen((100, 500), (1800, 500), (700, 500), (120, 300)))
    done = import_tracks(annotation, sheet, "Ada", masks)
    done.edit.do(annotation)
    assert [(i.object, i.number) for i in annotation.tracks.values()] == [(1, 1), (2, 1), (1, 2), (1, 3)]
    assert [o.id for o in annotation.chosen_objects()] == [1, 2]
    assert (done.made, done.objects) == (4, 0)


def test_without_masks_they_go_to_an_object_of_their_own() -> None:
    annotation = bare()
    done = import_tracks(annotation, TrackSheet.of_tracks(seen((1, 1), (5, 5))), "Ada")
    done.edit.do(annotation)
    assert [(o.id, o.status) for o in annotation.chosen_objects()] == [(3, "chosen")]
    assert {i.object for i in annotation.tracks.values()} == {3}
    assert done.objects == 1


def test_objects_of_other_programs_are_found_by_name_and_then_by_mask(tmp_path: Path) -> None:
    annotation = bare()
    tracks = seen((1800, 500), (1700, 500), (100, 500), owners=(1, 1, 2))
    sheet = TrackSheet(tracks, np.array([1, 2, 1]), {1: "fly", 2: "THING 1"})
    deeplabcut.write(sheet, tmp_path / "t.csv")
    done = import_tracks(annotation, deeplabcut.read(tmp_path / "t.csv", annotations.SIZE), "", masks)
    done.edit.do(annotation)
    assert [(i.object, i.number) for i in annotation.tracks.values()] == [(2, 1), (2, 2), (1, 1)]


def test_points_without_numbers_fill_those_they_run_along() -> None:
    annotation = annotations.started(24, 1, 3)
    for track, x in ((1, 100.0), (2, 300.0), (3, 500.0)):
        keys.set_key(annotation, track, 0, (x, 400.0)).do(annotation)
    sheet = TrackSheet.of_tracks(seen((505, 400), (101, 400), (900, 400), owners=(1, 1, 1)))
    done = import_tracks(annotation, sheet)
    done.edit.do(annotation)
    assert (done.filled, done.made) == (2, 1)
    assert annotation.track(3).xy[5].tolist() == [505, 400]
    assert annotation.track(1).xy[5].tolist() == [101, 400]
    assert annotation.track(1).xy[0].tolist() == [100, 400]  # a key stays
    assert (annotation.track(2).state[1:] == NONE).all()


def test_a_persons_word_and_locked_tracks_stay() -> None:
    annotation = annotations.started(24, 1, 2)
    for track in (1, 2):
        keys.set_key(annotation, track, 3, (50.0, 60.0)).do(annotation)
        keys.set_state(annotation, track, 8, 10, OCCLUDED).do(annotation)
    edit_tracks.update_track(annotation, 2, locked=True).do(annotation)
    locked = [a.copy() for a in annotation.track(2).arrays()]
    sheet = replace(TrackSheet.of_tracks(seen((500, 500), (500, 500), owners=(1, 1))), numbers_told=True)
    done = import_tracks(annotation, sheet)
    done.edit.do(annotation)
    cells = annotation.track(1)
    assert cells.xy[3].tolist() == [50, 60]
    assert cells.state[8:11].tolist() == [OCCLUDED] * 3
    assert cells.xy[12].tolist() == [500, 500]
    assert (done.filled, done.locked, done.kept_frames) == (1, 1, 4)
    assert all(np.array_equal(a, b) for a, b in zip(locked, annotation.track(2).arrays(), strict=True))


def test_hidden_points_of_which_no_place_is_known_lie_between_their_neighbours(tmp_path: Path) -> None:
    xy = np.array([[[10, 10], [np.nan, np.nan], [30, 20], [np.nan, np.nan]], [[np.nan, np.nan]] * 4], np.float32)
    state = np.array([[VISIBLE, OCCLUDED, VISIBLE, OUT_OF_VIEW], [OCCLUDED] * 4], np.uint8)
    tracks = PointTracks(xy, state, np.array([1, 1]), (64, 48))
    found = placed(tracks)
    assert found.xy[0].tolist() == [[10, 10], [20, 15], [30, 20], [30, 20]]
    assert (found.state[1] == NONE).all()
    annotation = Annotation(4, (64, 48))
    done = import_tracks(annotation, TrackSheet(tracks, np.array([1, 2]), {1: "dog"}))
    done.edit.do(annotation)
    assert (done.made, done.placeless) == (1, 1)
    assert annotation.track(1).xy[1].tolist() == [20, 15]
    hidden = replace(tracks, xy=np.array([[[10, 10], [52.4, 6.5], [30, 20], [63, 1]]], np.float32),
                     state=state[:1], object=np.array([1]))  # fmt: skip
    sleap.write(TrackSheet(hidden, np.array([1])), tmp_path / "s.h5")
    assert sleap.read(tmp_path / "s.h5").tracks.xy[0, 1].tolist() == pytest.approx([52.4, 6.5])


def test_another_number_of_frames_is_refused() -> None:
    with pytest.raises(GenmojoError, match="has 9 frames, the clip has 24"):
        import_tracks(bare(), TrackSheet.of_tracks(seen((1, 1), frames=9)))


def test_an_export_takes_tracks_by_their_review() -> None:
    annotation = annotations.started(4, 1, 3)
    for track, review in ((1, "approved"), (2, "rejected"), (3, "needs_fix")):
        edit_tracks.update_track(annotation, track, review=review).do(annotation)
    taken = {which: TrackSheet.of_annotation(annotation, which=which).numbers.tolist()  # type: ignore[arg-type]
             for which in ("all", "not-rejected", "approved")}  # fmt: skip
    assert taken == {"all": [1, 2, 3], "not-rejected": [1, 3], "approved": [1]}
    assert TrackSheet.of_annotation(annotation).reviews == ("approved", "rejected", "needs_fix")
