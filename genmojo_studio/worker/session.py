"""Drives a run by the window's commands: every command takes effect between two steps and is then acknowledged.

Knows no socket and no torch: messages leave through `tell`, commands come in through `put` from any thread.
"""

from __future__ import annotations

import queue
import threading
import time
from collections.abc import Callable, Iterator
from typing import Any, Protocol

from genmojo_core import events
from genmojo_core.errors import GenmojoError
from genmojo_studio.worker.protocol import COMMANDS, State
from genmojo_studio.worker.publisher import Publisher, Viewed

Message = dict[str, Any]
_IDLE_SECONDS = 0.25


class Held(Protocol):
    """A clock that can stand still."""

    def hold(self) -> None:
        """Stand still."""
        ...

    def go_on(self) -> None:
        """Go on."""
        ...


class Optimisation(Viewed, Protocol):
    """A run that can be driven; `genmojo_core.optimise.run.Run` with its setting is one."""

    clock: Held
    reference: int

    @property
    def steps_done(self) -> int:
        """Steps since the first start, over resumes."""
        ...

    def __iter__(self) -> Iterator[events.Event]:
        """The events of the run."""
        ...

    def stop(self) -> None:
        """End after the present step."""
        ...

    def change(self, name: str, value: float) -> events.ParameterChanged:
        """Set a parameter from the next step on."""
        ...

    def checkpoint(self) -> events.Checkpointed | None:
        """Write a checkpoint now."""
        ...

    def write_scene(self, path: str, told: Callable[[str], None]) -> None:
        """Write the scene as it stands, beside the run; `told` gets "" or what went wrong, from another thread."""
        ...


class Session:
    """One run under command.

    Args:
        tell: sends a message to all windows; called from the thread that drives. publisher: previews.
        paused: wait before the first step.
    """

    def __init__(self, tell: Callable[[Message], None], publisher: Publisher, paused: bool = False) -> None:
        self.tell, self.publisher = tell, publisher
        self.governor = publisher.governor
        self.state: State = "starting"
        self.stage, self.step = "", 0
        self.failure: events.Failed | None = None
        self.keep = True
        self.stop_asked = threading.Event()
        self.step_seconds = 0.0
        self.touched = time.monotonic()  # when the driving thread last got anywhere
        self._commands: queue.SimpleQueue[Message] = queue.SimpleQueue()
        self._run: Optimisation | None = None
        self._pause_before_steps = paused
        self._steps_left: int | None = None
        self._to_next_stage = False
        self._shown = False
        self._probing = False

    def put(self, command: Message) -> None:
        """A command of a window, from any thread. A stop is noticed at once by whatever can end early."""
        if command.get("name") == "stop":
            self.stop_asked.set()
            if self._run is not None:
                self._run.stop()
        self._commands.put(command)

    def enter(self, state: State, reason: str = "") -> None:
        """Be in another state and say so."""
        if state != self.state:
            self.state = state
            self.tell({"type": "state", "state": state, "reason": reason})

    def drive(self, run: Optimisation) -> None:
        """Run to the end, to a stop or to a failure (then `failure` is set)."""
        self._run = run
        if self.stop_asked.is_set():
            run.stop()
        self.enter("running")
        stream = iter(run)
        while True:
            self._obey()
            if self.stop_asked.is_set() and not self.keep:
                break
            begun = time.perf_counter()
            event = next(stream, None)
            if event is None:
                break
            self._heard(event, time.perf_counter() - begun)
        self._obey()
        if self.keep and self._shown:  # what stands at the end is shown even if previews were off
            self.publisher.show_run(run, run.reference, (self.stage, self.step))

    def answer_rest(self) -> None:
        """Refuse what came too late, except to stop."""
        while not self._commands.empty():
            command = self._commands.get()
            over = command.get("name") == "stop"
            self._ack(command, result=self.state if over else None, error="" if over else "The run is over.")

    def _heard(self, event: events.Event, seconds: float) -> None:
        """Pass an event on, count, show, and pause where that was asked for."""
        self.touched = time.monotonic()
        self.tell({"type": "event", "event": event.to_json()})
        if isinstance(event, events.StageStarted):
            self.stage = event.stage
            if event.steps and (self._pause_before_steps or self._to_next_stage):
                self._pause_before_steps = self._to_next_stage = False
                self.enter("paused", "next stage")
        elif isinstance(event, events.Preview):
            self._show(event.frame)
        elif isinstance(event, events.Step):
            self._stepped(event, seconds)
        elif isinstance(event, events.Failed):
            self.failure = event

    def _stepped(self, event: events.Step, seconds: float) -> None:
        """Bookkeeping and previews after a step."""
        self.step = self.step + 1 if self._run is None else self._run.steps_done
        self.step_seconds = seconds if not self.step_seconds else 0.9 * self.step_seconds + 0.1 * seconds
        self.governor.stepped(seconds)
        if self.governor.probing != self._probing:
            self._probing = self.governor.probing
            self.tell({"type": "probe", "on": self._probing})
        if self._steps_left is not None:
            self._steps_left -= 1
            if self._steps_left <= 0:
                self._steps_left = None
                self._show(None)
                self.enter("paused", "steps done")
        if self._run is not None and self._shown:
            if self.governor.due(time.monotonic()):
                self._show(None)
            self.publisher.sweep_some(self._run, self.step, seconds)

    def _show(self, frame: int | None) -> None:
        """Publish the frame on show; `frame`: what the run itself looked at."""
        if self._run is None or (self.governor.cadence == "off" and self._shown):
            return
        reference = self._run.reference if frame is None else frame
        self.publisher.show_run(self._run, reference, (self.stage, self.step))
        self._shown = True

    def _obey(self) -> None:
        """All commands that wait; while paused also those that come."""
        while not self._commands.empty():
            self._do(self._commands.get())
        if self.state != "paused" or self._run is None:
            return
        self._run.clock.hold()
        while self.state == "paused" and not self.stop_asked.is_set():
            self.touched = time.monotonic()
            try:
                self._do(self._commands.get(timeout=_IDLE_SECONDS))
            except queue.Empty:
                continue
        self._run.clock.go_on()
        while not self._commands.empty():
            self._do(self._commands.get())

    def _do(self, command: Message) -> None:
        """One command, acknowledged with its result or refused with a sentence."""
        name = str(command.get("name", ""))
        arguments = command.get("arguments") or {}
        if name not in COMMANDS or not isinstance(arguments, dict):
            self._ack(command, error=f"There is no command '{name}'.")
            return
        try:
            self._ack(command, result=getattr(self, f"_{name}")(**arguments))
        except GenmojoError as error:
            self._ack(command, error=error.sentence())
        except (TypeError, ValueError, KeyError) as error:
            self._ack(command, error=f"The command '{name}' came with wrong values ({error}).")

    def _ack(self, command: Message, result: Any = None, error: str = "") -> None:
        outcome = {"ok": False, "error": error} if error else {"ok": True, "result": result}
        self.tell({"type": "ack", "id": command.get("id"), "name": command.get("name"), **outcome})

    # ---- one method per name in COMMANDS -----------------------------------------------------------------------------

    def _ping(self) -> str:
        return self.state

    def _pause(self) -> str:
        if self.state in ("running", "stepping"):
            self._steps_left, self._to_next_stage = None, False
            self.enter("paused")
            self._show(None) if self._shown else None
        return self.state

    def _resume(self) -> str:
        if self.state == "paused":
            self.enter("running")
        return self.state

    def _step(self, n: int = 1) -> str:
        if int(n) < 1:
            raise GenmojoError("argument", f"{n} are no steps", "", "give 1 or more")
        self._steps_left = int(n)
        self.enter("stepping")
        return self.state

    def _run_to_next_stage(self) -> str:
        self._to_next_stage = True
        self.enter("stepping")
        return self.state

    def _set_parameter(self, name: str, value: float) -> float:
        if self._run is None:
            raise GenmojoError("argument", "the run has not begun", "", "wait for the first scene")
        changed = self._run.change(name, value)
        self.tell({"type": "event", "event": changed.to_json()})
        return changed.new

    def _checkpoint(self) -> str | None:
        written = None if self._run is None else self._run.checkpoint()
        if written is None:
            raise GenmojoError("argument", "there is nothing to keep yet", "", "wait for the first step")
        self.tell({"type": "event", "event": written.to_json()})
        return written.path

    def _stop(self, keep: bool = True) -> str:
        self.keep = bool(keep)
        self.stop_asked.set()
        self.enter("stopping")
        return self.state

    def _look(self, frame: int) -> int:
        self.publisher.frame = int(frame)
        if self._shown:
            self._show(None)
        return int(frame)

    def _sweep(self) -> bool:
        if self._run is None or not self._shown:
            raise GenmojoError("argument", "there is no scene yet", "", "wait for the first preview")
        self.publisher.sweep_all(self._run, self.step)
        return True

    def _write_scene(self, path: str) -> str:
        if self._run is None or not self._shown:
            raise GenmojoError("argument", "there is no scene yet", "", "wait for the first preview")

        def told(fault: str) -> None:
            event = {"event": "Warned", "code": "scene_not_written", "message": fault} if fault else {
                "event": "SceneWritten", "path": str(path)}  # fmt: skip
            self.tell({"type": "event", "event": event})

        self._run.write_scene(str(path), told)
        return str(path)

    def _set_view(self, cadence: str) -> str:
        self.governor.set_cadence(cadence)
        return cadence
