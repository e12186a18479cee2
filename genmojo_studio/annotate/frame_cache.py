"""Decoded frames around the one on show: a ring filled by threads, first the frame wanted, then what comes next.

There is one target at a time. Threads always work on the most wanted frame that is missing, so requests that nobody
waits for any more are never started; each target has a generation number that tells late answers apart.
"""

from __future__ import annotations

import threading
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from PySide6.QtCore import QObject, Signal, SignalInstance

from genmojo_core.clip.frames import FolderFrames, FrameSource, MaskFrames, open_source
from genmojo_core.errors import GenmojoError
from genmojo_studio.annotate.frame_buffers import FrameBuffers
from genmojo_studio.translate import fault

DEFAULT_BYTES = 640 << 20
_BEHIND = 4  # of every frames held, one is kept behind the target
_THREADS = 2
_PATIENCE = 5.0  # seconds that closing waits for a file being read
_STUCK: list[FrameCache] = []
_BEYOND = 2 * _THREADS + 2  # frames that are decoded, on show or on their way out besides those held


class FrameCache(QObject):
    """Frames and masks of one clip by number; signals arrive on the thread that made it."""

    arrived = Signal(int, int)  # frame, generation: the frame wanted is there
    filled = Signal(int)  # a frame entered the ring
    failed = Signal(int, str)  # frame, sentence

    def __init__(self, path: str | Path, most_bytes: int = DEFAULT_BYTES, parent: QObject | None = None) -> None:
        super().__init__(parent)
        source = open_source(path)
        self.count, self.size, self.seconds = source.count, source.size, source.seconds
        self.has_masks = bool(MaskFrames(path))
        self.capacity = max(8, min(self.count, most_bytes // (self.size[0] * self.size[1] * 4)))
        self._path = path
        self._buffers = FrameBuffers((self.size[1], self.size[0], 4), self.capacity + _BEYOND)
        self._frames: dict[int, np.ndarray] = {}
        self._masks: dict[int, np.ndarray | None] = {}
        self._bad: dict[int, str] = {}
        self._busy: set[int] = set()
        self._target, self._direction, self.generation = 0, 1, 0
        self._pinned: tuple[int, ...] = ()
        self._changed = threading.Condition()
        self._open = True
        sources = [source]
        if isinstance(source, FolderFrames):  # files of their own need no seeking: every thread reads its own
            sources += [open_source(path) for _ in range(_THREADS - 1)]
        self._threads = [threading.Thread(target=self._work, args=(s,), daemon=True, name="frames") for s in sources]
        for thread in self._threads:
            thread.start()

    def get(self, frame: int) -> np.ndarray | None:
        """(H, W, 4) uint8 BGRA if decoded already. Do not write into it."""
        return self._frames.get(frame)

    def mask(self, frame: int) -> np.ndarray | None:
        """(H, W) uint8 object ids, None if not decoded yet or without a mask."""
        return self._masks.get(frame)

    def want(self, frame: int) -> int:
        """Make a frame the target and return its generation; `arrived` follows unless `get` has it already."""
        with self._changed:
            if frame != self._target:
                self._direction = 1 if frame > self._target else -1
            self._target = frame
            self.generation += 1
            self._changed.notify_all()
        if frame in self._bad:  # whoever asks is told, however often
            self._say(self.failed, frame, self._bad[frame])
        return self.generation

    def pin(self, frames: list[int]) -> None:
        """Frames that are wanted besides the target (loupe, strip) and stay while they are pinned."""
        with self._changed:
            inside = dict.fromkeys(f for f in frames if 0 <= f < self.count)
            self._pinned = tuple(inside)[: max(self.capacity // 2, 1)]
            self._changed.notify_all()

    def read(self, frame: int, seconds: float = 5.0) -> np.ndarray | None:
        """The frame, waited for; None after `seconds` or if it cannot be read. For pieces that cannot go on without."""
        if self.get(frame) is None:
            self.want(frame)
            with self._changed:
                self._changed.wait_for(lambda: frame in self._frames or frame in self._bad, seconds)
        return self.get(frame)

    def held(self) -> list[int]:
        """Frames in the ring, rising."""
        return sorted(self._frames)

    def forget(self) -> None:
        """Let go of every frame, as after a change of the files."""
        with self._changed:
            self._frames.clear()
            self._masks.clear()
            self._bad.clear()
            self._changed.notify_all()

    def close(self) -> None:
        """End the threads and let go of all memory; idempotent."""
        with self._changed:
            self._open = False
            self._changed.notify_all()
        for thread in self._threads:
            thread.join(_PATIENCE)
        if any(thread.is_alive() for thread in self._threads):
            _STUCK.append(
                self
            )  # a disk that does not answer: the thread must not be the last to hold this (background.py)
        self._frames.clear()
        self._masks.clear()
        self._buffers.clear()

    def _work(self, source: FrameSource) -> None:
        """A thread: decode what is wanted most until the cache closes."""
        masks = MaskFrames(self._path)
        while True:
            with self._changed:
                frame = self._next()
                while self._open and frame is None:
                    self._changed.wait()
                    frame = self._next()
                if not self._open or frame is None:
                    break
                self._busy.add(frame)
            try:
                picture = source.read(frame, self._keep, self._buffers.take())
                labels = masks.read(frame) if masks else None
            except GenmojoError as error:
                self._fault(frame, fault(error))
                continue
            self._store(frame, picture, labels)
            del picture
        source.close()

    def _keep(self, frame: int, picture: np.ndarray) -> None:
        """Hold a frame that was decoded on the way, if it is near enough to be wanted."""
        with self._changed:
            if not self._open or frame in self._frames or abs(frame - self._target) > self.capacity:
                return
            self._frames[frame] = picture
            self._evict()
        self._say(self.filled, frame)

    def _store(self, frame: int, picture: np.ndarray, labels: np.ndarray | None) -> None:
        with self._changed:
            self._busy.discard(frame)
            if not self._open:
                return
            self._frames[frame] = picture
            self._masks.setdefault(frame, labels)
            self._evict()
            is_target, generation = frame == self._target, self.generation
            self._changed.notify_all()
        self._say(self.filled, frame)
        if is_target:
            self._say(self.arrived, frame, generation)

    def _fault(self, frame: int, sentence: str) -> None:
        with self._changed:
            self._busy.discard(frame)
            self._bad[frame] = sentence
            self._changed.notify_all()
        self._say(self.failed, frame, sentence)

    def _say(self, signal: SignalInstance, *values: object) -> None:
        """Emit, unless the window is gone."""
        if self._open:
            signal.emit(*values)

    def _next(self) -> int | None:
        """The most wanted frame that is neither there nor being decoded."""
        return next((f for f in self._wanted() if f not in self._frames and f not in self._busy), None)

    def _wanted(self) -> Iterator[int]:
        """Target first, then the frames it moves towards, with one behind for every few ahead; those held at most."""
        given = len(self._pinned)
        if self._target not in self._bad:
            yield self._target
        yield from (f for f in self._pinned if f not in self._bad)
        for k in range(1, self.capacity):
            places = [self._target + self._direction * k]
            if k % _BEHIND == 0:
                places.append(self._target - self._direction * (k // _BEHIND))
            for place in places:
                if 0 <= place < self.count and place not in self._bad:
                    given += 1
                    if given >= self.capacity:
                        return
                    yield place

    def _evict(self) -> None:
        """Drop the frames farthest from the target, those behind it first."""
        while len(self._frames) > self.capacity:
            worst = max((f for f in self._frames if f not in self._pinned), key=self._distance)
            del self._frames[worst]
            self._masks.pop(worst, None)

    def _distance(self, frame: int) -> float:
        ahead = (frame - self._target) * self._direction
        return ahead if ahead >= 0 else -_BEHIND * ahead
