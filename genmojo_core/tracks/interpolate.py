"""Positions between keys without looking at any picture: line, hold, and carrying a correction to the neighbours."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from genmojo_core.tracks.annotation import BY_HOLD, HOLD, LINEAR, Cells
from genmojo_core.tracks.model import NONE, VISIBLE, PointTracks


def line(xy0: np.ndarray, xy1: np.ndarray, t0: int, t1: int) -> np.ndarray:  # (2,), (2,) -> (t1 - t0 - 1, 2)
    """Positions strictly between two keys, evenly in time."""
    share = (np.arange(t0 + 1, t1) - t0)[:, None] / (t1 - t0)
    return (xy0 + (xy1 - xy0) * share).astype(np.float32)


def hold(xy0: np.ndarray, t0: int, t1: int) -> np.ndarray:  # (2,) -> (t1 - t0 - 1, 2)
    """The position of the earlier key, kept."""
    return np.repeat(np.asarray(xy0, np.float32)[None], t1 - t0 - 1, axis=0)


def between(cells: Cells, t0: int, t1: int, mode: int) -> Cells:
    """Frames t0 + 1 .. t1 - 1 of a track's T cells by line or hold.

    States that are NONE become VISIBLE; flags are kept; the confidence is 1 at the keys and falls to 0.5 between.
    """
    middle = Cells(*(np.array(a[t0 + 1 : t1]) for a in cells.arrays()))
    xy = hold(cells.xy[t0], t0, t1) if mode == BY_HOLD else line(cells.xy[t0], cells.xy[t1], t0, t1)
    away = np.minimum(np.arange(t0 + 1, t1) - t0, t1 - np.arange(t0 + 1, t1)) / max(t1 - t0, 1)
    source = np.full(len(xy), HOLD if mode == BY_HOLD else LINEAR, np.uint8)
    state = np.where(middle.state == NONE, VISIBLE, middle.state).astype(np.uint8)
    return Cells(xy, state, middle.flags, source, (1.0 - away).astype(np.float32), middle.mode)


def carried(count: int, t: int, previous: int | None, following: int | None, shift: np.ndarray) -> np.ndarray:
    """How a correction of `shift` (2,) at frame t moves its neighbours: (count, 2), all frames 0..count-1.

    Full at t, fading linearly to nothing at the keys on either side; constant where there is no key.
    """
    weight = np.ones(count)
    frames = np.arange(count)
    if previous is not None:
        before = frames < t
        weight[before] = np.clip((frames[before] - previous) / max(t - previous, 1), 0.0, 1.0)
    if following is not None:
        after = frames > t
        weight[after] = np.clip((following - frames[after]) / max(following - t, 1), 0.0, 1.0)
    return (weight[:, None] * np.asarray(shift, np.float64)).astype(np.float32)


def through(xy: np.ndarray, known: np.ndarray, at: np.ndarray, places: np.ndarray) -> np.ndarray:  # (T, 2)
    """A way xy (T, 2) moved so that it passes through places (m, 2) in frames at (m,), rising.

    What is missing at each of these frames fades linearly to the next of them, and stays before the first and after the
    last. Frames of which the way knows nothing, known (T,) bool, say nothing.
    """
    told = known[at]
    at, gap = at[told], places[told] - xy[at[told]]
    if not len(at):
        return xy
    frames = np.arange(len(xy))
    return (xy + np.stack([np.interp(frames, at, gap[:, axis]) for axis in (0, 1)], axis=1)).astype(np.float32)


def placed(tracks: PointTracks) -> PointTracks:
    """The same tracks with a place wherever they have a state.

    A point of which only its state is known lies on the line between its known neighbours in time, or stays at the only
    one; a track that is nowhere known loses its states. Where the state is NONE the place is NaN.
    """
    xy, state = np.array(tracks.xy, np.float32), np.array(tracks.state)
    known = np.isfinite(xy).all(axis=-1) & (state != NONE)
    frames = np.arange(state.shape[1])
    for row in np.flatnonzero(((state != NONE) & ~known).any(axis=1)):
        at, lost = np.flatnonzero(known[row]), np.flatnonzero((state[row] != NONE) & ~known[row])
        if len(at):
            xy[row, lost] = np.stack([np.interp(frames[lost], at, xy[row, at, axis]) for axis in (0, 1)], axis=1)
        else:
            state[row] = NONE
    xy[state == NONE] = np.nan
    return replace(tracks, xy=xy, state=state)
