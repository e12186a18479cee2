"""Keys that act while they are held: painting states, loupe, bare frame.

Qt tells of a shortcut when its key goes down but not when it comes up, so this listens to both: first the override
that precedes every shortcut, then the release.
"""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QEvent, QObject
from PySide6.QtGui import QKeyEvent, QKeySequence
from PySide6.QtWidgets import QWidget

from genmojo_studio.actions import ActionTable

Verb = Callable[[], object]


class HeldKeys(QObject):
    """Calls `begin()` when a held action's key goes down (its shortcut fires) and `end()` when it comes up."""

    def __init__(self, owner: QWidget, actions: ActionTable) -> None:
        super().__init__(owner)
        self._actions = actions
        self._ends: dict[str, Verb] = {}
        self._down: dict[int, str] = {}
        owner.installEventFilter(self)  # keys that nobody below keeps come up to it, overrides too

    def add(self, action_id: str, begin: Verb, tapped: Verb, end: Verb) -> None:
        """Bind an action: `begin` if a key is held for it, `tapped` if it came from a menu, `end` on release."""
        self._ends[action_id] = end

        def triggered() -> None:
            begin() if action_id in self._down.values() else tapped()

        self._actions.bind(action_id, triggered)

    def is_down(self, action_id: str) -> bool:
        """True while a key of the action is held."""
        return action_id in self._down.values()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Note which of the actions' keys are down; never keeps an event from anybody."""
        kind = event.type()
        if kind == QEvent.Type.ShortcutOverride and isinstance(event, QKeyEvent) and not event.isAutoRepeat():
            action_id = self._action_of(event)
            if action_id:
                self._down[event.key()] = action_id
        elif kind == QEvent.Type.KeyRelease and isinstance(event, QKeyEvent) and not event.isAutoRepeat():
            self._release(event.key())
        elif kind == QEvent.Type.WindowDeactivate:
            for key in list(self._down):
                self._release(key)
        return False

    def _release(self, key: int) -> None:
        action_id = self._down.pop(key, None)
        if action_id is not None and action_id not in self._down.values():
            self._ends[action_id]()

    def _action_of(self, event: QKeyEvent) -> str | None:
        pressed = QKeySequence(event.keyCombination())
        for action_id in self._ends:
            if any(QKeySequence(key) == pressed for key in self._actions.keys(action_id)):
                return action_id
        return None
