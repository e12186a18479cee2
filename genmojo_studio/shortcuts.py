"""The sheet of all keys (F1) and the editor in which a person changes them."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeySequence
from PySide6.QtWidgets import (
    QComboBox,
    QDialog,
    QDialogButtonBox,
    QHBoxLayout,
    QKeySequenceEdit,
    QLabel,
    QLineEdit,
    QPushButton,
    QTreeWidget,
    QTreeWidgetItem,
    QVBoxLayout,
    QWidget,
)

from genmojo_studio.actions import PRESETS, ActionTable
from genmojo_studio.settings import Settings
from genmojo_studio.translate import LANGUAGES, tr

_ID = Qt.ItemDataRole.UserRole


class KeySheet(QDialog):
    """All keys that work in a workspace, by menu, with a line to search in."""

    def __init__(self, table: ActionTable, workspace: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("All shortcuts"))
        self.resize(820, 720)
        self.line = QLineEdit(placeholderText=tr("Search"), clearButtonEnabled=True)
        self.list = _tree([tr("Command"), tr("Keys"), tr("What it does")])
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
        buttons.rejected.connect(self.reject)
        layout = QVBoxLayout(self)
        layout.addWidget(self.line)
        layout.addWidget(self.list)
        layout.addWidget(buttons)
        _fill(self.list, table, workspace, with_help=True)
        self.line.textChanged.connect(lambda text: _search(self.list, text))


class KeyEditor(QDialog):
    """Keys of one's own, presets of other tools, language. A key that something else has is named at once."""

    def __init__(self, table: ActionTable, settings: Settings, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._table = table
        self._settings = settings
        self.setWindowTitle(tr("Shortcuts and settings"))
        self.resize(760, 680)
        self.preset = QComboBox()
        self.preset.addItems(list(PRESETS))
        self.preset.setCurrentText(table.preset)
        self.language = QComboBox()
        for code, name in {"": tr("As the system"), **LANGUAGES}.items():
            self.language.addItem(name, code)
        self.language.setToolTip(tr("The language changes when the app starts again."))
        self.language.setCurrentIndex(max(self.language.findData(settings.text("language")), 0))
        self.line = QLineEdit(placeholderText=tr("Search"), clearButtonEnabled=True)
        self.list = _tree([tr("Command"), tr("Keys")])
        self.key = QKeySequenceEdit(clearButtonEnabled=True)
        self.set_button = QPushButton(tr("Set"))
        self.reset_button = QPushButton(tr("As delivered"))
        self.notice = QLabel(wordWrap=True)
        self._arrange()
        self._connect()
        self._refill()

    def _arrange(self) -> None:
        top, bottom = QHBoxLayout(), QHBoxLayout()
        for label, widget in ((tr("Keys as in"), self.preset), (tr("Language (after a restart)"), self.language)):
            top.addWidget(QLabel(label))
            top.addWidget(widget)
            top.addSpacing(16)
        top.addStretch()
        bottom.addWidget(QLabel(tr("New key")))
        for wide in (self.key, self.set_button, self.reset_button):
            bottom.addWidget(wide)
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
        buttons.rejected.connect(self.reject)
        layout = QVBoxLayout(self)
        layout.addLayout(top)
        layout.addWidget(self.line)
        layout.addWidget(self.list)
        layout.addLayout(bottom)
        layout.addWidget(self.notice)
        layout.addWidget(buttons)

    def _connect(self) -> None:
        self.preset.currentTextChanged.connect(self._take_preset)
        self.language.currentIndexChanged.connect(self._take_language)
        self.line.textChanged.connect(lambda text: _search(self.list, text))
        self.list.currentItemChanged.connect(self._show_key)
        self.set_button.clicked.connect(self._set)
        self.reset_button.clicked.connect(self._reset)

    def _refill(self) -> None:
        chosen = self._chosen()
        _fill(self.list, self._table, None, with_help=False)
        _search(self.list, self.line.text())
        for item in _leaves(self.list):
            if item.data(0, _ID) == chosen:
                self.list.setCurrentItem(item)
        conflicts = self._table.conflicts()
        self.notice.setText("\n".join(self._sentence(c.key, c.first, c.second) for c in conflicts[:4]))
        self.notice.setProperty("role", "bad" if conflicts else "dim")
        self.notice.style().polish(self.notice)

    def _sentence(self, key: str, first: str, second: str) -> str:
        return tr("{key} is used by “{first}” and “{second}”.").format(
            key=key, first=tr(self._table[first].text), second=tr(self._table[second].text)
        )

    def _chosen(self) -> str:
        item = self.list.currentItem()
        return str(item.data(0, _ID) or "") if item is not None else ""

    def _show_key(self) -> None:
        if self._chosen():
            self.key.setKeySequence(QKeySequence(next(iter(self._table.keys(self._chosen())), "")))

    def _set(self) -> None:
        if self._chosen():
            text = self.key.keySequence().toString(QKeySequence.SequenceFormat.PortableText)
            self._table.set_keys(self._chosen(), (text,) if text else ())
            self._keep()

    def _reset(self) -> None:
        if self._chosen():
            self._table.set_keys(self._chosen(), None)
            self._keep()
            self._show_key()

    def _take_preset(self, preset: str) -> None:
        self._table.set_preset(preset)
        self._settings.put("keys/preset", preset)
        self._refill()

    def _take_language(self) -> None:
        self._settings.put("language", str(self.language.currentData()))
        self.notice.setText(tr("The language changes when the app starts again."))

    def _keep(self) -> None:
        self._settings.put_own_keys(self._table.own_keys())
        self._refill()


def _tree(headers: list[str]) -> QTreeWidget:
    tree = QTreeWidget()
    tree.setHeaderLabels(headers)
    tree.setAlternatingRowColors(True)
    tree.setUniformRowHeights(True)
    return tree


def _fill(tree: QTreeWidget, table: ActionTable, workspace: str | None, with_help: bool) -> None:
    """One branch per menu; `workspace` None lists every action."""
    tree.clear()
    branches: dict[str, QTreeWidgetItem] = {}
    actions = list(table) if workspace is None else table.available(workspace)
    for action in actions:
        title = tr(action.menu.split("/")[0]) if action.menu else tr("Other")
        if workspace is None and action.workspace:
            title = f"{tr(action.workspace.capitalize())} › {title}"
        if title not in branches:
            branches[title] = QTreeWidgetItem([title])
            tree.addTopLevelItem(branches[title])
        keys = ", ".join(_native(key) for key in table.keys(action.id))
        item = QTreeWidgetItem([tr(action.text), keys, *([tr(action.help)] if with_help else [])])
        item.setData(0, _ID, action.id)
        branches[title].addChild(item)
    tree.expandAll()
    tree.setColumnWidth(0, 330)
    tree.setColumnWidth(1, 150)


def _search(tree: QTreeWidget, text: str) -> None:
    for item in _leaves(tree):
        words = " ".join(item.text(column) for column in range(tree.columnCount())).casefold()
        item.setHidden(text.casefold() not in words)
    for branch in _children(tree.invisibleRootItem()):
        branch.setHidden(all(item.isHidden() for item in _children(branch)))


def _leaves(tree: QTreeWidget) -> list[QTreeWidgetItem]:
    return [item for branch in _children(tree.invisibleRootItem()) for item in _children(branch)]


def _children(item: QTreeWidgetItem) -> list[QTreeWidgetItem]:
    found = (item.child(row) for row in range(item.childCount()))
    return [child for child in found if child is not None]


def _native(key: str) -> str:
    return QKeySequence(key).toString(QKeySequence.SequenceFormat.NativeText)
