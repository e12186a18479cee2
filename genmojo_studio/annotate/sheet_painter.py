"""Paints the dope sheet: rows, ruler, what is decoded or marked. Rows are kept as pictures until they change.

Fill: visible. Hatch: occluded. Dots: out of view. Empty: not annotated. Diamond: a person's key. Red: suspicious.
Paler: the tracker was less sure. Dots along the top: uncertain. Line between keys: solid where a tracker fills the
segment, dashed where a straight line does, stepped where the place is held.
"""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QImage, QPainter, QPainterPath, QPalette, QPen, QPolygonF

from genmojo_core.tracks.annotation import BY_HOLD, BY_LINE
from genmojo_core.tracks.model import OCCLUDED, OUT_OF_VIEW, VISIBLE
from genmojo_studio.annotate import returned
from genmojo_studio.annotate.colours import heat_colour, point_colour
from genmojo_studio.annotate.overlay import glyph_path
from genmojo_studio.annotate.session import Session
from genmojo_studio.annotate.sheet_columns import Columns, Lines, apart, columns, segments
from genmojo_studio.annotate.sheet_words import label
from genmojo_studio.annotate.stride_marks import StrideMarks
from genmojo_studio.annotate.time_view import Axis

RULER, ROW, LABEL = 30, 18, 168
MARKED = QColor(214, 142, 52)
DECODED = QColor(90, 170, 110)
_TICK = 8.0  # pixels between frames of the stride from which each has a sign of its own
_SHORT = 6.0  # pixels; a shorter segment shows no line
_STEP = 6.0  # pixels of a step of the line of a held segment


class SheetPainter:
    """Rows and ruler of one session, over an axis of time."""

    def __init__(self, session: Session, marks: StrideMarks) -> None:
        self._session, self._marks = session, marks
        self.lines = Lines(session)
        self._pictures: dict[int, QImage] = {}
        self._drawn: tuple[object, ...] = ()  # what all pictures depend on

    def forget(self, tracks: set[int] | None = None) -> None:
        """Some tracks were changed, or the looks of all."""
        if tracks is None:
            self._pictures = {}
            return
        self.lines.forget(tracks)
        for track in tracks:
            self._pictures.pop(track, None)

    def row(self, painter: QPainter, track: int, y: float, axis: Axis, palette: QPalette) -> None:
        """A track's cells, segments and keys, its top at y."""
        picture = self._picture(track, axis, palette, painter.device().devicePixelRatioF())
        painter.drawImage(QPointF(axis.left, y), picture)
        info = self._session.annotation.tracks[track]
        if info.review == "needs_fix":
            first, last = returned.run_of(self._session, info)
            x0, x1 = max(axis.x_of(first), axis.left), min(axis.x_of(last + 1), axis.left + axis.width)
            if x1 > x0:
                returned.paint_run(painter, QRectF(x0, y, x1 - x0, ROW))
        middle, size = y + ROW / 2, min(5.0, max(2.5, axis.wide / 2))
        line, view = self.lines.of(track), (axis.first, axis.span)
        for start, end, mode in segments(line, view, _SHORT / axis.wide):
            span = (max(axis.x_of(start + 0.5), axis.left), min(axis.x_of(end + 0.5), axis.left + axis.width))
            segment_line(painter, span, middle, mode, palette)
        painter.setPen(QPen(QColor(20, 22, 26), 1))
        painter.setBrush(QColor(255, 255, 255))
        for key in apart(line.keys, view, 3.0 / axis.wide).tolist():
            painter.drawPolygon(diamond(axis.x_of(key + 0.5), middle, size))

    def label(self, painter: QPainter, track: int, y: float, palette: QPalette) -> None:
        """Glyph and name of a track, and where its review stands."""
        session = self._session
        info = session.annotation.tracks[track]
        if track == session.track:
            tint = palette.highlight().color()
            tint.setAlpha(90)
            painter.fillRect(QRectF(0, y, LABEL - 4, ROW), tint)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(*point_colour(session.place_of(info.object), info.number - 1)))
        painter.drawPath(glyph_path(info.number - 1, 5).translated(12, y + ROW / 2))
        painter.setPen(palette.text().color())
        area = QRectF(24, y, LABEL - 30, ROW)
        mark = {"approved": " ✓", "needs_fix": " ✗", "fixed": " ↻"}.get(info.review, "")
        code, name = label(session, track)
        wide = painter.fontMetrics().horizontalAdvance(code)
        left = int(area.width()) - wide - 16
        clipped = painter.fontMetrics().elidedText(name, Qt.TextElideMode.ElideMiddle, left)
        painter.drawText(area, Qt.AlignmentFlag.AlignVCenter, code + clipped + mark)

    def ruler(self, painter: QPainter, axis: Axis, palette: QPalette) -> None:
        """Frame numbers and frames of the stride."""
        painter.fillRect(QRectF(0, 0, axis.left + axis.width + 6, RULER), palette.window())
        painter.save()
        painter.setClipRect(QRectF(axis.left, 0, axis.width + 6, RULER))
        painter.setPen(palette.placeholderText().color())
        step = nice(56 / axis.wide)
        for frame in range(int(axis.first // step) * step, int(axis.first + axis.span) + 1, step):
            if frame < self._session.annotation.frames:
                painter.drawText(QPointF(axis.x_of(frame) + 2, 11), str(frame))
        stride_ticks(painter, axis, self._marks, 14.0, palette)
        painter.restore()

    def over(self, painter: QPainter, axis: Axis) -> None:
        """On the ruler: frames that are decoded, and the run marked by [ and ]."""
        for first, end in runs(self._session.cache.held()):
            self._band(painter, axis, (first, end), (23.0, 3.0), DECODED)
        run = marked(self._session)
        if run is not None:
            tint = QColor(MARKED)
            tint.setAlpha(150)
            self._band(painter, axis, (run[0], run[1] + 1), (14.0, 6.0), tint)

    @staticmethod
    def _band(painter: QPainter, axis: Axis, span: tuple[int, int], place: tuple[float, float], colour: QColor) -> None:
        x0, x1 = max(axis.x_of(span[0]), axis.left), min(axis.x_of(span[1]), axis.left + axis.width)
        if x1 > x0:
            painter.fillRect(QRectF(x0, place[0], x1 - x0, place[1]), colour)

    def _picture(self, track: int, axis: Axis, palette: QPalette, ratio: float) -> QImage:
        """The pattern of a track, at the screen's own resolution."""
        ink, ground = palette.text().color().rgb(), palette.base().color().rgb()
        drawn = (axis, ratio, ink, ground)
        if drawn != self._drawn:
            self._pictures, self._drawn = {}, drawn
        picture = self._pictures.get(track)
        if picture is None:
            info, width = self._session.annotation.tracks[track], max(round(axis.width * ratio), 1)
            seen = columns(self.lines.of(track), self._session.suspicion.get(track), (axis.first, axis.span), width)
            colour = point_colour(self._session.place_of(info.object), info.number - 1)
            picture = self._pictures[track] = row_picture(seen, colour, (ink, ground), ratio)
        return picture


def stride_ticks(painter: QPainter, axis: Axis, marks: StrideMarks, y: float, palette: QPalette) -> None:
    """A ^ per frame of the stride, filled where everything is accepted; a band where they stand too close."""
    frames, done = marks.frames(), marks.done()
    shown = (frames + 1 > axis.first) & (frames < axis.first + axis.span)
    frames, done = frames[shown], done[shown]
    if not len(frames):
        return
    x = axis.left + (frames + 0.5 - axis.first) * axis.wide
    if len(frames) < 2 or x[1] - x[0] >= _TICK:
        for middle, filled in zip(x.tolist(), done.tolist(), strict=True):
            tick(painter, middle, y, palette, filled=filled)
        return
    columns_of, starts = np.unique((x // 2).astype(int), return_index=True)
    whole = np.minimum.reduceat(done, starts)
    painter.fillRect(QRectF(x[0], y + 5, x[-1] - x[0], 1), palette.placeholderText())
    for first, end in runs(columns_of[whole].tolist()):
        painter.fillRect(QRectF(2 * first, y + 1, 2 * (end - first), 5), palette.text())


def tick(painter: QPainter, x: float, y: float, palette: QPalette, *, filled: bool) -> None:
    """A frame of the stride, its tip at (x, y)."""
    painter.setPen(QPen((palette.text() if filled else palette.placeholderText()).color(), 1.2))
    painter.setBrush(palette.text() if filled else Qt.BrushStyle.NoBrush)
    corners = QPolygonF([QPointF(x - 3, y + 6), QPointF(x, y), QPointF(x + 3, y + 6)])
    if filled:
        painter.drawPolygon(corners)
    else:
        painter.drawPolyline(corners)


def marked(session: Session) -> tuple[int, int] | None:
    """First and last frame of the run that [ and ] mark, None where there is none."""
    if session.run == (None, None):
        return None
    ends = [session.frame if end is None else end for end in session.run]
    return min(ends), max(ends)


def row_picture(seen: Columns, colour: tuple[int, int, int], paper: tuple[int, int], ratio: float) -> QImage:
    """The pattern of a row of `ROW` high, one column of it per column of `seen`.

    `paper`: ink and ground as 0xaarrggbb, for what must be seen on any fill.
    """
    pixels = _pattern((round(ROW * ratio), len(seen.state)), seen, colour, ratio)
    _mark_uncertain(pixels, seen.uncertain, paper, ratio)
    height, width = pixels.shape[:2]
    picture = QImage(pixels.data, width, height, 4 * width, QImage.Format.Format_ARGB32).copy()
    picture.setDevicePixelRatio(ratio)
    return picture


def _pattern(
    shape: tuple[int, int], seen: Columns, colour: tuple[int, int, int], ratio: float
) -> np.ndarray:  # (h, w, 4) uint8 BGRA
    """Fill, hatch, dots or nothing for every column; a red rim where it is suspicious, paler where less sure."""
    height, width = shape
    state, doubt = seen.state, seen.doubt
    y, x = np.ogrid[:height, :width]
    top, bottom = round(2 * ratio), height - round(2 * ratio)
    unit = max(1, round(ratio))
    inside = (y >= top) & (y < bottom)
    hatch = ((x + y) // (2 * unit)) % 3 == 0
    dots = ((x // unit) % 6 < 2) & ((y - height // 2) // unit == 0)
    on = inside & ((state == VISIBLE) | ((state == OCCLUDED) & hatch) | ((state == OUT_OF_VIEW) & dots))
    out = np.zeros((height, width, 4), np.uint8)
    bgr = np.array(colour[::-1], np.uint8)
    out[on, :3] = bgr
    out[..., 3] = np.where(on, (110 + 105 * np.clip(seen.sure, 0, 1)).astype(np.uint8), 0)
    faint = inside & ~on & (state == OCCLUDED)
    out[faint, :3] = bgr
    out[faint, 3] = 45
    hot = inside & (doubt >= 0.3) & (y >= bottom - 4 * unit)
    if hot.any():
        heat = np.array([(*heat_colour(d)[::-1], 255) for d in np.linspace(0, 1, 33)], np.uint8)
        out[hot] = np.broadcast_to(heat[(doubt * 32).astype(int)], out.shape)[hot]
    return out


def _mark_uncertain(pixels: np.ndarray, uncertain: np.ndarray, paper: tuple[int, int], ratio: float) -> None:
    """A line of dots along the top, on a ground of its own."""
    if not uncertain.any():
        return
    unit, width = max(1, round(ratio)), len(uncertain)
    lane = pixels[round(ratio) : round(ratio) + 4 * unit]
    y, x = np.ogrid[: len(lane), :width]
    ink, ground = (np.array([*int(c).to_bytes(4, "little")], np.uint8) for c in paper)
    lane[:, uncertain] = ground
    lane[(uncertain & (x // unit % 5 < 2)) & (y >= unit) & (y < 3 * unit)] = ink


def segment_line(painter: QPainter, span: tuple[float, float], y: float, mode: int, palette: QPalette) -> None:
    """What fills a segment: solid a tracker, dashed a straight line, stepped the place of its first key."""
    path = QPainterPath(QPointF(span[0], y))
    if mode == BY_HOLD:
        for k in range(max(int((span[1] - span[0]) / _STEP), 1)):
            height = y + (2.5 if k % 2 == 0 else -2.5)
            path.lineTo(path.currentPosition().x(), height)
            path.lineTo(min(path.currentPosition().x() + _STEP, span[1]), height)
    else:
        path.lineTo(QPointF(span[1], y))
    painter.setBrush(Qt.BrushStyle.NoBrush)
    for colour, width in ((palette.base().color(), 3.0), (palette.text().color(), 1.4)):  # seen on any fill
        colour.setAlpha(140 if width > 2 else 255)
        pen = QPen(colour, width)
        pen.setCapStyle(Qt.PenCapStyle.FlatCap)
        if mode == BY_LINE:
            pen.setDashPattern([5.0 / width, 4.0 / width])
        painter.strokePath(path, pen)


def diamond(x: float, y: float, size: float) -> QPolygonF:
    """A key."""
    return QPolygonF([QPointF(x, y - size), QPointF(x + size, y), QPointF(x, y + size), QPointF(x - size, y)])


def runs(frames: list[int]) -> list[tuple[int, int]]:
    """Runs of consecutive frames as (first, end)."""
    if not frames:
        return []
    values = np.array(frames)
    cuts = np.flatnonzero(np.diff(values) > 1)
    firsts, lasts = np.r_[values[0], values[cuts + 1]], np.r_[values[cuts], values[-1]]
    return [(int(a), int(b) + 1) for a, b in zip(firsts, lasts, strict=True)]


def nice(least: float) -> int:
    """The next of 1, 2, 5, 10, 20, ... not below `least`."""
    step = 1
    while True:
        for factor in (1, 2, 5):
            if step * factor >= least:
                return step * factor
        step *= 10
