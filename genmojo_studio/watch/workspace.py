"""The workspace Watch: the scene in the middle, panels around it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

from PySide6.QtCore import QByteArray, Qt, QTimer, Signal
from PySide6.QtGui import QCloseEvent, QColor, QHideEvent, QShowEvent
from PySide6.QtWidgets import QDockWidget, QMainWindow, QTabWidget, QVBoxLayout, QWidget

from genmojo_studio import notify, theme
from genmojo_studio.actions import ActionTable
from genmojo_studio.background import Tasks
from genmojo_studio.panels import Panels
from genmojo_studio.settings import Settings
from genmojo_studio.state import AppState
from genmojo_studio.translate import tr
from genmojo_studio.undo import UndoStack
from genmojo_studio.view3d.picking import Pick
from genmojo_studio.watch import commands
from genmojo_studio.watch.actions import PANELS
from genmojo_studio.watch.appearance import Appearance
from genmojo_studio.watch.center import Center
from genmojo_studio.watch.compare_panel import ComparePanel
from genmojo_studio.watch.controls import scrolled
from genmojo_studio.watch.curves import Curves
from genmojo_studio.watch.draw_cost import DrawCost
from genmojo_studio.watch.leaving import may_leave
from genmojo_studio.watch.live_view import LiveView
from genmojo_studio.watch.objects_panel import ObjectsPanel
from genmojo_studio.watch.picking_panel import PickingPanel
from genmojo_studio.watch.player import Player
from genmojo_studio.watch.run_control import RunControl
from genmojo_studio.watch.run_log import RunLog
from genmojo_studio.watch.run_setup import RunSetup
from genmojo_studio.watch.run_status import RunStatus
from genmojo_studio.watch.session import Session
from genmojo_studio.watch.take_away import TakeAway
from genmojo_studio.watch.time_bar import TimeBar
from genmojo_studio.watch.track_sets import TrackSet
from genmojo_studio.watch.tracks_panel import TracksPanel
from genmojo_studio.watch.view_panel import BACKDROP, ViewPanel

_LAYOUT_VERSION = 1


class WatchWorkspace(QMainWindow):
    """Optimise, look at, question, compare and take away a scene. `said(text)`: what it is doing, "" for nothing.

    `parts` makes what is in it, one part each time; whoever makes a workspace goes through it to the end.
    """

    said = Signal(str)

    def __init__(self, state: AppState, actions: ActionTable, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.state = state
        self.table = actions
        self.undo = UndoStack()
        self.tracks_shown = True
        self._sizes_wait = False
        self.parts = self._make()

    def _make(self) -> Iterator[None]:
        """Everything in it, part by part; it is of use when all are there."""
        state, actions = self.state, self.table
        self.appearance = Appearance(self.undo, self)
        self.tasks = Tasks()
        self.session = Session(state, self.tasks, self)
        self.control = RunControl(self)
        self.player = Player(state, self.isVisible, self)
        yield
        self.view = LiveView(state, self.appearance, self.undo)
        self.draw_cost = DrawCost(self.view, self.control.client, self)
        self.control.draw_share = lambda: self.draw_cost.share
        yield
        self.compare = ComparePanel(state)
        self.center = Center(state, actions, self.session, self.view, self.compare.pane)
        yield
        self.view_panel = ViewPanel(state, actions, self.appearance)
        self.objects_panel = ObjectsPanel(state, actions, self.appearance)
        yield
        self.setup = RunSetup(state)
        yield
        self.status = RunStatus(state, actions, self.control)
        yield
        self.curves = Curves(state)
        yield
        self.picking = PickingPanel(state)
        self.tracks = TracksPanel(state)
        self.take_away = TakeAway(state, self.session, self.view, self.control, self)
        yield
        yield from self._arrange()
        self._connect()
        self._dress()
        commands.bind(self)

    def opening(self, path: Path) -> Iterator[None]:
        """Shows the clip of the shared state; a scene of another clip goes away."""
        self._open_clip(path)
        yield

    def _open_clip(self, path: Path) -> None:
        scene = self.session.scene
        if scene is not None and str(scene.config.get("input", "")) == str(path):
            return
        request = self.control.client.request
        if (
            self.control.live
            and request is not None
            and request.clip != str(path)
            and not may_leave(self.control, self)
        ):
            return
        if not self.control.live:
            self.session.clear()
            self.center.set_mode("side")
        self._clip_changed()

    def open_path(self, path: Path, kind: str) -> None:
        """Shows a scene file, a PLY (or a folder of them), or a run folder."""
        if kind == "scene":
            self.session.open_scene(path)
        elif kind == "ply":
            self.session.open_ply(path)
        else:
            commands.open_run(self, path)

    def save_layout(self) -> None:
        """Remembers where the panels are."""
        Settings().put_layout("watch", self.panels.layout())

    def restore_layout(self) -> None:
        """Puts the panels where they were, or where they were delivered."""
        stored = Settings().layout("watch")
        if stored is not None:
            self.restoreState(stored, _LAYOUT_VERSION)
        else:
            self.restoreState(self._delivered, _LAYOUT_VERSION)
            self._sizes_wait = True
            self._deliver_later()
        self.panels.arranged()

    def closeEvent(self, event: QCloseEvent) -> None:
        """Asks what becomes of a run that goes on."""
        if not may_leave(self.control, self):
            event.ignore()
            return
        self.setup.close_processes()
        self.take_away.close()
        self.center.comparison.close()
        self.picking.close_tasks()
        self.tracks.close_tasks()
        self.view_panel.map.close_tasks()
        self.compare.close_tasks()
        self.view.close()
        self.tasks.close()
        event.accept()

    def showEvent(self, event: QShowEvent) -> None:
        """Somebody looks again."""
        super().showEvent(event)
        self.control.show_view(True)
        self._deliver_later()

    def hideEvent(self, event: QHideEvent) -> None:
        """Minimised, or the other workspace is on show."""
        super().hideEvent(event)
        self.control.show_view(False)

    def _arrange(self) -> Iterator[None]:
        middle = QWidget()
        layout = QVBoxLayout(middle)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(0)
        layout.addWidget(self.center, 1)
        layout.addWidget(TimeBar(self.state, self.table, self.player))
        self.setCentralWidget(middle)
        self.run_tabs = QTabWidget()
        self.run_tabs.setDocumentMode(True)
        self.run_tabs.addTab(scrolled(_padded(self.setup)), tr("New run"))
        self.run_tabs.addTab(scrolled(_padded(self.status)), tr("This run"))
        self.setDockOptions(QMainWindow.DockOption.AllowTabbedDocks | QMainWindow.DockOption.AllowNestedDocks)
        self.setTabPosition(Qt.DockWidgetArea.AllDockWidgetAreas, QTabWidget.TabPosition.North)
        left, right, bottom = (
            Qt.DockWidgetArea.LeftDockWidgetArea,
            Qt.DockWidgetArea.RightDockWidgetArea,
            Qt.DockWidgetArea.BottomDockWidgetArea,
        )
        yield
        self.setCorner(Qt.Corner.BottomRightCorner, right)
        self.setCorner(Qt.Corner.BottomLeftCorner, left)
        made: dict[str, tuple[Callable[[], QWidget], Qt.DockWidgetArea]] = {
            "view": (partial(scrolled, self.view_panel), left),
            "objects": (lambda: self.objects_panel, left),
            "run": (lambda: self.run_tabs, right),
            "curves": (partial(scrolled, self.curves, True), bottom),
            "picking": (partial(scrolled, self.picking, True), bottom),
            "tracks": (partial(scrolled, self.tracks, True), bottom),
            "compare": (partial(scrolled, self.compare, True), bottom),
        }
        self.docks = {}
        for name, title in PANELS:
            widget, area = made[name]
            self.docks[name] = self._dock(name, tr(title), widget(), area)
            yield
        for name in ("picking", "tracks", "compare"):
            self.tabifyDockWidget(self.docks["curves"], self.docks[name])
        self.docks["curves"].raise_()
        self._delivered: QByteArray = self.saveState(_LAYOUT_VERSION)
        self.panels = Panels(self, self.docks, "watch", _LAYOUT_VERSION)

    def _deliver_later(self) -> None:
        """Sizes hold only once the window has its own."""
        if self._sizes_wait and self.isVisible():
            self._sizes_wait = False
            QTimer.singleShot(0, self, self._deliver_sizes)

    def _deliver_sizes(self) -> None:
        """A third of the height for the panels below, a fifth of the width for each side."""
        wide = max(290, self.width() // 6), max(380, self.width() // 5)
        self.resizeDocks([self.docks["view"], self.docks["run"]], list(wide), Qt.Orientation.Horizontal)
        self.resizeDocks([self.docks["curves"]], [self.height() // 3], Qt.Orientation.Vertical)
        self.resizeDocks([self.docks["view"], self.docks["objects"]], [540, 240], Qt.Orientation.Vertical)

    def _dock(self, name: str, title: str, widget: QWidget, area: Qt.DockWidgetArea) -> QDockWidget:
        dock = QDockWidget(title)
        dock.setObjectName(name)
        dock.setWidget(widget)
        self.addDockWidget(area, dock)
        return dock

    def _connect(self) -> None:
        session, control = self.session, self.control
        session.busy.connect(self.said)
        session.snapshot_changed.connect(self._show_snapshot)
        session.scene_changed.connect(self._scene_changed)
        control.snapshot.connect(session.take_preview)
        control.log_grew.connect(self._log_grew)
        control.failed.connect(self._tell)
        control.began.connect(self.compare.forget_checkpoints)
        control.checkpointed.connect(self.compare.keep_checkpoint)
        control.ended.connect(self._run_ended)
        control.quiet.connect(self.view.set_quiet)
        self.setup.start_wanted.connect(lambda: self.table.trigger("run.start"))
        self.status.resume_button.clicked.connect(self._resume)
        self.view.view_changed.connect(self._show_orbit)
        self.view.frame_drawn.connect(self._show_comparison)
        self.view.picked.connect(self._picked)
        self.picking.trajectory_changed.connect(self._show_tracks)
        self.compare.request_wanted.connect(self._show_comparison)
        self.compare.active_changed.connect(self.center.set_beside)
        self.view_panel.orbit_wanted.connect(self.view.set_orbit)
        self.view_panel.backdrop_changed.connect(self._dress)
        self.center.comparison.measured.connect(self.objects_panel.show_psnr)
        self.tracks.changed.connect(self._show_tracks)
        self.appearance.changed.connect(self._look_changed)
        self.state.subscribe(self._dress, "theme")
        self.state.subscribe(self._frame_changed, "frame")
        self.state.subscribe(self._clip_changed, "clip")
        self.state.subscribe(self._masks_changed, "masks_path", "clip")

    def _show_snapshot(self) -> None:
        snapshot = self.session.snapshot
        self.view.show_snapshot(snapshot)
        self.objects_panel.show_snapshot(snapshot)
        self.picking.renew(snapshot)
        self.compare.show_first(self._scene_name(), snapshot, self.session.scene)
        self._show_orbit()

    def _scene_name(self) -> str:
        path = self.session.path
        return tr("This run") if path is None else path.parent.name if path.name == "scene.h5" else path.name

    def _show_comparison(self) -> None:
        if self.compare.active:
            self.compare.show_request(self.view.request(), (self.view.width(), self.view.height()))

    def _scene_changed(self) -> None:
        self.undo.clear()
        scene, snapshot = self.session.scene, self.session.snapshot
        self.tracks.show_scene(scene)
        if scene is not None and not self.control.log.step:
            self.curves.show_log(RunLog.of_scene(scene.curve))
        if scene is not None and snapshot is not None and self.session.path == self.control.scene_path:
            self.picking.carry_over(snapshot)
        else:
            self.picking.clear()

    def _clip_changed(self) -> None:
        clip = self.state.clip
        if clip is not None and len(clip.seconds) > 1:
            self.player.fps = (len(clip.seconds) - 1) / max(float(clip.seconds[-1] - clip.seconds[0]), 1e-6)

    def _dress(self) -> None:
        """What is behind the scene: the canvas of the theme, or the colour that a person chose."""
        self.appearance.set_backdrop(QColor(Settings().text(BACKDROP) or theme.colours(self.state.theme).canvas))

    def _masks_changed(self) -> None:
        """Corrected masks call for another plan: it is shown again."""
        if self.state.masks_path is not None and not self.control.live:
            self.run_tabs.setCurrentIndex(0)

    def _frame_changed(self) -> None:
        if self.control.live and not self.state.playing:
            self.control.look(self.state.frame)
        self._show_orbit()

    def _show_orbit(self) -> None:
        snapshot = self.session.snapshot
        if self.view.snapshot is not None and snapshot is not None:
            self.view_panel.show_orbit(self.view.orbit, self.view.reference(), snapshot.supervised)

    def _look_changed(self) -> None:
        self.center.show_render_mode(str(self.appearance.look.mode))

    def _show_tracks(self) -> None:
        shown = list(self.tracks.sets.sets.values()) if self.tracks_shown else []
        followed, snapshot = self.picking.trajectory, self.session.snapshot
        extra = []
        if followed is not None and snapshot is not None and len(followed.position) == snapshot.T:
            extra.append(TrackSet("", "imported", followed.as_track((1, 1))))
        self.view.show_tracks([*shown, *extra], self.tracks.selected)
        self.center.input_picture.show_tracks(shown, self.tracks.selected)
        self.center.joined_picture.show_tracks(shown, self.tracks.selected)

    def _picked(self, found: Pick) -> None:
        self.picking.show_pick(found, self.session.snapshot)
        self.docks["picking"].raise_()
        snapshot = self.session.snapshot
        if self.control.live and snapshot is not None and snapshot.frames is None:
            self.control.sweep()  # the other frames, for its trajectory
        if found.main is not None:
            self.state.set(selected_object=found.main.object_id)

    def _log_grew(self) -> None:
        self.curves.show_log(self.control.log)

    def _run_ended(self, scene: Path) -> None:
        self.setup.came(self.control.log)
        self.session.open_scene(scene)

    def _resume(self) -> None:
        if self.control.run_dir is not None:
            self.control.resume(self.control.run_dir)

    def _tell(self, error: BaseException) -> None:
        notify.tell(error, self)


def _padded(inside: QWidget) -> QWidget:
    holder = QWidget()
    layout = QVBoxLayout(holder)
    layout.setContentsMargins(8, 8, 8, 8)
    layout.addWidget(inside)
    return holder
