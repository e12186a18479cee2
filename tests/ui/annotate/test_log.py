"""The log in a real window: filters, undone edits, the chain in words, export; a track's history shows what stands."""

import json
import sqlite3

import pytest
from annotating import choose_all, place_points
from PySide6.QtGui import QFont
from PySide6.QtWidgets import QFileDialog

from genmojo_core.store.project_file import Chain
from genmojo_core.tracks import edit_tracks
from genmojo_studio.annotate import verbs
from genmojo_studio.annotate.audit_panel import chain_words
from genmojo_studio.annotate.log_dialog import LogDialog


@pytest.fixture
def dialog(workspace, qtbot):
    choose_all(workspace)
    place_points(workspace, each=2)
    session = workspace.session
    session.select_track(1)
    verbs.nudge(session, 3.0, 4.0)
    session.undo()
    session.project.person = "Bo"
    session.do(edit_tracks.needs_fix(session.annotation, 1, "drift", (2, 4), "Bo", "look"))
    made = LogDialog(session, workspace)
    made.tabs.setCurrentWidget(made.audit)
    made.open()
    qtbot.waitActive(made, timeout=60_000)
    qtbot.waitUntil(lambda: made.audit.model is not None, timeout=60_000)
    yield made
    made.reject()


def texts(panel):
    """What the table shows."""
    model = panel.table.model()
    return [[str(model.index(y, x).data()) for x in range(model.columnCount())] for y in range(model.rowCount())]


def test_undone_edits_are_marked_and_lines_are_chosen_by_point_person_and_standing(dialog):
    panel = dialog.audit
    rows = texts(panel)
    assert len(rows) == len(dialog.audit.model.entries)
    undone = [row for row in rows if row[3] == "undone"]
    (moved,) = (row for row in undone if "moved by" in row[7])
    model = panel.table.model()
    line = rows.index(moved)
    assert model.index(line, 2).data(0x6).strikeOut()  # FontRole
    assert not isinstance(model.index(0, 2).data(0x6), QFont)
    panel.track.setCurrentIndex(panel.track.findData(2))
    assert {row[4] for row in texts(panel)} == {panel.track.currentText()}
    panel.track.setCurrentIndex(0)
    panel.person.setCurrentIndex(panel.person.findData("Bo"))
    assert [row[1] for row in texts(panel)] == ["Bo"]
    panel.person.setCurrentIndex(0)
    panel.standing.setChecked(True)
    assert {row[3] for row in texts(panel)} == {"yes"}


def test_the_chain_is_told_in_words(dialog, qtbot):
    panel = dialog.audit
    panel.check_button.click()
    qtbot.waitUntil(lambda: "whole" in panel.chain.text(), timeout=60_000)
    with sqlite3.connect(panel._session.project.path, timeout=30) as connection:
        connection.execute("UPDATE edits SET who = 'Eve' WHERE seq = 2")
    connection.close()
    panel.check_button.click()
    qtbot.waitUntil(lambda: "1 of" in panel.chain.text() and "number 2" in panel.chain.text(), timeout=60_000)
    assert "state kept after number 4 is not what they lead to" in chain_words(Chain(9, (), (), (4,)), 9)


def test_the_log_is_exported_by_button_and_by_menu(dialog, workspace, qtbot, tmp_path, monkeypatch):
    target = tmp_path / "log.json"
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(target), "JSON (*.json)"))
    dialog.audit.export_button.click()
    qtbot.waitUntil(target.exists, timeout=60_000)
    assert len(json.loads(target.read_text())["log"]) == len(workspace.session.project.log)
    dialog.reject()
    target.unlink()
    assert workspace.table.trigger("annotate.review.export_log")
    qtbot.waitUntil(target.exists, timeout=60_000)


def test_the_history_of_a_track_shows_only_what_stands(dialog, workspace):
    dialog.reject()
    workspace.show_step(3)
    workspace.session.select_track(1)
    shown = [workspace.review.history.item(n).text() for n in range(workspace.review.history.count())]
    assert shown[0].startswith("Needs fix: drift")
    assert len(shown) == 2  # the nudge was undone


def test_figures_of_clip_and_people_say_in_words_what_is_not_known(dialog, workspace, tmp_path, monkeypatch):
    table = dialog.figures
    titles = [table.horizontalHeaderItem(x).text() for x in range(table.columnCount())]
    assert titles == ["figure", "whole clip", "Ada", "Bo"]
    cells = {table.item(y, 0).text(): [table.item(y, x).text() for x in (1, 2, 3)] for y in range(table.rowCount())}
    points = len(workspace.session.annotation.tracks)
    assert cells["keys"] == [str(points), str(points), "0"]  # first placements
    assert cells["share of reviewed tracks sent back"][0] == "100.0%"
    assert "needs 10" in cells["time for what is left"][0]
    assert dialog.sheet.item(0, 0).text() == workspace.session.project.info.name
    assert not dialog.export_sheet.isEnabled()
    target = tmp_path / "figures.csv"
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(target), "CSV (*.csv)"))
    dialog.export_figures.click()
    assert "Ada" not in target.read_text("utf-8-sig")
