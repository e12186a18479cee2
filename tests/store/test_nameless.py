"""What goes out without consent names nobody, not even in notes, titles and names of moments."""

from __future__ import annotations

import json
import sqlite3
import zlib
from dataclasses import asdict
from pathlib import Path

import annotations

from genmojo_core.cli import main as cli
from genmojo_core.sentences import say
from genmojo_core.store import audit, project_file, time_sheet
from genmojo_core.store.nameless import HIDDEN, Nameless
from genmojo_core.store.project import Project, info_of
from genmojo_core.tracks import edit_tracks, keys
from genmojo_core.tracks.annotation import ObjectInfo

NAMES = ("Jörg", "Müller", "Bo", "Zoë")


def worked(path: Path) -> None:
    """Jörg places a point, Zoë was its annotator before, Bo returns it and names Jörg in his words."""
    project = Project.create(path, info_of(12, annotations.SIZE, "clip", "/data/jörg/clip"), person="Jörg Müller")
    a = project.annotation
    project.do(edit_tracks.put_objects(a, [ObjectInfo(1, "dog", 1, "chosen")]))
    project.do(edit_tracks.add_track(a, 1, 1, "Zoë"))
    project.do(edit_tracks.update_track(a, 1, person="Jörg Müller", note="Bo wants the left ear, not zoë"))
    project.do(keys.set_key(a, 1, 3, (5.0, 6.0)))
    project.undo()
    project.redo()
    project.person = "Bo"
    project.do(edit_tracks.needs_fix(a, 1, "drift", (2, 4), "Bo", "jörg, a boat hides it"))
    project.undo()
    project.redo()
    project.do(edit_tracks.reject(a, 1, "Bo", "Müller gave it up"))
    project.checkpoint("for Jörg")
    project.close()


def named(text: str) -> list[str]:
    return [name for name in NAMES if Nameless([name]).text(text) != text]


def test_a_copy_without_names_has_none_in_any_row_table_note_or_title(tmp_path: Path) -> None:
    worked(tmp_path / "p.genmojo")
    time_sheet.without_people(tmp_path / "p.genmojo", tmp_path / "bare.genmojo")
    assert project_file.verify(tmp_path / "bare.genmojo") == []
    loaded, full = (project_file.load(tmp_path / name) for name in ("bare.genmojo", "p.genmojo"))
    with sqlite3.connect(tmp_path / "bare.genmojo") as connection:
        rows = connection.execute("SELECT * FROM edits").fetchall()
        said = [zlib.decompress(row[-2]).decode() for row in rows if row[-2]]
        tables = [str(connection.execute(f"SELECT * FROM {t}").fetchall()) for t in ("clip", "objects", "tracks")]
        kept = json.loads(connection.execute("SELECT data FROM tracks").fetchone()[0])
    connection.close()
    texts = [*tables, *(json.dumps(json.loads(text), ensure_ascii=False) for text in said),
             *(str(row[:-2]) for row in rows), json.dumps(kept, ensure_ascii=False)]  # fmt: skip
    assert [named(text) for text in texts] == [[]] * len(texts)
    info = loaded.annotation.tracks[1]
    assert kept == json.loads(json.dumps(asdict(info)))
    assert info.note == f"{HIDDEN} wants the left ear, not {HIDDEN}"
    assert info.review_note == f"{HIDDEN} gave it up"
    assert loaded.log.rows[6].title == say("needs_fix_note", reason="drift", name=f"{HIDDEN}, a boat hides it")
    assert (loaded.annotation.track(1).xy == full.annotation.track(1).xy).all()


def test_a_log_without_consent_names_nobody_also_where_only_some_lines_are_written(tmp_path: Path) -> None:
    path = tmp_path / "p.genmojo"
    worked(path)
    for ending in ("csv", "json"):
        audit.write(audit.entries(path), tmp_path / f"l.{ending}", "clip", "")
        assert cli.main(["log", str(path), "-o", str(tmp_path / f"b.{ending}"), "--person", "Bo"]) == 0
        for name in ("l", "b"):
            text = (tmp_path / f"{name}.{ending}").read_text("utf-8-sig")
            assert named(json.dumps(json.loads(text), ensure_ascii=False) if ending == "json" else text) == []
            assert "a boat hides it" in text
    audit.write(audit.entries(path), tmp_path / "l.csv", "clip", "yes")
    assert named((tmp_path / "l.csv").read_text("utf-8-sig")) == list(NAMES)
