"""Good tracks with known errors put in: jumps, drifts, swaps, wrong occlusions."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from genmojo_core.tracks import edit_tracks, keys
from genmojo_core.tracks.annotation import KEY, TRACKER, Annotation, Cells, ObjectInfo
from genmojo_core.tracks.model import OCCLUDED, VISIBLE, PointTracks
from genmojo_core.tracks.suspicion import Spot


@dataclass(frozen=True)
class Injected:
    """An error: kind, track, frames first..last."""

    kind: str
    track: int
    first: int
    last: int


def annotated(truth: PointTracks, rng: np.random.Generator, points: int = 10, noise: float = 0.7) -> Annotation:
    """True tracks seen in frame 0: a key there and in every sixth frame, a tracker's small errors elsewhere."""
    annotation = Annotation(truth.xy.shape[1], truth.size)
    for owner in np.unique(truth.object):
        edit_tracks.put_objects(annotation, [ObjectInfo(int(owner), f"o{owner}", int(owner), "chosen")]).do(annotation)
        rows = np.flatnonzero((truth.object == owner) & truth.visible[:, 0])[:points]
        for number, row in enumerate(rows):
            made = edit_tracks.add_track(annotation, int(owner), number + 1)
            made.do(annotation)
            track = made.track
            for t in range(0, annotation.frames, 6):
                if truth.visible[row, t]:
                    keys.set_key(annotation, track, t, tuple(truth.xy[row, t])).do(annotation)
            frames = np.arange(1, annotation.frames)
            n = len(frames)
            xy = truth.xy[row, 1:] + rng.normal(0, noise, (n, 2))
            none = np.zeros(n, np.uint8)
            cells = Cells(xy.astype(np.float32), truth.state[row, 1:], none, np.full(n, TRACKER, np.uint8),
                          rng.uniform(0.5, 1, n).astype(np.float32), none)  # fmt: skip
            keys.solved(annotation, track, frames, cells).do(annotation)
    return annotation


def inject(annotation: Annotation, rng: np.random.Generator, count: int) -> list[Injected]:
    """`count` errors, one per track at most, of the four kinds in turn, each where the point is seen."""
    done: list[Injected] = []
    free = list(rng.permutation(list(annotation.tracks)))
    for number in range(count):
        kind = ("jump", "drift", "swap", "occlusion")[number % 4]
        error = next((e for track in list(free) if (e := _one(annotation, rng, kind, int(track), free))), None)
        if error is not None:
            done.append(error)
            free.remove(error.track)
    return done


def found_share(spots: list[Spot], errors: list[Injected], share: float = 0.2) -> tuple[float, dict[str, float]]:
    """Share of the errors that a spot in the first `share` of the queue touches; and by kind."""
    top = spots[: int(np.ceil(share * len(spots)))]
    hit = [any(s.track == e.track and s.first <= e.last and s.last >= e.first for s in top) for e in errors]
    by_kind = {k: float(np.mean([h for h, e in zip(hit, errors, strict=True) if e.kind == k]))
               for k in {e.kind for e in errors}}  # fmt: skip
    return float(np.mean(hit)), by_kind


def _one(annotation: Annotation, rng: np.random.Generator, kind: str, track: int, free: list[int]) -> Injected | None:
    """An error between two keys of a track, keys left alone."""
    cells = annotation.track(track).copy()
    is_key = (cells.flags & KEY) > 0
    starts = [t for t in np.flatnonzero(is_key) if (cells.state[t : t + 6] == VISIBLE).all() and t + 6 <= len(cells)]
    if not starts:
        return None
    first = int(rng.choice(starts)) + 1
    last = first + 4
    run = np.arange(first, last + 1)
    away = rng.normal(size=2)
    away /= np.linalg.norm(away)
    if kind == "jump":
        first = last = int(rng.integers(first, last + 1))
        cells.xy[first] += away * rng.uniform(10, 40)
    elif kind == "drift":
        cells.xy[run] += (np.arange(1, 6) / 5 * rng.uniform(12, 30))[:, None] * away
    elif kind == "swap":
        partner = _partner(annotation, track, first, free)
        if partner is None:
            return None
        other = annotation.track(partner).copy()
        cells.xy[run], other.xy[run] = other.xy[run], cells.xy[run].copy()
        annotation.write_cells(partner, np.arange(annotation.frames), other)
        free.remove(partner)
    else:
        cells.state[run] = OCCLUDED
    annotation.write_cells(track, np.arange(annotation.frames), cells)
    return Injected(kind, track, first, last)


def _partner(annotation: Annotation, track: int, t: int, free: list[int]) -> int | None:
    here = annotation.track(track).xy[t]
    owner = annotation.tracks[track].object
    for other in free:
        gap = np.linalg.norm(annotation.track(int(other)).xy[t] - here)
        if other != track and annotation.tracks[int(other)].object == owner and gap > 15:
            return int(other)
    return None
