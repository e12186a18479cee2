"""TAP-Vid at the border: points in 0..1 and `occluded` against our raster pixels and states (ANNOTATOR.md section 3).

Only npz; TAP-Vid's own pickles are never opened here. Arrays: `points` (N, T, 2) float32 = (x / W, y / H) exactly,
`occluded` (N, T) bool, optionally `video` (T, H, W, 3) uint8, and beside them our `object`, `uncertain`, `size`,
`state` (N, T), `xy` (N, T, 2) before it was clipped, and those of `side_arrays`. What another program has changed
since counts: our state and place hold only where they still say what `occluded` and `points` say.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from genmojo_core.errors import GenmojoError
from genmojo_core.store.npz import read_arrays, write_arrays
from genmojo_core.store.side_arrays import side_arrays, with_side_arrays
from genmojo_core.store.track_sheet import TrackSheet
from genmojo_core.tracks.annotation import UNCERTAIN
from genmojo_core.tracks.model import NONE, OCCLUDED, OUT_OF_VIEW, VISIBLE, PointTracks

_SAME = 1e-6  # of the picture: a place of ours and one of `points` this near are the same


def write(sheet: TrackSheet, path: str | Path, video: np.ndarray | None = None) -> None:
    """Write tracks as TAP-Vid npz: occluded = not visible; positions outside are clipped here and nowhere else.

    `video` (T, H, W, 3) uint8 goes along if given. Raises GenmojoError("value") if a visible point has no position,
    "io" where the file cannot be written.
    """
    tracks = sheet.tracks
    if (tracks.visible & ~np.isfinite(tracks.xy).all(axis=-1)).any():
        raise GenmojoError("value", "a visible point has no position", str(path))
    flags = np.zeros_like(tracks.state) if tracks.flags is None else tracks.flags
    arrays = {
        "points": _clipped(tracks.xy, tracks.size),
        "occluded": ~tracks.visible,
        "object": tracks.object,
        "uncertain": (flags & UNCERTAIN) > 0,
        "size": np.array(tracks.size, np.int64),
        "state": tracks.state.astype(np.uint8),
        "xy": tracks.xy.astype(np.float32),
    }
    if video is not None:
        arrays["video"] = video
    write_arrays(path, arrays | side_arrays(sheet))


def clipped_count(tracks: PointTracks) -> int:
    """How many visible points lie outside the picture; a TAP-Vid file has them at its border."""
    outside = ((tracks.xy < 0) | (tracks.xy > np.array(tracks.size))).any(axis=-1)
    return int((outside & tracks.visible).sum())


def read(path: str | Path, size: tuple[int, int] | None = None) -> TrackSheet:
    """Read TAP-Vid npz into raster pixels of `size` (width, height), or of the file's own `size` or `video`.

    Raises GenmojoError("schema") if arrays are missing, do not fit or no size is known.
    """
    return sheet_of(read_arrays(path), size, path)


def sheet_of(arrays: Mapping[str, np.ndarray], size: tuple[int, int] | None, path: str | Path) -> TrackSheet:
    """The sheet of arrays that were read, as `read`."""
    if "points" not in arrays or "occluded" not in arrays:
        raise GenmojoError("schema", "has no points or no occluded", str(path), "give a TAP-Vid npz")
    points, occluded = arrays["points"], arrays["occluded"].astype(bool)
    if points.ndim != 3 or points.shape[2] != 2 or occluded.shape != points.shape[:2]:
        raise GenmojoError("schema", f"points {points.shape} and occluded {occluded.shape} do not fit", str(path))
    if "size" in arrays:
        size = int(arrays["size"][0]), int(arrays["size"][1])
    elif size is None and "video" in arrays:
        size = int(arrays["video"].shape[2]), int(arrays["video"].shape[1])
    if size is None:
        raise GenmojoError("schema", "does not say the image size", str(path), "add size = (width, height)")
    tracks = _with_ours(_plain(points, occluded, size), points, arrays)
    owner = arrays["object"].astype(np.int64) if "object" in arrays else tracks.object
    if owner.shape != tracks.object.shape:
        raise GenmojoError("schema", f"object has the shape {owner.shape} for {len(points)} tracks", str(path))
    doubt = arrays["uncertain"] if "uncertain" in arrays and arrays["uncertain"].shape == occluded.shape else None
    flags = None if doubt is None else np.where(doubt.astype(bool), UNCERTAIN, 0).astype(np.uint8)
    return with_side_arrays(PointTracks(tracks.xy, tracks.state, owner, size, flags=flags), arrays)


def _plain(points: np.ndarray, occluded: np.ndarray, size: tuple[int, int]) -> PointTracks:
    """What points (N, T, 2) and occluded (N, T) alone say."""
    xy = (points * np.array(size)).astype(np.float32)
    outside = ((points <= 0) | (points >= 1)).any(axis=-1)
    state = np.where(~occluded, VISIBLE, np.where(outside, OUT_OF_VIEW, OCCLUDED))
    known = np.isfinite(xy).all(axis=-1)
    return PointTracks(xy, np.where(known, state, NONE).astype(np.uint8), np.zeros(len(xy), np.int64), size)


def _with_ours(tracks: PointTracks, points: np.ndarray, arrays: Mapping[str, np.ndarray]) -> PointTracks:
    """Our own states and places, where `occluded` and `points` still agree with them."""
    xy, state, shape = tracks.xy, tracks.state, tracks.state.shape
    if "state" in arrays and arrays["state"].shape == shape and arrays["state"].dtype.kind in "iu":
        told = arrays["state"]
        agrees = (told <= OUT_OF_VIEW) & ((told == VISIBLE) == (state == VISIBLE))
        state = np.where(agrees, told, state).astype(np.uint8)
    if "xy" in arrays and arrays["xy"].shape == xy.shape and arrays["xy"].dtype.kind == "f":
        there = arrays["xy"].astype(np.float32)
        same = (np.abs(_clipped(there, tracks.size) - points) <= _SAME).all(axis=-1)
        xy = np.where(same[..., None], there, xy)
    xy = np.where((state == NONE)[..., None], np.float32(np.nan), xy)
    return PointTracks(xy, state, tracks.object, tracks.size)


def _clipped(xy: np.ndarray, size: tuple[int, int]) -> np.ndarray:
    """Raster pixels as 0..1 of the picture, float32; what has no place is at 0, 0."""
    known = np.isfinite(xy).all(axis=-1)
    return np.clip(np.where(known[..., None], xy / np.array(size, np.float32), 0.0), 0.0, 1.0).astype(np.float32)
