"""Track sheets as npz: ours with all names, and whichever layout a file turns out to have."""

from __future__ import annotations

from pathlib import Path

from genmojo_core.store import cotracker_npz, npz, tapvid
from genmojo_core.store.side_arrays import side_arrays, with_side_arrays
from genmojo_core.store.track_sheet import TrackSheet


def write(sheet: TrackSheet, path: str | Path) -> None:
    """Write our npz with names, numbers and reviews. Raises as `npz.write_tracks`."""
    npz.write_arrays(path, npz.arrays_of(sheet.tracks, str(path)) | side_arrays(sheet))


def read(path: str | Path, size: tuple[int, int] | None = None) -> TrackSheet:
    """Tracks of an npz by its arrays: TAP-Vid (`points`), CoTracker (`visibility`) or ours. Raises GenmojoError."""
    arrays = npz.read_arrays(path)
    if "points" in arrays and "occluded" in arrays:
        return tapvid.sheet_of(arrays, size, path)
    if "tracks" in arrays and "visibility" in arrays:
        return cotracker_npz.sheet_of(arrays, size, path)
    return with_side_arrays(npz.tracks_of(arrays, size, path), arrays)
