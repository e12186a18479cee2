"""What lies over the picture: axes, badge, colour scale, names, and what other parts of the app paint.

A transparent widget above the surface, so that no painter ever touches GL state. All sizes are logical pixels.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QImage, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QWidget

from genmojo_core.clip.cameras import View
from genmojo_studio.translate import decimal, mark, tr
from genmojo_studio.view3d.colouring import flow_wheel, palette_rgb
from genmojo_studio.view3d.frames import FrameReport
from genmojo_studio.view3d.look import SCALAR_MODES, TITLES, Mode
from genmojo_studio.view3d.safe_band import SAFE_DEGREES, degrees_outside

Paint = Callable[[QPainter, View, float], None]  # (painter, camera in logical pixels, time)

UNITS = {
    Mode.DEPTH: mark("scene units"),
    Mode.DEPTH_MEDIAN: mark("scene units"),
    Mode.RESIDUAL: mark("of full scale"),
    Mode.FLOW: "px",
}
GIZMO = 92  # side of the square in the upper right corner
_MARGIN = 10
_LEGEND_FROM = 260  # height of a view that has room for a legend
_PLATE = QColor(12, 13, 15, 190)
_INK = QColor("#f2f2f2")
_DIM = QColor("#b9bfc8")
_WARN = QColor("#ffc24d")
_AXES = ((0, QColor("#ff6b6b"), "right"), (1, QColor("#7ddc7d"), "up"), (2, QColor("#6fb2ff"), "front"))


class Overlay(QWidget):
    """Paints over its parent; mouse and keys go through it."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self.setAttribute(Qt.WidgetAttribute.WA_NoSystemBackground)
        self.report: FrameReport | None = None
        self.paints: list[Paint] = []
        self.message = ""  # a banner, e.g. why the processor draws
        self.waiting = ""  # why there is no picture yet
        self.hint = ""  # how to move about, for a moment

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Everything over the newest frame, by the camera that frame was drawn with."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        if self.report is not None:
            request = self.report.request
            view = request.view(self.width(), self.height())
            for paint in self.paints:
                painter.save()
                paint(painter, view, request.t)
                painter.restore()
            self._paint_corner_texts(painter)
            if self.has_gizmo():
                paint_gizmo(painter, self.gizmo_rect(), axes_of(self.report))
            self._paint_legend(painter)
        text = self.waiting or self.message or self.hint
        if text:
            ink = _INK if text == self.hint else _WARN
            plate(painter, [text], QPointF(_MARGIN, self.height() - _MARGIN), ink, bottom=True)
        painter.end()

    def has_gizmo(self) -> bool:
        """Is there room for the axes beside the texts?"""
        return self.width() >= 4 * GIZMO and self.height() >= 2 * GIZMO

    def gizmo_rect(self) -> QRectF:
        """Where the axes are."""
        return QRectF(self.width() - GIZMO - _MARGIN, _MARGIN, GIZMO, GIZMO)

    def axis_at(self, point: QPointF) -> str | None:
        """The preset of the axis end under the mouse, or None."""
        if self.report is None or not self.has_gizmo() or not self.gizmo_rect().contains(point):
            return None
        best = None
        for end, _, preset, z in axis_ends(self.gizmo_rect(), axes_of(self.report)):
            if math.hypot(end.x() - point.x(), end.y() - point.y()) < 12 and (best is None or z < best[0]):
                best = (z, preset)
        return best[1] if best else None

    def _paint_corner_texts(self, painter: QPainter) -> None:
        """Where the view is, and whether that was supervised."""
        if self.report is None:
            return
        request = self.report.request
        o = request.orbit
        where = tr("elevation {degrees:+.1f}°").format(degrees=o.elevation)
        where += "   " + tr("azimuth {degrees:+.1f}°").format(degrees=o.azimuth)
        if abs(o.roll) > 0.05:
            where += "   " + tr("roll {degrees:+.1f}°").format(degrees=o.roll)
        lines = [where] if request.look.mode == Mode.RGB else [where, tr(TITLES[request.look.mode])]
        bottom = plate(painter, lines, QPointF(_MARGIN, _MARGIN), _INK)
        away = degrees_outside(o, request.snapshot.supervised)
        if away > SAFE_DEGREES and request.snapshot.cameras is not None:
            warning = tr("Not seen: {angle:.0f}° from the nearest supervised view.").format(angle=away)
            plate(painter, [warning], QPointF(_MARGIN, bottom + 4), _WARN)

    def _paint_legend(self, painter: QPainter) -> None:
        """Lower right corner: scale with lowest and highest value, flow wheel, or names of objects."""
        if self.report is None:
            return
        if self.height() < _LEGEND_FROM:
            return
        mode, bounds = self.report.request.look.mode, self.report.bounds
        corner = QPointF(self.width() - _MARGIN, self.height() - _MARGIN)
        if mode == Mode.FLOW:
            paint_wheel(painter, corner, bounds[1])
        elif mode in SCALAR_MODES:
            paint_scale(painter, corner, bounds, tr(UNITS[mode]) if UNITS.get(mode) else "")
        elif mode in (Mode.INSTANCE, Mode.INSTANCE_SOFT):
            snapshot = self.report.request.snapshot
            named = [snapshot.object_of(int(i)) for i in snapshot.object_ids]
            shown = [o for o in named if self.report.request.look.shows(snapshot, o.id)]
            paint_names(painter, corner, [(o.name, QColor.fromRgbF(*o.color)) for o in shown])


def axes_of(report: FrameReport) -> np.ndarray:  # (3, 3)
    """Right, up and front of the input camera (world up upright) in the axes of the shown camera, one per row."""
    request = report.request
    base = request.reference.view.world_to_camera[:3, :3]
    up = np.asarray(request.reference.up, float) / np.linalg.norm(request.reference.up)
    right = np.cross(up, -base[2])  # the input camera looks along base[2]
    right = right / np.linalg.norm(right) if np.linalg.norm(right) > 1e-6 else base[0]
    front = np.cross(right, up)
    shown = request.reference.pose(request.orbit)[:3, :3]
    return np.stack([right, up, front]) @ shown.T


def axis_ends(rect: QRectF, axes: np.ndarray) -> list[tuple[QPointF, QColor, str, float]]:
    """(place, colour, preset it leads to, depth) of the six ends, farthest first."""
    opposite = {"right": "left_90", "up": "bottom", "front": "back"}
    forward = {"right": "right_90", "up": "top", "front": "input"}
    ends = []
    length = rect.width() / 2 - 14
    for row, color, name in _AXES:
        for sign, names in ((1, forward), (-1, opposite)):
            x, y, z = sign * axes[row]
            place = rect.center() + QPointF(x * length, y * length)
            ends.append((place, color if sign > 0 else color.darker(190), names[name], float(z)))
    return sorted(ends, key=lambda e: -e[3])


def paint_gizmo(painter: QPainter, rect: QRectF, axes: np.ndarray) -> None:
    """Six ends of three axes; those of right, up and front carry a letter."""
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(QColor(12, 13, 15, 120))
    painter.drawEllipse(rect)
    letters = {"right_90": "R", "top": "U", "input": "F"}
    painter.setFont(_font(painter, 8, bold=True))
    for place, color, preset, _ in axis_ends(rect, axes):
        positive = preset in letters
        if positive:
            painter.setPen(QPen(color, 2))
            painter.drawLine(rect.center(), place)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(color)
        radius = 8.5 if positive else 5.0
        painter.drawEllipse(place, radius, radius)
        if positive:
            painter.setPen(QColor("#101113"))
            box = QRectF(place.x() - radius, place.y() - radius, 2 * radius, 2 * radius)
            painter.drawText(box, Qt.AlignmentFlag.AlignCenter, letters[preset])


def plate(painter: QPainter, lines: Sequence[str], at: QPointF, ink: QColor, *, bottom: bool = False) -> float:
    """Lines of text on a dark plate with its upper (or lower) left corner at a place; the plate's lower edge."""
    painter.setFont(_font(painter, 9))
    metrics = painter.fontMetrics()
    room = round(painter.window().width() - at.x() - _MARGIN - 16)
    lines = [metrics.elidedText(line, Qt.TextElideMode.ElideRight, room) for line in lines]
    width = max(metrics.horizontalAdvance(line) for line in lines) + 16
    height = metrics.height() * len(lines) + 8
    top = at.y() - height if bottom else at.y()
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(_PLATE)
    painter.drawRoundedRect(QRectF(at.x(), top, width, height), 4, 4)
    for k, line in enumerate(lines):
        painter.setPen(ink if k == 0 else _DIM)
        painter.drawText(QPointF(at.x() + 8, top + 4 + metrics.ascent() + k * metrics.height()), line)
    return top + height


def paint_scale(painter: QPainter, corner: QPointF, bounds: tuple[float, float], unit: str) -> None:
    """An upright colour bar with its lowest and highest value; its lower right corner at `corner`."""
    painter.setFont(_font(painter, 9))
    metrics = painter.fontMetrics()
    texts = [_number(bounds[1]), _number(bounds[0])] + ([unit] if unit else [])
    width = max(max(metrics.horizontalAdvance(t) for t in texts[:2]) + 30, metrics.horizontalAdvance(unit)) + 16
    bar, head = 120.0, metrics.height() + 2 if unit else 0
    rect = QRectF(corner.x() - width, corner.y() - bar - head - 20, width, bar + head + 20)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(_PLATE)
    painter.drawRoundedRect(rect, 4, 4)
    painter.setPen(_DIM)
    if unit:
        painter.drawText(QPointF(rect.x() + 8, rect.y() + 6 + metrics.ascent()), unit)
    colors = np.ascontiguousarray((palette_rgb()[::-1, None] * 255).round().astype(np.uint8))
    image = QImage(colors.data, 1, 256, 3, QImage.Format.Format_RGB888)
    top = rect.y() + head + 10
    painter.drawImage(QRectF(rect.x() + 8, top, 14, bar), image)
    painter.setPen(_INK)
    painter.drawText(QPointF(rect.x() + 30, top + metrics.ascent() - 2), texts[0])
    painter.drawText(QPointF(rect.x() + 30, top + bar), texts[1])


def paint_wheel(painter: QPainter, corner: QPointF, most: float) -> None:
    """The colours of directions, and the speed of the full ones."""
    side = 72
    line = np.linspace(-1, 1, side)
    flow = np.stack(np.meshgrid(line, line), axis=-1)
    rgb = (flow_wheel(flow, 1.0) * 255).astype(np.uint8)
    inside = (np.hypot(flow[..., 0], flow[..., 1]) <= 1).astype(np.uint8) * 255
    rgba = np.ascontiguousarray(np.dstack([rgb, inside]))
    painter.setFont(_font(painter, 9))
    text = f"{_number(most)} px"
    metrics = painter.fontMetrics()
    width = max(side, metrics.horizontalAdvance(text)) + 16
    rect = QRectF(corner.x() - width, corner.y() - side - metrics.height() - 18, width, side + metrics.height() + 18)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(_PLATE)
    painter.drawRoundedRect(rect, 4, 4)
    image = QImage(rgba.data, side, side, 4 * side, QImage.Format.Format_RGBA8888)
    painter.drawImage(QPointF(rect.center().x() - side / 2, rect.y() + 8), image)
    painter.setPen(_INK)
    painter.drawText(QRectF(rect.x(), rect.bottom() - metrics.height() - 6, width, metrics.height()),
                     Qt.AlignmentFlag.AlignCenter, text)  # fmt: skip


def paint_names(painter: QPainter, corner: QPointF, names: Sequence[tuple[str, QColor]]) -> None:
    """A swatch and a name per object."""
    if not names:
        return
    painter.setFont(_font(painter, 9))
    metrics = painter.fontMetrics()
    texts = [metrics.elidedText(name, Qt.TextElideMode.ElideRight, 220) for name, _ in names]
    width = max(metrics.horizontalAdvance(t) for t in texts) + 38
    step = metrics.height() + 3
    rect = QRectF(corner.x() - width, corner.y() - step * len(names) - 10, width, step * len(names) + 10)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(_PLATE)
    painter.drawRoundedRect(rect, 4, 4)
    for k, (text, (_, color)) in enumerate(zip(texts, names, strict=True)):
        top = rect.y() + 6 + k * step
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(color)
        painter.drawRect(QRectF(rect.x() + 9, top + 2, 12, 12))
        painter.setPen(_INK)
        painter.drawText(QPointF(rect.x() + 28, top + metrics.ascent()), text)


def _font(painter: QPainter, points: int, *, bold: bool = False) -> QFont:
    """The painter's font in a size."""
    font = QFont(painter.font())
    font.setPointSize(points)
    font.setBold(bold)
    return font


def _number(value: float) -> str:
    """Three significant digits, without an exponent where that is readable."""
    return decimal(value, ".3g" if 1e-3 <= abs(value) < 1e5 or value == 0 else ".2e")
