"""A tour of the annotator on a clip made on the spot: a note beside each thing, which goes on when it was tried."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QEvent, QPoint, QRect, Qt, QTimer
from PySide6.QtGui import QColor, QKeyEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QPushButton, QVBoxLayout, QWidget

from genmojo_studio.annotate import steps
from genmojo_studio.annotate.tour_clip import TourClip
from genmojo_studio.annotate.tour_stops import STOPS, Now, Stop
from genmojo_studio.translate import tr

if TYPE_CHECKING:
    from genmojo_studio.annotate.workspace import AnnotateWorkspace

_GAP = 14  # pixels between the note and what it points at
_PRAISE = 900  # ms for which "done" is read before the tour goes on


def begin(workspace: AnnotateWorkspace) -> None:
    """Give the tour on the demo clip; what is open is closed, with everything stored, and comes back afterwards."""
    if workspace.tour is not None:
        workspace.tour.go(0)
    elif workspace.tour_clip is None:
        clip = workspace.tour_clip = TourClip(workspace)

        def ready() -> None:
            if workspace.tour is None and workspace.tour_clip is clip:
                workspace.tour = Tour(workspace, clip)

        clip.open(ready)


class Tour(QFrame):
    """The note that goes from stop to stop; Escape ends it.

    What a stop asks for is done by the person, or by the tour itself if Next is pressed instead.
    """

    def __init__(self, workspace: AnnotateWorkspace, clip: TourClip) -> None:
        super().__init__(workspace)
        self._w, self._clip, self.at = workspace, clip, 0
        self._before: Now | None = None  # how things stood on arrival, None while nothing is asked
        self.setFrameShape(QFrame.Shape.StyledPanel)
        self.setAutoFillBackground(True)
        self.setFixedWidth(360)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.frame = _Frame(workspace)
        self.title, self.text, self.count = QLabel(), QLabel(wordWrap=True), QLabel()
        self.ask = QLabel(wordWrap=True)
        self._praise = QTimer(self, singleShot=True, interval=_PRAISE)
        self._praise.timeout.connect(self._next)
        self._place = QTimer(self, interval=100)  # the window, its panels and their contents may move
        self._place.timeout.connect(self._put)
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
        for label in (self.title, self.text, self.ask):
            column.addWidget(label)
        column.addLayout(row)
        for before, after in ((self.next, self.back), (self.back, self.end)):
            QWidget.setTabOrder(before, after)
        session = workspace.session
        if session is not None:
            for changed in (session.edited, session.selected, session.frame_changed):
                changed.connect(self._look)
        self.go(0)
        self._place.start()

    def go(self, at: int) -> None:
        """Show a stop."""
        session = self._w.session
        if session is None:
            return
        self.at = min(max(at, 0), len(STOPS) - 1)
        stop: Stop = STOPS[self.at]
        self._praise.stop()
        self._before = None
        self._clip.prepare(session, stop.needs)
        if steps.STEPS[self._w.step].name != stop.step:
            self._w.show_step(steps.place_of(stop.step))
        self.title.setText(f"<b>{tr(stop.title)}</b>")
        self.text.setText(tr(stop.text))
        self.ask.setText(f"<i>{tr(stop.ask)}</i>" if stop.ask else "")
        self.ask.setVisible(bool(stop.ask))
        self.count.setText(f"{self.at + 1} / {len(STOPS)}")
        self.back.setEnabled(self.at > 0)
        self.next.setText(tr("Next") if self.at < len(STOPS) - 1 else tr("Done"))
        if stop.done is not None:
            self._before = Now.of(session)
        self.adjustSize()
        self.show()
        self._put()
        (stop.target(self._w) if stop.ask else self.next).setFocus()

    def finish(self) -> None:
        """End the tour: its clip goes, what was open before comes back."""
        before = self._clip.before
        self._w.close_clip()  # which takes this note away
        for _ in self._w.opening(before) if before is not None and before.exists() else ():
            continue

    def vanish(self) -> None:
        """Take the note away."""
        self._w.tour = None
        self._place.stop()
        self._praise.stop()
        for part in (self.frame, self):
            part.hide()
            part.deleteLater()

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

    def _look(self, _what: object = None) -> None:
        """Whether what was asked for has been done."""
        session, done = self._w.session, STOPS[self.at].done
        if self._before is None or session is None or done is None or self._praise.isActive():
            return
        if done(self._before, Now.of(session)):
            self.ask.setText(f"<b>✓ {tr('Done.')}</b>")
            self._praise.start()

    def _put(self) -> None:
        """Beside what the note is about, wherever that is now; in the middle if it is hidden."""
        target = STOPS[self.at].target(self._w)
        area = QRect(target.mapTo(self._w, QPoint(0, 0)), target.size()).intersected(self._w.rect())
        shown = target.isVisibleTo(self._w) and not area.isEmpty()
        self.resize(self.width(), self.sizeHint().height())
        place = (
            self._beside(area, self._dock_of(target) or area)
            if shown
            else self._w.rect().center() - self.rect().center()
        )
        if place != self.pos():
            self.move(place)
        self.frame.show_around(area if shown else None)
        self.raise_()

    def _dock_of(self, target: QWidget) -> QRect | None:
        """The panel that a thing is in: what belongs to it there is not to be covered either."""
        for dock in self._w.docks.values():
            if dock.isAncestorOf(target) and not dock.isFloating():
                return dock.geometry()
        return None

    def _beside(self, area: QRect, around: QRect) -> QPoint:
        """Left of what is around the thing if there is room, else right; else below the thing itself, above it, or
        inside its corner. Always in the window."""
        w, h, room = self.width(), self.height(), self._w.rect()

        def held(x: int, y: int) -> QPoint:
            return QPoint(min(max(x, 4), room.width() - w - 4), min(max(y, 4), room.height() - h - 4))

        places = [held(around.left() - w - _GAP, area.top()), held(around.right() + _GAP, area.top()),
                  held(area.left(), area.bottom() + _GAP), held(area.left(), area.top() - h - _GAP)]  # fmt: skip
        free = (p for p in places if not QRect(p.x(), p.y(), w, h).intersects(area))
        return next(free, held(area.left() + _GAP, area.top() + _GAP))


class _Frame(QWidget):
    """A bright frame around what the note is about; lets every click through."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)

    def show_around(self, area: QRect | None) -> None:
        """Move around an area of the parent; None hides it."""
        if area is None:
            self.hide()
            return
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
