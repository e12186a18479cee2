"""Camera paths: keys with pose, lens, scene time and hold; edited as numbers, kept as JSON, rendered to video."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QCheckBox,
    QDialog,
    QFileDialog,
    QHeaderView,
    QPushButton,
    QSpinBox,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from genmojo_core.clip.camera_path import CameraKey, CameraPath
from genmojo_core.errors import GenmojoError
from genmojo_core.store import camera_paths
from genmojo_studio import notify
from genmojo_studio.state import AppState
from genmojo_studio.translate import tr
from genmojo_studio.view3d.orbit import Orbit
from genmojo_studio.watch.controls import dim, row
from genmojo_studio.watch.film_dialogs import mode_box
from genmojo_studio.watch.live_view import LiveView

_STEP_SECONDS = 2.0
_FIELDS = ("seconds", "scene_time", "fov", "hold")


class PathEditor(QDialog):
    """Emits `render_wanted(path as JSON, mode, short side)`."""

    render_wanted = Signal(dict, str, int)

    def __init__(self, state: AppState, view: LiveView, parent: QWidget | None = None) -> None:
        super().__init__(parent, Qt.WindowType.Tool)
        self._state = state
        self._view = view
        self.keys: list[CameraKey] = []
        self.setWindowTitle(tr("Camera path"))
        self.resize(560, 380)
        self.table = QTableWidget(0, len(_FIELDS))
        self.table.setHorizontalHeaderLabels([tr("Arrives (s)"), tr("Frame"), tr("Field of view (°)"), tr("Stays (s)")])
        self.table.setSelectionBehavior(QTableWidget.SelectionBehavior.SelectRows)
        self.table.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.Stretch)
        self.closed = QCheckBox(tr("Back to the first key"))
        self.mode = mode_box()
        self.short_side = QSpinBox()
        self.short_side.setRange(16, 4320)
        self.short_side.setValue(480)
        self.short_side.setSuffix(" px")
        layout = QVBoxLayout(self)
        layout.addWidget(dim(tr("Move the view, choose a frame, and add a key. Numbers can be typed over.")))
        layout.addWidget(self.table, 1)
        layout.addLayout(row(*(self._button(text, call) for text, call in (
            (tr("Add a key here"), self.add_key), (tr("Take this view"), self._replace_key),
            (tr("Show"), self._show_key), (tr("Delete"), self._delete_key)))))  # fmt: skip
        layout.addLayout(row(self.closed, self._button(tr("Load…"), self._load), self._button(tr("Save…"), self._save)))
        layout.addLayout(row(self.mode, self.short_side, self._button(tr("Render…"), self._render)))
        self.table.itemChanged.connect(self._typed)

    def add_key(self) -> None:
        """The view and the frame on show become the next key."""
        key = self._key_here(self.keys[-1].seconds + self.keys[-1].hold + _STEP_SECONDS if self.keys else 0.0)
        if key is not None:
            self.keys.append(key)
            self._refill(len(self.keys) - 1)

    def path(self) -> CameraPath:
        """The path of the table. Raises GenmojoError("camera")."""
        return CameraPath("path", tuple(self.keys), self.closed.isChecked())

    def _key_here(self, seconds: float) -> CameraKey | None:
        request = self._view.request()
        if request is None:
            return None
        fov = request.reference.fov if request.orbit.fov is None else request.orbit.fov
        return CameraKey(request.reference.pose(request.orbit), fov, float(self._state.frame), seconds)

    def _replace_key(self) -> None:
        at = self.table.currentRow()
        if 0 <= at < len(self.keys):
            here = self._key_here(self.keys[at].seconds)
            if here is not None:
                self.keys[at] = replace(here, hold=self.keys[at].hold)
                self._refill(at)

    def _show_key(self) -> None:
        at = self.table.currentRow()
        if 0 <= at < len(self.keys) and self._view.snapshot is not None:
            key = self.keys[at]
            self._state.set(frame=round(key.scene_time))
            try:
                self._view.set_orbit(self._view.reference().orbit_of(key.world_to_camera, key.fov), animate=True)
            except GenmojoError:
                self._view.set_orbit(Orbit(fov=key.fov))

    def _delete_key(self) -> None:
        at = self.table.currentRow()
        if 0 <= at < len(self.keys):
            del self.keys[at]
            self._refill(min(at, len(self.keys) - 1))

    def _load(self) -> None:
        name, _ = QFileDialog.getOpenFileName(self, tr("Load a camera path"), "", "JSON (*.json)")
        if name:
            try:
                found = camera_paths.read_json(name)
            except GenmojoError as error:
                notify.tell(error, self)
                return
            self.keys = list(found.keys)
            self.closed.setChecked(found.closed)
            self._refill(0)

    def _save(self) -> None:
        name, _ = QFileDialog.getSaveFileName(self, tr("Save the camera path"), "path.json", "JSON (*.json)")
        if name:
            try:
                camera_paths.write_json(self.path(), name)
            except GenmojoError as error:
                notify.tell(error, self)

    def _render(self) -> None:
        try:
            data: dict[str, Any] = self.path().to_json()
        except GenmojoError as error:
            notify.tell(error, self)
            return
        self.render_wanted.emit(data, str(self.mode.currentData()), self.short_side.value())

    def _refill(self, current: int) -> None:
        self.table.blockSignals(True)
        self.table.setRowCount(len(self.keys))
        for i, key in enumerate(self.keys):
            shown = (key.seconds, key.scene_time + 1, key.fov, key.hold)
            for column, value in enumerate(shown):
                self.table.setItem(i, column, QTableWidgetItem(f"{value:g}"))
        self.table.blockSignals(False)
        self.table.setCurrentCell(current, 0)

    def _typed(self, item: QTableWidgetItem) -> None:
        at, name = item.row(), _FIELDS[item.column()]
        try:
            value = float(item.text().replace(",", "."))
            changes: dict[str, Any] = {name: value - 1 if name == "scene_time" else value}
            changed = replace(self.keys[at], **changes)
            CameraPath("key", (changed,))
        except (ValueError, GenmojoError):
            self._refill(at)
            return
        self.keys[at] = changed
        self.keys.sort(key=lambda key: key.seconds)
        self._refill(at)

    def _button(self, text: str, call: Any) -> QPushButton:
        button = QPushButton(text)
        button.setAutoDefault(False)
        button.clicked.connect(lambda: call())
        return button
