"""Step 2: the five key points of every object, templates for them, the trackability of the place under the mouse."""

from __future__ import annotations

from dataclasses import replace

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QComboBox, QHBoxLayout, QLabel, QLineEdit, QProgressBar, QPushButton, QVBoxLayout, QWidget

from genmojo_core.sentences import say
from genmojo_core.tracks.edit_tracks import update_track
from genmojo_core.tracks.edits import set_meta
from genmojo_studio.annotate.session import Session
from genmojo_studio.annotate.track_tree import TrackTree
from genmojo_studio.annotate.trackability import Meter
from genmojo_studio.translate import mark, tr

TITLES = {
    "free": mark("free names"),
    "animal": mark("an animal"),
    "person": mark("a person"),
    "fish": mark("a fish"),
    "vehicle": mark("a vehicle"),
    "box": mark("a box"),
}
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
            self.template.addItem(tr(TITLES[name]), name)
        self.template.setAccessibleName(tr("Template of point names"))
        self.template.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.template.setMinimumContentsLength(8)
        self.name = QLineEdit(maxLength=60)
        self.name.setPlaceholderText(tr("name of the point"))
        self.name.setAccessibleName(tr("Name of the active point"))
        self.name.editingFinished.connect(self._take_name)
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
        names.addWidget(self.name, 1)
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
        self.template.currentIndexChanged.connect(self._take_template)
        session.selected.connect(self.refresh)
        session.edited.connect(self.refresh)
        session.frame_changed.connect(self._frame_changed)
        self.refresh()

    def refresh(self, _touched: object = None) -> None:
        """Say what a click does now."""
        session = self._session
        if not session.objects():
            self.next.setText(tr("Choose objects in step 1 first."))
            return
        object_id, number = session.active
        with QSignalBlocker(self.template):
            self.template.setCurrentIndex(self.template.findData(self._template()))
        named = session.annotation.tracks.get(session.track or 0)
        self.name.setEnabled(named is not None and not named.locked)
        if not self.name.isModified():
            self.name.setText(named.name if named is not None else "")
        hint = self.point_name(number)
        title = session.title(object_id, number) + ("" if session.track is not None else f" {hint}")
        moves = tr("{point} has its place: drag it or click beside it to move it.")
        verb = moves if session.track is not None else tr("A click places {point}.")
        sentences = [verb.format(point=title.strip())]
        first = session.first_frame(object_id)
        if session.track is None and session.frame != first:
            sentences.append(tr("The object is seen from frame {n} on: this track would start late.").format(n=first)
                             if session.frame > first else
                             tr("The object is first seen in frame {n}.").format(n=first))  # fmt: skip
        if session.placed is not None and session.nudged is not None:
            sentences.append(tr("Ctrl and an arrow nudge {point}.").format(point=session.title(*session.placed)))
        self.next.setText(" ".join(sentences))

    def showEvent(self, event: QShowEvent) -> None:
        """Made up to date when it is looked at."""
        super().showEvent(event)
        self.refresh()

    def _frame_changed(self, _frame: int) -> None:
        if self.isVisible():
            self.refresh()

    def point_name(self, number: int) -> str:
        """The template's name of a point (from 1)."""
        return _template_name(self._template(), number)

    def show_meter(self, meter: Meter | None) -> None:
        """The place under the mouse, None where there is none."""
        self.meter.setValue(round(100 * meter.score) if meter else 0)
        self.warning.setText(" ".join(tr(_WARNINGS[w]) for w in meter.warnings[:2]) if meter else " ")

    def _template(self) -> str:
        """The template of the active object."""
        chosen = self._session.annotation.meta.get(_key(self._session.active[0]), "free")
        return chosen if chosen in TEMPLATES else "free"

    def _take_template(self) -> None:
        """The active object gets a template: its points without a name, or with the old template's, take the new one's.

        Names that a person typed stay.
        """
        session, old, new = self._session, self._template(), str(self.template.currentData())
        edit = set_meta(session.annotation, _key(session.active[0]), new)
        step = session.do(replace(edit, title=say("name_points")))
        for info in session.annotation.tracks_of(session.active[0]) if step is not None else ():
            name = _template_name(new, info.number)
            if info.name in ("", _template_name(old, info.number)) and name != info.name and not info.locked:
                edit = update_track(session.annotation, info.id, say("name_points"), session.frame, name=name)
                session.do(edit, step)
        self.refresh()

    def _take_name(self) -> None:
        """The active point is called what a person typed."""
        session, track = self._session, self._session.track
        self.name.setModified(False)
        name = self.name.text().strip()
        if track is not None and name != session.annotation.tracks[track].name:
            session.do(update_track(session.annotation, track, say("name_points"), session.frame, name=name))
        self.refresh()


def _key(object_id: int) -> str:
    """The note of the project that keeps an object's template."""
    return f"template_{object_id}"


def _template_name(template: str, number: int) -> str:
    """What a template calls a point (from 1), "" for those beyond its names."""
    names = TEMPLATES[template]
    return tr(names[number - 1]) if number <= len(names) and names[number - 1] else ""
