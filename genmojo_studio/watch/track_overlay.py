"""Point tracks drawn over a picture: a mark where the point is, its trail, dashed where it is hidden."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np
from PySide6.QtCore import QLineF, QPointF, Qt
from PySide6.QtGui import QColor, QPainter, QPen, QPolygonF

from genmojo_core.clip.cameras import View
from genmojo_core.tracks.model import NONE, OUT_OF_VIEW, VISIBLE, PointTracks
from genmojo_studio.theme import SERIES
from genmojo_studio.watch.track_sets import TrackSet

TRAIL = 12  # frames
_STYLES = {"predicted": 0, "annotated": 1, "imported": 2}
Project = Callable[[PointTracks, int], np.ndarray]  # (tracks, frame) -> (N, 2) widget pixels, NaN where not drawn


def paint(
    painter: QPainter, sets: Iterable[TrackSet], frame: int, project: Project, selected: tuple[str, int] | None = None
) -> None:
    """Draws the shown sets at a frame; `selected` (set, row) is drawn thicker."""
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    for one in sets:
        if not one.shown or not 0 <= frame < one.tracks.state.shape[1]:
            continue
        first = max(0, frame - TRAIL)
        trail = np.stack([project(one.tracks, t) for t in range(first, frame + 1)], axis=1)  # (N, F, 2)
        states = one.tracks.state[:, first : frame + 1]
        for n in range(len(trail)):
            colour = QColor(SERIES[int(one.tracks.object[n]) % len(SERIES)])
            chosen = selected == (one.name, n)
            _paint_trail(painter, trail[n], states[n], colour, 2.5 if chosen else 1.3)
            if np.isfinite(trail[n, -1]).all() and states[n, -1] != NONE:
                _paint_mark(painter, trail[n, -1], int(states[n, -1]), _STYLES.get(one.kind, 0), colour, chosen)


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


def _paint_mark(painter: QPainter, at: np.ndarray, state: int, style: int, colour: QColor, chosen: bool) -> None:
    """Disc, square or diamond by origin; hollow where the point is hidden; a dark rim keeps it readable."""
    size = 5.0 if chosen else 3.6
    painter.setPen(QPen(QColor(0, 0, 0, 190), 1.2) if state == VISIBLE else QPen(colour, 1.6))
    painter.setBrush(colour if state == VISIBLE else Qt.BrushStyle.NoBrush)
    x, y = float(at[0]), float(at[1])
    if style == 0:
        painter.drawEllipse(QPointF(x, y), size, size)
    elif style == 1:
        painter.drawRect(round(x - size), round(y - size), round(2 * size), round(2 * size))
    else:
        corners = ((0.0, -size), (size, 0.0), (0.0, size), (-size, 0.0))
        painter.drawPolygon(QPolygonF([QPointF(x + dx * 1.3, y + dy * 1.3) for dx, dy in corners]))
