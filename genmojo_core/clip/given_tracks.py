"""Point tracks that lie beside a clip as an npz, in our keys or in those of the sample clips."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from genmojo_core.clip.clip import Channel
from genmojo_core.clip.limits import check_limit
from genmojo_core.clip.npz import NpzFile, open_npz
from genmojo_core.clip.pictures import Pictures
from genmojo_core.clip.points import NONE, OCCLUDED, OUT_OF_VIEW, VISIBLE, PointTracks
from genmojo_core.errors import GenmojoError

_OPTIONAL = {"xyz": 3, "conf": 2, "flags": 2, "source": 2}  # name -> rank


def read(path: Path, pictures: Pictures, only_object: int) -> Channel:
    """PointTracks in source pixels for the frames read; `valid` (N, T) is True where a point has a state.

    Read are our keys (`xy`, `state`, `object`, `size`, optional `xyz`, `conf`, `flags`, `source`) or `tracks`,
    `visible`, optional `annotated` (frames with annotation) and `track_object`. A position that is not finite has the
    state NONE: it says nothing, in particular not "occluded".

    Args:
        path: the npz file. pictures: the frames read. only_object: id of points without one (0 for background).

    Raises GenmojoError: as `open_npz`; "schema" for wrong shapes; "value" for states that are none.
    """
    file = open_npz(path)
    ours = "xy" in file
    xy = _checked(file, "xy" if ours else "tracks", 3).astype(np.float32)
    count, total = xy.shape[:2]
    if xy.shape[2] != 2 or total != pictures.total:
        raise GenmojoError("schema", f"holds positions {xy.shape} for a clip of {pictures.total} frames", str(path),
                           "store (points, frames, 2)")  # fmt: skip
    check_limit("tracks", count, str(path))
    state = _checked(file, "state", 2, (count, total)) if ours else _state(file, count, total)
    if (state > OUT_OF_VIEW).any() or (state < NONE).any():
        raise GenmojoError("value", "holds states other than 0 to 3", file.where("state"), "use 0 none, 1 visible, "
                           "2 occluded, 3 out of view")  # fmt: skip
    state = np.where(np.isfinite(xy).all(axis=2), state, NONE).astype(np.uint8)
    at = pictures.positions
    optional = {
        name: _checked(file, name, rank, (count, total))[:, at] for name, rank in _OPTIONAL.items() if name in file
    }
    tracks = PointTracks(xy[:, at], state[:, at], _owners(file, count, only_object), _size(file, pictures), **optional)
    if tracks.size != pictures.source_size:
        tracks = tracks.resized(*pictures.source_size)
    return Channel(tracks, tracks.state != NONE, f"given: {path}")


def _state(file: NpzFile, count: int, total: int) -> np.ndarray:
    """(N, T) states of `visible` and `annotated`."""
    state = np.where(_checked(file, "visible", 2, (count, total)).astype(bool), VISIBLE, OCCLUDED)
    if "annotated" in file:
        annotated = _checked(file, "annotated", 1, (total,)).astype(bool)
        state = np.where(annotated, state, NONE)
    return state


def _owners(file: NpzFile, count: int, only_object: int) -> np.ndarray:
    """(N,) object ids."""
    name = file.first_of("object", "track_object")
    if name is None:
        return np.full(count, only_object, np.int64)
    return _checked(file, name, 1, (count,)).astype(np.int64)


def _size(file: NpzFile, pictures: Pictures) -> tuple[int, int]:
    """(width, height) the positions refer to."""
    if "size" not in file:
        return pictures.source_size
    size = _checked(file, "size", 1, (2,))
    if (size < 1).any():
        raise GenmojoError("value", f"is {size[0]} x {size[1]}", file.where("size"), "store (width, height) in pixels")
    return int(size[0]), int(size[1])


def _checked(file: NpzFile, name: str, rank: int, start: tuple[int, ...] = ()) -> np.ndarray:
    """A numeric array of a rank and leading shape; raises GenmojoError("schema")."""
    array = file.array(name)
    if array.ndim != rank or array.shape[: len(start)] != start or array.dtype.kind not in "fiub":
        wanted = f"{rank} axes" + (f" starting with {start}" if start else "")
        raise GenmojoError("schema", f"is {array.dtype} of shape {array.shape}, wanted are numbers with {wanted}",
                           file.where(name), "store it in that shape")  # fmt: skip
    return array
