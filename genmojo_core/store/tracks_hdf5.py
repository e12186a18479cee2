"""Tracks alone as `genmojo4d` HDF5: the tracks group of a scene file without Gaussians."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from genmojo_core.clip.cameras import Cameras
from genmojo_core.errors import GenmojoError
from genmojo_core.store import scene_hdf5
from genmojo_core.store.scene_file import BakedScene
from genmojo_core.store.track_sheet import TrackSheet


def write(sheet: TrackSheet, path: str | Path, seconds: np.ndarray | None = None) -> None:
    """Write tracks; `seconds` (T,) are the clip's time stamps, by default 24 frames a second. Raises as scene files."""
    frames = sheet.tracks.state.shape[1]
    times = np.arange(frames) / 24.0 if seconds is None else np.asarray(seconds, np.float64)
    names = tuple(sheet.frame_name(t) for t in range(frames))
    scene_hdf5.write(_empty_scene(sheet, times, names), path)


def read(path: str | Path) -> TrackSheet:
    """The tracks of a scene file. Raises GenmojoError("empty") if it has none; everything scene files raise."""
    scene = scene_hdf5.read(path)
    if scene.predicted is None:
        raise GenmojoError("empty", "holds no tracks", str(path), "give a file with tracks")
    return TrackSheet.of_tracks(scene.predicted, scene.source_names)


def _empty_scene(sheet: TrackSheet, seconds: np.ndarray, names: tuple[str, ...]) -> BakedScene:
    """A scene of no objects; its camera stands still."""
    frames = len(seconds)
    width, height = sheet.tracks.size
    focal = float(max(width, height))
    lens = np.array([[focal, 0, width / 2], [0, focal, height / 2], [0, 0, 1]])
    cameras = Cameras(np.tile(lens, (frames, 1, 1)), np.tile(np.eye(4), (frames, 1, 1)), (width, height))

    def none(*shape: int) -> np.ndarray:
        return np.zeros(shape, np.float32)

    return BakedScene(
        np.arange(frames), seconds, names, (), none(0, 3), none(0, 4), none(0, 3), none(0), none(0, 3),
        np.zeros(0, np.uint64), none(frames, 0, 3), none(frames, 0, 4), none(frames, 0, 3), none(frames, 0, 3, 4),
        none(frames, 0), cameras, np.zeros(0, np.int64), np.array([0.0, -1.0, 0.0]), predicted=sheet.tracks,
    )  # fmt: skip
