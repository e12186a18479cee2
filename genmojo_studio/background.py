"""Work that would hold up the window, done on a thread, its result handed back on the UI thread.

What is done again and again while a run goes on gives way to an optimiser on the same cores: such threads take what it
leaves, and a tenth of a core at most of what it wants.
"""

from __future__ import annotations

import contextlib
import os
import sys
import threading
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from functools import cache
from typing import Any

from PySide6.QtCore import QObject, Qt, Signal

from genmojo_core.kernels.threads import HELPERS

Done = Callable[[Any], object]
Failed = Callable[[BaseException], object]
_NICENESS = 10


def give_way() -> None:
    """The calling thread, those it starts and the kernels' helpers have a low priority from now on.

    On Linux, where threads have one. The helpers may have been started by a thread that was in a hurry.
    """
    if sys.platform == "linux":
        helpers = (one.native_id for one in threading.enumerate() if one.name.startswith(HELPERS))
        for number in (threading.get_native_id(), *helpers):
            with contextlib.suppress(ProcessLookupError):  # it has ended meanwhile
                if os.getpriority(os.PRIO_PROCESS, number or 0) < _NICENESS:  # nobody may go back up
                    os.setpriority(os.PRIO_PROCESS, number or 0, _NICENESS)


class _Job:
    """One task. What it was made of is let go of on the UI thread: it may hold the last reference to a window, and a
    Qt object that dies on another thread takes the process with it."""

    def __init__(self, owner: Tasks, work: Callable[[], Any], done: Done, failed: Failed) -> None:
        self.owner, self.work, self.done, self.failed = owner, work, done, failed
        self.future: Future[Any] = Future()

    def call(self) -> Any:
        """On a thread: the work itself. The thread holds this job only, never what the job holds."""
        return self.work()

    def ring(self, _future: Future[Any]) -> None:
        """On a thread, when the work has ended."""
        _bell().ended.emit(self)

    def clear(self) -> None:
        """On the UI thread: let go of everything, the frames of an error too."""
        error = None if self.future.cancelled() else self.future.exception()
        if error is not None:
            error.__traceback__ = None
        del self.owner, self.work, self.done, self.failed, self.future


class _Bell(QObject):
    """Brings finished jobs to the UI thread. There is one, and it outlives every window: threads may always ring it."""

    ended = Signal(object)

    def __init__(self) -> None:
        super().__init__()
        self.ended.connect(self._deliver, Qt.ConnectionType.QueuedConnection)

    def _deliver(self, job: _Job) -> None:
        try:
            job.owner.deliver(job)
        finally:
            job.clear()


@cache
def _bell() -> _Bell:
    """Made by the first `Tasks`, hence on the UI thread."""
    return _Bell()


class Tasks:
    """The tasks of one window or panel: kept while they run, dropped together when it closes. Made on the UI thread.

    Args:
        threads: how many run at once. yields: they give way to an optimiser.
    """

    def __init__(self, threads: int = 1, yields: bool = False) -> None:
        _bell()
        manners = give_way if yields else None
        self._pool = ThreadPoolExecutor(threads, thread_name_prefix="genmojo-task", initializer=manners)
        self._closed = False
        self._waiting: set[_Job] = set()

    def run(self, work: Callable[[], Any], done: Done, failed: Failed) -> None:
        """Does `work()` on a thread, then calls `done(result)` or `failed(error)` on the UI thread.

        Once closed, nothing is done any more.
        """
        if self._closed:
            return
        job = _Job(self, work, done, failed)
        self._waiting.add(job)
        job.future = self._pool.submit(job.call)
        job.future.add_done_callback(job.ring)

    @property
    def busy(self) -> bool:
        """True while something runs or waits."""
        return bool(self._waiting)

    def drop(self) -> None:
        """Nobody is told of results still to come; what has not begun never does."""
        for job in list(self._waiting):
            job.future.cancel()
        self._waiting.clear()

    def close(self) -> None:
        """Drops everything and lets the threads end."""
        self._closed = True
        self.drop()
        self._pool.shutdown(wait=False)

    def deliver(self, job: _Job) -> None:
        """A job has ended: tell whoever waits for it, if anybody still does."""
        if job not in self._waiting:
            return
        self._waiting.discard(job)
        error = job.future.exception()
        if error is None:
            job.done(job.future.result())
        else:
            job.failed(error)
