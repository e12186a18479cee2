"""The window's end of a run: starts the worker, talks to it, shows what it says, and knows when and why it died.

    client = WorkerClient()
    client.state_changed.connect(...)
    client.start(RunRequest("clips/crossing", preset="draft"))

States come from the worker's own messages, never from a pressed button. Imports no torch.
"""

from __future__ import annotations

import contextlib
import json
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

from PySide6.QtCore import QObject, QTimer, Signal

from genmojo_core.errors import GenmojoError
from genmojo_core.store.atomic import write_bytes
from genmojo_studio.translate import tr
from genmojo_studio.view3d.snapshot import SceneSnapshot
from genmojo_studio.worker import death, runs
from genmojo_studio.worker.line import Line
from genmojo_studio.worker.preview_bus import BusReader
from genmojo_studio.worker.preview_codec import Layers, unpack_now, with_layers
from genmojo_studio.worker.process import WorkerProcess
from genmojo_studio.worker.protocol import ENDED, SILENCE_SECONDS, VERSION, Cadence, RunRequest

_TICK_MS = 100
_HELLO_SECONDS = 30.0  # a program that loads on a busy machine may be silent so long before its first word
_ASLEEP_SECONDS = 2.0  # a gap between ticks after which it was the window that slept
_DISCARD_SECONDS = 10.0  # then a worker that should stop is told harder, and after as long again killed


class WorkerClient(QObject):
    """One run as the window sees it.

    Args:
        program: command that runs the worker, None for this installation's.

    Signals: state_changed(state), event_received(event as JSON), preview_ready(SceneSnapshot), died(DeathReport; not
    final for a hang, which may pass), phase_changed(phase, note), beat_received(beat), acknowledged(id, ok, result or
    sentence), probe_changed(on): do not draw while on.
    """

    state_changed = Signal(str)
    event_received = Signal(dict)
    preview_ready = Signal(object)
    died = Signal(object)
    phase_changed = Signal(str, str)
    beat_received = Signal(dict)
    acknowledged = Signal(int, bool, object)
    probe_changed = Signal(bool)

    def __init__(self, parent: QObject | None = None, program: list[str] | None = None) -> None:
        super().__init__(parent)
        self.state, self.run_dir = "done", ""
        self.request: RunRequest | None = None
        self._program = program
        self._process: WorkerProcess | None = None
        self._line = Line(self)
        self._line.message.connect(self._on_message)
        self._line.closed.connect(self._check_end)
        self._timer = QTimer(self)
        self._timer.setInterval(_TICK_MS)
        self._timer.timeout.connect(self._tick)
        self._forget()

    # ---- what a window may ask for -----------------------------------------------------------------------------------

    def start(self, request: RunRequest) -> str:
        """Start a worker on a request; returns its run folder (made if the request names none).

        Raises GenmojoError("io") when the folder cannot be used or another worker is at it, "argument" while this
        client has a run.
        """
        self._must_be_free()
        folder = Path(request.run_dir) if request.run_dir else runs.new_run_dir(request.clip)
        if runs.live_run(folder) is not None:
            raise GenmojoError("io", "another worker is optimising in this folder", str(folder), "attach to it")
        request = replace(request, run_dir=str(folder.resolve()))
        if not request.resume:
            (folder / runs.EVENTS).unlink(missing_ok=True)
        write_bytes(folder / runs.REQUEST, json.dumps(request.to_json()).encode())
        self._forget()
        self.request, self.run_dir = request, str(folder)
        self._process = WorkerProcess.started(folder, self._program)
        self._enter("starting")
        self._timer.start()
        return self.run_dir

    def resume_run(self, run_dir: str | Path, **changes: Any) -> str:
        """Start a worker that goes on from a run folder's last checkpoint; `changes` replace fields of its request.

        Raises GenmojoError("io") where there is no checkpoint.
        """
        folder = Path(run_dir)
        if not (folder / "checkpoint.json").is_file():
            raise GenmojoError("io", "there is no checkpoint to resume from", str(folder), "start the run anew")
        request = RunRequest.from_json(runs.read_json(folder / runs.REQUEST))
        return self.start(replace(request, run_dir=str(folder), resume=True, **changes))

    def attach(self, run_dir: str | Path) -> None:
        """Watch a worker that is alive; what it said so far comes first. Raises GenmojoError("io") if none is."""
        self._must_be_free()
        run = runs.live_run(run_dir)
        if run is None:
            raise GenmojoError("io", "no optimiser is at work in this folder", str(run_dir), "open its scene or resume")
        self._forget()
        self.run_dir = str(run_dir)
        self._process = WorkerProcess(Path(run_dir), run.pid)
        self._enter("starting")
        self._connect(run)
        self._timer.start()

    def detach(self) -> None:
        """Let go of the worker, which goes on alone."""
        self._timer.stop()
        self._line.close()
        if self._process is not None:
            self._process.let_go()
        self._process = None
        self._forget()
        self.state = "done"

    def pause(self) -> int:
        """Wait after the present step. This and the other commands return a number that `acknowledged` brings back."""
        return self._command("pause")

    def resume(self) -> int:
        """Go on after a pause."""
        return self._command("resume")

    def step(self, n: int = 1) -> int:
        """Take n steps, then pause."""
        return self._command("step", {"n": n})

    def run_to_next_stage(self) -> int:
        """Go on, and pause where the next stage begins."""
        return self._command("run_to_next_stage")

    def set_parameter(self, name: str, value: float) -> int:
        """Change a parameter of `genmojo_core.optimise.parameters.PARAMETERS` from the next step on."""
        return self._command("set_parameter", {"name": name, "value": value})

    def checkpoint(self) -> int:
        """Write a checkpoint now."""
        return self._command("checkpoint")

    def look(self, frame: int) -> int:
        """Send previews of this frame from now on."""
        return self._command("look", {"frame": frame})

    def sweep(self) -> int:
        """Send all frames as they stand now; without it they come by themselves, every few seconds to minutes."""
        return self._command("sweep")

    def write_scene(self, path: str) -> int:
        """Write the scene as it stands while the run goes on; the event SceneWritten tells when it is there."""
        return self._command("write_scene", {"path": path})

    def set_view(self, cadence: Cadence) -> int:
        """How often previews come: "live" (as often as 3 % of the time allows), "slow" (1 Hz) or "off"."""
        return self._command("set_view", {"cadence": cadence})

    def stop(self, keep: bool = True) -> int:
        """End the run: `keep` writes checkpoint and scene. Without, a worker that does not obey is ended by force."""
        if not keep:
            self._force_at = time.monotonic() + _DISCARD_SECONDS
        return self._command("stop", {"keep": keep})

    def kill(self) -> None:
        """End the worker at once; what came after its last checkpoint is lost."""
        if self._process is not None:
            self._process.kill()

    # ---- what happens ------------------------------------------------------------------------------------------------

    def _forget(self) -> None:
        """Nothing is known about a run."""
        self.beat: dict[str, Any] = {}
        self.phase, self.note = "", ""
        self._hello = False
        self._waiting: list[dict[str, Any]] = []
        self._events = 0
        self._silence = _HELLO_SECONDS
        self._heard = self._ticked = time.monotonic()
        self._host_state = "starting"
        self._readers: dict[str, BusReader] = {}
        self._fresh: set[str] = set()
        self._layers: Layers | None = None
        self._snapshot: SceneSnapshot | None = None
        self._force_at = float("inf")
        self.latency = 0.0  # seconds from the worker's publishing to the last snapshot
        self._count = 0
        self._versions = 0

    def _must_be_free(self) -> None:
        if self._process is not None and self.state == "done":  # it has said all; its process may take a moment to go
            self._line.drain()
            self._catch_up(None)
            self._remove_buses()
            self.detach()
        if self._process is not None:
            raise GenmojoError("argument", "a run is going on here", self.run_dir, "stop it or detach first")

    def _command(self, name: str, arguments: dict[str, Any] | None = None) -> int:
        """Send a command, or keep it until the worker listens."""
        self._count += 1
        message = {"type": "command", "id": self._count, "name": name, "arguments": arguments or {}}
        if self._process is None:
            self.acknowledged.emit(self._count, False, "There is no run.")
        elif self._hello:
            self._line.send(message)
        else:
            self._waiting.append(message)
        return self._count

    def _enter(self, state: str) -> None:
        if state != self.state:
            self.state = state
            self.state_changed.emit(state)

    def _connect(self, run: runs.LiveRun) -> None:
        if not self._line.open(run.address):
            return
        self._line.send({"type": "hello", "version": VERSION, "token": run.token})

    def _tick(self) -> None:
        """Ten times a second: is it there, is it well, is it gone?"""
        now = time.monotonic()
        if now - self._ticked > _ASLEEP_SECONDS:
            self._heard = now
        self._ticked = now
        if self._process is None:
            return
        if not self._line.is_open and not self._check_end():
            run = runs.live_run(self.run_dir)
            if run is not None:
                self._connect(run)
        elif self._check_end():
            return
        silent = now - self._heard
        if silent > self._silence and self.state not in (*ENDED, "lost"):
            self._lost(silent)
        if now > self._force_at and self._process is not None:
            self._force_at = now + _DISCARD_SECONDS
            self._process.end_harder()

    def _lost(self, silent: float) -> None:
        """No sign of life."""
        self._enter("lost")
        self.died.emit(death.hung(self.run_dir, self.beat, silent, self.note))

    def _check_end(self) -> bool:
        """True if the worker has ended; says how, once."""
        process = self._process
        if process is None or not process.ended():
            return process is None
        self._line.drain()
        self._timer.stop()
        self._process = None
        self._line.close()
        self._catch_up(None)
        self._remove_buses()
        left = runs.read_json(Path(self.run_dir) / runs.EXIT)
        if left.get("kind") == "done" and left.get("pid") == process.pid:
            self._enter("done")
            return True
        process.sweep_up()
        report = death.classify(self.run_dir, process.exit_code, self.beat, self._hello, process.pid)
        self._enter("failed")
        self.died.emit(report)
        return True

    def _remove_buses(self) -> None:
        for bus in Path(self.run_dir).glob("*.bus"):
            with contextlib.suppress(OSError):  # on Windows a mapped file stays until the next run
                bus.unlink()

    def _on_message(self, message: dict[str, Any]) -> None:
        """One message of the worker."""
        self._heard = time.monotonic()
        handler = getattr(self, f"_on_{message['type']}", None)
        if handler is not None:
            handler(message)
        if self._fresh and not self._line.more:
            self._show()

    def _on_hello(self, message: dict[str, Any]) -> None:
        self._hello = True
        self.request = RunRequest.from_json(message["request"])
        self._catch_up(int(message["events"]))
        self._on_phase(message)
        self._on_bus(message)
        self._fresh = set(self._readers)
        self._on_beat(message["beat"])
        self._on_state(message)
        for command in self._waiting:
            self._line.send(command)
        self._waiting = []

    def _catch_up(self, end: int | None) -> None:
        """Tell what was said while nobody listened, up to an event's number (None: to the end)."""
        events = runs.read_events(self.run_dir, self._events)
        events = events if end is None else events[: max(0, end - self._events)]
        self._events += len(events)
        for event in events:
            self.event_received.emit(event)

    def _on_refused(self, message: dict[str, Any]) -> None:
        self._line.close()
        title = tr("The run was started by another version of the program (protocol {version}).")
        title = title.format(version=message.get("version"))
        report = death.DeathReport("version", title, tr(death.ADVICE["version"]), final=False, run_dir=self.run_dir)
        self._timer.stop()
        self.died.emit(report)

    def _on_state(self, message: dict[str, Any]) -> None:
        self._host_state = message["state"]
        if self._host_state != "failed":  # that one comes with its reason, when the process has ended
            self._enter(self._host_state)

    def _on_event(self, message: dict[str, Any]) -> None:
        number = int(message["n"])
        if number > self._events:  # some did not come: the worker was short of memory
            self._catch_up(number)
        if number >= self._events:
            self._events = number + 1
            self.event_received.emit(message["event"])

    def _on_phase(self, message: dict[str, Any]) -> None:
        self.phase, self.note = message["phase"], message["note"]
        self._silence = max(SILENCE_SECONDS, float(message["silence"]))
        self.phase_changed.emit(self.phase, self.note)

    def _on_beat(self, message: dict[str, Any]) -> None:
        self.beat = {key: value for key, value in message.items() if key != "type"}
        self.beat_received.emit(self.beat)
        if message.get("stuck") and self.state not in (*ENDED, "lost"):
            self._lost(float(message["quiet"]))
        elif self.state == "lost" and not message.get("stuck"):
            self._enter(self._host_state)

    def _on_ack(self, message: dict[str, Any]) -> None:
        if isinstance(message.get("id"), int):
            outcome = message.get("result") if message.get("ok") else message.get("error")
            self.acknowledged.emit(message["id"], bool(message.get("ok")), outcome)

    def _on_probe(self, message: dict[str, Any]) -> None:
        self.probe_changed.emit(bool(message["on"]))

    def _on_bus(self, message: dict[str, Any]) -> None:
        """Open the buses that are new."""
        for stream, path in message["streams"].items():
            old = self._readers.get(stream)
            if old is not None and str(old.path) == path:
                continue
            if old is not None:
                old.close()
            with contextlib.suppress(GenmojoError):  # gone already: a larger one follows
                self._readers[stream] = BusReader(path)

    def _on_preview(self, message: dict[str, Any]) -> None:
        self._fresh.add(message["stream"])

    def _show(self) -> None:
        """Read what is new from the buses and pass one snapshot on."""
        fresh, self._fresh = self._fresh, set()
        if "layers" in fresh and "layers" in self._readers:
            found = self._readers["layers"].latest()
            self._layers = self._layers if found is None else Layers(found)
        if "now" in fresh and "now" in self._readers:
            found = self._readers["now"].latest()
            if found is not None:
                self._snapshot = unpack_now(found)
                self.latency = time.monotonic() - found.published
        if self._snapshot is not None:
            self._versions += 1
            self._snapshot = with_layers(self._snapshot, self._layers, self._versions)
            self.preview_ready.emit(self._snapshot)
