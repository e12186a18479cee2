"""The audit log says who did what to which point, what stood before and after, and whether it stands."""

from __future__ import annotations

import csv
import json
import sqlite3
from pathlib import Path

import annotations
import numpy as np

from genmojo_core.cli import main as cli
from genmojo_core.store import audit, project_file
from genmojo_core.store.project import Project, info_of
from genmojo_core.tracks import annotation, edit_tracks, exchange, keys
from genmojo_core.tracks.annotation import ObjectInfo
from genmojo_core.tracks.edits import set_meta
from genmojo_core.tracks.model import OCCLUDED, VISIBLE


def worked(path: Path) -> Project:
    """A point placed, filled, moved, painted, returned, approved; a move was undone."""
    project = Project.create(path, info_of(12, annotations.SIZE, "clip"), person="Ada")
    a = project.annotation
    project.do(edit_tracks.put_objects(a, [ObjectInfo(1, "dog", 1, "chosen"), ObjectInfo(2, "", 2, "chosen")]))
    project.do(edit_tracks.add_track(a, 1, 2, "Ada", "nose"))
    project.do(keys.set_key(a, 1, 3, (100.0, 200.0)))
    project.do(annotations.solution(a, 1, np.arange(12), np.random.default_rng(0)))
    project.do(keys.set_key(a, 1, 3, (103.0, 204.0)))
    project.undo()
    project.do(keys.set_state(a, 1, 5, 8, OCCLUDED))
    project.person = "Bo"
    project.do(edit_tracks.needs_fix(a, 1, "drift", (2, 4), "Bo", "look"))
    project.checkpoint("here")
    return project


def test_every_line_tells_point_frames_before_and_after(tmp_path: Path) -> None:
    project = worked(tmp_path / "p.genmojo")
    project.close()
    found = audit.entries(tmp_path / "p.genmojo")
    assert [e.row.seq for e in found] == list(range(1, 10))
    made, first, moved = found[1], found[2], found[4]
    assert [p.title() for p in made.words.points] == ["dog · 2 nose"]
    assert (first.words.first, first.words.last, first.words.keys) == (3, 3, (0, 1))
    assert first.words.before == ("not annotated ×1", "keys: 0")
    assert first.words.after == ("x 100.0 y 200.0", "visible ×1", "keys: 1")
    assert first.words.placed == ((1, 3),)
    assert found[3].words.machine and found[3].words.placed == ()
    assert moved.words.before[0] == "x 100.0 y 200.0"
    assert moved.words.after[0] == "x 103.0 y 204.0"
    assert moved.words.moved == 5.0
    assert [e.stands for e in found] == [True] * 4 + [False] + [True] * 4
    assert (found[5].row.kind, found[5].words.points) == ("undo", moved.words.points)
    painted = found[6].words
    assert (painted.first, painted.last) == (5, 8)
    assert f"occluded ×{painted.frames}" in painted.after
    assert {"needs a fix", "drift", "frames 2 to 4", "times returned: 1"} < set(found[7].words.after)
    assert "draft" in found[7].words.before


def test_a_swap_of_tracks_that_were_proposed_can_be_read(tmp_path: Path) -> None:
    project = worked(tmp_path / "p.genmojo")
    a = project.annotation
    project.do(edit_tracks.add_track(a, 1, 3, "Ada", "ear"))
    xy = np.full((12, 2), 50.0, np.float32)
    ways = {2: annotation.Proposal("optical", xy, np.full(12, VISIBLE, np.uint8), np.ones(12, np.float32))}
    a.propose(2, ways[2])
    project.do(keys.accept(a, ways, annotation.TRACKER))
    project.do(exchange.swap(a, 1, 2, 4, 9))
    project.close()
    swapped = audit.entries(tmp_path / "p.genmojo")[-1]
    assert [p.title() for p in swapped.words.points] == ["dog · 2 nose", "dog · 3 ear"]


def test_a_point_keeps_the_name_it_had_then(tmp_path: Path) -> None:
    project = worked(tmp_path / "p.genmojo")
    project.do(edit_tracks.update_track(project.annotation, 1, name="snout"))
    project.undo()
    project.do(edit_tracks.delete_track(project.annotation, 1))
    project.close()
    last = audit.entries(tmp_path / "p.genmojo")[-3:]
    assert [e.words.points[0].title() for e in last] == ["dog · 2 snout", "dog · 2 nose", "dog · 2 nose"]
    assert last[-1].words.after[0] == "deleted"


def test_the_log_is_exported_whole_with_consent_and_nameless_without(tmp_path: Path) -> None:
    project = worked(tmp_path / "p.genmojo")
    project.do(set_meta(project.annotation, "consent", "yes"))
    project.close()
    found = audit.entries(tmp_path / "p.genmojo")
    audit.write(found, tmp_path / "l.csv", "clip", "yes")
    with open(tmp_path / "l.csv", encoding="utf-8-sig", newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert [r["who"] for r in rows] == ["Ada"] * 7 + ["Bo"] * 3
    assert rows[4] | {"stands": "no", "points": "dog · 2 nose", "moved_px": "5.0", "keys_before": "1"} == rows[4]
    assert rows[4]["at"].endswith("+00:00")
    assert len({r["hash"] for r in rows}) == 10
    audit.write(found, tmp_path / "l.json", "clip", "")
    text = (tmp_path / "l.json").read_text()
    assert "Ada" not in text and "Bo" not in text
    lines = json.loads(text)["log"]
    assert [line["who"] for line in lines] == ["person 1"] * 7 + ["person 2"] * 3
    assert {len(line["at"]) for line in lines} == {len("2026-01-05")}


def test_the_command_writes_what_was_asked_for_and_finds_a_broken_chain(tmp_path: Path) -> None:
    path = tmp_path / "p.genmojo"
    worked(path).close()
    assert cli.main(["log", str(path), "-o", str(tmp_path / "l.json"), "--track", "1", "--standing"]) == 0
    lines = json.loads((tmp_path / "l.json").read_text())["log"]
    assert [line["seq"] for line in lines] == [2, 3, 4, 6, 7, 8]
    with sqlite3.connect(path) as connection:
        connection.execute("UPDATE edits SET title = 'nothing' WHERE seq = 3")
    connection.close()
    assert cli.main(["log", str(path)]) == 2
    assert [row.seq for row in project_file.check_chain(path).broken] == [3]
    with sqlite3.connect(path) as connection:
        connection.execute("DELETE FROM edits WHERE seq = 5")
    connection.close()
    chain = project_file.check_chain(path)
    assert (chain.missing, chain.entries) == ((5,), 8)


def test_times_are_local_and_say_their_zone(monkeypatch) -> None:
    import time

    monkeypatch.setenv("TZ", "Europe/Berlin")
    time.tzset()
    try:
        assert audit.local("2026-01-05T10:00:00.500+00:00") == "2026-01-05 11:00:00 +01:00"
        assert audit.local("2026-01-05") == "2026-01-05"
    finally:
        monkeypatch.undo()
        time.tzset()
