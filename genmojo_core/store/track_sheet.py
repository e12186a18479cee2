"""Tracks with the names that other programs want: what every track format reads and writes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from genmojo_core.tracks.annotation import Annotation
from genmojo_core.tracks.metrics import select
from genmojo_core.tracks.model import NONE, PointTracks


@dataclass(frozen=True)
class TrackSheet:
    """Point tracks, and names.

    Args:
        tracks: N tracks over T frames, raster pixels of `tracks.size`.
        numbers: (N,) number 1.. of each track's key point within its object.
        object_names: object id -> name. frame_names: T file names or empty.
    """

    tracks: PointTracks
    numbers: np.ndarray
    object_names: Mapping[int, str] = field(default_factory=dict)
    frame_names: tuple[str, ...] = ()

    @staticmethod
    def of_tracks(tracks: PointTracks, frame_names: tuple[str, ...] = ()) -> TrackSheet:
        """Tracks without names: numbered within their object in the order they come."""
        numbers = np.zeros(len(tracks.object), np.int64)
        for owner in np.unique(tracks.object):
            rows = np.flatnonzero(tracks.object == owner)
            numbers[rows] = np.arange(1, len(rows) + 1)
        return TrackSheet(tracks, numbers, {int(i): f"object {i}" for i in np.unique(tracks.object)}, frame_names)

    @staticmethod
    def of_annotation(annotation: Annotation, frame_names: tuple[str, ...] = ()) -> TrackSheet:
        """The active tracks of an annotation, by object and number."""
        infos = sorted(annotation.active(), key=lambda i: (i.object, i.number, i.id))
        tracks = annotation.to_tracks([i.id for i in infos])
        names = {o.id: o.name for o in annotation.objects.values()}
        return TrackSheet(tracks, np.array([i.number for i in infos], np.int64), names, frame_names)

    def without_empty(self) -> TrackSheet:
        """Only the tracks of which anything is known; formats that store grids of objects and points have others."""
        there = (self.tracks.state != NONE).any(axis=1)
        return TrackSheet(select(self.tracks, there), self.numbers[there], self.object_names, self.frame_names)

    def name_of(self, owner: int) -> str:
        """The name of an object."""
        return self.object_names.get(owner, f"object {owner}")

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


def blank_tracks(count: int, frames: int, owners: list[int], size: tuple[int, int]) -> PointTracks:
    """Tracks that know nothing yet."""
    return PointTracks(np.full((count, frames, 2), np.nan, np.float32), np.full((count, frames), NONE, np.uint8),
                       np.array(owners, np.int64), size)  # fmt: skip
