"""What the dope sheet shows of a track: its cells in memory of their own, put together per column of pixels. No Qt."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from genmojo_core.tracks.annotation import CONFIRMED, KEY, UNCERTAIN
from genmojo_core.tracks.model import NONE, OCCLUDED, OUT_OF_VIEW, VISIBLE
from genmojo_studio.annotate.session import Session

_KEPT = 200  # tracks whose cells stay copied
_RANK = np.array([3, 0, 1, 2], np.uint8)  # by state; where several frames share a column the worst is shown
_RANKED = np.array([VISIBLE, OCCLUDED, OUT_OF_VIEW, NONE], np.uint8)


@dataclass(frozen=True)
class Line:
    """A track over all T frames: state, flags (uint8), sure (float32, 1 where a person spoke), keys (n,) and the mode
    (n,) of the segment that begins at each."""

    state: np.ndarray
    flags: np.ndarray
    sure: np.ndarray
    keys: np.ndarray
    modes: np.ndarray


@dataclass(frozen=True)
class Columns:
    """One value per column of pixels: worst state, highest doubt, least confidence, whether any is uncertain."""

    state: np.ndarray
    doubt: np.ndarray
    sure: np.ndarray
    uncertain: np.ndarray


class Lines:
    """Copies of tracks as `Line`; in an annotation the frames of a track lie far apart."""

    def __init__(self, session: Session) -> None:
        self._session = session
        self._lines: dict[int, Line] = {}

    def forget(self, tracks: set[int]) -> None:
        """Some tracks were changed."""
        for track in tracks:
            self._lines.pop(track, None)

    def of(self, track: int) -> Line:
        """A track as it stands. Raises GenmojoError("argument") if there is none of that id."""
        line = self._lines.get(track)
        if line is None:
            cells = self._session.annotation.track(track)
            flags = np.array(cells.flags)
            keys = np.flatnonzero(flags & KEY)
            sure = np.where(flags & (KEY | CONFIRMED), np.float32(1), cells.conf)
            line = Line(np.array(cells.state), flags, sure, keys, np.array(cells.mode[keys]))
            if len(self._lines) >= _KEPT:
                self._lines.pop(next(iter(self._lines)))
            self._lines[track] = line
        return line


def columns(line: Line, doubt: np.ndarray | None, view: tuple[float, float], width: int) -> Columns:
    """A line in `width` columns of pixels.

    Args:
        doubt: (T,) suspicion 0..1, None where nobody knows it.
        view: first frame on show and how many are, neither need be whole.
        width: pixels of the screen, at least 1.

    A column that covers several frames shows the worst state, the highest doubt and the least confidence of them.
    """
    last = len(line.state) - 1
    edges = view[0] + np.arange(width + 1) * (view[1] / width)
    begin = np.clip(np.floor(edges[:-1] + 1e-9).astype(int), 0, last)
    known = doubt if doubt is not None and len(doubt) == last + 1 else None
    marked = (line.flags & UNCERTAIN) > 0
    if view[1] <= width:
        hot = np.zeros(width) if known is None else known[begin]
        return Columns(line.state[begin], hot, line.sure[begin], marked[begin])
    end = min(int(np.ceil(edges[-1] - 1e-9)), last + 1)
    first, at = int(begin[0]), begin - begin[0]
    run = slice(first, max(end, first + 1))
    worst = np.maximum.reduceat(_RANK[line.state[run]], at)
    hot = np.zeros(width) if known is None else np.maximum.reduceat(known[run], at)
    uncertain = np.logical_or.reduceat(marked[run], at)
    return Columns(_RANKED[worst], hot, np.minimum.reduceat(line.sure[run], at), uncertain)


def segments(line: Line, view: tuple[float, float], least: float) -> list[tuple[int, int, int]]:
    """Segments (key, next key, mode) of a line that reach into the view and are `least` frames long at least."""
    if len(line.keys) < 2:
        return []
    first, end, modes = line.keys[:-1], line.keys[1:], line.modes[:-1]
    shown = (end + 1 > view[0]) & (first < view[0] + view[1]) & (end - first >= least)
    return [(int(a), int(b), int(m)) for a, b, m in zip(first[shown], end[shown], modes[shown], strict=True)]


def apart(frames: np.ndarray, view: tuple[float, float], least: float) -> np.ndarray:
    """Of rising frames those in the view, and of those closer than `least` frames one."""
    shown = frames[(frames + 1 > view[0]) & (frames < view[0] + view[1])]
    if least <= 1 or not len(shown):
        return shown
    return shown[np.unique((shown / least).astype(int), return_index=True)[1]]
