"""What our npz files keep beside the arrays of a format: numbers, names, reviews, flags, time stamps.

`number` (N,), `point_name` (N,) and `review` (N,) texts, `object_id` (K,) with `object_name` (K,), `frame_name` (T,),
`seconds` (T,), and `flags`, `source` (N, T) uint8, `conf` (N, T) float32. All are optional; other programs ignore them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from genmojo_core.store.track_sheet import TrackSheet
from genmojo_core.tracks.model import PointTracks

_CELLS = {"flags": np.uint8, "source": np.uint8, "conf": np.float32}


def side_arrays(sheet: TrackSheet) -> dict[str, np.ndarray]:
    """The arrays of a sheet that its format has no place for."""
    owners = sorted({int(i) for i in sheet.tracks.object})
    found: dict[str, np.ndarray] = {"number": sheet.numbers.astype(np.int64)}
    texts = {"object_name": [sheet.name_of(i) for i in owners], "point_name": list(sheet.point_names),
             "review": list(sheet.reviews), "frame_name": list(sheet.frame_names)}  # fmt: skip
    found |= {key: np.array(words, np.str_) for key, words in texts.items() if any(words)}
    if owners:
        found["object_id"] = np.array(owners, np.int64)
    if sheet.seconds is not None:
        found["seconds"] = sheet.seconds.astype(np.float64)
    return found | cell_arrays(sheet.tracks)


def cell_arrays(tracks: PointTracks) -> dict[str, np.ndarray]:
    """flags, source and conf (N, T), those that are known."""
    return {key: np.asarray(getattr(tracks, key), dtype) for key, dtype in _CELLS.items()
            if getattr(tracks, key) is not None}  # fmt: skip


def with_cells(tracks: PointTracks, cells: Mapping[str, np.ndarray]) -> PointTracks:
    """The tracks with flags, source and conf (N, T) as far as they are given."""
    given: dict[str, Any] = {key: cells[key].astype(dtype) for key, dtype in _CELLS.items() if key in cells}
    return replace(tracks, **given)


def with_side_arrays(tracks: PointTracks, arrays: Mapping[str, np.ndarray]) -> TrackSheet:
    """Tracks of a format with what lies beside them; arrays of another shape are somebody else's and ignored."""
    count, frames = tracks.state.shape
    cells = {key: arrays[key] for key in _CELLS if _numbers(arrays, key, (count, frames))}
    sheet = TrackSheet.of_tracks(with_cells(tracks, cells))
    names = dict(sheet.object_names)
    if "object_id" in arrays and _texts(arrays, "object_name", arrays["object_id"].size):
        names |= dict(zip(arrays["object_id"].reshape(-1).tolist(), arrays["object_name"].tolist(), strict=True))
    told = _numbers(arrays, "number", (count,))
    return replace(
        sheet, numbers=arrays["number"].astype(np.int64) if told else sheet.numbers, numbers_told=told,
        object_names=names, frame_names=_texts(arrays, "frame_name", frames),
        point_names=_texts(arrays, "point_name", count), reviews=_texts(arrays, "review", count),
        seconds=arrays["seconds"].astype(np.float64) if _numbers(arrays, "seconds", (frames,)) else None,
    )  # fmt: skip


def _numbers(arrays: Mapping[str, np.ndarray], key: str, shape: tuple[int, ...]) -> bool:
    """Whether an array of numbers of that shape is there."""
    return key in arrays and arrays[key].shape == shape and arrays[key].dtype.kind in "iufb"


def _texts(arrays: Mapping[str, np.ndarray], key: str, count: int) -> tuple[str, ...]:
    """The texts of an array of that length, none if there is no such array."""
    found = arrays.get(key)
    return tuple(found.tolist()) if found is not None and found.shape == (count,) and found.dtype.kind == "U" else ()
