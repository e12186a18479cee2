"""Two annotators: exact agreement figures, three-way merge that loses nobody's work, statistics, time sheets."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import annotations
import numpy as np
import pytest

from genmojo_core.errors import GenmojoError
from genmojo_core.store import project_file, time_sheet
from genmojo_core.store.edit_codec import decode_annotation, encode_annotation
from genmojo_core.store.project import Project, info_of
from genmojo_core.store.project_log import Row
from genmojo_core.tracks import edit_tracks, exchange, keys, statistics
from genmojo_core.tracks.agreement import agreement
from genmojo_core.tracks.annotation import SCENE, Annotation, ObjectInfo, Proposal
from genmojo_core.tracks.edits import set_meta
from genmojo_core.tracks.merge import MergeThing, locked, merge, preview
from genmojo_core.tracks.model import OCCLUDED, VISIBLE


def filled() -> Annotation:
    """Every track visible in all frames, keys at both ends."""
    annotation = annotations.started(12, 2, 3)
    for track in annotation.tracks:
        for t in (0, 11):
            keys.set_key(annotation, track, t, (200.0 + 50 * track + 10 * t, 300.0)).do(annotation)
    return annotation


def copied(annotation: Annotation) -> Annotation:
    return decode_annotation(encode_annotation(annotation))


def test_the_same_annotation_agrees_wholly() -> None:
    figures = agreement(filled(), filled())
    assert figures["aj"] == figures["oa"] == figures["delta"] == 100
    assert figures["median_px"] == 0
    assert figures["states"] == 1


def test_a_constant_offset_is_measured_in_pixels_of_1080p() -> None:
    mine, theirs = filled(), filled()
    for track in theirs.tracks:
        cells = theirs.cells(track, np.arange(12))
        cells.xy[:] += np.float32((3.0, 4.0))
        theirs.write_cells(track, np.arange(12), cells)
    assert agreement(mine, theirs)["median_px"] == pytest.approx(5.0, abs=1e-4)


def test_a_merge_keeps_what_either_side_did_alone_and_asks_about_the_rest() -> None:
    base = filled()
    mine, theirs = copied(base), copied(base)
    keys.set_key(mine, 1, 5, (999.0, 99.0)).do(mine)
    keys.set_key(theirs, 2, 5, (888.0, 88.0)).do(theirs)
    keys.set_key(mine, 3, 5, (500.0, 50.0)).do(mine)
    keys.set_key(theirs, 3, 5, (540.0, 50.0)).do(theirs)
    keys.set_state(theirs, 4, 3, 6, OCCLUDED).do(theirs)
    runs = preview(base, mine, theirs)
    assert {(r.track, r.kind) for r in runs} == {(1, "mine"), (2, "theirs"), (3, "conflict"), (4, "theirs")}
    asked = {n: "middle" for n, r in enumerate(runs) if r.kind == "conflict"}
    before = mine.digest()
    edit = merge(mine, theirs, runs, asked)
    edit.do(mine)
    assert mine.track(1).xy[5].tolist() == [999.0, 99.0]
    assert mine.track(2).xy[5].tolist() == [888.0, 88.0]
    assert mine.track(3).xy[5].tolist() == [520.0, 50.0]
    assert mine.track(4).state[3:7].tolist() == [OCCLUDED] * 4
    edit.undo(mine)
    assert mine.digest() == before


def test_figures_that_nothing_tells_are_no_number() -> None:
    """The common tracks only have a key, or the clip is one frame."""
    mine, theirs = annotations.started(12, 1, 1), annotations.started(12, 1, 1)
    for side in (mine, theirs):
        keys.set_key(side, 1, 11, (5.0, 5.0)).do(side)
    assert np.isnan(agreement(mine, theirs)["aj"])
    assert agreement(mine, theirs)["median_px"] == 0
    mine, theirs = annotations.started(1, 1, 1), annotations.started(1, 1, 1)
    for side in (mine, theirs):
        keys.set_key(side, 1, 0, (5.0, 5.0)).do(side)
    assert np.isnan(agreement(mine, theirs)["aj"])


def test_points_names_notes_reviews_objects_and_doubts_are_listed_and_taken() -> None:
    base = filled()
    mine, theirs = copied(base), copied(base)
    edit_tracks.put_objects(theirs, [ObjectInfo(9, "bird", 3, "chosen")]).do(theirs)
    new = edit_tracks.add_track(theirs, 9, 2, "Bob", "beak")
    new.do(theirs)
    keys.set_key(theirs, int(new.track or 0), 4, (7.0, 8.0)).do(theirs)
    edit_tracks.delete_track(theirs, 5).do(theirs)
    edit_tracks.update_track(theirs, 1, name="nose", note="blurred").do(theirs)
    keys.set_uncertain(theirs, 1, 2, 3, on=True).do(theirs)
    edit_tracks.needs_fix(theirs, 2, "drift", (3, 6), "Bob", "look").do(theirs)
    edit_tracks.update_track(mine, 2, note="slips").do(mine)
    edit_tracks.update_track(mine, 3, name="mine").do(mine)
    edit_tracks.update_track(theirs, 3, name="theirs").do(theirs)
    found = preview(base, mine, theirs)
    listed = {(one.what, one.object, one.number): (one.kind, one.mine, one.theirs)
              for one in found if isinstance(one, MergeThing)}  # fmt: skip
    assert listed == {
        ("object", 9, 0): ("theirs", "", "chosen"), ("point", 9, 2): ("theirs", "", "1"),
        ("point", 2, 2): ("theirs", "12", ""), ("name", 1, 1): ("theirs", "", "nose"),
        ("note", 1, 1): ("theirs", "", "blurred"), ("review", 1, 2): ("theirs", "", "needs_fix"),
        ("note", 1, 2): ("mine", "slips", ""), ("name", 1, 3): ("conflict", "mine", "theirs"),
    }  # fmt: skip
    assert [(r.track, r.first, r.last, r.kind) for r in found if not isinstance(r, MergeThing)] == [(1, 2, 3, "theirs")]
    before = mine.digest()
    edit = merge(mine, theirs, found, {})
    edit.do(mine)
    places = {(i.object, i.number): i for i in mine.tracks.values()}
    assert (2, 2) not in places
    assert (places[9, 2].name, places[9, 2].person) == ("beak", "Bob")
    assert mine.track(places[9, 2].id).xy[4].tolist() == [7, 8]
    assert mine.objects[9].status == "chosen"
    assert (places[1, 1].name, places[1, 1].note, places[1, 3].name) == ("nose", "blurred", "mine")
    assert (places[1, 2].review, places[1, 2].reason, places[1, 2].run) == ("needs_fix", "drift", (3, 6))
    assert (places[1, 2].review_note, places[1, 2].note) == ("look", "slips"), "the reviewer's words beside my own"
    assert [one.kind for one in preview(base, mine, theirs)] == ["mine", "conflict"]
    edit.undo(mine)
    assert mine.digest() == before


def test_a_merge_says_what_it_took() -> None:
    mine = filled()
    theirs = copied(mine)
    edit_tracks.put_objects(theirs, [ObjectInfo(9, "bird", 3, "chosen")]).do(theirs)
    assert merge(mine, theirs, preview(mine, mine, theirs), {}).title == "Merge 1 objects"
    edit_tracks.add_track(theirs, 9, 1).do(theirs)
    assert merge(mine, theirs, preview(mine, mine, theirs), {}).title == "Merge 1 tracks and 1 objects"


def test_a_deletion_against_work_is_a_conflict_and_locked_tracks_stay() -> None:
    base = filled()
    mine, theirs = copied(base), copied(base)
    keys.set_key(mine, 5, 5, (1.0, 1.0)).do(mine)
    edit_tracks.delete_track(theirs, 5).do(theirs)
    keys.set_key(theirs, 6, 5, (2.0, 2.0)).do(theirs)
    edit_tracks.update_track(mine, 6, locked=True).do(mine)
    found = preview(base, mine, theirs)
    kinds = {one.track: one.kind for one in found if not (isinstance(one, MergeThing) and one.what == "review")}
    assert kinds == {5: "conflict", 6: "theirs"}
    assert [locked(mine, one) for one in found if one.track == 6] == [True, True]
    before = mine.digest()
    merge(mine, theirs, found, dict.fromkeys(range(len(found)), "mine")).do(mine)
    assert mine.digest() == before
    merge(mine, theirs, found, dict.fromkeys(range(len(found)), "theirs")).do(mine)
    assert 5 not in mine.tracks
    assert mine.track(6).xy[5].tolist() != [2.0, 2.0]


def test_what_speaks_against_the_same_clip_is_seen_in_pictures_times_and_names() -> None:
    one = info_of(12, annotations.SIZE)
    assert project_file.clip_doubt(one, one) == ""
    assert project_file.clip_doubt(one, replace(one, name="other")) == "name"
    assert project_file.clip_doubt(one, replace(one, seconds=one.seconds + 1.0)) == "times"
    told = replace(one, sha256=("a",) * 12)
    assert project_file.clip_doubt(told, replace(told, name="other")) == ""
    assert project_file.clip_doubt(told, replace(told, sha256=("b",) * 12)) == "pictures"


def test_annotations_of_other_clips_are_refused() -> None:
    with pytest.raises(GenmojoError, match="12 frames"):
        agreement(annotations.started(10), filled())


def test_statistics_count_what_is_there() -> None:
    annotation = filled()
    keys.set_state(annotation, 1, 6, 11, OCCLUDED).do(annotation)
    figures = statistics.track_figures(annotation, 1)
    assert (figures["keys"], figures["occluded"], figures["annotated"]) == (2, 0.5, 1.0)
    whole = statistics.clip_figures(annotation)
    assert whole["tracks"] == 6
    assert whole["motion"] == pytest.approx(10 * 256 / 1920, rel=1e-5)


def test_pauses_are_no_work() -> None:
    def row(seq: int, at: str) -> Row:
        return Row(seq, seq - 1, seq, "do", "key", "", 0, 1, "Ada", f"2026-01-05T{at}+00:00", "1")

    stamps = ("10:00:00", "10:00:10", "10:30:00", "10:30:20")
    (day,) = time_sheet.time_sheet([row(n + 1, at) for n, at in enumerate(stamps)])
    assert (day.person, day.keys, day.seconds) == ("Ada", 4, 10 + 60 + 20 + 5)


def test_times_need_consent_and_names_can_be_taken_out(tmp_path: Path) -> None:
    project = Project.create(tmp_path / "p.genmojo", info_of(12, annotations.SIZE), person="Ada Lovelace")
    project.do(edit_tracks.put_objects(project.annotation, [ObjectInfo(1, "dog", 1, "chosen")]))
    project.do(edit_tracks.add_track(project.annotation, 1, 1, person="Ada Lovelace"))
    project.do(keys.set_key(project.annotation, 1, 3, (5.0, 6.0)))
    with pytest.raises(GenmojoError, match="no consent"):
        time_sheet.write_time_sheet(project.log.rows, "", tmp_path / "t.csv")
    project.do(set_meta(project.annotation, "consent", "yes"))
    time_sheet.write_time_sheet(project.log.rows, project.annotation.meta["consent"], tmp_path / "t.csv")
    assert "Ada Lovelace" in (tmp_path / "t.csv").read_text()
    project.close()
    time_sheet.without_people(tmp_path / "p.genmojo", tmp_path / "bare.genmojo")
    assert b"Lovelace" not in (tmp_path / "bare.genmojo").read_bytes()
    assert project_file.verify(tmp_path / "bare.genmojo") == []
    bare = Project.open(tmp_path / "bare.genmojo", backup=False)
    assert bare.annotation.track(1).xy[3].tolist() == [5.0, 6.0]
    assert bare.annotation.tracks[1].person == ""
    bare.close()


def test_a_merge_brings_what_trackers_proposed_so_that_it_goes_on_to_lead(tmp_path: Path) -> None:
    rng = np.random.default_rng(3)

    def way(tracker: str) -> Proposal:
        xy = rng.uniform(0, 900, (12, 2)).astype(np.float32)
        return Proposal(tracker, xy, np.full(12, VISIBLE, np.uint8), np.ones(12, np.float32))

    project = Project.create(tmp_path / "p.genmojo", info_of(12, annotations.SIZE))
    mine, ways, still = project.annotation, {n: way("scene") for n in (1, 2, 3)}, way("optical")
    project.do(edit_tracks.put_objects(mine, [ObjectInfo(1, "dog", 1, "chosen")]))
    for track in (1, 2):
        project.do(edit_tracks.add_track(mine, 1, track))
        project.do(keys.accept(mine, {track: ways[track]}, SCENE))
        project.propose(track, ways[track])
    base, theirs = copied(mine), copied(mine)
    for track in (1, 2):
        theirs.propose(track, ways[track])
    project.propose(1, still)
    exchange.swap(theirs, 1, 2, 4, 7).do(theirs)
    edit_tracks.add_track(theirs, 1, 3).do(theirs)
    theirs.propose(3, ways[3])
    keys.accept(theirs, {3: ways[3]}, SCENE).do(theirs)
    project.do(merge(mine, theirs, preview(base, mine, theirs), {}))

    def led(side: Annotation) -> list[bool]:
        return [np.array_equal(side.proposals[t]["scene"].xy, side.track(t).xy) for t in (1, 2, 3)]

    assert not np.array_equal(mine.track(1).xy, ways[1].xy)
    assert led(mine) == [True] * 3
    assert np.array_equal(mine.proposals[1]["optical"].xy, still.xy)
    project.wait()
    assert led(project_file.load(tmp_path / "p.genmojo").annotation) == [True] * 3
    project.undo()
    assert np.array_equal(mine.proposals[1]["scene"].xy, ways[1].xy)
    project.close()
