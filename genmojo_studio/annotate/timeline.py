"""The timeline below dope sheet and graphs: the whole clip, what of it is on show, and the frame on show.

Press or drag in the upper lane to go there. The bar in the lower lane is the part that the dope sheet and the graphs
show: drag it to scroll, its ends to zoom. A double click shows the whole clip.
"""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QHelpEvent, QMouseEvent, QPainter, QPaintEvent, QPen, QPixmap, QWheelEvent
from PySide6.QtWidgets import QSizePolicy, QToolTip, QWidget

from genmojo_studio.annotate.session import Session
from genmojo_studio.annotate.sheet_painter import LABEL, stride_ticks
from genmojo_studio.annotate.stride_marks import StrideMarks
from genmojo_studio.annotate.time_view import Axis, TimeView
from genmojo_studio.translate import tr

_LANE, _BAR = 12, 8  # pixels of height of the lane to go in, of the lane of the bar
_END = 6.0  # pixels around an end of the bar that take hold of it
_NOTCH = 120.0


class Timeline(QWidget):
    """Two thin lanes over the width of the dope sheet's cells.

    Args:
        across: left end and width of those cells, pixels of a widget as wide as this one.
    """

    began = Signal()
    seek = Signal(int)

    def __init__(
        self,
        session: Session,
        view: TimeView,
        marks: StrideMarks,
        across: Callable[[], tuple[float, float]],
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self._session, self._view, self._marks, self._across = session, view, marks, across
        self._still: QPixmap | None = None
        self._drawn: Axis | None = None  # what it was drawn for
        self._drag: tuple[str, float, float, float] | None = None  # what is held, frame, first and end when it began
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setMouseTracking(True)
        self.setAccessibleName(tr("Timeline of the whole clip"))
        view.changed.connect(self.update)
        marks.changed.connect(self._forget)
        session.frame_changed.connect(self.update)

    def sizeHint(self) -> QSize:
        """As wide as it may be, and low."""
        return QSize(600, _LANE + _BAR)

    def axis(self) -> Axis:
        """Where the clip's frames are."""
        return Axis(0.0, float(self._view.frames), *self._across())

    def bar(self) -> QRectF:
        """The part on show."""
        axis = self.axis()
        x0, x1 = axis.x_of(self._view.first), axis.x_of(self._view.end)
        return QRectF(x0, _LANE + 1, max(x1 - x0, 8.0), _BAR - 3)

    def paintEvent(self, event: QPaintEvent) -> None:
        """What is on show, and where one is."""
        painter, palette, axis = QPainter(self), self.palette(), self.axis()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, on=True)
        painter.setPen(palette.placeholderText().color())
        first, end = self._view.cells()
        words = tr("{a} to {b} of {n}").format(a=first, b=end - 1, n=self._view.frames)
        painter.drawText(QRectF(8, 0, LABEL - 12, _LANE + _BAR), Qt.AlignmentFlag.AlignVCenter, words)
        if self._still is None or self._drawn != axis:
            self._still, self._drawn = self._make_still(axis), axis
        painter.drawPixmap(0, 0, self._still)
        painter.setPen(Qt.PenStyle.NoPen)
        tint = palette.placeholderText().color() if self._view.whole else palette.highlight().color()
        tint.setAlpha(110 if self._view.whole else 200)
        painter.setBrush(tint)
        painter.drawRoundedRect(self.bar(), 2, 2)
        x = axis.x_of(self._session.frame + 0.5)
        painter.setPen(QPen(palette.highlight().color(), 2))
        painter.drawLine(QPointF(x, 0), QPointF(x, _LANE))
        painter.end()

    def _make_still(self, axis: Axis) -> QPixmap:
        """The lanes and the frames of the stride, which stay while only the frame changes."""
        ratio = self.devicePixelRatioF()
        still = QPixmap(self.size() * ratio)
        still.setDevicePixelRatio(ratio)
        still.fill(Qt.GlobalColor.transparent)
        painter = QPainter(still)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, on=True)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(self.palette().base())
        painter.drawRect(QRectF(axis.left, 1, axis.width, _LANE - 2))
        painter.drawRoundedRect(QRectF(axis.left, _LANE + 1, axis.width, _BAR - 3), 2, 2)
        stride_ticks(painter, axis, self._marks, 3.0, self.palette())
        painter.end()
        return still

    # ---- mouse

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Go there, or take hold of the bar."""
        place = event.position()
        if event.button() == Qt.MouseButton.MiddleButton:
            self._hold("bar", place.x())
        elif event.button() == Qt.MouseButton.LeftButton:
            self._hold(self._under(place), place.x())
            if self._drag is not None and self._drag[0] == "frame":
                self.began.emit()
                self.seek.emit(self._frame(place.x()))

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Go on, scroll or zoom."""
        place = event.position()
        if self._drag is None:
            side = self._under(place) in ("first", "end")
            self.setCursor(Qt.CursorShape.SizeHorCursor if side else Qt.CursorShape.ArrowCursor)
            return
        held, began, first, end = self._drag
        moved = self.axis().frame_at(place.x()) - began
        if held == "frame":
            self.seek.emit(self._frame(place.x()))
        elif held == "bar":
            self._view.scroll(first + moved - self._view.first)
        elif held == "first":
            self._view.show(min(first + moved, end - 1), end)
        else:
            self._view.show(first, max(end + moved, first + 1))

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Let go."""
        self._drag = None

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """The whole clip."""
        self._view.fit()

    def wheelEvent(self, event: QWheelEvent) -> None:
        """On in time; with Ctrl closer, about the mouse."""
        turned = (event.angleDelta().y() or event.angleDelta().x()) / _NOTCH
        if event.modifiers() & Qt.KeyboardModifier.ControlModifier:
            about = min(max(self.axis().frame_at(event.position().x()), self._view.first), self._view.end)
            self._view.zoom(turned, about)
        else:
            self._view.scroll(-turned * self._view.span / 8)
        event.accept()

    def changeEvent(self, event: QEvent) -> None:
        """Other colours, another picture."""
        super().changeEvent(event)
        self._forget()

    def event(self, event: QEvent) -> bool:
        """Tool tips that tell the frame."""
        if event.type() == QEvent.Type.ToolTip and isinstance(event, QHelpEvent):
            QToolTip.showText(event.globalPos(), self._words(QPointF(event.pos())), self)
            return True
        return super().event(event)

    # ---- helpers

    def _forget(self) -> None:
        self._still = None
        self.update()

    def _words(self, place: QPointF) -> str:
        if place.x() < LABEL:
            return tr("The frames that the dope sheet and the graphs show.")
        if place.y() >= _LANE:
            return tr("Drag the bar to scroll, its ends to zoom; a double click shows the whole clip.")
        return f"{tr('frame')} {self._frame(place.x())}"

    def _under(self, place: QPointF) -> str:
        """What a press takes hold of: "frame", an end of the bar ("first", "end"), or the "bar"."""
        bar = self.bar()
        if place.y() < _LANE:
            return "frame"
        if abs(place.x() - bar.left()) <= _END and bar.width() > 3 * _END:
            return "first"
        if abs(place.x() - bar.right()) <= _END:
            return "end"
        return "bar"

    def _hold(self, what: str, x: float) -> None:
        at = self.axis().frame_at(x)
        if what == "bar" and not self._view.first <= at <= self._view.end:  # beside it: it comes there
            self._view.scroll(at - self._view.span / 2 - self._view.first)
        self._drag = (what, at, self._view.first, self._view.end)

    def _frame(self, x: float) -> int:
        return min(max(int(self.axis().frame_at(x)), 0), self._view.frames - 1)
