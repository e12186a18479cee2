"""CoTracker 2 and 3 from the user's own checkout and checkpoint, in a process of its own.

Its code and weights are CC BY-NC 4.0 and not part of this program: the user brings them. Long clips go in windows that
overlap, so memory stays bounded; a window begins where the last one left the points. Pixels are converted here:
CoTracker counts from the centre of the first pixel, axes are (time, point), queries are (t, x, y).
"""

from __future__ import annotations

import math
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from genmojo_core.clip.clip import Clip
from genmojo_core.errors import GenmojoError
from genmojo_core.store.cotracker_npz import CENTRE, tracks_from_cotracker
from genmojo_core.store.npz import read_arrays
from genmojo_core.tracks.model import NONE, PointTracks

if TYPE_CHECKING:
    from genmojo_core.trackers.seeding import Cancelled, Progress, Queries

LICENCE = (
    "CoTracker (code and weights) is licensed CC BY-NC 4.0 by Meta: not for commercial use. It is not part of this "
    "program; you point to a copy of your own."
)
HUB = "hub:"  # instead of a checkout: "hub:cotracker3_offline", downloaded by torch.hub; only with the user's consent
HUB_MODELS = (  # entry points of its hubconf.py: version 3; version 2 with windows of 8 and of 16 frames (v1)
    "cotracker3_offline", "cotracker3_online", "cotracker2", "cotracker2_online", "cotracker2v1", "cotracker2v1_online",
)  # fmt: skip
_PROCESS = "genmojo_core.trackers.cotracker_process"
_FILES = ("asked.npz", "answer.npz", "words.txt", "shares.txt")
_OVERLAP = 8  # frames two windows share
_START_SECONDS, _FRAME_SECONDS = 8.0, 1.0  # of a window on a CPU: torch and the weights; a frame, both ways
WINDOWS = (2 * _OVERLAP, 512)  # least and most frames of a window


def machine_gib() -> float:
    """GiB of memory of this machine; 24 where the system does not tell."""
    try:
        return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2**30
    except (AttributeError, ValueError, OSError):
        return 24.0


@dataclass(frozen=True)
class Limits:
    """frames per window; GiB of address space of the child (Linux, on the processor; 0: none), by default 0.8 of the
    machine's; seconds until it is stopped. Raises GenmojoError("value") for windows outside WINDOWS."""

    window: int = 64
    memory_gib: float = field(default_factory=lambda: 0.8 * machine_gib())
    seconds: float = 3600.0

    def __post_init__(self) -> None:
        if not WINDOWS[0] <= self.window <= WINDOWS[1] or not 0 <= self.memory_gib < math.inf:
            raise GenmojoError("value", f"a window of {self.window} frames and {self.memory_gib:g} GiB are no limits",
                               "cotracker", f"give {WINDOWS[0]} to {WINDOWS[1]} frames and GiB from 0")  # fmt: skip


class CoTrackerSeeder:
    """Follows points with CoTracker.

    Args:
        checkout: folder that holds the package `cotracker`; or "hub:<model>", one of HUB_MODELS, after `consent`.
        checkpoint: its weights (.pth), None with the hub. limits: of the child.
        consent: the user agreed that torch.hub downloads and runs code.
    """

    name, licence = "cotracker", LICENCE

    def __init__(
        self, checkout: Path, checkpoint: Path | None, limits: Limits | None = None, consent: bool = False
    ) -> None:
        self._hub = str(checkout)[len(HUB) :] if str(checkout).startswith(HUB) else ""
        self._checkout, self._checkpoint, self._limits = checkout, checkpoint, limits or Limits()
        if self._hub:
            if self._hub not in HUB_MODELS:
                raise GenmojoError("argument", f"there is no model '{self._hub}'", "cotracker",
                                   f"use one of {', '.join(HUB_MODELS)}")  # fmt: skip
            if not consent:
                raise GenmojoError("argument", "would download and run code by torch.hub", "cotracker",
                                   "agree first, or give a local checkout")  # fmt: skip
        elif not (checkout / "cotracker" / "predictor.py").is_file():
            raise GenmojoError("missing_package", "holds no cotracker/predictor.py", str(checkout),
                               "give a checkout of CoTracker")  # fmt: skip
        elif checkpoint is None or not checkpoint.is_file():
            raise GenmojoError("missing_package", "is no checkpoint", str(checkpoint or "cotracker"),
                               "give CoTracker's weights (.pth)")  # fmt: skip

    def forecast(self, clip: Clip, queries: Queries) -> float:
        """A guess for a CPU: of every window start and frames."""
        return window_seconds(len(clip), self._limits.window, queries.t)

    def seed(
        self, clip: Clip, queries: Queries, progress: Progress | None = None, cancelled: Cancelled | None = None
    ) -> PointTracks:
        """Tracks of the queries. Where memory runs out, windows of half the frames are tried, down to the least.

        Raises GenmojoError("missing_package") with the child's last words if it fails, "budget" if memory ran out.
        """
        size = np.array(clip.source_size, np.float64)
        scale = np.array(clip.size, np.float64) / size
        held = np.concatenate([queries.t[:, None], queries.xy * scale - CENTRE], axis=1)

        window = min(self._limits.window, max(len(clip), WINDOWS[0]))
        while True:
            turns = _Turns(len(_jobs(len(clip), window, held[:, 0])[1]), progress)

            def run(frames: np.ndarray, asked: np.ndarray, turns: _Turns = turns) -> tuple[np.ndarray, np.ndarray]:
                found = self._child(frames, asked, turns.tell, cancelled)
                turns.done += 1
                return found

            try:
                xy, seen = in_windows(clip.frames, held, window, run, progress)
                break
            except GenmojoError as error:
                if error.code != "budget" or window <= WINDOWS[0]:
                    raise
                window = max(window // 2, WINDOWS[0])
        tracks = tracks_from_cotracker(xy, seen, clip.size).resized(*clip.source_size)
        conf = np.where(tracks.state == NONE, 0.0, np.where(tracks.visible, 0.8, 0.4)).astype(np.float32)
        return PointTracks(tracks.xy, tracks.state, queries.object, clip.source_size, conf=conf)

    def _child(
        self, frames: np.ndarray, queries: np.ndarray, tell: Callable[[float], None], cancelled: Cancelled | None
    ) -> tuple[np.ndarray, np.ndarray]:
        """One window in a process of its own: (T, N, 2) and (T, N)."""
        with tempfile.TemporaryDirectory(prefix="genmojo-cotracker-") as folder:
            asked, answer, words, shares = (Path(folder) / name for name in _FILES)
            shares.touch()
            with open(asked, "wb") as file:  # as it is: to compress it takes seconds in which nobody could cancel
                np.savez(file, video=frames, queries=queries.astype(np.float32))
            command = [sys.executable, "-m", _PROCESS, str(asked), str(answer), str(self._checkout.absolute()),
                       str(self._checkpoint.absolute()) if self._checkpoint else "", self._hub,
                       str(self._limits.memory_gib), str(shares)]  # fmt: skip
            environment = os.environ | {"TORCH_FORCE_WEIGHTS_ONLY_LOAD": "1"}
            with (
                open(words, "wb") as said,
                subprocess.Popen(command, stdout=said, stderr=said, env=environment) as child,
            ):
                self._watch(child, lambda: tell(_last_share(shares)), cancelled)
            if child.returncode != 0 or not answer.is_file():
                said_last = words.read_text(errors="replace").strip()
                if _is_out_of_memory(child.returncode, said_last):
                    raise GenmojoError("budget", "CoTracker ran out of memory, or the system ended it",
                                       str(self._checkout),
                                       "close other programs, allow more memory, or use a smaller clip")  # fmt: skip
                last = said_last.splitlines()[-1:] or [f"exit {child.returncode}"]
                raise GenmojoError("missing_package", f"CoTracker stopped: {last[0][:300]}", str(self._checkout),
                                   "check checkout, checkpoint and memory")  # fmt: skip
            arrays = read_arrays(answer)
        shape = (len(frames), len(queries))
        if arrays["tracks"].shape != (*shape, 2) or arrays["visibility"].shape != shape:
            raise GenmojoError("schema", f"gave tracks {arrays['tracks'].shape} for {shape}", str(self._checkout))
        return arrays["tracks"], arrays["visibility"].astype(bool)

    def _watch(self, child: subprocess.Popen[bytes], tell: Callable[[], None], cancelled: Cancelled | None) -> None:
        """Wait; stop it when time is up or the user says so."""
        until = time.monotonic() + self._limits.seconds
        while child.poll() is None:
            if (cancelled is not None and cancelled()) or time.monotonic() > until:
                child.kill()
                raise GenmojoError("argument", "was stopped before it was done", "cotracker")
            tell()
            time.sleep(0.05)


@dataclass
class _Turns:
    """How many windows there are to do and are done; tells the share of the whole when it is more than before."""

    count: int
    progress: Progress | None
    done: int = 0
    told: float = 0.0

    def tell(self, share: float) -> None:
        """The share of the window that runs."""
        whole = (self.done + share) / max(self.count, 1)
        if self.progress is not None and whole > self.told:
            self.told = whole
            self.progress(whole)


def _last_share(path: Path) -> float:
    """The share that the child told last, 0 if it told none; the end of what it is writing counts when it is whole."""
    lines = path.read_text(encoding="ascii").split("\n")[:-1]
    return float(lines[-1]) if lines else 0.0


def _is_out_of_memory(code: int, words: str) -> bool:
    """Whether a child ended for want of memory: killed by the system, or by its last words."""
    last = words[-2000:].lower()
    return code in (-9, 137) or any(sign in last for sign in ("memoryerror", "out of memory", "can't allocate memory"))


def in_windows(
    frames: np.ndarray,  # (T, H, W, 3) uint8
    queries: np.ndarray,  # (N, 3) t, x, y in centre px
    window: int,
    run: Callable[[np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray]],
    progress: Progress | None = None,
) -> tuple[np.ndarray, np.ndarray]:  # (T, N, 2), (T, N) bool
    """Run a tracker over windows of at most `window` frames.

    Each query begins in the last window that holds its frame. From there a sweep forwards and one backwards, in which
    windows overlap by 8 frames or more, go on from its last seen place in the shared frames; a window is run with the
    queries that have reached it. `run` gets the window's frames and queries with times counted in the window.
    """
    total = len(frames)
    starts, jobs, home = _jobs(total, window, queries[:, 0])
    xy = np.full((total, len(queries), 2), np.nan, np.float32)
    seen = np.zeros((total, len(queries)), bool)
    known = np.zeros((total, len(queries)), bool)
    for turn, (k, rows) in enumerate(jobs):
        first, end = starts[k], min(starts[k] + window, total)
        asked = np.array([_entry(queries[n], home[n] == k, first, end, (xy[:, n], seen[:, n], known[:, n]))
                          for n in rows])  # fmt: skip
        places, visible = run(frames[first:end], asked)
        for column, n in enumerate(rows):
            new = ~known[first:end, n]
            xy[first:end, n][new], seen[first:end, n][new] = places[new, column], visible[new, column]
            known[first:end, n] = True
        if progress is not None:
            progress((turn + 1) / len(jobs))
    return xy, seen


def window_seconds(frames: int, window: int, times: np.ndarray) -> float:
    """A guess of what queries in frames times (N,) take in windows of at most `window` frames."""
    window = min(window, max(frames, WINDOWS[0]))
    starts, jobs, _ = _jobs(frames, window, times)
    return sum(_START_SECONDS + _FRAME_SECONDS * (min(starts[k] + window, frames) - starts[k]) for k, _ in jobs)


def _jobs(total: int, window: int, times: np.ndarray) -> tuple[list[int], list[tuple[int, np.ndarray]], np.ndarray]:
    """First frames of the windows; which window is run in turn with which queries (rows); the window each begins in."""
    step = max(window - _OVERLAP, 1)
    starts = [0] if total <= window else [*range(0, total - window, step), total - window]
    home = np.array([max(k for k, s in enumerate(starts) if s <= t < s + window) for t in times.astype(int)], int)
    jobs = [(k, np.flatnonzero(home <= k)) for k in range(len(starts))]
    jobs += [(k, np.flatnonzero(home > k)) for k in reversed(range(len(starts)))]
    return starts, [(k, rows) for k, rows in jobs if len(rows)], home


def _entry(
    query: np.ndarray, own: bool, first: int, end: int, so_far: tuple[np.ndarray, np.ndarray, np.ndarray]
) -> np.ndarray:  # (3,) t in the window, x, y
    """Where a point enters a window: its query, or of the frames shared with the window that it comes from the seen one
    deepest in this window, else the deepest."""
    if own:
        return np.array([query[0] - first, query[1], query[2]])
    xy, seen, known = so_far
    shared = np.flatnonzero(known[first:end])
    good = shared[seen[first:end][shared]]
    entry = int((good if len(good) else shared)[-1 if shared[0] == 0 else 0])
    return np.array([entry, *xy[first + entry]])
