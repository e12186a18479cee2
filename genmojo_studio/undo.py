"""Undo of view and scene edits: values before and after. Knows no Qt.

Annotations have their own, which survives a restart (the project file); this one lives as long as the window.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

_MERGE_SECONDS = 1.0
_MOST = 1000


@dataclass
class _Change:
    text: str
    restore: Callable[[Any], object]
    before: Any
    after: Any
    key: str
    at: float


class UndoStack:
    """Changes done and undone. Quick changes of one thing (dragging a slider) become one."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._done: list[_Change] = []
        self._undone: list[_Change] = []

    def record(self, text: str, restore: Callable[[Any], object], before: Any, after: Any, key: str = "") -> None:
        """Notes a change that has happened: `restore(before)` takes it back, `restore(after)` does it again.

        Changes with the same non-empty `key` within a second of one another are merged.
        """
        now = self._clock()
        self._undone.clear()
        last = self._done[-1] if self._done else None
        if last is not None and key and last.key == key and now - last.at < _MERGE_SECONDS:
            last.after, last.at = after, now
            return
        self._done.append(_Change(text, restore, before, after, key, now))
        del self._done[:-_MOST]

    @property
    def undo_text(self) -> str:
        """What `undo` would take back, "" if nothing."""
        return self._done[-1].text if self._done else ""

    @property
    def redo_text(self) -> str:
        """What `redo` would do again, "" if nothing."""
        return self._undone[-1].text if self._undone else ""

    def undo(self) -> bool:
        """Takes the last change back; False if there is none."""
        if not self._done:
            return False
        change = self._done.pop()
        self._undone.append(change)
        change.restore(change.before)
        return True

    def redo(self) -> bool:
        """Does the last change that was taken back again; False if there is none."""
        if not self._undone:
            return False
        change = self._undone.pop()
        change.at = -_MERGE_SECONDS
        self._done.append(change)
        change.restore(change.after)
        return True

    def clear(self) -> None:
        """Forgets everything: another scene is on show."""
        self._done.clear()
        self._undone.clear()
