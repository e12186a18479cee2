"""Point tracks: which sets are drawn, how far they are apart in every frame, and where it is worst."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QColor
from PySide6.QtWidgets import (
    QComboBox,
    QFileDialog,
    QHBoxLayout,
    QLabel,
    QLayout,
    QPushButton,
    QTreeWidget,
    QTreeWidgetItem,
    QVBoxLayout,
    QWidget,
)

from genmojo_core.errors import GenmojoError
from genmojo_core.store.scene_file import BakedScene
from genmojo_core.tracks.model import PointTracks
from genmojo_studio import notify
from genmojo_studio.background import Tasks
from genmojo_studio.state import AppState
from genmojo_studio.theme import SERIES
from genmojo_studio.translate import tr
from genmojo_studio.watch import track_overlay, track_sets
from genmojo_studio.watch.controls import row
from genmojo_studio.watch.plots import LatePlot
from genmojo_studio.watch.track_overlay import Chosen
from genmojo_studio.watch.track_sets import Apart, TrackSet, TrackSets

_MOST_WORST = 50


class TracksPanel(QWidget):
    """Sets of tracks and their distance to a reference set. Emits `changed` when what is drawn changes."""

    changed = Signal()

    def __init__(self, state: AppState, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._state = state
        self.sets = TrackSets()
        self._apart: Apart | None = None
        self._chosen: int | None = None  # row of the set that is compared
        self._scene: BakedScene | None = None
        self._tasks = Tasks()
        self.list = QTreeWidget()
        self.list.setHeaderLabels([tr("Tracks"), tr("Origin"), tr("Points")])
        self.list.setRootIsDecorated(False)
        self.which, self.reference = QComboBox(), QComboBox()
        self.plot = LatePlot(state, self._made, self._fill)
        self._here = pg.InfiniteLine(0, angle=90, pen=pg.mkPen(SERIES[1]))
        self.said = QLabel()
        self.said.setProperty("role", "dim")
        self.worst = QTreeWidget()
        self.worst.setHeaderLabels([tr("Track"), tr("Worst frame"), tr("px at 256")])
        self.worst.setRootIsDecorated(False)
        bring, jump = QPushButton(tr("Import…")), QPushButton(tr("Jump to worst"))
        self.follow = QPushButton(tr("Follow through the scene"))
        self.follow.setToolTip(tr("Carries the points of the other set through the 4D scene, hidden or not"))
        bring.clicked.connect(self._ask_import)
        jump.clicked.connect(self.jump_to_worst)
        self.follow.clicked.connect(self.follow_points)
        layout = QHBoxLayout(self)
        layout.setContentsMargins(8, 8, 8, 8)
        layout.addLayout(_column(self.list, row(bring, self.follow)), 3)
        self._choice = (self.which, QLabel(tr("against")), self.reference)
        choice = row(*self._choice, self.said)
        layout.addLayout(_column(choice, self.plot), 5)
        layout.addLayout(_column(self.worst, row(jump)), 3)
        self.list.itemChanged.connect(self._ticked)
        for box in (self.which, self.reference):
            box.activated.connect(self._compare_others)
        self.worst.itemClicked.connect(self._toggle)
        state.subscribe(self._follow_clip, "clip")
        state.subscribe(self._show_frame, "frame")

    @property
    def selected(self) -> Chosen:
        """The selected track, and the one of the reference that it is compared with."""
        row = self._chosen
        if row is None or not self.which.count():
            return ()
        chosen = ((str(self.which.currentData()), row),)
        if self._apart is None or row >= len(self._apart.partner) or self._apart.partner[row] < 0:
            return chosen
        return (*chosen, (str(self.reference.currentData()), int(self._apart.partner[row])))

    def show_scene(self, scene: BakedScene | None) -> None:
        """Takes the predicted tracks of a scene file; None for a run that goes on."""
        self._scene = scene
        self.follow.setEnabled(scene is not None)
        self.sets.drop("predicted")
        if scene is not None and scene.predicted is not None:
            self.sets.put(TrackSet(tr("Scene"), "predicted", scene.predicted))
        self._refill()

    def add(self, name: str, kind: str, tracks: PointTracks) -> None:
        """Adds a set, in source pixels of the clip."""
        self.sets.put(TrackSet(name, kind, tracks))
        self._refill()

    def follow_points(self) -> None:
        """Where the scene carries the points of the reference set: a set "Scene" to compare with it."""
        scene, reference = self._scene, self.sets.sets.get(str(self.reference.currentData()))
        if scene is None or reference is None:
            return
        self.follow.setEnabled(False)
        self._tasks.run(lambda: _carried(scene, reference.tracks), self._take_followed, self._following_failed)

    def close_tasks(self) -> None:
        """No more results."""
        self._tasks.close()

    def jump_to_worst(self) -> None:
        """The track and frame farthest from the reference."""
        if self.worst.topLevelItemCount():
            self._jump(self.worst.topLevelItem(0))

    def _take_followed(self, found: PointTracks) -> None:
        self.follow.setEnabled(True)
        self.add(tr("Scene"), "predicted", found)

    def _following_failed(self, error: BaseException) -> None:
        self.follow.setEnabled(True)
        notify.tell(error, self)

    def _follow_clip(self) -> None:
        self.sets.drop("annotated", "imported")
        clip = self._state.clip
        if clip is not None and clip.tracks is not None:
            self.sets.put(TrackSet(tr("Of the clip"), "annotated", clip.tracks.value))
        self._refill()

    def _refill(self) -> None:
        self.list.blockSignals(True)
        self.list.clear()
        kinds = {"predicted": tr("predicted"), "annotated": tr("annotated"), "imported": tr("imported")}
        for one in self.sets.sets.values():
            item = QTreeWidgetItem([one.name, kinds[one.kind], str(len(one.tracks.state))])
            item.setIcon(1, track_overlay.mark_of(one.kind, QColor(SERIES[0])))
            item.setToolTip(1, tr("Its points have this mark, hollow where they are hidden; trails are dotted there."))
            item.setCheckState(0, Qt.CheckState.Checked if one.shown else Qt.CheckState.Unchecked)
            self.list.addTopLevelItem(item)
        self.list.blockSignals(False)
        chosen = self.which.currentData(), self.reference.currentData()
        defaults = self._first_of("predicted") or self._first_of("imported"), self._first_of("annotated")
        for box, before, default in zip((self.which, self.reference), chosen, defaults, strict=True):
            box.clear()
            for one in self.sets.sets.values():
                box.addItem(one.name, one.name)
            kept = before in self.sets.sets and chosen[0] != chosen[1]
            box.setCurrentIndex(max(box.findData(before if kept else default), 0))
        self._compare()
        self.changed.emit()

    def _first_of(self, kind: str) -> str:
        return next((one.name for one in self.sets.sets.values() if one.kind == kind), "")

    def _compare_others(self) -> None:
        self._compare()
        self.changed.emit()

    def _compare(self) -> None:
        first = self.sets.sets.get(str(self.which.currentData()))
        second = self.sets.sets.get(str(self.reference.currentData()))
        self.worst.clear()
        self._apart = self._chosen = None
        for part in self._choice:
            part.setVisible(bool(self.sets.sets))
        self.said.setText("" if self.sets.sets else tr("Import tracks, or place points in the workspace Annotate."))
        if first is None or second is None or first is second:
            self.plot.draw()
            return
        self._apart = track_sets.apart(first.tracks, second.tracks)
        self.plot.draw()
        known = self._apart.error[np.isfinite(self._apart.error)]
        text = tr("{count} pairs, median {median:.2f} px, states differ in {share:.1f} %")
        if len(known):
            share = 100 * self._apart.state_differs.mean()
            count = int((self._apart.partner >= 0).sum())
            self.said.setText(text.format(count=count, median=float(np.median(known)), share=share))
        for track, frame, distance in self._apart.worst(_MOST_WORST):
            item = QTreeWidgetItem([str(track + 1), str(frame + 1), f"{distance:.1f}"])
            item.setData(0, Qt.ItemDataRole.UserRole, (track, frame))
            self.worst.addTopLevelItem(item)

    def _ticked(self, item: QTreeWidgetItem) -> None:
        self.sets.sets[item.text(0)].shown = item.checkState(0) == Qt.CheckState.Checked
        self.changed.emit()

    def _jump(self, item: QTreeWidgetItem | None) -> None:
        if item is not None:
            track, frame = item.data(0, Qt.ItemDataRole.UserRole)
            self.worst.setCurrentItem(item)
            self._chosen = int(track)
            self._state.set(playing=False, frame=int(frame))
            self.changed.emit()

    def _toggle(self, item: QTreeWidgetItem) -> None:
        """A click on the track that is chosen already lets all stand out alike again."""
        if item.data(0, Qt.ItemDataRole.UserRole) == (self._chosen, self._state.frame):
            self._chosen = None
            self.worst.clearSelection()
            self.changed.emit()
        else:
            self._jump(item)

    def _clicked(self, event: object) -> None:
        if self.plot.plot is not None:
            at = self.plot.plot.getPlotItem().vb.mapSceneToView(event.scenePos())  # type: ignore[attr-defined]
            self._state.set(playing=False, frame=round(at.x()) - 1)

    def _ask_import(self) -> None:
        kinds = tr("Tracks, or the scene of another run") + " (*.npz *.h5 *.hdf5)"
        path, _ = QFileDialog.getOpenFileName(self, tr("Import tracks"), "", kinds)
        if path:
            self.bring(Path(path))

    def bring(self, path: Path) -> None:
        """Adds the tracks of a file; a scene without any carries the reference's points through it."""
        clip, reference = self._state.clip, self.sets.sets.get(str(self.reference.currentData()))
        if clip is None:
            return
        asked = None if reference is None else reference.tracks
        name = path.name if path.name != "scene.h5" else f"{path.parent.name}/{path.name}"
        self._tasks.run(
            lambda: _brought(path, clip.source_size, asked),
            lambda found: self.add(name, "imported", found),
            lambda error: notify.tell(error, self),
        )

    def _show_frame(self) -> None:
        self._here.setValue(self._state.frame + 1)

    def _made(self) -> pg.PlotWidget:
        plot = pg.PlotWidget()
        plot.setLabel("bottom", tr("frame"))
        plot.setLabel("left", tr("px at 256"))
        plot.hideButtons()
        plot.setMouseEnabled(False, False)
        plot.scene().sigMouseClicked.connect(self._clicked)
        return plot

    def _fill(self, plot: pg.PlotWidget) -> None:
        """How far apart the two sets are in every frame."""
        plot.clear()
        plot.addItem(self._here, ignoreBounds=True)
        if self._apart is not None:
            by_frame = self._apart.by_frame()
            pen = pg.mkPen(SERIES[0], width=2)
            plot.plot(np.arange(1, len(by_frame) + 1), by_frame, pen=pen, connect="finite")


def _column(*parts: QWidget | QLayout) -> QVBoxLayout:
    column = QVBoxLayout()
    for part in parts:
        column.addWidget(part) if isinstance(part, QWidget) else column.addLayout(part)
    return column


def _brought(path: Path, size: tuple[int, int], asked: PointTracks | None) -> PointTracks:
    """Tracks of a file in pixels of a clip of `size`. Raises GenmojoError for whatever the file can cause."""
    if path.suffix.lower() not in (".h5", ".hdf5"):
        return track_sets.read(path, size)
    from genmojo_core.store import scene_hdf5

    scene = scene_hdf5.read(path)
    if scene.predicted is not None:
        return scene.predicted.resized(*size)
    if asked is None:
        raise GenmojoError("empty", "holds no tracks, and there are none to carry through it", str(path),
                           "import tracks first")  # fmt: skip
    return _carried(scene, asked).resized(*size)


def _carried(scene: BakedScene, asked: PointTracks) -> PointTracks:
    """Every track of a set from the first frame where it is seen, carried by the scene; in the same order."""
    from genmojo_core.trackers import scene as tracker

    seen = asked.visible[:, : len(scene)]
    rows = np.flatnonzero(seen.any(axis=1))
    t = seen[rows].argmax(axis=1)
    size = scene.cameras.size
    at = asked.resized(*size).xy[rows, t]
    return tracker.track(scene, t, np.clip(at, 0.5, np.array(size) - 0.5))
