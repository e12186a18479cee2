"""The dope sheet: every track's state in every frame at a glance. Click to go there, drag to paint a state.

Ctrl+wheel zooms in time, Shift+wheel or the middle button scrolls in it, a double click shows the whole clip; the
right button asks what to do. What the signs mean stands in `sheet_painter.py`, and in the legend for people.
"""

from __future__ import annotations

import math

from PySide6.QtCore import QEvent, QPoint, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QContextMenuEvent,
    QFocusEvent,
    QHelpEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QPixmap,
    QResizeEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QAbstractScrollArea, QToolTip, QWidget

from genmojo_core.tracks.annotation import Touched
from genmojo_studio.annotate.session import Session
from genmojo_studio.annotate.sheet_order import ordered
from genmojo_studio.annotate.sheet_painter import LABEL, MARKED, ROW, RULER, SheetPainter
from genmojo_studio.annotate.sheet_words import describe_cell, describe_row
from genmojo_studio.annotate.stride_marks import StrideMarks
from genmojo_studio.annotate.time_view import Axis, TimeView
from genmojo_studio.translate import tr

_DRAG = 4  # pixels that a press moves before it is more than a click
_NOTCH = 120.0  # of a wheel, in eighths of a degree


class DopeSheet(QAbstractScrollArea):
    """Rows of tracks over columns of frames."""

    began = Signal()  # a press, before it chooses or goes anywhere
    seek = Signal(int)
    picked = Signal(int)
    painted = Signal(int, int, int)  # track, first and last frame
    asked = Signal(int, int, QPoint)  # track, frame and place on the screen of a right click

    def __init__(self, session: Session, view: TimeView, marks: StrideMarks, parent: QWidget | None = None) -> None:
        self._still: QPixmap | None = None
        super().__init__(parent)
        self._session, self.view = session, view
        self.order = "object"  # of `ORDERS`
        self._rows: list[int] = []
        self._painter = SheetPainter(session, marks)
        self._press: tuple[int, int, QPointF] | None = None  # track, frame, place of a press that may paint
        self._pan: tuple[QPointF, float, int] | None = None  # place, first frame and row when panning began
        self._at = 0
        self._ruler = False
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setAccessibleName(tr("Dope sheet: states of all points over time"))
        self.setMinimumHeight(RULER + 2 * ROW)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.verticalScrollBar().valueChanged.connect(self._dirty)
        view.changed.connect(self._dirty)
        marks.changed.connect(self._dirty)
        session.edited.connect(self._edited)
        session.selected.connect(self._chosen)
        session.settings_changed.connect(self.viewport().update)
        session.frame_changed.connect(self.viewport().update)
        session.cache.filled.connect(self._ring_changed)
        self.viewport().setMouseTracking(True)
        self._known: dict[int, tuple[int, int]] = {}  # object and number of every row
        self._sort()
        self._dirty()

    def sizeHint(self) -> QSize:
        """Room for a dozen rows."""
        return QSize(900, RULER + 12 * ROW)

    def rows(self) -> list[int]:
        """Track ids from top to bottom."""
        return list(self._rows)

    def set_order(self, order: str) -> None:
        """Sort the rows, one of `ORDERS`; they stay so while keys are placed, until they are sorted again."""
        self.order = order
        self._sort()
        self._chosen()

    def refresh(self, _what: object = None) -> None:
        """Suspicion has changed."""
        self._painter.forget()
        if self.order == "suspicion":
            self._sort()
        self._dirty()

    # ---- geometry

    def axis(self) -> Axis:
        """Where the frames on show are."""
        return Axis(self.view.first, self.view.span, LABEL, max(self.viewport().width() - LABEL - 6, 1))

    def frame_at(self, x: float) -> int:
        """Frame under a viewport x, the nearest on show where none is there."""
        first, end = self.view.cells()
        return min(max(int(self.axis().frame_at(x) // 1), first), end - 1)

    def x_of(self, frame: float) -> float:
        """Viewport x of a frame's left edge."""
        return self.axis().x_of(frame)

    def row_at(self, y: float) -> int | None:
        """Place in `rows` under a viewport y, None on the ruler or below all rows."""
        row = int((y - RULER) // ROW) + self.verticalScrollBar().value()
        return row if y >= RULER and row < len(self._rows) else None

    # ---- painting

    def paintEvent(self, event: QPaintEvent) -> None:
        """Ruler, pattern, keys, selection and playhead."""
        if self._still is None:
            self._still = self._make_still()
        painter, axis = QPainter(self.viewport()), self.axis()
        painter.drawPixmap(0, 0, self._still)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, on=True)
        self._painter.over(painter, axis)
        self._paint_brush(painter, axis)
        x = axis.x_of(self._session.frame + 0.5)
        if axis.left <= x <= axis.left + axis.width:
            painter.setPen(QPen(self.palette().highlight().color(), 2))
            painter.drawLine(QPointF(x, 12), QPointF(x, self.viewport().height()))
        if not self._rows:
            painter.setPen(self.palette().placeholderText().color())
            area = QRectF(LABEL, RULER, axis.width, ROW * 3)
            painter.drawText(area, Qt.AlignmentFlag.AlignCenter, tr("No points yet: place them in step 2."))
        if self.hasFocus():
            painter.setPen(QPen(self.palette().highlight().color(), 2))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawRect(QRectF(self.viewport().rect()).adjusted(1, 1, -1, -1))
        painter.end()

    def _make_still(self) -> QPixmap:
        """All that stays while only the frame changes."""
        ratio, axis = self.devicePixelRatioF(), self.axis()
        still = QPixmap(self.viewport().size() * ratio)
        still.setDevicePixelRatio(ratio)
        still.fill(self.palette().base().color())
        painter = QPainter(still)
        painter.setFont(self.font())
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, on=True)
        painter.setClipRect(QRectF(LABEL, RULER, axis.width, self.viewport().height()))
        for n, track in enumerate(self._shown()):
            self._painter.row(painter, track, RULER + n * ROW, axis, self.palette())
        painter.setClipping(False)
        for n, track in enumerate(self._shown()):
            self._painter.label(painter, track, RULER + n * ROW, self.palette())
        self._painter.ruler(painter, axis, self.palette())
        painter.end()
        return still

    def _paint_brush(self, painter: QPainter, axis: Axis) -> None:
        """What is being painted now, here by dragging or by a key held down."""
        painting = self._session.painting
        if self._press is not None and self._at != self._press[1]:
            track, run = self._press[0], sorted((self._press[1], self._at))
        elif painting is not None:
            track, run = painting.track, list(painting.run())
        else:
            return
        if track not in self._rows:
            return
        row = self._rows.index(track)
        y = RULER + (row - self.verticalScrollBar().value()) * ROW
        x0, x1 = (min(max(axis.x_of(f), LABEL), LABEL + axis.width) for f in (run[0], run[1] + 1))
        tint = QColor(MARKED)
        tint.setAlpha(130)
        painter.fillRect(QRectF(x0, y, x1 - x0, ROW), tint)

    # ---- mouse

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Left: begin to scrub on the ruler, else take the cell. Middle, or Shift and left: pan."""
        place, left = event.position(), event.button() == Qt.MouseButton.LeftButton
        if event.button() == Qt.MouseButton.MiddleButton or (left and event.modifiers() & _SHIFT):
            self._pan = (place, self.view.first, self.verticalScrollBar().value())
            self.viewport().setCursor(Qt.CursorShape.ClosedHandCursor)
            return
        if not left:
            self._press = None  # any other button gives up what is being painted
            self.viewport().update()
            return
        frame, row = self.frame_at(place.x()), self.row_at(place.y())
        self._ruler = place.y() < RULER and place.x() >= LABEL
        self.began.emit()
        if row is not None:
            self.picked.emit(self._rows[row])
            if place.x() >= LABEL:
                self._press, self._at = (self._rows[row], frame, place), frame
        if self._ruler or (row is not None and place.x() >= LABEL):
            self.seek.emit(frame)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Scrub, paint or pan while a button is down, else say what is there."""
        place = event.position()
        frame = self.frame_at(place.x())
        if self._pan is not None:
            self._panned(place)
            return
        beyond = place.x() - min(max(place.x(), LABEL), self.x_of(self.view.end))
        if beyond and (self._ruler or self._press is not None):  # a drag past the edge takes the view along
            self.view.scroll(math.copysign(self.view.span / 40, beyond))
        if self._ruler:
            self.seek.emit(frame)
        elif self._press is not None:
            far = (place - self._press[2]).manhattanLength() >= _DRAG
            self._at = frame if far or self._at != self._press[1] else self._at
            self.viewport().update()
        elif QToolTip.isVisible():
            self._tell(event.globalPosition().toPoint(), place)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """A drag paints."""
        if self._pan is not None:
            self._pan = None
            self.viewport().unsetCursor()
            return
        if event.button() != Qt.MouseButton.LeftButton:
            return
        press, self._press, self._ruler = self._press, None, False
        if press is not None and self._at != press[1]:
            self.painted.emit(press[0], *sorted((press[1], self._at)))
        self.viewport().update()

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """The whole clip again."""
        if event.button() == Qt.MouseButton.LeftButton:
            self._press = None
            self.view.fit()

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        """What can be done there, or with the active point's row where the keyboard asks."""
        place = event.pos()
        if event.reason() == QContextMenuEvent.Reason.Keyboard and self._session.track in self._rows:
            row = self._rows.index(self._session.track)
            place = QPoint(round(self.x_of(self._session.frame + 0.5)),
                           RULER + ROW * (row - self.verticalScrollBar().value()) + ROW // 2)  # fmt: skip
        found = self.row_at(place.y())
        if found is not None:
            frame = self.frame_at(place.x()) if place.x() >= LABEL else self._session.frame
            self.asked.emit(self._rows[found], frame, self.viewport().mapToGlobal(place))
        event.accept()

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Rows up and down; with Ctrl closer in time about the mouse, with Shift (or sideways) on in time."""
        up, side = event.angleDelta().y() / _NOTCH, event.angleDelta().x() / _NOTCH
        if event.modifiers() & Qt.KeyboardModifier.ControlModifier:
            axis = self.axis()
            x = min(max(event.position().x(), axis.left), axis.left + axis.width)
            self.view.zoom(up or side, axis.frame_at(x))
        elif event.modifiers() & _SHIFT or abs(side) > abs(up):
            self.view.scroll(-(up or side) * self.view.span / 8)
        else:
            bar = self.verticalScrollBar()
            bar.setValue(bar.value() - int(math.copysign(math.ceil(abs(2 * up)), up)))
        event.accept()

    def viewportEvent(self, event: QEvent) -> bool:
        """Tool tips of the cells."""
        if event.type() == QEvent.Type.ToolTip and isinstance(event, QHelpEvent):
            self._tell(event.globalPos(), QPointF(event.pos()))
            return True
        return super().viewportEvent(event)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Another width, another pattern."""
        self._dirty()

    # ---- helpers

    def words_at(self, place: QPointF) -> str:
        """What stands at a place of the viewport, in words."""
        row = self.row_at(place.y())
        if row is None:
            return ""
        track = self._rows[row]
        if place.x() < LABEL:
            return describe_row(self._session, track)
        return describe_cell(self._session, track, self.frame_at(place.x()))

    def _tell(self, on_screen: QPoint, place: QPointF) -> None:
        words = self.words_at(place)
        if words:
            QToolTip.showText(on_screen, words, self.viewport())
        else:
            QToolTip.hideText()

    def _panned(self, place: QPointF) -> None:
        if self._pan is None:
            return
        began, first, row = self._pan
        self.view.scroll(first - (place.x() - began.x()) / self.axis().wide - self.view.first)
        self.verticalScrollBar().setValue(row - round((place.y() - began.y()) / ROW))

    def _visible(self) -> int:
        """Rows that are wholly on show."""
        return max(1, (self.viewport().height() - RULER) // ROW)

    def _shown(self) -> list[int]:
        first = self.verticalScrollBar().value()
        return self._rows[first : first + self._visible() + 1]

    def _edited(self, touched: Touched) -> None:
        self._painter.forget(touched.tracks)
        if touched.objects:  # their order gives the colours
            self._painter.forget()
        if touched.objects or any(self._changed_place(track) for track in touched.tracks):
            self._sort()
        self._dirty()

    def _changed_place(self, track: int) -> bool:
        """Whether a track came, went, or became another point."""
        info = self._session.annotation.tracks.get(track)
        return self._known.get(track) != (None if info is None else (info.object, info.number))

    def _sort(self) -> None:
        self._rows = ordered(self._session, self.order)
        tracks = self._session.annotation.tracks
        self._known = {track: (tracks[track].object, tracks[track].number) for track in self._rows}

    def _chosen(self) -> None:
        """The active point's row comes into view."""
        track, bar = self._session.track, self.verticalScrollBar()
        if track in self._rows:
            row = self._rows.index(track)
            if row < bar.value():
                bar.setValue(row)
            elif row > bar.value() + self._visible():
                bar.setValue(row - self._visible() + 1)
        self._dirty()

    def _dirty(self, _what: object = None) -> None:
        self.verticalScrollBar().setPageStep(self._visible())
        self.verticalScrollBar().setRange(0, max(0, len(self._rows) - self._visible()))
        self._still = None
        self.viewport().update()

    def focusInEvent(self, event: QFocusEvent) -> None:
        """Show that the keyboard is here."""
        self.viewport().update()

    def focusOutEvent(self, event: QFocusEvent) -> None:
        """And that it is not."""
        self.viewport().update()

    def changeEvent(self, event: QEvent) -> None:
        """Other colours, another picture."""
        super().changeEvent(event)
        if event.type() in (QEvent.Type.PaletteChange, QEvent.Type.StyleChange, QEvent.Type.FontChange):
            self._still = None
            self.viewport().update()

    def _ring_changed(self, _frame: int) -> None:
        self.viewport().update(0, 20, self.viewport().width(), 8)


_SHIFT = Qt.KeyboardModifier.ShiftModifier
