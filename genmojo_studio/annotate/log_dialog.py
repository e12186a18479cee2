"""The audit log, the clip's figures, and the time sheet: shown to whoever works here, exported only with consent."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtWidgets import (
    QAbstractItemView,
    QDialog,
    QDialogButtonBox,
    QFileDialog,
    QHeaderView,
    QLabel,
    QTableWidget,
    QTableWidgetItem,
    QTabWidget,
    QVBoxLayout,
    QWidget,
)

from genmojo_core.errors import GenmojoError
from genmojo_core.store.atomic import write_bytes
from genmojo_studio import notify
from genmojo_studio.annotate import statistics
from genmojo_studio.annotate.session import Session
from genmojo_studio.translate import tr

_MOST = 2000  # rows of the log that are shown; all are exported


class LogDialog(QDialog):
    """Three tables and one export."""

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self.setWindowTitle(tr("Log and statistics"))
        self.resize(760, 560)
        rows = session.project.log.rows
        self.tabs = QTabWidget()
        self.tabs.setDocumentMode(True)
        figures = statistics.figures(session.annotation, session.stride)
        self.tabs.addTab(_table([tr("figure"), tr("value")], [[tr(a), b] for a, b in figures]), tr("Clip"))
        sheets = [[s.person, str(s.edits), str(s.keys), f"{s.seconds / 60:.1f}", str(s.returned)]
                  for s in statistics.sheets(rows, session.annotation)]  # fmt: skip
        titles = [tr("person"), tr("edits"), tr("keys"), tr("minutes"), tr("sent back")]
        self.tabs.addTab(_table(titles, sheets), tr("Time sheet"))
        shown = [[str(r.seq), r.title, r.who, r.at.replace("T", " ")[:19], "" if r.frame is None else str(r.frame)]
                 for r in rows[-_MOST:][::-1]]  # fmt: skip
        self.tabs.addTab(_table(["#", tr("what"), tr("who"), tr("when"), tr("frame")], shown), tr("Audit log"))
        consent = session.annotation.meta.get("consent") == "yes"
        text = tr("Names and times are exported: consent is given.") if consent else tr(
            "Names and times stay out of the export: no consent is given (step 4).")  # fmt: skip
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
        self.export = buttons.addButton(tr("Export the log…"), QDialogButtonBox.ButtonRole.ActionRole)
        self.export.clicked.connect(self._export)
        buttons.rejected.connect(self.reject)
        column = QVBoxLayout(self)
        column.addWidget(self.tabs)
        column.addWidget(QLabel(text, wordWrap=True))
        column.addWidget(buttons)

    def _export(self) -> None:
        name, _ = QFileDialog.getSaveFileName(self, tr("Export the log"), "log.csv", "CSV (*.csv)")
        if not name:
            return
        consent = self._session.annotation.meta.get("consent") == "yes"
        try:
            text = statistics.log_csv(self._session.project.log.rows, with_effort=consent)
            write_bytes(Path(name), text.encode())
        except GenmojoError as error:
            notify.tell(error, self)


def _table(titles: list[str], rows: list[list[str]]) -> QTableWidget:
    table = QTableWidget(len(rows), len(titles))
    table.setHorizontalHeaderLabels(titles)
    table.verticalHeader().hide()
    table.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
    table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
    table.setTabKeyNavigation(False)
    for y, row in enumerate(rows):
        for x, text in enumerate(row):
            table.setItem(y, x, QTableWidgetItem(text))
    table.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
    table.horizontalHeader().setSectionResizeMode(1 if len(titles) > 2 else 0, QHeaderView.ResizeMode.Stretch)
    return table
