"""The view by numbers: elevation, azimuth, roll, radius, field of view; directions; splat size; what was seen."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QColor, QGuiApplication
from PySide6.QtWidgets import (
    QCheckBox,
    QColorDialog,
    QComboBox,
    QFormLayout,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QSlider,
    QVBoxLayout,
    QWidget,
)

from genmojo_core.errors import GenmojoError
from genmojo_studio import notify
from genmojo_studio.actions import ActionTable
from genmojo_studio.settings import Settings
from genmojo_studio.state import AppState
from genmojo_studio.translate import tr
from genmojo_studio.view3d.orbit import Orbit, Reference, parse
from genmojo_studio.view3d.safe_band import SAFE_DEGREES, degrees_outside
from genmojo_studio.watch.actions import VIEWS
from genmojo_studio.watch.appearance import Appearance
from genmojo_studio.watch.controls import number, row, set_role
from genmojo_studio.watch.view_map import ViewMap

BACKDROP = "view/backdrop"  # in the settings


class ViewPanel(QWidget):
    """Typed numbers move the view, the view moves the numbers.

    Signals: `orbit_wanted(Orbit)`; `backdrop_changed()`, the choice is in the settings under BACKDROP ("" as the theme,
    else "#rrggbb").
    """

    orbit_wanted = Signal(object)
    backdrop_changed = Signal()

    def __init__(
        self, state: AppState, actions: ActionTable, appearance: Appearance, parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self._appearance = appearance
        self._orbit = Orbit()
        self.fields = {
            "elevation": number(-180, 180, "°", 2, 5),
            "azimuth": number(-180, 180, "°", 2, 5),
            "roll": number(-180, 180, "°", 2, 5),
            "radius": number(0.001, 1e6, "", 3, 0.1),
            "fov": number(1, 170, "°", 2, 2),
        }
        titles = (tr("Elevation"), tr("Azimuth"), tr("Roll"), tr("Radius"), tr("Field of view"))
        form = QFormLayout()
        for (name, field), title in zip(self.fields.items(), titles, strict=True):
            form.addRow(title, field)
            field.valueChanged.connect(lambda value, name=name: self._typed(name, value))
            field.clear()  # nothing is known without a scene
        self.map = ViewMap(state)
        self.map.orbit_wanted.connect(self.orbit_wanted)
        self.badge = QLabel()
        self.badge.setWordWrap(True)
        self.splat_scale = QSlider(Qt.Orientation.Horizontal)
        self.splat_scale.setRange(0, 300)
        self.splat_scale.setValue(100)
        self.background = QCheckBox(tr("Background"))
        self.canonical = QCheckBox(tr("Without motion"))
        form.addRow(tr("Splat size"), self.splat_scale)
        form.addRow(self.background, self.canonical)
        self.backdrop = _backdrops()
        self.backdrop.activated.connect(self._choose_backdrop)
        form.addRow(tr("Behind it"), self.backdrop)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(8, 8, 8, 8)
        layout.addLayout(form)
        layout.addWidget(self.map)
        layout.addWidget(self.badge)
        layout.addLayout(_directions(actions))
        layout.addLayout(self._copying())
        layout.addStretch()
        self.splat_scale.valueChanged.connect(self._scale)
        self.background.clicked.connect(lambda: actions.trigger("view.background"))
        self.canonical.clicked.connect(lambda: actions.trigger("view.canonical"))
        appearance.changed.connect(self._show_look)
        self._show_look()
        self._show_backdrop()
        self.setEnabled(False)

    def _copying(self) -> QHBoxLayout:
        copy, paste = QPushButton(tr("Copy")), QPushButton(tr("Paste"))
        copy.setToolTip(tr("Copies these numbers as text"))
        copy.clicked.connect(lambda: QGuiApplication.clipboard().setText(self._orbit.text()))
        paste.clicked.connect(self._paste)
        return row(copy, paste)

    def show_orbit(self, orbit: Orbit, reference: Reference, supervised: np.ndarray) -> None:
        """Shows where the view is; `supervised` are rows (elevation, azimuth, frame) as in a snapshot."""
        self._orbit = orbit
        self.setEnabled(True)
        values = {
            "elevation": orbit.elevation,
            "azimuth": orbit.azimuth,
            "roll": orbit.roll,
            "radius": reference.radius if orbit.radius is None else orbit.radius,
            "fov": reference.fov if orbit.fov is None else orbit.fov,
        }
        for name, field in self.fields.items():
            field.blockSignals(True)
            field.setValue(values[name])
            field.blockSignals(False)
        self.map.show_view(orbit, supervised)
        text, role = judged(orbit, supervised)
        self.badge.setText(text)
        set_role(self.badge, role)

    def _typed(self, name: str, value: float) -> None:
        changes: dict[str, Any] = {name: value}
        self.orbit_wanted.emit(replace(self._orbit, **changes))

    def _paste(self) -> None:
        try:
            self.orbit_wanted.emit(parse(QGuiApplication.clipboard().text()))
        except GenmojoError as error:
            notify.tell(error, self)

    def _scale(self, value: int) -> None:
        self._appearance.set(replace(self._appearance.look, splat_scale=value / 100), tr("Splat size"), "splat")

    def _choose_backdrop(self) -> None:
        colour = self.backdrop.currentData()
        if colour is None:
            chosen = QColorDialog.getColor(QColor(Settings().text(BACKDROP)), self, tr("The colour behind the scene"))
            colour = chosen.name() if chosen.isValid() else Settings().text(BACKDROP)
        Settings().put(BACKDROP, colour)
        self._show_backdrop()
        self.backdrop_changed.emit()

    def _show_backdrop(self) -> None:
        place = self.backdrop.findData(Settings().text(BACKDROP))
        self.backdrop.setCurrentIndex(place if place >= 0 else self.backdrop.count() - 1)

    def _show_look(self) -> None:
        look = self._appearance.look
        self.splat_scale.blockSignals(True)
        self.splat_scale.setValue(round(look.splat_scale * 100))
        self.splat_scale.blockSignals(False)
        self.background.setChecked(look.show_background)
        self.canonical.setChecked(look.canonical)


def _backdrops() -> QComboBox:
    """What can be behind the scene; the last entry asks."""
    box = QComboBox()
    for text, colour in (
        (tr("As the theme"), ""),
        (tr("Black"), "#000000"),
        (tr("White"), "#ffffff"),
        (tr("Another colour…"), None),
    ):
        box.addItem(text, colour)
    box.setToolTip(tr("The colour behind the scene"))
    return box


def _directions(actions: ActionTable) -> QGridLayout:
    """A button for every named direction."""
    directions = QGridLayout()
    directions.setSpacing(4)
    for i, (name, text, key) in enumerate(VIEWS):
        button = QPushButton(tr(text))
        button.setToolTip(f"{tr(text)} ({key})")
        button.clicked.connect(lambda _=False, name=name: actions.trigger(f"view.{name}"))
        directions.addWidget(button, i // 3, i % 3)
    return directions


def judged(orbit: Orbit, supervised: np.ndarray) -> tuple[str, str]:
    """(sentence, role): how far the view is from the nearest one that had supervision."""
    away = degrees_outside(orbit, supervised)
    if away <= SAFE_DEGREES:
        return tr("Seen: supervision reaches this view."), "good"
    return tr("Not seen: {angle:.0f}° from the nearest supervised view.").format(angle=away), "warn"
