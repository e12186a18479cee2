"""A window without a window: a client with everything it was told, and waiting with a deadline."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from PySide6.QtCore import QCoreApplication

from genmojo_studio.app import make_application
from genmojo_studio.worker.client import WorkerClient
from genmojo_studio.worker.protocol import RunRequest

FAKE = [sys.executable, str(Path(__file__).with_name("fake_worker.py"))]
PATIENCE = 120.0  # seconds until a test gives up on a slow, busy machine


def application() -> QCoreApplication:
    """The one application of the process; nothing here is shown, so no display is needed."""
    if QCoreApplication.instance() is None and sys.platform == "linux" and not os.environ.get("DISPLAY"):
        os.environ["QT_QPA_PLATFORM"] = "minimal"
    return QCoreApplication.instance() or make_application(["test"])  # tests of windows may come after these


class Watched:
    """A client and what it said."""

    def __init__(self, program: list[str] | None = None) -> None:
        application()
        self.client = WorkerClient(program=program)
        self.states: list[str] = []
        self.events: list[dict[str, Any]] = []
        self.snapshots: list[Any] = []
        self.reports: list[Any] = []
        self.answers: dict[int, tuple[bool, Any]] = {}
        self.client.state_changed.connect(self.states.append)
        self.client.event_received.connect(self.events.append)
        self.client.preview_ready.connect(self.snapshots.append)
        self.client.died.connect(self.reports.append)
        self.client.acknowledged.connect(self._answer)

    def _answer(self, number: int, ok: bool, result: Any) -> None:
        self.answers[number] = (ok, result)

    def until(self, condition: Callable[[], Any], seconds: float = PATIENCE) -> float:
        """Let things happen until a condition holds; returns how long that took. A run that died stays dead."""
        begun, reports = time.monotonic(), len(self.reports)
        while not condition():
            QCoreApplication.processEvents()
            time.sleep(0.005)
            over = any(report.final for report in self.reports[reports:])
            if time.monotonic() - begun > seconds or (over and not condition()):
                raise AssertionError(f"in {seconds} s only: {self.states}, {len(self.events)} events, {self.reports}")
        return time.monotonic() - begun

    def until_state(self, state: str, seconds: float = PATIENCE) -> float:
        return self.until(lambda: self.client.state == state, seconds)

    def answer(self, number: int, seconds: float = PATIENCE) -> tuple[bool, Any]:
        self.until(lambda: number in self.answers, seconds)
        return self.answers[number]

    def steps(self) -> int:
        return sum(e["event"] == "Step" for e in self.events)


@contextmanager
def watched(program: list[str] | None = FAKE) -> Iterator[Watched]:
    """A client whose worker is gone at the end, whatever happened."""
    window = Watched(program)
    try:
        yield window
    finally:
        window.client.kill()
        if window.client._process is not None:
            window.until(lambda: window.client._process is None)


def fake_request(run_dir: Path, **options: Any) -> RunRequest:
    return RunRequest("clip", str(run_dir), models={k: str(v) for k, v in options.items()})
