"""The history as a tree: who did what and when, where we are, what was undone or branched off; go to any of it."""

from __future__ import annotations

from PySide6.QtCore import Qt, QTimer
from PySide6.QtGui import QFont, QPalette
from PySide6.QtWidgets import (
    QCheckBox,
    QDialog,
    QDialogButtonBox,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QTreeWidget,
    QTreeWidgetItem,
    QVBoxLayout,
    QWidget,
)

from genmojo_core.store import audit
from genmojo_core.store.history_tree import History, State
from genmojo_core.store.project_log import ROOT
from genmojo_studio.annotate.session import Session
from genmojo_studio.translate import told, tr

_SEQ = Qt.ItemDataRole.UserRole
_MOST = 300  # deeds listed at first, and more with each “Show earlier”
_WIDTHS = (330, 150, 100, 170, 150)


class HistoryDialog(QDialog):
    """Newest on top; branches hang below the state they leave. It follows the session until that closes."""

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session, self._most = session, _MOST
        self._history = History(session.project.log)
        self.setWindowTitle(tr("History"))
        self.resize(1000, 620)
        self.line = QLineEdit(placeholderText=tr("Search"), clearButtonEnabled=True)
        self.named = QCheckBox(tr("Named moments only"))
        self.list = QTreeWidget()
        self.list.setHeaderLabels([tr("Deed"), tr("Name"), tr("Who"), tr("When"), tr("Point"), tr("Frame")])
        self.list.setAccessibleName(tr("States of the history"))
        self.list.setUniformRowHeights(True)
        self.list.setAlternatingRowColors(True)
        for column, width in enumerate(_WIDTHS):
            self.list.setColumnWidth(column, width)
        self.note = QLabel(wordWrap=True)
        self.note.setProperty("role", "dim")
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
        action = QDialogButtonBox.ButtonRole.ActionRole
        self.go_button = buttons.addButton(tr("Go to this state"), action)
        self.back_button = buttons.addButton(tr("Back to before the jump"), action)
        self.more_button = buttons.addButton(tr("Show earlier"), action)
        buttons.rejected.connect(self.reject)
        top, column_ = QHBoxLayout(), QVBoxLayout(self)
        top.addWidget(self.line, 1)
        top.addWidget(self.named)
        column_.addLayout(top)
        for widget in (self.list, self.note, buttons):
            column_.addWidget(widget)
        self._later = QTimer(self, singleShot=True, interval=150)
        self._connect()
        self.refresh()

    def _connect(self) -> None:
        self.line.textChanged.connect(self._filter)
        self.named.toggled.connect(self._filter)
        self.list.currentItemChanged.connect(self._allow)
        self.list.itemActivated.connect(self.go)
        self.go_button.clicked.connect(self.go)
        self.back_button.clicked.connect(self.go_back)
        self.more_button.clicked.connect(self.show_more)
        self._later.timeout.connect(self.refresh)
        for changed in (self._session.edited, self._session.stored):
            changed.connect(self._later.start)
        self._session.destroyed.connect(self.close)

    def refresh(self) -> None:
        """Show the history as it stands; what is marked stays marked."""
        marked, open_ = self.marked(), self._open_branches()
        if marked == self._history.head:
            marked = None  # whoever looks at where we are goes along
        self._history = history = History(self._session.project.log)
        self.list.clear()
        line = history.line(ROOT)
        shown = line[-self._most :]
        self._add(None, shown, open_)
        self.more_button.setVisible(len(line) > len(shown))
        self.back_button.setEnabled(history.before_jump not in (None, history.head) and not self._read_only())
        self._filter()
        self._mark(marked if marked in history.states else history.head)
        free = tr("Nothing is lost by going elsewhere: what is undone stays here, and the way back is listed too.")
        self.note.setText(tr("Read only: another program has this project open.") if self._read_only() else free)
        self._allow()

    def marked(self) -> int | None:
        """The state that is marked, None if there is none."""
        item = self.list.currentItem()
        return None if item is None else item.data(0, _SEQ)

    def choose(self, seq: int) -> None:
        """Mark a state."""
        self._mark(seq)

    def go(self) -> None:
        """To the state that is marked."""
        seq = self.marked()
        if seq is not None and seq != self._history.head and not self._read_only():
            self._session.go_to(seq)
            self.refresh()

    def go_back(self) -> None:
        """To where the last jump came from."""
        if self._history.before_jump is not None and not self._read_only():
            self._session.go_to(self._history.before_jump)
            self.refresh()

    def show_more(self) -> None:
        """List earlier deeds too."""
        self._most += 4 * _MOST
        self.refresh()

    def _read_only(self) -> bool:
        return self._session.project.read_only

    def _add(self, parent: QTreeWidgetItem | None, line: list[int], open_: set[int]) -> None:
        """A line of states below an item, newest first, each with the branches that leave it."""
        waiting = [(parent, line)]
        while waiting:
            above, states = waiting.pop()
            for seq in reversed(states):
                item = self._item(self._history.states[seq])
                self.list.addTopLevelItem(item) if above is None else above.addChild(item)
                for first in self._history.branches(seq, set(states)):
                    branch = self._history.line(first, branch=True)[: self._most]
                    head = QTreeWidgetItem([tr("Another branch: {n} deeds").format(n=len(branch)), "", "", "", "", ""])
                    head.setData(0, _SEQ + 1, first)
                    item.addChild(head)
                    item.setExpanded(True)
                    head.setExpanded(first in open_)
                    waiting.append((head, branch))

    def _item(self, state: State) -> QTreeWidgetItem:
        row, here = state.row, state.seq == self._history.head
        title = tr("The beginning") if row is None else told(row.title)
        texts = [f"▶ {title}" if here else title, ", ".join(state.names)]
        if row is not None:
            info = self._session.annotation.tracks.get(row.track or 0)
            point = "" if info is None else self._session.title(info.object, info.number)
            texts += [row.who, audit.local(row.at)[:19], point, "" if row.frame is None else str(row.frame)]
        item = QTreeWidgetItem(texts)
        item.setData(0, _SEQ, state.seq)
        font = QFont()
        font.setBold(here)
        for column, text in enumerate(texts):
            item.setFont(column, font)
            item.setToolTip(column, text)
            if state.ahead:
                item.setForeground(column, self.palette().brush(QPalette.ColorRole.PlaceholderText))
        said = tr("Here you are") if here else tr("Undone") if state.ahead else tr("In effect")
        item.setToolTip(0, f"{said}: {title}")
        return item

    def _items(self) -> list[QTreeWidgetItem]:
        """All items, parents before children."""
        found = _inside(self.list.invisibleRootItem())
        for item in found:  # grows as it goes
            found += _inside(item)
        return found

    def _open_branches(self) -> set[int]:
        return {item.data(0, _SEQ + 1) for item in self._items() if item.isExpanded()} - {None}

    def _mark(self, seq: int | None) -> None:
        for item in self._items():
            if item.data(0, _SEQ) == seq and seq is not None:
                self.list.setCurrentItem(item)
                self.list.scrollToItem(item)
                return

    def _filter(self) -> None:
        """What holds the text, or has a name; and what leads there."""
        text, named = self.line.text().casefold(), self.named.isChecked()
        for item in reversed(self._items()):
            words = " ".join(item.text(column) for column in range(6)).casefold()
            hit = item.data(0, _SEQ) is not None and text in words and (bool(item.text(1)) or not named)
            inside = _inside(item)
            item.setHidden(not hit and all(child.isHidden() for child in inside))
            if (text or named) and inside and not item.isHidden():
                item.setExpanded(True)

    def _allow(self) -> None:
        marked = self.marked()
        self.go_button.setEnabled(marked is not None and marked != self._history.head and not self._read_only())


def _inside(item: QTreeWidgetItem) -> list[QTreeWidgetItem]:
    found = (item.child(row) for row in range(item.childCount()))
    return [child for child in found if child is not None]
