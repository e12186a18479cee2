"""Plots in the colours of the theme.

Without grid lines: drawing them takes more than all the rest of a plot, and curves are repainted while a run goes on.
"""

from __future__ import annotations

import pyqtgraph as pg

from genmojo_studio.theme import colours


def dress(plot: pg.PlotWidget, theme: str) -> None:
    """Gives a plot the colours of a theme."""
    table = colours(theme)
    plot.setBackground(table.field)
    for side in ("bottom", "left"):
        axis = plot.getAxis(side)
        axis.setPen(table.line)
        axis.setTextPen(table.text)
        axis.setLabel(axis.labelText, color=table.dim)
    legend = plot.getPlotItem().legend
    if legend is not None:
        legend.setLabelTextColor(table.text)
