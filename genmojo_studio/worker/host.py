"""The worker: a program of its own that optimises one run folder and talks to any window that asks.

    python -m genmojo_studio.worker.host --run-dir DIR

DIR holds request.json (protocol.RunRequest). It lives on when the window closes, and ends when the run is over. What it
says goes to events.jsonl, how it ended to exit.json, the scene to scene.h5, prints and traces to worker.log.
"""

from __future__ import annotations

import argparse
import faulthandler
import json
import os
import secrets
import signal
import sys
import threading
import time
import traceback
from pathlib import Path
from types import FrameType, TracebackType
from typing import Any, Protocol

from genmojo_core.errors import GenmojoError
from genmojo_core.sentences import say
from genmojo_core.store.atomic import write_bytes
from genmojo_studio.worker import machine, runs
from genmojo_studio.worker.governor import Governor
from genmojo_studio.worker.link import Link
from genmojo_studio.worker.protocol import RunRequest
from genmojo_studio.worker.publisher import Publisher
from genmojo_studio.worker.session import Optimisation, Session

STUCK_SECONDS = 60.0  # a step may take so long, or STUCK_STEPS times as long as usual
STUCK_STEPS = 20.0
PHASE_SECONDS = 900.0  # and any other phase so long
_ANNOUNCE_SECONDS = 2.0  # a silence is announced before it begins
_OUT_OF_MEMORY = ("can't allocate memory", "not enough memory", "out of memory", "OutOfMemoryError")


class Job(Protocol):
    """What the host does with a request; the real one is `Optimise`, tests have their own."""

    def run(self, host: Host) -> None:
        """Prepare, drive `host.session`, write the scene."""
        ...


class Host:
    """Everything a job needs: the folder, the request, the windows, the session.

    Args:
        run_dir: the run folder. Raises GenmojoError("schema") if it holds no request.
    """

    def __init__(self, run_dir: Path) -> None:
        self.folder = run_dir
        self.request = RunRequest.from_json(runs.read_json(run_dir / runs.REQUEST))
        self.phase, self.note, self.silence = "starting", "starting", 30.0
        self.compiling = 0.0
        self.governor = Governor(self.request.cadence)
        self.publisher = Publisher(run_dir, self.tell, self.governor)
        self.publisher.frame = self.request.look_at
        self.session = Session(self.tell, self.publisher, self.request.paused)
        self._events = runs.open_events(run_dir)
        self._count = len(runs.read_events(run_dir))
        self._lock = threading.Lock()
        self.link: Link | None = None

    def tell(self, message: dict[str, Any]) -> None:
        """Send a message to all windows; events are numbered and kept in events.jsonl first."""
        if message["type"] == "event":
            with self._lock:
                message = {**message, "n": self._count}
                self._events.write(json.dumps(message["event"], allow_nan=True).encode() + b"\n")
                self._events.flush()
                self._count += 1  # only now: a window that says hello reads so many from the file
        if self.link is not None:
            self.link.tell(message)

    def announce(self, phase: str, note: str, silence: float) -> None:
        """Say what the worker is at and for how many seconds it may be silent; "loaded" ends loading and compiling."""
        if phase in ("loading", "compiling"):
            self.compiling = silence
        elif phase == "loaded":
            self.compiling = 0.0
            return
        else:
            self.silence = silence
        self.phase, self.note = phase, note
        self.session.touched = time.monotonic()
        self.tell({"type": "phase", "phase": phase, "note": note, "silence": max(silence, self.compiling)})
        if self.compiling and self.link is not None:  # a compiler may keep the interpreter to itself at once
            self.link.leave(_ANNOUNCE_SECONDS)

    def hello(self) -> dict[str, Any]:
        """What a window hears first."""
        return {"state": self.session.state, "phase": self.phase, "note": self.note, "events": self._count,
                "silence": max(self.silence, self.compiling), "streams": self.publisher.files(),
                "request": self.request.to_json(), "pid": os.getpid(), "beat": self.beat()}  # fmt: skip

    def beat(self) -> dict[str, Any]:
        """The heartbeat; `stuck` is True when the run itself has not moved for longer than it may."""
        session = self.session
        quiet = time.monotonic() - session.touched
        stepping = self.phase == "stepping"
        allowed = max(STUCK_SECONDS, STUCK_STEPS * session.step_seconds) if stepping else PHASE_SECONDS
        cost = self.governor.cost(time.monotonic())
        return {
            "phase": self.phase, "note": self.note, "step": session.step, "step_seconds": session.step_seconds,
            "quiet": quiet, "stuck": quiet > max(allowed, self.compiling), "cadence": self.governor.cadence,
            "view": {"publish_share": cost.publish_share, "draw_share": cost.draw_share, "interval": cost.interval},
            "cpu_seconds": time.process_time(), **machine.memory(),
        }  # fmt: skip


class Optimise:
    """The job: a clip becomes a scene file."""

    def run(self, host: Host) -> None:
        """Prepare, optimise, write. Raises GenmojoError for what is wrong with the input."""
        from genmojo_core.config import preset
        from genmojo_core.measure import effect_costs
        from genmojo_core.store import scene_hdf5
        from genmojo_studio.worker import preparing
        from genmojo_studio.worker.first_cloud import first_cloud

        session, request = host.session, host.request
        session.enter("ready")
        config = preset(request.preset, **request.changes)
        if not request.resume:
            host.announce("looking", say("lifting"), 60.0)
            first = first_cloud(request)
            if first is not None:
                host.publisher.show(first.cloud, first.t, ("points", 0), first.setting)
        loading = preparing.load_and_compile(config, host.announce)
        try:
            clip, plan, config = preparing.prepare(request, host.announce, session.stop_asked.is_set)
        except preparing.StopAsked:
            return
        loading.join()
        host.tell({"type": "event", "event": {"event": "Planned", "effects": plan.to_json(), "frames": len(clip),
                                              "guesses": list(clip.guesses), "config": config.to_json()}})  # fmt: skip
        run = preparing.build(clip, plan, config, request)
        drive(host, run)
        effect_costs.keep_run(clip.name, run.run.plan)
        if session.keep and hasattr(run.run, "scene"):
            session.enter("finishing")
            host.announce("writing", say("writing"), 120.0)
            path = Path(request.output) if request.output else host.folder / runs.SCENE
            scene_hdf5.write(run.run.bake(), path)
            host.tell({"type": "event", "event": {"event": "SceneWritten", "path": str(path)}})
        if session.failure is not None:
            raise GenmojoError("numeric", session.failure.message.rstrip("."))


def drive(host: Host, run: Optimisation) -> None:
    """Let the session drive a run, with the phase told."""
    host.announce("stepping", say("optimising"), 0.0)
    host.session.drive(run)


def main(argv: list[str] | None = None, job: Job | None = None) -> int:
    """The program. `job`: what to do instead of optimising (tests)."""
    parser = argparse.ArgumentParser(prog="genmojo-worker", description="Optimises one run folder.")
    parser.add_argument("--run-dir", required=True, type=Path)
    folder = parser.parse_args(argv).run_dir.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    fault_log = open(folder / runs.FAULT, "w")  # noqa: SIM115 - the fault handler needs it to the very end
    faulthandler.enable(fault_log)
    (folder / runs.EXIT).unlink(missing_ok=True)
    with _Report(folder):
        host = Host(folder)
        token = secrets.token_hex(16)
        with Link(token, host.hello, host.beat, host.session.put) as link:
            host.link = link
            run = runs.LiveRun(str(folder), host.request.clip, os.getpid(), link.address, token, time.time())
            with runs.RunLock(run), _Report(folder, host):
                signal.signal(signal.SIGTERM, _Stop(host))
                if hasattr(signal, "SIGHUP"):  # the window's terminal is closed
                    signal.signal(signal.SIGHUP, signal.SIG_IGN)
                (job or Optimise()).run(host)
                host.publisher.close()
                host.session.answer_rest()
                _leave(folder, {"kind": "done", "kept": host.session.keep})
                host.session.enter("done", "" if host.session.keep else "discarded")
    return 0


class _Stop:
    """SIGTERM is a stop that keeps what stands; the second one ends at once."""

    def __init__(self, host: Host) -> None:
        self.host = host

    def __call__(self, number: int, frame: FrameType | None) -> None:
        if self.host.session.stop_asked.is_set():
            raise KeyboardInterrupt
        self.host.session.put({"id": "signal", "name": "stop", "arguments": {"keep": True}})


class _Report:
    """Around the work: an exception is kept in exit.json and told to the windows, then goes its way."""

    def __init__(self, folder: Path, host: Host | None = None) -> None:
        self.folder, self.host = folder, host

    def __enter__(self) -> None:
        return

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if kind is None or error is None or (self.folder / runs.EXIT).exists():
            return
        report = _described(kind, error, trace)
        _leave(self.folder, report)
        if self.host is not None:
            self.host.session.enter("failed", report["title"])


def _described(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> dict[str, Any]:
    """Class, sentence and details of an exception."""
    traceback.clear_frames(trace)  # what they held is free again, which a report on memory may need
    text = "".join(traceback.format_exception(kind, error, trace, limit=40))
    if isinstance(error, GenmojoError):
        return {"kind": "input", "code": error.code, "title": error.sentence(), "detail": ""}
    if isinstance(error, MemoryError) or any(mark in f"{kind.__name__}: {error}" for mark in _OUT_OF_MEMORY):
        peak = machine.memory()["peak_mb"] / 1024
        return {"kind": "memory", "title": f"There was not enough memory; {peak:.1f} GB were in use.", "detail": text}
    if isinstance(error, KeyboardInterrupt):
        return {"kind": "killed", "title": "The optimiser was interrupted.", "detail": ""}
    return {"kind": "exception", "title": f"The optimiser stopped with an error: {kind.__name__}: {error}"[:300],
            "detail": text}  # fmt: skip


def _leave(folder: Path, report: dict[str, Any]) -> None:
    """exit.json, the last thing written."""
    write_bytes(folder / runs.EXIT, json.dumps({"pid": os.getpid(), **report}).encode())


if __name__ == "__main__":
    sys.exit(main())
