"""Point tracks drawn over a picture: a mark where the point is, its trail, dashed where it is hidden."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import partial

import numpy as np
from PySide6.QtCore import QLineF, QPointF, Qt
from PySide6.QtGui import QColor, QIcon, QPainter, QPen, QPixmap, QPolygonF

from genmojo_core.clip.cameras import View
from genmojo_core.tracks.model import NONE, OUT_OF_VIEW, VISIBLE, PointTracks
from genmojo_studio.theme import SERIES
from genmojo_studio.watch.track_sets import TrackSet

TRAIL = 12  # frames
_STYLES = {"predicted": 0, "annotated": 1, "imported": 2}
_PALE = 0.4  # of the other tracks, while some are chosen
_BRIGHT = QColor("white")
Chosen = tuple[tuple[str, int], ...]  # (set, row) of tracks: one, and the one that it is compared with
Project = Callable[[PointTracks, int], np.ndarray]  # (tracks, frame) -> (N, 2) widget pixels, NaN where not drawn


def paint(painter: QPainter, sets: Iterable[TrackSet], frame: int, project: Project, selected: Chosen = ()) -> None:
    """Draws the shown sets at a frame; the `selected` tracks last and bright, with a line from one to the next."""
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    bright: dict[tuple[str, int], Callable[[], QPointF | None]] = {}
    painter.setOpacity(_PALE if selected else 1.0)
    for one in sets:
        if not one.shown or not 0 <= frame < one.tracks.state.shape[1]:
            continue
        first = max(0, frame - TRAIL)
        trail = np.stack([project(one.tracks, t) for t in range(first, frame + 1)], axis=1)  # (N, F, 2)
        states = one.tracks.state[:, first : frame + 1]
        for n in range(len(trail)):
            colour = QColor(SERIES[int(one.tracks.object[n]) % len(SERIES)])
            drawn = _Drawn(trail[n], states[n], colour, _STYLES.get(one.kind, 0))
            if (one.name, n) in selected:
                bright[one.name, n] = partial(_paint_track, painter, drawn, True)
            else:
                _paint_track(painter, drawn, False)
    painter.setOpacity(1.0)
    places = [bright[key]() for key in selected if key in bright]
    known = [place for place in places if place is not None]
    painter.setPen(QPen(_BRIGHT, 1.5))
    painter.drawPolyline(QPolygonF(known))


@dataclass(frozen=True)
class _Drawn:
    """One track: (F, 2) widget pixels and (F,) states up to the frame on show, its colour, its origin's mark."""

    trail: np.ndarray
    states: np.ndarray
    colour: QColor
    style: int


def _paint_track(painter: QPainter, drawn: _Drawn, chosen: bool) -> QPointF | None:
    """Trail and mark; where the point is now, if it is anywhere."""
    trail, states = drawn.trail, drawn.states
    if chosen:
        _paint_trail(painter, trail, states, _BRIGHT, 4.5)
    _paint_trail(painter, trail, states, drawn.colour, 2.5 if chosen else 1.3)
    if not np.isfinite(trail[-1]).all() or states[-1] == NONE:
        return None
    at = QPointF(float(trail[-1, 0]), float(trail[-1, 1]))
    if chosen:
        painter.setPen(QPen(_BRIGHT, 2.0))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawEllipse(at, 9.0, 9.0)
    paint_mark(painter, at, int(states[-1]), drawn.style, drawn.colour)
    return at


def mark_of(kind: str, colour: QColor) -> QIcon:
    """The mark of an origin, for lists."""
    picture = QPixmap(14, 14)
    picture.fill(Qt.GlobalColor.transparent)
    painter = QPainter(picture)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    paint_mark(painter, QPointF(7, 7), VISIBLE, _STYLES[kind], colour)
    painter.end()
    return QIcon(picture)


def by_camera(view: View, scale: tuple[float, float], offset: tuple[float, float]) -> Project:
    """Projects 3D tracks by the camera of a view; widget = pixel * scale + offset. Tracks without 3D are not drawn."""

    def project(tracks: PointTracks, frame: int) -> np.ndarray:
        if tracks.xyz is None:
            return np.full((len(tracks.state), 2), np.nan)
        world = tracks.xyz[:, frame].astype(np.float64)
        camera = world @ view.world_to_camera[:3, :3].T + view.world_to_camera[:3, 3]
        depth = np.where(camera[:, 2] > view.near, camera[:, 2], np.nan)
        x = view.fx * camera[:, 0] / depth + view.cx
        y = view.fy * camera[:, 1] / depth + view.cy
        return np.stack([x * scale[0] + offset[0], y * scale[1] + offset[1]], axis=-1)

    return project


def _paint_trail(painter: QPainter, trail: np.ndarray, states: np.ndarray, colour: QColor, width: float) -> None:
    """The way to the present position; the part towards a hidden position is dotted."""
    drawn = np.isfinite(trail).all(axis=-1) & (states != NONE) & (states != OUT_OF_VIEW)
    for style, wanted in ((Qt.PenStyle.SolidLine, True), (Qt.PenStyle.DotLine, False)):
        painter.setPen(QPen(colour, width, style))
        lines = [
            QLineF(*trail[i - 1], *trail[i])
            for i in range(1, len(trail))
            if drawn[i] and drawn[i - 1] and (states[i] == VISIBLE) == wanted
        ]
        painter.drawLines(lines)


def paint_mark(painter: QPainter, at: QPointF, state: int, style: int, colour: QColor) -> None:
    """Disc, square or diamond by origin; hollow where the point is hidden; a dark rim keeps it readable."""
    size, x, y = 3.6, at.x(), at.y()
    painter.setPen(QPen(QColor(0, 0, 0, 190), 1.2) if state == VISIBLE else QPen(colour, 1.6))
    painter.setBrush(colour if state == VISIBLE else Qt.BrushStyle.NoBrush)
    if style == 0:
        painter.drawEllipse(at, size, size)
    elif style == 1:
        painter.drawRect(round(x - size), round(y - size), round(2 * size), round(2 * size))
    else:
        corners = ((0.0, -size), (size, 0.0), (0.0, size), (-size, 0.0))
        painter.drawPolygon(QPolygonF([QPointF(x + dx * 1.3, y + dy * 1.3) for dx, dy in corners]))
