"""Keys, states and what machines may touch: the promises an annotator relies on."""

from __future__ import annotations

import time

import annotations
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from genmojo_core.errors import GenmojoError
from genmojo_core.tracks import edit_tracks, exchange, keys
from genmojo_core.tracks.annotation import (
    BY_HOLD,
    BY_LINE,
    CONFIRMED,
    KEY,
    LINEAR,
    PAINTED,
    TRACKER,
    Annotation,
    Cells,
    Proposal,
)
from genmojo_core.tracks.model import NONE, OCCLUDED, OUT_OF_VIEW, VISIBLE


def proposal(frames: int = 24, at: tuple[float, float] = (100.0, 200.0)) -> Proposal:
    """A point that stands still and is seen."""
    xy = np.repeat(np.array([at], np.float32), frames, axis=0)
    return Proposal("test", xy, np.full(frames, VISIBLE, np.uint8), np.full(frames, 0.5, np.float32))


@settings(max_examples=15, deadline=None)
@given(seed=st.integers(0, 2**32 - 1))
def test_machines_never_change_what_a_person_placed_confirmed_or_painted(seed: int) -> None:
    rng = np.random.default_rng(seed)
    annotation = annotations.started(16, 1, 2)
    for _ in range(12):
        annotations.random_edit(annotation, rng).do(annotation)
        for track in [i.id for i in annotation.tracks.values()]:
            before = annotation.track(track).copy()
            annotations.solution(annotation, track, np.arange(16), rng).do(annotation)
            after = annotation.track(track)
            placed = (before.flags & (KEY | CONFIRMED)) > 0
            assert np.array_equal(before.xy[placed], after.xy[placed])
            painted = placed | ((before.flags & PAINTED) > 0)
            assert np.array_equal(before.state[painted], after.state[painted])
            assert np.array_equal(before.flags, after.flags)


@settings(max_examples=15, deadline=None)
@given(seed=st.integers(0, 2**32 - 1))
def test_every_edit_undoes_itself_exactly(seed: int) -> None:
    rng = np.random.default_rng(seed)
    annotation = annotations.started(10, 2, 2)
    done = []
    digests = [annotation.digest()]
    for _ in range(25):
        edit = annotations.random_edit(annotation, rng)
        edit.do(annotation)
        done.append(edit)
        digests.append(annotation.digest())
    for edit, digest in zip(reversed(done), reversed(digests[:-1]), strict=True):
        edit.undo(annotation)
        assert annotation.digest() == digest


@settings(max_examples=15, deadline=None)
@given(seed=st.integers(0, 2**32 - 1))
def test_a_tracker_that_knows_nothing_takes_nothing_away(seed: int) -> None:
    rng = np.random.default_rng(seed)
    annotation = annotations.started(16, 1, 2)
    for _ in range(12):
        annotations.random_edit(annotation, rng).do(annotation)
    for track in [i.id for i in annotation.tracks.values()]:
        before = annotation.track(track).copy()
        state = (rng.uniform(size=16) < 0.5).astype(np.uint8)
        made = Proposal("test", rng.uniform(0, 999, (16, 2)).astype(np.float32), state, np.ones(16, np.float32))
        keys.accept(annotation, {track: made}, TRACKER).do(annotation)
        for old, new in zip(before.arrays(), annotation.track(track).arrays(), strict=True):
            assert np.array_equal(old[state == NONE], new[state == NONE])


def test_a_proposal_passes_through_every_place_a_person_is_sure_of() -> None:
    annotation = annotations.started()
    for t, x in ((0, 100.0), (10, 130.0), (20, 90.0)):
        keys.set_key(annotation, 1, t, (x, 200.0)).do(annotation)
    keys.accept(annotation, {1: proposal()}, TRACKER).do(annotation)
    xy = annotation.track(1).xy
    assert xy[[0, 10, 20], 0].tolist() == [100.0, 130.0, 90.0]
    assert xy[[5, 9, 11, 15, 23], 0].tolist() == pytest.approx([115.0, 127.0, 126.0, 110.0, 90.0])
    assert (xy[:, 1] == 200.0).all()


def test_a_key_moves_its_neighbours_at_once_but_no_other_key() -> None:
    annotation = annotations.started()
    keys.accept(annotation, {1: proposal()}, TRACKER).do(annotation)
    keys.set_key(annotation, 1, 0, (100.0, 200.0)).do(annotation)
    keys.set_key(annotation, 1, 10, (110.0, 200.0)).do(annotation)
    x = annotation.track(1).xy[:, 0]
    assert x[:11].tolist() == pytest.approx([100.0 + t for t in range(11)])
    assert (x[10:] == 110).all()
    keys.set_key(annotation, 1, 14, (90.0, 200.0)).do(annotation)
    x = annotation.track(1).xy[:, 0]
    assert x[12] == pytest.approx(100.0)
    assert x[10] == 110
    assert annotation.keys(1).tolist() == [0, 10, 14]


def test_between_two_keys_without_a_tracker_lies_a_line() -> None:
    annotation = annotations.started()
    keys.set_key(annotation, 1, 2, (0.0, 0.0)).do(annotation)
    keys.set_key(annotation, 1, 6, (40.0, 8.0)).do(annotation)
    cells = annotation.track(1)
    assert cells.xy[4].tolist() == [20.0, 4.0]
    assert (cells.source[3:6] == LINEAR).all()
    assert cells.state[1] == cells.state[7] == NONE


@pytest.mark.parametrize(("mode", "x"), [(BY_LINE, 20.0), (BY_HOLD, 0.0)])
def test_a_segment_by_line_or_hold_is_not_solved(mode: int, x: float) -> None:
    annotation = annotations.started()
    keys.set_key(annotation, 1, 2, (0.0, 0.0)).do(annotation)
    keys.set_key(annotation, 1, 6, (40.0, 8.0)).do(annotation)
    keys.set_mode(annotation, 1, 4, mode).do(annotation)
    rng = np.random.default_rng(0)
    annotations.solution(annotation, 1, np.arange(24), rng).do(annotation)
    assert annotation.track(1).xy[4, 0] == x


def test_painting_a_state_keeps_places_and_clearing_takes_them() -> None:
    annotation = annotations.started()
    keys.accept(annotation, {1: proposal()}, TRACKER).do(annotation)
    keys.set_state(annotation, 1, 5, 8, OCCLUDED).do(annotation)
    keys.set_state(annotation, 1, 9, 9, OUT_OF_VIEW).do(annotation)
    cells = annotation.track(1)
    assert cells.state[4:11].tolist() == [VISIBLE, *[OCCLUDED] * 4, OUT_OF_VIEW, VISIBLE]
    assert (cells.xy[5:10] == [100.0, 200.0]).all()
    keys.clear(annotation, 1, 5, 23).do(annotation)
    assert (annotation.track(1).state[5:] == NONE).all()


def test_frames_between_two_accepted_ones_take_their_common_state() -> None:
    annotation = annotations.started()
    keys.accept(annotation, {1: proposal()}, TRACKER).do(annotation)
    cells = annotation.cells(1, np.array([3]))
    cells.state[:] = OCCLUDED
    annotation.write_cells(1, np.array([3]), cells)
    keys.confirm(annotation, [1], 2).do(annotation)
    keys.confirm(annotation, [1], 4).do(annotation)
    assert annotation.track(1).state[3] == VISIBLE


def test_locked_and_approved_tracks_refuse_edits_in_one_sentence() -> None:
    annotation = annotations.started()
    keys.accept(annotation, {1: proposal()}, TRACKER).do(annotation)
    edit_tracks.approve(annotation, 1, "Bo").do(annotation)
    with pytest.raises(GenmojoError, match="locked"):
        keys.set_key(annotation, 1, 3, (1.0, 2.0))
    assert keys.solved(annotation, 1, np.arange(24), Cells.empty(24)).changes == ()
    edit_tracks.needs_fix(annotation, 1, "drift", (3, 8), "Bo", "left ear").do(annotation)
    keys.set_key(annotation, 1, 3, (1.0, 2.0)).do(annotation)
    assert annotation.tracks[1].rounds == 1
    with pytest.raises(GenmojoError, match="says nothing about frame"):
        edit_tracks.approve(annotation, 2, "Bo")


def test_swap_split_and_join_with_one_side_missing() -> None:
    annotation = annotations.started()
    keys.accept(annotation, {1: proposal()}, TRACKER).do(annotation)
    exchange.swap(annotation, 1, 2, 10, 14).do(annotation)
    assert (annotation.track(1).state[10:15] == NONE).all()
    assert (annotation.track(2).state[10:15] == VISIBLE).all()
    edit = exchange.split(annotation, 1, 15, 9)
    edit.do(annotation)
    assert (annotation.track(edit.track).state[15:] == VISIBLE).all()
    exchange.join_tracks(annotation, 1, edit.track).do(annotation)
    assert edit.track not in annotation.tracks
    assert (annotation.track(1).state[15:] == VISIBLE).all()


def test_one_frame_costs_the_same_however_long_the_clip_is() -> None:
    def cost(annotation: Annotation, t: int) -> float:
        times = []
        for _ in range(200):
            began = time.perf_counter()
            annotation.at(t)
            times.append(time.perf_counter() - began)
        return float(np.median(times))

    small, large = annotations.started(100, 5, 5), Annotation(4000, annotations.SIZE)
    large.reserve(2000)
    edit_tracks.put_objects(large, [edit_tracks.ObjectInfo(1, "many", 1, "chosen")]).do(large)
    for number in range(2000):
        info = edit_tracks.TrackInfo(number + 1, 1, number + 1)
        large.put_track(number + 1, info)
    for owner in (small, large):
        for track in range(1, 26):
            keys.accept(owner, {track: proposal(owner.frames)}, TRACKER).do(owner)
    assert len(large.at(2000).ids) == 25
    assert cost(large, 2000) < cost(small, 50) + 0.0001  # a tenth of a millisecond
