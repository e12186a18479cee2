"""A decoded frame as something that can be painted: as it is while frames fly by, without aliasing once they rest."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QRectF
from PySide6.QtGui import QImage, QPainter

from genmojo_studio.annotate.mapping import Mapping
from genmojo_studio.annotate.patches import shrunk


class FrameImage:
    """A frame (H, W, 4) BGRA and its last copy of less resolution."""

    def __init__(self, frame: np.ndarray) -> None:
        height, width = frame.shape[:2]
        self.frame = frame
        self._image = QImage(frame.data, width, height, 4 * width, QImage.Format.Format_RGB32)
        self._small: tuple[tuple[int, int], np.ndarray, QImage] | None = None

    def paint(self, painter: QPainter, mapping: Mapping, *, fine: bool) -> None:
        """Draw it; `fine` takes longer where the frame is shown smaller than it is."""
        height, width = self.frame.shape[:2]
        target = QRectF(*mapping.to_widget(0, 0), width * mapping.zoom, height * mapping.zoom)
        ratio = painter.device().devicePixelRatioF()
        pixels = round(target.width() * ratio), round(target.height() * ratio)
        if not fine or pixels[0] >= width:
            painter.drawImage(target, self._image)
            return
        if self._small is None or self._small[0] != pixels:
            small = shrunk(self.frame, pixels)
            image = QImage(small.data, pixels[0], pixels[1], 4 * pixels[0], QImage.Format.Format_RGB32)
            self._small = (pixels, small, image)
        painter.drawImage(target, self._small[2])
