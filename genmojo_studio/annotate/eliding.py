"""Names in narrow columns, shortened so that those which differ still look different."""

from __future__ import annotations

import os
from collections.abc import Callable

from PySide6.QtCore import QModelIndex, QPersistentModelIndex, Qt
from PySide6.QtGui import QFontMetrics
from PySide6.QtWidgets import QApplication, QStyle, QStyledItemDelegate, QStyleOptionViewItem

Index = QModelIndex | QPersistentModelIndex
_DOTS = "…"


class Distinct(QStyledItemDelegate):
    """Draws a column of names; the full name stays what is edited."""

    def initStyleOption(self, option: QStyleOptionViewItem, index: Index) -> None:
        """The text as far as there is room for it, told apart from its siblings."""
        super().initStyleOption(option, index)
        style = option.widget.style() if option.widget is not None else QApplication.style()
        area = style.subElementRect(QStyle.SubElement.SE_ItemViewItemText, option, option.widget)
        margin = style.pixelMetric(QStyle.PixelMetric.PM_FocusFrameHMargin, None, option.widget) + 1
        room = area.width() - 2 * margin
        if room <= 0 or option.fontMetrics.horizontalAdvance(option.text) <= room:
            return
        rows = range(index.model().rowCount(index.parent()))
        names = [str(index.sibling(row, index.column()).data() or "") for row in rows]
        option.text = elided(option.text, names, room, option.fontMetrics)


def elided(name: str, names: list[str], room: int, metrics: QFontMetrics) -> str:
    """A name within `room` pixels: its ends, or what tells it apart where another of `names` would look the same."""

    def middle(text: str) -> str:
        return metrics.elidedText(text, Qt.TextElideMode.ElideMiddle, room)

    short = middle(name)
    same = [other for other in names if other != name and middle(other) == short]
    if not same:
        return short
    differs = max(len(os.path.commonprefix([name, other])) for other in same)
    word = name.rfind(" ", 0, differs) + 1
    return _from(name, word if _tells(name, word, differs, room, metrics.horizontalAdvance) else differs, room, metrics)


def _tells(name: str, start: int, differs: int, room: int, wide: Callable[[str], int]) -> bool:
    """Whether the character that differs is seen in what is shown from `start` on."""
    return wide(_DOTS + name[start : differs + 1] + _DOTS) <= room


def _from(name: str, start: int, room: int, metrics: QFontMetrics) -> str:
    """What begins at `start`, after as much of the name's beginning as there is room for."""
    rest = _DOTS + name[start:]
    head = next((k for k in range(min(start, 8), 0, -1) if metrics.horizontalAdvance(name[:k] + rest) <= room), 0)
    return metrics.elidedText(name[:head] + rest, Qt.TextElideMode.ElideRight, room)
