"""The worker's process: starting it so that it outlives the window, and seeing whether and how it has ended."""

from __future__ import annotations

import contextlib
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

from genmojo_studio.worker import runs

ROOT = Path(__file__).resolve().parents[2]
_LAST_SECONDS = 1.0  # after its lock is gone, how long a worker of another window may take to leave
_LET_GO: list[subprocess.Popen[bytes]] = []  # children that go on without us; reaped by the system when we end


class WorkerProcess:
    """A worker, ours or found.

    Args:
        folder: its run folder. pid: its process. child: how to wait for it, None if another program started it.
    """

    def __init__(self, folder: Path, pid: int, child: subprocess.Popen[bytes] | None = None) -> None:
        self.folder, self.pid, self._child = folder, pid, child
        self._lock_gone: float | None = None
        self._asked = False
        self._address = ""

    @classmethod
    def started(cls, folder: Path, program: list[str] | None = None) -> WorkerProcess:
        """Start a worker in a process group of its own; what it prints goes to the folder's log.

        Not in a session of its own: Linux shares the cores among sessions first (autogroups), and the window's threads
        could not give way to it any more.
        """
        command = [*(program or [sys.executable, "-m", "genmojo_studio.worker.host"]), "--run-dir", str(folder)]
        paths = [str(ROOT), *filter(None, [os.environ.get("PYTHONPATH", "")])]
        environment = {**os.environ, "PYTHONPATH": os.pathsep.join(paths), "PYTHONUNBUFFERED": "1"}
        environment.setdefault("OPENBLAS_NUM_THREADS", "1")
        with open(folder / runs.LOG, "wb") as log:
            if sys.platform == "win32":
                flags = subprocess.CREATE_NEW_PROCESS_GROUP | subprocess.DETACHED_PROCESS
                child = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=log, stderr=log, env=environment,
                                         creationflags=flags)  # fmt: skip
            else:
                child = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=log, stderr=log, env=environment,
                                         process_group=0)  # fmt: skip
        return cls(folder, child.pid, child)

    @property
    def exit_code(self) -> int | None:
        """As `Popen.returncode`; None while it runs or where it is not our child."""
        return None if self._child is None else self._child.returncode

    def ended(self) -> bool:
        """True once the process is gone; remembers its address for `sweep_up`."""
        if self._child is not None:
            return self._child.poll() is not None
        if runs.live_run(self.folder) is not None:
            self._lock_gone = None
            return False
        if not _exists(self.pid):
            return True
        self._lock_gone = self._lock_gone or time.monotonic()
        return time.monotonic() - self._lock_gone > _LAST_SECONDS

    def end_harder(self) -> None:
        """First SIGTERM, the next time SIGKILL."""
        if self._asked:
            self.kill()
        else:
            self._asked = True
            self._signal(signal.SIGTERM)

    def kill(self) -> None:
        """End it at once."""
        self._signal(getattr(signal, "SIGKILL", signal.SIGTERM))

    def let_go(self) -> None:
        """It goes on without us."""
        if self._child is not None:
            _LET_GO.append(self._child)

    def sweep_up(self) -> None:
        """Remove what a worker that was killed could not remove: its socket."""
        address = str(runs.read_json(self.folder / runs.LOCK).get("address", ""))
        folder = Path(address.removeprefix("unix:")).parent
        if address.startswith("unix:") and folder.name.startswith("genmojo-"):
            shutil.rmtree(folder, ignore_errors=True)

    def _signal(self, number: int) -> None:
        if self.ended():
            return
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.kill(self.pid, number)


def _exists(pid: int) -> bool:
    """True if a process with this number is there."""
    if sys.platform == "win32":
        return False  # os.kill(pid, 0) would end it there; the lock has told already
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    except PermissionError:
        return True
    return True
