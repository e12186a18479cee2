"""Figures per clip and person: who placed what, what it cost, what is left; and in words what is not known."""

from __future__ import annotations

import csv
from dataclasses import replace
from pathlib import Path

import annotations
import numpy as np
import pytest

from genmojo_core.cli import main as cli
from genmojo_core.store import audit, project_file, time_sheet, work_figures
from genmojo_core.store.project import Project, info_of
from genmojo_core.tracks import edit_tracks, keys
from genmojo_core.tracks.annotation import ObjectInfo
from genmojo_core.tracks.edits import join, set_meta
from genmojo_core.tracks.model import OCCLUDED


def worked(path: Path) -> Project:
    """12 frames, two points: Ada placed both (one with its track, as the app does), Bo accepted and returned one."""
    project = Project.create(path, info_of(12, annotations.SIZE, "clip"), person="Ada")
    a = project.annotation
    project.do(edit_tracks.put_objects(a, [ObjectInfo(1, "dog", 1, "chosen")]))
    project.do(set_meta(a, "limit_points", "2"))
    for number in (1, 2):
        made = edit_tracks.add_track(a, 1, number, "Ada")
        made.do(a)
        placed = keys.set_key(a, int(made.track or 0), 0, (100.0 * number, 50.0))
        made.undo(a)
        project.do(join("track", placed.title, [made, placed]))
        project.do(annotations.solution(a, number, np.arange(12), np.random.default_rng(number)))
    project.do(keys.set_state(a, 1, 1, 11, OCCLUDED))
    project.do(keys.set_key(a, 1, 6, (5.0, 5.0)))
    project.do(keys.set_key(a, 1, 8, (6.0, 6.0)))
    project.undo()
    project.person = "Bo"
    for t in (2, 4):
        project.do(keys.confirm(a, [1, 2], t))
    project.do(edit_tracks.needs_fix(a, 1, "drift", (2, 4), "Bo", "look"))
    return project


def timed(entries: list[audit.Entry], step: float = 10.0) -> list[audit.Entry]:
    """The same with a line every so many seconds."""
    return [replace(e, row=replace(e.row, at=f"2026-01-05T10:{int(n * step) // 60:02d}:{n * step % 60:06.3f}+00:00"))
            for n, e in enumerate(entries)]  # fmt: skip


def test_first_placements_are_keys_and_each_person_has_their_part(tmp_path: Path) -> None:
    project = worked(tmp_path / "p.genmojo")
    project.close()
    entries = timed(audit.entries(tmp_path / "p.genmojo"))
    whole, ada, bo = work_figures.figures(project.annotation, entries, "clip")
    assert (whole.clip, whole.person, ada.person, bo.person) == ("clip", "", "Ada", "Bo")
    assert (whole.keys, ada.keys, bo.keys) == (3, 3, 0)  # the one undone does not count, two came with their tracks
    assert (whole.confirmed, ada.confirmed, bo.confirmed) == (7, 3, 4)
    assert (whole.tracks, ada.tracks, bo.tracks) == (2, 2, 2)
    assert whole.keys_per_track == 1.5
    assert ada.seconds == 9 * 10.0 + 5.0
    assert whole.seconds == ada.seconds + bo.seconds
    assert whole.seconds_per_track == whole.seconds / 2
    assert (whole.returned, whole.reopened) == (1, 1.0)
    assert whole.visible + whole.occluded + whole.out_of_view == pytest.approx(1.0)
    assert whole.left == (6 - 4) + (6 - 3)
    assert "needs 10 accepted places" in whole.unknown["eta_seconds"]


def test_time_left_goes_by_the_pace_so_far_and_nothing_left_takes_none(tmp_path: Path) -> None:
    project = worked(tmp_path / "p.genmojo")
    for t in (1, 3, 5):
        project.do(keys.confirm(project.annotation, [1, 2], t))
    project.close()
    entries = timed(audit.entries(tmp_path / "p.genmojo"))
    whole = work_figures.figures(project.annotation, entries, "clip", stride=1)[0]
    assert (whole.left, whole.confirmed) == (24 - 13, 13)
    assert whole.eta_seconds == pytest.approx(whole.seconds * 11 / 13)
    for track in (1, 2):
        edit_tracks.approve(project.annotation, track, "Bo").do(project.annotation)
    done = work_figures.figures(project.annotation, entries, "clip")[0]
    assert (done.left, done.eta_seconds) == (0, 0.0)


def test_only_frames_of_the_stride_are_left_and_nothing_of_a_closed_clip(tmp_path: Path) -> None:
    project = worked(tmp_path / "p.genmojo")
    a = project.annotation
    for t in (1, 3, 5, 7, 9):  # beside the stride: the frames of the stride are as open as before
        project.do(keys.confirm(a, [1, 2], t))
    project.close()
    entries = timed(audit.entries(tmp_path / "p.genmojo"))
    whole = work_figures.figures(a, entries, "clip")[0]
    assert (whole.left, whole.confirmed) == ((6 - 4) + (6 - 3), 17)
    assert whole.eta_seconds == pytest.approx(whole.seconds * 5 / 17)
    set_meta(a, "limit_points", "5").do(a)
    assert work_figures.figures(a, entries, "clip")[0].left == 5 + 3 * 6
    for track in (1, 2):
        edit_tracks.approve(a, track, "Bo").do(a)
    done = work_figures.figures(a, entries, "clip")[0]
    assert (done.left, done.eta_seconds) == (0, 0.0)


def test_what_is_not_known_is_said_in_words(tmp_path: Path) -> None:
    Project.create(tmp_path / "p.genmojo", info_of(12, annotations.SIZE, "clip")).close()
    loaded = project_file.load(tmp_path / "p.genmojo")
    (row,) = work_figures.figures(loaded.annotation, [], "clip")
    assert row.unknown["keys_per_track"] == row.unknown["eta_seconds"] == "no track yet"
    assert row.unknown["reopened"] == row.unknown["visible"] == "no track yet"
    fresh = annotations.started(12, 1, 1)
    assert work_figures.figures(fresh, [], "clip")[0].unknown["reopened"] == "nothing was reviewed yet"
    worked(tmp_path / "q.genmojo").close()
    time_sheet.without_people(tmp_path / "q.genmojo", tmp_path / "bare.genmojo")
    bare = project_file.load(tmp_path / "bare.genmojo")
    whole = work_figures.figures(bare.annotation, audit.entries(tmp_path / "bare.genmojo"), "clip")[0]
    assert whole.seconds is None
    assert whole.unknown["seconds"] == "times were taken out of this copy"


def test_tables_name_the_clip_and_keep_people_back_without_consent(tmp_path: Path) -> None:
    project = worked(tmp_path / "p.genmojo")
    project.close()

    def rows(name: str) -> list[dict[str, str]]:
        with open(tmp_path / name, encoding="utf-8-sig", newline="") as stream:
            return list(csv.DictReader(stream))

    assert cli.main(["times", str(tmp_path / "p.genmojo"), "-o", str(tmp_path / "a.csv")]) == 0
    (only,) = rows("a.csv")
    assert (only["clip"], only["person"], only["seconds"], only["keys"]) == ("clip", "", "", "3")
    project = Project.open(tmp_path / "p.genmojo", "Ada")
    project.do(set_meta(project.annotation, "consent", "yes"))
    project.put_blob("stride", b"4")
    project.close()
    assert cli.main(["times", str(tmp_path / "p.genmojo"), "-o", str(tmp_path / "b.csv")]) == 0
    assert [r["person"] for r in rows("b.csv")] == ["", "Ada", "Bo"]
    assert (only["left"], rows("b.csv")[0]["left"]) == ("5", "2")  # of 0, 2, .. 10; of 0, 4, 8 by its own stride
    entries = audit.entries(tmp_path / "p.genmojo")
    found = work_figures.figures(project.annotation, entries, "clip")[0]
    time_sheet.write_time_sheet([e.row for e in entries], "yes", tmp_path / "t.csv", "clip",
                                work_figures.placed_keys(entries))  # fmt: skip
    days = rows("t.csv")
    assert {d["clip"] for d in days} == {"clip"}
    assert (tmp_path / "t.csv").read_bytes().startswith(b"\xef\xbb\xbf"), "spreadsheets tell UTF-8 by its mark"
    named = [e.row if e.row.who == "Bo" else replace(e.row, who="=1+1") for e in entries]
    time_sheet.write_time_sheet(named, "yes", tmp_path / "t.csv", "-clip")
    work_figures.write([replace(found, person="@me")], tmp_path / "f.csv", "yes")
    assert {d["person"] for d in rows("t.csv")} == {"'=1+1", "Bo"} and rows("t.csv")[0]["clip"] == "'-clip"
    assert rows("f.csv")[0]["person"] == "'@me"
    assert sum(int(d["keys"]) for d in days) == 4  # the one undone was work too
