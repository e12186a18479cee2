"""A picture with zoom and point tracks over it: the input frame, or input and render joined."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QColor, QImage, QMouseEvent, QPainter, QPaintEvent, QResizeEvent, QWheelEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from genmojo_core.tracks.model import NONE, PointTracks
from genmojo_studio.annotate.mapping import Mapping, fitted
from genmojo_studio.state import AppState
from genmojo_studio.theme import colours
from genmojo_studio.watch import track_overlay
from genmojo_studio.watch.track_overlay import Chosen
from genmojo_studio.watch.track_sets import TrackSet


class Picture(QWidget):
    """Shows (H, W, 3) uint8; wheel zooms, drag moves, double click fits. `pressed(x, y)` in picture pixels."""

    pressed = Signal(float, float)
    swept = Signal(float)  # share of the width under the mouse while the left button is down

    def __init__(self, state: AppState, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._state = state
        self._pixels: np.ndarray | None = None
        self._image: QImage | None = None
        self._mapping = Mapping()
        self._fits = True
        self._dragged: QPointF | None = None
        self._sets: tuple[TrackSet, ...] = ()
        self._selected: Chosen = ()
        self._caption = ""
        self.setMinimumSize(160, 90)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        state.subscribe(self.update, "theme")

    def show_pixels(self, pixels: np.ndarray | None, caption: str = "") -> None:
        """Shows other pixels; the zoom stays where the size does."""
        before = None if self._pixels is None else self._pixels.shape
        self._caption = caption
        self._pixels = None if pixels is None else np.ascontiguousarray(pixels)
        self._image = None
        if self._pixels is not None:
            height, width = self._pixels.shape[:2]
            self._image = QImage(self._pixels.data, width, height, 3 * width, QImage.Format.Format_RGB888)
            if self._fits or before != self._pixels.shape:
                self._fit()
        self.update()

    def show_tracks(self, sets: Iterable[TrackSet], selected: Chosen) -> None:
        """Draws tracks, in source pixels of the clip, over the picture."""
        self._sets, self._selected = tuple(sets), selected
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """The picture, pixels kept apart when enlarged much, and the tracks."""
        table = colours(self._state.theme)
        painter = QPainter(self)
        painter.fillRect(self.rect(), QColor(table.canvas))
        if self._image is not None:
            painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform, self._mapping.zoom < 4)
            x, y = self._mapping.to_widget(0, 0)
            size = self._image.width() * self._mapping.zoom, self._image.height() * self._mapping.zoom
            painter.drawImage(QRectF(x, y, *size), self._image)
            track_overlay.paint(painter, self._sets, self._state.frame, self._place, self._selected)
        if self._caption:
            _caption(painter, self._caption)
        painter.end()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """A picture that was fitted stays so."""
        if self._fits:
            self._fit()

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Zooms about the mouse."""
        at = event.position()
        self._fits = False
        self._mapping = self._mapping.zoomed(1.2 ** (event.angleDelta().y() / 120), at.x(), at.y())
        self.update()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Left chooses a place, middle and right move the picture."""
        self._dragged = event.position()
        if event.button() == Qt.MouseButton.LeftButton:
            self._press(event.position())

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Moves the picture, or sweeps over it."""
        if self._dragged is None:
            return
        if event.buttons() & Qt.MouseButton.LeftButton:
            self._press(event.position())
            return
        moved = event.position() - self._dragged
        self._dragged = event.position()
        self._fits = False
        self._mapping = self._mapping.panned(moved.x(), moved.y())
        self.update()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Ends a drag."""
        self._dragged = None

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """The whole picture again."""
        self._fit()
        self.update()

    def _press(self, at: QPointF) -> None:
        if self._image is None:
            return
        x, y = self._mapping.to_image(at.x(), at.y())
        self.pressed.emit(x, y)
        self.swept.emit(min(max(x / self._image.width(), 0.0), 1.0))

    def _fit(self) -> None:
        self._fits = True
        if self._image is not None:
            size = (float(self._image.width()), float(self._image.height()))
            self._mapping = fitted(size, (float(self.width()), float(self.height())), 4)

    def _place(self, tracks: PointTracks, frame: int) -> np.ndarray:  # (N, 2) widget pixels
        if self._image is None:
            return np.full((len(tracks.state), 2), np.nan)
        scale = np.array([self._image.width() / tracks.size[0], self._image.height() / tracks.size[1]])
        at = tracks.xy[:, frame] * scale * self._mapping.zoom + (self._mapping.dx, self._mapping.dy)
        return np.where((tracks.state[:, frame] != NONE)[:, None], at, np.nan)


def _caption(painter: QPainter, text: str) -> None:
    metrics = painter.fontMetrics()
    width = metrics.horizontalAdvance(text) + 16
    painter.fillRect(6, 6, width, metrics.height() + 8, QColor(0, 0, 0, 165))
    painter.setPen(QColor("#f2f2f2"))
    painter.drawText(14, 10 + metrics.ascent(), text)
