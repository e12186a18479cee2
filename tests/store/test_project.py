"""Projects: undo and redo through restarts, branches, two programs, damaged files, full disks, old backups."""

from __future__ import annotations

import json
import sqlite3
import time
import zlib
from contextlib import closing
from pathlib import Path

import annotations
import numpy as np
import pytest

from genmojo_core.errors import GenmojoError
from genmojo_core.store import project_file
from genmojo_core.store.edit_codec import decode_annotation, encode_annotation
from genmojo_core.store.project import Project, info_of
from genmojo_core.tracks import edit_tracks, keys
from genmojo_core.tracks.annotation import TRACKER, Annotation, ObjectInfo, Proposal


def begun(path: Path, frames: int = 24, points: int = 3) -> Project:
    project = Project.create(path, info_of(frames, annotations.SIZE, "demo"), person="Ada")
    project.do(edit_tracks.put_objects(project.annotation, [ObjectInfo(1, "dog", 1, "chosen")]))
    for number in range(points):
        project.do(edit_tracks.add_track(project.annotation, 1, number + 1))
    return project


def random_history(project: Project, edits: int, seed: int) -> None:
    """Edits with an undo or redo now and then, so that the history branches."""
    rng = np.random.default_rng(seed)
    for _ in range(edits):
        action = rng.integers(10)
        if action == 0:
            project.undo()
        elif action == 1:
            project.redo()
        else:
            project.do(annotations.random_edit(project.annotation, rng))


def check_undo_all_redo_all(path: Path, edits: int, seed: int) -> None:
    project = begun(path)
    random_history(project, edits, seed)
    while project.redo() is not None:
        pass
    full = project.annotation.digest()
    while project.undo() is not None:
        pass
    empty = project.annotation.digest()
    assert empty == Annotation(24, annotations.SIZE).digest()
    while project.redo() is not None:
        pass
    assert project.annotation.digest() == full
    project.close()
    again = Project.open(path, backup=False)
    assert again.annotation.digest() == full
    assert project_file.verify(path) == []
    while again.undo() is not None:
        pass
    assert again.annotation.digest() == empty
    again.close()


@pytest.mark.parametrize("seed", range(3))
def test_undoing_and_redoing_everything_gives_the_same_annotation_also_after_a_restart(
    tmp_path: Path, seed: int
) -> None:
    check_undo_all_redo_all(tmp_path / "p.genmojo", 150, seed)


@pytest.mark.slow
@pytest.mark.timeout(1800)
@pytest.mark.parametrize("seed", range(50))
def test_fifty_histories_of_a_thousand_edits(tmp_path: Path, seed: int) -> None:
    check_undo_all_redo_all(tmp_path / "p.genmojo", 1000, seed + 100)


def test_undo_names_the_frame_and_track_to_look_at_even_after_a_restart(tmp_path: Path) -> None:
    project = begun(tmp_path / "p.genmojo")
    project.do(keys.set_key(project.annotation, 2, 7, (10.0, 20.0)))
    project.do(keys.set_key(project.annotation, 3, 15, (30.0, 40.0)))
    project.close()
    project = Project.open(tmp_path / "p.genmojo")
    first = project.undo()
    second = project.undo()
    assert (first.frame, first.track, first.titles) == (15, 3, ("Place point 3 of dog",))
    assert (second.frame, second.track) == (7, 2)
    project.close()
    project = Project.open(tmp_path / "p.genmojo")
    assert project.redo().frame == 7
    assert project.annotation.track(2).xy[7].tolist() == [10.0, 20.0]
    project.close()


def test_what_a_tracker_answers_is_undone_with_the_key_it_answers(tmp_path: Path) -> None:
    project = begun(tmp_path / "p.genmojo")
    before = project.annotation.digest()
    step = project.do(keys.set_key(project.annotation, 1, 5, (10.0, 20.0)))
    rng = np.random.default_rng(0)
    project.do(annotations.solution(project.annotation, 1, np.arange(24), rng), step=step)
    project.undo()
    assert project.annotation.digest() == before
    assert project.do(annotations.solution(project.annotation, 1, np.arange(24), rng), step=step) is None
    assert project.annotation.digest() == before
    project.close()


def test_what_could_not_be_written_is_counted_once_and_written_at_the_end(tmp_path: Path) -> None:
    project = begun(tmp_path / "p.genmojo")
    project.wait()
    with closing(sqlite3.connect(tmp_path / "p.genmojo")) as connection, connection:
        connection.execute("CREATE TRIGGER full BEFORE INSERT ON edits BEGIN SELECT RAISE(ABORT, 'disk is full'); END")
    project.do(keys.set_key(project.annotation, 1, 5, (10.0, 20.0)))
    for _ in range(3):
        assert not project.wait(60)
        assert project.unsaved() == 1
        project.retry()
    assert not project.wait(60)
    with closing(sqlite3.connect(tmp_path / "p.genmojo")) as connection, connection:
        connection.execute("DROP TRIGGER full")
    project.close()
    assert project_file.load(tmp_path / "p.genmojo").annotation.track(1).xy[5].tolist() == [10.0, 20.0]
    assert project_file.clip_of(tmp_path / "p.genmojo").frames == project.annotation.frames


def test_a_late_answer_is_not_taken_back_with_what_was_done_meanwhile(tmp_path: Path) -> None:
    project = begun(tmp_path / "p.genmojo")
    step = project.do(keys.set_key(project.annotation, 1, 5, (10.0, 20.0)))
    project.do(keys.set_key(project.annotation, 2, 5, (30.0, 20.0)))
    rng = np.random.default_rng(0)
    project.do(annotations.solution(project.annotation, 1, np.arange(24), rng), step=step)
    solved = project.annotation.track(1).xy[9].tolist()
    project.undo()
    assert project.annotation.track(2).xy[5].tolist() == [30.0, 20.0], "only the answer was taken back"
    assert project.annotation.track(1).xy[9].tolist() != solved
    project.undo()
    assert project.annotation.track(2).state[5] == 0
    assert project.annotation.track(1).xy[5].tolist() == [10.0, 20.0]
    project.close()


def test_another_branch_can_be_returned_to(tmp_path: Path) -> None:
    project = begun(tmp_path / "p.genmojo")
    project.do(keys.set_key(project.annotation, 1, 5, (10.0, 20.0)))
    left, kept = project.log.head, project.annotation.digest()
    project.undo()
    project.do(keys.set_key(project.annotation, 1, 9, (1.0, 2.0)))
    project.do(keys.set_key(project.annotation, 1, 10, (1.0, 3.0)))
    other = project.annotation.digest()
    project.go_to(left)
    assert project.annotation.digest() == kept
    project.undo()
    assert project.redo().frame == 5
    project.go_to(project.history()[-1].seq)
    assert project.annotation.digest() == other
    project.close()


def test_named_states_can_be_returned_to(tmp_path: Path) -> None:
    project = begun(tmp_path / "p.genmojo")
    project.do(keys.set_key(project.annotation, 1, 5, (10.0, 20.0)))
    named = project.annotation.digest()
    project.checkpoint("first pass")
    project.do(keys.set_key(project.annotation, 1, 9, (1.0, 2.0)))
    project.go_to(project.checkpoints()[0].parent)
    assert project.annotation.digest() == named
    assert len(project_file.backups(project.path)) == 1
    project.close()


def test_the_second_program_may_look_but_not_write(tmp_path: Path) -> None:
    project = begun(tmp_path / "p.genmojo")
    project.do(keys.set_key(project.annotation, 1, 5, (10.0, 20.0)))
    project.wait()
    second = Project.open(tmp_path / "p.genmojo")
    assert second.read_only
    assert second.annotation.digest() == project.annotation.digest()
    with pytest.raises(GenmojoError, match="another program"):
        second.do(keys.set_key(second.annotation, 1, 6, (1.0, 1.0)))
    project.close()
    second.close()
    third = Project.open(tmp_path / "p.genmojo")
    assert not third.read_only
    third.close()


def test_a_closed_project_is_one_file_and_opens_where_nobody_can_write(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    project = begun(tmp_path / "p.genmojo")
    expected = project.annotation.digest()
    project.close()
    assert sorted(p.name for p in tmp_path.iterdir()) == ["p.genmojo", "p.genmojo.lock"]
    before = (tmp_path / "p.genmojo").read_bytes()
    monkeypatch.setattr("os.access", lambda path, mode: False)
    assert project_file.load(tmp_path / "p.genmojo").annotation.digest() == expected
    assert (tmp_path / "p.genmojo").read_bytes() == before
    assert sorted(p.name for p in tmp_path.iterdir()) == ["p.genmojo", "p.genmojo.lock"]


def test_proposals_are_kept_untouched(tmp_path: Path) -> None:
    project = begun(tmp_path / "p.genmojo")
    rng = np.random.default_rng(1)
    made = Proposal("optical", rng.uniform(0, 99, (24, 2)).astype(np.float32), np.ones(24, np.uint8),
                    np.ones(24, np.float32))  # fmt: skip
    project.propose(1, made)
    project.do(keys.accept(project.annotation, {1: made}, TRACKER))
    project.do(keys.set_key(project.annotation, 1, 5, (10.0, 20.0)))
    project.close()
    again = Project.open(tmp_path / "p.genmojo")
    assert np.array_equal(again.annotation.proposals[1]["optical"].xy, made.xy)
    again.close()


def test_edits_are_on_the_disk_within_a_fifth_of_a_second(tmp_path: Path) -> None:
    project = begun(tmp_path / "p.genmojo")
    delays: list[float] = []
    project.saved = lambda seq, seconds: delays.append(seconds)
    rng = np.random.default_rng(0)
    for _ in range(150):
        project.do(annotations.random_edit(project.annotation, rng))
        time.sleep(0.002)
    assert project.wait()
    assert len(delays) > 100
    assert np.quantile(delays, 0.99) < 0.2
    project.close()


def test_a_changed_row_is_found(tmp_path: Path) -> None:
    project = begun(tmp_path / "p.genmojo")
    project.do(keys.set_key(project.annotation, 1, 5, (10.0, 20.0)))
    project.close()
    with sqlite3.connect(tmp_path / "p.genmojo") as connection:
        connection.execute("UPDATE edits SET who = 'Eve' WHERE seq = 3")
    connection.close()
    assert len(project_file.verify(tmp_path / "p.genmojo")) == 1


def test_files_that_are_no_sound_project_are_refused_in_one_sentence(tmp_path: Path) -> None:
    with pytest.raises(GenmojoError, match="does not exist"):
        Project.open(tmp_path / "none.genmojo")
    (tmp_path / "text.genmojo").write_bytes(b"hello" * 1000)
    with pytest.raises(GenmojoError, match="no project"):
        Project.open(tmp_path / "text.genmojo")
    begun(tmp_path / "new.genmojo").close()
    with sqlite3.connect(tmp_path / "new.genmojo") as connection:
        connection.execute("PRAGMA user_version=9")
    connection.close()
    with pytest.raises(GenmojoError, match="version 9, this program knows up to 2"):
        Project.open(tmp_path / "new.genmojo")
    with pytest.raises(GenmojoError, match="exists already"):
        begun(tmp_path / "new.genmojo")


def test_a_damaged_shortcut_is_not_needed(tmp_path: Path) -> None:
    project = begun(tmp_path / "p.genmojo")
    random_history(project, 40, 5)
    expected = project.annotation.digest()
    project.close()
    with sqlite3.connect(tmp_path / "p.genmojo") as connection:
        connection.execute("UPDATE blobs SET data = x'00' WHERE name LIKE 'snapshot:%'")
    connection.close()
    project = Project.open(tmp_path / "p.genmojo")
    assert project.annotation.digest() == expected
    project.close()


def test_a_changed_shortcut_is_not_believed_and_is_told(tmp_path: Path) -> None:
    path = tmp_path / "p.genmojo"
    project = begun(path)
    random_history(project, 40, 5)
    expected = project.annotation.digest()
    project.close()
    assert project_file.check_chain(path).states == ()

    def change(name: str) -> None:
        """Another annotation is put where the shortcut was, under a name."""
        other = project_file.load(path).annotation
        keys.set_key(other, next(iter(other.tracks)), 2, (1.0, 2.0)).do(other)
        with sqlite3.connect(path) as connection:
            connection.execute("UPDATE blobs SET data = ?, name = COALESCE(?, name) WHERE name LIKE 'snapshot:%'",
                               (encode_annotation(other), name or None))  # fmt: skip
        connection.close()

    change("")
    rows = len(project.log)
    assert project_file.load(path).annotation.digest() == expected
    assert project_file.check_chain(path).states == (rows,)
    assert project_file.verify(path) == [f"the state kept after edit {rows} is not what the edits lead to"]
    change(f"snapshot:{rows}")  # as of files of version 1, which say nothing of what was kept
    assert project_file.check_chain(path).states == (rows,)


def test_older_programs_are_kept_out_by_the_first_edit_not_by_a_look(tmp_path: Path) -> None:
    """They would drop reviewers' notes and know no edits of proposals."""
    path = tmp_path / "p.genmojo"
    begun(path).close()

    def version(new: int | None = None) -> int:
        with sqlite3.connect(path) as connection:
            if new is not None:
                connection.execute(f"PRAGMA user_version={new}")
            found = connection.execute("PRAGMA user_version").fetchone()[0]
        connection.close()
        return int(found)

    assert version() == 2
    assert version(1) == 1
    project = Project.open(path)
    project.note_digests({0: "file:00"})
    project.moved_clip("elsewhere")
    project.close()
    assert version() == 1
    project = Project.open(path)
    project.do(keys.set_key(project.annotation, 1, 5, (10.0, 20.0)))
    project.close()
    assert version() == 2
    assert [project_file.load(copy).version for copy in project_file.backups(path)] == [1, 1]


def test_what_cannot_be_written_is_said_kept_and_can_be_saved_elsewhere(tmp_path: Path) -> None:
    project = begun(tmp_path / "p.genmojo")
    project.wait()
    heard: list[GenmojoError] = []
    project.failed = heard.append
    blocker = sqlite3.connect(tmp_path / "p.genmojo", isolation_level=None)
    blocker.execute("CREATE TRIGGER full BEFORE INSERT ON edits BEGIN SELECT RAISE(FAIL, 'disk is full'); END")
    project.do(keys.set_key(project.annotation, 1, 5, (10.0, 20.0)))
    assert not project.wait()
    assert "disk is full" in heard[0].sentence()
    blocker.execute("DROP TRIGGER full")
    project.save_copy(tmp_path / "copy.genmojo")
    copied = Project.open(tmp_path / "copy.genmojo")
    assert copied.annotation.digest() == project.annotation.digest()
    copied.close()
    project.do(keys.set_key(project.annotation, 1, 6, (10.0, 20.0)))
    assert project.wait()
    project.close()
    blocker.close()
    assert project_file.load(tmp_path / "p.genmojo").annotation.digest() == project.annotation.digest()


def test_a_project_from_before_reviewers_had_notes_of_their_own_keeps_every_word() -> None:
    """A reviewer then wrote over the one note there was: of what came back it is the reviewer's."""
    annotation = annotations.started(6, 1, 3)
    edit_tracks.needs_fix(annotation, 1, "drift", (1, 2), "Bo", "left ear").do(annotation)
    edit_tracks.update_track(annotation, 2, note="blurred", review="approved", locked=True).do(annotation)
    record = json.loads(zlib.decompress(encode_annotation(annotation)))
    for track in record["tracks"]:
        track["info"]["note"] = track["info"].pop("review_note") or track["info"]["note"]
    old = decode_annotation(zlib.compress(json.dumps(record).encode()))
    assert [(i.note, i.review_note) for i in old.tracks.values()] == [("", "left ear"), ("blurred", ""), ("", "")]
    assert old.digest() == annotation.digest()
