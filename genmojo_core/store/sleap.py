"""SLEAP analysis HDF5: `tracks` on disk (tracks, 2, nodes, frames), NaN where a point is not seen.

SLEAP counts pixels from the centre of the first one. An object is a SLEAP track, a key point a node. It has no states:
ours go along in a dataset of our own that SLEAP ignores.
"""

from __future__ import annotations

import io
from pathlib import Path

import h5py
import numpy as np

from genmojo_core.errors import GenmojoError
from genmojo_core.store.atomic import write_bytes
from genmojo_core.store.safe import json_text, open_hdf5, read_array
from genmojo_core.store.track_sheet import TrackSheet, blank_tracks
from genmojo_core.tracks.model import NONE, OUT_OF_VIEW, VISIBLE

CENTRE = 0.5
_STATE = "genmojo_state"  # (tracks, nodes, frames) uint8
_IDS = "genmojo_object"  # (tracks,) int64
_SIZE = "genmojo_size"  # (2,) int64


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
        file["node_names"] = np.array([str(n).encode() for n in points])
        file["edge_names"] = np.zeros((0, 2), "S1")
        file["edge_inds"] = np.zeros((0, 2), np.int64)
        file["provenance"] = json_text({"program": "genmojo"})
        file[_STATE], file[_IDS] = state, np.array(owners, np.int64)
        file[_SIZE] = np.array(sheet.tracks.size, np.int64)
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
    if _SIZE in arrays:
        size = int(arrays[_SIZE][0]), int(arrays[_SIZE][1])
    if size is None:
        raise GenmojoError("schema", "does not say the image size", str(path), "give --size WIDTHxHEIGHT")
    return _sheet(arrays, size, max(tracks.shape[3], frames or 0), str(path))


def _sheet(arrays: dict[str, np.ndarray], size: tuple[int, int], frames: int, where: str) -> TrackSheet:
    """Names and rows of SLEAP's arrays."""
    tracks = arrays["tracks"]
    owners, _, points, held = tracks.shape
    names = [_text(n) for n in arrays["track_names"]] or ["object 1"]
    nodes = [_text(n) for n in arrays["node_names"]]
    if len(names) != owners or len(nodes) != points:
        raise GenmojoError("schema", f"names {len(names)} tracks and {len(nodes)} nodes for {owners} and {points}",
                           where)  # fmt: skip
    ids = arrays.get(_IDS, np.arange(1, owners + 1)).astype(np.int64)
    numbers = [int(n) if n.isdigit() else k + 1 for k, n in enumerate(nodes)]
    pairs = [(k, p) for k in range(owners) for p in range(points)]
    made = blank_tracks(len(pairs), frames, [int(ids[k]) for k, _ in pairs], size)
    for row, (k, p) in enumerate(pairs):
        made.xy[row, :held] = tracks[k, :, p].T + CENTRE
        made.state[row, :held] = np.where(np.isfinite(made.xy[row, :held]).all(axis=1), VISIBLE, NONE)
        if _STATE in arrays and arrays[_STATE].shape == (owners, points, held):
            told = np.minimum(arrays[_STATE][k, p], OUT_OF_VIEW)
            made.state[row, :held] = np.where(made.state[row, :held] == VISIBLE, VISIBLE,
                                              np.where(told == VISIBLE, NONE, told))  # fmt: skip
    named = {int(i): n for i, n in zip(ids, names, strict=True)}
    return TrackSheet(made, np.array([numbers[p] for _, p in pairs], np.int64), named).without_empty()


def _text(value: bytes | str) -> str:
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value)
