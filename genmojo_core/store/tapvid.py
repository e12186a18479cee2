"""TAP-Vid at the border: points in 0..1 and `occluded` against our raster pixels and states (ANNOTATOR.md section 3).

Only npz; TAP-Vid's own pickles are never opened here. Arrays: `points` (N, T, 2) float32 = (x / W, y / H) exactly,
`occluded` (N, T) bool, optionally `video` (T, H, W, 3) uint8, and beside them our `object`, `uncertain`, `size`.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from genmojo_core.errors import GenmojoError
from genmojo_core.store.npz import read_arrays, write_arrays
from genmojo_core.tracks.model import NONE, OCCLUDED, OUT_OF_VIEW, VISIBLE, PointTracks

_UNCERTAIN = 2  # flag bit of PointTracks.flags


def write(tracks: PointTracks, path: str | Path, video: np.ndarray | None = None) -> None:
    """Write tracks as TAP-Vid npz: occluded = not visible; positions outside are clipped here and nowhere else.

    `video` (T, H, W, 3) uint8 goes along if given. Raises GenmojoError("value") if a visible point has no position,
    "io" where the file cannot be written.
    """
    known = np.isfinite(tracks.xy).all(axis=-1)
    if (tracks.visible & ~known).any():
        raise GenmojoError("value", "a visible point has no position", str(path))
    points = np.where(known[..., None], tracks.xy / np.array(tracks.size, np.float32), 0.0)
    flags = np.zeros_like(tracks.state) if tracks.flags is None else tracks.flags
    arrays = {
        "points": np.clip(points, 0.0, 1.0).astype(np.float32),
        "occluded": ~tracks.visible,
        "object": tracks.object,
        "uncertain": (flags & _UNCERTAIN) > 0,
        "size": np.array(tracks.size, np.int64),
    }
    if video is not None:
        arrays["video"] = video
    write_arrays(path, arrays)


def read(path: str | Path, size: tuple[int, int] | None = None) -> PointTracks:
    """Read TAP-Vid npz into raster pixels of `size` (width, height), or of the file's own `size` or `video`.

    Raises GenmojoError("schema") if arrays are missing, do not fit or no size is known.
    """
    arrays = read_arrays(path)
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
    xy = (points * np.array(size)).astype(np.float32)
    known = np.isfinite(xy).all(axis=-1)
    outside = ((points <= 0) | (points >= 1)).any(axis=-1)
    state = np.where(~occluded, VISIBLE, np.where(outside, OUT_OF_VIEW, OCCLUDED))
    owner = arrays.get("object", np.zeros(len(points)))
    doubt = arrays["uncertain"] if "uncertain" in arrays and arrays["uncertain"].shape == occluded.shape else None
    flags = None if doubt is None else np.where(doubt.astype(bool), _UNCERTAIN, 0).astype(np.uint8)
    return PointTracks(xy, np.where(known, state, NONE).astype(np.uint8), owner.astype(np.int64), size, flags=flags)
