"""The one table of everything a person can do: menus, keys, palette, shortcut sheet and editor come from it. No Qt.

Each workspace lists its actions in a module of its own (`annotate/actions.py`, `watch/actions.py`): a tuple named
`ACTIONS`. Texts are English; the window translates them in the context "actions".
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field

PRESETS = ("Studio", "CVAT", "labelme", "Blender")
EVERYWHERE = ""
_MODIFIERS = "ctrl alt shift meta num"
_NAMES = {"escape": "esc", "delete": "del", "backtab": "tab", "pageup": "pgup", "pagedown": "pgdown", "insert": "ins"}


@dataclass(frozen=True)
class Action:
    """One thing a person can do.

    Args:
        id: stable name, "group.verb" ("time.play").
        text: what the menu and the palette say; "…" at the end if it asks something first.
        menu: title of its menu ("File", "View", ..., "View/Direction" for a submenu), "" if only in the palette.
        keys: shortcuts in the preset Studio, as Qt spells them ("Ctrl+K", "Space", "Shift+.").
        presets: shortcuts in other presets, where they differ from Studio's.
        workspace: "annotate", "watch", or "" if it works everywhere.
        help: one sentence for the shortcut sheet and the tool tip.
        checkable: shown with a tick that `ActionTable.bind(checked=...)` tells.
        separator: a line stands above it in its menu.
        repeats: holding the key repeats it (frame steps).
        held: acts until its key comes up; such a key is a single one, no sequence.
    """

    id: str
    text: str
    menu: str = ""
    keys: tuple[str, ...] = ()
    presets: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    workspace: str = EVERYWHERE
    help: str = ""
    checkable: bool = False
    separator: bool = False
    repeats: bool = False
    held: bool = False


@dataclass(frozen=True)
class Conflict:
    """Two actions that answer to the same key at the same time."""

    key: str
    first: str
    second: str


@dataclass
class _Bound:
    callback: Callable[[], object]
    enabled: Callable[[], bool] | None
    checked: Callable[[], bool] | None


class ActionTable:
    """The actions of the app, what they call, and the keys they answer to."""

    def __init__(self, actions: Iterable[Action]) -> None:
        self._actions: dict[str, Action] = {}
        self._bound: dict[str, _Bound] = {}
        self._own: dict[str, tuple[str, ...]] = {}
        self._listeners: list[Callable[[], None]] = []
        self.preset = PRESETS[0]
        for action in actions:
            if action.id in self._actions:
                raise ValueError(f"two actions are named {action.id}")
            self._actions[action.id] = action

    def __iter__(self) -> Iterator[Action]:
        return iter(self._actions.values())

    def __getitem__(self, action_id: str) -> Action:
        return self._actions[action_id]

    def has(self, action_id: str) -> bool:
        """True for an action of this table."""
        return action_id in self._actions

    def bind(
        self,
        action_id: str,
        callback: Callable[[], object],
        enabled: Callable[[], bool] | None = None,
        checked: Callable[[], bool] | None = None,
    ) -> None:
        """Says what an action does, when it is possible and (if checkable) whether it is on.

        Binding again replaces. Raises KeyError for an action that the table has not.
        """
        if action_id not in self._actions:
            raise KeyError(f"no action is named {action_id}")
        self._bound[action_id] = _Bound(callback, enabled, checked)
        self.changed()

    def is_bound(self, action_id: str) -> bool:
        """True once somebody said what the action does."""
        return action_id in self._bound

    def is_enabled(self, action_id: str) -> bool:
        """True if the action can be done now."""
        bound = self._bound.get(action_id)
        return bound is not None and (bound.enabled is None or bool(bound.enabled()))

    def is_checked(self, action_id: str) -> bool:
        """True if a checkable action is on now."""
        bound = self._bound.get(action_id)
        return bound is not None and bound.checked is not None and bool(bound.checked())

    def trigger(self, action_id: str) -> bool:
        """Does the action if it is possible now; False if not."""
        if not self.is_enabled(action_id):
            return False
        self._bound[action_id].callback()
        return True

    def keys(self, action_id: str) -> tuple[str, ...]:
        """The keys an action answers to: the person's own, else the preset's, else Studio's."""
        if action_id in self._own:
            return self._own[action_id]
        return _preset_keys(self._actions[action_id], self.preset)

    def own_keys(self) -> dict[str, tuple[str, ...]]:
        """Keys that a person changed, to be stored."""
        return dict(self._own)

    def set_keys(self, action_id: str, keys: Iterable[str] | None) -> None:
        """Gives an action keys of one's own; None takes the preset's again."""
        action = self._actions[action_id]
        if keys is None or tuple(keys) == _preset_keys(action, self.preset):
            self._own.pop(action_id, None)
        else:
            self._own[action_id] = tuple(keys)
        self.changed()

    def set_preset(self, preset: str) -> None:
        """Takes the keys of a preset; keys of one's own stay. Raises ValueError for an unknown preset."""
        if preset not in PRESETS:
            raise ValueError(f"no preset is named {preset}; there are {', '.join(PRESETS)}")
        self.preset = preset
        self.changed()

    def conflicts(self) -> list[Conflict]:
        """Keys that two actions of one workspace (or one and one that works everywhere) both answer to.

        Also those that begin a sequence of another's, which could not be reached.
        """
        found = []
        by_start: dict[str, list[tuple[str, Action]]] = {}
        for action in self._actions.values():
            for key in dict.fromkeys(normal_key(key) for key in self.keys(action.id)):
                same_start = by_start.setdefault(key.split(", ")[0], [])
                for taken, other in same_start:
                    if overlap(key, taken) and (
                        EVERYWHERE in (action.workspace, other.workspace) or action.workspace == other.workspace
                    ):
                        found.append(Conflict(key, other.id, action.id))
                same_start.append((key, action))
        return found

    def available(self, workspace: str) -> list[Action]:
        """Actions that somebody bound and that work in this workspace."""
        return [
            action
            for action in self._actions.values()
            if action.workspace in (EVERYWHERE, workspace) and self.is_bound(action.id)
        ]

    def subscribe(self, listener: Callable[[], None]) -> Callable[[], None]:
        """Calls `listener()` when a key or a binding has changed. Returns a function that ends the subscription."""
        self._listeners.append(listener)

        def unsubscribe() -> None:
            if listener in self._listeners:
                self._listeners.remove(listener)

        return unsubscribe

    def changed(self) -> None:
        """Tells menus that keys or bindings have changed. What is possible now they ask whenever they open."""
        for listener in list(self._listeners):
            listener()


def normal_key(key: str) -> str:
    """One spelling per key: modifiers in Qt's order, each part capitalised ("shift+ctrl+k" -> "Ctrl+Shift+K")."""
    return ", ".join(_normal_chord(chord.strip()) for chord in key.split(", "))


def overlap(one: str, other: str) -> bool:
    """Whether two keys cannot both be told apart: they are the same, or one begins the other."""
    first, second = normal_key(one).split(", "), normal_key(other).split(", ")
    return all(a == b for a, b in zip(first, second, strict=False))


def _normal_chord(chord: str) -> str:
    parts = chord.split("+")
    if chord.endswith("+"):  # the plus key itself: "+" or "Ctrl++"
        parts = [*[part for part in parts if part], "+"]
    modifiers = sorted((part.lower() for part in parts[:-1]), key=lambda part: (_MODIFIERS.find(part), part))
    last = _NAMES.get(parts[-1].lower(), parts[-1])
    return "+".join([*(part.capitalize() for part in modifiers), last.upper() if len(last) == 1 else last.capitalize()])


def _preset_keys(action: Action, preset: str) -> tuple[str, ...]:
    return tuple(action.presets.get(preset, action.keys))
