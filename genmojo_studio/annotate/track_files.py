"""Files of tracks by format: which endings they have, how they are read and written. No Qt."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from genmojo_core.errors import GenmojoError
from genmojo_core.sentences import say
from genmojo_core.store import coco, cotracker_npz, cvat, deeplabcut, npz, sleap, tapvid, tracks_hdf5
from genmojo_core.store.track_sheet import TrackSheet
from genmojo_core.tracks import edit_tracks
from genmojo_core.tracks.annotation import CONFIRMED, HUMAN, IMPORT, KEY, Annotation, Cells, ObjectInfo
from genmojo_core.tracks.edits import CellsChange, Edit, MetaChange, ObjectChange, TrackChange
from genmojo_core.tracks.model import NONE

Size = tuple[int, int]


@dataclass(frozen=True)
class Format:
    """A format: title, ending, writer of a sheet, reader for a clip of a size and a number of frames."""

    name: str
    title: str
    ending: str
    write: Callable[[TrackSheet, Path], None]
    read: Callable[[Path, Size, int], TrackSheet]


def _npz(path: Path, size: Size, frames: int) -> TrackSheet:
    """An npz by what it holds: TAP-Vid, CoTracker or ours."""
    from genmojo_core.trackers.seeding import read_any

    return TrackSheet.of_tracks(read_any(path, size))


FORMATS = (
    Format("genmojo", "GenMOJO tracks", "npz", lambda s, p: npz.write_tracks(s.tracks, p), _npz),
    Format("tapvid", "TAP-Vid", "npz", lambda s, p: tapvid.write(s.tracks, p), _npz),
    Format("cotracker", "CoTracker", "npz", cotracker_npz.write, _npz),
    Format("hdf5", "GenMOJO HDF5", "h5", tracks_hdf5.write, lambda p, size, n: tracks_hdf5.read(p)),
    Format("sleap", "SLEAP analysis", "analysis.h5", sleap.write, sleap.read),
    Format("deeplabcut", "DeepLabCut", "csv", deeplabcut.write, deeplabcut.read),
    Format("cvat", "CVAT video", "xml", cvat.write, cvat.read),
    Format("coco", "COCO keypoints", "json", coco.write, lambda p, size, n: coco.read(p)),
)


def by_title(title: str) -> Format:
    """The format of a line of `filters`."""
    return next((f for f in FORMATS if title.startswith(f.title)), FORMATS[0])


def filters() -> str:
    """The lines of a file dialog."""
    return ";;".join(f"{f.title} (*.{f.ending})" for f in FORMATS)


def import_edit(annotation: Annotation, sheet: TrackSheet, person: str) -> Edit:
    """Tracks of a file into an annotation, as one edit: into points that exist where a person has not spoken, else as
    new points of their objects; objects that are missing are made.

    Raises GenmojoError("schema") for another number of frames.
    """
    tracks = sheet.tracks.resized(*annotation.size)
    if tracks.state.shape[1] != annotation.frames:
        raise GenmojoError("schema", f"has {tracks.state.shape[1]} frames, the clip has {annotation.frames}", "import")
    changes: list = []
    order = max((o.order for o in annotation.objects.values()), default=0)
    for owner in np.unique(tracks.object).tolist():
        if owner and owner not in annotation.objects:
            order += 1
            changes.append(ObjectChange(owner, None, ObjectInfo(owner, sheet.name_of(owner), order, "chosen")))
    last = annotation.new_track_id() - 1
    known = {(i.object, i.number): i.id for i in annotation.tracks.values()}
    for row, (owner, number) in enumerate(zip(tracks.object.tolist(), sheet.numbers.tolist(), strict=True)):
        track = known.get((owner, number))
        if track is None:
            last += 1
            track = last
            made = edit_tracks.TrackInfo(track, int(owner), int(number), "", person)
            changes.append(TrackChange(track, None, made))
            before = Cells.empty(annotation.frames)
        else:
            before = annotation.track(track).copy()
        frames, after = _imported(before, tracks.xy[row], tracks.state[row])
        if len(frames):
            kept = Cells(*(a[frames] for a in before.arrays()))
            changes.append(CellsChange(track, frames.astype(np.int32), kept, after))
    changes.append(MetaChange("last_track", annotation.meta.get("last_track"), str(last)))
    return Edit("import", say("import", count=len(tracks.object)), tuple(changes), 0, None)


def _imported(before: Cells, xy: np.ndarray, state: np.ndarray) -> tuple[np.ndarray, Cells]:
    """Frames (n,) that a file may fill, and their cells: those that no person placed, confirmed or made."""
    free = (before.flags & (KEY | CONFIRMED)) == 0
    free &= (before.source != HUMAN) & (state != NONE)
    frames = np.flatnonzero(free)
    count = len(frames)
    small = [state[frames].astype(np.uint8), np.zeros(count, np.uint8), np.full(count, IMPORT, np.uint8)]
    return frames, Cells(np.nan_to_num(xy[frames]).astype(np.float32), small[0], small[1], small[2],
                         np.full(count, 0.5, np.float32), np.zeros(count, np.uint8))  # fmt: skip
