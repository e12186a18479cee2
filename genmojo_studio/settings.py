"""What the app remembers between sessions: theme, language, keys, recent files, window layouts."""

from __future__ import annotations

import json
from pathlib import Path
from typing import cast

from PySide6.QtCore import QByteArray, QSettings, QStandardPaths

_MOST_RECENT = 12


class Settings:
    """Thin, typed cover of QSettings; all instances share what is stored."""

    def __init__(self) -> None:
        self._store = QSettings("GenMOJO", "Studio")

    def text(self, key: str, default: str = "") -> str:
        """A stored text."""
        return str(self._store.value(key, default))

    def whole(self, key: str, default: int) -> int:
        """A stored whole number; the default where none can be read."""
        stored = _parsed(self.text(key, str(default)))
        return stored if isinstance(stored, int) else default

    def put(self, key: str, value: str) -> None:
        """Stores a text."""
        self._store.setValue(key, value)

    def layout(self, name: str) -> QByteArray | None:
        """A window state or geometry stored under a name."""
        value = self._store.value(f"layout/{name}")
        return value if isinstance(value, QByteArray) else None

    def put_layout(self, name: str, state: QByteArray) -> None:
        """Stores a window state or geometry."""
        self._store.setValue(f"layout/{name}", state)

    def forget_layouts(self) -> None:
        """Every window opens as it was delivered."""
        self._store.remove("layout")

    def recent(self) -> list[Path]:
        """Files and folders opened lately, newest first; those that are gone are left out."""
        return [path for path in map(Path, self._strings("recent")) if path.exists()]

    def add_recent(self, path: str | Path) -> None:
        """Puts a file or folder first in the list."""
        newest = str(Path(path).absolute())
        others = [other for other in self._strings("recent") if other != newest]
        self._store.setValue("recent", json.dumps([newest, *others][:_MOST_RECENT]))

    def own_keys(self) -> dict[str, tuple[str, ...]]:
        """Shortcuts that a person changed."""
        stored = _parsed(self.text("keys/own", "{}"))
        if not isinstance(stored, dict):
            return {}
        return {name: tuple(map(str, keys)) for name, keys in stored.items() if isinstance(keys, list)}

    def put_own_keys(self, keys: dict[str, tuple[str, ...]]) -> None:
        """Stores the shortcuts that a person changed."""
        self._store.setValue("keys/own", json.dumps({name: list(given) for name, given in keys.items()}))

    def _strings(self, key: str) -> list[str]:
        stored = _parsed(self.text(key, "[]"))
        return cast(list[str], stored) if isinstance(stored, list) else []


def data_folder() -> Path:
    """Where the app puts what it makes itself: the demo clip, runs without a folder of their own."""
    place = QStandardPaths.writableLocation(QStandardPaths.StandardLocation.GenericDataLocation)
    return Path(place) / "genmojo-studio"


def _parsed(text: str) -> object:
    """JSON that a person may have spoilt by hand: nothing, then."""
    try:
        return json.loads(text)
    except json.JSONDecodeError:
        return None
