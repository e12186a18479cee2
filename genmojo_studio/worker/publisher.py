"""The worker's side of the previews: when a frame is sent, and the slow sweep over all frames.

The sweep is made a few frames at a time between steps, never taking more than SWEEP_SHARE of the run's time, except
when it was asked for: then it is finished at once.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path
from typing import Any, Protocol

import numpy as np

from genmojo_studio.worker.governor import SWEEP_SHARE, Governor
from genmojo_studio.worker.preview_bus import BusWriter, size_of
from genmojo_studio.worker.preview_codec import Arrays, FrameArrays, Setting, pack_layers, pack_now

_ROOM = 1.5  # a bus is made so much larger than its first preview


class Viewed(Protocol):
    """What can be shown: a run."""

    def live(self, t: int) -> FrameArrays:
        """The Gaussians of frame t."""
        ...

    def setting(self) -> Setting:
        """What stays the same."""
        ...


class Publisher:
    """Writes the streams "now" and "layers".

    Args:
        folder: where the bus files are made. tell: sends a message to the windows. governor: says when.
    """

    def __init__(self, folder: Path, tell: Callable[[dict[str, Any]], None], governor: Governor) -> None:
        self.folder, self.tell, self.governor = folder, tell, governor
        self.frame: int | None = None  # the one the window shows
        self._buses: dict[str, BusWriter] = {}
        self._made = 0
        self._swept: list[FrameArrays] = []
        self._owed = 0.0  # seconds the sweep may take, saved up step by step
        for left in folder.glob("*.bus"):  # of a worker that was killed here
            left.unlink(missing_ok=True)

    def files(self) -> dict[str, str]:
        """Path of the bus of every stream; from any thread."""
        return {stream: str(bus.path) for stream, bus in list(self._buses.items())}

    def show(self, now: FrameArrays, t: int, where: tuple[str, int], setting: Setting) -> None:
        """Send one frame. `where`: stage and step."""
        self._send("now", *pack_now(now, t, *where, setting))

    def show_run(self, run: Viewed, reference: int, where: tuple[str, int]) -> None:
        """Send the frame the window shows (until it asked for one, the canonical one)."""
        setting = run.setting()
        begun, made = time.perf_counter(), self._made
        t = reference if self.frame is None else min(max(self.frame, 0), setting.frames - 1)
        self._send("now", *pack_now(run.live(t), t, *where, setting))
        if made == self._made:  # making a bus takes long and happens once
            self.governor.published(time.monotonic(), time.perf_counter() - begun)

    def sweep_some(self, run: Viewed, step: int, step_seconds: float) -> None:
        """After a step: go on with the sweep for as long as it may take."""
        if self.governor.cadence == "off" or self.governor.probing:
            return
        self._owed = min(self._owed + SWEEP_SHARE * step_seconds, 0.25)
        begun = time.perf_counter()
        frames = run.setting().frames
        while self._owed > time.perf_counter() - begun and not self._sweep_frame(run, step, frames):
            pass
        took = time.perf_counter() - begun
        self._owed -= took
        self.governor.spent(time.monotonic(), took)

    def sweep_all(self, run: Viewed, step: int) -> None:
        """All frames at once, as they stand."""
        self._swept = []
        frames = run.setting().frames
        while not self._sweep_frame(run, step, frames):
            pass

    def close(self) -> None:
        """No more previews."""
        for bus in self._buses.values():
            bus.close()

    def _sweep_frame(self, run: Viewed, step: int, frames: int) -> bool:
        """One more frame; True when the sweep is done and sent. Begins anew where Gaussians were added or removed."""
        found = run.live(len(self._swept))
        if self._swept and not np.array_equal(self._swept[0].uid, found.uid):
            self._swept = []
            return False
        self._swept.append(found)
        if len(self._swept) < frames:
            return False
        self._send("layers", *pack_layers(self._swept, step))
        self._swept = []
        return True

    def _send(self, stream: str, meta: dict[str, Any], arrays: Arrays) -> None:
        """Put it on the stream's bus; a larger bus is made when it does not fit any more."""
        bus = self._buses.get(stream)
        if bus is None or not bus.fits(meta, arrays):
            if bus is not None:
                bus.close()
            self._made += 1
            path = self.folder / f"{stream}-{self._made}.bus"
            old = None if bus is None else bus.path
            bus = self._buses[stream] = BusWriter(path, int(_ROOM * size_of(meta, arrays)) + 4096)
            self.tell({"type": "bus", "streams": self.files()})
            if old is not None:
                old.unlink(missing_ok=True)
        self.tell({"type": "preview", "stream": stream, "sequence": bus.publish(meta, arrays)})
