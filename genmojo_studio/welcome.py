"""The start page: the demo one click away, what was open lately, and how to bring something of one's own."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QFrame,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QListWidget,
    QListWidgetItem,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from genmojo_core.errors import GenmojoError
from genmojo_studio import opening
from genmojo_studio.translate import tr


class Welcome(QWidget):
    """The start page; it only says what was asked for."""

    demo_wanted = Signal()
    folder_wanted = Signal()
    file_wanted = Signal()
    path_wanted = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        title = QLabel("GenMOJO Studio")
        title.setProperty("role", "title")
        about = QLabel(tr("From a video of several objects to a complete 4D scene and accurate point tracks."))
        about.setProperty("role", "dim")
        self.recent = QListWidget()
        self.recent.setWordWrap(False)
        self.recent.setTextElideMode(Qt.TextElideMode.ElideMiddle)
        self.recent.itemActivated.connect(self._open_recent)
        self.recent.itemClicked.connect(self._open_recent)
        self.demo_button = _card_button(tr("Open the demo clip"), self.demo_wanted.emit)
        self.demo_button.setDefault(True)
        cards = self._cards()
        drop = QLabel(
            tr("Or drop a folder or a file anywhere on the window.  Ctrl+K finds every command, F1 every key.")
        )
        drop.setProperty("role", "dim")
        drop.setWordWrap(True)
        column = QVBoxLayout()
        for part in (title, about):
            column.addWidget(part)
        column.addSpacing(20)
        column.addLayout(cards)
        column.addSpacing(20)
        column.addWidget(_heading(tr("Opened lately")))
        column.addWidget(self.recent, 1)
        column.addWidget(drop)
        frame = QWidget()
        frame.setLayout(column)
        frame.setMaximumWidth(1000)
        outer = QGridLayout(self)
        outer.setContentsMargins(40, 48, 40, 32)
        outer.addWidget(frame, 0, 1)
        for side in (0, 2):
            outer.setColumnStretch(side, 1)
        outer.setColumnStretch(1, 12)

    def _cards(self) -> QHBoxLayout:
        cards = QHBoxLayout()
        for heading, text, button in (
            (tr("Try it"), tr("Shapes that cross and hide one another, made on the spot."), self.demo_button),
            (
                tr("Your own clip"),
                tr("A folder of images. Masks, depth and cameras beside it are used if they are there."),
                _card_button(tr("Open clip folder…"), self.folder_wanted.emit),
            ),
            (
                tr("A file"),
                tr("A video, a scene (.h5), an annotation project (.genmojo) or a splat (.ply)."),
                _card_button(tr("Open file…"), self.file_wanted.emit),
            ),
        ):
            cards.addWidget(_card(heading, text, button))
        return cards

    def show_recent(self, paths: list[Path], live: Sequence[Path] = ()) -> None:
        """Lists runs that go on without a window, then what was open lately, newest first."""
        self.recent.clear()
        for path in [*live, *(path for path in paths if path not in live)]:
            kind = tr("run, going on now") if path in live else _kind_text(path)
            item = QListWidgetItem(f"{path.name}    {kind}    {path.parent}")
            item.setData(Qt.ItemDataRole.UserRole, str(path))
            item.setToolTip(str(path))
            self.recent.addItem(item)
        if not self.recent.count():
            item = QListWidgetItem(tr("Nothing yet."))
            item.setFlags(Qt.ItemFlag.NoItemFlags)
            self.recent.addItem(item)

    def _open_recent(self, item: QListWidgetItem) -> None:
        path = item.data(Qt.ItemDataRole.UserRole)
        if path:
            self.path_wanted.emit(path)


def _kind_text(path: Path) -> str:
    """What a path is, for people; nothing if it cannot be opened any more."""
    names = {"clip": tr("clip"), "scene": tr("scene"), "project": tr("project"), "ply": tr("splat"), "run": tr("run")}
    try:
        return names[opening.kind_of(path)]
    except GenmojoError:
        return ""


def _card(title: str, text: str, button: QPushButton) -> QFrame:
    card = QFrame()
    card.setProperty("role", "card")
    layout = QVBoxLayout(card)
    layout.setContentsMargins(18, 16, 18, 16)
    layout.addWidget(_heading(title))
    said = QLabel(text)
    said.setWordWrap(True)
    said.setProperty("role", "dim")
    layout.addWidget(said, 1)
    layout.addWidget(button)
    return card


def _heading(text: str) -> QLabel:
    label = QLabel(text)
    label.setProperty("role", "heading")
    return label


def _card_button(text: str, callback: Callable[[], object]) -> QPushButton:
    button = QPushButton(text)
    button.clicked.connect(lambda: callback())
    return button
