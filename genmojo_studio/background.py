"""Work that would hold up the window, done on a thread, its result handed back on the UI thread.

What is done again and again while a run goes on gives way to an optimiser on the same cores: such threads take what it
leaves, and a tenth of a core at most of what it wants.
"""

from __future__ import annotations

import os
import sys
import threading
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from typing import Any

from PySide6.QtCore import QObject, Qt, Signal

Done = Callable[[Any], object]
Failed = Callable[[BaseException], object]
_NICENESS = 10


def give_way() -> None:
    """The calling thread, and those it starts, have a low priority from now on; on Linux, where threads have one."""
    if sys.platform == "linux":
        os.setpriority(os.PRIO_PROCESS, threading.get_native_id(), _NICENESS)


class Tasks(QObject):
    """The tasks of one window or panel: kept while they run, dropped together when it closes.

    Args:
        yields: they give way to an optimiser.
    """

    _ended = Signal(object)

    def __init__(self, parent: QObject | None = None, threads: int = 1, yields: bool = False) -> None:
        super().__init__(parent)
        manners = give_way if yields else None
        self._pool = ThreadPoolExecutor(threads, thread_name_prefix="genmojo-task", initializer=manners)
        self._waiting: dict[Future[Any], tuple[Done, Failed]] = {}
        self._ended.connect(self._deliver, Qt.ConnectionType.QueuedConnection)

    def run(self, work: Callable[[], Any], done: Done, failed: Failed) -> None:
        """Does `work()` on a thread, then calls `done(result)` or `failed(error)` on the UI thread."""
        future = self._pool.submit(work)
        self._waiting[future] = (done, failed)
        future.add_done_callback(self._ended.emit)

    @property
    def busy(self) -> bool:
        """True while something runs or waits."""
        return bool(self._waiting)

    def drop(self) -> None:
        """Nobody is told of results still to come; what has not begun never does."""
        for future in list(self._waiting):
            future.cancel()
        self._waiting.clear()

    def close(self) -> None:
        """Drops everything and lets the threads end."""
        self.drop()
        self._pool.shutdown(wait=False, cancel_futures=True)

    def _deliver(self, future: Future[Any]) -> None:
        done, failed = self._waiting.pop(future, (None, None))
        if done is None or failed is None or future.cancelled():
            return
        error = future.exception()
        if error is None:
            done(future.result())
        else:
            failed(error)
