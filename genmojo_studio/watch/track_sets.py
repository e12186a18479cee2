"""Point tracks of several origins over one clip: predicted, annotated, imported; and how far two of them are apart.

Knows no Qt.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from genmojo_core.store import track_npz
from genmojo_core.tracks.model import NONE, VISIBLE, PointTracks


@dataclass
class TrackSet:
    """Tracks of one origin in source pixels of the clip.

    Args:
        name: for people. kind: "predicted", "annotated" or "imported". tracks: N tracks over T frames.
        shown: drawn or not.
    """

    name: str
    kind: str
    tracks: PointTracks
    shown: bool = True


@dataclass(frozen=True)
class Apart:
    """How far a set is from another, pixels of an image 256 wide and high as track metrics count them.

    Args:
        error: (N, T) distance, NaN where either has no position. partner: (N,) row of the other set, -1 for none.
        state_differs: (N, T) bool, one says visible and the other hidden.
    """

    error: np.ndarray
    partner: np.ndarray
    state_differs: np.ndarray

    def by_frame(self) -> np.ndarray:
        """(T,) mean distance over tracks, NaN in frames without any."""
        known = np.isfinite(self.error)
        total = np.where(known, self.error, 0.0).sum(axis=0)
        return np.where(known.any(axis=0), total / np.maximum(known.sum(axis=0), 1), np.nan)

    def worst(self, count: int) -> list[tuple[int, int, float]]:
        """(track, frame, distance) of the `count` worst places, one per track, worst first."""
        known = np.where(np.isfinite(self.error), self.error, -1.0)
        frames = known.argmax(axis=1)
        rows = [(n, int(frames[n]), float(known[n, frames[n]])) for n in range(len(known)) if known[n].max() >= 0]
        return sorted(rows, key=lambda row: -row[2])[:count]


def apart(tracks: PointTracks, reference: PointTracks, pair_within: float = 6.0) -> Apart:
    """Distances of `tracks` to the track of `reference` that belongs to each.

    Sets of equal length whose first positions agree are paired row by row. Otherwise each track takes the nearest one
    of the same object in the first frame where both have a position, if it lies within `pair_within` pixels at 256.
    """
    a, b = _at_256(tracks), _at_256(reference)
    frames = min(a.shape[1], b.shape[1])
    a, b = a[:, :frames], b[:, :frames]
    partner = _partners(a, b, tracks.object, reference.object, pair_within)
    found = partner >= 0
    error = np.full(a.shape[:2], np.nan)
    error[found] = np.linalg.norm(a[found] - b[partner[found]], axis=-1)
    differs = np.zeros(a.shape[:2], bool)
    seen, other = tracks.state[found, :frames], reference.state[partner[found], :frames]
    differs[found] = (seen != NONE) & (other != NONE) & ((seen == VISIBLE) != (other == VISIBLE))
    return Apart(error, partner, differs)


def read(path: str | Path, size: tuple[int, int]) -> PointTracks:
    """Tracks of a file in pixels of a clip of `size` (width, height): our npz, TAP-Vid's or CoTracker's.

    Raises GenmojoError for whatever the file can cause.
    """
    return track_npz.read(path, size).tracks.resized(*size)


def _at_256(tracks: PointTracks) -> np.ndarray:  # (N, T, 2), NaN where there is no position
    scaled = tracks.xy.astype(np.float64) * (256.0 / tracks.size[0], 256.0 / tracks.size[1])
    return np.where((tracks.state != NONE)[..., None], scaled, np.nan)


def _partners(a: np.ndarray, b: np.ndarray, of_a: np.ndarray, of_b: np.ndarray, within: float) -> np.ndarray:
    both = np.isfinite(a).all(axis=-1)
    if len(a) == len(b):
        at = both & np.isfinite(b).all(axis=-1)
        first = at.argmax(axis=1)
        rows = np.arange(len(a))
        near = np.linalg.norm(a[rows, first] - b[rows, first], axis=-1) <= within
        if at.any() and near[at.any(axis=1)].mean() > 0.9:
            return np.where(at.any(axis=1), rows, -1)
    partner = np.full(len(a), -1)
    for n in range(len(a)):
        candidates = np.flatnonzero(of_b == of_a[n]) if (of_b == of_a[n]).any() else np.arange(len(b))
        for t in np.flatnonzero(both[n]):
            distance = np.linalg.norm(b[candidates, t] - a[n, t], axis=-1)
            if len(distance) and np.isfinite(distance).any():
                best = int(np.nanargmin(distance))
                if distance[best] <= within:
                    partner[n] = candidates[best]
                break
    return partner


@dataclass
class TrackSets:
    """The sets on show, by name."""

    sets: dict[str, TrackSet] = field(default_factory=dict)

    def put(self, found: TrackSet) -> None:
        """Adds a set or replaces the one of its name, keeping whether it is shown."""
        if found.name in self.sets:
            found.shown = self.sets[found.name].shown
        self.sets[found.name] = found

    def drop(self, *kinds: str) -> None:
        """Forgets all sets of some kinds."""
        self.sets = {name: one for name, one in self.sets.items() if one.kind not in kinds}
