"""A 4D scene of the clip, optimised by the command line in a process of its own, for tracks behind what hides them."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from PySide6.QtCore import QElapsedTimer, QObject, QProcess, QTimer, Signal

from genmojo_core.tracks.annotation import CONFIRMED, KEY, Annotation
from genmojo_core.tracks.model import NONE, PointTracks
from genmojo_studio.translate import fault, tr

_MARGIN = 1.15  # reading, writing and the first estimates come on top of the budget


class SceneJob(QObject):
    """One optimisation with a budget of seconds, which makes its end foreseeable.

    Args:
        clip, output: what is optimised, where the scene goes. seconds: budget.
        given: options of `genmojo optimize` with a file each that a person made: {"--tracks": npz, "--masks": npz}.
    """

    progressed = Signal(float)  # 0..1 of the forecast
    finished = Signal(str)  # path of the scene
    failed = Signal(str)  # a sentence

    def __init__(
        self, clip: Path, output: Path, seconds: float, given: dict[str, Path], parent: QObject | None = None
    ) -> None:
        super().__init__(parent)
        self._output, self._seconds = output, seconds
        self._process = QProcess(self)
        self._process.setProgram(sys.executable)
        files = [word for option, path in given.items() for word in (option, str(path))]
        self._process.setArguments(["-m", "genmojo_core.cli.main", "optimize", str(clip), "-o", str(output), "--preset",
                                    "draft", "--budget", f"{seconds:.0f}s", "--run-dir", f"{output}.run",
                                    *files])  # fmt: skip
        self._process.finished.connect(self._ended)
        self._process.errorOccurred.connect(self._error)
        self._clock = QElapsedTimer()
        self._tick = QTimer(self)
        self._tick.setInterval(500)
        self._tick.timeout.connect(self._tell)
        self._cancelled = False

    def arguments(self) -> list[str]:
        """The command line that runs."""
        return self._process.arguments()

    def start(self) -> None:
        """Begin."""
        self._clock.start()
        self._tick.start()
        self._process.start()

    def cancel(self) -> None:
        """End the process; nothing is kept."""
        self._cancelled = True
        self._tick.stop()
        if self._process.state() != QProcess.ProcessState.NotRunning:
            self._process.terminate()
            if not self._process.waitForFinished(3000):
                self._process.kill()
                self._process.waitForFinished(2000)

    def _tell(self) -> None:
        self.progressed.emit(min(self._clock.elapsed() / 1000 / (self._seconds * _MARGIN), 0.99))

    def _ended(self, code: int, _status: QProcess.ExitStatus) -> None:
        self._tick.stop()
        if self._cancelled:
            return
        if code == 0 and self._output.exists():
            self.finished.emit(str(self._output))
            return
        lines = bytes(self._process.readAllStandardError().data()).decode(errors="replace").strip().splitlines()
        self.failed.emit(fault(lines[-1][:400]) if lines else tr("The optimisation ended without a scene."))

    def _error(self, error: QProcess.ProcessError) -> None:
        if error == QProcess.ProcessError.FailedToStart and not self._cancelled:
            self._tick.stop()
            self.failed.emit(tr("The optimisation could not be started."))


def said_by_people(annotation: Annotation) -> PointTracks | None:
    """What people placed or accepted, source pixels; state NONE wherever nobody spoke. None without any of it."""
    ids = [info.id for info in annotation.active() if len(annotation.keys(info.id))]
    if not ids:
        return None
    cells = [annotation.track(track) for track in ids]
    sure = np.stack([(c.flags & (KEY | CONFIRMED)) > 0 for c in cells])
    state = np.where(sure, np.stack([c.state for c in cells]), NONE).astype(np.uint8)
    owners = np.array([annotation.tracks[track].object for track in ids], np.int64)
    return PointTracks(np.stack([c.xy for c in cells]).astype(np.float32), state, owners, annotation.size)


def forecast(seconds: float) -> float:
    """Minutes until a scene with a budget of `seconds` is there."""
    return seconds * _MARGIN / 60
