"""Everything drawn over a frame, by one painter: masks, trails, points (`rim.py`: arrows to those outside the view).

Colours and glyphs are those of `colours.py`. Work per frame depends on what is shown, not on how long the clip is; of
thousands of tracks only `DETAILED` get glyphs and trails, the rest are dots.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import lru_cache

import cv2
import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QBrush, QColor, QPainter, QPainterPath, QPen, QPixmap, QPolygonF

from genmojo_core.estimate.masks import Box, Prompt
from genmojo_core.tracks.annotation import CONFIRMED, KEY, UNCERTAIN
from genmojo_core.tracks.model import NONE, OCCLUDED, OUT_OF_VIEW, VISIBLE
from genmojo_studio.annotate.colours import glyph, object_colour, point_colour
from genmojo_studio.annotate.mapping import Mapping

DETAILED = 25  # marks with glyph and trail where there are more than MANY tracks
MANY = 64
FLYING = 800  # dots that are drawn while frames fly by
RADIUS = 6.0
_FAINT = 0.3  # of marks that would hide where another is dragged to
_DARK = QColor(12, 14, 18)


@dataclass(frozen=True)
class Mark:
    """One point as shown: raster xy, state, flags, place of its object in the list, number of the point (both from 0).

    suspicion is 0..1, `proposed` a place that nobody accepted yet.
    """

    track: int
    xy: tuple[float, float]
    state: int
    flags: int
    place: int
    point: int
    suspicion: float = 0.0


@dataclass(frozen=True)
class Ghost:
    """A track beside what stands, another person's or one to come: its label, raster xy (k, 2), state (k,) and index in
    them of the frame shown, colour (r, g, b) 0..255."""

    label: str
    xy: np.ndarray
    state: np.ndarray
    now: int
    colour: tuple[int, int, int] = (255, 255, 255)


@dataclass
class Picture:
    """What the overlay shows of one frame.

    Args:
        marks: points with glyphs, the selected one among them. dots: (n, 2) raster positions of all other points.
        trails: per mark, raster xy (k, 2), state (k,) and index in them of the frame shown.
        contours: per object id, its place in the list and its outlines as closed (m, 2) raster polygons.
        mask_mode: 0 off, 1 outline, 2 filled. selected: track id or None. ghosts: tracks to compare with.
        sketch: boxes and strokes of this frame that wait to be cut out.
    """

    marks: list[Mark] = field(default_factory=list)
    dots: np.ndarray = field(default_factory=lambda: np.zeros((0, 2), np.float32))
    trails: list[tuple[Mark, np.ndarray, np.ndarray, int]] = field(default_factory=list)
    contours: dict[int, tuple[int, list[np.ndarray]]] = field(default_factory=dict)
    mask_mode: int = 1
    selected: int | None = None
    selected_object: int | None = None
    sketch: list[Prompt] = field(default_factory=list)
    ghosts: list[Ghost] = field(default_factory=list)


def contours_of(labels: np.ndarray, places: dict[int, int]) -> dict[int, tuple[int, list[np.ndarray]]]:
    """Outlines of the objects in `places` (id -> place) in a mask (H, W): id -> place and closed raster polygons."""
    found = {}
    for object_id, place in places.items():
        mask = (labels == object_id).astype(np.uint8)
        x, y, w, h = cv2.boundingRect(mask)
        if not w:
            continue
        lines, _ = cv2.findContours(mask[y : y + h, x : x + w], cv2.RETR_CCOMP, cv2.CHAIN_APPROX_SIMPLE)
        shift = np.array([x + 0.5, y + 0.5], np.float32)
        found[object_id] = (place, [line[:, 0].astype(np.float32) + shift for line in lines if len(line) > 2])
    return found


def draw(
    painter: QPainter,
    picture: Picture,
    mapping: Mapping,
    view: QRectF,
    *,
    fine: bool = True,
    dragged: tuple[int, tuple[float, float]] | None = None,
) -> None:
    """Draw everything; `view` is the visible part of the widget.

    `dragged`: a track that is being dragged and its raster position by now. Its mark is left to `draw_held`, and those
    around are faint, so that nothing hides the pixel that it goes to.
    Without `fine` outlines and trails are drawn without smoothing, which costs a third, and of thousands of dots only
    FLYING: for frames that fly by.
    """
    painter.setRenderHint(QPainter.RenderHint.Antialiasing, on=fine)
    if picture.mask_mode:
        _masks(painter, picture, mapping)
    _trails(painter, picture, mapping, fine=fine)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing, on=True)
    if len(picture.dots):
        _dots(painter, picture.dots if fine else picture.dots[:: max(1, len(picture.dots) // FLYING)], mapping)
    for mark in picture.marks:
        if mark.state == NONE:
            continue
        centre = QPointF(*mapping.to_widget(*mark.xy))
        if not view.contains(centre) or (dragged is not None and mark.track == dragged[0]):
            continue
        painter.setOpacity(_FAINT if dragged is not None and _close(centre, mapping, dragged[1]) else 1.0)
        if mark.track == picture.selected:
            draw_mark(painter, mark, centre, selected=True)
        else:
            stamp, half = _stamp(mark, painter.device().devicePixelRatioF())
            painter.drawPixmap(centre - QPointF(half, half), stamp)
    painter.setOpacity(1.0)
    _sketch(painter, picture.sketch, mapping)
    for ghost in picture.ghosts:
        _ghost(painter, ghost, mapping)


def sketch_pen(*, on: bool) -> QPen:
    """How strokes on an object, and those beside it, are drawn."""
    return QPen(QColor(120, 220, 255) if on else QColor(255, 120, 120), 2.5, Qt.PenStyle.SolidLine,
                Qt.PenCapStyle.RoundCap)  # fmt: skip


def _sketch(painter: QPainter, sketch: list[Prompt], mapping: Mapping) -> None:
    """Boxes and strokes that wait."""
    painter.setBrush(Qt.BrushStyle.NoBrush)
    for prompt in sketch:
        if isinstance(prompt, Box):
            painter.setPen(sketch_pen(on=True))
            corners = [QPointF(*mapping.to_widget(*xy)) for xy in ((prompt.x0, prompt.y0), (prompt.x1, prompt.y1))]
            painter.drawRect(QRectF(*corners))
            continue
        painter.setPen(sketch_pen(on=prompt.foreground))
        line = pg.functions.arrayToQPolygonF(*_mapped(prompt.points, mapping))
        painter.drawPolyline(line)
        painter.drawEllipse(line[0], 2.5, 2.5)  # of a click nothing else would be seen


def draw_mark(painter: QPainter, mark: Mark, centre: QPointF, *, selected: bool = False) -> None:
    """A point's glyph: filled where visible, hollow and dashed where occluded, crossed where out of view."""
    radius = RADIUS
    colour = QColor(*point_colour(mark.place, mark.point))
    path = glyph_path(mark.point, radius).translated(centre)
    hidden = mark.state in (OCCLUDED, OUT_OF_VIEW)
    painter.setPen(QPen(_DARK, 3.2))
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.drawPath(path)
    pen = QPen(colour, 2.0)
    if mark.state == OCCLUDED:
        pen.setDashPattern([1.6, 1.4])
    painter.setPen(pen)
    fill = QColor(colour)
    fill.setAlpha(0 if hidden else 70)  # the pixel below must show
    painter.setBrush(QBrush(fill))
    painter.drawPath(path)
    if mark.state == OUT_OF_VIEW:
        r = radius * 0.6
        painter.drawLines([QLineF(centre.x() - r, centre.y() - r, centre.x() + r, centre.y() + r),
                           QLineF(centre.x() - r, centre.y() + r, centre.x() + r, centre.y() - r)])  # fmt: skip
    _badges(painter, mark, centre, radius)
    if selected:
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setPen(QPen(_DARK, 3.6))
        painter.drawEllipse(centre, radius * 2.1, radius * 2.1)
        painter.setPen(QPen(colour.lighter(125), 1.8))
        painter.drawEllipse(centre, radius * 2.1, radius * 2.1)
    _number(painter, mark, centre + QPointF(radius * 1.3, -radius * 1.1), colour.lighter(130))


def _number(painter: QPainter, mark: Mark, at: QPointF, colour: QColor) -> None:
    """The point's number, with a dark rim."""
    text = str(mark.point + 1)
    painter.setPen(QPen(_DARK, 1))
    for shift in ((-1, 0), (1, 0), (0, -1), (0, 1)):
        painter.drawText(at + QPointF(*shift), text)
    painter.setPen(colour)
    painter.drawText(at, text)


def draw_held(painter: QPainter, mark: Mark, origin: QPointF, at: QPointF) -> None:
    """A mark that is being dragged: its ring without anything inside, a line from where it was, and its number."""
    colour = QColor(*point_colour(mark.place, mark.point)).lighter(125)
    painter.setBrush(Qt.BrushStyle.NoBrush)
    ring = glyph_path(mark.point, RADIUS * 0.6).translated(origin)
    for pen in (QPen(_DARK, 3.2), QPen(colour, 1.4)):
        painter.setPen(pen)
        painter.drawPath(ring)
        painter.drawEllipse(at, RADIUS * 2.1, RADIUS * 2.1)
    painter.setPen(QPen(colour, 1.2, Qt.PenStyle.DotLine))
    painter.drawLine(origin, at)
    _number(painter, mark, at + QPointF(RADIUS * 2.2, -RADIUS * 2.0), colour)


def _close(centre: QPointF, mapping: Mapping, xy: tuple[float, float]) -> bool:
    """Whether a mark at a widget position would cover what is near a raster position."""
    away = centre - QPointF(*mapping.to_widget(*xy))
    return math.hypot(away.x(), away.y()) < 5 * RADIUS


def _stamp(mark: Mark, ratio: float) -> tuple[QPixmap, float]:
    """The mark drawn once and kept: text and curves cost far more than copying them. Returns it and half its side."""
    looks = (mark.place % 64, mark.point, mark.state, mark.flags & (KEY | CONFIRMED | UNCERTAIN), mark.suspicion >= 0.5)
    return _stamped(*looks, ratio)


@lru_cache(maxsize=2048)
def _stamped(place: int, point: int, state: int, flags: int, doubtful: bool, ratio: float) -> tuple[QPixmap, float]:
    half = 3.5 * RADIUS
    stamp = QPixmap(round(2 * half * ratio), round(2 * half * ratio))
    stamp.setDevicePixelRatio(ratio)
    stamp.fill(Qt.GlobalColor.transparent)
    painter = QPainter(stamp)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing, on=True)
    draw_mark(painter, Mark(0, (0, 0), state, flags, place, point, 1.0 * doubtful), QPointF(half, half))
    painter.end()
    return stamp, half


def glyph_path(point: int, radius: float) -> QPainterPath:
    """The glyph of a point (from 0) around the origin."""
    path = QPainterPath()
    name = glyph(point)
    if name == "circle":
        path.addEllipse(QPointF(0, 0), radius, radius)
        return path
    if name == "square":
        path.addRect(QRectF(-radius * 0.85, -radius * 0.85, radius * 1.7, radius * 1.7))
        return path
    corners = {"triangle": 3, "diamond": 4, "star": 10}[name]
    points = []
    for k in range(corners):
        reach = radius * (1.15 if name != "star" or k % 2 == 0 else 0.5)
        angle = -math.pi / 2 + 2 * math.pi * k / corners
        points.append(QPointF(reach * math.cos(angle), reach * math.sin(angle)))
    path.addPolygon(QPolygonF(points))
    path.closeSubpath()
    return path


def _badges(painter: QPainter, mark: Mark, centre: QPointF, radius: float) -> None:
    """White middle: a person's key. Tick below: confirmed. Question mark: uncertain. Red ring: suspicious."""
    if mark.flags & KEY:
        painter.setPen(QPen(_DARK, 1))
        painter.setBrush(QColor(255, 255, 255))
        painter.drawEllipse(centre, 1.7, 1.7)
    if mark.flags & CONFIRMED and not mark.flags & KEY:
        x, y = centre.x(), centre.y() + radius * 1.6
        for colour, width in ((_DARK, 3.4), (QColor(150, 235, 170), 1.6)):
            painter.setPen(QPen(colour, width))
            painter.drawLines([QLineF(x - 3, y, x - 1, y + 2), QLineF(x - 1, y + 2, x + 3, y - 2)])
    if mark.flags & UNCERTAIN:
        painter.setPen(QPen(QColor(255, 235, 130), 1))
        painter.drawText(centre + QPointF(-radius * 2.3, radius * 0.7), "?")
    if mark.suspicion >= 0.5:
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setPen(QPen(QColor(255, 60, 60), 2.0))
        painter.drawArc(QRectF(centre.x() - radius * 1.6, centre.y() - radius * 1.6, radius * 3.2, radius * 3.2),
                        45 * 16, 270 * 16)  # fmt: skip


def _masks(painter: QPainter, picture: Picture, mapping: Mapping) -> None:
    for object_id, (place, lines) in picture.contours.items():
        path = QPainterPath()
        for line in lines:
            path.addPolygon(pg.functions.arrayToQPolygonF(*_mapped(line, mapping)))
            path.closeSubpath()
        colour = QColor(*object_colour(place))
        chosen = object_id == picture.selected_object
        painter.setPen(QPen(colour, 2.0 if chosen else 1.2))
        fill = QColor(colour)
        fill.setAlpha(70 if picture.mask_mode == 2 else 0)
        painter.setBrush(QBrush(fill) if picture.mask_mode == 2 else Qt.BrushStyle.NoBrush)
        painter.drawPath(path)


def _trails(painter: QPainter, picture: Picture, mapping: Mapping, *, fine: bool) -> None:
    """Past fading in, future thinner; stretches without sight are dashed."""
    painter.setBrush(Qt.BrushStyle.NoBrush)
    for mark, xy, state, now in picture.trails:
        x, y = _mapped(xy, mapping)
        colour = QColor(*point_colour(mark.place, mark.point))
        styles = _styles(state)
        for first, end, alpha, width in ((0, now, 200, 1.8), (now, len(x) - 1, 110, 1.2)):
            colour.setAlpha(alpha)
            for begin, stop, style in _runs(styles, first, end):
                painter.setPen(QPen(colour, width if fine else 1, style))
                painter.drawPolyline(pg.functions.arrayToQPolygonF(x[begin : stop + 1], y[begin : stop + 1]))


def _ghost(painter: QPainter, ghost: Ghost, mapping: Mapping) -> None:
    """A track to compare with: a dotted trail, and a ring with a label, dashed where the point is hidden."""
    own = QColor(*ghost.colour)
    x, y = _mapped(ghost.xy, mapping)
    painter.setBrush(Qt.BrushStyle.NoBrush)
    for colour, width in ((_DARK, 3.6), (own, 1.8)):
        painter.setPen(QPen(colour, width, Qt.PenStyle.DotLine))
        for begin, stop, _ in _runs(_styles(ghost.state), 0, len(x) - 1):
            painter.drawPolyline(pg.functions.arrayToQPolygonF(x[begin : stop + 1], y[begin : stop + 1]))
    state = int(ghost.state[ghost.now])
    if state == NONE:
        return
    centre = QPointF(x[ghost.now], y[ghost.now])
    style = Qt.PenStyle.SolidLine if state == VISIBLE else Qt.PenStyle.DashLine
    for colour, width in ((_DARK, 4.0), (own, 2.0)):
        painter.setPen(QPen(colour, width, style))
        painter.drawEllipse(centre, RADIUS * 1.5, RADIUS * 1.5)
    at = centre + QPointF(RADIUS * 1.8, RADIUS * 2.4)
    painter.setPen(QPen(_DARK, 1))
    for shift in ((-1, 0), (1, 0), (0, -1), (0, 1)):
        painter.drawText(at + QPointF(*shift), ghost.label)
    painter.setPen(own)
    painter.drawText(at, ghost.label)


def _styles(state: np.ndarray) -> list[Qt.PenStyle]:
    """How the stretch from each of n frames to the next is drawn, n - 1 of them."""
    seen, known = state == VISIBLE, state != NONE
    shown = (known[:-1] & known[1:]).astype(int) + (seen[:-1] & seen[1:])
    return [(Qt.PenStyle.NoPen, Qt.PenStyle.DashLine, Qt.PenStyle.SolidLine)[n] for n in shown.tolist()]


def _runs(styles: list[Qt.PenStyle], first: int, end: int) -> Iterator[tuple[int, int, Qt.PenStyle]]:
    """Stretches first..end - 1 put together where they look alike and are drawn: first and last frame, style."""
    begin = first
    for at in range(first + 1, end + 1):
        if at == end or styles[at] != styles[begin]:
            if styles[begin] != Qt.PenStyle.NoPen:
                yield begin, at, styles[begin]
            begin = at


def _dots(painter: QPainter, xy: np.ndarray, mapping: Mapping) -> None:
    painter.setRenderHint(QPainter.RenderHint.Antialiasing, on=False)
    painter.setPen(QPen(QColor(235, 235, 235), 3))
    painter.drawPoints(pg.functions.arrayToQPolygonF(*_mapped(xy, mapping)))
    painter.setRenderHint(QPainter.RenderHint.Antialiasing, on=True)


def _mapped(xy: np.ndarray, mapping: Mapping) -> tuple[np.ndarray, np.ndarray]:
    """Widget x and y of raster positions (n, 2), as float64 rows of their own."""
    points = np.asarray(xy, np.float64)
    return points[:, 0] * mapping.zoom + mapping.dx, points[:, 1] * mapping.zoom + mapping.dy
