"""What the workspace shows: the newest snapshot of a scene, where it came from, and the input beside it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from PySide6.QtCore import QObject, Signal

from genmojo_core.clip.clip import Clip
from genmojo_core.store.scene_file import BakedScene
from genmojo_studio import notify
from genmojo_studio.background import Tasks
from genmojo_studio.opening import SHARED_SHORT_SIDE
from genmojo_studio.state import AppState
from genmojo_studio.translate import tr
from genmojo_studio.view3d.snapshot import SceneSnapshot


class Session(QObject):
    """One scene at a time: a file, a PLY, or the previews of a run.

    Signals: `snapshot_changed` for anything new to draw; `scene_changed` when another scene or run came on show;
    `busy(text)` while something is read, "" when it is.
    """

    snapshot_changed = Signal()
    scene_changed = Signal()
    busy = Signal(str)

    def __init__(self, state: AppState, tasks: Tasks, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._state = state
        self._tasks = tasks
        self._version = 0
        self.snapshot: SceneSnapshot | None = None
        self.scene: BakedScene | None = None
        self.path: Path | None = None

    def open_scene(self, path: Path) -> None:
        """Reads a scene file, and the clip it was made from where that still lies there."""
        self._read(path, lambda: _read_scene(path, self._state.clip_path), self._scene_read)

    def open_ply(self, path: Path) -> None:
        """Reads a splat, or a folder of them as frames; the camera is invented."""
        self._read(path, lambda: _read_ply(path), self._scene_read)

    def take_preview(self, snapshot: SceneSnapshot) -> None:
        """A worker's newest preview."""
        first = self.scene is not None or self.snapshot is None
        self.scene, self.path = None, None
        self._show(snapshot)
        if first:
            self.scene_changed.emit()

    def clear(self) -> None:
        """Nothing is on show: another clip was opened, or a run begins."""
        self.snapshot, self.scene, self.path = None, None, None
        self._state.set(scene_path=None)
        self.scene_changed.emit()
        self.snapshot_changed.emit()

    def _read(self, path: Path, work: Callable[[], object], done: Callable[[Any], None]) -> None:
        self.busy.emit(tr("Reading {name} …").format(name=path.name))
        self.path = path
        self._tasks.run(work, done, self._failed)

    def _scene_read(self, result: Read) -> None:
        scene, clip, clip_path = result.scene, result.clip, result.clip_path
        self.busy.emit("")
        self.scene = scene
        if clip is not None and clip_path is not None:
            self._state.open_clip(clip, clip_path)
        self._state.set(scene_path=self.path, frame_count=max(len(scene), 1))
        self._version += 1
        self._show(replace(result.snapshot.at(self._state.frame), version=self._version))
        self.scene_changed.emit()

    def _show(self, snapshot: SceneSnapshot) -> None:
        self._version = max(self._version, snapshot.version)
        self.snapshot = snapshot
        if self._state.frame_count != snapshot.T:
            self._state.set(frame_count=max(snapshot.T, 1))
        self.snapshot_changed.emit()

    def _failed(self, error: BaseException) -> None:
        self.busy.emit("")
        notify.tell(error)


@dataclass(frozen=True)
class Read:
    """A file's scene, ready to draw, and its clip unless that is open already or gone."""

    scene: BakedScene
    snapshot: SceneSnapshot
    clip: Clip | None = None
    clip_path: Path | None = None


def _read_scene(path: Path, open_clip: Path | None) -> Read:
    from genmojo_core.clip import folders
    from genmojo_core.store import scene_hdf5

    scene = scene_hdf5.read(path)
    source = _clip_of(scene, path)
    if source is None or source == open_clip:
        return Read(scene, SceneSnapshot.from_baked(scene))
    return Read(scene, SceneSnapshot.from_baked(scene), folders.read(source, short_side=SHARED_SHORT_SIDE), source)


def _clip_of(scene: BakedScene, path: Path) -> Path | None:
    """Where the scene's clip lies: as the file says, or by that name beside the file."""
    said = str(scene.config.get("input", ""))
    places = (Path(said), path.parent / said, path.parent / Path(said).name) if said else ()
    return next((place.absolute() for place in places if place.exists()), None)


def _read_ply(path: Path) -> Read:
    from genmojo_core.store import ply_scene

    scene = ply_scene.read_scene(path)
    return Read(scene, SceneSnapshot.from_baked(scene))
