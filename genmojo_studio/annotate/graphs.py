"""Curves of the active track over time: position, speed, confidence, suspicion.

A click goes to that frame, a double click shows the whole curve again after zooming. The frames on show are those of
the dope sheet (`TimeView`).
In the curves of x and y the keys are knots: dragging one up or down moves the key.
"""

from __future__ import annotations

import numpy as np
import pyqtgraph as pg
from pyqtgraph.GraphicsScene.mouseEvents import HoverEvent, MouseDragEvent
from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QComboBox, QHBoxLayout, QVBoxLayout, QWidget

from genmojo_core.tracks.annotation import KEY
from genmojo_core.tracks.model import NONE
from genmojo_studio.annotate.colours import point_colour
from genmojo_studio.annotate.session import Session
from genmojo_studio.annotate.signal_bars import SignalBars
from genmojo_studio.annotate.time_view import TimeView
from genmojo_studio.translate import tr


class Knots(pg.ScatterPlotItem):
    """Keys on a curve; where `loose`, each can be dragged up and down."""

    dropped = Signal(int, float)  # place of the knot, its new value

    def __init__(self, frames: np.ndarray, values: np.ndarray, loose: bool) -> None:
        super().__init__(frames, values, symbol="d", size=11, brush="w", pen="k", hoverable=loose, hoverSize=15)
        self._frames, self._values, self._loose = frames, values, loose
        self._held: int | None = None

    def hoverEvent(self, event: HoverEvent) -> None:
        """A drag that begins on a knot is the knot's, not the plot's."""
        super().hoverEvent(event)
        if self._loose and not event.isExit() and len(self.pointsAt(event.pos())):
            event.acceptDrags(Qt.MouseButton.LeftButton)

    def mouseDragEvent(self, event: MouseDragEvent) -> None:
        """Hold the knot under the button's press until it comes up."""
        if event.button() != Qt.MouseButton.LeftButton or not self._loose:
            event.ignore()
            return
        if event.isStart():
            under = self.pointsAt(event.buttonDownPos())
            self._held = int(under[0].index()) if len(under) else None
        if self._held is None:
            event.ignore()
            return
        event.accept()
        box = self.getViewBox()
        box.enableAutoRange(axis=box.YAxis, enable=event.isFinish())  # a scale that moved along would run away
        values = self._values.copy()
        values[self._held] = event.pos().y()
        self.setData(self._frames, values)
        if event.isFinish():
            held, self._held = self._held, None
            self.dropped.emit(held, float(values[held]))


class Graphs(QWidget):
    """One plot with the curve chosen, of the active track and faintly of its object's others."""

    seek = Signal(int)
    moved = Signal(int, int, float, float)  # track, frame, raster x and y: a knot was dragged there

    def __init__(self, session: Session, view: TimeView, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session, self._view = session, view
        self._zoomed = self._placing = False  # whether the frames on show were chosen here; are being put on show now
        self.measures: dict[int, dict[str, np.ndarray]] = {}  # track -> name -> (T,), e.g. forward-backward error
        self.choice = QComboBox()
        self.choice.addItems([tr("x"), tr("y"), tr("speed (px per frame)"), tr("acceleration"), tr("confidence"),
                              tr("suspicion"), tr("forward-backward error (px)"), tr("likeness (NCC)")])  # fmt: skip
        self.choice.setAccessibleName(tr("Curve"))
        self.choice.currentIndexChanged.connect(self.refresh)
        self.plot = pg.PlotWidget()
        self.plot.setAccessibleName(tr("Curve over frames"))
        self.plot.showGrid(x=True, y=True, alpha=0.2)
        self.plot.setLabel("bottom", tr("frame"))
        self.plot.setMenuEnabled(False)
        self.plot.setFocusPolicy(Qt.FocusPolicy.NoFocus)  # keys move frames and points, as everywhere
        self.plot.getPlotItem().hideButtons()
        self.plot.setBackground(None)
        self._now = pg.InfiniteLine(angle=90, pen=pg.mkPen(70, 140, 220, width=2))
        self.plot.addItem(self._now)
        self.plot.scene().sigMouseClicked.connect(self._clicked)
        self.plot.getViewBox().setAutoVisible(y=True)  # the scale of y belongs to the frames on show
        self.plot.setXRange(view.first - 0.5, view.end - 0.5, padding=0)  # from now on never by itself
        self.plot.getViewBox().sigXRangeChanged.connect(self._scrolled)
        view.changed.connect(self._follow)
        row = QHBoxLayout(self)
        row.setContentsMargins(4, 4, 4, 4)
        left = QVBoxLayout()
        left.addWidget(self.choice)
        self.bars = SignalBars(session)
        left.addWidget(self.bars)
        left.addStretch()
        row.addLayout(left)
        row.addWidget(self.plot, 1)
        self._lines: list[pg.GraphicsObject] = []
        self.knots: Knots | None = None
        self._drawn: tuple[tuple[int, int], int] | None = None  # point and curve on show
        session.edited.connect(self._later)
        session.selected.connect(self._later)
        session.frame_changed.connect(self._move)

    def set_measures(self, measures: dict[int, dict[str, np.ndarray]]) -> None:
        """What the pictures say about tracks: forward-backward error and likeness, (T,) each."""
        self.measures |= {t: {n: v for n, v in m.items() if v is not None} for t, m in measures.items()}
        self._later()

    def showEvent(self, event: object) -> None:
        """Curves are made when they are looked at."""
        self.refresh()

    def refresh(self) -> None:
        """Draw the curves again."""
        for line in self._lines:
            self.plot.removeItem(line)
        self._lines, self.knots = [], None
        session = self._session
        drawn = (session.active, self.choice.currentIndex())
        if drawn != self._drawn:  # a range that was zoomed belongs to the curve before
            self._drawn = drawn
            self._fit(time=self._zoomed)
        place = session.place_of(session.active[0])
        for info in session.annotation.tracks_of(session.active[0]):
            values = self._values(info.id)
            own = info.id == session.track
            colour = (*point_colour(place, info.number - 1), 255 if own else 70)
            pen = pg.mkPen(colour, width=2 if own else 1)
            self._lines.append(self.plot.plot(np.arange(len(values)), values, pen=pen, connect="finite"))
            if own:
                self.knots = self._knots(info.id, values)
                self.plot.addItem(self.knots)
                self._lines.append(self.knots)
        self._follow()
        self._move(session.frame)

    def _knots(self, track: int, values: np.ndarray) -> Knots:
        """The keys of a track on its curve."""
        keys, axis = self._session.annotation.keys(track), self.choice.currentIndex()
        knots = Knots(keys, values[keys], axis < 2 and not self._session.annotation.tracks[track].locked)

        def dropped(place: int, value: float) -> None:
            frame = int(keys[place])
            xy = self._session.annotation.track(track).xy[frame].tolist()
            xy[axis] = value
            self.moved.emit(track, frame, *xy)

        knots.dropped.connect(dropped)
        return knots

    def _values(self, track: int) -> np.ndarray:  # (T,), NaN where unknown
        cells = self._session.annotation.track(track)
        xy = np.where((cells.state == NONE)[:, None], np.nan, cells.xy.astype(float))
        kind = self.choice.currentIndex()
        if kind < 2:
            return xy[:, kind]
        if kind < 4:
            steps = np.diff(xy, axis=0, n=kind - 1)
            length = np.hypot(steps[:, 0], steps[:, 1])
            return np.concatenate([np.full(len(xy) - len(length), np.nan), length])
        if kind == 4:
            return np.where(cells.flags & KEY, 1.0, cells.conf)
        if kind == 5:
            return self._session.suspicion.get(track, np.zeros(len(xy)))
        return self.measures.get(track, {}).get("fb" if kind == 6 else "ncc", np.full(len(xy), np.nan))

    def _later(self, _what: object = None) -> None:
        if self.isVisible():
            self.refresh()

    def _move(self, frame: int) -> None:
        if self.isVisible():
            self._now.setValue(frame)

    def _fit(self, *, time: bool) -> None:
        """The whole height of the curve, and with `time` the whole clip."""
        box = self.plot.getViewBox()
        box.enableAutoRange(axis=box.YAxis)
        if time:
            self._view.fit()
            self._follow()

    def _follow(self) -> None:
        """Show the frames that the dope sheet shows; values stand in the middle of its cells."""
        if self.isVisible() and not self._placing:
            self._placing, self._zoomed = True, False
            self.plot.setXRange(self._view.first - 0.5, self._view.end - 0.5, padding=0)
            self._placing = False

    def _scrolled(self, _box: object, frames: tuple[float, float]) -> None:
        """The frames on show were chosen with the mouse in the graph: the dope sheet follows."""
        if not self._placing:
            self._placing = self._zoomed = True
            self._view.show(frames[0] + 0.5, frames[1] + 0.5)
            self._placing = False

    def _clicked(self, event: object) -> None:
        """A click goes to the frame; a second one right after it shows the whole curve again."""
        if event.double():  # type: ignore[attr-defined]
            self._fit(time=True)
            return
        place = self.plot.getPlotItem().vb.mapSceneToView(event.scenePos())  # type: ignore[attr-defined]
        if event.button() == Qt.MouseButton.LeftButton:  # type: ignore[attr-defined]
            self.seek.emit(round(place.x()))
