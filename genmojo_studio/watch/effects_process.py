"""`genmojo effects` in a process of its own, so that the window never waits."""

from __future__ import annotations

import json
import sys
from pathlib import Path

from PySide6.QtCore import QObject, QProcess, Signal

from genmojo_studio.translate import tr

_LAST_MS = 10_000  # a process that was killed is gone by then


class EffectsProcess(QObject):
    """Asks one question at a time; an older one is dropped.

    Signals: `answered(dict)` with what the command prints as JSON, `failed(sentence)`.
    """

    answered = Signal(dict)
    failed = Signal(str)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._process: QProcess | None = None
        self._closed = False

    def ask(self, clip: Path, preset: str, masks: Path | None = None, *more: str) -> None:
        """Asks what a clip (with corrected masks) calls for under a preset; `more`: options of the command."""
        self.stop()
        if self._closed:
            return
        process = QProcess(self)
        process.finished.connect(self._finished)
        process.setProcessChannelMode(QProcess.ProcessChannelMode.SeparateChannels)
        self._process = process
        arguments = ["-m", "genmojo_core.cli.main", "effects", str(clip), "--preset", preset, "--json", *more]
        arguments += ["--masks", str(masks)] if masks is not None else []
        process.start(sys.executable, arguments)

    def stop(self) -> None:
        """Drops a question that is still being answered; its process goes when it has ended."""
        if self._process is not None:
            old, self._process = self._process, None
            old.finished.disconnect(self._finished)
            old.finished.connect(old.deleteLater)
            old.kill()

    def close(self) -> None:
        """The window goes: nothing is asked any more."""
        self._closed = True
        self.stop()
        for process in self.findChildren(QProcess):
            process.waitForFinished(_LAST_MS)

    def _finished(self, code: int) -> None:
        process = self._process
        if process is None:
            return
        self._process = None
        output = bytes(process.readAllStandardOutput().data()).decode(errors="replace")
        faults = bytes(process.readAllStandardError().data()).decode(errors="replace").strip().splitlines()
        process.deleteLater()
        if code == 0:
            self.answered.emit(json.loads(output))
        else:
            self.failed.emit(faults[-1] if faults else tr("The clip could not be measured."))
