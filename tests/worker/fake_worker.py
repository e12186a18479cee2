"""A worker whose optimiser only walks at random: the whole machinery without torch, and faults on request.

The request's `models` say what it does: step_seconds, steps, lift (of these), gaussians, frames; fault (exception,
memory, segfault, exit, hang, compile) at which step; endless: it goes on until it is killed, and for `steps` once
resumed. It begins when a window listens, so that no test depends on how soon that is.
"""

from __future__ import annotations

import ctypes
import json
import os
import signal
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

from genmojo_core import events
from genmojo_core.clip.cameras import Cameras
from genmojo_core.errors import GenmojoError
from genmojo_core.optimise import parameters
from genmojo_core.store.atomic import write_bytes
from genmojo_studio.view3d.snapshot import SnapshotObject
from genmojo_studio.worker import host as worker
from genmojo_studio.worker.preview_codec import Cloud, Setting


class FakeClock:
    held = False

    def hold(self) -> None:
        self.held = True

    def go_on(self) -> None:
        self.held = False


class FakeRun:
    """Random walk; step t moves every Gaussian; deterministic by step."""

    def __init__(self, host: worker.Host) -> None:
        self.host = host
        options = host.request.models
        self.step_seconds = float(options.get("step_seconds", 0.01))
        self.steps = int(options.get("steps", 60))
        self.lift = int(options.get("lift", self.steps // 2))
        self.count = int(options.get("gaussians", 300))
        self.frames = int(options.get("frames", 4))
        self.fault, self.at = options.get("fault", ""), int(options.get("at", 5))
        self.clock, self.reference = FakeClock(), self.frames // 2
        self.stopped, self.done = False, 0
        self.still: Cloud | None = None
        self.checkpoint_path = host.folder / "checkpoint.json"
        if host.request.resume:
            self.done = json.loads(self.checkpoint_path.read_text())["step"]
        if options.get("endless"):
            self.steps = self.done + self.steps if host.request.resume else 10**9

    @property
    def steps_done(self) -> int:
        return self.done

    def setting(self) -> Setting:
        lens = np.array([[100.0, 0, 64], [0, 100.0, 48], [0, 0, 1]])
        cameras = Cameras(np.tile(lens, (self.frames, 1, 1)), np.tile(np.eye(4), (self.frames, 1, 1)), (128, 96))
        objects = (SnapshotObject(1, "one", (1.0, 0, 0)), SnapshotObject(0, "background", (0.5, 0.5, 0.5), True))
        return Setting(self.frames, objects, cameras, np.array([0.0, -1, 0]), np.array([0.0, 0, 4]))

    def live(self, t: int) -> Cloud:
        n = self.count
        if self.still is None:
            owner = np.where(np.arange(n) < n // 2, 1, 0).astype(np.uint16)
            means = (np.random.default_rng(0).normal(size=(n, 3)) + [0, 0, 4]).astype(np.float32)
            self.still = Cloud(means, np.tile(np.float32([1, 0, 0, 0]), (n, 1)), np.full((n, 3), 0.05, np.float32),
                               np.full(n, 0.8, np.float32), np.full((n, 3), 0.5, np.float32), owner,
                               np.arange(n, dtype=np.uint64))  # fmt: skip
        means = self.still.means.copy()
        means[: n // 2, 0] += np.float32(0.1 * t)
        means[:, 1] += np.float32(0.001 * self.done)
        return replace(self.still, means=means)

    def stop(self) -> None:
        self.stopped = True

    def change(self, name: str, value: float) -> events.ParameterChanged:
        return events.ParameterChanged(0.0, 0.0, self.done, name, 0.0, parameters.checked(name, value))

    def checkpoint(self) -> events.Checkpointed | None:
        write_bytes(self.checkpoint_path, json.dumps({"step": self.done}).encode())
        return events.Checkpointed(0.0, 0.0, self.done, str(self.checkpoint_path))

    def write_scene(self, path: str, told: Callable[[str], None]) -> None:
        write_bytes(path, b"scene so far")
        told("")

    def __iter__(self) -> Iterator[events.Event]:
        yield events.Preview(0.0, 0.0, "first scene", 0, self.reference, 20.0)
        for stage, first, end in (("lift", 0, self.lift), ("joint", self.lift, self.steps)):
            yield events.StageStarted(0.0, 0.0, stage, end - first)
            while first <= self.done < end and not self.stopped:
                self._spoil()
                time.sleep(self.step_seconds)
                self.done += 1
                yield events.Step(0.0, 0.0, stage, self.done - first, end - first, 1.0 / self.done, {"rgb": 1.0},
                                  self.count, 20.0, self.done / self.steps, 0.0)  # fmt: skip
                if self.done % 10 == 0:
                    yield self.checkpoint()
        yield events.Finished(0.0, 0.0, self.done, "interrupted" if self.stopped else "done")

    def _spoil(self) -> None:
        if self.done != self.at or self.host.request.resume:
            return
        if self.fault == "exception":
            raise ZeroDivisionError("as asked for")
        if self.fault == "input":
            raise GenmojoError("value", "the clip is odd", "clip", "take another")
        if self.fault == "memory":
            raise MemoryError
        if self.fault == "allocate":
            fill_memory()
        if self.fault == "segfault":
            ctypes.string_at(0)
        if self.fault == "exit":
            os._exit(3)
        if self.fault == "hang":
            os.kill(os.getpid(), signal.SIGSTOP)
        if self.fault == "compile":
            self.host.announce("compiling", "compiling", 60.0)
            ctypes.PyDLL(None).sleep(7)  # holds the interpreter, as a compiler does
            self.host.announce("loaded", "", 0.0)


def fill_memory() -> None:
    """Allocate until the system refuses: it is told to give this process 40 MB more and nothing beyond."""
    import resource

    pages = int(Path("/proc/self/statm").read_text().split()[0])
    most = pages * resource.getpagesize() + (40 << 20)
    resource.setrlimit(resource.RLIMIT_AS, (most, most))
    held = []
    while True:
        held.append(np.ones(2 << 20))


def wait_for_a_window(host: worker.Host) -> None:
    """Until one has said hello; a minute at most."""
    until = time.monotonic() + 60
    while host.link is not None and not any(window.known for window in list(host.link._windows)):
        if time.monotonic() > until:
            return
        time.sleep(0.005)


class FakeJob:
    def run(self, host: worker.Host) -> None:
        host.session.enter("ready")
        wait_for_a_window(host)
        run = FakeRun(host)
        worker.drive(host, run)
        if host.session.keep:
            host.session.enter("finishing")
            write_bytes(host.folder / "scene.h5", b"scene")
            host.tell({"type": "event", "event": {"event": "SceneWritten", "path": str(host.folder / "scene.h5")}})


if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
    sys.exit(worker.main(job=FakeJob()))
