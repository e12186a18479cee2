"""What every sign of the dope sheet means, drawn as the sheet draws it; and what mouse and keys do there."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen, QPixmap
from PySide6.QtWidgets import QDialog, QDialogButtonBox, QGridLayout, QLabel, QVBoxLayout, QWidget

from genmojo_core.tracks.annotation import BY_HOLD, BY_LINE, BY_TRACKER
from genmojo_core.tracks.model import NONE, OCCLUDED, OUT_OF_VIEW, VISIBLE
from genmojo_studio.annotate import returned
from genmojo_studio.annotate.colours import point_colour
from genmojo_studio.annotate.mouse_rules import RULES, SHEET
from genmojo_studio.annotate.sheet_columns import Columns
from genmojo_studio.annotate.sheet_painter import DECODED, MARKED, ROW, diamond, row_picture, segment_line, tick
from genmojo_studio.translate import tr

_WIDE = 92
Sketch = Callable[[QPainter], None]


class SheetLegend(QDialog):
    """Samples with a sentence each; it may stay open while one works."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Signs of the dope sheet"))
        grid = QGridLayout()
        grid.setHorizontalSpacing(12)
        grid.setVerticalSpacing(4)
        for row, (sketch, words) in enumerate(self._signs()):
            sample = QLabel()
            sample.setPixmap(self._sample(sketch))
            grid.addWidget(sample, row % 8, 2 * (row // 8))
            grid.addWidget(QLabel(words), row % 8, 2 * (row // 8) + 1)
        hands = QGridLayout()
        hands.setHorizontalSpacing(12)
        for row, rule in enumerate(rule for rule in RULES if rule.where == SHEET):
            title = QLabel(tr(rule.gesture))
            title.setProperty("role", "dim")
            hands.addWidget(title, row, 0)
            hands.addWidget(QLabel(tr(rule.does)), row, 1)
        hands.setColumnStretch(1, 1)
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
        buttons.rejected.connect(self.reject)
        column = QVBoxLayout(self)
        column.setSpacing(10)
        column.addLayout(grid)
        column.addLayout(hands)
        column.addWidget(buttons)

    def _signs(self) -> list[tuple[Sketch, str]]:
        """Every sign and what it means."""
        return [
            (self._row(VISIBLE), tr("visible")),
            (self._row(OCCLUDED), tr("occluded")),
            (self._row(OUT_OF_VIEW), tr("out of view")),
            (self._row(NONE), tr("not annotated")),
            (self._row(VISIBLE, sure=0.0), tr("paler: the tracker was less sure")),
            (self._row(VISIBLE, doubt=0.9), tr("suspicious, the redder the more")),
            (self._row(VISIBLE, uncertain=True), tr("marked as uncertain")),
            (self._keyed(None), tr("key: a person placed the point")),
            (self._keyed(BY_TRACKER), tr("between two keys: filled by a tracker")),
            (self._keyed(BY_LINE), tr("filled by a straight line")),
            (self._keyed(BY_HOLD), tr("held where the first key is")),
            (self._returned(), tr("sent back by a reviewer")),
            (self._tick(filled=False), tr("frame of the stride")),
            (self._tick(filled=True), tr("frame of the stride in which every point is accepted")),
            (_band(MARKED), tr("run marked by [ and ]")),
            (_band(DECODED), tr("frames that are ready to be shown")),
        ]

    def _row(self, state: int, *, sure: float = 1.0, doubt: float = 0.0, uncertain: bool = False) -> Sketch:
        width = round(_WIDE * self.devicePixelRatioF())
        seen = Columns(np.full(width, state, np.uint8), np.full(width, doubt), np.full(width, sure),
                       np.full(width, uncertain))  # fmt: skip
        paper = (self.palette().text().color().rgb(), self.palette().base().color().rgb())
        picture = row_picture(seen, point_colour(0, 0), paper, self.devicePixelRatioF())
        return lambda painter: painter.drawImage(QPointF(0, 0), picture)

    def _keyed(self, mode: int | None) -> Sketch:
        ground = self._row(VISIBLE)

        def sketch(painter: QPainter) -> None:
            ground(painter)
            ends = [_WIDE / 2] if mode is None else [8.0, _WIDE - 8.0]
            if mode is not None:
                segment_line(painter, (ends[0], ends[1]), ROW / 2, mode, self.palette())
            painter.setPen(QPen(QColor(20, 22, 26), 1))
            painter.setBrush(QColor(255, 255, 255))
            for x in ends:
                painter.drawPolygon(diamond(x, ROW / 2, 5.0))

        return sketch

    def _returned(self) -> Sketch:
        ground = self._row(VISIBLE)

        def sketch(painter: QPainter) -> None:
            ground(painter)
            returned.paint_run(painter, QRectF(_WIDE / 4, 0, _WIDE / 2, ROW))

        return sketch

    def _tick(self, *, filled: bool) -> Sketch:
        return lambda painter: tick(painter, _WIDE / 2, ROW / 2 - 3, self.palette(), filled=filled)

    def _sample(self, sketch: Sketch) -> QPixmap:
        ratio = self.devicePixelRatioF()
        pixmap = QPixmap(round(_WIDE * ratio), round(ROW * ratio))
        pixmap.setDevicePixelRatio(ratio)
        pixmap.fill(self.palette().base().color())
        painter = QPainter(pixmap)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, on=True)
        sketch(painter)
        painter.end()
        return pixmap


def _band(colour: QColor) -> Sketch:
    def sketch(painter: QPainter) -> None:
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(colour)
        painter.drawRect(QRectF(0, ROW / 2 - 2, _WIDE, 4))

    return sketch
