"""Help › Try hard cases: `genmojo selftest --hard` in a process of its own, its verdicts as a table."""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Mapping, Sequence
from typing import Any

from PySide6.QtCore import QProcess, Signal
from PySide6.QtGui import QColor
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QHeaderView,
    QLabel,
    QProgressBar,
    QTreeWidget,
    QTreeWidgetItem,
    QVBoxLayout,
    QWidget,
)

from genmojo_studio.translate import decimal, tr

_BROKEN = QColor(220, 70, 60)
_PERCENT = re.compile(r"(\d+)%")


class SelftestDialog(QDialog):
    """Runs as soon as it is made; closing it ends the run.

    Args:
        rows: only these rows of the study, all without any.

    Signals: `ended` once the table is filled or nothing came.
    """

    ended = Signal()

    def __init__(self, parent: QWidget | None = None, rows: Sequence[str] = ()) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Hard cases on this machine"))
        self.resize(900, 620)
        self.said = QLabel(tr("Some minutes: hostile splats, masks, depths and numbers that go bad."))
        self.said.setWordWrap(True)
        self.bar = QProgressBar()
        self.table = QTreeWidget()
        self.table.setHeaderLabels([tr("Row"), tr("Case"), tr("What happened"), tr("Verdict"), tr("Seconds")])
        self.table.setRootIsDecorated(False)
        self.table.header().setSectionResizeMode(2, QHeaderView.ResizeMode.Stretch)
        self.table.header().setStretchLastSection(False)
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
        buttons.rejected.connect(self.reject)
        layout = QVBoxLayout(self)
        for part in (self.said, self.bar, self.table, buttons):
            layout.addWidget(part)
        self._process = QProcess(self)
        self._process.readyReadStandardError.connect(self._progress)
        self._process.finished.connect(self._finished)
        arguments = ["-m", "genmojo_core.cli.main", "selftest", "--hard", "--json"]
        self._process.start(sys.executable, arguments + (["--rows", ",".join(rows)] if rows else []))

    def done(self, result: int) -> None:
        """Ends a run that goes on, then closes."""
        if self._process.state() != QProcess.ProcessState.NotRunning:
            self._process.finished.disconnect(self._finished)
            self._process.kill()
            self._process.waitForFinished(5000)
        super().done(result)

    def _progress(self) -> None:
        found = _PERCENT.findall(bytes(self._process.readAllStandardError().data()).decode(errors="replace"))
        if found:
            self.bar.setValue(int(found[-1]))

    def _finished(self) -> None:
        self.bar.setValue(100)
        text = bytes(self._process.readAllStandardOutput().data()).decode(errors="replace").strip()
        if not text:
            self.said.setText(tr("The self-test ended without a result."))
        else:
            self._show(json.loads(text))
        self.ended.emit()

    def _show(self, told: Mapping[str, Any]) -> None:
        for one in told["verdicts"]:
            verdict = tr("holds") if one["holds"] else tr("broken")
            happened = " ".join(str(one["happened"]).split())
            item = QTreeWidgetItem([one["row"], one["name"], happened, verdict, decimal(one["seconds"], ".1f")])
            item.setToolTip(2, happened)
            if not one["holds"]:
                item.setForeground(3, _BROKEN)
            self.table.addTopLevelItem(item)
        for column in (0, 1, 3, 4):
            self.table.resizeColumnToContents(column)
        self.said.setText(tr("{cases} cases, {failed} broken, {seconds:.0f} s.").format(**told))
