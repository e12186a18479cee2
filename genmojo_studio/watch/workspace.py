"""The workspace Watch: the scene in the middle, panels around it."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtWidgets import QLabel, QMainWindow, QWidget

from genmojo_studio.actions import ActionTable
from genmojo_studio.state import AppState


class WatchWorkspace(QMainWindow):
    """Optimise, look at, question, compare and take away a scene."""

    def __init__(self, state: AppState, actions: ActionTable, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.state = state
        self.actions_table = actions
        self.setCentralWidget(QLabel("watch"))

    def open_clip(self, path: Path) -> None:
        """Shows the clip of the shared state."""

    def open_path(self, path: Path, kind: str) -> None:
        """Shows a scene file, a PLY or a run folder."""

    def save_layout(self) -> None:
        """Remembers where the panels are."""

    def restore_layout(self) -> None:
        """Puts the panels where they were."""
