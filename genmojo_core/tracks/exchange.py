"""Edits that move frames between tracks: two change places, one is split in two, two become one.

All that is known of a frame goes along: place, state, flags, source, confidence and what trackers proposed there. What
a reviewer said goes with the frames that it is about where a track is split or joined; a swap leaves it with the track,
which it may well answer. Any track may know nothing in some of the frames, or in all.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from genmojo_core.errors import GenmojoError
from genmojo_core.sentences import say
from genmojo_core.tracks.annotation import CONFIRMED, KEY, Annotation, Cells, Proposal, Review, TrackInfo
from genmojo_core.tracks.edit_tracks import add_track, delete_track, unlocked
from genmojo_core.tracks.edits import CellsChange, Change, Edit, ProposalChange, TrackChange, cells_change
from genmojo_core.tracks.keys import name_of
from genmojo_core.tracks.model import NONE

_URGENT: tuple[Review, ...] = ("rejected", "approved", "draft", "in_progress", "fixed", "needs_fix")


def swap(annotation: Annotation, one: int, other: int, first: int, last: int) -> Edit:
    """Two tracks change places in frames first..last, keys included; either may know nothing there.

    Raises GenmojoError("argument") for frames outside the clip and locked tracks.
    """
    frames = np.arange(first, last + 1)
    a, b = (_checked_cells(annotation, track, first, last) for track in (one, other))
    changes = [cells_change(annotation, one, frames, b), cells_change(annotation, other, frames, a)]
    moved = [] if one == other else [*_given(annotation, other, one, frames), *_given(annotation, one, other, frames)]
    run = say("frame", first=first) if first == last else say("frames", first=first, last=last)
    title = say("swap_run", one=name_of(annotation, one), other=name_of(annotation, other), frames=run)
    return Edit("swap", title, (*(c for c in changes if c is not None), *moved), first, one)


def split(annotation: Annotation, track: int, t: int, number: int, owner: int | None = None) -> Edit:
    """Frames t and after become point `number` of object `owner` (None: of the same object); its id is `edit.track`.

    That point may exist already if it knows nothing of those frames.
    Raises GenmojoError("argument") if it knows something, is locked, or there is nothing to be moved.
    """
    info = unlocked(annotation, track)
    owner = info.object if owner is None else owner
    tail = _checked_cells(annotation, track, t, annotation.frames - 1)
    frames = np.flatnonzero(tail.state != NONE) + t
    if not len(frames):
        raise GenmojoError("argument", f"{name_of(annotation, track)} has nothing from frame {t} on",
                           hint="choose an earlier frame")  # fmt: skip
    there = next((i for i in annotation.tracks_of(owner) if i.number == number), None)
    cells = annotation.cells(track, frames)
    head, gone = _parted(info, t)
    if there is None:
        made = add_track(annotation, owner, number, info.person)
        new = int(made.track or 0)
        begun = replace(TrackInfo(new, owner, number), **gone)
        changes: list[Change] = [made.changes[0], TrackChange(new, None, begun)]
        changes.append(CellsChange(new, frames.astype(np.int32), Cells.empty(len(frames)), cells))
    else:
        new = there.id
        _nothing_there(annotation, new, frames)
        taken = cells_change(annotation, new, frames, cells)
        changes = [*([taken] if taken is not None else []), *_described(there, _joined(there, replace(info, **gone)))]
    changes += _given(annotation, track, new, np.arange(t, annotation.frames))
    away = cells_change(annotation, track, frames, Cells.empty(len(frames)))
    changes += [*([away] if away is not None else []), *_described(info, head)]
    changes += _given(annotation, None, track, np.arange(t, annotation.frames))
    title = say("split_to", one=name_of(annotation, track), frame=say("frame", first=t),
                other=say("point_of", number=number, name=annotation.objects[owner].name))  # fmt: skip
    return Edit("split", title, tuple(changes), t, new)


def conflicts(annotation: Annotation, one: int, other: int) -> tuple[np.ndarray, np.ndarray]:
    """Frames (n,) in which both tracks know something, and those of them (m,) in which a person placed both."""
    mine, theirs = annotation.track(one), annotation.track(other)
    both = np.flatnonzero((mine.state != NONE) & (theirs.state != NONE))
    return both, both[(mine.flags[both] & theirs.flags[both] & KEY) > 0]


def join_tracks(annotation: Annotation, one: int, other: int, prefer_other: bool = False) -> Edit:
    """`one` takes the frames of `other`, which is deleted.

    Where both know something a key goes before an accepted place, that before any other; of equals `one` stays, or
    `other` with `prefer_other`. Raises GenmojoError("argument") for locked tracks.
    """
    info, gone = unlocked(annotation, one), unlocked(annotation, other)
    if one == other:
        raise GenmojoError("argument", "a track cannot be joined to itself", hint="choose another one")
    mine, theirs = annotation.track(one), annotation.track(other)
    lead = 0.5 if prefer_other else -0.5
    frames = np.flatnonzero((theirs.state != NONE) & (_weight(theirs) + lead > _weight(mine)))
    taken = cells_change(annotation, one, frames, annotation.cells(other, frames))
    changes: list[Change] = [] if taken is None else [taken]
    changes += _described(info, _joined(info, gone))
    changes += _given(annotation, other, one, frames, fill=True)
    changes += _given(annotation, None, other, np.arange(annotation.frames))
    title = say("join_to", one=name_of(annotation, one), other=name_of(annotation, other))
    where = int(frames[0]) if len(frames) else 0
    return Edit("join", title, (*changes, *delete_track(annotation, other).changes), where, one)


def _described(info: TrackInfo, fields: dict[str, Any]) -> list[TrackChange]:
    """The change of a track's description, if there is any."""
    new = replace(info, **fields)
    return [TrackChange(info.id, info, new)] if new != info else []


def _weight(cells: Cells) -> np.ndarray:  # (T,)
    """How much a person stands behind each frame: nothing known -2, else 0, accepted 1, key 2."""
    sure = np.where(cells.flags & KEY, 2, np.where(cells.flags & CONFIRMED, 1, 0))
    return np.where(cells.state == NONE, -2, sure)


def _nothing_there(annotation: Annotation, track: int, frames: np.ndarray) -> None:
    """Raises GenmojoError("argument") if a track is locked or knows any of the frames."""
    unlocked(annotation, track)
    known = frames[annotation.track(track).state[frames] != NONE]
    if len(known):
        raise GenmojoError("argument", f"{name_of(annotation, track)} has places of its own in {len(known)} of these "
                           f"frames, the first is {known[0]}", hint="swap or join the two instead")  # fmt: skip


def _given(
    annotation: Annotation, source: int | None, track: int, frames: np.ndarray, fill: bool = False
) -> list[ProposalChange]:
    """What trackers proposed for `source` (None: for nothing) in some frames becomes what they proposed for `track`.

    `fill`: in all other frames, too, of which they said nothing for `track`.
    """
    theirs = annotation.proposals.get(source, {}) if source is not None else {}
    mine = annotation.proposals.get(track, {})
    return given(track, mine, theirs, frames, annotation.frames, fill)


def given(track: int, mine: Mapping[str, Proposal], theirs: Mapping[str, Proposal], frames: np.ndarray,
          count: int, fill: bool = False) -> list[ProposalChange]:  # fmt: skip
    """What some trackers proposed in frames (n,) for another track becomes what they proposed for `track`.

    Args:
        mine, theirs: by tracker; of a tracker that has nothing of the other track, nothing is left there. count: of
            the clip's frames. fill: in all others, too, of which `mine` says nothing.
    """
    changes = []
    for name in sorted({*mine, *theirs}):
        before, silent = mine.get(name), _silent(name, count)
        own, other = before or silent, theirs.get(name, silent)
        unknown = np.flatnonzero((own.state == NONE) & (other.state != NONE)) if fill else frames[:0]
        after = _over(own, other, np.union1d(frames, unknown))
        left = after if (after.state != NONE).any() else None
        if (before is None) != (left is None) or (before is not None and left is not None and _differ(before, left)):
            changes.append(ProposalChange(track, name, before, left))
    return changes


def _silent(tracker: str, count: int) -> Proposal:
    """A proposal that says nothing of any frame."""
    cells = Cells.empty(count)
    return Proposal(tracker, cells.xy, cells.state, cells.conf)


def _over(one: Proposal, other: Proposal, frames: np.ndarray) -> Proposal:
    """A proposal with some frames of another."""
    arrays = [np.array(a) for a in (one.xy, one.state, one.conf)]
    for mine, theirs in zip(arrays, (other.xy, other.state, other.conf), strict=True):
        mine[frames] = theirs[frames]
    return Proposal(one.tracker, *arrays)


def _differ(one: Proposal, other: Proposal) -> bool:
    pairs = ((one.xy, other.xy), (one.state, other.state), (one.conf, other.conf))
    return any(not np.array_equal(a, b) for a, b in pairs)


def _parted(info: TrackInfo, t: int) -> tuple[dict[str, Any], dict[str, Any]]:
    """What changes of a track's description before frame t, and what its part from t on brings along."""
    words = ("review", "reviewer", "reason", "run", "note", "rounds", "review_note", "person")
    tail = {name: getattr(info, name) for name in words}
    if info.run is None:
        return {}, tail
    first, last = info.run
    past = {"review": "in_progress", "reason": "", "run": None, "review_note": ""}
    if first >= t:
        return past, tail
    if last < t:
        return {}, tail | past
    return {"run": (first, t - 1)}, tail | {"run": (t, last)}


def _joined(one: TrackInfo, other: TrackInfo) -> dict[str, Any]:
    """What changes of `one` when it takes over `other`: the more urgent review stands, notes of both are kept."""
    ranks = [_URGENT.index(i.review) for i in (one, other)]
    first, second = (one, other) if ranks[0] >= ranks[1] else (other, one)
    run, said = first.run, first.review_note
    if ranks[0] == ranks[1]:
        runs = [i.run for i in (one, other) if i.run is not None]
        run = (min(r[0] for r in runs), max(r[1] for r in runs)) if len(runs) == 2 else first.run or second.run
        said = _both(one.review_note, other.review_note)
    return {"review": first.review, "reviewer": first.reviewer or second.reviewer, "run": run, "review_note": said,
            "reason": first.reason or (second.reason if ranks[0] == ranks[1] else ""),
            "note": _both(one.note, other.note), "rounds": max(one.rounds, other.rounds)}  # fmt: skip


def _both(one: str, other: str) -> str:
    """Two notes as one."""
    return one if not other or other == one else f"{one} / {other}" if one else other


def _checked_cells(annotation: Annotation, track: int, first: int, last: int) -> Cells:
    """Copies of frames first..last of a track that is not locked."""
    unlocked(annotation, track)
    if not 0 <= first <= last < annotation.frames:
        raise GenmojoError("argument", f"frames {first} to {last} are not in 0 to {annotation.frames - 1}")
    return annotation.cells(track, np.arange(first, last + 1))
