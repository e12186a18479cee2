"""A tour of the annotator on a clip made on the spot: a note beside each thing, with what to try."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from PySide6.QtCore import QEvent, QPoint, QRect, Qt
from PySide6.QtGui import QColor, QKeyEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QPushButton, QVBoxLayout, QWidget

from genmojo_studio.translate import mark, tr

if TYPE_CHECKING:
    from genmojo_studio.annotate.workspace import AnnotateWorkspace


@dataclass(frozen=True)
class Stop:
    """One stop: the step it belongs to (0..3), what it points at, title and text."""

    step: int
    target: Callable[[AnnotateWorkspace], QWidget]
    title: str
    text: str


STOPS = (
    Stop(
        0,
        lambda w: w.bar,
        mark("Four steps"),
        mark(
            "Objects, points, refining, review. Each says what it still lacks. You can "
            "go back at any time: Alt+1 to Alt+4."
        ),
    ),
    Stop(
        0,
        lambda w: w.objects.table,
        mark("Objects"),
        mark(
            "Every mask is a candidate, with size, motion and how often it is "
            "hidden. Select a row and press Choose, or leave it out with a reason."
        ),
    ),
    Stop(
        0,
        lambda w: w.objects.cut,
        mark("More objects"),
        mark(
            "No mask? Draw a box around the object, or click and scribble on "
            "it, then Cut out. It is followed through the clip."
        ),
    ),
    Stop(
        1,
        lambda w: w.canvas,
        mark("Points"),
        mark(
            "Click five points on each object; the next one is chosen for you. Hold Z "
            "for the loupe, Ctrl and an arrow nudge by a quarter of a pixel."
        ),
    ),
    Stop(
        1,
        lambda w: w.points.meter,
        mark("A good place"),
        mark(
            "A corner can be followed, an edge slides, a flat place is lost. "
            "The bar shows it for the place under the mouse."
        ),
    ),
    Stop(
        1,
        lambda w: w.points.seed,
        mark("Seed"),
        mark("A tracker proposes the rest. It never overwrites what you placed."),
    ),
    Stop(
        2,
        lambda w: w.play.sheet,
        mark("Dope sheet"),
        mark(
            "Fill: visible. Hatch: occluded. Diamond: your key. Red: doubtful. "
            "Click to go there, drag to paint a state."
        ),
    ),
    Stop(
        2,
        lambda w: w.canvas,
        mark("Refine"),
        mark(
            "Enter accepts the points of a frame and goes on. Drag a point that is off: "
            "both segments beside it are solved again. Hold Q and step to paint occlusion."
        ),
    ),
    Stop(
        2,
        lambda w: w.refine.queue,
        mark("The queue"),
        mark("N goes to the next most suspicious spot, and says why it is suspicious."),
    ),
    Stop(
        3,
        lambda w: w.review.approve_button,
        mark("Review"),
        mark(
            "Somebody else approves each track, or returns it with a "
            "reason. Everything is stored as you work; Ctrl+Z takes back anything, even tomorrow."
        ),
    ),
)


class Tour(QFrame):
    """The note that goes from stop to stop; Escape ends it."""

    def __init__(self, workspace: AnnotateWorkspace) -> None:
        super().__init__(workspace)
        self._w, self.at = workspace, 0
        self.setFrameShape(QFrame.Shape.StyledPanel)
        self.setAutoFillBackground(True)
        self.setFixedWidth(360)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.frame = _Frame(workspace)
        self.title, self.text, self.count = QLabel(), QLabel(wordWrap=True), QLabel()
        self.setObjectName("tour")
        self.setStyleSheet(
            "#tour { background: palette(window); border: 2px solid rgb(255, 190, 60); border-radius: 6px; }"
        )
        self.count.setProperty("role", "dim")
        self.back, self.next = QPushButton(tr("Back")), QPushButton(tr("Next"))
        self.end = QPushButton(tr("End the tour"))
        self.back.clicked.connect(self._back)
        self.next.clicked.connect(self._next)
        self.end.clicked.connect(self.finish)
        row = QHBoxLayout()
        row.addWidget(self.count)
        row.addStretch()
        for button in (self.end, self.back, self.next):
            row.addWidget(button)
        column = QVBoxLayout(self)
        for label in (self.title, self.text):
            column.addWidget(label)
        column.addLayout(row)
        for before, after in ((self.next, self.back), (self.back, self.end)):
            QWidget.setTabOrder(before, after)
        self.go(0)

    def go(self, at: int) -> None:
        """Show a stop."""
        self.at = min(max(at, 0), len(STOPS) - 1)
        stop: Stop = STOPS[self.at]
        if self._w.step != stop.step:
            self._w.show_step(stop.step)
        self.title.setText(f"<b>{tr(stop.title)}</b>")
        self.text.setText(tr(stop.text))
        self.count.setText(f"{self.at + 1} / {len(STOPS)}")
        self.back.setEnabled(self.at > 0)
        self.next.setText(tr("Next") if self.at < len(STOPS) - 1 else tr("Done"))
        target = stop.target(self._w)
        area = QRect(target.mapTo(self._w, QPoint(0, 0)), target.size())
        self.adjustSize()
        self.move(self._beside(area))
        self.frame.show_around(area)
        self.show()
        self.raise_()
        self.next.setFocus()

    def finish(self) -> None:
        """End the tour."""
        self.frame.deleteLater()
        self.deleteLater()
        self._w.canvas.setFocus()

    def event(self, event: QEvent) -> bool:
        """Escape is the tour's own key while it has the keyboard."""
        override = event.type() == QEvent.Type.ShortcutOverride and isinstance(event, QKeyEvent)
        if override and isinstance(event, QKeyEvent) and event.key() == Qt.Key.Key_Escape:
            event.accept()
            return True
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Escape ends the tour."""
        if event.key() == Qt.Key.Key_Escape:
            self.finish()
        else:
            event.ignore()

    def _next(self) -> None:
        self.finish() if self.at == len(STOPS) - 1 else self.go(self.at + 1)

    def _back(self) -> None:
        self.go(self.at - 1)

    def _beside(self, area: QRect) -> QPoint:
        """Left of the thing if there is room, else right, below, above, or inside its corner; always in the window."""
        gap, w, h = 14, self.width(), self.sizeHint().height()
        room = self._w.rect()
        places = [QPoint(area.left() - w - gap, area.top()), QPoint(area.right() + gap, area.top()),
                  QPoint(area.left(), area.bottom() + gap), QPoint(area.left(), area.top() - h - gap)]  # fmt: skip
        found = next((p for p in places if room.contains(QRect(p.x(), p.y(), w, h))), area.topLeft() + QPoint(gap, gap))
        return QPoint(min(max(found.x(), 4), room.width() - w - 4), min(max(found.y(), 4), room.height() - h - 4))


class _Frame(QWidget):
    """A bright frame around what the note is about; lets every click through."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)

    def show_around(self, area: QRect) -> None:
        """Move around an area of the parent."""
        self.setGeometry(area.adjusted(-4, -4, 4, 4))
        self.show()
        self.raise_()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw the frame."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, on=True)
        painter.setPen(QPen(QColor(255, 190, 60), 3))
        painter.drawRoundedRect(self.rect().adjusted(2, 2, -2, -2), 6, 6)
        painter.end()
