"""What drawing costs a run on the same machine, and frames at a pace that the optimiser hardly feels."""

from __future__ import annotations

import time
from typing import Any

from PySide6.QtCore import QObject

from genmojo_studio.view3d.frames import FrameReport
from genmojo_studio.view3d.pace import Pace
from genmojo_studio.view3d.scene_view import SceneView
from genmojo_studio.worker.client import WorkerClient

_AT_WORK = ("running", "stepping", "finishing")


class DrawCost(QObject):
    """Paces a view by what its drawing costs the run of a client; `share` of a step is what it costs now."""

    def __init__(self, view: SceneView, client: WorkerClient, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._view = view
        self._pace = Pace()
        self._seconds: float | None = None  # of the run at its last step
        self._used = time.process_time()  # of this process then
        view.frame_drawn.connect(self._drew)
        client.event_received.connect(self._heard)
        client.state_changed.connect(self._entered)

    @property
    def share(self) -> float:
        """Of a step that drawing adds, as last measured; 0 while no run goes on."""
        return self._pace.share

    def _drew(self, report: FrameReport) -> None:
        self._pace.drew(report.ms / 1e3)

    def _heard(self, event: dict[str, Any]) -> None:
        if event.get("event") == "StageStarted":
            self._pace.another_stage()
        if event.get("event") != "Step":
            return
        seconds, before = float(event["seconds"]), self._seconds
        used, self._used = time.process_time() - self._used, time.process_time()
        self._seconds = seconds
        if before is not None and seconds > before:
            self._pace.stepped(seconds - before, used)
            self._view.set_pace(self._pace.interval)

    def _entered(self, state: str) -> None:
        if state == "starting":
            self._pace, self._seconds = Pace(), None
        if state in _AT_WORK:
            self._view.set_pace(self._pace.interval)
        else:
            self._view.set_pace(0.0)
            self._seconds = None
