"""CoTracker's result as npz: `tracks` (T, N, 2) or (1, T, N, 2), `visibility` (T, N) or (1, T, N).

Time comes first, and pixels are counted from the centre of the first one: raster coordinates are larger by a half.
CoTracker knows two states only; beside its arrays we keep ours (`state`, `object`, `size`, and `side_arrays`). A
visibility in numbers is a probability: seen above 0.9, or above 0.6 of its product with `confidence` (the thresholds of
CoTracker's offline and online predictors).
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from genmojo_core.errors import GenmojoError
from genmojo_core.store.npz import read_arrays, write_arrays
from genmojo_core.store.side_arrays import side_arrays, with_side_arrays
from genmojo_core.store.track_sheet import TrackSheet
from genmojo_core.tracks.model import NONE, OCCLUDED, OUT_OF_VIEW, VISIBLE, PointTracks

CENTRE = 0.5  # raster minus centre coordinates
_OFFLINE, _ONLINE = 0.9, 0.6


def write(sheet: TrackSheet, path: str | Path) -> None:
    """Write tracks; positions that are unknown are NaN. Raises GenmojoError("io")."""
    tracks = sheet.tracks
    write_arrays(path, {
        "tracks": np.swapaxes(tracks.xy.astype(np.float64) - CENTRE, 0, 1).astype(np.float32),
        "visibility": tracks.visible.T, "state": tracks.state.T, "object": tracks.object,
        "size": np.array(tracks.size, np.int64),
    } | side_arrays(sheet))  # fmt: skip


def read(path: str | Path, size: tuple[int, int] | None = None) -> TrackSheet:
    """Read tracks; `size` (width, height) is used where the file has none. Raises GenmojoError("schema")."""
    return sheet_of(read_arrays(path), size, path)


def sheet_of(arrays: Mapping[str, np.ndarray], size: tuple[int, int] | None, path: str | Path) -> TrackSheet:
    """The sheet of arrays that were read, as `read`."""
    if "tracks" not in arrays or "visibility" not in arrays:
        raise GenmojoError("schema", "has no tracks or no visibility", str(path), "give CoTracker's result as npz")
    xy, seen = (a[0] if a.ndim == rank else a for a, rank in ((arrays["tracks"], 4), (arrays["visibility"], 3)))
    if xy.ndim != 3 or xy.shape[2] != 2 or seen.shape != xy.shape[:2] or xy.dtype.kind != "f":
        raise GenmojoError("schema", f"tracks {xy.shape} and visibility {seen.shape} do not fit", str(path),
                           "store (T, N, 2) and (T, N)")  # fmt: skip
    found = tuple(int(n) for n in arrays["size"]) if "size" in arrays else size
    if found is None or len(found) != 2:
        raise GenmojoError("schema", "does not say the image size", str(path), "give --size WIDTHxHEIGHT")
    tracks = tracks_from_cotracker(xy, _seen(seen, arrays.get("confidence")), (found[0], found[1]))
    count = len(tracks.xy)
    owner = arrays["object"].astype(np.int64) if "object" in arrays else np.zeros(count, np.int64)
    told = arrays["state"].T.astype(np.uint8) if "state" in arrays else tracks.state
    if owner.shape != (count,) or told.shape != tracks.state.shape or (told > OUT_OF_VIEW).any():
        raise GenmojoError("schema", "has object or state of another shape", str(path))
    state = np.where((told == VISIBLE) == tracks.visible, told, tracks.state)  # what was changed since counts
    return with_side_arrays(PointTracks(tracks.xy, state.astype(np.uint8), owner, tracks.size), arrays)


def _seen(visibility: np.ndarray, confidence: np.ndarray | None) -> np.ndarray:  # (T, N) bool
    """Where points are seen, from yes and no or from probabilities."""
    if visibility.dtype.kind != "f" or np.isin(visibility, (0.0, 1.0)).all():
        return visibility.astype(bool)
    if confidence is None or confidence.size != visibility.size:
        return np.asarray(visibility > _OFFLINE)
    return np.asarray(visibility * confidence.reshape(visibility.shape) > _ONLINE)


def tracks_from_cotracker(xy: np.ndarray, seen: np.ndarray, size: tuple[int, int]) -> PointTracks:
    """CoTracker's (T, N, 2) positions and (T, N) bool visibility as PointTracks of object 0."""
    places = np.swapaxes(xy.astype(np.float64) + CENTRE, 0, 1).astype(np.float32)
    with np.errstate(invalid="ignore"):
        outside = ((places < 0) | (places > np.array(size))).any(axis=-1)
    known = np.isfinite(places).all(axis=-1)
    state = np.where(seen.T, VISIBLE, np.where(outside, OUT_OF_VIEW, OCCLUDED))
    return PointTracks(places, np.where(known, state, NONE).astype(np.uint8), np.zeros(len(places), np.int64), size)
