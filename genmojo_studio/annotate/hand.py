"""What the hand on the canvas has got hold of: a point that is being dragged, and the reticle that shows where."""

from __future__ import annotations

import math
from dataclasses import dataclass

from PySide6.QtCore import QPointF
from PySide6.QtGui import QColor, QPainter, QPen

from genmojo_studio.annotate.overlay import Mark

SLACK = 4.0  # widget pixels: a press that moves less is a click
FINE = 0.125  # speed of a drag with Shift
RETICLE = (6, 120)  # least and most length of the reticle's arms, in widget pixels
_GAP = 3.0


@dataclass
class Hold:
    """A mark under a pressed button, the press in widget pixels, and where the mark is by now: None until it moves."""

    mark: Mark
    press: QPointF
    xy: tuple[float, float] | None = None

    def move(self, before: QPointF, now: QPointF, zoom: float, *, fine: bool) -> None:
        """The mouse went from one widget position to another; nothing moves within SLACK of the press."""
        if self.xy is None:
            if length(now - self.press) <= SLACK:
                return
            self.xy, before = self.mark.xy, self.press
        step = (now - before) * ((FINE if fine else 1.0) / zoom)
        self.xy = (self.xy[0] + step.x(), self.xy[1] + step.y())


def draw_reticle(painter: QPainter, at: QPointF, arm: float) -> None:
    """Four arms with a gap, dark under light, so that it shows on any picture."""
    for colour, width in ((QColor(0, 0, 0, 170), 3.0), (QColor(255, 255, 255), 1.0)):
        painter.setPen(QPen(colour, width))
        for dx, dy in ((1, 0), (-1, 0), (0, 1), (0, -1)):
            painter.drawLine(at + QPointF(dx * _GAP, dy * _GAP), at + QPointF(dx * arm, dy * arm))


def length(vector: QPointF) -> float:
    """Length of a vector in widget pixels."""
    return math.hypot(vector.x(), vector.y())
