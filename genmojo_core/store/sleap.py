"""SLEAP analysis HDF5: `tracks` on disk (tracks, 2, nodes, frames), NaN where a point is not seen.

SLEAP counts pixels from the centre of the first one. An object is a SLEAP track, a key point a node. It has no states
and no hidden places: ours go along in datasets of our own that SLEAP ignores. What SLEAP has changed since counts.
"""

from __future__ import annotations

import io
from dataclasses import replace
from pathlib import Path

import h5py
import numpy as np

from genmojo_core.errors import GenmojoError
from genmojo_core.store.atomic import write_bytes
from genmojo_core.store.safe import json_text, open_hdf5, read_array
from genmojo_core.store.side_arrays import cell_arrays, with_cells
from genmojo_core.store.track_sheet import TrackSheet, blank_tracks
from genmojo_core.tracks.model import NONE, OUT_OF_VIEW, VISIBLE, PointTracks

CENTRE = 0.5
_OURS = "genmojo_"  # state, flags, source (tracks, nodes, frames) uint8, conf float32, xy (..., 2) raster px
_CELLS = {"state": np.uint8, "flags": np.uint8, "source": np.uint8, "conf": np.float32}
_TEXTS = ("point_name", "review")  # (tracks, nodes)


def write(sheet: TrackSheet, path: str | Path) -> None:
    """Write tracks. Raises GenmojoError("io")."""
    owners, points, rows = sheet.grid()
    there = rows >= 0
    xy = np.where(there[..., None, None], sheet.tracks.xy[rows], np.nan).astype(np.float64)  # (K, P, T, 2)
    state = np.where(there[..., None], sheet.tracks.state[rows], NONE).astype(np.uint8)
    places = np.where((state == VISIBLE)[..., None], xy - CENTRE, np.nan)
    seen = (state == VISIBLE).any(axis=1)  # (K, T)
    memory = io.BytesIO()
    with h5py.File(memory, "w") as file:
        file["tracks"] = np.transpose(places, (0, 3, 1, 2))
        file["track_occupancy"] = seen.T.astype(np.uint8)
        file["point_scores"] = np.where(state == VISIBLE, 1.0, np.nan)
        file["instance_scores"] = np.where(seen, 1.0, np.nan)
        file["tracking_scores"] = np.where(seen, 1.0, np.nan)
        file["track_names"] = np.array([sheet.name_of(i).encode() for i in owners])
        file["node_names"] = np.array([name.encode() for name in sheet.part_names(points, rows)])
        file["edge_names"] = np.zeros((0, 2), "S1")
        file["edge_inds"] = np.zeros((0, 2), np.int64)
        file["provenance"] = json_text({"program": "genmojo"})
        for name, array in _own_arrays(sheet, rows, xy, state).items():
            file[_OURS + name] = array
        file[_OURS + "object"], file[_OURS + "number"] = np.array(owners, np.int64), np.array(points, np.int64)
        file[_OURS + "size"] = np.array(sheet.tracks.size, np.int64)
    write_bytes(path, memory.getbuffer())


def read(path: str | Path, size: tuple[int, int] | None = None, frames: int | None = None) -> TrackSheet:
    """Read tracks; SLEAP's file says neither the image size nor how many frames follow its last labelled one.

    Raises GenmojoError("schema") for other files, or without a size; everything `open_hdf5` raises.
    """
    with open_hdf5(path) as file:
        for name in ("tracks", "track_names", "node_names"):
            if name not in file:
                raise GenmojoError("schema", f"has no {name}", str(path), "give a SLEAP analysis file")
        arrays = {name: read_array(file[name], f"{path}:{name}") for name in (*file,) if name != "provenance"}
    tracks = arrays["tracks"]
    if tracks.ndim != 4 or tracks.shape[1] != 2 or tracks.dtype.kind != "f":
        raise GenmojoError("schema", f"tracks have the shape {tracks.shape}, expected (tracks, 2, nodes, frames)",
                           str(path))  # fmt: skip
    if _OURS + "size" in arrays:
        size = int(arrays[_OURS + "size"][0]), int(arrays[_OURS + "size"][1])
    if size is None:
        raise GenmojoError("schema", "does not say the image size", str(path), "give --size WIDTHxHEIGHT")
    return _sheet(arrays, size, max(tracks.shape[3], frames or 0), str(path))


def _own_arrays(sheet: TrackSheet, rows: np.ndarray, xy: np.ndarray, state: np.ndarray) -> dict[str, np.ndarray]:
    """What SLEAP has no place for, by our names; rows (K, P) as of the sheet's grid."""
    there = rows >= 0
    found: dict[str, np.ndarray] = {"state": state, "xy": xy.astype(np.float32)}
    for name, array in cell_arrays(sheet.tracks).items():
        found[name] = np.where(there[..., None], array[rows], 0).astype(array.dtype)
    for name, words in (("point_name", sheet.point_names), ("review", sheet.reviews)):
        if any(words):
            found[name] = np.array([[words[r].encode() if r >= 0 else b"" for r in line] for line in rows])
    return found


def _sheet(arrays: dict[str, np.ndarray], size: tuple[int, int], frames: int, where: str) -> TrackSheet:
    """Names and rows of SLEAP's arrays."""
    tracks = arrays["tracks"]
    owners, _, points, held = tracks.shape
    names = [_text(n) for n in arrays["track_names"]] or ["object 1"]
    nodes = [_text(n) for n in arrays["node_names"]]
    if len(names) != owners or len(nodes) != points:
        raise GenmojoError("schema", f"names {len(names)} tracks and {len(nodes)} nodes for {owners} and {points}",
                           where)  # fmt: skip
    told = _OURS + "object" in arrays and arrays[_OURS + "object"].shape == (owners,)
    ids = (arrays[_OURS + "object"] if told else np.arange(1, owners + 1)).astype(np.int64)
    numbers = np.array([int(n) if n.isdigit() else k + 1 for k, n in enumerate(nodes)], np.int64)
    if _OURS + "number" in arrays and arrays[_OURS + "number"].shape == (points,):
        numbers = arrays[_OURS + "number"].astype(np.int64)
    made = blank_tracks(owners * points, frames, np.repeat(ids, points).tolist(), size)
    made.xy[:, :held] = np.transpose(tracks, (0, 2, 3, 1)).reshape(-1, held, 2) + CENTRE
    made.state[np.isfinite(made.xy).all(axis=2)] = VISIBLE
    texts = {key: arrays.get(_OURS + key) for key in _TEXTS}
    words = {key: tuple(_text(w) for w in found.reshape(-1)) for key, found in texts.items()
             if found is not None and found.shape == (owners, points)}  # fmt: skip
    plain = tuple("" if n.isdigit() else n for n in nodes) * owners
    return replace(
        TrackSheet(_with_ours(made, arrays, held), np.tile(numbers, owners),
                   {int(i): n for i, n in zip(ids, names, strict=True)}, owners_told=told),
        point_names=words.get("point_name", plain if any(plain) else ()), reviews=words.get("review", ()),
    ).without_empty()  # fmt: skip


def _with_ours(made: PointTracks, arrays: dict[str, np.ndarray], held: int) -> PointTracks:
    """Our states, hidden places and flags in the first `held` frames, where SLEAP's own arrays leave room for them."""
    count, frames = made.state.shape
    cells = {}
    for name, dtype in _CELLS.items():
        found = arrays.get(_OURS + name)
        if found is not None and found.ndim == 3 and found.size == count * held and found.shape[2] == held:
            cells[name] = np.zeros((count, frames), dtype)
            cells[name][:, :held] = found.reshape(count, held).astype(dtype)
    seen = made.state == VISIBLE
    if "state" in cells:
        told = np.minimum(cells.pop("state"), OUT_OF_VIEW)
        made.state[:] = np.where(seen, VISIBLE, np.where(told == VISIBLE, NONE, told))
    there = arrays.get(_OURS + "xy")
    if there is not None and there.size == 2 * count * held and there.dtype.kind == "f":
        hidden = (made.state != NONE) & ~seen
        hidden[:, held:] = False
        made.xy[hidden] = there.reshape(count, held, 2)[hidden[:, :held]]
    return with_cells(made, cells)


def _text(value: bytes | str) -> str:
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value)
