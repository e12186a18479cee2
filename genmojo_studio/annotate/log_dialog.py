"""Figures of the clip and its people, the time sheet, the audit log: shown here, exported only with consent."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import Qt
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
from genmojo_core.store import audit, time_sheet, work_figures
from genmojo_core.store.work_figures import Figures
from genmojo_core.tracks.statistics import clip_figures
from genmojo_studio import notify
from genmojo_studio.annotate.audit_panel import AuditPanel
from genmojo_studio.annotate.session import Session
from genmojo_studio.annotate.track_tree import review_name
from genmojo_studio.translate import decimal, mark, told, tr

_NOTE = mark(
    "Seconds at work come from the log; a pause counts as one minute at most. A key belongs to whoever placed or moved "
    "it last. What is left and its time are for the stride set above the frame."
)


class LogDialog(QDialog):
    """Three tables and their exports. The tables are filled when the log has been read."""

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._rows: list[Figures] = []
        self._entries: list[audit.Entry] = []
        self.setWindowTitle(tr("Log and statistics"))
        room = self.screen().availableSize()
        self.resize(min(1240, room.width() - 60), min(640, room.height() - 80))
        self.tabs = QTabWidget()
        self.tabs.setDocumentMode(True)
        self.figures, self.sheet, self.audit = _table(), _table(), AuditPanel(session)
        self.figures.setAccessibleName(tr("Figures of the clip and its people"))
        self.sheet.setAccessibleName(tr("Time sheet"))
        self.finished.connect(self.audit.close_tasks)
        self.tabs.addTab(_with_note(self.figures, tr(_NOTE)), tr("Clip and people"))
        self.tabs.addTab(self.sheet, tr("Time sheet"))
        self.tabs.addTab(self.audit, tr("Audit log"))
        self.audit.ready.connect(self._read)
        consent = session.annotation.meta.get("consent") == "yes"
        text = tr("Names and times may be exported: consent is given.") if consent else tr(
            "Names and times are not exported: no consent is given (step 4).")  # fmt: skip
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
        self.export_figures = buttons.addButton(tr("Export the figures…"), QDialogButtonBox.ButtonRole.ActionRole)
        self.export_sheet = buttons.addButton(tr("Export the time sheet…"), QDialogButtonBox.ButtonRole.ActionRole)
        self.export_copy = buttons.addButton(tr("Export without names…"), QDialogButtonBox.ButtonRole.ActionRole)
        self.export_sheet.setEnabled(False)
        self.export_figures.setEnabled(False)
        self.export_figures.clicked.connect(self._export_figures)
        self.export_sheet.clicked.connect(self._export_sheet)
        self.export_copy.clicked.connect(self._export_copy)
        buttons.rejected.connect(self.reject)
        column = QVBoxLayout(self)
        column.addWidget(self.tabs)
        column.addWidget(QLabel(text, wordWrap=True))
        column.addWidget(buttons)

    def _read(self, entries: list[audit.Entry]) -> None:
        """The log is there: the figures can be counted."""
        session = self._session
        self._entries, clip = entries, session.project.info.name
        self._rows = work_figures.figures(session.annotation, entries, clip, session.stride)
        people = [row.person or tr("nobody named") for row in self._rows[1:]]
        _fill(self.figures, [tr("figure"), tr("whole clip"), *people], _by_figure(self._rows) + _of_clip(session))
        days = time_sheet.time_sheet([e.row for e in entries], keys=work_figures.placed_keys(entries))
        titles = [
            tr("clip"),
            tr("person"),
            tr("day"),
            tr("minutes"),
            tr("edits"),
            tr("keys"),
            tr("undone"),
            tr("tracks"),
        ]
        _fill(self.sheet, titles, [[clip, d.person, d.day, decimal(d.seconds / 60, ".1f"), str(d.edits), str(d.keys),
                                    str(d.undone), str(d.tracks)] for d in days])  # fmt: skip
        self.export_figures.setEnabled(True)
        self.export_sheet.setEnabled(session.annotation.meta.get("consent") == "yes")

    def _export_figures(self) -> None:
        consent = self._session.annotation.meta.get("consent", "")
        name, _ = QFileDialog.getSaveFileName(self, tr("Export the figures"), "figures.csv", "CSV (*.csv)")
        if name:
            self._try(lambda: work_figures.write(self._rows, _csv(name), consent))

    def _export_sheet(self) -> None:
        name, _ = QFileDialog.getSaveFileName(self, tr("Export the time sheet"), "time.csv", "CSV (*.csv)")
        consent = self._session.annotation.meta.get("consent", "")
        if name:
            rows, placed = [e.row for e in self._entries], work_figures.placed_keys(self._entries)
            clip = self._session.project.info.name
            self._try(lambda: time_sheet.write_time_sheet(rows, consent, _csv(name), clip, placed))

    def _export_copy(self) -> None:
        """A copy of the project in which nobody is named."""
        name, _ = QFileDialog.getSaveFileName(self, tr("Export without names"), "copy.genmojo", "GenMOJO (*.genmojo)")
        if name:
            self._session.project.wait()
            target = Path(name) if name.endswith(".genmojo") else Path(f"{name}.genmojo")
            self._try(lambda: time_sheet.without_people(self._session.project.path, target))

    def _try(self, work: Callable[[], object]) -> None:
        try:
            work()
        except GenmojoError as error:
            notify.tell(error, self)


def _csv(name: str) -> Path:
    """A chosen name, with its ending."""
    return Path(name) if Path(name).suffix else Path(f"{name}.csv")


def duration(seconds: float) -> str:
    """A time as a person says it."""
    if seconds < 90:
        return tr("{n} s").format(n=round(seconds))
    if seconds < 5400:
        return tr("{n:.1f} min").format(n=seconds / 60)
    return tr("{n:.1f} h").format(n=seconds / 3600)


def _by_figure(rows: list[Figures]) -> list[list[str]]:
    """One line per figure, one column per row; what is not known says why."""

    def line(title: str, name: str, form: Callable[[float], str]) -> list[str]:
        cells = []
        for row in rows:
            value, why = getattr(row, name), row.unknown.get(name, "")
            cells.append(form(value) if value is not None else told(why) if why else "–")
        return [title, *cells]

    def share(value: float) -> str:
        return decimal(value, ".1%")

    return [
        line(tr("time at work"), "seconds", duration), line(tr("tracks"), "tracks", str), line(tr("keys"), "keys", str),
        line(tr("keys per track (mean)"), "keys_per_track", lambda v: decimal(v, ".1f")),
        line(tr("time per track"), "seconds_per_track", duration),
        line(tr("places looked at"), "confirmed", str), line(tr("share looked at"), "confirmed_share", share),
        line(tr("visible"), "visible", share), line(tr("occluded"), "occluded", share),
        line(tr("out of view"), "out_of_view", share), line(tr("uncertain"), "uncertain", share),
        line(tr("tracks sent back"), "returned", str),
        line(tr("share of reviewed tracks sent back"), "reopened", share),
        line(tr("places still to look at"), "left", str), line(tr("time for what is left"), "eta_seconds", duration),
    ]  # fmt: skip


def _of_clip(session: Session) -> list[list[str]]:
    """What only the whole clip has."""
    f = clip_figures(session.annotation)
    rows = [[tr("objects"), str(f["objects"])],
            [tr("motion at 256 x 256"), f"{decimal(f['motion'], '.2f')} px"]]  # fmt: skip
    return rows + [[review_name(name), str(count)] for name, count in f["reviews"].items()]


def _with_note(table: QTableWidget, text: str) -> QWidget:
    """A table with a sentence below it."""
    made, note = QWidget(), QLabel(text, wordWrap=True)
    note.setProperty("role", "dim")
    column = QVBoxLayout(made)
    column.addWidget(table, 1)
    column.addWidget(note)
    return made


def _table() -> QTableWidget:
    """An empty table to be read, not edited."""
    table = QTableWidget(1, 1)
    table.setHorizontalHeaderLabels([""])
    table.setItem(0, 0, QTableWidgetItem(tr("Reading the log …")))
    table.verticalHeader().hide()
    table.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
    table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
    table.setTabKeyNavigation(False)
    table.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
    table.horizontalHeader().setDefaultAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
    table.horizontalHeader().setStretchLastSection(True)
    return table


def _fill(table: QTableWidget, titles: list[str], rows: list[list[str]]) -> None:
    table.setRowCount(len(rows))
    table.setColumnCount(len(titles))
    table.setHorizontalHeaderLabels(titles)
    for y, row in enumerate(rows):
        for x in range(len(titles)):
            table.setItem(y, x, QTableWidgetItem(row[x] if x < len(row) else ""))
