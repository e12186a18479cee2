"""Work that the disk does not take, copies, backups, and clips that were moved: nothing is lost in silence."""

import shutil
import sqlite3
from contextlib import closing
from datetime import UTC, datetime

import pytest
from annotating import choose_all, place_points
from PySide6.QtCore import Qt, QTimer
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMessageBox

from genmojo_core.errors import GenmojoError
from genmojo_core.store import project_file
from genmojo_core.store.project import Project
from genmojo_studio.annotate.session import open_session
from genmojo_studio.state import AppState

FULL = "CREATE TRIGGER full BEFORE INSERT ON edits BEGIN SELECT RAISE(ABORT, 'disk is full'); END"


def fill_disk(workspace):
    with closing(sqlite3.connect(workspace.session.project.path)) as connection, connection:
        connection.execute(FULL)


def free_disk(workspace):
    with closing(sqlite3.connect(workspace.session.project.path)) as connection, connection:
        connection.execute("DROP TRIGGER full")


def place_on_full_disk(workspace, qtbot):
    """Points that cannot be written, and the word that they are not."""
    choose_all(workspace)
    workspace.session.project.wait()
    fill_disk(workspace)
    place_points(workspace, each=1)
    qtbot.waitUntil(lambda: workspace.bar.saved.text() == "NOT SAVED", timeout=60_000)


def answer(texts, seen):
    """Press buttons of the questions that will be asked, one after the other."""

    def press():
        box = QApplication.activeModalWidget()
        if not isinstance(box, QMessageBox):
            QTimer.singleShot(50, press)
            return
        seen.append(box.text())
        text = texts.pop(0)
        next(b for b in box.buttons() if b.text().replace("&", "") == text).click()
        if texts:
            QTimer.singleShot(50, press)

    QTimer.singleShot(50, press)


def test_closing_asks_while_edits_are_not_on_the_disk(workspace, qtbot):
    place_on_full_disk(workspace, qtbot)
    edits, seen = len(workspace.session.annotation.tracks), []
    answer(["Cancel"], seen)
    assert not workspace.close()
    assert "could not be written" in seen[0]
    assert workspace.session is not None
    free_disk(workspace)
    answer(["Try again"], seen)
    assert workspace.hands.keeping.may_close()
    qtbot.waitUntil(lambda: workspace.bar.saved.text() != "NOT SAVED", timeout=60_000)
    path = workspace.session.project.path
    assert workspace.close()
    assert len(project_file.load(path).annotation.tracks) == edits


def test_what_the_disk_does_not_take_goes_into_a_copy(workspace, qtbot, tmp_path, monkeypatch):
    place_on_full_disk(workspace, qtbot)
    free_disk(workspace)  # the copy lies on another disk; here nothing is tried again before it is asked for
    digest, copy, seen = workspace.session.annotation.digest(), tmp_path / "copy.genmojo", []
    monkeypatch.setattr("PySide6.QtWidgets.QFileDialog.getSaveFileName", lambda *a, **k: (str(copy), ""))
    answer(["Save a copy…"], seen)
    assert workspace.hands.keeping.may_close()
    assert seen
    assert project_file.load(copy).annotation.digest() == digest
    workspace.session.project.retry()
    assert workspace.session.project.wait(60)


def test_the_question_names_the_fault_and_escape_loses_nothing(workspace, qtbot):
    place_on_full_disk(workspace, qtbot)
    seen = []

    def look():
        box = QApplication.activeModalWidget()
        if not isinstance(box, QMessageBox):
            QTimer.singleShot(50, look)
            return
        seen.extend([box.informativeText(), box.defaultButton().text(), box.escapeButton().text()])
        QTest.keyClick(box, Qt.Key.Key_Escape)

    QTimer.singleShot(50, look)
    assert not workspace.hands.keeping.may_close()
    assert "disk is full" in seen[0] and seen[1] == "Try again" and seen[2].replace("&", "") == "Cancel"
    free_disk(workspace)
    workspace.session.project.retry()


def test_backups_are_told_by_local_time(workspace, monkeypatch):
    workspace.session.project.checkpoint("half way")
    (copy,) = project_file.backups(workspace.session.project.path)
    copy.with_name("kept by hand.genmojo").write_bytes(copy.read_bytes())
    asked = []
    monkeypatch.setattr("PySide6.QtWidgets.QInputDialog.getItem", lambda *a, **k: (asked.append(a), ("", False))[1])
    workspace.table.trigger("annotate.file.backup")
    made = datetime.strptime(copy.stem, "%Y%m%dT%H%M%S%f").replace(tzinfo=UTC).astimezone()
    assert "stays as it is" in asked[0][2]
    assert asked[0][3][0] == "1: kept by hand" and f"{made:%Y-%m-%d %H:%M:%S}" in asked[0][3][1]


def test_a_copy_and_a_backup_are_projects_of_their_own(workspace, qtbot, tmp_path, monkeypatch):
    choose_all(workspace)
    session = workspace.session
    copy = tmp_path / "for a colleague"
    monkeypatch.setattr("PySide6.QtWidgets.QFileDialog.getSaveFileName", lambda *a, **k: (str(copy), ""))
    workspace.table.trigger("annotate.file.copy")
    assert project_file.load(copy.with_suffix(".genmojo")).annotation.digest() == session.annotation.digest()
    session.project.checkpoint("half way")
    then = session.annotation.digest()
    place_points(workspace, each=1)
    monkeypatch.setattr("PySide6.QtWidgets.QInputDialog.getItem", lambda *a, **k: (a[3][0], True))
    path = session.project.path
    workspace.table.trigger("annotate.file.backup")
    assert workspace.session.project.path != path
    assert workspace.session.annotation.digest() == then
    assert len(project_file.load(path).annotation.tracks) > 0, "the project itself stays as it is"


def test_a_project_finds_its_clip_where_it_was_moved(qapp, qtbot, clip_folder, tmp_path):
    before, after = tmp_path / "before", tmp_path / "after"
    shutil.copytree(clip_folder, before)
    state = AppState()
    path = tmp_path / "p.genmojo"
    open_session(state, before, "Ada", path).close()
    before.rename(after)
    with pytest.raises(GenmojoError):
        open_session(state, path, "Ada")
    session = open_session(state, path, "Ada", clip=after)
    session.close()
    session = open_session(state, path, "Ada")
    assert session.project.info.path == str(after)
    session.close()
    other = tmp_path / "other"
    shutil.copytree(after, other)
    next(other.rglob("*.jpg")).unlink()
    with pytest.raises(GenmojoError, match="the project's clip has"):
        open_session(state, path, "Ada", clip=other)
    Project.open(path).close()  # nothing is left locked
