"""Questions before a picture or a turntable is made."""

from __future__ import annotations

from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QSpinBox,
    QWidget,
)

from genmojo_studio.export.request import ExportRequest
from genmojo_studio.translate import tr
from genmojo_studio.watch.controls import number

_MOST_PIXELS = 8192


class PictureDialog(QDialog):
    """Size of a picture of the view, and whether what is behind stays clear."""

    def __init__(self, size: tuple[int, int], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Picture of this view"))
        self.width_field, self.height_field = _pixels(size[0]), _pixels(size[1])
        self.transparent = QCheckBox(tr("Transparent behind the scene"))
        form = QFormLayout(self)
        form.addRow(tr("Width"), self.width_field)
        form.addRow(tr("Height"), self.height_field)
        form.addRow(self.transparent)
        form.addRow(_buttons(self))

    def size_wanted(self) -> tuple[int, int]:
        """(width, height) in pixels."""
        return self.width_field.value(), self.height_field.value()


class TurntableDialog(QDialog):
    """How a turntable turns and what it shows."""

    def __init__(self, elevation: float, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Turntable video"))
        self.seconds = number(0.5, 600, " s", 1, 1)
        self.seconds.setValue(6)
        self.fps = number(1, 120, "", 0, 1)
        self.fps.setValue(24)
        self.degrees = number(-720, 720, "°", 0, 30)
        self.degrees.setValue(360)
        self.elevation = number(-89, 89, "°", 1, 5)
        self.elevation.setValue(elevation)
        self.short_side = _pixels(480)
        self.mode = mode_box()
        self.time = QComboBox()
        for key, text in (
            ("freeze", tr("This frame")),
            ("play", tr("The clip once")),
            ("loop", tr("The clip again and again")),
        ):
            self.time.addItem(text, key)
        self.transparent = QCheckBox(tr("Pictures with a transparent background"))
        form = QFormLayout(self)
        for title, field in (
            (tr("Length"), self.seconds),
            (tr("Pictures a second"), self.fps),
            (tr("Turn"), self.degrees),
            (tr("Elevation"), self.elevation),
            (tr("Short side"), self.short_side),
            (tr("Show"), self.mode),
            (tr("Scene time"), self.time),
        ):
            form.addRow(title, field)
        form.addRow(self.transparent)
        form.addRow(_buttons(self))

    def request(self, scene: str, output: str, frame: int) -> ExportRequest:
        """The job as the form says."""
        return ExportRequest(
            "turntable", scene, output, frame=frame, mode=str(self.mode.currentData()),
            short_side=self.short_side.value(), transparent=self.transparent.isChecked(),
            degrees=self.degrees.value(), seconds=self.seconds.value(), fps=self.fps.value(),
            time_mode=str(self.time.currentData()), elevation=self.elevation.value(),
        )  # fmt: skip


def mode_box() -> QComboBox:
    """A choice of what films show."""
    box = QComboBox()
    for key, text in (
        ("rgb", tr("Colour")),
        ("depth", tr("Depth")),
        ("instance", tr("Objects")),
        ("flow", tr("Motion to the next frame")),
        ("opacity", tr("Coverage")),
        ("normal", tr("Surface direction")),
    ):
        box.addItem(text, key)
    return box


def _pixels(value: int) -> QSpinBox:
    field = QSpinBox()
    field.setRange(16, _MOST_PIXELS)
    field.setValue(value)
    field.setSuffix(" px")
    return field


def _buttons(dialog: QDialog) -> QDialogButtonBox:
    buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Save | QDialogButtonBox.StandardButton.Cancel)
    buttons.accepted.connect(dialog.accept)
    buttons.rejected.connect(dialog.reject)
    return buttons
