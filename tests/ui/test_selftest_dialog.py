"""Help › Try hard cases: the real program in a process of its own, its verdicts in a table; closing ends it."""

from __future__ import annotations

import json

from PySide6.QtCore import QProcess

from genmojo_studio.selftest_dialog import SelftestDialog


def test_verdicts_of_the_real_program_fill_the_table(window, qtbot):
    """The rows of one case of the study that take seconds."""
    dialog = SelftestDialog(window, rows=("N26",))
    qtbot.addWidget(dialog)
    dialog.show()
    with qtbot.waitSignal(dialog.ended, timeout=300_000):
        pass
    count = dialog.table.topLevelItemCount()
    rows = [dialog.table.topLevelItem(i) for i in range(count)]
    assert count > 2 and {row.text(0) for row in rows} == {"N26"}
    assert {row.text(3) for row in rows} == {"holds"} and all(row.text(2) for row in rows)
    assert dialog.said.text().startswith(f"{count} cases, 0 broken")


def test_a_broken_case_is_marked_and_no_answer_is_told(window, qtbot):
    dialog = SelftestDialog(window, rows=("N26",))
    qtbot.addWidget(dialog)
    verdict = {"row": "N99", "name": "made up", "happened": "two\nlines", "holds": False, "seconds": 1.25}
    dialog._show(json.loads(json.dumps({"verdicts": [verdict], "cases": 1, "failed": 1, "seconds": 2.0})))
    item = dialog.table.topLevelItem(0)
    assert [item.text(i) for i in range(5)] == ["N99", "made up", "two lines", "broken", "1.2"]
    dialog._process.kill()
    qtbot.waitUntil(lambda: dialog._process.state() == QProcess.ProcessState.NotRunning, timeout=60_000)
    assert "without a result" in dialog.said.text()


def test_closing_ends_the_program_and_the_menu_leads_to_it(window, qtbot, monkeypatch):
    opened = []
    monkeypatch.setattr(SelftestDialog, "open", lambda self: opened.append(self))
    window.table.trigger("help.selftest")
    (dialog,) = opened
    qtbot.waitUntil(lambda: dialog._process.state() == QProcess.ProcessState.Running, timeout=60_000)
    dialog.reject()
    assert dialog._process.state() == QProcess.ProcessState.NotRunning
