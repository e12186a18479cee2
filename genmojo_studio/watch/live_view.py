"""The 3D view in the workspace: follows the shared state, remembers turns for undo, draws point tracks."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtGui import QPainter
from PySide6.QtWidgets import QVBoxLayout, QWidget

from genmojo_core.clip.cameras import View
from genmojo_studio.state import AppState
from genmojo_studio.theme import colours
from genmojo_studio.translate import tr
from genmojo_studio.undo import UndoStack
from genmojo_studio.view3d.frames import FrameRequest
from genmojo_studio.view3d.look import BLACK
from genmojo_studio.view3d.orbit import Orbit
from genmojo_studio.view3d.scene_view import SceneView
from genmojo_studio.view3d.snapshot import SceneSnapshot
from genmojo_studio.watch import track_overlay
from genmojo_studio.watch.appearance import Appearance
from genmojo_studio.watch.controls import dim
from genmojo_studio.watch.track_overlay import Chosen
from genmojo_studio.watch.track_sets import TrackSet


class LiveView(SceneView):
    """A `SceneView` that belongs to the app."""

    def __init__(self, state: AppState, appearance: Appearance, undo: UndoStack, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._state = state
        self._appearance = appearance
        self._undo = undo
        self._kept = self.orbit
        self._quiet = False
        self._pending: SceneSnapshot | None = None
        self._sets: tuple[TrackSet, ...] = ()
        self._selected: Chosen = ()
        self._nothing = dim()
        self._nothing.setAlignment(Qt.AlignmentFlag.AlignCenter)
        layout = QVBoxLayout(self)
        layout.addWidget(self._nothing)
        self.set_input(self._clip_frame)
        self.add_overlay(self._paint_tracks)
        self.view_changed.connect(self._remember)
        appearance.changed.connect(self._take_look)
        state.subscribe(self._take_time, "frame")

    def show_snapshot(self, snapshot: SceneSnapshot | None) -> None:
        """Shows a scene, or as soon as drawing is allowed again."""
        if self._quiet and snapshot is not None:
            self._pending = snapshot
        else:
            self.set_snapshot(snapshot)
            self._nothing.setVisible(snapshot is None)
            self._take_time()

    def set_quiet(self, quiet: bool) -> None:
        """While the worker measures what the view costs, new previews wait."""
        self._quiet = quiet
        if not quiet and self._pending is not None:
            self.set_snapshot(self._pending)
            self._pending = None

    def show_tracks(self, sets: Iterable[TrackSet], selected: Chosen) -> None:
        """Draws 3D tracks over the scene."""
        self._sets, self._selected = tuple(sets), selected
        self.overlay.update()

    def request(self) -> FrameRequest | None:
        """What the view shows now, for others to draw the same."""
        return None if self.snapshot is None else self._request(moving=self._rest.isActive())

    def _take_time(self) -> None:
        self.set_time(float(self._state.frame), playing=self._state.playing)

    def _take_look(self) -> None:
        look = self._appearance.look
        self.set_look(look)
        light = sum(look.backdrop or BLACK) > 1.5  # the text must be read on whatever was chosen
        ink = colours("light" if light else "dark").dim
        text = tr("No scene yet. Start a run (F5), or open a scene file.")
        self._nothing.setText(f'<span style="color: {ink}">{text}</span>')

    def _remember(self, orbit: Orbit) -> None:
        if orbit != self._kept:
            self._undo.record(tr("Turn the view"), self._restore, self._kept, orbit, "orbit")
            self._kept = orbit

    def _restore(self, orbit: Orbit) -> None:
        self._kept = orbit
        self.set_orbit(orbit)

    def _clip_frame(self, t: int) -> np.ndarray | None:
        clip = self._state.clip
        return clip.frames[t] if clip is not None and 0 <= t < len(clip.frames) else None

    def _paint_tracks(self, painter: QPainter, view: View, t: float) -> None:
        project = track_overlay.by_camera(view, (1.0, 1.0), (0.0, 0.0))
        track_overlay.paint(painter, self._sets, round(t), project, self._selected)
