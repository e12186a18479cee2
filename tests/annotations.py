"""Annotations and random edits for tests."""

from __future__ import annotations

import numpy as np

from genmojo_core.tracks import edit_tracks, exchange, keys
from genmojo_core.tracks.annotation import REASONS, TRACKER, Annotation, Cells, ObjectInfo
from genmojo_core.tracks.edits import Edit, set_meta

SIZE = (1920, 1080)


def started(frames: int = 24, objects: int = 2, points: int = 3) -> Annotation:
    """Objects with empty tracks; ids of tracks count from 1."""
    annotation = Annotation(frames, SIZE)
    infos = [ObjectInfo(k + 1, f"thing {k + 1}", k + 1, "chosen") for k in range(objects)]
    edit_tracks.put_objects(annotation, infos).do(annotation)
    for k in range(objects):
        for number in range(points):
            edit_tracks.add_track(annotation, k + 1, number + 1).do(annotation)
    return annotation


def random_edit(annotation: Annotation, rng: np.random.Generator) -> Edit:
    """One of the edits people and machines make, valid for the annotation as it stands."""
    tracks = [i.id for i in annotation.tracks.values() if not i.locked]
    if len(tracks) < 2:
        return edit_tracks.add_track(annotation, 1, 1 + max((i.number for i in annotation.tracks.values()), default=0))
    track = int(rng.choice(tracks))
    t = int(rng.integers(annotation.frames))
    last = int(rng.integers(t, annotation.frames))
    kind = int(rng.integers(12))
    if kind <= 3:
        return keys.set_key(annotation, track, t, tuple(rng.uniform(0, 1000, 2)))
    if kind == 4:
        return keys.set_state(annotation, track, t, last, int(rng.integers(4)))
    if kind == 5:
        return keys.confirm(annotation, tracks, t)
    if kind == 6:
        return keys.set_uncertain(annotation, track, t, last, bool(rng.integers(2)))
    if kind == 7:
        return solution(annotation, track, np.arange(t, last + 1), rng)
    if kind == 8:
        return exchange.swap(annotation, track, int(rng.choice(tracks)), t, last)
    if kind == 9:
        found = annotation.keys(track)
        if not len(found):
            return set_meta(annotation, "consent", f"{t}")
        return keys.remove_key(annotation, track, int(found[0]))
    if kind == 10:
        return edit_tracks.needs_fix(annotation, track, REASONS[t % 6], (t, last), "Bo", "look")
    if rng.integers(3):
        return edit_tracks.update_track(annotation, track, name=f"name {t}")
    return edit_tracks.delete_track(annotation, track)


def solution(annotation: Annotation, track: int, frames: np.ndarray, rng: np.random.Generator) -> Edit:
    """What a tracker might answer."""
    n = len(frames)
    cells = Cells(rng.uniform(0, 1000, (n, 2)).astype(np.float32), rng.integers(1, 4, n).astype(np.uint8),
                  np.zeros(n, np.uint8), np.full(n, TRACKER, np.uint8), rng.uniform(0, 1, n).astype(np.float32),
                  np.zeros(n, np.uint8))  # fmt: skip
    return keys.solved(annotation, track, frames, cells)
