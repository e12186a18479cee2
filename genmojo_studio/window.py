"""The one window: start page, the two workspaces, menus, opening and closing."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, Protocol, cast

from PySide6.QtCore import Qt, QTimer
from PySide6.QtGui import QCloseEvent, QDragEnterEvent, QDropEvent, QShowEvent
from PySide6.QtWidgets import QApplication, QDialog, QFileDialog, QMainWindow, QStackedWidget, QWidget

from genmojo_core.clip.clip import Clip
from genmojo_core.errors import GenmojoError
from genmojo_studio import demo, notify, opening, theme
from genmojo_studio.about import About
from genmojo_studio.actions import ActionTable
from genmojo_studio.assembly import Assembly
from genmojo_studio.background import Tasks
from genmojo_studio.header import Header
from genmojo_studio.key_sheet import KeySheet
from genmojo_studio.menus import Menus
from genmojo_studio.palette import Palette
from genmojo_studio.panels import Panels
from genmojo_studio.selftest_dialog import SelftestDialog
from genmojo_studio.settings import Settings, data_folder
from genmojo_studio.shortcuts import KeyEditor
from genmojo_studio.state import AppState
from genmojo_studio.translate import tr
from genmojo_studio.watchdog import Watchdog
from genmojo_studio.welcome import Welcome
from genmojo_studio.worker import runs

_PRELOAD_MS = 100  # after the window came up
_OPENING = "opening"  # the assembly of the clip that is being shown
_TURN_MS = 20  # what others do because a clip was opened has its turn
_POLISHED = 40  # widgets of a new workspace that are dressed in one turn
_MODULES = {  # they pull in OpenGL, plots and readers that the start page does not need
    "annotate": "genmojo_studio.annotate.workspace",
    "watch": "genmojo_studio.watch.workspace",
}


class Workspace(Protocol):
    """What the window asks of a workspace, besides being a QMainWindow. `parts` makes what is in it."""

    panels: Panels
    parts: Iterator[None]

    def opening(self, path: Path) -> Iterator[None]:
        """Shows a clip (or a project), part by part; the shared state already holds a clip that was read."""
        ...

    def close(self) -> bool:
        """Asks to close; False keeps the window open."""
        ...

    def save_layout(self) -> None:
        """Remembers where the panels are."""
        ...

    def restore_layout(self) -> None:
        """Puts the panels where they were."""
        ...


class MainWindow(QMainWindow):
    """The window. Workspaces are made when they are first shown."""

    def __init__(self, state: AppState, table: ActionTable, settings: Settings) -> None:
        super().__init__()
        self.state = state
        self.table = table
        self.settings = settings
        self.tasks = Tasks(threads=2)
        self.watchdog = Watchdog(self)
        self.workspaces: dict[str, Workspace] = {}
        self._shown_clips: dict[str, Path | None] = {}
        self._loaded: set[str] = set()
        self._visited: set[str] = set()
        self._assemblies: dict[str, Assembly] = {}
        self.workspace = ""
        self.setWindowTitle("GenMOJO Studio")
        self.setAcceptDrops(True)
        room = self.screen().availableGeometry()
        self.resize(min(1600, room.width()), min(950, room.height()))
        self.welcome = Welcome()
        self.stack = QStackedWidget()
        self.stack.addWidget(self.welcome)
        self.setCentralWidget(self.stack)
        self.header = Header()
        self.addToolBar(self.header)
        self._connect()
        self.menus = Menus(self, table)
        self.show_workspace("")
        self._preload = QTimer(self, interval=_PRELOAD_MS, singleShot=True)
        self._preload.timeout.connect(lambda: self._load("watch", self._prepare))
        geometry = settings.layout("window")
        if geometry is not None:
            self.restoreGeometry(geometry)

    def show_workspace(self, name: str) -> None:
        """Brings "annotate", "watch" or the start page ("") to the front, with the clip that is open."""
        self._bring(name)
        for _ in self._opening(name):
            continue

    def _bring(self, name: str) -> None:
        """To the front, whatever it shows."""
        if name and name not in self.workspaces:
            self._assembly(name).finish()
        self.workspace = name
        if not name:
            self.welcome.show_recent(self.settings.recent(), [Path(run.run_dir) for run in runs.live_runs()])
        self._visited.add(name)
        self.stack.setCurrentWidget(cast(QWidget, self.workspaces[name]) if name else self.welcome)
        self.header.show_workspace(name)
        self.header.show_panels(None if not name else not self._panels_hidden())
        self.menus.set_workspace(name)

    def _opening(self, name: str) -> Iterator[None]:
        """Shows the clip that is open in a workspace, unless it does."""
        path = self.state.clip_path
        if name and path is not None and self._shown_clips.get(name) != path:
            self._shown_clips[name] = path
            yield from self.workspaces[name].opening(path)

    def _open_by_parts(self, parts: Iterator[None], then: Callable[[], object] | None = None) -> None:
        """Shows a clip, a part in each turn, once the one before is there."""
        if _OPENING in self._assemblies:
            self._assemblies[_OPENING].finish()
        self._assemblies[_OPENING] = Assembly(parts, self)
        self._assemblies[_OPENING].start(then)

    def go_to(self, name: str, then: Callable[[], object] = lambda: None) -> None:
        """As `show_workspace`, but loads on a thread what is not loaded, and lets the window answer in between; does
        something in it then."""

        def shown() -> None:
            self.header.say("")
            self._bring(name)
            self._open_by_parts(self._opening(name), then)

        if not name or name in self.workspaces:
            shown()
        elif name in self._loaded:
            self._assembly(name).start(shown)
        else:
            self.header.say(tr("Loading …"), busy=True)
            self._load(name, lambda: self._assembly(name).start(shown))

    def _prepare(self) -> None:
        """Once Watch is loaded: it is made while nobody waits for it, part by part."""
        _ask_for_opengl()
        if not self.workspace:
            self._assembly("watch").start()

    def _load(self, name: str, then: Callable[[], object]) -> None:
        """Imports what a workspace is made of on a thread, which lets the window answer meanwhile."""

        def loaded(_: object) -> None:
            self._loaded.add(name)
            then()

        self.tasks.run(lambda: importlib.import_module(_MODULES[name]), loaded, self._reading_failed)

    def _assembly(self, name: str) -> Assembly:
        """What makes a workspace; it may be at it already."""
        if name not in self._assemblies:
            self._assemblies[name] = Assembly(self._parts(name), self)
        return self._assemblies[name]

    def _parts(self, name: str) -> Iterator[None]:
        """A workspace, part by part, and its place in the window."""
        made = _make_workspace(name, self.state, self.table)
        yield from made.parts
        widget = cast(QWidget, made)
        widget.resize(self.stack.size())
        self.stack.addWidget(widget)
        yield
        made.restore_layout()
        yield
        inside = widget.findChildren(QWidget)
        for first in range(0, len(inside), _POLISHED):
            for one in inside[first : first + _POLISHED]:
                one.ensurePolished()
            yield
        said = getattr(made, "said", None)
        if said is not None:
            said.connect(lambda text: self.header.say(text, busy=bool(text)))
        self.workspaces[name] = made

    def open_path(self, path: Path) -> None:
        """Opens whatever lies there; faults are told in a dialog."""
        path = path.absolute()
        try:
            kind = opening.kind_of(path)
        except GenmojoError as error:
            notify.tell(error, self)
            return
        self.settings.add_recent(path)
        if kind == "clip":
            self.read_clip(path, self.workspace or "watch")
        elif kind == "project":
            self.go_to("annotate", lambda: self._open_project(path))
        else:
            self.go_to("watch", lambda: cast(Any, self.workspaces["watch"]).open_path(path, kind))

    def _open_project(self, path: Path) -> None:
        self._shown_clips["annotate"] = path
        self._open_by_parts(self.workspaces["annotate"].opening(path))

    def read_clip(self, path: Path, workspace: str) -> None:
        """Reads a clip on a thread and shows it in a workspace."""
        self.header.say(tr("Reading {name} …").format(name=path.name), busy=True)
        self.tasks.run(
            lambda: _read_clip(path, workspace),
            lambda found: self._clip_read(found, path, workspace),
            self._reading_failed,
        )

    def open_demo(self) -> None:
        """Makes the demo clip (the same bytes every time) and opens it."""
        self.header.say(tr("Making the demo clip …"), busy=True)
        self.tasks.run(demo.write, self.open_path, self._reading_failed)

    def showEvent(self, event: QShowEvent) -> None:
        """Once it is on the screen, what the first clip will need is loaded: opening it then takes no time."""
        super().showEvent(event)
        if "watch" not in self.workspaces:
            self._preload.start()

    def closeEvent(self, event: QCloseEvent) -> None:
        """Asks the workspaces; one that says no keeps everything as it is."""
        for name, workspace in self.workspaces.items():
            if name in self._visited:
                workspace.save_layout()
            if not workspace.close():
                event.ignore()
                return
        for assembly in self._assemblies.values():
            assembly.stop()
        self.settings.put_layout("window", self.saveGeometry())
        self._preload.stop()
        self.tasks.close()
        event.accept()
        QApplication.quit()

    def dragEnterEvent(self, event: QDragEnterEvent) -> None:
        """Files and folders may be dropped anywhere."""
        if any(url.isLocalFile() for url in event.mimeData().urls()):
            event.acceptProposedAction()

    def dropEvent(self, event: QDropEvent) -> None:
        """Opens what was dropped."""
        event.acceptProposedAction()
        for url in event.mimeData().urls()[:1]:
            self.open_path(Path(url.toLocalFile()))

    def _connect(self) -> None:
        self.welcome.demo_wanted.connect(self.open_demo)
        self.welcome.folder_wanted.connect(self._ask_folder)
        self.welcome.file_wanted.connect(self._ask_file)
        self.welcome.path_wanted.connect(lambda path: self.open_path(Path(path)))
        self.header.workspace_wanted.connect(self.go_to)
        self.header.palette_wanted.connect(self._show_palette)
        self.header.panels_wanted.connect(lambda: self.table.trigger("window.panels"))
        bind = self.table.bind
        bind("file.open_clip", self._ask_folder)
        bind("file.open", self._ask_file)
        bind("file.demo", self.open_demo)
        bind("file.close", lambda: self.show_workspace(""))
        bind("file.settings", lambda: self._open_dialog(KeyEditor(self.table, self.settings, self)))
        bind("file.quit", self.close)
        bind("window.annotate", lambda: self.go_to("annotate"))
        bind("window.watch", lambda: self.go_to("watch"))
        bind("window.theme", self._switch_theme, checked=lambda: self.state.theme == "light")
        bind("window.full_screen", self._switch_full_screen, checked=self.isFullScreen)
        bind("window.panels", self._switch_panels, lambda: bool(self.workspace), self._panels_hidden)
        bind("window.reset", self._reset_layout, lambda: bool(self.workspace))
        bind("help.palette", self._show_palette)
        bind("help.keys", self._show_keys)
        bind("help.selftest", lambda: self._open_dialog(SelftestDialog(self)))
        bind("help.crash", self._show_crashes, lambda: bool(notify.crash_reports(data_folder() / "crashes")))
        bind("help.about", lambda: self._open_dialog(About(self)))
        self.state.subscribe(self._show_title, "clip", "clip_path", "scene_path")

    def _clip_read(self, found: tuple[Clip, Path | None, Path | None], path: Path, workspace: str) -> None:
        clip, masks, project = found

        def made() -> None:
            self.header.say("")
            self.state.open_clip(clip, path, masks, project)
            QTimer.singleShot(_TURN_MS, self, lambda: self.go_to(workspace))

        self._assembly(workspace).start(made)

    def _reading_failed(self, error: BaseException) -> None:
        self.header.say("")
        notify.tell(error, self)

    def _ask_folder(self) -> None:
        chosen = QFileDialog.getExistingDirectory(self, tr("Open a clip folder"), self._last_folder())
        if chosen:
            self.open_path(Path(chosen))

    def _ask_file(self) -> None:
        chosen, _ = QFileDialog.getOpenFileName(self, tr("Open a file"), self._last_folder(), opening.file_filter())
        if chosen:
            self.open_path(Path(chosen))

    def _last_folder(self) -> str:
        return next((str(path.parent) for path in self.settings.recent()), str(Path.home()))

    def _show_palette(self) -> None:
        palette = Palette(self.table, self.workspace, self)
        corner = self.mapToGlobal(self.rect().topLeft())
        palette.move(corner.x() + (self.width() - palette.width()) // 2, corner.y() + 70)
        palette.accepted.connect(lambda: self.table.trigger(palette.chosen))
        self._open_dialog(palette)

    def _show_keys(self) -> None:
        """The sheet of keys, of the step that a person is in."""
        for old in self.findChildren(KeySheet):
            old.close()
        place = getattr(self.workspaces.get(self.workspace), "step", None)
        self._open_dialog(KeySheet(self.table, self.workspace, self, place), beside=True)

    def _open_dialog(self, dialog: QDialog, *, beside: bool = False) -> None:
        """Shows a dialog and goes on; `beside` leaves the window usable meanwhile."""
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        dialog.show() if beside else dialog.open()

    def _switch_theme(self) -> None:
        self.state.set(theme="dark" if self.state.theme == "light" else "light")
        self.settings.put("theme", self.state.theme)
        application = QApplication.instance()
        if isinstance(application, QApplication):
            theme.apply(application, self.state.theme)

    def _switch_full_screen(self) -> None:
        self.showNormal() if self.isFullScreen() else self.showFullScreen()

    def _switch_panels(self) -> None:
        self.workspaces[self.workspace].panels.toggle()
        self.header.show_panels(not self._panels_hidden())

    def _panels_hidden(self) -> bool:
        return bool(self.workspace) and self.workspaces[self.workspace].panels.hidden

    def _reset_layout(self) -> None:
        self.settings.forget_layouts()
        self.workspaces[self.workspace].panels.reset()
        self.workspaces[self.workspace].restore_layout()
        self.header.show_panels(True)

    def _show_crashes(self) -> None:
        reports = notify.crash_reports(data_folder() / "crashes")
        text = "\n\n".join(report.read_text(errors="replace")[:4000] for report in reports[:3])
        notify.show_dialog(self, tr("Reports of earlier crashes"), "\n".join(map(str, reports[:3])), text)

    def _show_title(self) -> None:
        shown = self.state.clip_path or self.state.scene_path
        self.header.show_name(shown.name if shown else "")
        self.setWindowTitle(f"{shown.name} – GenMOJO Studio" if shown else "GenMOJO Studio")


def _make_workspace(name: str, state: AppState, table: ActionTable) -> Workspace:
    """Imported when first shown (_MODULES)."""
    if name == "annotate":
        from genmojo_studio.annotate.workspace import AnnotateWorkspace

        return AnnotateWorkspace(state, table)
    from genmojo_studio.watch.workspace import WatchWorkspace

    return WatchWorkspace(state, table)


def _ask_for_opengl() -> None:
    """Making a first OpenGL context loads the driver; the answer is kept."""
    importlib.import_module("genmojo_studio.view3d.gl_probe").probe()


def _read_clip(path: Path, workspace: str) -> tuple[Clip, Path | None, Path | None]:
    """The clip, with the masks that a person corrected in its project, where they lie, and the project, if any.

    The workspace that will show it is loaded too.
    """
    from genmojo_core.clip import folders, mask_file
    from genmojo_studio.annotate import hand_masks
    from genmojo_studio.annotate.session import prepare_project, project_path

    importlib.import_module(_MODULES[workspace])
    clip = folders.read(path, short_side=opening.SHARED_SHORT_SIDE)
    file = project_path(path)
    project, masks = file if file.is_file() else None, file.with_suffix(hand_masks.SUFFIX)
    if workspace == "annotate":
        prepare_project(path)
    return (mask_file.with_masks(clip, masks), masks, project) if masks.exists() else (clip, None, project)
