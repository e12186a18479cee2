"""Exports as jobs in a second process: the window goes on, sees progress and may cancel."""

from __future__ import annotations

import json
import sys
from typing import Any

from PySide6.QtCore import QObject, QProcess, QProcessEnvironment, QTimer, Signal, SignalInstance

from genmojo_studio.export.request import ExportRequest
from genmojo_studio.worker.process import ROOT

_CANCEL_MS = 5000  # then a process that does not stop by itself is killed
_PROGRAM = ["-m", "genmojo_studio.export.program"]


class ExportJob(QObject):
    """One export.

    Signals, one of the last three exactly once, when the process has ended: progress(0..1);
    finished(dict with "path" and "files"), failed(sentence), cancelled().
    """

    progress = Signal(float)
    finished = Signal(dict)
    failed = Signal(str)
    cancelled = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.request: ExportRequest | None = None
        self._over = True
        self._cancelling = False
        self._rest = b""
        self._outcome: tuple[Any, ...] | None = None  # signal and values
        self._process = QProcess(self)
        self._process.readyReadStandardOutput.connect(self._read)
        self._process.finished.connect(self._on_finished)
        self._process.errorOccurred.connect(self._on_error)
        self._patience = QTimer(self)
        self._patience.setSingleShot(True)
        self._patience.setInterval(_CANCEL_MS)
        self._patience.timeout.connect(self._process.kill)

    @property
    def running(self) -> bool:
        """True until one of finished, failed, cancelled was told."""
        return not self._over

    def start(self, request: ExportRequest) -> None:
        """Begin; a job that runs already is left alone."""
        if self.running:
            return
        self.request, self._over, self._cancelling, self._rest = request, False, False, b""
        self._outcome = None
        environment = QProcessEnvironment.systemEnvironment()
        paths = [str(ROOT), environment.value("PYTHONPATH")]
        environment.insert("PYTHONPATH", (";" if sys.platform == "win32" else ":").join(filter(None, paths)))
        self._process.setProcessEnvironment(environment)
        self._process.start(sys.executable, _PROGRAM)
        self._process.write(json.dumps(request.to_json()).encode() + b"\n")

    def cancel(self) -> None:
        """Stop and remove what was written; `cancelled` tells when it is done."""
        if self.running and not self._cancelling:
            self._cancelling = True
            self._process.write(b"cancel\n")
            self._patience.start()

    def wait(self, milliseconds: int = 10_000) -> None:
        """At the end of the program: cancel and wait."""
        self.cancel()
        if not self._process.waitForFinished(milliseconds):
            self._process.kill()
            self._process.waitForFinished(1000)

    def _read(self) -> None:
        """Lines of JSON; anything else a library printed is passed over."""
        self._rest += bytes(self._process.readAllStandardOutput().data())
        *lines, self._rest = self._rest.split(b"\n")
        for line in lines:
            try:
                message = json.loads(line)
            except ValueError:
                continue
            if isinstance(message, dict):
                self._told(message)

    def _told(self, message: dict[str, object]) -> None:
        share = message.get("progress")
        if isinstance(share, int | float):
            self.progress.emit(float(share))
        elif isinstance(message.get("done"), dict):
            self._outcome = (self.finished, message["done"])
        elif "error" in message:
            self._outcome = (self.failed, str(message["error"]))
        elif "cancelled" in message:
            self._outcome = (self.cancelled,)

    def _end(self, signal: SignalInstance, *values: object) -> None:
        if not self._over:
            self._over = True
            self._patience.stop()
            signal.emit(*values)

    def _on_finished(self, code: int, status: QProcess.ExitStatus) -> None:
        """Whatever it had to say was said; a process that went without a word failed."""
        self._read()
        if self._outcome is not None:
            self._end(*self._outcome)
        elif self._cancelling:
            self._end(self.cancelled)
        said = bytes(self._process.readAllStandardError().data()).decode("utf-8", "replace").strip().splitlines()
        why = said[-1] if said else f"exit code {code}" if status == QProcess.ExitStatus.NormalExit else "it was killed"
        self._end(self.failed, f"The export could not be finished ({why}).")

    def _on_error(self, error: QProcess.ProcessError) -> None:
        if error == QProcess.ProcessError.FailedToStart:
            self._end(self.failed, "The export could not be started.")
