"""Curves of a run while it goes on: accuracy against time, losses, counts, time of a step, memory."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import Qt, QTimer
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QCheckBox, QComboBox, QHBoxLayout, QLabel, QVBoxLayout, QWidget

from genmojo_core.effects.texts import sentence
from genmojo_core.optimise import gain
from genmojo_studio.state import AppState
from genmojo_studio.theme import SERIES, colours
from genmojo_studio.translate import told, tr
from genmojo_studio.watch import plots
from genmojo_studio.watch.run_log import RunLog

REFRESH_MS = 100  # at most ten times a second
MOST_POINTS = 1000  # per curve; longer ones are thinned
_MARKS = {"stage": Qt.PenStyle.DashLine, "checkpoint": Qt.PenStyle.DotLine, "effect": Qt.PenStyle.DashDotLine}


class Curves(QWidget):
    """One plot with a choice of what it shows; drawn only while it is visible."""

    def __init__(self, state: AppState, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._state = state
        self._log = RunLog()
        self._dirty = True
        self._items: dict[str, pg.PlotDataItem] = {}
        self._mark_items: list[pg.InfiniteLine] = []
        self.what = QComboBox()
        self._drawers: dict[str, tuple[Callable[[], None], str, str]] = {
            "accuracy": (self._draw_accuracy, tr("Accuracy against time"), tr("held-out PSNR (dB)")),
            "losses": (self._draw_losses, tr("Losses"), tr("weighted loss")),
            "gaussians": (self._draw_counts, tr("Gaussians"), tr("Gaussians")),
            "step_ms": (self._draw_times, tr("Time of a step"), tr("ms")),
            "memory": (self._draw_memory, tr("Memory"), tr("MB")),
        }
        for key, (_, text, _) in self._drawers.items():
            self.what.addItem(text, key)
        self.log_axis = QCheckBox(tr("Logarithmic"))
        self.smooth = QCheckBox(tr("Smooth"))
        self.said = QLabel()
        self.said.setProperty("role", "dim")
        self.plot = pg.PlotWidget()
        self.plot.addLegend(offset=(-8, -8), labelTextSize="8pt")
        self.plot.setLabel("bottom", tr("seconds"))
        self.plot.getPlotItem().setDownsampling(auto=True, mode="peak")
        self.plot.setClipToView(True)
        self.plot.hideButtons()
        top = QHBoxLayout()
        for widget in (self.what, self.log_axis, self.smooth):
            top.addWidget(widget)
        top.addStretch()
        top.addWidget(self.said)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(6, 6, 6, 6)
        layout.addLayout(top)
        layout.addWidget(self.plot, 1)
        self.what.currentIndexChanged.connect(self._restart)
        self.log_axis.toggled.connect(self._restart)
        self.smooth.toggled.connect(self._restart)
        self._timer = QTimer(self)
        self._timer.setInterval(REFRESH_MS)
        self._timer.timeout.connect(self._refresh)
        self._timer.start()
        state.subscribe(self._dress, "theme")
        self._dress()

    def show_log(self, log: RunLog) -> None:
        """Draws a run, or what has been added to it; the plot follows at its own pace."""
        if log is not self._log:
            self._log = log
            self._restart()
        self._dirty = True

    def showEvent(self, event: QShowEvent) -> None:
        """What was not drawn while hidden is drawn now."""
        self._dirty = True
        super().showEvent(event)

    def _dress(self) -> None:
        plots.dress(self.plot, self._state.theme)
        self._restart()

    def _restart(self) -> None:
        """Throws the curves away and draws anew."""
        self.plot.clear()
        self._items.clear()
        self._mark_items.clear()
        _, _, unit = self._drawers[self.what.currentData()]
        logarithmic = self.log_axis.isChecked()
        self.plot.setLogMode(x=False, y=logarithmic)
        self.plot.setLabel("left", unit)
        self.plot.enableAutoRange()
        self._dirty = True

    def _refresh(self) -> None:
        if not self._dirty or not self.isVisible():
            return
        self._dirty = False
        self._drawers[self.what.currentData()][0]()
        self._draw_marks()
        plots.settle(self.plot)

    def _draw_accuracy(self) -> None:
        rows = [(at, value) for at, _, value in self._log.accuracy]
        curve = np.array(rows, np.float64).reshape(-1, 2)
        self._set("measured", tr("measured"), curve[:, 0], curve[:, 1], 0)
        found = gain.expected(rows)
        if found is None:
            self.said.setText("")
            return
        last = curve[-1, 0]
        ahead = np.linspace(last, last + found.seconds, 30)
        self._set(
            "expected", tr("expected"), ahead, found.at(ahead) + curve[-1, 1] - found.at(ahead[:1]), 1, dashed=True
        )
        text = tr("the next minute buys {gain:+.2f} ± {spread:.2f} dB")
        self.said.setText(text.format(gain=found.decibel, spread=found.spread))

    def _draw_losses(self) -> None:
        self.said.setText("")
        seconds = self._log.column("seconds")
        for i, name in enumerate(self._log.losses):
            values = self._log.column(name)
            self._set(
                name, name, seconds, np.where(values > 0, values, np.nan) if self.log_axis.isChecked() else values, i
            )

    def _draw_counts(self) -> None:
        self._one("gaussians")

    def _draw_times(self) -> None:
        self._one("step_ms")

    def _draw_memory(self) -> None:
        rows = np.array(self._log.memory, np.float64).reshape(-1, 2)
        self._set("memory", tr("worker"), rows[:, 0], rows[:, 1], 0)
        self.said.setText(f"{rows[:, 1].max():.0f} MB" if len(rows) else "")

    def _one(self, name: str) -> None:
        values = self._log.column(name)
        self._set(name, self.what.currentText(), self._log.column("seconds"), values, 0)
        known = values[np.isfinite(values)]
        self.said.setText(tr("median {value:.0f}").format(value=np.median(known)) if len(known) else "")

    def _set(self, key: str, text: str, x: np.ndarray, y: np.ndarray, colour: int, dashed: bool = False) -> None:
        if key not in self._items:
            style = Qt.PenStyle.DashLine if dashed else Qt.PenStyle.SolidLine
            pen = pg.mkPen(SERIES[colour % len(SERIES)], width=2, style=style)
            self._items[key] = self.plot.plot(name=text, pen=pen, connect="finite")
        if self.smooth.isChecked() and len(y) > 8 and not dashed:
            y = _smoothed(y)
        stride = max(1, len(x) // MOST_POINTS)
        self._items[key].setData(x[::stride], y[::stride])

    def _draw_marks(self) -> None:
        table = colours(self._state.theme)
        for mark in self._log.marks[len(self._mark_items) :]:
            pen = pg.mkPen(table.bad if mark.kind == "warning" else table.dim, style=_MARKS.get(mark.kind))
            label = told(mark.text) if mark.kind == "stage" else None
            options = {"position": 0.08, "color": table.dim, "rotateAxis": (1, 0), "anchors": [(0, 0), (0, 1)]}
            line = pg.InfiniteLine(mark.seconds, angle=90, pen=pen, label=label, labelOpts=options)
            line.setToolTip(sentence(mark.said, tr) or told(mark.text))
            self.plot.addItem(line, ignoreBounds=True)
            self._mark_items.append(line)


def _smoothed(values: np.ndarray) -> np.ndarray:
    """Running mean over a twentieth of the curve, NaN kept out of it."""
    width = max(3, len(values) // 20)
    kernel = np.ones(width)
    known = np.isfinite(values)
    total = np.convolve(np.where(known, values, 0.0), kernel, "same")
    count = np.convolve(known.astype(np.float64), kernel, "same")
    return np.where(known, total / np.maximum(count, 1), np.nan)
