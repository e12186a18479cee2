"""Run folders and who works in them: where runs lie, which are alive, how to reach a live one.

A worker holds an operating-system lock on `lock.json` in its run folder as long as it lives, however it ends; the file
says how to reach it. A copy under `<runs>/live` makes it findable for a window that knows nothing.
"""

from __future__ import annotations

import contextlib
import json
import os
import re
import secrets
import sys
import time
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import IO, Any

from genmojo_core.errors import GenmojoError
from genmojo_core.store.atomic import write_bytes

LOCK, REQUEST, EVENTS, EXIT, LOG, FAULT, SCENE = (
    "lock.json", "request.json", "events.jsonl", "exit.json", "worker.log", "fault.log", "scene.h5",
)  # fmt: skip
_LOCK_SECONDS = 1.0
_LOCKED_BYTE = 1 << 20  # beyond the text: on Windows a locked byte cannot be read


@dataclass(frozen=True)
class LiveRun:
    """A worker that can be reached.

    Args:
        run_dir: its folder. clip: what it works on. pid: its process. address: "unix:PATH" or "tcp:HOST:PORT".
        token: it wants to hear at hello. started: seconds since 1970.
    """

    run_dir: str
    clip: str
    pid: int
    address: str
    token: str
    started: float


def runs_folder() -> Path:
    """Where runs lie: $GENMOJO_RUNS, else the user's folder for an application's state."""
    given = os.environ.get("GENMOJO_RUNS")
    if given:
        return Path(given)
    if sys.platform == "win32":
        base = Path(os.environ.get("LOCALAPPDATA", Path.home() / "AppData" / "Local"))
    elif sys.platform == "darwin":
        base = Path.home() / "Library" / "Application Support"
    else:
        base = Path(os.environ.get("XDG_STATE_HOME", Path.home() / ".local" / "state"))
    return base / "genmojo" / "runs"


def new_run_dir(clip: str) -> Path:
    """A fresh folder for a run of a clip, named after it and the time. Raises GenmojoError("io")."""
    name = re.sub(r"[^\w-]+", "-", Path(clip).stem or "clip")[:40]
    folder = runs_folder() / f"{name}-{time.strftime('%Y%m%d-%H%M%S')}-{secrets.token_hex(2)}"
    try:
        folder.mkdir(parents=True, exist_ok=False)
    except OSError as error:
        raise GenmojoError("io", f"cannot be made ({(error.strerror or '').lower()})", str(folder),
                           "set GENMOJO_RUNS to a folder with room") from error  # fmt: skip
    return folder


class RunLock:
    """The worker's claim on its run folder, held until the process ends.

    Raises GenmojoError("io") on entry when another worker is at it.
    """

    def __init__(self, run: LiveRun) -> None:
        self.run = run
        self._stream: IO[bytes] | None = None

    def __enter__(self) -> RunLock:
        folder = Path(self.run.run_dir)
        folder.mkdir(parents=True, exist_ok=True)
        stream = open(folder / LOCK, "a+b")  # noqa: SIM115 - held for the life of the process
        deadline = time.monotonic() + _LOCK_SECONDS
        while not _try_lock(stream):
            if time.monotonic() < deadline:  # a window looking whether somebody is here holds it for a moment
                time.sleep(0.02)
                continue
            stream.close()
            raise GenmojoError("io", "another worker is optimising in this folder", self.run.run_dir,
                               "attach to it or choose another folder")  # fmt: skip
        stream.truncate(0)
        stream.write(json.dumps(asdict(self.run)).encode())
        stream.flush()
        os.chmod(folder / LOCK, 0o600)
        self._stream = stream
        self._pointer = runs_folder() / "live" / f"{self.run.pid}-{secrets.token_hex(4)}.json"
        write_bytes(self._pointer, json.dumps({"run_dir": str(folder.resolve())}).encode())
        return self

    def __exit__(self, *_: object) -> None:
        self._pointer.unlink(missing_ok=True)
        if self._stream is not None:
            self._stream.close()


def live_run(run_dir: str | Path) -> LiveRun | None:
    """The worker that is alive in a run folder, or None."""
    path = Path(run_dir) / LOCK
    try:
        with open(path, "r+b") as stream:
            if _try_lock(stream):
                return None
            stream.seek(0)
            return LiveRun(**json.loads(stream.read(_LOCKED_BYTE)))
    except (OSError, ValueError, TypeError):
        return None


def live_runs() -> list[LiveRun]:
    """All workers alive, oldest first; pointers of dead ones are removed."""
    found = {}
    for pointer in (runs_folder() / "live").glob("*.json"):
        try:
            run_dir = json.loads(pointer.read_bytes())["run_dir"]
        except (OSError, ValueError, KeyError, TypeError):
            continue
        run = live_run(run_dir)
        if run is None:
            pointer.unlink(missing_ok=True)
        else:
            found[run.run_dir] = run
    return sorted(found.values(), key=lambda run: run.started)


def newest_scenes(count: int) -> list[Path]:
    """Scene files of the last runs that ended with one, the newest first."""
    found = []
    for path in runs_folder().glob(f"*/{SCENE}"):
        with contextlib.suppress(OSError):  # taken away meanwhile
            found.append((path.stat().st_mtime, path))
    return [path for _, path in sorted(found, reverse=True)[:count]]


def read_json(path: Path) -> dict[str, Any]:
    """A JSON object of a run folder; empty where there is none."""
    try:
        data = json.loads(path.read_bytes())
    except (OSError, ValueError):
        return {}
    return data if isinstance(data, dict) else {}


def read_events(run_dir: str | Path, after: int = 0) -> list[dict[str, Any]]:
    """What a run has told so far, in order, but the first `after` events; a last line that is cut off is left out."""
    try:
        lines = (Path(run_dir) / EVENTS).read_bytes().splitlines(keepends=True)
    except OSError:
        return []
    events = []
    for line in lines[after:]:
        if not line.endswith(b"\n"):
            break
        try:
            events.append(json.loads(line))
        except ValueError:
            continue
    return [event for event in events if isinstance(event, dict)]


def steps_told(events: list[dict[str, Any]]) -> int:
    """How many steps a run had done at the end of its events; a resumed run tells some steps again."""
    done: dict[str, int] = {}  # per stage, in their order
    for event in events:
        if event.get("event") == "Step":
            stages = list(done)
            stage = str(event["stage"])
            for later in stages[stages.index(stage) + 1 :] if stage in done else ():
                del done[later]
            done[stage] = int(event["step"])
    return sum(done.values())


def open_events(run_dir: str | Path) -> IO[bytes]:
    """The event log, to add to; a last line that a killed worker left unfinished is cut off."""
    stream = open(Path(run_dir) / EVENTS, "a+b")  # noqa: SIM115 - the caller closes it
    stream.seek(0)
    text = stream.read()
    stream.truncate(text.rfind(b"\n") + 1)
    return stream


def _try_lock(stream: IO[bytes]) -> bool:
    """Take the lock without waiting; it goes when the file is closed or the process ends."""
    try:
        if sys.platform == "win32":
            import msvcrt

            stream.seek(_LOCKED_BYTE)
            msvcrt.locking(stream.fileno(), msvcrt.LK_NBLCK, 1)
        else:
            import fcntl

            fcntl.flock(stream.fileno(), fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True
