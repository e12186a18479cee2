"""Plots in the colours of the theme.

Without grid lines: drawing them takes more than all the rest of a plot, and curves are repainted while a run goes on.
"""

from __future__ import annotations

from collections.abc import Callable

import pyqtgraph as pg
from PySide6.QtCore import QTimer
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QVBoxLayout, QWidget

from genmojo_studio.state import AppState
from genmojo_studio.theme import colours

_MARGINS = (2, 10, 10, 2)  # left, top, right, bottom: the highest number of an axis is not cut off


class LatePlot(QWidget):
    """A plot that is made when it is first on show: that takes 50 ms, and most lie behind other panels.

    Args:
        state: its theme is followed. make: makes the plot; `draw` fills it, then and whenever it is asked for anew.
    """

    def __init__(
        self, state: AppState, make: Callable[[], pg.PlotWidget], draw: Callable[[pg.PlotWidget], None]
    ) -> None:
        super().__init__()
        self._state, self._make, self._draw = state, make, draw
        self.plot: pg.PlotWidget | None = None
        self._theme = ""  # that it wears
        state.subscribe(self._dress, "theme")
        self._layout = QVBoxLayout(self)
        self._layout.setContentsMargins(0, 0, 0, 0)

    def draw(self) -> None:
        """Draws what there is to draw, if anybody has ever looked."""
        if self.plot is not None:
            self._draw(self.plot)
            settle(self.plot)

    def showEvent(self, event: QShowEvent) -> None:
        """Somebody looks."""
        super().showEvent(event)
        if self.plot is None:
            QTimer.singleShot(0, self, self._come)
        self._dress()

    def _come(self) -> None:
        """The plot is made, and filled in the turn after that; not for a panel that only showed up for a moment."""
        if self.plot is None and self.isVisible():
            self.plot = self._make()
            self._layout.addWidget(self.plot)
            self._dress()
            QTimer.singleShot(0, self, self.draw)

    def _dress(self) -> None:
        """In the theme's colours, once somebody looks."""
        if self.plot is not None and self.isVisible() and self._theme != self._state.theme:
            self._theme = self._state.theme
            dress(self.plot, self._theme)


def dress(plot: pg.PlotWidget, theme: str) -> None:
    """Gives a plot the colours of a theme."""
    table = colours(theme)
    plot.setBackground(table.field)
    plot.getPlotItem().setContentsMargins(*_MARGINS)
    for side in ("bottom", "left"):
        axis = plot.getAxis(side)
        axis.setPen(table.line)
        axis.setTextPen(table.text)
        axis.setLabel(axis.labelText, color=table.dim)
    legend = plot.getPlotItem().legend
    if legend is not None:
        legend.setLabelTextColor(table.text)


def settle(plot: pg.PlotWidget) -> None:
    """Fits the axes to what was drawn now: left to the next repaint, their numbers could stay as they were before.

    A plot of nothing has no numbers.
    """
    has_values = any(item.xData is not None and len(item.xData) for item in plot.listDataItems())
    for side in ("bottom", "left"):
        plot.getAxis(side).setStyle(showValues=has_values)
    plot.getPlotItem().getViewBox().updateAutoRange()
