"""The visualisation panel: one frame with everything over it, painted together, so that nothing is ever out of step.

The canvas knows no annotation: it is given a frame and a `Picture`, and says in raster pixels what a person did.
"""

from __future__ import annotations

from enum import Enum

import numpy as np
from PySide6.QtCore import QEvent, QPointF, QRect, QRectF, Qt, QTimer, Signal
from PySide6.QtGui import QColor, QKeyEvent, QMouseEvent, QPainter, QPaintEvent, QPen, QResizeEvent, QWheelEvent
from PySide6.QtWidgets import QWidget

from genmojo_core.tracks.model import NONE
from genmojo_studio.annotate import overlay, rim
from genmojo_studio.annotate.frame_image import FrameImage
from genmojo_studio.annotate.hand import RETICLE, SLACK, Hold, draw_reticle, length
from genmojo_studio.annotate.loupe import Loupe
from genmojo_studio.annotate.mapping import Mapping, View, fitted
from genmojo_studio.annotate.overlay import Mark, Picture
from genmojo_studio.translate import tr

REACH = 12.0  # widget pixels within which a point is grabbed
_SMOOTH_AFTER = 120  # ms without a new frame after which a shrunk frame is drawn without aliasing


class Tool(Enum):
    """What the left button does."""

    POINT = "point"
    BOX = "box"
    SCRIBBLE = "scribble"
    SCRIBBLE_OUT = "scribble out"


class Canvas(QWidget):
    """Frame, overlay, reticle and loupe; emits raster positions."""

    clicked = Signal(float, float)  # place the active point here
    picked = Signal(int)  # track under a click
    sought = Signal(int)  # track whose arrow at the rim was clicked: it wants to be seen
    held = Signal(bool)  # a point is under the pressed button, or no longer
    dragged = Signal(int, float, float)  # track, where it was let go
    toggled = Signal(int)  # right click on a track
    boxed = Signal(float, float, float, float)
    stroked = Signal(object, bool)  # (n, 2) raster points, True on the object
    hovered = Signal(float, float)
    zoomed = Signal(float)
    cycled = Signal(int)  # Tab (1) or Shift+Tab (-1) in the frame

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMinimumSize(200, 120)
        self.setAccessibleName(tr("Frame with points"))
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setCursor(Qt.CursorShape.BlankCursor)
        self.mapping, self.picture, self.loupe = Mapping(), Picture(), Loupe()
        self.tool, self.reticle = Tool.POINT, 18
        self.show_overlay = True
        self.places = False  # whether a click beside another point places one that has no place yet, or picks the other
        self.ghost: tuple[float, float] | None = None  # where snapping would put a click
        self.locked_on: tuple[float, float] | None = None  # raster place held in the middle of the view
        self._frame: np.ndarray | None = None
        self._image: FrameImage | None = None
        self._fit = True
        self._mouse = QPointF(-1, -1)
        self._press: QPointF | None = None
        self._hold: Hold | None = None
        self._arrow: Mark | None = None  # pressed on
        self._pan_from: Mapping | None = None
        self._stroke: list[QPointF] = []
        self._background = QColor("#101113")
        self._calm = QTimer(self)
        self._calm.setSingleShot(True)
        self._calm.setInterval(_SMOOTH_AFTER)
        self._calm.timeout.connect(self.update)

    # ---- what is shown

    def show_frame(self, frame: np.ndarray | None, picture: Picture) -> None:
        """Put a frame (H, W, 4) BGRA and its overlay on show together; None empties the panel."""
        resized = frame is not None and (self._frame is None or self._frame.shape != frame.shape)
        if frame is not self._frame:
            self._frame, self._image = frame, None if frame is None else FrameImage(frame)
            self._calm.start()
        self.picture = picture
        if resized and self._fit:
            self.fit()
        if self.locked_on is not None:
            self.mapping = self.mapping.centred(*self.locked_on, (self.width(), self.height()))
        self.update()

    def set_background(self, colour: str) -> None:
        """Colour around the frame."""
        self._background = QColor(colour)
        self.update()

    def set_reticle(self, size: int) -> None:
        """Length of the reticle's arms in widget pixels, within RETICLE."""
        self.reticle = min(max(size, RETICLE[0]), RETICLE[1])
        self.update()

    def set_overlay(self, on: bool) -> None:
        """Show what is drawn over the frame, or the bare frame."""
        self.show_overlay = on
        self.update()

    def set_tool(self, tool: Tool) -> None:
        """What the left button does from now on."""
        self.tool, self._stroke, self._press = tool, [], None
        self.setCursor(Qt.CursorShape.BlankCursor if tool == Tool.POINT else Qt.CursorShape.CrossCursor)
        self.update()

    def fit(self) -> None:
        """Show the whole frame, and keep doing so when the panel's size changes."""
        self._fit = True
        if self._frame is not None:
            self.mapping = fitted((self._frame.shape[1], self._frame.shape[0]), (self.width(), self.height()))
        self._zoom_changed()

    def centre_on(self, x: float, y: float) -> None:
        """Bring a raster position into the middle of the view, also one beyond the frame."""
        self._fit = False
        self.mapping = self.mapping.centred(x, y, (self.width(), self.height()))
        self._zoom_changed()

    def view(self) -> View:
        """What part of the frame is on show: zoom and the raster position in the middle, None for the whole frame."""
        if self._fit:
            return None
        x, y = self.mapping.to_image(self.width() / 2, self.height() / 2)
        return round(self.mapping.zoom, 6), round(x, 2), round(y, 2)

    def set_view(self, view: View) -> None:
        """Show a part of the frame again that `view` told."""
        if view is None:
            self.fit()
        elif view != self.view():
            self.mapping = Mapping(view[0])
            self.centre_on(view[1], view[2])

    def one_to_one(self) -> None:
        """One raster pixel per widget pixel, around the middle of the view."""
        self.zoom(1.0 / self.mapping.zoom)

    def zoom(self, factor: float, at: QPointF | None = None) -> None:
        """Zoom about a widget position, by default the middle."""
        at = at or QPointF(self.width() / 2, self.height() / 2)
        self._fit = False
        self.mapping = self.mapping.zoomed(factor, at.x(), at.y())
        self._zoom_changed()

    def zoom_step(self, steps: float, at: QPointF | None = None) -> None:
        """Zoom in (1) or out (-1) by a step: the loupe while it is open, else the frame."""
        if self.loupe.on:
            self.loupe.zoom = min(max(self.loupe.zoom * 2 ** (steps / 2), 4.0), 16.0)
            self.update()
        else:
            self.zoom(1.2**steps, at)

    def mouse_raster(self) -> tuple[float, float] | None:
        """Raster position of the mouse, None outside the frame."""
        if self._frame is None or not self.rect().contains(self._mouse.toPoint()):
            return None
        x, y = self.mapping.to_image(self._mouse.x(), self._mouse.y())
        inside = 0 <= x <= self._frame.shape[1] and 0 <= y <= self._frame.shape[0]
        return (x, y) if inside else None

    def dragged_to(self) -> tuple[float, float] | None:
        """Raster position of the point being dragged, None if none is."""
        return self._hold.xy if self._hold is not None else None

    def put_back(self) -> bool:
        """The point that is held goes back to where it was; the button does nothing any more. False if none is."""
        if self._hold is None:
            return False
        self._let_go()
        self._press = self._pan_from = None
        self.update()
        return True

    # ---- painting

    def paintEvent(self, event: QPaintEvent) -> None:
        """Frame, overlay, tools, loupe; only what changed is clipped in."""
        painter = QPainter(self)
        painter.fillRect(event.rect(), self._background)
        if self._frame is None:
            painter.setPen(self.palette().placeholderText().color())
            painter.drawText(self.rect(), Qt.AlignmentFlag.AlignCenter, tr("Open a clip to begin"))
            painter.end()
            return
        if self._image is not None:
            self._image.paint(painter, self.mapping, fine=not self._calm.isActive() and self.width() > 1)
        if self.show_overlay:
            dragged = None if self._hold is None or self._hold.xy is None else (self._hold.mark.track, self._hold.xy)
            overlay.draw(painter, self.picture, self.mapping, QRectF(self.rect()), fine=not self._calm.isActive(),
                         dragged=dragged)  # fmt: skip
            rim.draw(painter, self._arrows(), self.picture.selected)
        self._paint_tools(painter)
        if self.loupe.on:
            self.loupe.paint(painter, self.rect(), self._mouse)
        if self.hasFocus():
            painter.setPen(QPen(self.palette().highlight().color(), 2))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawRect(QRectF(self.rect()).adjusted(1, 1, -1, -1))
        painter.end()

    def _paint_tools(self, painter: QPainter) -> None:
        """Reticle at the mouse, the point being dragged, the snap's target, boxes and strokes."""
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, on=True)
        if self.ghost is not None:
            at = QPointF(*self.mapping.to_widget(*self.ghost))
            painter.setPen(QPen(QColor(90, 255, 160), 1.6, Qt.PenStyle.DashLine))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawEllipse(at, 9, 9)
            painter.drawLine(self._mouse, at)
        painter.setPen(overlay.sketch_pen(on=self.tool != Tool.SCRIBBLE_OUT))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        if self.tool == Tool.BOX and self._press is not None:
            painter.drawRect(QRectF(self._press, self._mouse).normalized())
        elif self._stroke:
            painter.drawPolyline(self._stroke)
        dragged = self.dragged_to()
        if self._hold is not None and dragged is not None:
            at = QPointF(*self.mapping.to_widget(*dragged))
            overlay.draw_held(painter, self._hold.mark, QPointF(*self.mapping.to_widget(*self._hold.mark.xy)), at)
            draw_reticle(painter, at, self.reticle)
        elif self.tool == Tool.POINT and self.underMouse() and self.rect().contains(self._mouse.toPoint()):
            draw_reticle(painter, self._mouse, self.reticle)

    # ---- mouse

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Grab the nearest point, begin a box, a stroke or a pan."""
        self._mouse = event.position()
        if self._hold is not None:
            return
        button = event.button()
        if button == Qt.MouseButton.RightButton:
            near = self._near(event.position())
            if near is not None:
                self.toggled.emit(near.track)
            return
        self._press = event.position()
        if button == Qt.MouseButton.MiddleButton:
            self._pan_from = self.mapping
        elif button == Qt.MouseButton.LeftButton and self.tool == Tool.POINT:
            mark = self._near(event.position())
            self._arrow = rim.hit(self._arrows(), event.position()) if mark is None and self.show_overlay else None
            if mark is not None:
                self._hold = Hold(mark, event.position())
                self.held.emit(True)
        elif button == Qt.MouseButton.LeftButton and self.tool in (Tool.SCRIBBLE, Tool.SCRIBBLE_OUT):
            self._stroke = [event.position()]

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Drag what was grabbed, pan, or show where the mouse is."""
        before, self._mouse = self._mouse, event.position()
        left = bool(event.buttons() & Qt.MouseButton.LeftButton)
        moved = self._press is not None and length(self._mouse - self._press) > SLACK
        if self._hold is not None and not left:
            self.put_back()  # the button was let go where nobody told: in a dialog, or another window
        elif self._hold is not None:
            fine = bool(event.modifiers() & Qt.KeyboardModifier.ShiftModifier)
            self._hold.move(before, self._mouse, self.mapping.zoom, fine=fine)
        elif self._stroke:
            self._stroke.append(event.position())
        elif self._press is not None and moved and self.tool == Tool.POINT:
            self._pan_from = self._pan_from or self.mapping
        if self._pan_from is not None and self._press is not None:
            shift = self._mouse - self._press
            self._fit = False
            self.mapping = self._pan_from.panned(shift.x(), shift.y())
        x, y = self.mapping.to_image(self._mouse.x(), self._mouse.y())
        self.hovered.emit(x, y)
        self._repaint_around(before)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Say what was done."""
        self._mouse = event.position()
        press, hold, stroke, pan, arrow = self._press, self._hold, self._stroke, self._pan_from, self._arrow
        if hold is not None and event.button() != Qt.MouseButton.LeftButton:
            return
        self._let_go()
        self._press, self._stroke, self._pan_from, self._arrow = None, [], None, None
        if press is None or event.button() == Qt.MouseButton.RightButton:
            return
        x, y = self.mapping.to_image(self._mouse.x(), self._mouse.y())
        if self.tool == Tool.BOX:
            x0, y0 = self.mapping.to_image(press.x(), press.y())
            self.boxed.emit(min(x0, x), min(y0, y), max(x0, x), max(y0, y))
        elif stroke:
            points = np.array([self.mapping.to_image(p.x(), p.y()) for p in stroke])
            self.stroked.emit(points, self.tool == Tool.SCRIBBLE)
        elif hold is not None and hold.xy is not None:
            self.dragged.emit(hold.mark.track, *hold.xy)
        elif hold is not None and hold.mark.track != self.picture.selected and not self._places_beside(hold.mark):
            self.picked.emit(hold.mark.track)
        elif arrow is not None and pan is None:
            self.sought.emit(arrow.track)
        elif pan is None and event.button() == Qt.MouseButton.LeftButton:
            self.clicked.emit(*(self.ghost or (x, y)))
        self.update()

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Zoom at the mouse; the loupe's own zoom while it is held."""
        self.zoom_step(event.angleDelta().y() / 120, event.position())
        event.accept()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keep the whole frame in view while nobody zoomed, else the middle where it is."""
        if self._fit:
            self.fit()
        elif event.oldSize().isValid():
            grown = event.size() - event.oldSize()
            self.mapping = self.mapping.panned(grown.width() / 2, grown.height() / 2)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Keys belong to the actions of the workspace."""
        event.ignore()

    def event(self, event: QEvent) -> bool:
        """Tab goes through the points while the keyboard is here; F6 leaves."""
        tabs = {Qt.Key.Key_Tab: 1, Qt.Key.Key_Backtab: -1}
        if event.type() == QEvent.Type.KeyPress and isinstance(event, QKeyEvent) and event.key() in tabs:
            self.cycled.emit(tabs[Qt.Key(event.key())])
            return True
        if event.type() in (QEvent.Type.WindowDeactivate, QEvent.Type.Hide):
            self.put_back()
        return super().event(event)

    def leaveEvent(self, event: object) -> None:
        """No reticle without a mouse."""
        self.update()

    # ---- helpers

    def _near(self, at: QPointF) -> Mark | None:
        """The nearest mark within reach; the selected one wins ties."""
        best, least = None, REACH
        for mark in self.picture.marks if self.show_overlay else []:
            away = length(QPointF(*self.mapping.to_widget(*mark.xy)) - at)
            if mark.state == NONE:
                continue
            if away < least or (best is not None and away == least and mark.track == self.picture.selected):
                best, least = mark, away
        return best

    def _places_beside(self, mark: Mark) -> bool:
        """Whether a click near a point places the active one, which has no place: beside the glyph, not on it."""
        away = length(QPointF(*self.mapping.to_widget(*mark.xy)) - self._mouse)
        return self.places and self.picture.selected is None and away > overlay.RADIUS

    def _let_go(self) -> None:
        if self._hold is not None:
            self._hold = None
            self.held.emit(False)

    def _arrows(self) -> list[rim.Arrow]:
        """Arrows to the points outside the view."""
        return rim.arrows(self.picture.marks, self.mapping, QRectF(self.rect()))

    def _repaint_around(self, before: QPointF) -> None:
        """Repaint what the mouse moved over, or everything where more changes."""
        if self._pan_from is not None or self._stroke or self.loupe.on or self.ghost is not None or self._press:
            self.update()
            return
        reach = self.reticle + 6
        for at in (before, self._mouse):
            self.update(QRect(int(at.x()) - reach, int(at.y()) - reach, 2 * reach, 2 * reach))

    def _zoom_changed(self) -> None:
        self.zoomed.emit(self.mapping.zoom)
        self.update()
