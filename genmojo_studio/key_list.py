"""Lists of actions and their keys, as the sheet of keys and the editor of keys show them."""

from __future__ import annotations

from collections.abc import Iterable

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QTreeWidget, QTreeWidgetItem

from genmojo_studio.actions import Action, ActionTable
from genmojo_studio.key_rules import native
from genmojo_studio.translate import tr

ID = Qt.ItemDataRole.UserRole


class KeyTree(QTreeWidget):
    """Branches of actions, or of gestures; `search` hides what does not hold a text."""

    def __init__(self, headers: list[str]) -> None:
        super().__init__()
        self.setHeaderLabels(headers)
        self.setAlternatingRowColors(True)
        self.setUniformRowHeights(True)
        self._branches: dict[str, QTreeWidgetItem] = {}

    def clear(self) -> None:
        """Nothing is listed."""
        super().clear()
        self._branches = {}

    def add(self, branch: str, texts: list[str], action_id: str = "") -> QTreeWidgetItem:
        """A line below a branch, which is made where there is none of that title."""
        if branch not in self._branches:
            self._branches[branch] = QTreeWidgetItem([branch])
            self.addTopLevelItem(self._branches[branch])
        item = QTreeWidgetItem(texts)
        item.setData(0, ID, action_id)
        for column, text in enumerate(texts):
            item.setToolTip(column, text)
        self._branches[branch].addChild(item)
        return item

    def spread(self) -> None:
        """Show all branches, with room for the names."""
        self.expandAll()
        self.setColumnWidth(0, 330)
        self.setColumnWidth(1, 150)

    def search(self, text: str) -> None:
        """Show what holds a text only."""
        for item in self.leaves():
            words = " ".join(item.text(column) for column in range(self.columnCount())).casefold()
            item.setHidden(text.casefold() not in words)
        for branch in _children(self.invisibleRootItem()):
            branch.setHidden(all(item.isHidden() for item in _children(branch)))

    def leaves(self) -> list[QTreeWidgetItem]:
        """The lines below the branches."""
        return [item for branch in _children(self.invisibleRootItem()) for item in _children(branch)]


def fill(tree: KeyTree, table: ActionTable, actions: Iterable[Action], places: bool) -> None:
    """One branch per menu: text, keys and (where there are three columns) help; `places` names the workspace too."""
    for action in actions:
        title = tr(action.menu.split("/")[0]) if action.menu else tr("Other")
        if places and action.workspace:
            title = f"{tr(action.workspace.capitalize())} › {title}"
        add_action(tree, table, action, title)


def add_action(tree: KeyTree, table: ActionTable, action: Action, branch: str) -> None:
    """One action below a branch."""
    keys = "   ".join(native(key) for key in table.keys(action.id))
    tree.add(branch, [tr(action.text), keys, tr(action.help)][: tree.columnCount()], action.id)


def _children(item: QTreeWidgetItem) -> list[QTreeWidgetItem]:
    found = (item.child(row) for row in range(item.childCount()))
    return [child for child in found if child is not None]
