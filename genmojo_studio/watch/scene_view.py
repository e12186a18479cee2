"""The live view of the scene, with orbit, undo of views and point tracks over it."""

from __future__ import annotations

from collections.abc import Iterable

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QVBoxLayout, QWidget

from genmojo_studio.state import AppState
from genmojo_studio.undo import UndoStack
from genmojo_studio.view3d.orbit import Orbit, Reference, reference_of
from genmojo_studio.view3d.snapshot import SceneSnapshot
from genmojo_studio.watch.appearance import Appearance
from genmojo_studio.watch.picture import Picture
from genmojo_studio.watch.reference import draw
from genmojo_studio.watch.track_sets import TrackSet


class SceneView(QWidget):
    """Stand-in until the splat view is there."""

    orbit_changed = Signal()
    picked = Signal(float, float)

    def __init__(self, state: AppState, appearance: Appearance, undo: UndoStack, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.state = state
        self.orbit = Orbit()
        self.tracks_shown = True
        self.snapshot: SceneSnapshot | None = None
        self.picture = Picture(state)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self.picture)

    @property
    def reference(self) -> Reference:
        return reference_of(self.snapshot, self.state.frame)

    def show_snapshot(self, snapshot):
        self.snapshot = snapshot
        self.set_time(self.state.frame)

    def set_orbit(self, orbit):
        self.orbit = orbit
        self.set_time(self.state.frame)
        self.orbit_changed.emit()

    go_to = set_orbit

    def set_time(self, t):
        if self.snapshot is not None:
            self.picture.show_pixels(draw(self.snapshot, t, (480, 270)), "scene")

    def set_quiet(self, on):
        pass

    def show_tracks(self, shown: Iterable[TrackSet], selected) -> None:
        self.picture.show_tracks(shown, selected)

    def pick(self, x, y):
        return None
