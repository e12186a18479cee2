"""A 4D scene of the clip, optimised by the command line in a process of its own, for tracks behind what hides them."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path

from PySide6.QtCore import QElapsedTimer, QObject, QProcess, QTimer, Signal

from genmojo_core.tracks.annotation import Annotation
from genmojo_studio.translate import fault, tr

SUFFIX = ".scene.h5"  # of the scene beside a project
_START_SECONDS, _FRAME_SECONDS = 5.0, 0.35  # on top of the budget: start and end, a frame's reading and estimates
_FOLLOW_START, _FOLLOW_SECONDS = 2.0, 0.15  # to follow the points through the scene: start, a frame


@dataclass(frozen=True)
class Forecast:
    """Seconds until tracks from a scene are there: to optimise it, and to follow the points through it."""

    optimise: float
    follow: float

    @property
    def whole(self) -> float:
        """Both."""
        return self.optimise + self.follow

    @staticmethod
    def of(budget: float, annotation: Annotation) -> Forecast:
        """For a budget of seconds, from the number of frames (measured on clips of 24 and 78 frames)."""
        frames = annotation.frames
        optimise = budget + _START_SECONDS + _FRAME_SECONDS * frames
        return Forecast(optimise, _FOLLOW_START + _FOLLOW_SECONDS * frames)


class SceneJob(QObject):
    """One optimisation with a budget of seconds, which makes its end foreseeable.

    Args:
        clip, output: what is optimised, where the scene goes. seconds: budget. expected: seconds it will take.
        given: options of `genmojo optimize` with a file each that a person made: {"--tracks": npz, "--masks": npz}.
    """

    progressed = Signal(float)  # 0..1 of the forecast
    finished = Signal(str)  # path of the scene
    failed = Signal(str)  # a sentence

    def __init__(
        self, clip: Path, output: Path, seconds: float, expected: float, given: dict[str, Path],
        parent: QObject | None = None,
    ) -> None:  # fmt: skip
        super().__init__(parent)
        self._output, self._expected = output, expected
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
        """End the process at once; nothing is kept. Asked politely it would finish its step and write its scene."""
        self._cancelled = True
        self._tick.stop()
        if self._process.state() != QProcess.ProcessState.NotRunning:
            self._process.kill()
            self._process.waitForFinished(2000)

    def _tell(self) -> None:
        self.progressed.emit(min(self._clock.elapsed() / 1000 / self._expected, 0.99))

    def _ended(self, code: int, status: QProcess.ExitStatus) -> None:
        self._tick.stop()
        if self._cancelled:
            return
        if code == 0 and self._output.exists():
            self.finished.emit(str(self._output))
            return
        if status == QProcess.ExitStatus.CrashExit:
            self.failed.emit(tr("The system ended the optimisation; memory may have run out. Close other programs."))
            return
        lines = bytes(self._process.readAllStandardError().data()).decode(errors="replace").strip().splitlines()
        self.failed.emit(fault(lines[-1][:400]) if lines else tr("The optimisation ended without a scene."))

    def _error(self, error: QProcess.ProcessError) -> None:
        if error == QProcess.ProcessError.FailedToStart and not self._cancelled:
            self._tick.stop()
            self.failed.emit(tr("The optimisation could not be started."))
