"""The run on show: the worker's client, what it has said so far, and the rule that ends it when it buys too little."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from PySide6.QtCore import QObject, Signal

from genmojo_core.errors import GenmojoError
from genmojo_core.optimise.gain import StopRule
from genmojo_studio.view3d.snapshot import SceneSnapshot
from genmojo_studio.watch.run_log import RunLog
from genmojo_studio.worker.client import WorkerClient
from genmojo_studio.worker.death import DeathReport
from genmojo_studio.worker.protocol import ENDED, RunRequest
from genmojo_studio.worker.runs import SCENE

LIVE = ("starting", "ready", "running", "paused", "stepping", "stopping", "finishing", "lost")


class RunControl(QObject):
    """Starts, steers and follows one run at a time. States come from the worker's acknowledgements only.

    Signals: `state_changed`, `log_grew`, `snapshot(SceneSnapshot)`, `died(DeathReport)`, `ended(Path)` with the scene
    file, `failed(error)` for a command that the worker refused.
    """

    state_changed = Signal()
    log_grew = Signal()
    snapshot = Signal(object)
    died = Signal(object)
    ended = Signal(object)
    failed = Signal(object)
    began = Signal()
    checkpointed = Signal(int)  # at a step
    quiet = Signal(bool)  # the worker measures what the view costs: do not draw

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.client = WorkerClient(self)
        self.log = RunLog()
        self.state = ""
        self.stop_below: float | None = None
        self.phase = ""
        self.view_cost = 0.0
        self.draw_share: Callable[[], float] = lambda: 0.0  # of a step that drawing adds, as the window measures it
        self.parameters: dict[str, float] = {}  # as they were changed while the run goes on
        self._rule = StopRule()
        self._wanted: list[tuple[Path, Callable[[Path], None]]] = []  # scenes asked for while the run goes on
        self._view_shown = True
        self._unasked: set[int] = set()  # commands that nobody gave: what becomes of them is nobody's concern
        self.client.state_changed.connect(self._state)
        self.client.event_received.connect(self._event)
        self.client.preview_ready.connect(self._preview)
        self.client.died.connect(self._died)
        self.client.beat_received.connect(self._beat)
        self.client.phase_changed.connect(self._phase)
        self.client.acknowledged.connect(self._acknowledged)
        self.client.probe_changed.connect(self.quiet)

    @property
    def live(self) -> bool:
        """True while a worker is at it."""
        return self.state in LIVE

    @property
    def run_dir(self) -> Path | None:
        """The run's folder once there is one."""
        return Path(self.client.run_dir) if self.client.run_dir else None

    @property
    def scene_path(self) -> Path | None:
        """Where the run's scene is or will be."""
        request = self.client.request
        if request is not None and request.output:
            return Path(request.output)
        return self.run_dir / SCENE if self.run_dir is not None else None

    def start(self, request: RunRequest) -> None:
        """Starts a worker; GenmojoErrors are told through `failed`."""
        self._begin()
        self._ask(lambda: self.client.start(request))

    def attach(self, run_dir: Path) -> None:
        """Shows a run that lives."""
        self._begin()
        self._ask(lambda: self.client.attach(str(run_dir)))

    def resume(self, run_dir: Path) -> None:
        """Goes on from a run folder's checkpoint."""
        self._begin()
        self._ask(lambda: self.client.resume_run(run_dir))

    def detach(self) -> None:
        """Lets the worker go on alone; its run can be attached to later."""
        self.client.detach()
        self.state = ""
        self.quiet.emit(False)

    def look(self, frame: int) -> None:
        """Previews of this frame from now on."""
        if self.live:
            self._unasked.add(self.client.look(frame))

    def sweep(self) -> None:
        """All frames as they stand now, once."""
        if self.live:
            self._unasked.add(self.client.sweep())

    def show_view(self, shown: bool) -> None:
        """While nobody sees the view, the worker makes no previews."""
        self._view_shown = shown
        if self.live:
            self._unasked.add(self.client.set_view("live" if shown else "off"))

    def scene_so_far(self, then: Callable[[Path], None]) -> None:
        """Writes the scene as it stands into the run's folder and calls `then` with its path; the run goes on."""
        if self.run_dir is not None:
            path = self.run_dir / f"so-far-{len(self.log.step)}.h5"
            self._wanted.append((path, then))
            self._ask(lambda: self.client.write_scene(str(path)))

    def set_parameter(self, name: str, value: float) -> None:
        """Changes a number of the run from its next step on."""
        self._ask(lambda: self.client.set_parameter(name, value))

    def pause_or_resume(self) -> None:
        """Pauses a running run, lets a paused one go on."""
        self._ask(self.client.resume if self.state == "paused" else self.client.pause)

    def step(self) -> None:
        """One step, then paused."""
        self._ask(lambda: self.client.step(1))

    def run_to_next_stage(self) -> None:
        """Goes on and pauses where the next stage begins."""
        self._ask(self.client.run_to_next_stage)

    def checkpoint(self) -> None:
        """Writes a checkpoint at the next step."""
        self._ask(self.client.checkpoint)

    def stop(self, keep: bool) -> None:
        """Ends the run; `keep` writes the scene as it stands."""
        self._ask(lambda: self.client.stop(keep))

    def _begin(self) -> None:
        self.log = RunLog()
        self._wanted = []
        self.parameters = {}
        self._rule = StopRule()
        self.phase = ""
        self.began.emit()
        self.log_grew.emit()

    def _ask(self, command: Callable[[], Any]) -> None:
        try:
            command()
        except GenmojoError as error:
            self.failed.emit(error)

    def _state(self, state: str) -> None:
        began = state == "running" and self.state in ("starting", "ready")
        self.state = state
        if state not in ("running", "stepping"):
            self.quiet.emit(False)  # a measurement that was cut short keeps nothing from the view
        if began and not self._view_shown:
            self.show_view(False)
        self.state_changed.emit()
        scene = self.scene_path
        if state == "done" and scene is not None and scene.exists():
            self.ended.emit(scene)
        if state in ENDED:
            self._answer_wanted(scene if state == "done" else None)

    def _answer_wanted(self, scene: Path | None) -> None:
        """The run is over: who waits for its scene gets the last one, or is told that there is none."""
        wanted, self._wanted = self._wanted, []
        if scene is not None and scene.exists():
            for _, then in wanted:
                then(scene)
        elif wanted:
            self.failed.emit(GenmojoError("io", "the run ended before its scene was written", str(self.run_dir),
                                          "resume the run and try again"))  # fmt: skip

    def _event(self, event: dict[str, Any]) -> None:
        points = len(self.log.accuracy)
        self.log.add(event)
        if event.get("event") == "SceneWritten":
            for path, then in [wanted for wanted in self._wanted if str(wanted[0]) == event.get("path")]:
                self._wanted.remove((path, then))
                then(path)
        if event.get("event") == "Checkpointed" and self.state in ("running", "stepping", "paused"):
            self.checkpointed.emit(int(event["step"]))
        if event.get("event") == "ParameterChanged":
            self.parameters[str(event["name"])] = float(event["new"])
        self.log_grew.emit()
        if self.stop_below is not None and len(self.log.accuracy) > points and self.state == "running":
            curve = [(at, value) for at, _, value in self.log.accuracy]
            if self._rule.reached(curve, self.stop_below):
                self.stop(keep=True)

    def _preview(self, snapshot: SceneSnapshot) -> None:
        self.snapshot.emit(snapshot)

    def _beat(self, beat: dict[str, Any]) -> None:
        self.log.add_memory(float(beat.get("rss_mb", 0.0)))
        view = beat.get("view", {})
        drawing = max(float(view.get("draw_share") or 0.0), self.draw_share())
        self.view_cost = float(view.get("publish_share") or 0.0) + drawing
        self.log_grew.emit()

    def _phase(self, _phase: str, note: str) -> None:
        self.phase = note
        self.state_changed.emit()

    def _acknowledged(self, number: int, ok: bool, outcome: Any) -> None:
        if not ok and number not in self._unasked:
            self.failed.emit(GenmojoError("argument", str(outcome).rstrip("."), "run"))
        self._unasked.discard(number)

    def _died(self, report: DeathReport) -> None:
        self.died.emit(report)
