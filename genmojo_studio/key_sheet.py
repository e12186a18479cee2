"""The sheet of all keys (F1): what mouse and keys do in the step that a person is in, then everything else."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QCheckBox, QDialog, QDialogButtonBox, QHBoxLayout, QLineEdit, QVBoxLayout, QWidget

from genmojo_studio.actions import ActionTable
from genmojo_studio.key_list import KeyTree, add_action, fill
from genmojo_studio.key_rules import native
from genmojo_studio.translate import tr

if TYPE_CHECKING:
    from genmojo_studio.annotate.mouse_rules import Here


class KeySheet(QDialog):
    """Mouse and keys that work in a workspace, with a line to search in.

    Args:
        place: the step that a person is in (from 0), None where there are no steps.
    """

    def __init__(self, table: ActionTable, workspace: str, parent: QWidget | None = None,
                 place: int | None = None) -> None:  # fmt: skip
        super().__init__(parent)
        self._table, self._workspace, self._place = table, workspace, place
        self.setWindowTitle(tr("Mouse and keys"))
        self.resize(860, 760)
        self.line = QLineEdit(placeholderText=tr("Search"), clearButtonEnabled=True)
        self.only = QCheckBox(tr("This step only"))
        self.only.setVisible(place is not None)
        self.list = KeyTree([tr("Command"), tr("Keys"), tr("What it does")])
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
        buttons.rejected.connect(self.reject)
        top = QHBoxLayout()
        top.addWidget(self.line, 1)
        top.addWidget(self.only)
        layout = QVBoxLayout(self)
        layout.addLayout(top)
        layout.addWidget(self.list)
        layout.addWidget(buttons)
        self.line.textChanged.connect(self.list.search)
        self.only.toggled.connect(self._refill)
        self._later = QTimer(self, singleShot=True, interval=0)  # a workspace binds a hundred actions at once
        self._later.timeout.connect(self._refill)
        self.destroyed.connect(table.subscribe(self._later.start))
        self._refill()
        self.line.setFocus()

    def _refill(self) -> None:
        self.list.clear()
        actions = self._table.available(self._workspace)
        here = self._here()
        if here is not None:
            for where, gesture, does in here.rules:
                self.list.add(where, [gesture, "", does])
            for action in actions:
                if here.has(action.id) and self._table.keys(action.id):
                    add_action(self.list, self._table, action, here.title)
        if not self.only.isChecked() or here is None:
            rest = [action for action in actions if here is None or not here.has(action.id)
                    or not self._table.keys(action.id)]  # fmt: skip
            fill(self.list, self._table, rest, places=False)
        self.list.spread()
        self.list.setColumnWidth(0, 330)
        self.list.setColumnWidth(1, 170)
        self.list.search(self.line.text())

    def _here(self) -> Here | None:
        if self._workspace != "annotate" or self._place is None:
            return None
        from genmojo_studio.annotate.mouse_rules import here  # the start page does without the annotator

        return here(self._place, lambda action_id: native(next(iter(self._table.keys(action_id)), "")))
