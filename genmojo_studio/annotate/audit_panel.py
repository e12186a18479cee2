"""The audit log as a table: who did what to which point and when, before and after; filters, its chain, its export."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import Any

from PySide6.QtCore import QAbstractTableModel, QModelIndex, QPersistentModelIndex, QSortFilterProxyModel, Qt, Signal
from PySide6.QtGui import QFont, QPalette
from PySide6.QtWidgets import (
    QAbstractItemView,
    QApplication,
    QCheckBox,
    QComboBox,
    QFileDialog,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QPushButton,
    QTableView,
    QVBoxLayout,
    QWidget,
)

from genmojo_core.store import audit, project_file
from genmojo_core.store.edit_words import Point
from genmojo_core.store.project_file import Chain
from genmojo_core.store.project_log import Row
from genmojo_studio import notify
from genmojo_studio.annotate.session import Session
from genmojo_studio.background import Tasks
from genmojo_studio.translate import told, tr

_Index = QModelIndex | QPersistentModelIndex
_POINTS = 3  # of an edit's points that a cell names
_WIDTHS = (176, 90, 200, 104, 110, 84, 150, 220, 50)  # px of the columns
_WHAT = 2


class LogModel(QAbstractTableModel):
    """Lines of the log, newest first."""

    def __init__(self, entries: list[audit.Entry], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.entries = entries[::-1]
        self._titles = [tr("when (local time)"), tr("who"), tr("what"), tr("in effect"), tr("point"), tr("frames"),
                        tr("before"), tr("after"), tr("version")]  # fmt: skip
        self._struck = QFont()
        self._struck.setStrikeOut(True)

    def rowCount(self, parent: _Index = QModelIndex()) -> int:  # noqa: B008
        """Lines."""
        return 0 if parent.isValid() else len(self.entries)

    def columnCount(self, parent: _Index = QModelIndex()) -> int:  # noqa: B008
        """Columns."""
        return 0 if parent.isValid() else len(self._titles)

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """What the columns are."""
        if orientation == Qt.Orientation.Horizontal and role == Qt.ItemDataRole.DisplayRole:
            return self._titles[section]
        return None

    def data(self, index: _Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """A cell: its text, which is its tooltip too; what was undone is struck and dim."""
        entry = self.entries[index.row()]
        if role in (Qt.ItemDataRole.DisplayRole, Qt.ItemDataRole.ToolTipRole):
            return cells(entry)[index.column()]
        if role == Qt.ItemDataRole.FontRole and not entry.stands and index.column() == _WHAT:
            return self._struck
        if role == Qt.ItemDataRole.ForegroundRole and not entry.stands:
            return QApplication.palette().brush(QPalette.ColorRole.PlaceholderText)
        return None


class _Filter(QSortFilterProxyModel):
    """Lines of one track, of one person, of what stands only."""

    def __init__(self, entries: list[audit.Entry], parent: QWidget) -> None:
        super().__init__(parent)
        self._entries = entries[::-1]
        self.track: int | None = None
        self.person: str | None = None
        self.standing = False

    def filterAcceptsRow(self, row: int, _parent: _Index) -> bool:
        """Whether a line is shown."""
        entry = self._entries[row]
        return ((self.track is None or entry.touches(self.track))
                and (self.person is None or entry.row.who == self.person)
                and (not self.standing or (entry.stands and entry.row.verb == "do")))  # fmt: skip


class AuditPanel(QWidget):
    """The log of one project, read in the background; `model` is None until it is there."""

    ready = Signal(object)  # list of audit.Entry

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session, self.tasks = session, Tasks()
        self.model: LogModel | None = None
        self._rows: _Filter | None = None
        self.track, self.person = QComboBox(), QComboBox()
        self.track.setAccessibleName(tr("Lines of which point"))
        self.person.setAccessibleName(tr("Lines of which person"))
        self.standing = QCheckBox(tr("Only what stands"))
        self.standing.setToolTip(tr("Leaves out edits that were undone, undoing itself and named moments."))
        self.count, self.chain = QLabel(tr("Reading the log …")), QLabel(wordWrap=True)
        self.table = QTableView()
        self.table.setAccessibleName(tr("Audit log"))
        self.check_button, self.export_button = QPushButton(tr("Check the chain")), QPushButton(tr("Export the log…"))
        self.check_button.setToolTip(tr("Every line carries a hash of itself and the line before: nothing can be "
                                        "changed, added or taken out afterwards without being seen."))  # fmt: skip
        self._arrange()
        session.project.wait()
        self.tasks.run(partial(audit.entries, session.project.path), self._read, self._failed)

    def close_tasks(self) -> None:
        """Nobody waits for the log any more."""
        self.tasks.close()

    def check(self) -> None:
        """Whether the chain of hashes is whole, told in words."""
        self.chain.setText(tr("Checking …"))
        self._session.project.wait()
        self.tasks.run(partial(project_file.check_chain, self._session.project.path), self._checked, self._failed)

    def export(self) -> None:
        """The whole log as CSV or JSON."""
        ask_export(self._session, self.tasks, self)

    def _read(self, entries: list[audit.Entry]) -> None:
        self.model, self._rows = LogModel(entries, self), _Filter(entries, self)
        self._rows.setSourceModel(self.model)
        self.table.setModel(self._rows)
        for column, width in enumerate(_WIDTHS):
            self.table.setColumnWidth(column, width)
        self.track.addItem(tr("all points"), None)
        points = {p.track: _title(p) for e in entries for p in e.words.points if p.track is not None}
        for track, title in sorted(points.items(), key=lambda one: one[1]):
            self.track.addItem(title, track)
        self.person.addItem(tr("everybody"), None)
        for name in sorted({e.row.who for e in entries}):
            self.person.addItem(name or tr("nobody named"), name)
        self.track.currentIndexChanged.connect(self._filter)
        self.person.currentIndexChanged.connect(self._filter)
        self.standing.toggled.connect(self._filter)
        self._filter()
        self.ready.emit(entries)

    def _filter(self) -> None:
        if self._rows is None or self.model is None:
            return
        self._rows.track, self._rows.person = self.track.currentData(), self.person.currentData()
        self._rows.standing = self.standing.isChecked()
        self._rows.invalidate()
        self.count.setText(tr("{n} of {all} lines").format(n=self._rows.rowCount(), all=self.model.rowCount()))

    def _checked(self, chain: Chain) -> None:
        self.chain.setText(chain_words(chain, len(self._session.project.log)))

    def _failed(self, error: BaseException) -> None:
        self.count.setText("")
        self.chain.setText("")
        notify.tell(error, self)

    def _arrange(self) -> None:
        self.check_button.clicked.connect(self.check)
        self.export_button.clicked.connect(self.export)
        self.table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.table.setTabKeyNavigation(False)
        self.table.setWordWrap(False)
        self.table.verticalHeader().hide()
        self.table.verticalHeader().setDefaultSectionSize(self.fontMetrics().height() + 8)
        header = self.table.horizontalHeader()
        header.setSectionResizeMode(QHeaderView.ResizeMode.Interactive)
        header.setStretchLastSection(True)
        filters, below, column = QHBoxLayout(), QHBoxLayout(), QVBoxLayout(self)
        for widget in (self.track, self.person, self.standing):
            filters.addWidget(widget)
        filters.addStretch(1)
        filters.addWidget(self.count)
        below.addWidget(self.check_button)
        below.addWidget(self.chain, 1)
        below.addWidget(self.export_button)
        column.addLayout(filters)
        column.addWidget(self.table, 1)
        column.addLayout(below)


def ask_export(session: Session, tasks: Tasks, parent: QWidget) -> None:
    """Where to write the log of a project, as CSV or JSON; it is written in the background."""
    kinds = {"CSV (*.csv)": ".csv", "JSON (*.json)": ".json"}
    start = f"{Path(session.project.info.name).stem}-log.csv"
    name, kind = QFileDialog.getSaveFileName(parent, tr("Export the log"), start, ";;".join(kinds))
    if not name:
        return
    path = Path(name) if Path(name).suffix.lower() in kinds.values() else Path(name + kinds.get(kind, ".csv"))
    project, consent = session.project, session.annotation.meta.get("consent", "")
    project.wait()

    def work() -> None:
        audit.write(audit.entries(project.path), path, project.info.name, consent)

    tasks.run(work, lambda _none: session.said.emit(tr("Saved: {name}").format(name=path.name)),
              lambda error: notify.tell(error, parent))  # fmt: skip


def chain_words(chain: Chain, known: int) -> str:
    """What checking the chain found; `known`: lines that the open project has."""
    if chain.missing:
        return tr("{n} lines are missing, the first is number {first}: this history is not whole.").format(
            n=len(chain.missing), first=chain.missing[0])  # fmt: skip
    if chain.broken:
        row = chain.broken[0]
        return tr("{n} of {all} lines were changed after they were made. The first: number {first}, “{title}”, "
                  "{when}.").format(n=len(chain.broken), all=chain.entries, first=row.seq, title=told(row.title),
                                    when=audit.local(row.at))  # fmt: skip
    if chain.states:
        return tr("All {n} lines are whole, but the state kept after number {first} is not what they lead to: it was "
                  "changed afterwards.").format(n=chain.entries, first=chain.states[0])  # fmt: skip
    if chain.entries < known:
        return tr("{n} of {all} lines are on the disk and whole; the rest is not written yet.").format(
            n=chain.entries, all=known)  # fmt: skip
    return tr("The chain is whole: none of {n} lines was changed, added or taken out afterwards.").format(
        n=chain.entries)  # fmt: skip


def cells(entry: audit.Entry) -> list[str]:
    """A line of the log as a person reads it, by columns."""
    row, words = entry.row, entry.words
    stands = "" if row.verb != "do" else tr("yes") if entry.stands else tr("undone")
    points = ", ".join(_title(p) for p in words.points[:_POINTS])
    if len(words.points) > _POINTS:
        points = tr("{points} and {n} more").format(points=points, n=len(words.points) - _POINTS)
    if words.first is None:
        frames = ""
    elif words.first == words.last:
        frames = str(words.first)
    else:
        frames = tr("{first} to {last} ({n})").format(first=words.first, last=words.last, n=words.frames)
    before, after = (", ".join(map(told, side)) for side in (words.before, words.after))
    return [audit.local(row.at), row.who, done(row), stands, points, frames, before, after, row.version]


def _title(point: Point) -> str:
    """What a person calls a point of the log."""
    return point.title(tr("object {n}").format(n=point.owner))


def done(row: Row) -> str:
    """What a row of the log did, in the person's language."""
    if row.verb == "checkpoint":
        return tr("Named: {name}").format(name=row.title)
    sentence = {"undo": tr("Undone: {title}"), "redo": tr("Done again: {title}")} if row.verb == "move" else {}
    return sentence.get(row.kind, "{title}").format(title=told(row.title))
