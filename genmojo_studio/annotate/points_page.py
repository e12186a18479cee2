"""Step 2: the five key points of every object, templates for them, the trackability of the place under the mouse."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QComboBox, QHBoxLayout, QLabel, QProgressBar, QPushButton, QVBoxLayout, QWidget

from genmojo_core.tracks.edit_tracks import update_track
from genmojo_studio.annotate.session import Session
from genmojo_studio.annotate.track_tree import TrackTree
from genmojo_studio.annotate.trackability import Meter
from genmojo_studio.translate import mark, tr

TEMPLATES: dict[str, tuple[str, ...]] = {
    "free": ("", "", "", "", ""),
    "animal": (mark("left eye"), mark("right eye"), mark("nose"), mark("front paw"), mark("tail")),
    "person": (mark("head"), mark("left hand"), mark("right hand"), mark("left foot"), mark("right foot")),
    "fish": (mark("eye"), mark("mouth"), mark("back fin"), mark("belly fin"), mark("tail")),
    "vehicle": (mark("front left"), mark("front right"), mark("rear left"), mark("rear right"), mark("roof")),
    "box": (mark("corner 1"), mark("corner 2"), mark("corner 3"), mark("corner 4"), mark("centre mark")),
}
_WARNINGS = {
    "off mask": mark("Off the object's mask."),
    "near": mark("Less than 8 px from another point."),
    "flat": mark("Nothing to hold on to: flat."),
    "edge": mark("Only an edge: it slides along."),
}


class PointsPage(QWidget):
    """Which point comes next, what it is called, how good the place is."""

    seed_wanted = Signal()

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self.next = QLabel(wordWrap=True)
        self.tree = TrackTree(session, ("frame",))
        self.template = QComboBox()
        for name in TEMPLATES:
            self.template.addItem(tr(name), name)
        self.template.setAccessibleName(tr("Template of point names"))
        self.meter = QProgressBar(minimum=0, maximum=100, textVisible=False)
        self.meter.setFixedHeight(10)
        self.meter.setAccessibleName(tr("How well the place under the mouse can be followed"))
        self.warning = QLabel(" ", wordWrap=True)
        self.warning.setProperty("role", "warn")
        self.warning.setMinimumHeight(36)
        self.seed = QPushButton(tr("Seed tracks…"))
        self.seed.clicked.connect(self.seed_wanted)
        names, held = QHBoxLayout(), QHBoxLayout()
        names.addWidget(QLabel(tr("Names")))
        names.addWidget(self.template, 1)
        held.addWidget(QLabel(tr("Trackable")))
        held.addWidget(self.meter, 1)
        column = QVBoxLayout(self)
        column.setContentsMargins(8, 6, 8, 6)
        column.addWidget(self.next)
        column.addLayout(names)
        column.addWidget(self.tree, 1)
        column.addLayout(held)
        column.addWidget(self.warning)
        column.addWidget(self.seed)
        self.template.currentIndexChanged.connect(self._rename)
        session.selected.connect(self.refresh)
        session.edited.connect(self.refresh)
        self.refresh()

    def refresh(self, _touched: object = None) -> None:
        """Say what a click does now."""
        session = self._session
        if not session.objects():
            self.next.setText(tr("Choose objects in step 1 first."))
            return
        object_id, number = session.active
        hint = self.point_name(number)
        title = session.title(object_id, number) + ("" if session.track is not None else f" {hint}")
        verb = tr("A click moves {point}.") if session.track is not None else tr("A click places {point}.")
        self.next.setText(verb.format(point=title.strip()))

    def point_name(self, number: int) -> str:
        """The template's name of a point (from 1)."""
        names = TEMPLATES[str(self.template.currentData())]
        return tr(names[number - 1]) if number <= len(names) and names[number - 1] else ""

    def show_meter(self, meter: Meter | None) -> None:
        """The place under the mouse, None where there is none."""
        self.meter.setValue(round(100 * meter.score) if meter else 0)
        self.warning.setText(" ".join(tr(_WARNINGS[w]) for w in meter.warnings[:2]) if meter else " ")

    def _rename(self) -> None:
        """Points of the active object that have no name yet take the template's."""
        session = self._session
        step: int | None = None
        for info in session.annotation.tracks_of(session.active[0]):
            name = self.point_name(info.number)
            if name and name != info.name and not info.locked:
                edit = update_track(session.annotation, info.id, tr("Name points"), session.frame, name=name)
                step = session.do(edit, step)
        self.refresh()
