"""The stabilised strip: patches of the active point in the frames around, pinned, so that slips of a pixel show."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QPointF, QRect, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QImage, QMouseEvent, QPainter, QPaintEvent, QPen, QResizeEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from genmojo_core.tracks.annotation import KEY
from genmojo_core.tracks.model import NONE
from genmojo_studio.annotate.patches import patch
from genmojo_studio.annotate.session import Session
from genmojo_studio.translate import tr

REACH = 4  # frames on either side
ZOOM = 4.0


class Strip(QWidget):
    """Nine patches; a click goes to that frame."""

    seek = Signal(int)

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Maximum)
        self.setMinimumHeight(48)
        self.setAccessibleName(tr("Stabilised strip of the active point"))
        session.shown.connect(self._changed)
        session.cache.filled.connect(self._filled)

    def sizeHint(self) -> QSize:
        """One row of patches."""
        return QSize(600, 92)

    def frames(self) -> list[int]:
        """The frames shown, some of them outside the clip."""
        return [self._session.frame + k for k in range(-REACH, REACH + 1)]

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw the patches that are decoded."""
        painter = QPainter(self)
        painter.fillRect(event.rect(), self.palette().window())
        session, track = self._session, self._session.track
        if track is None:
            painter.setPen(self.palette().placeholderText().color())
            painter.drawText(self.rect(), Qt.AlignmentFlag.AlignCenter, tr("The active point has no track yet."))
        else:
            cells = session.annotation.track(track)
            for n, frame in enumerate(self.frames()):
                if 0 <= frame < session.annotation.frames:
                    known = cells.state[frame] != NONE
                    xy = cells.xy[frame] if known else None
                    self._tile(painter, n, frame, xy, key=bool(cells.flags[frame] & KEY))
        painter.end()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """No higher than its patches are wide, and lower in a low window: there the frame comes first."""
        most = min(self.width() / (2 * REACH + 1), self.window().height() / 11)
        self.setMaximumHeight(int(min(max(most, 48), 92)))

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Go to the frame clicked."""
        n = int((event.position().x() - self._left()) // self._side())
        if 0 <= n <= 2 * REACH:
            self.seek.emit(self.frames()[n])

    def _tile(self, painter: QPainter, n: int, frame: int, xy: np.ndarray | None, *, key: bool) -> None:
        side = int(self._side())  # whole pixels: patches are copied, not scaled
        place = QRect(int(self._left()) + n * side + 2, 3, side - 4, side - 4)
        picture = self._session.cache.get(frame)
        if picture is not None and xy is not None:
            ratio = self.devicePixelRatioF()
            pixels = max(round(place.width() * ratio), 1)
            part = patch(picture, (float(xy[0]), float(xy[1])), (pixels, pixels), ZOOM * ratio)
            image = QImage(part.data, pixels, pixels, 4 * pixels, QImage.Format.Format_RGB32)
            image.setDevicePixelRatio(ratio)
            painter.drawImage(place.topLeft(), image)
            middle = QRectF(place).center()
            painter.setPen(QPen(QColor(255, 255, 255, 190), 1))
            for dx, dy in ((1, 0), (-1, 0), (0, 1), (0, -1)):
                painter.drawLine(middle + QPointF(4 * dx, 4 * dy), middle + QPointF(11 * dx, 11 * dy))
        now = frame == self._session.frame
        painter.setBrush(Qt.BrushStyle.NoBrush)
        rim = self.palette().highlight() if now else self.palette().mid()
        painter.setPen(QPen(rim.color(), 2 if now else 1))
        painter.drawRect(place)
        label = f"{frame} ◆" if key else str(frame)
        box = QRect(place.x() + 1, place.bottom() - 14, painter.fontMetrics().horizontalAdvance(label) + 6, 14)
        painter.fillRect(box, QColor(10, 11, 13, 180))
        painter.setPen(QColor(235, 236, 240))
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, label)

    def _side(self) -> float:
        return min(self.height(), self.width() / (2 * REACH + 1))

    def _left(self) -> float:
        return (self.width() - self._side() * (2 * REACH + 1)) / 2

    def show_frame(self) -> None:
        """Another frame is on show."""
        self._changed()

    def _changed(self) -> None:
        if self.isVisible():
            self.update()

    def _filled(self, frame: int) -> None:
        if self.isVisible() and abs(frame - self._session.frame) <= REACH:
            self.update()
