"""Tracks with the names that other programs want: what every track format reads and writes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from genmojo_core.tracks.annotation import Annotation, TrackInfo
from genmojo_core.tracks.metrics import select
from genmojo_core.tracks.model import NONE, PointTracks

Which = Literal["all", "not-rejected", "approved"]
WHICH: tuple[Which, ...] = ("not-rejected", "all", "approved")  # tracks an export takes, by their review


@dataclass(frozen=True)
class TrackSheet:
    """Point tracks, and names.

    Args:
        tracks: N tracks over T frames, raster pixels of `tracks.size`.
        numbers: (N,) number 1.. of each track's key point within its object.
        object_names: object id -> name. frame_names: T file names or empty.
        point_names: N names of the key points ("" for none), or empty.
        reviews: N words, where each track's review stands, or empty. seconds: (T,) time stamps or None.
        owners_told, numbers_told: whether the file says them; else they were made up in reading it.
    """

    tracks: PointTracks
    numbers: np.ndarray
    object_names: Mapping[int, str] = field(default_factory=dict)
    frame_names: tuple[str, ...] = ()
    point_names: tuple[str, ...] = ()
    reviews: tuple[str, ...] = ()
    seconds: np.ndarray | None = None
    owners_told: bool = True
    numbers_told: bool = True

    @staticmethod
    def of_tracks(tracks: PointTracks, frame_names: tuple[str, ...] = ()) -> TrackSheet:
        """Tracks without names: numbered within their object in the order they come."""
        numbers = np.zeros(len(tracks.object), np.int64)
        for owner in np.unique(tracks.object):
            rows = np.flatnonzero(tracks.object == owner)
            numbers[rows] = np.arange(1, len(rows) + 1)
        names = {int(i): f"object {i}" for i in np.unique(tracks.object)}
        return TrackSheet(tracks, numbers, names, frame_names, numbers_told=False)

    @staticmethod
    def of_annotation(annotation: Annotation, frame_names: tuple[str, ...] = (), seconds: np.ndarray | None = None,
                      which: Which = "all") -> TrackSheet:  # fmt: skip
        """Active tracks of an annotation by object and number: all, those not rejected, or the approved ones only."""
        infos = sorted(annotation.active(), key=lambda i: (i.object, i.number, i.id))
        infos = [i for i in infos if taken(i, which)]
        tracks = annotation.to_tracks([i.id for i in infos])
        names = {o.id: o.name for o in annotation.objects.values()}
        return TrackSheet(tracks, np.array([i.number for i in infos], np.int64), names, frame_names,
                          tuple(i.name for i in infos), tuple(i.review for i in infos), seconds)  # fmt: skip

    def select(self, rows: np.ndarray, frames: np.ndarray | None = None) -> TrackSheet:
        """Some of the tracks, (N,) bool or positions, over some frames (positions, default all)."""
        places = np.arange(len(self.numbers))[rows]
        times = np.arange(self.tracks.state.shape[1]) if frames is None else frames
        return replace(
            self, tracks=select(self.tracks, places, times), numbers=self.numbers[places],
            frame_names=tuple(self.frame_name(int(t)) for t in times) if self.frame_names else (),
            point_names=tuple(self.point_names[i] for i in places) if self.point_names else (),
            reviews=tuple(self.reviews[i] for i in places) if self.reviews else (),
            seconds=None if self.seconds is None else self.seconds[times],
        )  # fmt: skip

    def without_empty(self) -> TrackSheet:
        """Only the tracks of which anything is known; formats that store grids of objects and points have others."""
        return self.select((self.tracks.state != NONE).any(axis=1))

    def name_of(self, owner: int) -> str:
        """The name of an object."""
        return self.object_names.get(owner, f"object {owner}")

    def point_name(self, row: int) -> str:
        """The name of a track's key point, "" without one."""
        return self.point_names[row] if self.point_names else ""

    def review(self, row: int) -> str:
        """Where a track's review stands, "" where nobody says."""
        return self.reviews[row] if self.reviews else ""

    def frame_name(self, t: int) -> str:
        """The file name of a frame."""
        return self.frame_names[t] if t < len(self.frame_names) else f"{t:05d}.png"

    def grid(self) -> tuple[list[int], list[int], np.ndarray]:
        """Object ids, key point numbers, and the row of each (objects, points), -1 where there is none."""
        owners = sorted({int(i) for i in self.tracks.object})
        points = sorted({int(n) for n in self.numbers})
        rows = np.full((len(owners), len(points)), -1, np.int64)
        for row, (owner, number) in enumerate(zip(self.tracks.object, self.numbers, strict=True)):
            rows[owners.index(int(owner)), points.index(int(number))] = row
        return owners, points, rows

    def part_names(self, points: list[int], rows: np.ndarray) -> list[str]:
        """What to call key points that all objects share: their name where all agree on one, else their number.

        points: P numbers. rows: (K, P) as of `grid`, or those of one object (1, P).
        """
        found = [{self.point_name(int(r)) for r in column if r >= 0} for column in rows.T]
        agreed = [next(iter(names)) if len(names) == 1 else "" for names in found]
        plain = [name if name and not name.isdigit() and agreed.count(name) == 1 else "" for name in agreed]
        return [name or str(number) for name, number in zip(plain, points, strict=True)]


def taken(info: TrackInfo, which: Which) -> bool:
    """Whether an export of these takes a track."""
    return which == "all" or (info.review == "approved" if which == "approved" else info.review != "rejected")


def blank_tracks(count: int, frames: int, owners: list[int], size: tuple[int, int]) -> PointTracks:
    """Tracks that know nothing yet."""
    return PointTracks(np.full((count, frames, 2), np.nan, np.float32), np.full((count, frames), NONE, np.uint8),
                       np.array(owners, np.int64), size)  # fmt: skip
