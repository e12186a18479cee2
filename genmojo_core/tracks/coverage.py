"""How much of an annotation a person has gone through: what is open in a frame, keys and gaps of tracks."""

from __future__ import annotations

import numpy as np

from genmojo_core.tracks.annotation import CONFIRMED, KEY, Annotation

_CHUNK = 512  # frames looked at in one go, so that long clips with many tracks need no copy of all flags


def open_tracks(annotation: Annotation) -> list[int]:
    """Tracks in which a person has a say: active and not locked."""
    return [info.id for info in annotation.active() if not info.locked]


def open_points(annotation: Annotation, tracks: list[int], frames: np.ndarray) -> np.ndarray:  # (n,) int64
    """How many of the tracks are neither placed nor accepted in each of the frames (n,)."""
    counts = np.zeros(len(frames), np.int64)
    for begin in range(0, len(frames), _CHUNK):
        part = annotation.flags(tracks, frames[begin : begin + _CHUNK])
        counts[begin : begin + _CHUNK] = ((part & (KEY | CONFIRMED)) == 0).sum(axis=1)
    return counts


def key_figures(annotation: Annotation, tracks: list[int]) -> tuple[np.ndarray, np.ndarray]:
    """Number of keys and longest run of frames without one, (n,) int64 each, of n tracks."""
    last = np.full(len(tracks), -1, np.int64)
    counts, gaps = np.zeros(len(tracks), np.int64), np.zeros(len(tracks), np.int64)
    for begin in range(0, annotation.frames, _CHUNK):
        frames = np.arange(begin, min(begin + _CHUNK, annotation.frames))
        keyed = (annotation.flags(tracks, frames) & KEY) > 0
        counts += keyed.sum(axis=0)
        for t in np.flatnonzero(keyed.any(axis=1)):
            here = keyed[t]
            gaps[here] = np.maximum(gaps[here], frames[t] - last[here] - 1)
            last[here] = frames[t]
    return counts, np.maximum(gaps, annotation.frames - last - 1)
