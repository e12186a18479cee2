"""Small parts that several panels are made of."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDoubleSpinBox, QFrame, QHBoxLayout, QLabel, QScrollArea, QSizePolicy, QWidget


def as_sentence(words: str) -> str:
    """With a capital and a full stop."""
    return f"{words[:1].upper()}{words[1:].rstrip('.')}."


def dim(text: str = "") -> QLabel:
    """A line of secondary text that wraps."""
    label = QLabel(text)
    label.setProperty("role", "dim")
    label.setWordWrap(True)
    return label


def line(text: str = "") -> QLabel:
    """Secondary text of one line, cut where there is no room: for panels that a scroll area fits into its height."""
    label = QLabel(text)
    label.setProperty("role", "dim")
    label.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
    return label


def set_role(label: QWidget, role: str) -> None:
    """Changes what a label says by its colour: "dim", "good", "warn", "bad" or ""."""
    if label.property("role") != role:
        label.setProperty("role", role)
        label.style().unpolish(label)
        label.style().polish(label)


def number(low: float, high: float, suffix: str = "", decimals: int = 1, step: float = 1.0) -> QDoubleSpinBox:
    """A field for a number, which counts once it is typed to its end."""
    box = QDoubleSpinBox()
    box.setRange(low, high)
    box.setDecimals(decimals)
    box.setSingleStep(step)
    box.setSuffix(suffix)
    box.setKeyboardTracking(False)
    return box


def row(*widgets: QWidget, stretch: int = -1) -> QHBoxLayout:
    """Widgets side by side; `stretch` is the position of the one that takes the room, -1 for a gap at the end."""
    layout = QHBoxLayout()
    layout.setContentsMargins(0, 0, 0, 0)
    for i, widget in enumerate(widgets):
        layout.addWidget(widget, 1 if i == stretch else 0)
    if stretch < 0:
        layout.addStretch()
    return layout


def scrolled(inside: QWidget, sideways: bool = False) -> QScrollArea:
    """A panel that scrolls where the window is low; `sideways` too where it is narrow."""
    area = QScrollArea()
    area.setWidgetResizable(True)
    area.setFrameShape(QFrame.Shape.NoFrame)
    area.setWidget(inside)
    if not sideways:
        area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        area.setMinimumWidth(inside.minimumSizeHint().width() + 12)
    return area
