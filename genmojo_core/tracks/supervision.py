"""Which places of annotated tracks an optimisation may follow: those that a person gave, not what a tracker guessed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from genmojo_core.tracks.annotation import CONFIRMED, KEY, UNCERTAIN, Annotation
from genmojo_core.tracks.model import NONE, OCCLUDED, PointTracks


def said_by_people(annotation: Annotation) -> PointTracks | None:
    """What people placed or accepted and are sure of, source pixels; state NONE elsewhere. None without any of it."""
    ids = [info.id for info in annotation.active() if len(annotation.keys(info.id))]
    return sure(annotation.to_tracks(ids)) if ids else None


def sure(tracks: PointTracks) -> PointTracks:
    """The tracks with state NONE where their flags say that no person gave or accepted the place, or was uncertain.

    Tracks without flags, or without any that a person set, are what they are: nothing is known about who made them.
    """
    if tracks.flags is None or not (tracks.flags & (KEY | CONFIRMED)).any():
        return tracks
    known = ((tracks.flags & (KEY | CONFIRMED)) > 0) & ((tracks.flags & UNCERTAIN) == 0)
    return replace(tracks, state=np.where(known, tracks.state, NONE).astype(np.uint8))


def hidden_by_people(tracks: PointTracks) -> np.ndarray:  # (N, T) bool
    """Where a person placed a point that is hidden and was sure of it: a place in the picture behind something.

    Places that were only accepted, and those of tracks without flags, are nobody's word.
    """
    if tracks.flags is None:
        return np.zeros(tracks.state.shape, bool)
    return (tracks.state == OCCLUDED) & ((tracks.flags & KEY) > 0) & ((tracks.flags & UNCERTAIN) == 0)
