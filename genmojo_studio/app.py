"""Starts the app: arguments, OpenGL format, fault hooks, state, actions, window. It alone knows everybody."""

from __future__ import annotations

import argparse
import logging
import sys
from collections.abc import Sequence
from pathlib import Path

from PySide6.QtCore import QCoreApplication, Qt, QTimer
from PySide6.QtGui import QIcon, QSurfaceFormat
from PySide6.QtWidgets import QApplication

from genmojo_studio import notify, theme, translate
from genmojo_studio.actions import Action, ActionTable
from genmojo_studio.annotate import actions as annotate_actions
from genmojo_studio.garbage import Collector
from genmojo_studio.settings import Settings, data_folder
from genmojo_studio.shell_actions import ACTIONS
from genmojo_studio.state import AppState
from genmojo_studio.watch import actions as watch_actions
from genmojo_studio.window import MainWindow

_SWITCH_SECONDS = 1e-3  # after which a thread gives Python's lock to the window's; the default is 5 ms, often a frame
RESOURCES = Path(__file__).resolve().parent.parent / "resources"


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the app until its window closes; returns the exit code."""
    arguments = _arguments(argv)
    logging.basicConfig(level=logging.INFO if arguments.verbose else logging.WARNING, format="%(message)s")
    application = make_application()
    hooks = notify.Hooks(data_folder() / "crashes")
    hooks.install()
    settings = Settings()
    translators = translate.install(arguments.language or settings.text("language"))
    window = make_window(application, settings)
    window.show()
    if arguments.path:
        QTimer.singleShot(0, lambda: window.open_path(Path(arguments.path)))
    code = application.exec()
    hooks.remove()
    translators.clear()
    return code


def make_application(argv: Sequence[str] = ("genmojo-studio",)) -> QApplication:
    """The Qt application, with what must be said before it exists: shared OpenGL contexts and their format."""
    QCoreApplication.setAttribute(Qt.ApplicationAttribute.AA_ShareOpenGLContexts)
    surface = QSurfaceFormat()
    surface.setVersion(3, 3)
    surface.setProfile(QSurfaceFormat.OpenGLContextProfile.CoreProfile)
    surface.setSamples(0)
    surface.setDepthBufferSize(0)
    surface.setSwapInterval(1)
    QSurfaceFormat.setDefaultFormat(surface)
    application = QApplication(list(argv))
    application.setApplicationName("genmojo-studio")
    application.setApplicationDisplayName("GenMOJO Studio")
    application.setDesktopFileName("genmojo-studio")
    application.setWindowIcon(QIcon(str(RESOURCES / "icons" / "genmojo-studio.svg")))
    Collector(application)
    sys.setswitchinterval(_SWITCH_SECONDS)
    return application


def make_window(application: QApplication, settings: Settings) -> MainWindow:
    """State, actions and the window, as the settings say."""
    state = AppState()
    state.set(theme=settings.text("theme", "dark"))
    theme.apply(application, state.theme)
    table = ActionTable(all_actions())
    preset = settings.text("keys/preset")
    if preset:
        table.set_preset(preset)
    for action_id, keys in settings.own_keys().items():
        if table.has(action_id):
            table.set_keys(action_id, keys)
    collector = application.findChild(Collector)
    if collector is not None:
        state.subscribe(collector.sweep_soon, "clip_path")
    return MainWindow(state, table, settings)


def all_actions() -> list[Action]:
    """The app's own actions followed by those of both workspaces."""
    return [*ACTIONS, *watch_actions.ACTIONS, *annotate_actions.ACTIONS]


def _arguments(argv: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser("genmojo-studio", description="Annotate, optimise and look at 4D scenes.")
    parser.add_argument("path", nargs="?", help="a clip folder, a video, scene.h5, project.genmojo, a .ply or a run")
    parser.add_argument("--language", choices=tuple(translate.LANGUAGES), help="of the window; default: the system's")
    parser.add_argument("--verbose", action="store_true", help="say on stderr what happens, stalls included")
    return parser.parse_args(argv)


if __name__ == "__main__":
    sys.exit(main())
