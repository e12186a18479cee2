"""Icons of resources/icons, drawn in the theme's colours."""

from __future__ import annotations

from functools import lru_cache

from PySide6.QtCore import QByteArray, Qt
from PySide6.QtGui import QIcon, QPainter, QPixmap
from PySide6.QtSvg import QSvgRenderer

from genmojo_studio.theme import ICONS, colours

_SIZES = (16, 20, 32, 48)


@lru_cache(maxsize=256)
def icon(name: str, theme: str) -> QIcon:
    """An icon by the name of its file, in every size that screens of one and two device pixels ask for."""
    table = colours(theme)
    drawing = (ICONS / f"{name}.svg").read_text(encoding="utf-8")
    made = QIcon()
    for mode, colour in (
        (QIcon.Mode.Normal, table.text),
        (QIcon.Mode.Disabled, table.line),
        (QIcon.Mode.Selected, table.on_accent),
    ):
        renderer = QSvgRenderer(QByteArray(drawing.replace("currentColor", colour).encode()))
        for size in _SIZES:
            picture = QPixmap(size, size)
            picture.fill(Qt.GlobalColor.transparent)
            painter = QPainter(picture)
            renderer.render(painter)
            painter.end()
            made.addPixmap(picture, mode)
    return made
