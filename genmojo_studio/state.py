"""The one shared, observable state of the app: which clip, which frame, what is selected. Knows no Qt.

Panels read it, actions change it, nobody else keeps a copy. Everything happens on the thread that made it.
"""

from __future__ import annotations

import threading
import weakref
from collections.abc import Callable, Collection
from pathlib import Path
from typing import Any

from genmojo_core.clip.clip import Clip

Callback = Callable[[], None]
_PLAIN = (int, float, str, bytes, bool, Path, type(None))


class AppState:
    """Clip, frame and selection that the two workspaces share.

    Attributes (change them with `set`, never directly):
        clip: the clip that is open, or None.  clip_path: where it was read from, or None.
        masks_path: file with masks that a person corrected, which stand for the clip's, or None.
        project_path: project of the clip's annotation, or None.
        scene_path: the scene file or run folder on show, or None.
        frame: index into the clip's frames, 0-based, always inside.  frame_count: number of frames, at least 1.
        playing: whether time runs.  speed: frames advance at `speed` times the clip's rate, > 0.
        selected_object: id in the clip's masks, or None.  selected_track: index of a point track, or None.
        theme: "dark" or "light".
    """

    clip: Clip | None
    clip_path: Path | None
    masks_path: Path | None
    project_path: Path | None
    scene_path: Path | None
    frame: int
    frame_count: int
    playing: bool
    speed: float
    selected_object: int | None
    selected_track: int | None
    theme: str

    def __init__(self) -> None:
        self._thread = threading.get_ident()
        self._subscribers: list[tuple[Callable[[], Callback | None], frozenset[str]]] = []
        self._values: dict[str, Any] = {
            "clip": None,
            "clip_path": None,
            "masks_path": None,
            "project_path": None,
            "scene_path": None,
            "frame": 0,
            "frame_count": 1,
            "playing": False,
            "speed": 1.0,
            "selected_object": None,
            "selected_track": None,
            "theme": "dark",
        }

    def __getattr__(self, name: str) -> Any:
        try:
            return self.__dict__["_values"][name]
        except KeyError:
            raise AttributeError(f"the state has no {name}") from None

    def set(self, **values: Any) -> None:
        """Changes several values at once and tells each subscriber of any of them once.

        Equal values count as no change. `frame` is kept within the clip. Raises AttributeError for an unknown name,
        RuntimeError when called from another thread.
        """
        if threading.get_ident() != self._thread:
            raise RuntimeError("the state is changed on the UI thread only")
        unknown = sorted(set(values) - set(self._values))
        if unknown:
            raise AttributeError(f"the state has no {', '.join(unknown)}")
        changed = {name for name, value in values.items() if not _same(self._values[name], value)}
        self._values.update({name: values[name] for name in changed})
        if self._keep_frame_inside():
            changed.add("frame")
        if changed:
            self._notify(changed)

    def subscribe(self, callback: Callback, *names: str) -> Callable[[], None]:
        """Calls `callback()` after a change of any of `names` (of anything if there are none).

        A bound method is held weakly: it ends with its object. Returns a function that ends the subscription.
        Raises AttributeError for an unknown name.
        """
        unknown = sorted(set(names) - set(self._values))
        if unknown:
            raise AttributeError(f"the state has no {', '.join(unknown)}")
        entry = (_reference(callback), frozenset(names) or frozenset(self._values))
        self._subscribers.append(entry)

        def unsubscribe() -> None:
            if entry in self._subscribers:
                self._subscribers.remove(entry)

        return unsubscribe

    def open_clip(self, clip: Clip, path: str | Path, masks: Path | None = None, project: Path | None = None) -> None:
        """Puts another clip on show, at its first frame, nothing selected.

        Args:
            masks: where corrected ones lie. project: of its annotation.
        """
        self.set(
            clip=clip,
            clip_path=Path(path),
            masks_path=masks,
            project_path=project,
            frame_count=max(len(clip), 1),
            frame=0,
            playing=False,
            selected_object=None,
            selected_track=None,
        )

    def _keep_frame_inside(self) -> bool:
        """Moves the frame into the clip; True if it had to."""
        inside = min(max(int(self._values["frame"]), 0), max(int(self._values["frame_count"]), 1) - 1)
        if inside == self._values["frame"]:
            return False
        self._values["frame"] = inside
        return True

    def _notify(self, changed: Collection[str]) -> None:
        for entry in list(self._subscribers):
            find, names = entry
            if names.isdisjoint(changed):
                continue
            callback = find()
            if callback is not None:
                callback()
            elif entry in self._subscribers:
                self._subscribers.remove(entry)


def _same(old: Any, new: Any) -> bool:
    """Plain values by value, everything else (a clip) by identity."""
    if old is new:
        return True
    return isinstance(old, _PLAIN) and isinstance(new, _PLAIN) and type(old) is type(new) and old == new


def _reference(callback: Callback) -> Callable[[], Callback | None]:
    if hasattr(callback, "__self__") and hasattr(callback, "__func__"):
        return weakref.WeakMethod(callback)
    return lambda: callback
