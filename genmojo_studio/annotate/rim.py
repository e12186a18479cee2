"""Points outside the visible part of the frame: arrows with their glyphs at the rim of the view, to be clicked."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QColor, QPainter, QPen, QPolygonF

from genmojo_core.tracks.model import NONE
from genmojo_studio.annotate import overlay
from genmojo_studio.annotate.colours import point_colour
from genmojo_studio.annotate.mapping import Mapping
from genmojo_studio.annotate.overlay import Mark

INSET = 26.0  # widget pixels from the rim to the middle of a glyph
APART = 28.0  # between two of them
REACH = 14.0  # within which a click is one on an arrow
_DARK = QColor(12, 14, 18)


@dataclass(frozen=True)
class Arrow:
    """A point outside the view: its mark, where in the widget its glyph stands, the direction to it (radians)."""

    mark: Mark
    at: QPointF
    angle: float


def arrows(marks: list[Mark], mapping: Mapping, view: QRectF) -> list[Arrow]:
    """One for every mark outside `view`, in its direction as far as others leave room; none in a view without room."""
    inner = view.adjusted(INSET, INSET, -INSET, -INSET)
    found = []
    for mark in marks:
        target = QPointF(*mapping.to_widget(*mark.xy))
        if mark.state != NONE and np.isfinite(mark.xy).all() and not view.contains(target):
            found.append((mark, target))
    if not found or inner.width() < APART or inner.height() < APART:
        return []
    middle = inner.center()
    ways = [(t - middle) for _, t in found]
    length = 2 * (inner.width() + inner.height())
    places = spread(np.array([_along(way, inner) for way in ways]), length, min(APART, length / len(found)))
    spots = [_spot(float(place), inner) for place in places]
    return [
        Arrow(mark, spot, math.atan2(target.y() - spot.y(), target.x() - spot.x()))
        for (mark, target), spot in zip(found, spots, strict=True)
    ]


def spread(places: np.ndarray, length: float, apart: float) -> np.ndarray:
    """Places (n,) on a closed line of a length, moved as little as needed to be `apart` from each other.

    Least squares: places less the room that those before them take must not fall, which pools neighbours that crowd.
    The line is cut open where the widest gap is.
    """
    order = np.argsort(places, kind="stable")
    rising = places[order]
    gaps = np.diff(rising, append=rising[0] + length)
    start = (int(np.argmax(gaps)) + 1) % len(rising)
    order = np.roll(order, -start)
    line = np.roll(rising, -start)
    line = np.where(line < line[0], line + length, line) - apart * np.arange(len(line))
    pools: list[tuple[float, int]] = []
    for value in line.tolist():
        mean, count = value, 1
        while pools and pools[-1][0] > mean:
            before, more = pools.pop()
            mean, count = (before * more + mean * count) / (more + count), more + count
        pools.append((mean, count))
    apart_again = np.repeat([mean for mean, _ in pools], [count for _, count in pools]) + apart * np.arange(len(line))
    moved = np.empty(len(places))
    moved[order] = apart_again % length
    return moved


def draw(painter: QPainter, found: list[Arrow], selected: int | None) -> None:
    """Glyphs as in the frame, each with a triangle in the track's colour that points to where the point is."""
    for arrow in found:
        mark = arrow.mark
        along = QPointF(math.cos(arrow.angle), math.sin(arrow.angle))
        across = QPointF(-along.y(), along.x())
        foot, wide = (15.0, 7.0) if mark.track == selected else (11.0, 6.0)
        corners = [arrow.at + along * (foot + 9), arrow.at + along * foot + across * wide,
                   arrow.at + along * foot - across * wide]  # fmt: skip
        painter.setPen(QPen(_DARK, 1.6))
        painter.setBrush(QColor(*point_colour(mark.place, mark.point)))
        painter.drawPolygon(QPolygonF(corners))
        overlay.draw_mark(painter, mark, arrow.at, selected=mark.track == selected)


def hit(found: list[Arrow], at: QPointF) -> Mark | None:
    """The mark whose arrow a widget position is on, the nearest first."""
    away = [(math.hypot(a.at.x() - at.x(), a.at.y() - at.y()), n) for n, a in enumerate(found)]
    near = min(away, default=(REACH, 0))
    return found[near[1]].mark if near[0] < REACH else None


def _along(way: QPointF, inner: QRectF) -> float:
    """How far along the rectangle's rim, clockwise from its upper left corner, a way from its middle leaves it."""
    half_w, half_h = inner.width() / 2, inner.height() / 2
    share = min(half_w / max(abs(way.x()), 1e-9), half_h / max(abs(way.y()), 1e-9))
    x, y = way.x() * share + half_w, way.y() * share + half_h
    w, h = inner.width(), inner.height()
    if half_w * abs(way.y()) >= half_h * abs(way.x()):
        return x if way.y() < 0 else w + h + (w - x)
    return w + y if way.x() > 0 else 2 * w + h + (h - y)


def _spot(along: float, inner: QRectF) -> QPointF:
    """The place on the rim that is so far along it."""
    corners = [inner.topLeft(), inner.topRight(), inner.bottomRight(), inner.bottomLeft(), inner.topLeft()]
    for (start, end), side in zip(pairwise(corners), 2 * [inner.width(), inner.height()], strict=True):
        if along <= side:
            return start + (end - start) * (along / side)
        along -= side
    return inner.topLeft()
