"""Swap, split and join: what they move comes back, nothing is lost, and all that is known of a frame goes along."""

from __future__ import annotations

from dataclasses import replace

import annotations
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from genmojo_core.errors import GenmojoError
from genmojo_core.store.project import Project, info_of
from genmojo_core.tracks import edit_tracks, exchange, keys
from genmojo_core.tracks.annotation import KEY, Annotation, Cells, ObjectInfo, Proposal
from genmojo_core.tracks.edits import Edit
from genmojo_core.tracks.model import NONE, VISIBLE

FRAMES = 12


def random(seed: int) -> Annotation:
    """Tracks with gaps, keys and states of all kinds, and proposals of two trackers for some; track 4 knows nothing."""
    rng, annotation = np.random.default_rng(seed), annotations.started(FRAMES, 2, 2)
    for track in (1, 2, 3):
        state = rng.integers(0, 4, FRAMES).astype(np.uint8)
        known = state != NONE
        small = [np.where(known, rng.integers(0, n, FRAMES), 0).astype(np.uint8) for n in (32, 9, 3)]
        xy = np.where(known[:, None], rng.uniform(0, 900, (FRAMES, 2)), 0).astype(np.float32)
        conf = np.where(known, rng.uniform(0, 1, FRAMES), 0).astype(np.float32)
        cells = Cells(xy, state, small[0], small[1], conf, small[2])
        annotation.write_cells(track, np.arange(FRAMES), cells)
        for name in ("optical", "scene")[: int(rng.integers(0, 3))]:
            annotation.propose(track, Proposal(name, xy * np.float32(1.5), state, conf))
        first = int(rng.integers(0, FRAMES))
        run = (first, int(rng.integers(first, FRAMES)))
        review = ("draft", "in_progress", "needs_fix", "fixed", "rejected")[int(rng.integers(5))]
        back = {"reason": "drift", "run": run, "review_note": "look", "rounds": 2} if "fix" in review else {}
        info = replace(annotation.tracks[track], review=review, note=("", "mine")[int(rng.integers(2))], **back)
        annotation.put_track(track, info)
    return annotation


def everything(annotation: Annotation) -> tuple[object, ...]:
    """All that is known of the tracks there are: descriptions, cells, proposals."""
    return dict(annotation.tracks), [
        [a.tobytes() for a in annotation.track(t).arrays()] for t in sorted(annotation.tracks)
    ], {(t, n): (p.xy.tobytes(), p.state.tobytes(), p.conf.tobytes())
        for t, ps in annotation.proposals.items() for n, p in ps.items()}  # fmt: skip


def rows(annotation: Annotation) -> list[tuple[object, ...]]:
    """Every known cell of every track with its frame, sorted: what no exchange may lose or make up."""
    found = []
    for track in annotation.tracks:
        cells = annotation.track(track)
        for t in np.flatnonzero(cells.state):
            found.append((int(t), *cells.xy[t].tolist(), *(float(a[t]) for a in cells.arrays()[1:])))
    return sorted(found)


seeds = st.integers(0, 10_000)
frames = st.integers(0, FRAMES - 1)


@settings(deadline=None, max_examples=60)
@given(seeds, frames, frames, st.permutations([1, 2, 3, 4]))
def test_a_swap_twice_changes_nothing_and_one_loses_nothing(seed: int, a: int, b: int, order: list[int]) -> None:
    annotation = random(seed)
    before, known, first, last = everything(annotation), rows(annotation), min(a, b), max(a, b)
    one, other = order[:2]
    theirs = annotation.cells(other, np.arange(first, last + 1))
    edit = exchange.swap(annotation, one, other, first, last)
    edit.do(annotation)
    assert rows(annotation) == known
    for mine, other_s in zip(annotation.cells(one, np.arange(first, last + 1)).arrays(), theirs.arrays(), strict=True):
        np.testing.assert_array_equal(mine, other_s)
    exchange.swap(annotation, one, other, first, last).do(annotation)
    assert everything(annotation) == before
    exchange.swap(annotation, other, one, first, last).do(annotation)
    edit.undo(annotation)
    assert everything(annotation) == before


@settings(deadline=None, max_examples=60)
@given(seeds, frames, st.sampled_from([1, 2, 3]), st.sampled_from([None, 2]))
def test_split_then_join_is_as_before(seed: int, t: int, track: int, owner: int | None) -> None:
    annotation = random(seed)
    if not annotation.track(track).state[t:].any():
        with pytest.raises(GenmojoError, match="has nothing from frame"):
            exchange.split(annotation, track, t, 9, owner)
        return
    before, known = everything(annotation), rows(annotation)
    edit = exchange.split(annotation, track, t, 9, owner)
    edit.do(annotation)
    new = int(edit.track or 0)
    assert rows(annotation) == known
    assert not annotation.track(track).state[t:].any() and not annotation.track(new).state[:t].any()
    assert annotation.tracks[new].object == (owner or annotation.tracks[track].object)
    exchange.join_tracks(annotation, track, new).do(annotation)
    after = everything(annotation)
    assert after == before
    Edit("all", "", edit.changes).do(annotation)
    edit.undo(annotation)
    assert everything(annotation) == before


@settings(deadline=None, max_examples=60)
@given(seeds, st.permutations([1, 2, 3, 4]), st.booleans())
def test_a_join_keeps_every_frame_and_every_key_that_stands_alone(seed: int, order: list[int], prefer: bool) -> None:
    annotation = random(seed)
    one, other = order[:2]
    mine, theirs = annotation.track(one).copy(), annotation.track(other).copy()
    both, keyed = exchange.conflicts(annotation, one, other)
    before = everything(annotation)
    edit = exchange.join_tracks(annotation, one, other, prefer)
    edit.do(annotation)
    assert other not in annotation.tracks
    now = annotation.track(one)
    np.testing.assert_array_equal(now.state != NONE, (mine.state != NONE) | (theirs.state != NONE))
    for t in np.flatnonzero(now.state):
        sure = [bool(c.state[t]) and bool(c.flags[t] & KEY) for c in (mine, theirs)]
        wanted = (theirs if prefer else mine) if t in keyed else theirs if sure[1] and t in both else mine
        if t in keyed or (t in both and any(sure)):
            np.testing.assert_array_equal(now.xy[t], wanted.xy[t])
    edit.undo(annotation)
    assert everything(annotation) == before


def test_a_part_may_become_a_point_that_knows_nothing_there_and_no_other() -> None:
    annotation = annotations.started(FRAMES, 2, 2)
    keys.set_key(annotation, 1, 2, (10.0, 20.0)).do(annotation)
    keys.set_key(annotation, 1, 8, (70.0, 20.0)).do(annotation)
    keys.set_key(annotation, 3, 1, (5.0, 5.0)).do(annotation)
    edit = exchange.split(annotation, 1, 5, 1, 2)
    edit.do(annotation)
    assert edit.track == 3
    assert annotation.keys(3).tolist() == [1, 8]
    assert annotation.keys(1).tolist() == [2]
    keys.set_key(annotation, 1, 5, (9.0, 9.0)).do(annotation)
    with pytest.raises(GenmojoError, match="has places of its own in 1 of these frames, the first is 5"):
        exchange.split(annotation, 3, 0, 1, 1)


def test_the_run_of_a_review_goes_with_its_frames() -> None:
    annotation = annotations.started(FRAMES, 1, 1)
    keys.set_key(annotation, 1, 0, (10.0, 20.0), VISIBLE).do(annotation)
    keys.set_key(annotation, 1, 11, (10.0, 20.0), VISIBLE).do(annotation)
    edit_tracks.needs_fix(annotation, 1, "drift", (3, 8), "Bo", "left ear").do(annotation)
    edit = exchange.split(annotation, 1, 6, 2)
    edit.do(annotation)
    head, tail = annotation.tracks[1], annotation.tracks[int(edit.track or 0)]
    assert (head.run, tail.run) == ((3, 5), (6, 8))
    edit.undo(annotation)
    edit = exchange.split(annotation, 1, 2, 2)
    edit.do(annotation)
    head, tail = annotation.tracks[1], annotation.tracks[int(edit.track or 0)]
    assert (head.review, head.run, head.review_note) == ("in_progress", None, "")
    assert (tail.review, tail.run, tail.review_note, tail.reviewer) == ("needs_fix", (3, 8), "left ear", "Bo")


def test_locked_tracks_refuse_and_say_so() -> None:
    annotation = random(3)
    edit_tracks.lock(annotation, 2, 0, on=True).do(annotation)
    forbidden = [
        lambda: exchange.swap(annotation, 1, 2, 0, 3),
        lambda: exchange.join_tracks(annotation, 1, 2),
        lambda: exchange.join_tracks(annotation, 2, 1),
        lambda: exchange.split(annotation, 2, 0, 9),
    ]
    for make in forbidden:
        with pytest.raises(GenmojoError, match="locked"):
            make()


def test_proposals_go_along_and_survive_closing_undone_and_done_again(tmp_path) -> None:
    project = Project.create(tmp_path / "p.genmojo", info_of(FRAMES, annotations.SIZE), "Ada")
    project.do(edit_tracks.put_objects(project.annotation, [ObjectInfo(1, "dog", 1, "chosen")]))
    for number in (1, 2):
        project.do(edit_tracks.add_track(project.annotation, 1, number))
        project.do(keys.set_key(project.annotation, number, 0, (10.0 * number, 5.0)))
    for track in (1, 2):
        xy = np.full((FRAMES, 2), track, np.float32)
        project.propose(track, Proposal("scene", xy, np.ones(FRAMES, np.uint8), np.ones(FRAMES, np.float32)))
    project.do(exchange.swap(project.annotation, 1, 2, 4, 7))

    def places(there: Project) -> list[list[float]]:
        return [there.annotation.proposals[t]["scene"].xy[:, 0].tolist() for t in (1, 2)]

    swapped = [[1.0] * 4 + [2.0] * 4 + [1.0] * 4, [2.0] * 4 + [1.0] * 4 + [2.0] * 4]
    assert places(project) == swapped
    project.close()
    project = Project.open(tmp_path / "p.genmojo", "Ada")
    assert places(project) == swapped
    project.undo()
    project.close()
    project = Project.open(tmp_path / "p.genmojo", "Ada")
    assert places(project) == [[1.0] * FRAMES, [2.0] * FRAMES]
    project.redo()
    assert places(project) == swapped
    edit = exchange.split(project.annotation, 1, 0, 3)
    project.do(edit)
    project.close()
    project = Project.open(tmp_path / "p.genmojo", "Ada")
    assert not project.annotation.proposals.get(1)
    assert project.annotation.proposals[int(edit.track or 0)]["scene"].xy[:, 0].tolist() == swapped[0]
    project.close()


def test_the_proposal_before_stays_beside_the_new_one_and_survives_closing(tmp_path) -> None:
    project = Project.create(tmp_path / "p.genmojo", info_of(FRAMES, annotations.SIZE), "Ada")
    project.do(edit_tracks.put_objects(project.annotation, [ObjectInfo(1, "dog", 1, "chosen")]))
    project.do(edit_tracks.add_track(project.annotation, 1, 1))
    for x in (1.0, 1.0, 2.0, 3.0):
        xy = np.full((FRAMES, 2), x, np.float32)
        project.propose(1, Proposal("optical", xy, np.ones(FRAMES, np.uint8), np.ones(FRAMES, np.float32)))
    project.close()
    project = Project.open(tmp_path / "p.genmojo", "Ada")
    kept = {name: float(p.xy[0, 0]) for name, p in project.annotation.proposals[1].items()}
    project.close()
    assert kept == {"optical": 3.0, "optical before": 2.0}
