"""Panels of a workspace: all away at once, so that the pictures fill the window, and back; pages in one panel."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import QByteArray, QSize
from PySide6.QtWidgets import QDockWidget, QMainWindow, QStackedWidget

from genmojo_studio.settings import Settings


class Panels:
    """The docks of one workspace. Whether they are hidden is remembered under its name.

    Args:
        version: of the layout, as in `QMainWindow.saveState`.
    """

    def __init__(self, window: QMainWindow, docks: Mapping[str, QDockWidget], name: str, version: int = 0) -> None:
        self._window, self._docks, self._version = window, docks, version
        self._key = f"panels/{name}"
        self._shown: QByteArray | None = None  # what to come back to, while hidden

    @property
    def hidden(self) -> bool:
        """True while the panels are away."""
        return self._shown is not None

    def layout(self) -> QByteArray:
        """Where the panels are, or will be when they come back."""
        return self._window.saveState(self._version) if self._shown is None else self._shown

    def toggle(self) -> None:
        """Away, or back to where they were."""
        if self._shown is None:
            self._hide()
        else:
            shown, self._shown = self._shown, None
            self._window.restoreState(shown, self._version)
        Settings().put(self._key, "hidden" if self.hidden else "")

    def arranged(self) -> None:
        """The workspace has put its panels somewhere: they go away again where that was asked for."""
        self._shown = None
        if Settings().text(self._key):
            self._hide()

    def reset(self) -> None:
        """Panels are on show from now on, wherever the workspace puts them."""
        self._shown = None
        Settings().put(self._key, "")

    def _hide(self) -> None:
        self._shown = self._window.saveState(self._version)
        for dock in self._docks.values():
            dock.hide()


class Pages(QStackedWidget):
    """Pages of which only the one on show takes room; the others may be wider."""

    def __init__(self) -> None:
        super().__init__()
        self.currentChanged.connect(self._turned)

    def sizeHint(self) -> QSize:
        """That of the page on show."""
        page = self.currentWidget()
        return super().sizeHint() if page is None else page.sizeHint()

    def minimumSizeHint(self) -> QSize:
        """That of the page on show."""
        page = self.currentWidget()
        return super().minimumSizeHint() if page is None else page.minimumSizeHint()

    def _turned(self, _place: int) -> None:
        self.updateGeometry()
