"""Frame steps of the annotator at 1080p: from the key to a painted frame, cached and not, and with many tracks.

    python tests/benchmarks/frame_step.py            # prints milliseconds; needs a display (xvfb-run will do)

Goals of issue 5: p95 at most 16 ms cached and 33 ms uncached with 25 tracks; with 5,000 tracks x 10,000 frames at
most 10 % more. Wall time is what a person waits for; CPU time of the process is steadier on a shared machine.
Not covered: videos (their seeks are timed in tests/clip), a graphics driver's own latency.
"""

from __future__ import annotations

import os
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import cv2
import numpy as np
from PySide6.QtCore import QEventLoop
from PySide6.QtWidgets import QApplication

from genmojo_core.store.project import Project, info_of
from genmojo_core.tracks.annotation import Annotation, ObjectInfo, TrackInfo
from genmojo_studio import theme
from genmojo_studio.actions import ActionTable
from genmojo_studio.annotate.actions import ACTIONS
from genmojo_studio.annotate.frame_cache import FrameCache
from genmojo_studio.annotate.session import Session
from genmojo_studio.annotate.workspace import AnnotateWorkspace
from genmojo_studio.state import AppState

W, H, CLIP = 1920, 1080, 48


def write_clip(folder: Path, frames: int = CLIP) -> Path:
    """A 1080p clip of JPEG files with texture everywhere."""
    random = np.random.default_rng(0)
    small = random.integers(0, 255, (H // 8, W // 8, 3), np.uint8)
    picture = cv2.resize(small, (W, H), interpolation=cv2.INTER_CUBIC)
    (folder / "JPEGImages" / "clip").mkdir(parents=True)
    for t in range(frames):
        cv2.imwrite(str(folder / "JPEGImages" / "clip" / f"{t:05d}.jpg"), np.roll(picture, 6 * t, axis=1),
                    [cv2.IMWRITE_JPEG_QUALITY, 92])  # fmt: skip
    return folder


def fill(annotation: Annotation, tracks: int) -> None:
    """Five objects and many tracks that move and hide now and then."""
    random = np.random.default_rng(1)
    annotation.reserve(tracks)
    for k in range(1, 6):
        annotation.put_object(k, ObjectInfo(k, f"object {k}", k, "chosen"))
    for n in range(tracks):
        annotation.put_track(n + 1, TrackInfo(n + 1, n % 5 + 1, n // 5 + 1))
    start = random.uniform((100, 100), (W - 100, H - 100), (tracks, 2))
    which = np.arange(tracks)
    cells = annotation._cells  # frame by frame, as it lies in memory: thousands of tracks one by one take minutes
    for t in range(annotation.frames):
        cells.xy[t, :tracks] = start + 60 * np.stack([np.cos(t / 9 + which), np.sin(t / 7 + 0 * which)], 1)
        cells.state[t, :tracks] = 1 + (t // 8 + which) % 5 // 4
        cells.flags[t, :tracks] = 5 if t % 16 == 0 else 0
    cells.conf[:] = 0.8
    annotation.revision += 1


def make(folder: Path, clip: Path, tracks: int, frames: int) -> AnnotateWorkspace:
    """A window of 1920 x 1080 with a session in the step Refine."""
    state = AppState()
    cache = FrameCache(clip)
    if frames > cache.count:  # a long clip without a long clip's files: later numbers show the files again
        files = cache.count
        cache.close()
        cache = Repeated(clip, frames, files)
    project = Project.create(folder / f"{tracks}-{frames}.genmojo", info_of(cache.count, cache.size, "clip", str(clip)))
    fill(project.annotation, tracks)
    state.set(frame_count=cache.count)
    workspace = AnnotateWorkspace(state, ActionTable(ACTIONS))
    workspace.resize(W, H)
    workspace.show()
    workspace.open_with(Session(state, cache, project))
    workspace.work.close()  # nothing in the background while time is taken
    workspace.show_step(2)
    settle()
    return workspace


class Repeated(FrameCache):
    """A cache of a long clip whose pictures are those of a short one."""

    def __init__(self, clip: Path, frames: int, files: int) -> None:
        self._files = files
        super().__init__(clip)
        self.count = frames
        self.seconds = np.arange(frames) / 24.0

    def _wanted(self) -> Iterator[int]:
        return (frame for frame in super()._wanted() if frame < self._files)

    def get(self, frame: int) -> np.ndarray | None:
        return super().get(frame % self._files)

    def want(self, frame: int) -> int:
        return super().want(frame % self._files)


def settle(seconds: float = 0.4) -> None:
    """Let pending events through."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        QApplication.processEvents()


def step(workspace: AnnotateWorkspace, frame: int) -> tuple[float, float]:
    """Milliseconds of wall and of the process's CPU until a frame is painted with its overlay."""
    wall, cpu = time.perf_counter(), time.process_time()
    workspace.session.go(frame)
    while workspace.screen_link.painted != frame:
        QApplication.processEvents(QEventLoop.ProcessEventsFlag.WaitForMoreEvents)
    workspace.canvas.repaint()
    QApplication.processEvents()
    return 1e3 * (time.perf_counter() - wall), 1e3 * (time.process_time() - cpu)


def cached(workspace: AnnotateWorkspace, frames: list[int]) -> np.ndarray:
    """(n, 2) milliseconds of steps over frames that are decoded already."""
    for frame in dict.fromkeys(frames):
        workspace.session.cache.read(frame % CLIP)
    settle()
    return np.array([step(workspace, f) for f in frames])


def uncached(workspace: AnnotateWorkspace, frames: list[int]) -> np.ndarray:
    """(n, 2) milliseconds of steps whose frame must be decoded first."""
    times, room = [], workspace.session.cache.capacity
    workspace.session.cache.capacity = 1  # no frames ahead: only the wanted frame is timed
    for frame in frames:
        workspace.session.cache.forget()
        times.append(step(workspace, frame))
    workspace.session.cache.capacity = room
    return np.array(times)


def in_turns(windows: list[tuple[AnnotateWorkspace, int]], laps: int) -> list[np.ndarray]:
    """(n, 2) milliseconds of cached steps per window and its first frame, lap by lap in turns; closes the windows."""
    found: list[list[np.ndarray]] = [[] for _ in windows]
    for lap in range(laps):
        for times, (workspace, first) in zip(found, windows, strict=True):
            for other, _ in windows:
                other.setVisible(other is workspace)
            taken = cached(workspace, list(range(first, first + CLIP, 2)))
            times += [taken] if lap else []  # the first lap warms up
    for workspace, _ in windows:
        workspace.close()
    return [np.concatenate(times) for times in found]


def report(title: str, times: np.ndarray) -> float:
    """One line; returns the p95 of the CPU time."""
    wall, cpu = np.percentile(times, 95, axis=0)
    middle = np.median(times, axis=0)
    sys.stdout.write(f"{title:34s} wall p50 {middle[0]:6.1f} p95 {wall:6.1f} ms   "
                     f"cpu p50 {middle[1]:6.1f} p95 {cpu:6.1f} ms\n")  # fmt: skip
    sys.stdout.flush()
    return float(cpu)


def main() -> None:
    """Print the figures."""
    application = QApplication.instance() or QApplication([])
    theme.apply(application, "dark")
    os.environ.setdefault("XDG_CONFIG_HOME", tempfile.mkdtemp())
    with tempfile.TemporaryDirectory() as name:
        clip = write_clip(Path(name) / "clip")
        workspace = make(Path(name), clip, 25, CLIP)
        there_and_back = [*range(CLIP), *reversed(range(CLIP))]
        report("25 tracks, cached", cached(workspace, there_and_back * 2))
        report("25 tracks, uncached", uncached(workspace, there_and_back))
        few, many = in_turns([(workspace, 0), (make(Path(name), clip, 5000, 10_000), 5000)], laps=6)
        report("25 tracks x 48 frames", few)
        report("5,000 tracks x 10,000 frames", many)
        sys.stdout.write(f"ratio of medians (CPU): {np.median(many[:, 1]) / np.median(few[:, 1]):.2f}\n")


if __name__ == "__main__":
    main()
