"""npz files of arrays: point tracks, queries, camera paths. Never pickles, always whole, faults in one sentence.

Tracks (ARCHITECTURE.md section 5): `xy` (N, T, 2) raster pixels, `state` (N, T), `object` (N,), `size` (W, H), optional
`xyz`, `flags`, `source`, `conf`. As truth also the layout of BLENDER.md: `tracks`, `visible`, `track_object`,
`track_xyz`. Queries: `t` (N,) frame positions, `xy` (N, 2).
"""

from __future__ import annotations

import io
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from genmojo_core.clip.npz import open_npz
from genmojo_core.errors import GenmojoError
from genmojo_core.store.atomic import write_bytes
from genmojo_core.tracks.model import NONE, OCCLUDED, OUT_OF_VIEW, VISIBLE, PointTracks

MAX_BYTES = 2 << 30  # declared, uncompressed, all arrays of a file together
_OPTIONAL = {"xyz": np.float32, "conf": np.float32, "flags": np.uint8, "source": np.uint8}


def read_arrays(path: str | Path) -> dict[str, np.ndarray]:
    """All arrays of an npz file.

    Raises GenmojoError: "io" missing, "format" no npz, "unsafe_pickle" an array of Python objects, "size" too large.
    """
    if not Path(path).is_file():
        raise GenmojoError("io", "does not exist or is no file", str(path), "check the name")
    archive = open_npz(Path(path))
    declared = sum(header.nbytes for header in archive.headers.values())
    if declared > MAX_BYTES:
        raise GenmojoError("size", f"unpacks to {declared >> 20} MiB, the limit is {MAX_BYTES >> 20}", str(path))
    return {name: archive.array(name) for name in archive.headers}


def write_arrays(path: str | Path, arrays: Mapping[str, np.ndarray]) -> None:
    """Write an npz file, whole or not at all. Raises GenmojoError("io")."""
    memory = io.BytesIO()
    plain: dict[str, Any] = {key: np.asarray(value) for key, value in arrays.items()}
    np.savez_compressed(memory, **plain)
    write_bytes(path, memory.getbuffer())


def write_tracks(tracks: PointTracks, path: str | Path) -> None:
    """Write point tracks. Raises GenmojoError("io"), or "value" if a visible point has no position."""
    write_arrays(path, arrays_of(tracks, str(path)))


def arrays_of(tracks: PointTracks, where: str) -> dict[str, np.ndarray]:
    """The arrays of our layout. Raises GenmojoError("value") if a visible point has no position."""
    lost = tracks.visible & ~np.isfinite(tracks.xy).all(axis=-1)
    if lost.any():
        point, frame = (int(i) for i in np.argwhere(lost)[0])
        raise GenmojoError("value", f"track {point} is visible in frame {frame} but has no position", where)
    arrays: dict[str, np.ndarray] = {"xy": tracks.xy.astype(np.float32), "state": tracks.state.astype(np.uint8),
              "object": tracks.object.astype(np.int64), "size": np.array(tracks.size, np.int64)}  # fmt: skip
    for key, dtype in _OPTIONAL.items():
        value = getattr(tracks, key)
        if value is not None:
            arrays[key] = value.astype(dtype)
    return arrays


def read_tracks(path: str | Path, size: tuple[int, int] | None = None) -> PointTracks:
    """Read point tracks of our layout or a Blender `truth.npz`.

    `size` (width, height) is used where the file has none; without both the truth's points decide nothing and
    GenmojoError("schema") is raised. Raises GenmojoError for everything `read_arrays` and `check_tracks` name.
    """
    return tracks_of(read_arrays(path), size, path)


def tracks_of(arrays: Mapping[str, np.ndarray], size: tuple[int, int] | None, path: str | Path) -> PointTracks:
    """The tracks of arrays that were read, as `read_tracks`."""
    tracks = _from_truth(arrays, size, path) if "tracks" in arrays else _from_ours(arrays, size, path)
    check_tracks(tracks, str(path))
    return tracks


def read_queries(path: str | Path) -> tuple[np.ndarray, np.ndarray]:
    """Query points: t (N,) int64 frame positions and xy (N, 2) float64 raster pixels of the clip."""
    arrays = read_arrays(path)
    _need(arrays, ("t", "xy"), path)
    t, xy = np.atleast_1d(arrays["t"]), np.asarray(arrays["xy"])
    if t.ndim != 1 or xy.shape != (len(t), 2) or t.dtype.kind not in "iuf" or xy.dtype.kind not in "iuf":
        raise GenmojoError("schema", f"t is {t.shape} and xy {xy.shape}, expected (N,) and (N, 2) numbers", str(path))
    if len(t) == 0:
        raise GenmojoError("empty", "holds no query", str(path), "give at least one point")
    if not (np.isfinite(t).all() and np.isfinite(xy).all()) or (t != np.round(t)).any():
        raise GenmojoError("value", "has a time that is no whole frame or a position that is not finite", str(path))
    return t.astype(np.int64), xy.astype(np.float64)


def check_tracks(tracks: PointTracks, where: str) -> None:
    """Raise GenmojoError("schema" or "value") unless shapes agree, states are 0..3 and every state has a position."""
    count, frames = tracks.state.shape if tracks.state.ndim == 2 else (-1, -1)
    if count < 0 or tracks.xy.shape != (count, frames, 2) or tracks.object.shape != (count,):
        raise GenmojoError("schema", f"xy {tracks.xy.shape}, state {tracks.state.shape} and object "
                           f"{tracks.object.shape} do not belong together", where)  # fmt: skip
    if tracks.xyz is not None and tracks.xyz.shape != (count, frames, 3):
        raise GenmojoError("schema", f"xyz has the shape {tracks.xyz.shape}, expected {(count, frames, 3)}", where)
    if (tracks.state > OUT_OF_VIEW).any():
        raise GenmojoError("value", "state has values over 3", where)
    if min(tracks.size) <= 0:
        raise GenmojoError("value", f"the image size is {tracks.size}", where)
    bad = ~(np.abs(tracks.xy) < 1e9).all(axis=-1) & (tracks.state == VISIBLE)
    if bad.any():
        point, frame = (int(i) for i in np.argwhere(bad)[0])
        raise GenmojoError("value", f"track {point} is visible in frame {frame} but has no finite position", where)


def _from_ours(arrays: Mapping[str, np.ndarray], size: tuple[int, int] | None, path: str | Path) -> PointTracks:
    """Our own layout."""
    _need(arrays, ("xy", "state"), path)
    state = _numbers(arrays, "state", path).astype(np.uint8)
    count = len(state)
    owner = _numbers(arrays, "object", path) if "object" in arrays else np.zeros(count)
    optional = {key: _numbers(arrays, key, path).astype(dtype) for key, dtype in _OPTIONAL.items() if key in arrays}
    return PointTracks(_numbers(arrays, "xy", path).astype(np.float32), state, owner.astype(np.int64),
                       _size(arrays, size, path), **optional)  # fmt: skip


def _from_truth(arrays: Mapping[str, np.ndarray], size: tuple[int, int] | None, path: str | Path) -> PointTracks:
    """The layout of exact ground truth: hidden points have positions too; out of the picture is its own state."""
    _need(arrays, ("tracks", "visible"), path)
    xy = _numbers(arrays, "tracks", path).astype(np.float32)
    visible = np.asarray(arrays["visible"]).astype(bool)
    if xy.ndim != 3 or visible.shape != xy.shape[:2]:
        raise GenmojoError("schema", f"tracks {xy.shape} and visible {visible.shape} do not belong together", str(path))
    width, height = _size(arrays, size, path)
    with np.errstate(invalid="ignore"):
        outside = ((xy < 0) | (xy >= np.array([width, height]))).any(axis=-1)
    known = np.isfinite(xy).all(axis=-1)
    state = np.where(visible, VISIBLE, np.where(outside, OUT_OF_VIEW, OCCLUDED))
    owner = _numbers(arrays, "track_object", path) if "track_object" in arrays else np.zeros(len(xy))
    xyz = _numbers(arrays, "track_xyz", path).astype(np.float32) if "track_xyz" in arrays else None
    return PointTracks(xy, np.where(known, state, NONE).astype(np.uint8), owner.astype(np.int64), (width, height), xyz)


def _size(arrays: Mapping[str, np.ndarray], size: tuple[int, int] | None, path: str | Path) -> tuple[int, int]:
    """(width, height) from the file, else as told."""
    if "size" in arrays:
        found = _numbers(arrays, "size", path).reshape(-1)
        if found.shape != (2,):
            raise GenmojoError("schema", f"size has {found.size} numbers, expected width and height", str(path))
        return int(found[0]), int(found[1])
    if size is None:
        raise GenmojoError("schema", "does not say the image size its pixels belong to", str(path),
                           "add size = (width, height)")  # fmt: skip
    return size


def _need(arrays: Mapping[str, np.ndarray], keys: tuple[str, ...], path: str | Path) -> None:
    """Raise GenmojoError("schema") naming what is missing."""
    absent = [key for key in keys if key not in arrays]
    if absent:
        raise GenmojoError("schema", f"has no {' and no '.join(absent)} (it has {', '.join(arrays) or 'nothing'})",
                           str(path))  # fmt: skip


def _numbers(arrays: Mapping[str, np.ndarray], key: str, path: str | Path) -> np.ndarray:
    """An array that holds numbers."""
    if arrays[key].dtype.kind not in "iufb":
        raise GenmojoError("schema", f"{key} holds {arrays[key].dtype}, expected numbers", str(path))
    return arrays[key]
