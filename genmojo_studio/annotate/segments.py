"""Segments of a track between its keys: their ends, what fills them, and answers cut to one of them."""

from __future__ import annotations

import numpy as np

from genmojo_core.trackers.solver import SolveAnswer
from genmojo_core.tracks.annotation import BY_TRACKER, KEY, Annotation, Cells


def is_key(annotation: Annotation, track: int, frame: int) -> bool:
    """Whether a person placed the point in a frame."""
    return bool(annotation.cells(track, np.array([frame])).flags[0] & KEY)


def by_rule(annotation: Annotation, track: int, start: int | None, end: int | None) -> bool:
    """Whether the segment between two keys is filled by line or hold: no tracker has a say there."""
    return start is not None and end is not None and bool(annotation.track(track).mode[start] != BY_TRACKER)


def frames_between(annotation: Annotation, start: int | None, end: int | None) -> tuple[int, int]:
    """First and last frame of the segment between two keys, of the clip where there is none."""
    return start if start is not None else 0, end if end is not None else annotation.frames - 1


def within(answer: SolveAnswer, span: tuple[int, int]) -> SolveAnswer:
    """Only the frames first..last of an answer."""
    found: dict[int, tuple[np.ndarray, Cells]] = {}
    for track, (frames, cells) in answer.found.items():
        inside = (frames >= span[0]) & (frames <= span[1])
        found[track] = (frames[inside], Cells(*(a[inside] for a in cells.arrays())))
    return SolveAnswer(answer.request, found)
