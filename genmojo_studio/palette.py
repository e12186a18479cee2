"""The command palette: type a few letters of what you want to do."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QKeyEvent, QKeySequence
from PySide6.QtWidgets import QDialog, QLineEdit, QTreeWidget, QTreeWidgetItem, QVBoxLayout, QWidget

from genmojo_studio.actions import Action, ActionTable
from genmojo_studio.translate import tr


class Palette(QDialog):
    """A line and a list; Enter does what is marked. `chosen` is the id of what was done, "" if nothing."""

    def __init__(self, table: ActionTable, workspace: str, parent: QWidget | None = None) -> None:
        super().__init__(parent, Qt.WindowType.Popup | Qt.WindowType.FramelessWindowHint)
        self._table = table
        self._actions = [action for action in table.available(workspace) if action.id != "help.palette"]
        self.chosen = ""
        self.line = QLineEdit(placeholderText=tr("What do you want to do?"))
        self.list = QTreeWidget()
        self.list.setColumnCount(3)
        self.list.setHeaderHidden(True)
        self.list.setRootIsDecorated(False)
        self.list.setUniformRowHeights(True)
        self.list.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(8, 8, 8, 8)
        layout.addWidget(self.line)
        layout.addWidget(self.list)
        self.resize(620, 420)
        self.line.textChanged.connect(self._filter)
        self.list.itemActivated.connect(self._accept_item)
        self.list.itemClicked.connect(self._accept_item)
        self.line.installEventFilter(self)
        self._filter("")
        self.line.setFocus()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Arrow keys and Enter act on the list while the line has the focus."""
        if isinstance(event, QKeyEvent) and event.type() == QEvent.Type.KeyPress:
            step = {Qt.Key.Key_Down: 1, Qt.Key.Key_Up: -1, Qt.Key.Key_PageDown: 8, Qt.Key.Key_PageUp: -8}
            if event.key() in step and self.list.topLevelItemCount():
                self._mark(self.list.currentIndex().row() + step[Qt.Key(event.key())])
                return True
            if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
                self._accept_item(self.list.currentItem())
                return True
        return super().eventFilter(watched, event)

    def _filter(self, text: str) -> None:
        self.list.clear()
        for _, action in matches(text, self._actions):
            key = QKeySequence(next(iter(self._table.keys(action.id)), "")).toString(
                QKeySequence.SequenceFormat.NativeText
            )
            item = QTreeWidgetItem([tr(action.text).rstrip("…"), _place(action), key])
            item.setData(0, Qt.ItemDataRole.UserRole, action.id)
            item.setToolTip(0, tr(action.help))
            item.setDisabled(not self._table.is_enabled(action.id))
            self.list.addTopLevelItem(item)
        self.list.setColumnWidth(0, 330)
        self.list.setColumnWidth(1, 150)
        self._mark(0)

    def _mark(self, row: int) -> None:
        item = self.list.topLevelItem(min(max(row, 0), self.list.topLevelItemCount() - 1))
        if item is not None:
            self.list.setCurrentItem(item)

    def _accept_item(self, item: QTreeWidgetItem | None) -> None:
        if item is None or item.isDisabled():
            return
        self.chosen = str(item.data(0, Qt.ItemDataRole.UserRole))
        self.accept()


def matches(text: str, actions: list[Action]) -> list[tuple[float, Action]]:
    """Actions that hold the letters of `text` in order, the best first; all of them for an empty text."""
    scored = [(_score(text, f"{tr(action.text)} {_place(action)} {action.text}"), action) for action in actions]
    found = [(score, action) for score, action in scored if score is not None]
    return sorted(((score, action) for score, action in found), key=lambda pair: pair[0])


def _score(text: str, title: str) -> float | None:
    """Smaller is better, None for no match: whole words first, then starts of words, then letters in order."""
    wanted, title = text.casefold().strip(), title.casefold()
    if not wanted:
        return 0.0
    if wanted in title:
        at = title.index(wanted)
        return at / 100 if at == 0 or title[at - 1] == " " else 1 + at / 100
    place, gaps = -1, 0
    for letter in wanted.replace(" ", ""):
        following = title.find(letter, place + 1)
        if following < 0:
            return None
        gaps += following - place - 1
        place = following
    return 2 + gaps / 100


def _place(action: Action) -> str:
    return " › ".join(tr(part) for part in action.menu.split("/")) if action.menu else ""
