"""Work of which only the newest matters: what is asked for while one runs replaces what waits."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from PySide6.QtCore import QObject, Signal

from genmojo_studio import notify
from genmojo_studio.background import Tasks


class Latest(QObject):
    """One thread, one job waiting at most. `done(result)` for every job that ran to its end."""

    done = Signal(object)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._tasks = Tasks(yields=True)
        self._waiting: Callable[[], Any] | None = None

    def ask(self, work: Callable[[], Any]) -> None:
        """Does `work()` as soon as the thread is free, unless something newer comes."""
        self._waiting = work
        self._next()

    def close(self) -> None:
        """No more results."""
        self._waiting = None
        self._tasks.close()

    def _next(self) -> None:
        if self._waiting is not None and not self._tasks.busy:
            work, self._waiting = self._waiting, None
            self._tasks.run(work, self._finished, self._failed)

    def _finished(self, result: Any) -> None:
        self.done.emit(result)
        self._next()

    def _failed(self, error: BaseException) -> None:
        notify.tell(error)
        self._next()
