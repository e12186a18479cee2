"""The dope sheet: every track's state in every frame at a glance. Click to go there, drag to paint a state.

Fill: visible. Hatch: occluded. Dots: out of view. Empty: not annotated. Diamond: a person's key. Red: suspicious.
Paler: the tracker was less sure.
The pattern is made in one numpy picture per change, so that stepping only moves the playhead.
"""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QFocusEvent,
    QImage,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QPixmap,
    QPolygonF,
    QResizeEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QAbstractScrollArea, QWidget

from genmojo_core.tracks.annotation import CONFIRMED, KEY
from genmojo_core.tracks.model import OCCLUDED
from genmojo_studio.annotate.colours import heat_colour, point_colour
from genmojo_studio.annotate.overlay import glyph_path
from genmojo_studio.annotate.session import Session
from genmojo_studio.translate import tr

RULER, ROW, LABEL = 30, 18, 168


class DopeSheet(QAbstractScrollArea):
    """Rows of tracks over columns of frames."""

    began = Signal()  # a press, before it chooses or goes anywhere
    seek = Signal(int)
    picked = Signal(int)
    painted = Signal(int, int, int)  # track, first and last frame

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        self._still: QPixmap | None = None
        super().__init__(parent)
        self._session = session
        self.by_suspicion = False
        self._rows: list[int] = []
        self._strip: QImage | None = None
        self._pixels: np.ndarray | None = None
        self._press: tuple[int, int] | None = None  # row, frame
        self._at = 0
        self._ruler = False
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setAccessibleName(tr("Dope sheet: states of all points over time"))
        self.setMinimumHeight(RULER + 2 * ROW)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.verticalScrollBar().valueChanged.connect(self._dirty)
        session.edited.connect(self._dirty)
        session.selected.connect(self._dirty)
        session.frame_changed.connect(self.viewport().update)
        session.cache.filled.connect(self._ring_changed)
        self.viewport().setMouseTracking(True)
        self._dirty()

    def sizeHint(self) -> QSize:
        """Room for a dozen rows."""
        return QSize(900, RULER + 12 * ROW)

    def rows(self) -> list[int]:
        """Track ids from top to bottom."""
        return list(self._rows)

    def sort_by_suspicion(self, on: bool) -> None:
        """Worst tracks first, or by object and point."""
        self.by_suspicion = on
        self._dirty()

    def refresh(self, _what: object = None) -> None:
        """Suspicion has changed."""
        self._dirty()

    # ---- geometry

    def frame_at(self, x: float) -> int:
        """Frame under a viewport x."""
        share = (x - LABEL) / max(self._width(), 1)
        return int(np.clip(share * self._frames(), 0, self._frames() - 1))

    def x_of(self, frame: float) -> float:
        """Viewport x of a frame's left edge."""
        return LABEL + frame * self._width() / self._frames()

    def row_at(self, y: float) -> int | None:
        """Place in `rows` under a viewport y, None on the ruler or below all rows."""
        row = int((y - RULER) // ROW) + self.verticalScrollBar().value()
        return row if y >= RULER and row < len(self._rows) else None

    def _width(self) -> float:
        return self.viewport().width() - LABEL - 6

    def _frames(self) -> int:
        return max(self._session.annotation.frames, 1)

    # ---- painting

    def paintEvent(self, event: QPaintEvent) -> None:
        """Ruler, pattern, keys, selection and playhead."""
        if self._still is None:
            self._still = self._make_still()
        painter = QPainter(self.viewport())
        painter.drawPixmap(0, 0, self._still)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, on=True)
        self._paint_ring(painter)
        self._paint_brush(painter, self.verticalScrollBar().value())
        x = self.x_of(self._session.frame + 0.5)
        painter.setPen(QPen(self.palette().highlight().color(), 2))
        painter.drawLine(QPointF(x, 12), QPointF(x, self.viewport().height()))
        if not self._rows:
            painter.setPen(self.palette().placeholderText().color())
            area = QRectF(LABEL, RULER, self._width(), ROW * 3)
            painter.drawText(area, Qt.AlignmentFlag.AlignCenter, tr("No points yet: place them in step 2."))
        if self.hasFocus():
            painter.setPen(QPen(self.palette().highlight().color(), 2))
            painter.drawRect(QRectF(self.viewport().rect()).adjusted(1, 1, -1, -1))
        painter.end()

    def _make_still(self) -> QPixmap:
        """All that stays while only the frame changes."""
        ratio = self.devicePixelRatioF()
        still = QPixmap(self.viewport().size() * ratio)
        still.setDevicePixelRatio(ratio)
        still.fill(self.palette().base().color())
        painter = QPainter(still)
        painter.setFont(self.font())
        self._make_strip()
        if self._strip is not None:
            painter.drawImage(QPointF(LABEL, RULER), self._strip)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, on=True)
        for n, track in enumerate(self._shown()):
            self._paint_row(painter, n, track, selected=track == self._session.track)
        self._paint_ruler(painter)
        painter.end()
        return still

    def _paint_row(self, painter: QPainter, n: int, track: int, *, selected: bool) -> None:
        session, y = self._session, RULER + n * ROW
        info = session.annotation.tracks[track]
        place = session.place_of(info.object)
        if selected:
            tint = self.palette().highlight().color()
            tint.setAlpha(90)
            painter.fillRect(QRectF(0, y, LABEL - 4, ROW), tint)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(*point_colour(place, info.number - 1)))
        painter.drawPath(glyph_path(info.number - 1, 5).translated(12, y + ROW / 2))
        owner = session.annotation.objects.get(info.object)
        painter.setPen(self.palette().text().color())
        text = f"{owner.name if owner else info.object} · {info.number} {info.name}"
        mark = {"approved": " ✓", "needs_fix": " ✗", "fixed": " ↻"}.get(info.review, "")
        area = QRectF(24, y, LABEL - 30, ROW)
        clipped = painter.fontMetrics().elidedText(text, Qt.TextElideMode.ElideMiddle, int(area.width()) - 16)
        painter.drawText(area, Qt.AlignmentFlag.AlignVCenter, clipped + mark)
        wide = self._width() / self._frames()
        size = min(5.0, max(2.5, wide / 2))
        painter.setPen(QPen(QColor(20, 22, 26), 1))
        painter.setBrush(QColor(255, 255, 255))
        for key in session.annotation.keys(track).tolist():
            x, middle = self.x_of(key + 0.5), y + ROW / 2
            painter.drawPolygon(QPolygonF([QPointF(x, middle - size), QPointF(x + size, middle),
                                           QPointF(x, middle + size), QPointF(x - size, middle)]))  # fmt: skip

    def _paint_ruler(self, painter: QPainter) -> None:
        """Frame numbers and ticks of the stride."""
        painter.fillRect(QRectF(0, 0, self.viewport().width(), RULER), self.palette().window())
        step = _nice(56 * self._frames() / max(self._width(), 1))
        painter.setPen(self.palette().placeholderText().color())
        for frame in range(0, self._frames(), step):
            painter.drawText(QPointF(self.x_of(frame) + 2, 11), str(frame))
        stride = self._session.stride
        if self._width() * stride / self._frames() >= 3:
            for frame in range(0, self._frames(), stride):
                x = self.x_of(frame + 0.5)
                painter.drawLine(QPointF(x, 15), QPointF(x, 20))

    def _paint_ring(self, painter: QPainter) -> None:
        """Frames that are decoded, and the run marked by [ and ]."""
        for first, end in _runs(self._session.cache.held()):
            painter.fillRect(QRectF(self.x_of(first), 23, self.x_of(end) - self.x_of(first), 3), QColor(90, 170, 110))
        run = self._session.run
        if run != (None, None):
            ends = [self._session.frame if end is None else end for end in run]
            x0, x1 = self.x_of(min(ends)), self.x_of(max(ends) + 1)
            painter.fillRect(QRectF(x0, 14, x1 - x0, 6), QColor(214, 142, 52, 150))

    def _paint_brush(self, painter: QPainter, first: int) -> None:
        """What is being painted now, here by dragging or by a key held down."""
        painting = self._session.painting
        if self._press is not None and self._at != self._press[1]:
            row, run = self._press[0], sorted((self._press[1], self._at))
        elif painting is not None and painting.track in self._rows:
            row, run = self._rows.index(painting.track), list(painting.run())
        else:
            return
        area = QRectF(self.x_of(run[0]), RULER + (row - first) * ROW, self.x_of(run[1] + 1) - self.x_of(run[0]), ROW)
        painter.fillRect(area, QColor(214, 142, 52, 130))

    def _make_strip(self) -> None:
        """The pattern of all rows on show, at the screen's own resolution."""
        ratio = self.devicePixelRatioF()
        rows, width = self._shown(), round(self._width() * ratio)
        height = round(len(rows) * ROW * ratio)
        if not rows or width < 1:
            self._strip = None
            return
        annotation, frames = self._session.annotation, self._frames()
        column = np.minimum(np.arange(width) * frames // width, frames - 1)
        pixels = np.zeros((height, width, 4), np.uint8)
        row_pixels = round(ROW * ratio)
        for n, track in enumerate(rows):
            info = annotation.tracks[track]
            doubt = self._session.suspicion.get(track, np.zeros(frames))
            cells = annotation.track(track)
            colour = point_colour(self._session.place_of(info.object), info.number - 1)
            part = pixels[n * row_pixels : (n + 1) * row_pixels]
            sure = np.where(cells.flags & (KEY | CONFIRMED), 1.0, cells.conf)
            part[:] = _pattern((row_pixels, width), cells.state[column], colour, (doubt[column], sure[column]), ratio)
        self._pixels = pixels
        self._strip = QImage(pixels.data, width, height, 4 * width, QImage.Format.Format_ARGB32)
        self._strip.setDevicePixelRatio(ratio)

    # ---- mouse

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Begin to scrub on the ruler, else take the cell."""
        frame, row = self.frame_at(event.position().x()), self.row_at(event.position().y())
        self._ruler = event.position().y() < RULER
        self.began.emit()
        if row is not None:
            self.picked.emit(self._rows[row])
            if event.position().x() >= LABEL:
                self._press, self._at = (row, frame), frame
        if self._ruler or (row is not None and event.position().x() >= LABEL):
            self.seek.emit(frame)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Scrub or paint; otherwise say what is under the mouse."""
        frame = self.frame_at(event.position().x())
        if event.buttons() & Qt.MouseButton.LeftButton and self._ruler:
            self.seek.emit(frame)
        elif self._press is not None:
            self._at = frame
            self.viewport().update()
        else:
            self._describe(self.row_at(event.position().y()), frame)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """A drag paints."""
        press, self._press, self._ruler = self._press, None, False
        if press is not None and self._at != press[1]:
            self.painted.emit(self._rows[press[0]], *sorted((press[1], self._at)))
        self.viewport().update()

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Rows up and down."""
        bar = self.verticalScrollBar()
        bar.setValue(bar.value() - int(np.sign(event.angleDelta().y())) * 2)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Another width, another pattern."""
        self._dirty()

    # ---- helpers

    def _describe(self, row: int | None, frame: int) -> None:
        if row is None:
            self.viewport().setToolTip("")
            return
        cells = self._session.annotation.track(self._rows[row])
        names = {0: tr("not annotated"), 1: tr("visible"), 2: tr("occluded"), 3: tr("out of view")}
        text = f"{tr('frame')} {frame}: {names[int(cells.state[frame])]}"
        self.viewport().setToolTip(text + (", " + tr("key") if cells.flags[frame] & KEY else ""))

    def _shown(self) -> list[int]:
        first = self.verticalScrollBar().value()
        return self._rows[first : first + max(1, (self.viewport().height() - RULER) // ROW + 1)]

    def _order(self) -> list[int]:
        session = self._session
        if self.by_suspicion:
            worst = {t: float(v.max(initial=0)) for t, v in session.suspicion.items()}
            return sorted((i.id for i in session.annotation.active()), key=lambda t: -worst.get(t, 0.0))
        places = {o.id: n for n, o in enumerate(session.objects())}
        infos = session.annotation.active()
        return [i.id for i in sorted(infos, key=lambda i: (places.get(i.object, 99), i.object, i.number))]

    def _dirty(self, _what: object = None) -> None:
        self._rows = self._order()
        visible = max(1, (self.viewport().height() - RULER) // ROW)
        self.verticalScrollBar().setRange(0, max(0, len(self._rows) - visible))
        self._still = None
        self.viewport().update()

    def focusInEvent(self, event: QFocusEvent) -> None:
        """Show that the keyboard is here."""
        self.viewport().update()

    def focusOutEvent(self, event: QFocusEvent) -> None:
        """And that it is not."""
        self.viewport().update()

    def changeEvent(self, event: QEvent) -> None:
        """Other colours, another picture."""
        super().changeEvent(event)
        if event.type() in (QEvent.Type.PaletteChange, QEvent.Type.StyleChange, QEvent.Type.FontChange):
            self._still = None
            self.viewport().update()

    def _ring_changed(self, _frame: int) -> None:
        self.viewport().update(0, 20, self.viewport().width(), 8)


def _pattern(
    shape: tuple[int, int],
    state: np.ndarray,
    colour: tuple[int, int, int],
    trust: tuple[np.ndarray, np.ndarray],
    ratio: float,
) -> np.ndarray:  # (h, w, 4) uint8 BGRA
    """Fill, hatch, dots or nothing for every column; a red rim where it is suspicious, paler where less sure.

    `trust`: suspicion and confidence of every column, 0..1.
    """
    height, width = shape
    doubt, sure = trust
    y, x = np.ogrid[:height, :width]
    top, bottom = round(2 * ratio), height - round(2 * ratio)
    unit = max(1, round(ratio))
    inside = (y >= top) & (y < bottom)
    hatch = ((x + y) // (2 * unit)) % 3 == 0
    dots = ((x // unit) % 6 < 2) & ((y - height // 2) // unit == 0)
    on = inside & ((state == 1) | ((state == OCCLUDED) & hatch) | ((state == 3) & dots))
    out = np.zeros((height, width, 4), np.uint8)
    bgr = np.array(colour[::-1], np.uint8)
    out[on, :3] = bgr
    out[..., 3] = np.where(on, (110 + 105 * np.clip(sure, 0, 1)).astype(np.uint8), 0)
    faint = inside & ~on & (state == OCCLUDED)
    out[faint, :3] = bgr
    out[faint, 3] = 45
    hot = inside & (doubt >= 0.3) & (y >= bottom - 4 * unit)
    if hot.any():
        heat = np.array([(*heat_colour(d)[::-1], 255) for d in np.linspace(0, 1, 33)], np.uint8)
        out[hot] = np.broadcast_to(heat[(doubt * 32).astype(int)], out.shape)[hot]
    return out


def _runs(frames: list[int]) -> list[tuple[int, int]]:
    """Runs of consecutive frames as (first, end)."""
    if not frames:
        return []
    values = np.array(frames)
    cuts = np.flatnonzero(np.diff(values) > 1)
    firsts, lasts = np.r_[values[0], values[cuts + 1]], np.r_[values[cuts], values[-1]]
    return [(int(a), int(b) + 1) for a, b in zip(firsts, lasts, strict=True)]


def _nice(least: float) -> int:
    """The next of 1, 2, 5, 10, 20, ... not below `least`."""
    step = 1
    while True:
        for factor in (1, 2, 5):
            if step * factor >= least:
                return step * factor
        step *= 10
