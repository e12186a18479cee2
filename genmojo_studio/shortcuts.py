"""The editor in which a person changes keys: one by one, by presets, by files."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from PySide6.QtGui import QKeySequence
from PySide6.QtWidgets import (
    QComboBox,
    QDialog,
    QDialogButtonBox,
    QFileDialog,
    QHBoxLayout,
    QKeySequenceEdit,
    QLabel,
    QLineEdit,
    QListWidget,
    QListWidgetItem,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from genmojo_core.errors import GenmojoError
from genmojo_studio import key_rules
from genmojo_studio.actions import PRESETS, ActionTable, normal_key
from genmojo_studio.key_list import ID, KeyTree, fill
from genmojo_studio.key_rules import native
from genmojo_studio.settings import Settings
from genmojo_studio.translate import LANGUAGES, fault, tr

_KINDS = "JSON (*.json)"


class KeyEditor(QDialog):
    """Keys of one's own, presets of other tools, language.

    A key that clashes is refused with the name of the other action, and offered to be taken over from it.
    """

    def __init__(self, table: ActionTable, settings: Settings, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._table, self._settings = table, settings
        self._offered: Callable[[], None] | None = None
        self.setWindowTitle(tr("Shortcuts and settings"))
        self.resize(800, 760)
        self.preset = QComboBox()
        self.preset.addItems(list(PRESETS))
        self.preset.setCurrentText(table.preset)
        self.language = QComboBox()
        for code, name in {"": tr("As the system"), **LANGUAGES}.items():
            self.language.addItem(name, code)
        self.language.setToolTip(tr("The language changes when the app starts again."))
        self.language.setCurrentIndex(max(self.language.findData(settings.text("language")), 0))
        self.line = QLineEdit(placeholderText=tr("Search"), clearButtonEnabled=True)
        self.list = KeyTree([tr("Command"), tr("Keys")])
        self.keys = QListWidget()
        self.keys.setMaximumHeight(84)
        self.keys.setAccessibleName(tr("Keys of the command"))
        self.key = QKeySequenceEdit(clearButtonEnabled=True)
        self.key.setMaximumSequenceLength(2)
        self.add_button, self.replace_button = QPushButton(tr("Add")), QPushButton(tr("Replace the marked key"))
        self.remove_button, self.reset_button = QPushButton(tr("Remove")), QPushButton(tr("As delivered"))
        self.notice = QLabel(wordWrap=True)
        self.take_button = QPushButton(tr("Take it over"))
        self._arrange()
        self._connect()
        self._refill()
        self.say("", bad=False)

    def _arrange(self) -> None:
        top, middle, bottom, foot = QHBoxLayout(), QHBoxLayout(), QHBoxLayout(), QHBoxLayout()
        for label, widget in ((tr("Keys as in"), self.preset), (tr("Language (after a restart)"), self.language)):
            top.addWidget(QLabel(label))
            top.addWidget(widget)
            top.addSpacing(16)
        top.addStretch()
        sides = QVBoxLayout()
        for button in (self.remove_button, self.reset_button):
            sides.addWidget(button)
        sides.addStretch()
        middle.addWidget(self.keys, 1)
        middle.addLayout(sides)
        bottom.addWidget(QLabel(tr("New key")))
        for wide in (self.key, self.add_button, self.replace_button):
            bottom.addWidget(wide)
        foot.addWidget(self.notice, 1)
        foot.addWidget(self.take_button)
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
        self.import_button = buttons.addButton(tr("Import…"), QDialogButtonBox.ButtonRole.ActionRole)
        self.export_button = buttons.addButton(tr("Export…"), QDialogButtonBox.ButtonRole.ActionRole)
        buttons.rejected.connect(self.reject)
        layout = QVBoxLayout(self)
        layout.addLayout(top)
        layout.addWidget(self.line)
        layout.addWidget(self.list, 1)
        for row in (middle, bottom, foot):
            layout.addLayout(row)
        layout.addWidget(buttons)
        for button in self.findChildren(QPushButton):
            button.setAutoDefault(False)  # Enter in the field for a key is a key

    def _connect(self) -> None:
        self.preset.textActivated.connect(self._take_preset)
        self.language.currentIndexChanged.connect(self._take_language)
        self.line.textChanged.connect(self.list.search)
        self.list.currentItemChanged.connect(self._show_keys)
        self.add_button.clicked.connect(self.add)
        self.replace_button.clicked.connect(self.replace)
        self.remove_button.clicked.connect(self.remove)
        self.reset_button.clicked.connect(self.reset)
        self.take_button.clicked.connect(self.take_over)
        self.import_button.clicked.connect(self.import_file)
        self.export_button.clicked.connect(self.export_file)

    # ---- one action

    def choose(self, action_id: str) -> None:
        """Mark an action."""
        for item in self.list.leaves():
            if item.data(0, ID) == action_id:
                self.list.setCurrentItem(item)

    def add(self) -> None:
        """One more key for the action that is marked."""
        key = self._typed()
        if key:
            self._propose((*self._table.keys(self._chosen()), key), [key])

    def replace(self) -> None:
        """Another key in place of the one that is marked; its other keys stay."""
        key, old = self._typed(), self._marked()
        if key and old:
            wanted = tuple(key if k == old else k for k in self._table.keys(self._chosen()))
            self._propose(wanted, [key])

    def remove(self) -> None:
        """Take the marked key from the action; its other keys stay."""
        old = self._marked()
        if old:
            self._propose(tuple(k for k in self._table.keys(self._chosen()) if k != old), [])

    def reset(self) -> None:
        """The keys that the preset gives to the action."""
        if self._chosen():
            tried = key_rules.trial(self._table)
            tried.set_keys(self._chosen(), None)
            had = self._table.keys(self._chosen())
            self._propose(None, [key for key in tried.keys(self._chosen()) if key not in had])

    def take_over(self) -> None:
        """Do what was refused, at the cost of the actions that were named."""
        if self._offered is not None:
            self._offered()

    def _propose(self, wanted: tuple[str, ...] | None, new: list[str]) -> None:
        """Give the action that is marked keys, `new` ones among them, unless those clash."""
        action_id = self._chosen()
        tried = key_rules.trial(self._table)
        tried.set_keys(action_id, wanted)
        found = key_rules.clashes(tried, action_id, new)
        if not found:
            self._change(lambda: self._table.set_keys(action_id, wanted))
            return
        words = " ".join(dict.fromkeys(key_rules.sentence(self._table, action_id, clash) for clash in found))
        possible = all(clash.other for clash in found)
        self.say(words, bad=True)
        if possible:
            self._offer(lambda: key_rules.take_over(self._table, action_id, wanted, found), tr("Take it over"))

    def _typed(self) -> str:
        """The new key, "" if there is none to give or the action has it."""
        key = self.key.keySequence().toString(QKeySequence.SequenceFormat.PortableText)
        if not self._chosen():
            self.say(tr("Mark a command first."), bad=False)
            return ""
        if not key:
            self.say(tr("Press the new key in the field first."), bad=False)
        elif normal_key(key) in map(normal_key, self._table.keys(self._chosen())):
            self.say(tr("The command has this key already."), bad=False)
            return ""
        return key

    # ---- all actions

    def import_file(self) -> None:
        """All keys from a file."""
        name, _ = QFileDialog.getOpenFileName(self, tr("Import shortcuts"), "", _KINDS)
        if not name:
            return
        try:
            unknown = key_rules.read_file(self._table, Path(name))
        except GenmojoError as error:
            self.say(fault(error), bad=True)
            return
        self._keep()
        words = tr("{n} commands of the file are not known here.").format(n=unknown) if unknown else ""
        self.say(tr("Taken from {name}.").format(name=Path(name).name) + f" {words}", bad=False)

    def export_file(self) -> None:
        """All keys into a file."""
        name, _ = QFileDialog.getSaveFileName(self, tr("Export shortcuts"), "shortcuts.json", _KINDS)
        if not name:
            return
        path = Path(name).with_suffix(".json")
        try:
            key_rules.write_file(self._table, path)
        except GenmojoError as error:
            self.say(fault(error), bad=True)
            return
        self.say(tr("Saved: {name}").format(name=path.name), bad=False)

    def _take_preset(self, preset: str) -> None:
        """Other keys; those of one's own stay, and those that would clash are asked about first."""
        lost = key_rules.own_that_clash(self._table, preset)

        def take() -> None:
            for action_id in lost:
                self._table.set_keys(action_id, None)
            self._table.set_preset(preset)

        if not lost:
            self._change(take)
            return
        self.preset.setCurrentText(self._table.preset)
        names = ", ".join(tr(self._table[action_id].text) for action_id in lost[:4])
        self.say(tr("Keys of your own clash with {preset}: {names}.").format(preset=preset, names=names), bad=True)
        self._offer(take, tr("Give mine up"))

    def _take_language(self) -> None:
        self._settings.put("language", str(self.language.currentData()))
        self.say(tr("The language changes when the app starts again."), bad=False)

    # ---- what is shown

    def say(self, words: str, *, bad: bool) -> None:
        """A sentence below; with nothing to say, what is wrong with the keys as they are."""
        conflicts = [] if words else self._table.conflicts()
        self.notice.setText(words or "\n".join(self._conflict(c.key, c.first, c.second) for c in conflicts[:4]))
        self.notice.setProperty("role", "bad" if bad or conflicts else "dim")
        for polish in (self.notice.style().unpolish, self.notice.style().polish):  # the theme looks at roles once
            polish(self.notice)
        self._offered = None
        self.take_button.hide()

    def _offer(self, change: Callable[[], object], title: str) -> None:
        self._offered = lambda: self._change(change)
        self.take_button.setText(title)
        self.take_button.show()

    def _change(self, change: Callable[[], object]) -> None:
        change()
        self._keep()
        self.key.clear()
        self.say("", bad=False)

    def _keep(self) -> None:
        """Store the keys and show them."""
        self._settings.put_own_keys(self._table.own_keys())
        self._settings.put("keys/preset", self._table.preset)
        self.preset.setCurrentText(self._table.preset)
        self._refill()

    def _refill(self) -> None:
        chosen = self._chosen()
        self.list.clear()
        fill(self.list, self._table, self._table, places=True)
        self.list.spread()
        self.list.setColumnWidth(0, 420)
        self.list.search(self.line.text())
        self.choose(chosen)
        self._show_keys()

    def _conflict(self, key: str, first: str, second: str) -> str:
        return tr("{key} is used by “{first}” and “{second}”.").format(
            key=key, first=tr(self._table[first].text), second=tr(self._table[second].text)
        )

    def _chosen(self) -> str:
        item = self.list.currentItem()
        return str(item.data(0, ID) or "") if item is not None else ""

    def _marked(self) -> str:
        item = self.keys.currentItem()
        return "" if item is None else str(item.data(ID))

    def _show_keys(self) -> None:
        self.keys.clear()
        for key in self._table.keys(self._chosen()) if self._chosen() else ():
            item = QListWidgetItem(native(key))
            item.setData(ID, key)
            self.keys.addItem(item)
        self.keys.setCurrentRow(0)
        for button in (self.replace_button, self.remove_button):
            button.setEnabled(bool(self.keys.count()))
        for widget in (self.key, self.add_button, self.reset_button):
            widget.setEnabled(bool(self._chosen()))
