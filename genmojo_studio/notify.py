"""How the app tells a person that something went wrong: the one sentence of a GenmojoError, or a report of our fault.

Tests replace `show_dialog`, so that no modal window blocks them.
"""

from __future__ import annotations

import faulthandler
import logging
import os
import sys
import threading
import traceback
from collections.abc import Callable
from pathlib import Path
from types import TracebackType
from typing import TextIO

from PySide6.QtCore import QObject, Qt, QtMsgType, Signal, qInstallMessageHandler
from PySide6.QtWidgets import QMessageBox, QWidget

from genmojo_core.errors import GenmojoError
from genmojo_studio.translate import fault, tr

LOG = logging.getLogger("genmojo_studio")
_NOISE = ("QXcbConnection: XCB error", "propagateSizeHints", "QStandardPaths: ")


def tell(error: BaseException, parent: QWidget | None = None) -> None:
    """Shows a fault in a dialog: plain text, never markup from a file."""
    if isinstance(error, GenmojoError):
        show_dialog(parent, tr("That did not work"), fault(error), "")
        return
    details = "".join(traceback.format_exception(error))
    LOG.error("%s", details)
    show_dialog(parent, tr("A fault of the app"), _own_fault(error), details)


def _show(parent: QWidget | None, title: str, text: str, details: str) -> None:
    box = QMessageBox(parent)
    box.setIcon(QMessageBox.Icon.Critical if details else QMessageBox.Icon.Warning)
    box.setWindowTitle("GenMOJO Studio")
    box.setTextFormat(Qt.TextFormat.PlainText)
    box.setText(title)
    box.setInformativeText(text)
    if details:
        box.setDetailedText(details)
    _shown.add(box)  # one without a parent would go with this function
    box.finished.connect(lambda: _shown.discard(box))
    box.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    box.open()


_shown: set[QMessageBox] = set()
show_dialog: Callable[[QWidget | None, str, str, str], None] = _show


class Hooks(QObject):
    """Catches what nobody caught, in slots and in threads, and tells it once on the UI thread."""

    _caught = Signal(object)

    def __init__(self, crash_folder: Path) -> None:
        super().__init__()
        self._told: set[str] = set()
        self._caught.connect(self._tell, Qt.ConnectionType.QueuedConnection)
        self._file = _crash_file(crash_folder)
        self._before = sys.excepthook

    def install(self) -> None:
        """Takes over the hooks of Python, its threads and Qt; call it before the first widget."""
        sys.excepthook = self._hook
        threading.excepthook = lambda given: self._hook(given.exc_type, given.exc_value, given.exc_traceback)
        qInstallMessageHandler(_qt_message)

    def remove(self) -> None:
        """Gives the hooks back and deletes an empty crash file."""
        sys.excepthook = self._before
        threading.excepthook = threading.__excepthook__
        qInstallMessageHandler(None)
        if self._file is not None:
            faulthandler.disable()
            self._file.close()
            Path(self._file.name).unlink(missing_ok=True)
            self._file = None

    def _hook(self, kind: type[BaseException], value: BaseException | None, trace: TracebackType | None) -> None:
        if issubclass(kind, KeyboardInterrupt) or value is None:
            self._before(kind, value or kind(), trace)
            return
        self._caught.emit(value)

    def _tell(self, error: BaseException) -> None:
        place = traceback.extract_tb(error.__traceback__)
        key = f"{type(error).__name__} {place[-1].filename}:{place[-1].lineno}" if place else type(error).__name__
        if isinstance(error, GenmojoError) or key not in self._told:  # a fault in a repaint would tell for ever
            self._told.add(key)
            tell(error)


def crash_reports(folder: Path) -> list[Path]:
    """What processes that died left behind, newest first; files of processes that live are left out."""
    found = [path for path in folder.glob("crash-*.txt") if path.stat().st_size and not _alive(path)]
    return sorted(found, key=lambda path: path.stat().st_mtime, reverse=True)


def _crash_file(folder: Path) -> TextIO | None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
        file = (folder / f"crash-{os.getpid()}.txt").open("w", encoding="utf-8")
    except OSError as error:
        LOG.warning("no crash reports: %s", error)
        return None
    faulthandler.enable(file)
    return file


def _alive(report: Path) -> bool:
    number = report.stem.removeprefix("crash-")
    return number.isdigit() and int(number) == os.getpid()


def _qt_message(kind: QtMsgType, _context: object, message: str) -> None:
    if not message.startswith(_NOISE):
        LOG.log(logging.DEBUG if kind == QtMsgType.QtDebugMsg else logging.WARNING, "Qt: %s", message)


def _own_fault(error: BaseException) -> str:
    said = tr(
        "This is a fault of ours, not of your data. Your annotations are on disk. The details help us to mend it."
    )
    return f"{said}\n\n{type(error).__name__}: {error}"
