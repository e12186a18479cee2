"""All directions at a glance: which were supervised, how far the others are from them, and where the view is."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QFocusEvent,
    QImage,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QPixmap,
    QPolygonF,
)
from PySide6.QtWidgets import QWidget

from genmojo_studio.state import AppState
from genmojo_studio.theme import colours
from genmojo_studio.translate import tr
from genmojo_studio.view3d.orbit import Orbit
from genmojo_studio.view3d.safe_band import SAFE_DEGREES, degrees_to_supervised
from genmojo_studio.watch.latest import Latest

_CELL = 5  # degrees of one cell of the map
_FAR = 90.0  # degrees from any supervised view, from where it gets no darker
_STEP = 5.0  # degrees that an arrow key turns
_KEYS = {Qt.Key.Key_Left: (0, -1), Qt.Key.Key_Right: (0, 1), Qt.Key.Key_Up: (1, 0), Qt.Key.Key_Down: (-1, 0)}
_SPOT = 2.0  # pixels between points that are drawn
_AXIS = 14  # pixels of the rim with the numbers


class ViewMap(QWidget):
    """Azimuth -180..180 from left to right, elevation 90..-90 from top to bottom.

    Green: within the safe band of a supervised view; amber, ever fainter: far from all. A click, a drag or the arrow
    keys turn the view: `orbit_wanted(Orbit)`.
    """

    orbit_wanted = Signal(object)

    def __init__(self, state: AppState, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._state = state
        self._orbit = Orbit()
        self._supervised = np.zeros((0, 3), np.float32)
        self._away = np.zeros((0, 0))
        self._asked: np.ndarray | None = None  # the supervised views that are on the map or will soon be
        self._latest = Latest(self)
        self._latest.done.connect(self._take)
        self._picture: tuple[tuple[str, QSize, float], QPixmap] | None = None
        self.setMinimumHeight(120)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setAccessibleName(tr("Map of directions"))
        self.setToolTip(
            tr("Every direction: green was supervised or is within {degrees:.0f}° of it, faint is a guess.\n"
               "Points are supervised views, the ring is this view. Click, drag or use the arrow keys to turn.")
            .format(degrees=SAFE_DEGREES)
        )  # fmt: skip
        state.subscribe(self.update, "theme")

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Two to one, as the angles."""
        return QSize(300, 160)

    def show_view(self, orbit: Orbit, supervised: np.ndarray) -> None:
        """Where the view is; `supervised` are rows (elevation, azimuth, frame) as in a snapshot.

        They come on the map a moment later: how far everything is from thousands of views is found on a thread.
        """
        if self._asked is None or not np.array_equal(supervised, self._asked):
            self._asked = np.asarray(supervised)
            wanted, known = self._asked, (self._supervised, self._away)
            self._latest.ask(lambda: (wanted, extended(known, wanted)))
        self._orbit = orbit
        self.update()

    def close_tasks(self) -> None:
        """No more results."""
        self._latest.close()

    def _take(self, found: tuple[np.ndarray, np.ndarray]) -> None:
        self._supervised, self._away = found
        self._picture = None
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """The field, supervised views, the view's own place."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        table, field = colours(self._state.theme), self._field()
        if self._away.size and self.isEnabled():
            painter.drawPixmap(QPointF(0, 0), self._drawn(field))
            self._paint_here(painter, field)
        else:
            painter.fillRect(field, QColor(table.field))
        painter.setPen(QColor(table.line))
        painter.drawRect(field)
        font = painter.font()
        font.setPixelSize(10)
        painter.setFont(font)
        painter.setPen(QColor(table.dim))
        for azimuth in (-180, -90, 0, 90, 180):
            x = _place(field, 0, azimuth).x()
            box = QRectF(min(max(x - 20, 0), self.width() - 40), field.bottom() + 1, 40, _AXIS)
            aligned = {-180: Qt.AlignmentFlag.AlignLeft, 180: Qt.AlignmentFlag.AlignRight}
            painter.drawText(box, aligned.get(azimuth, Qt.AlignmentFlag.AlignHCenter), f"{azimuth}°")
        painter.setPen(QPen(QColor(table.line), 1, Qt.PenStyle.DotLine))
        painter.drawLine(_place(field, 0, -180), _place(field, 0, 180))
        painter.drawLine(_place(field, 90, 0), _place(field, -90, 0))
        if self.hasFocus():
            painter.setPen(QPen(QColor(table.accent), 2))
            painter.drawRect(field)
        painter.end()

    def mousePressEvent(self, event: QMouseEvent) -> None:  # noqa: N802 - Qt's name
        """Turns the view there."""
        self._go(event.position())

    def mouseMoveEvent(self, event: QMouseEvent) -> None:  # noqa: N802 - Qt's name
        """And follows the mouse while a button is down."""
        if event.buttons() & Qt.MouseButton.LeftButton:
            self._go(event.position())

    def keyPressEvent(self, event: QKeyEvent) -> None:  # noqa: N802 - Qt's name
        """Arrow keys turn by five degrees."""
        turn = _KEYS.get(Qt.Key(event.key()))
        if turn is None or event.modifiers():
            super().keyPressEvent(event)
            return
        self.orbit_wanted.emit(self._orbit.turned(_STEP * turn[0], _STEP * turn[1]))

    def focusInEvent(self, event: QFocusEvent) -> None:  # noqa: N802 - Qt's name
        """A frame shows that keys arrive here."""
        super().focusInEvent(event)
        self.update()

    def _field(self) -> QRectF:
        return QRectF(1, 1, self.width() - 2, self.height() - 2 - _AXIS)

    def _go(self, point: QPointF) -> None:
        if self.isEnabled():
            elevation, azimuth = angles_at(self._field(), point)
            self.orbit_wanted.emit(replace(self._orbit, elevation=elevation, azimuth=azimuth))

    def _image(self) -> QImage:
        table = colours(self._state.theme)
        safe, near, far = (_rgb(table.good), _rgb(table.warn), _rgb(table.field))
        share = np.clip((self._away - SAFE_DEGREES) / (_FAR - SAFE_DEGREES), 0, 1)[..., None] ** 0.5
        pixels = np.where(
            self._away[..., None] <= SAFE_DEGREES, safe, 0.75 * near * (1 - share) + far * (share * 0.75 + 0.25)
        )
        pixels = np.ascontiguousarray(pixels.round().astype(np.uint8))
        height, width = pixels.shape[:2]
        return QImage(pixels.data, width, height, 3 * width, QImage.Format.Format_RGB888).copy()

    def _drawn(self, field: QRectF) -> QPixmap:
        """Field and supervised views, kept until one of them, the theme or the size is another."""
        key = (self._state.theme, self.size(), self.devicePixelRatioF())
        if self._picture is None or self._picture[0] != key:
            drawn = QPixmap(self.size() * key[2])
            drawn.setDevicePixelRatio(key[2])
            drawn.fill(Qt.GlobalColor.transparent)
            painter = QPainter(drawn)
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.drawImage(field, self._image())
            pen = QPen(QColor(colours(self._state.theme).text), 3)
            pen.setCapStyle(Qt.PenCapStyle.RoundCap)
            painter.setPen(pen)
            painter.drawPoints(_spots(field, self._supervised))
            painter.end()
            self._picture = (key, drawn)
        return self._picture[1]

    def _paint_here(self, painter: QPainter, field: QRectF) -> None:
        here = _place(field, self._orbit.elevation, self._orbit.azimuth)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        for colour, width in ((QColor("black"), 4), (QColor("white"), 2)):  # seen on every colour
            painter.setPen(QPen(colour, width))
            painter.drawEllipse(here, 6, 6)


def distances(supervised: np.ndarray) -> np.ndarray:  # (36, 72) degrees
    """Angle of every cell's middle to the nearest supervised view, rows from the top down."""
    elevation = np.arange(90 - _CELL / 2, -90, -_CELL)
    azimuth = np.arange(-180 + _CELL / 2, 180, _CELL)
    grid = np.stack(np.meshgrid(elevation, azimuth, indexing="ij"), -1)
    return degrees_to_supervised(grid.reshape(-1, 2), supervised).reshape(grid.shape[:2])


def extended(known: tuple[np.ndarray, np.ndarray], supervised: np.ndarray) -> np.ndarray:
    """`distances(supervised)`; `known`: supervised views and distances that are there already.

    While a run goes on, more views come after those that are known: only they are looked at.
    """
    before, away = known
    if len(before) and away.size and np.array_equal(supervised[: len(before)], before):
        return np.minimum(away, distances(supervised[len(before) :]))
    return distances(supervised)


def angles_at(field: QRectF, point: QPointF) -> tuple[float, float]:
    """(elevation, azimuth) in degrees of a point on the map."""
    across = min(max((point.x() - field.left()) / field.width(), 0.0), 1.0)
    down = min(max((point.y() - field.top()) / field.height(), 0.0), 1.0)
    return 90.0 - 180.0 * down, 360.0 * across - 180.0


def _place(field: QRectF, elevation: float, azimuth: float) -> QPointF:
    return QPointF(
        field.left() + (azimuth + 180.0) / 360.0 * field.width(),
        field.top() + (90.0 - elevation) / 180.0 * field.height(),
    )


def _spots(field: QRectF, supervised: np.ndarray) -> QPolygonF:
    """A point per supervised direction; of those that would lie on each other, within `_SPOT` pixels, one."""
    elevation, azimuth = np.asarray(supervised, np.float64).reshape(-1, 3)[:, :2].T
    across = field.left() + (azimuth + 180.0) / 360.0 * field.width()
    down = field.top() + (90.0 - elevation) / 180.0 * field.height()
    cell = np.round(down / _SPOT) * (field.width() + 2) + np.round(across / _SPOT)
    _, first = np.unique(cell, return_index=True)
    return QPolygonF([QPointF(x, y) for x, y in zip(across[first].tolist(), down[first].tolist(), strict=True)])


def _rgb(colour: str) -> np.ndarray:
    return np.array([int(colour[i : i + 2], 16) for i in (1, 3, 5)], np.float64)
