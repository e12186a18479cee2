"""What lies under a pixel: the Gaussians that make its colour, and the chosen one's way and parameters over time."""

from __future__ import annotations

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QColor, QIcon, QPixmap
from PySide6.QtWidgets import QComboBox, QHBoxLayout, QTreeWidget, QTreeWidgetItem, QVBoxLayout, QWidget

from genmojo_studio import notify
from genmojo_studio.background import Tasks
from genmojo_studio.state import AppState
from genmojo_studio.theme import SERIES
from genmojo_studio.translate import decimal, tr
from genmojo_studio.view3d.picking import Contributor, Pick
from genmojo_studio.view3d.snapshot import SceneSnapshot
from genmojo_studio.watch import trajectory
from genmojo_studio.watch.controls import line
from genmojo_studio.watch.plots import LatePlot
from genmojo_studio.watch.trajectory import Trajectory

_OWN_NUMBER = (1 << 48) - 1  # the object's id stands above these bits of a Gaussian's number
_MOST_ROWS = 40
_ROW = Qt.ItemDataRole.UserRole
_UID = Qt.ItemDataRole.UserRole + 1


class PickingPanel(QWidget):
    """Filled by a click into the scene. `trajectory_changed` when another Gaussian is followed (or none)."""

    trajectory_changed = Signal()

    def __init__(self, state: AppState, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._state = state
        self._tasks = Tasks()
        self._snapshot: SceneSnapshot | None = None
        self.trajectory: Trajectory | None = None
        self.said = line()
        self.list = QTreeWidget()
        self.list.setHeaderLabels([tr("Object"), tr("Share"), tr("Depth"), tr("Opacity"), tr("Number")])
        self.list.setRootIsDecorated(False)
        self.list.setUniformRowHeights(True)
        self.what = QComboBox()
        for key, text in (
            ("position", tr("Position")),
            ("speed", tr("Speed")),
            ("turn", tr("Turn (°)")),
            ("scale", tr("Size")),
            ("opacity", tr("Opacity")),
            ("colour", tr("Colour")),
        ):
            self.what.addItem(text, key)
        self.plot = LatePlot(state, self._made, self._fill)
        self._here = pg.InfiniteLine(0, angle=90, pen=pg.mkPen(SERIES[1]))
        left, right = QVBoxLayout(), QVBoxLayout()
        left.addWidget(self.said)
        left.addWidget(self.list, 1)
        right.addWidget(self.what, 0, Qt.AlignmentFlag.AlignLeft)
        right.addWidget(self.plot, 1)
        layout = QHBoxLayout(self)
        layout.setContentsMargins(8, 8, 8, 8)
        layout.addLayout(left, 2)
        layout.addLayout(right, 3)
        self.list.itemSelectionChanged.connect(self._follow_chosen)
        self.what.activated.connect(self.plot.draw)
        state.subscribe(self._show_frame, "frame")
        self.clear()

    def clear(self) -> None:
        """Another scene is on show."""
        self._tasks.drop()
        self._snapshot, self.trajectory = None, None
        self.list.clear()
        self.said.setText(tr("Click a place in the scene to see which Gaussians make its colour."))
        self.plot.draw()
        self.trajectory_changed.emit()

    def close_tasks(self) -> None:
        """No more results."""
        self._tasks.close()

    def show_pick(self, pick: Pick | None, snapshot: SceneSnapshot | None) -> None:
        """Lists what a click found."""
        self._snapshot = snapshot
        self.list.clear()
        if pick is None or pick.main is None:
            self.said.setText(tr("Nothing is there."))
            return
        text = tr("{count} Gaussians cover {coverage:.0f} % of pixel ({x:.0f}, {y:.0f}); depth {depth:.3f}.")
        self.said.setText(
            text.format(
                count=len(pick.contributors), coverage=100 * pick.coverage, x=pick.x, y=pick.y, depth=pick.main.depth
            )
        )
        strongest = sorted(pick.contributors, key=lambda one: -one.weight)[:_MOST_ROWS]
        for one in strongest:
            item = _item(one, snapshot is not None and snapshot.object_of(one.object_id).is_background)
            self.list.addTopLevelItem(item)
            if one.row == pick.main.row:
                self.list.setCurrentItem(item)
        for column in range(5):
            self.list.resizeColumnToContents(column)

    def renew(self, snapshot: SceneSnapshot | None) -> None:
        """A newer snapshot of the same run: the way of the Gaussian that is followed, once all frames are known."""
        known = self.trajectory
        if known is None or snapshot is None or snapshot.frames is None or len(known.position) == snapshot.T:
            return
        rows = np.flatnonzero(snapshot.uid == known.uid)
        if len(rows) and not self._tasks.busy:
            row = int(rows[0])
            self._tasks.run(lambda: trajectory.of(snapshot, row), self._take, notify.tell)

    def carry_over(self, snapshot: SceneSnapshot) -> None:
        """The run that was asked has ended: the same Gaussians in its scene, which knows their whole ways."""
        self._snapshot = snapshot
        self.list.blockSignals(True)
        for i in reversed(range(self.list.topLevelItemCount())):
            item = self.list.topLevelItem(i)
            if item is None:
                continue
            rows = np.flatnonzero(snapshot.uid == np.uint64(int(item.data(0, _UID))))
            if len(rows):
                item.setData(0, _ROW, int(rows[0]))
            else:
                self.list.takeTopLevelItem(i)
        self.list.blockSignals(False)
        self._follow_chosen()

    def _follow_chosen(self) -> None:
        item, snapshot = self.list.currentItem(), self._snapshot
        if item is None or snapshot is None:
            return
        row = int(item.data(0, _ROW))
        self._tasks.drop()
        self._tasks.run(lambda: trajectory.of(snapshot, row), self._take, notify.tell)

    def _take(self, found: Trajectory) -> None:
        self.trajectory = found
        self.plot.draw()
        self.trajectory_changed.emit()

    def _made(self) -> pg.PlotWidget:
        plot = pg.PlotWidget()
        plot.setLabel("bottom", tr("frame"))
        plot.addLegend(offset=(-8, 8), labelTextSize="8pt")
        plot.hideButtons()
        return plot

    def _fill(self, plot: pg.PlotWidget) -> None:
        plot.clear()
        plot.addItem(self._here, ignoreBounds=True)
        if self.trajectory is None:
            return
        plot.setXRange(1, max(self._state.frame_count, 2))
        what = str(self.what.currentData())
        for i, (name, values) in enumerate(self.trajectory.curves(what).items()):
            colour = ("#e0524d", "#3fa45b", "#4f8fe0")[i] if what == "colour" else SERIES[i]
            symbol = "o" if len(values) == 1 else None
            frames = np.arange(len(values)) + self.trajectory.first + 1
            plot.plot(frames, values, name=name, pen=pg.mkPen(colour, width=2), symbol=symbol, symbolBrush=colour)

    def _show_frame(self) -> None:
        self._here.setValue(self._state.frame + 1)


def _item(one: Contributor, is_background: bool) -> QTreeWidgetItem:
    texts = [
        tr("Background") if is_background else one.object_name,
        f"{decimal(100 * one.weight, '.1f')} %",
        decimal(one.depth, ".3f"),
        decimal(one.opacity, ".2f"),
        str(one.uid & _OWN_NUMBER),
    ]
    item = QTreeWidgetItem(texts)
    item.setData(0, _ROW, one.row)
    item.setData(0, _UID, str(one.uid))
    picture = QPixmap(14, 14)
    picture.fill(QColor.fromRgbF(*(min(max(c, 0.0), 1.0) for c in one.colour)))
    item.setIcon(0, QIcon(picture))
    for column in range(1, 5):
        item.setTextAlignment(column, Qt.AlignmentFlag.AlignRight)
    return item
