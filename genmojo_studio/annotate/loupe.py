"""The loupe: four magnified patches beside the mouse that should look alike if a point sits where it did before."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from PySide6.QtCore import QPointF, QRect, QRectF, Qt
from PySide6.QtGui import QColor, QImage, QPainter, QPen

from genmojo_studio.annotate.colours import point_colour
from genmojo_studio.annotate.overlay import RADIUS, glyph_path
from genmojo_studio.annotate.patches import difference, patch
from genmojo_studio.translate import tr

TILE = 148  # widget pixels
_GAP = 4


@dataclass
class Source:
    """A frame (H, W, 4), the raster position whose surroundings are shown, and where the point is in that frame."""

    frame: np.ndarray
    xy: tuple[float, float]
    point: tuple[float, float] | None = None


@dataclass
class Loupe:
    """What the loupe shows: now, the previous key, the first frame, and the difference of now and the key.

    `sources` holds "now", "key" and "first" as far as they are known. `smooth`: bicubic, else pixels are squares.
    `looks`: place of the point's object and its number from 0, which give glyph and colour.
    """

    on: bool = False
    zoom: float = 8.0
    smooth: bool = False
    sources: dict[str, Source] = field(default_factory=dict)
    looks: tuple[int, int] = (0, 0)

    def paint(self, painter: QPainter, area: QRect, mouse: QPointF) -> None:
        """Draw the tiles beside the mouse, on the side with more room."""
        side = 2 * TILE + 3 * _GAP
        x = mouse.x() + 36 if mouse.x() < area.width() / 2 else mouse.x() - 36 - side
        y = mouse.y() - side / 2
        x, y = min(max(x, 4), area.width() - side - 4), min(max(y, 4), area.height() - side - 4)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(10, 11, 13, 235))
        painter.drawRoundedRect(QRectF(x, y, side, side), 6, 6)
        ratio = painter.device().devicePixelRatioF()
        tiles = self._tiles(ratio)
        names = {"now": tr("now") + f"  {self.zoom:.0f}x", "key": tr("previous key"), "first": tr("first frame"),
                 "difference": tr("difference")}  # fmt: skip
        for k, (name, title) in enumerate(names.items()):
            place = QRectF(x + _GAP + (k % 2) * (TILE + _GAP), y + _GAP + (k // 2) * (TILE + _GAP), TILE, TILE)
            self._tile(painter, place, tiles.get(name), title)
            self._point(painter, place, self.sources.get(name))

    def _tiles(self, ratio: float) -> dict[str, np.ndarray]:
        pixels = round(TILE * ratio)
        tiles = {
            name: patch(source.frame, source.xy, (pixels, pixels), self.zoom * ratio, smooth=self.smooth)
            for name, source in self.sources.items()
        }
        if "now" in tiles and "key" in tiles:
            tiles["difference"] = difference(tiles["now"], tiles["key"])
        return tiles

    def _point(self, painter: QPainter, place: QRectF, source: Source | None) -> None:
        """The point's glyph where it is, hollow, so that the pixels below show."""
        if source is None or source.point is None:
            return
        shift = [(p - c) * self.zoom for p, c in zip(source.point, source.xy, strict=True)]
        centre = place.center() + QPointF(*shift)
        if not place.adjusted(RADIUS, RADIUS, -RADIUS, -RADIUS).contains(centre):
            return
        painter.setBrush(Qt.BrushStyle.NoBrush)
        glyph = glyph_path(self.looks[1], RADIUS).translated(centre)
        for colour, thick in ((QColor(0, 0, 0, 150), 3.0), (QColor(*point_colour(*self.looks)), 1.4)):
            painter.setPen(QPen(colour, thick))
            painter.drawPath(glyph)

    def _tile(self, painter: QPainter, place: QRectF, picture: np.ndarray | None, title: str) -> None:
        if picture is None:
            painter.setPen(QColor(150, 155, 165))
            painter.drawText(place, Qt.AlignmentFlag.AlignCenter, "–")
        else:
            height, width = picture.shape[:2]
            painter.drawImage(place, QImage(picture.data, width, height, 4 * width, QImage.Format.Format_RGB32))
            middle = place.center()
            for colour, thick in ((QColor(0, 0, 0, 150), 3.0), (QColor(255, 255, 255), 1.0)):
                painter.setPen(QPen(colour, thick))
                for dx, dy in ((1, 0), (-1, 0), (0, 1), (0, -1)):
                    painter.drawLine(middle + QPointF(4 * dx, 4 * dy), middle + QPointF(14 * dx, 14 * dy))
        label = QRectF(place.x(), place.bottom() - 18, place.width(), 18)
        painter.fillRect(label, QColor(10, 11, 13, 190))
        painter.setPen(QColor(230, 232, 235))
        painter.drawText(label.adjusted(5, 0, 0, 0), Qt.AlignmentFlag.AlignVCenter, title)
