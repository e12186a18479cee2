"""Edits of points: keys, states, confirmations, and what machines may fill in between.

Each function returns the `Edit`; nothing is changed until it is done. All raise GenmojoError("argument") for frames
outside the clip, tracks that do not exist, and locked tracks.
"""

from __future__ import annotations

import numpy as np

from genmojo_core.errors import GenmojoError
from genmojo_core.sentences import say
from genmojo_core.tracks.annotation import (
    BY_TRACKER,
    CONFIRMED,
    HUMAN,
    KEY,
    PAINTED,
    SNAPPED,
    UNCERTAIN,
    Annotation,
    Cells,
    Proposal,
)
from genmojo_core.tracks.edits import CellsChange, Edit, cells_change, join
from genmojo_core.tracks.interpolate import between, carried, through
from genmojo_core.tracks.model import NONE, OCCLUDED, OUT_OF_VIEW, VISIBLE

GAP = 3  # frames between two visits that are taken to go on as both of them
_PAINTED = {NONE: "not_annotated", VISIBLE: "visible", OCCLUDED: "occluded", OUT_OF_VIEW: "out_of_view"}


def set_key(
    annotation: Annotation, track: int, t: int, xy: tuple[float, float], state: int | None = None, snapped: bool = False
) -> Edit:
    """A person places the point in frame t; neighbours follow at once, up to the next keys.

    Args:
        annotation, track, t: where.
        xy: source raster pixels.
        state: by default the state that stands, VISIBLE if there is none.
        snapped: the place was moved to a peak of likeness first.

    Confirmed frames stay as they are; a tracker's solution may replace the rest later (`solved`).
    """
    cells = _open(annotation, track, t, t)
    if not np.isfinite(xy).all():
        raise GenmojoError("argument", f"the place {xy} of a key is not finite")
    previous, following = _neighbours(annotation, track, t)
    new = cells.copy()
    known = cells.state != NONE
    if known[t]:
        moved = carried(annotation.frames, t, previous, following, np.asarray(xy, np.float32) - cells.xy[t])
        free = known & ~_protected(cells)
        new.xy[free] += moved[free]
    new.xy[t] = xy
    new.state[t] = state if state is not None else (cells.state[t] if known[t] else VISIBLE)
    new.flags[t] = (int(cells.flags[t]) & ~(UNCERTAIN | SNAPPED)) | KEY | CONFIRMED | (SNAPPED if snapped else 0)
    if state is not None and state != cells.state[t]:
        new.flags[t] |= PAINTED
    new.source[t], new.conf[t] = HUMAN, 1.0
    new = _by_rule(new, [k for k in (previous, t, following) if k is not None])
    return _edit(annotation, "key", say("place", point=name_of(annotation, track)), track, t, new)


def remove_key(annotation: Annotation, track: int, t: int) -> Edit:
    """The key of frame t becomes an ordinary place again."""
    cells = _open(annotation, track, t, t)
    if not cells.flags[t] & KEY:
        raise GenmojoError("argument", f"{name_of(annotation, track)} has no key in frame {t}")
    new = cells.copy()
    new.flags[t] &= 0xFF ^ (KEY | CONFIRMED | SNAPPED)
    new.conf[t], new.mode[t] = 0.5, BY_TRACKER
    around = [k for k in _neighbours(annotation, track, t) if k is not None]
    title = say("delete_key", point=name_of(annotation, track))
    return _edit(annotation, "unkey", title, track, t, _by_rule(new, around))


def set_state(annotation: Annotation, track: int, first: int, last: int, state: int) -> Edit:
    """Paint a state over frames first..last; positions stay. NONE also takes keys and positions away."""
    if state not in _PAINTED:
        raise GenmojoError("argument", f"there is no state {state}")
    cells = _open(annotation, track, first, last)
    new, run = cells.copy(), slice(first, last + 1)
    if state == NONE:
        for mine, nothing in zip(new.arrays(), Cells.empty(last + 1 - first).arrays(), strict=True):
            mine[run] = nothing
    else:
        lost = np.flatnonzero(cells.state[run] == NONE) + first
        new.xy[lost] = _nearest_known(annotation, cells, lost)
        new.state[run], new.flags[run] = state, new.flags[run] | PAINTED
    title = say(_PAINTED[state], point=name_of(annotation, track), frames=_frames(first, last))
    return _edit(annotation, "states", title, track, first, new)


def set_uncertain(annotation: Annotation, track: int, first: int, last: int, on: bool) -> Edit:
    """Mark frames first..last as uncertain, or not."""
    cells = _open(annotation, track, first, last)
    new, run = cells.copy(), slice(first, last + 1)
    new.flags[run] = new.flags[run] | UNCERTAIN if on else new.flags[run] & (0xFF ^ UNCERTAIN)
    title = say("uncertain" if on else "certain", point=name_of(annotation, track), frames=_frames(first, last))
    return _edit(annotation, "uncertain", title, track, first, new)


def confirm(annotation: Annotation, tracks: list[int], t: int, on: bool = True) -> Edit:
    """A person looked at these points in frame t and accepts them as they are (or takes that back).

    Up to GAP frames between two accepted ones that have the same state take that state too: a point does not vanish
    for a frame between two visits. Points without a state and locked tracks are left out.
    """
    changes = []
    for track in tracks:
        frames = np.arange(max(t - GAP - 1, 0), min(t + GAP + 2, annotation.frames))
        cells, here = annotation.cells(track, frames), int(t - frames[0])
        if cells.state[here] == NONE or annotation.tracks[track].locked:
            continue
        if on:
            cells.flags[here] |= CONFIRMED
            _close_gaps(cells, here)
        else:
            cells.flags[here] &= 0xFF ^ CONFIRMED
        changes.append(cells_change(annotation, track, frames, cells))
    made = tuple(c for c in changes if c is not None)
    if on and len(made) == 1:
        title = say("accept_point", point=name_of(annotation, made[0].track))
    else:
        title = say("accept_points" if on else "reopen_points", count=len(made))
    return Edit("confirm", title, made, t, made[0].track if made else None)


def set_mode(annotation: Annotation, track: int, t: int, mode: int) -> Edit:
    """How the segment around frame t is filled: BY_TRACKER, BY_LINE or BY_HOLD. Needs a key before t."""
    cells = _open(annotation, track, t, t)
    start, end = annotation.segment(track, t)
    if start is None:
        raise GenmojoError("argument", f"{name_of(annotation, track)} has no key before frame {t}")
    new = cells.copy()
    new.mode[start] = mode
    new = _by_rule(new, [k for k in (start, end) if k is not None])
    return _edit(annotation, "mode", say("fill_mode", point=name_of(annotation, track)), track, t, new)


def clear(annotation: Annotation, track: int, first: int, last: int) -> Edit:
    """Forget everything in frames first..last, keys included."""
    return set_state(annotation, track, first, last, NONE)


def solved(annotation: Annotation, track: int, frames: np.ndarray, cells: Cells, title: str = "") -> Edit:
    """A machine's positions and states for some frames; where its state is NONE it says nothing, and nothing changes.

    Keys, confirmed frames, segments by line or hold and locked tracks keep what they have; painted states stay, only
    their positions move.
    """
    frames = np.asarray(frames, np.int64)
    now = annotation.track(track)
    if annotation.tracks[track].locked:
        return Edit("solve", title, (), machine=True)
    free = (cells.state != NONE) & ~_protected(now)[frames] & (_mode_of(now)[frames] == BY_TRACKER)
    frames, cells = frames[free], Cells(*(a[free] for a in cells.arrays()))
    flags = now.flags[frames]
    painted = (flags & PAINTED) > 0
    state = np.where(painted, now.state[frames], cells.state).astype(np.uint8)
    new = Cells(
        cells.xy.astype(np.float32), state, flags, cells.source, cells.conf.astype(np.float32), now.mode[frames]
    )
    change = cells_change(annotation, track, frames, new)
    where = int(change.frames[0]) if change is not None else None
    title = title or say("solve", point=name_of(annotation, track))
    return Edit("solve", title, (change,) if change is not None else (), where, track, machine=True)


def accept(annotation: Annotation, proposals: dict[int, Proposal], source: int) -> Edit:
    """Tracks take what a tracker proposes, wherever no person has said otherwise.

    A proposal is moved so that it passes through the keys and the accepted places (`interpolate.through`).
    """
    parts = []
    frames = np.arange(annotation.frames)
    for track, p in proposals.items():
        small = np.full(annotation.frames, source, np.uint8)
        now = annotation.track(track)
        sure = np.flatnonzero(_protected(now) & (now.state != NONE))
        xy = through(p.xy, p.state != NONE, sure, now.xy[sure])
        cells = Cells(xy, p.state, np.zeros_like(small), small, p.conf, np.zeros_like(small))
        parts.append(solved(annotation, track, frames, cells))
    name = next(iter(proposals.values())).tracker if proposals else "nothing"
    made = [part for part in parts if part.changes]
    return join("seed", say("seed_by", count=len(made), name=name), made)


def _close_gaps(cells: Cells, here: int) -> None:
    """Frames between an accepted one and the next accepted ones on either side take their common state."""
    sure = np.flatnonzero(_protected(cells))
    for other in (sure[sure < here][-1:], sure[sure > here][:1]):
        if len(other) and cells.state[other[0]] == cells.state[here]:
            between_them = slice(min(int(other[0]), here) + 1, max(int(other[0]), here))
            free = (cells.flags[between_them] & PAINTED) == 0
            cells.state[between_them][free & (cells.state[between_them] != NONE)] = cells.state[here]


def _open(annotation: Annotation, track: int, first: int, last: int) -> Cells:
    """A track's cells, after its lock and the frames were checked."""
    cells = annotation.track(track)
    if not 0 <= first <= last < annotation.frames:
        raise GenmojoError("argument", f"frames {first} to {last} are not in 0 to {annotation.frames - 1}")
    if annotation.tracks[track].locked:
        raise GenmojoError("argument", f"{name_of(annotation, track)} is locked", hint="unlock it first")
    return cells


def _neighbours(annotation: Annotation, track: int, t: int) -> tuple[int | None, int | None]:
    """The keys strictly before and after frame t."""
    keys = annotation.keys(track)
    before, after = keys[keys < t], keys[keys > t]
    return int(before[-1]) if len(before) else None, int(after[0]) if len(after) else None


def _by_rule(cells: Cells, keys: list[int]) -> Cells:
    """Cells with the segments between consecutive keys filled where they go by line or hold, or know nothing."""
    for t0, t1 in zip(keys[:-1], keys[1:], strict=True):
        run = slice(t0 + 1, t1)
        filled = between(cells, t0, t1, int(cells.mode[t0]))
        take = ~_protected(cells)[run] & ((cells.state[run] == NONE) | (cells.mode[t0] != BY_TRACKER))
        for mine, theirs in zip(cells.arrays(), filled.arrays(), strict=True):
            mine[run][take] = theirs[take]
    return cells


def _mode_of(cells: Cells) -> np.ndarray:  # (T,)
    """The mode of the segment every frame lies in; BY_TRACKER outside the keys."""
    keys = np.flatnonzero(cells.flags & KEY)
    at = np.searchsorted(keys, np.arange(len(cells)), side="right") - 1
    inner = (at >= 0) & (at < len(keys) - 1)
    return np.where(inner, cells.mode[keys[np.clip(at, 0, None)]] if len(keys) else 0, BY_TRACKER)


def _protected(cells: Cells) -> np.ndarray:  # (n,) bool
    """Cells whose place only a person may change."""
    return (cells.flags & (KEY | CONFIRMED)) > 0


def _nearest_known(annotation: Annotation, cells: Cells, frames: np.ndarray) -> np.ndarray:  # (n, 2)
    """The place of the nearest frame that has one; the middle of the picture without any."""
    known = np.flatnonzero(cells.state != NONE)
    if not len(known):
        return np.repeat(np.array([annotation.size], np.float32) / 2, len(frames), axis=0)
    nearest = known[np.argmin(np.abs(known[None] - np.asarray(frames)[:, None]), axis=1)] if len(frames) else known[:0]
    return cells.xy[nearest]


def _edit(annotation: Annotation, kind: str, title: str, track: int, t: int, new: Cells) -> Edit:
    """The edit that makes a track's T cells those."""
    change: CellsChange | None = cells_change(annotation, track, np.arange(annotation.frames), new)
    return Edit(kind, title, (change,) if change is not None else (), t, track)


def name_of(annotation: Annotation, track: int) -> str:
    """What a person calls a track, a sentence of the core."""
    info = annotation.tracks[track]
    owner = annotation.objects.get(info.object)
    called = owner.name if owner else say("object_number", number=info.object)
    return info.name or say("point_of", number=info.number, name=called)


def _frames(first: int, last: int) -> str:
    """ "frame 3" or "frames 3 to 8"."""
    return say("frame", first=first) if first == last else say("frames", first=first, last=last)
