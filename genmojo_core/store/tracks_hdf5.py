"""Tracks alone as `genmojo4d` HDF5: the tracks group of a scene file without Gaussians.

Numbers, names and reviews of the tracks go along in the file's configuration, under "track_sheet".
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from genmojo_core.clip.cameras import Cameras
from genmojo_core.errors import GenmojoError
from genmojo_core.store import scene_hdf5
from genmojo_core.store.scene_file import BakedScene
from genmojo_core.store.track_sheet import TrackSheet
from genmojo_core.tracks.interpolate import placed

_SHEET = "track_sheet"


def write(sheet: TrackSheet, path: str | Path) -> None:
    """Write tracks; time stamps are the sheet's, else 24 frames a second. A hidden point whose place nobody knows lies
    on the line between its neighbours. Raises as scene files."""
    sheet = replace(sheet, tracks=placed(sheet.tracks))
    frames = sheet.tracks.state.shape[1]
    times = np.arange(frames) / 24.0 if sheet.seconds is None else np.asarray(sheet.seconds, np.float64)
    names = tuple(sheet.frame_name(t) for t in range(frames))
    scene_hdf5.write(_empty_scene(sheet, times, names), path)


def read(path: str | Path) -> TrackSheet:
    """The tracks of a scene file. Raises GenmojoError("empty") if it has none; everything scene files raise."""
    scene = scene_hdf5.read(path)
    if scene.predicted is None:
        raise GenmojoError("empty", "holds no tracks", str(path), "give a file with tracks")
    plain = replace(TrackSheet.of_tracks(scene.predicted, scene.source_names), seconds=scene.seconds)
    told = scene.config.get(_SHEET)
    if not isinstance(told, dict):
        return plain
    try:
        return _named(plain, told)
    except (KeyError, TypeError, ValueError) as error:
        raise GenmojoError("schema", "has names of its tracks that do not fit them", str(path),
                           "export it again") from error  # fmt: skip


def _named(sheet: TrackSheet, told: dict[str, Any]) -> TrackSheet:
    """With the numbers and names that lie beside the tracks. Raises ValueError for lists of another length."""
    count = len(sheet.numbers)
    numbers = np.array(told["number"], np.int64)
    points, reviews = (tuple(str(word) for word in told[key]) for key in ("point_name", "review"))
    if numbers.shape != (count,) or len(points) not in (0, count) or len(reviews) not in (0, count):
        raise ValueError("other lengths")
    names = {int(key): str(name) for key, name in told["object_name"].items()}
    return replace(sheet, numbers=numbers, object_names=names, point_names=points, reviews=reviews, numbers_told=True)


def _empty_scene(sheet: TrackSheet, seconds: np.ndarray, names: tuple[str, ...]) -> BakedScene:
    """A scene of no objects; its camera stands still."""
    frames = len(seconds)
    width, height = sheet.tracks.size
    focal = float(max(width, height))
    lens = np.array([[focal, 0, width / 2], [0, focal, height / 2], [0, 0, 1]])
    cameras = Cameras(np.tile(lens, (frames, 1, 1)), np.tile(np.eye(4), (frames, 1, 1)), (width, height))
    told = {"number": sheet.numbers.tolist(), "point_name": list(sheet.point_names), "review": list(sheet.reviews),
            "object_name": {str(i): sheet.name_of(int(i)) for i in np.unique(sheet.tracks.object)}}  # fmt: skip

    def none(*shape: int) -> np.ndarray:
        return np.zeros(shape, np.float32)

    return BakedScene(
        np.arange(frames), seconds, names, (), none(0, 3), none(0, 4), none(0, 3), none(0), none(0, 3),
        np.zeros(0, np.uint64), none(frames, 0, 3), none(frames, 0, 4), none(frames, 0, 3), none(frames, 0, 3, 4),
        none(frames, 0), cameras, np.zeros(0, np.int64), np.array([0.0, -1.0, 0.0]), predicted=sheet.tracks,
        config={_SHEET: told}, fps=_rate(seconds),
    )  # fmt: skip


def _rate(seconds: np.ndarray) -> float:
    """Frames a second, by the median step."""
    steps = np.diff(seconds)
    return float(1.0 / np.median(steps)) if len(steps) and np.median(steps) > 0 else 24.0
