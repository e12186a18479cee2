"""The audit log, the clip's figures, and the time sheet: shown to whoever works here, exported only with consent."""

from __future__ import annotations

from collections.abc import Callable
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
from genmojo_core.store import time_sheet
from genmojo_core.tracks.statistics import clip_figures
from genmojo_studio import notify
from genmojo_studio.annotate.audit_panel import AuditPanel
from genmojo_studio.annotate.session import Session
from genmojo_studio.annotate.track_tree import review_name
from genmojo_studio.translate import decimal, tr


class LogDialog(QDialog):
    """Three tables and one export."""

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self.setWindowTitle(tr("Log and statistics"))
        room = self.screen().availableSize()
        self.resize(min(1240, room.width() - 60), min(640, room.height() - 80))
        rows = session.project.log.rows
        self.tabs = QTabWidget()
        self.tabs.setDocumentMode(True)
        self.tabs.addTab(_table([tr("figure"), tr("value")], _figures(session)), tr("Clip"))
        sheets = [[d.person, d.day, decimal(d.seconds / 60, ".1f"), str(d.edits), str(d.keys), str(d.undone)]
                  for d in time_sheet.time_sheet(rows)]  # fmt: skip
        titles = [tr("person"), tr("day"), tr("minutes"), tr("edits"), tr("keys"), tr("undone")]
        self.tabs.addTab(_table(titles, sheets), tr("Time sheet"))
        self.audit = AuditPanel(session)
        self.finished.connect(self.audit.close_tasks)
        self.tabs.addTab(self.audit, tr("Audit log"))
        consent = session.annotation.meta.get("consent") == "yes"
        text = tr("Names and times may be exported: consent is given.") if consent else tr(
            "Names and times are not exported: no consent is given (step 4).")  # fmt: skip
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
        self.export_sheet = buttons.addButton(tr("Export the time sheet…"), QDialogButtonBox.ButtonRole.ActionRole)
        self.export_copy = buttons.addButton(tr("Export without names…"), QDialogButtonBox.ButtonRole.ActionRole)
        self.export_sheet.setEnabled(consent)
        self.export_sheet.clicked.connect(self._export_sheet)
        self.export_copy.clicked.connect(self._export_copy)
        buttons.rejected.connect(self.reject)
        column = QVBoxLayout(self)
        column.addWidget(self.tabs)
        column.addWidget(QLabel(text, wordWrap=True))
        column.addWidget(buttons)

    def _export_sheet(self) -> None:
        name, _ = QFileDialog.getSaveFileName(self, tr("Export the time sheet"), "time.csv", "CSV (*.csv)")
        consent = self._session.annotation.meta.get("consent", "")
        if name:
            self._try(lambda: time_sheet.write_time_sheet(self._session.project.log.rows, consent, Path(name)))

    def _export_copy(self) -> None:
        """A copy of the project in which nobody is named."""
        name, _ = QFileDialog.getSaveFileName(self, tr("Export without names"), "copy.genmojo", "GenMOJO (*.genmojo)")
        if name:
            self._session.project.wait()
            self._try(lambda: time_sheet.without_people(self._session.project.path, Path(name)))

    def _try(self, work: Callable[[], object]) -> None:
        try:
            work()
        except GenmojoError as error:
            notify.tell(error, self)


def _figures(session: Session) -> list[list[str]]:
    """Figures of the whole clip as rows of title and value."""
    f = clip_figures(session.annotation)
    shares = (
        (tr("annotated"), "annotated"), (tr("accepted by a person"), "confirmed"), (tr("visible"), "visible"),
        (tr("occluded"), "occluded"), (tr("out of view"), "out_of_view"), (tr("uncertain"), "uncertain"),
    )  # fmt: skip
    rows = [[tr("objects"), str(f["objects"])], [tr("tracks"), str(f["tracks"])],
            [tr("keys per track (mean)"), decimal(f.get("keys", 0.0), ".1f")]]  # fmt: skip
    rows += [[title, decimal(f[name], ".1%")] for title, name in shares if name in f]
    rows += [
        [tr("motion at 256 x 256"), f"{decimal(f['motion'], '.2f')} px"],
        [tr("tracks sent back"), f"{f['reopened']:.0%}"],
    ]
    return rows + [[review_name(name), str(count)] for name, count in f["reviews"].items()]


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
