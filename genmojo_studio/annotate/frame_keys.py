"""Keys that step through the frames behind a dialog."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QWidget

from genmojo_studio.annotate.session import Session

_STEPS = {Qt.Key.Key_Comma: -1, Qt.Key.Key_Period: 1}


class FrameKeys(QObject):
    """While `widget` has the keyboard, comma and full stop go a frame back and on: they belong to actions of the window
    below, which rests meanwhile."""

    def __init__(self, session: Session, widget: QWidget) -> None:
        super().__init__(widget)
        self._session = session
        widget.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Take the keys before anybody else does."""
        kinds = (QEvent.Type.ShortcutOverride, QEvent.Type.KeyPress)
        if isinstance(event, QKeyEvent) and event.type() in kinds and event.key() in _STEPS:
            event.accept()
            if event.type() == QEvent.Type.KeyPress:
                self._session.go(self._session.frame + _STEPS[Qt.Key(event.key())])
            return True
        return super().eventFilter(watched, event)
