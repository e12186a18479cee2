"""Which keys stay with the widget that has the keyboard: shortcuts of single keys must not break lists and fields."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, Qt, QTimer
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractItemView,
    QAbstractSpinBox,
    QApplication,
    QComboBox,
    QLineEdit,
    QListWidget,
    QPushButton,
    QTabBar,
    QTreeWidget,
    QWidget,
)

_PRESS = {Qt.Key.Key_Space, Qt.Key.Key_Return, Qt.Key.Key_Enter}
_UP_DOWN = {Qt.Key.Key_Up, Qt.Key.Key_Down, Qt.Key.Key_Home, Qt.Key.Key_End, Qt.Key.Key_PageUp, Qt.Key.Key_PageDown}
_SIDES = {Qt.Key.Key_Left, Qt.Key.Key_Right}
_EDIT = {Qt.Key.Key_Delete, Qt.Key.Key_Backspace}
_OWN: tuple[tuple[type[QWidget], set[Qt.Key]], ...] = (
    (QLineEdit, _PRESS | _UP_DOWN | _SIDES | _EDIT),
    (QAbstractSpinBox, _PRESS | _UP_DOWN | _SIDES | _EDIT),
    (QComboBox, _PRESS | _UP_DOWN),
    (QAbstractButton, _PRESS),
    (QTabBar, _SIDES),
    (QAbstractItemView, _PRESS | _UP_DOWN),
)


class KeyboardManners(QObject):
    """Lets lists, fields and buttons below a window keep the keys that they understand; all others are shortcuts."""

    def __init__(self, owner: QWidget) -> None:
        super().__init__(owner)
        owner.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Accepting the override sends the key on to the widget instead of a shortcut."""
        override = event.type() == QEvent.Type.ShortcutOverride and isinstance(event, QKeyEvent)
        if override and isinstance(event, QKeyEvent) and belongs(QApplication.focusWidget(), event):
            event.accept()
            return True
        return False


def belongs(widget: QWidget | None, event: QKeyEvent) -> bool:
    """Whether a key is the widget's own: plain keys of its kind, no combinations with Ctrl or Alt."""
    modifiers = Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.AltModifier
    if widget is None or event.modifiers() & modifiers:
        return False
    return any(isinstance(widget, kind) and Qt.Key(event.key()) in keys for kind, keys in _OWN)


class _Closing(QObject):
    """Hands the keyboard to the frame when a list that was opened closes; keys on a closed box keep it."""

    def __init__(self, box: QComboBox, canvas: QWidget) -> None:
        super().__init__(box)
        self._canvas = canvas
        box.view().installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Once the list is gone, for closing it gives the keyboard to the box."""
        if event.type() == QEvent.Type.Hide:
            QTimer.singleShot(0, self._canvas, self._canvas.setFocus)
        return False


def give_back(root: QWidget, canvas: QWidget) -> None:
    """A mouse click on a button leaves the keyboard where it is; one into a list hands it to the frame."""
    for button in root.findChildren(QPushButton):
        button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
    for tree in root.findChildren(QTreeWidget):
        tree.itemClicked.connect(lambda *_: canvas.setFocus())
    for field in root.findChildren(QLineEdit):
        if not isinstance(field.parent(), (QAbstractSpinBox, QComboBox)):
            field.returnPressed.connect(canvas.setFocus)
    for box in root.findChildren(QComboBox):
        _Closing(box, canvas)
    for queue in root.findChildren(QListWidget):
        queue.itemClicked.connect(lambda *_: canvas.setFocus())
