"""Why a place is suspicious: nine signals of the active point in the frame on show, each a bar with its value."""

from __future__ import annotations

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from genmojo_core.tracks.suspicion import SIGNALS
from genmojo_studio.annotate.colours import heat_colour
from genmojo_studio.annotate.session import Session
from genmojo_studio.translate import decimal, told, tr

_ROW = 15  # px


class SignalBars(QWidget):
    """One row per signal: its words, how much it speaks against the place (0 to 1), and the score of all together."""

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Fixed)
        self.setToolTip(tr("What speaks against the place of the active point in this frame, after what corrections "
                           "taught: 0 nothing, 1 surely wrong. Together they make the suspicion."))  # fmt: skip
        self._rows: list[tuple[str, float]] = []
        for changed in (session.shown, session.selected, session.frame_changed):
            changed.connect(self.refresh)
        self.refresh()

    def rows(self) -> list[tuple[str, float]]:
        """Words and value 0..1 of every signal, and of all together last; nothing before a point was judged."""
        session = self._session
        judged = session.suspicions.get(session.track or 0)
        if judged is None or session.frame >= len(judged.score):
            return []
        parts = judged.parts[:, session.frame].tolist()
        return [*zip(map(told, SIGNALS.values()), parts, strict=True),
                (tr("suspicion"), float(judged.score[session.frame]))]  # fmt: skip

    def refresh(self, _what: object = None) -> None:
        """Another frame, point or judgement."""
        rows = self.rows()
        if rows != self._rows or not self.accessibleName():
            self._rows = rows
            words = "; ".join(f"{words} {decimal(value, '.2f')}" for words, value in rows)
            self.setAccessibleName(words or tr("Nothing was judged yet."))
            self.update()

    def sizeHint(self) -> QSize:
        """Room for the longest words and all rows."""
        words = [told(w) for w in SIGNALS.values()]
        return QSize(max(self.fontMetrics().horizontalAdvance(w) for w in words) + 96, _ROW * (len(words) + 1) + 4)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Words at the left, bar and value at the right; what says nothing is pale."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, on=True)
        dim, full = self.palette().placeholderText().color(), self.palette().text().color()
        if not self._rows:
            painter.setPen(dim)
            painter.drawText(self.rect(), Qt.AlignmentFlag.AlignTop, tr("Nothing was judged yet."))
            return
        bar, number = 50, 36
        for row, (words, value) in enumerate(self._rows):
            box = QRectF(0, row * _ROW + (4 if row == len(self._rows) - 1 else 0), self.width(), _ROW)
            painter.setPen(full if value >= 0.1 else dim)
            name = QRectF(box.left(), box.top(), box.width() - bar - number - 8, _ROW)
            fitted = self.fontMetrics().elidedText(words, Qt.TextElideMode.ElideRight, int(name.width()))
            painter.drawText(name, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft, fitted)
            painter.drawText(box, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignRight, decimal(value, ".2f"))
            track = QRectF(box.right() - bar - number, box.top() + 4, bar, _ROW - 8)
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(QColor(128, 128, 128, 60))
            painter.drawRoundedRect(track, 2, 2)
            painter.setBrush(QColor(*heat_colour(value)))
            painter.drawRoundedRect(QRectF(track.left(), track.top(), bar * min(value, 1.0), track.height()), 2, 2)
