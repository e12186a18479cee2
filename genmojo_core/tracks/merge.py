"""A three-way merge of two annotators' work: what differs, what each difference would do, and one edit that does it.

Differences are runs of frames of a point that both have, and things: points and objects that one side only has, names,
notes, reviews. That a frame was accepted stays each person's own. Points are the same if object and number are.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any, Literal

import numpy as np

from genmojo_core.sentences import say
from genmojo_core.tracks.agreement import pairs
from genmojo_core.tracks.annotation import PROPOSED, UNCERTAIN, Annotation, Cells, ObjectInfo, TrackInfo
from genmojo_core.tracks.edits import (
    CellsChange,
    Change,
    Edit,
    MetaChange,
    ObjectChange,
    ProposalChange,
    TrackChange,
    cells_change,
)
from genmojo_core.tracks.exchange import given
from genmojo_core.tracks.model import NONE, VISIBLE

SAME_PIXELS = 1.5  # at 1080p: closer than this two people mean the same place
Side = Literal["mine", "theirs", "same", "conflict"]
Choice = Literal["mine", "theirs", "middle"]
What = Literal["point", "name", "note", "review", "object", "object name"]
_REVIEW = tuple(f.name for f in fields(TrackInfo) if f.name not in ("id", "object", "number", "name", "person", "note"))


@dataclass(frozen=True)
class MergeRun:
    """Frames first..last of my track in which one side or both changed something.

    kind: "mine" or "theirs" (only that side did), "conflict"; gap: largest distance in source px (NaN where a side has
    no place); their: the other annotation's track.
    """

    track: int
    their: int
    first: int
    last: int
    kind: Side
    gap: float


@dataclass(frozen=True)
class MergeThing:
    """A point, an object, or a word about one that differs; number is 0 for objects.

    mine, theirs: what each side has, "" for nothing: a status of objects, a count of frames of points, a review, a name
    or a note. track, their: ids of the point on either side, None where there is none.
    """

    what: What
    object: int
    number: int
    kind: Side
    mine: str
    theirs: str
    track: int | None = None
    their: int | None = None


Difference = MergeRun | MergeThing


def preview(base: Annotation | None, mine: Annotation, theirs: Annotation) -> list[Difference]:
    """What a merge would meet: runs by track and frame, then things.

    Args:
        base: what both began from; without it every difference is a conflict, and what only one side has is its own.
        mine, theirs: the two sides.
    Raises GenmojoError("value") for annotations of other clips.
    """
    return [*_runs(base, mine, theirs), *_objects(base, mine, theirs), *_points(base, mine, theirs)]


def locked(mine: Annotation, one: Difference) -> bool:
    """Whether a difference is of a track of mine that is locked: it stays as it is."""
    return one.track is not None and mine.tracks[one.track].locked


def merge(
    mine: Annotation, theirs: Annotation, differences: Sequence[Difference], choices: Mapping[int, Choice]
) -> Edit:
    """One edit of mine that takes over what only they changed, and of conflicts what was chosen.

    Args:
        differences: of `preview`. choices: position in them -> "mine", "theirs" or "middle" (of runs); conflicts that
            are not named stay mine.
    Locked tracks stay as they are.
    """
    wanted: list[tuple[Difference, Choice]] = []
    for number, one in enumerate(differences):
        choice: Choice = choices.get(number, "theirs" if one.kind == "theirs" else "mine")
        if choice != "mine" and not locked(mine, one):
            wanted.append((one, choice))
    things = [one for one, _ in wanted if isinstance(one, MergeThing)]
    runs = [(one, choice) for one, choice in wanted if isinstance(one, MergeRun)]
    changes = [*_object_changes(mine, theirs, things), *_new_points(mine, theirs, things),
               *_cell_changes(mine, theirs, runs), *_proposal_changes(mine, theirs, runs),
               *_word_changes(mine, theirs, things), *_deletions(mine, things)]  # fmt: skip
    tracks = {c.track if isinstance(c, CellsChange) else c.id for c in changes
              if isinstance(c, CellsChange | TrackChange)}  # fmt: skip
    cells = next((c for c in changes if isinstance(c, CellsChange) and len(c.frames)), None)
    where = (int(cells.frames[0]), cells.track) if cells is not None else (None, None)
    objects = sum(isinstance(c, ObjectChange) for c in changes)
    title = say("merge_mixed", tracks=len(tracks), objects=objects) if tracks and objects else say(
        "merge_objects", count=objects) if objects else say("merge", count=len(tracks))  # fmt: skip
    return Edit("merge", title, tuple(changes), *where)


def _runs(base: Annotation | None, mine: Annotation, theirs: Annotation) -> list[MergeRun]:
    """Frames in which points that both have differ."""
    found = []
    unit = mine.size[1] / 1080.0
    bases = {} if base is None else dict(pairs(mine, base))
    for track, their in pairs(mine, theirs):
        a, b = mine.track(track), theirs.track(their)
        start = base.track(bases[track]) if base is not None and track in bases else None
        differs = _differs(a, b, SAME_PIXELS * unit)
        changed_a = _differs(a, start, 1e-3) if start is not None else a.state != NONE
        changed_b = _differs(b, start, 1e-3) if start is not None else b.state != NONE
        kind = np.where(~differs, 0, np.where(changed_a & changed_b, 3, np.where(changed_b, 2, 1)))
        edges = np.flatnonzero(np.diff(kind, prepend=-1, append=-1))
        for first, end in zip(edges[:-1], edges[1:], strict=True):
            if kind[first]:
                gap = np.linalg.norm(a.xy[first:end] - b.xy[first:end], axis=1)
                gap[(a.state[first:end] == NONE) | (b.state[first:end] == NONE)] = np.nan
                worst = float(np.nanmax(gap)) if np.isfinite(gap).any() else float("nan")
                name: Side = ("same", "mine", "theirs", "conflict")[kind[first]]  # type: ignore[assignment]
                found.append(MergeRun(track, their, int(first), int(end) - 1, name, worst))
    return found


def _objects(base: Annotation | None, mine: Annotation, theirs: Annotation) -> list[MergeThing]:
    """Objects that one side chose or gave up and the other did not, and other names of those both chose."""
    found = []
    for owner in sorted({*mine.objects, *theirs.objects}):
        b, m, t = (None if side is None else side.objects.get(owner) for side in (base, mine, theirs))
        found += _thing("object", (owner, 0), _status(b), _status(m), _status(t))
        if m is not None and t is not None and "chosen" in (m.status, t.status):
            found += _thing("object name", (owner, 0), b.name if b else "", m.name, t.name)
    return found


def _points(base: Annotation | None, mine: Annotation, theirs: Annotation) -> list[MergeThing]:
    """Points that one side only has, and what the sides say of those both have."""
    found = []
    sides = [{} if side is None else {(i.object, i.number): i.id for i in side.tracks.values()}
             for side in (base, mine, theirs)]  # fmt: skip
    for place in sorted({*sides[1], *sides[2]}):
        b, m, t = (side.get(place) for side in sides)
        first = base.tracks[b] if base is not None and b is not None else None
        if m is None or t is None:
            known = [_known(side, i) for side, i in ((base, b), (mine, m), (theirs, t))]
            changed = base is not None and b is not None and _changed(
                base, b, mine if m is not None else theirs, m if m is not None else t)  # fmt: skip
            kind: Side = "conflict" if changed else "theirs" if (m is None) == (b is None) else "mine"
            found.append(MergeThing("point", *place, kind, known[1], known[2], m, t))
            continue
        ours, other = mine.tracks[m], theirs.tracks[t]
        found += _thing("name", place, first.name if first else "", ours.name, other.name, m, t)
        found += _thing("note", place, first.note if first else "", ours.note, other.note, m, t)
        found += _thing("review", place, _review(first), _review(ours), _review(other), m, t)
    return found


def _thing(what: What, place: tuple[int, int], b: str, m: str, t: str,
           track: int | None = None, their: int | None = None) -> list[MergeThing]:  # fmt: skip
    """A difference of words, if they differ; who changed them is told from the base, else from who has any."""
    if m == t:
        return []
    kind: Side = "theirs" if m == b else "mine" if t == b else "conflict"
    return [MergeThing(what, *place, kind, _plain(m), _plain(t), track, their)]


def _status(info: ObjectInfo | None) -> str:
    """Whether an object was chosen or rejected; candidates are what nobody has said anything about."""
    return "" if info is None or info.status == "candidate" else info.status


def _review(info: TrackInfo | None) -> str:
    """Where a review stands, with everything it says behind a line break; "" where it has not begun."""
    if info is None:
        return ""
    said = {name: getattr(info, name) for name in _REVIEW}
    empty = {f.name: f.default for f in fields(TrackInfo) if f.name in _REVIEW}
    return "" if said == empty else f"{info.review}\n{sorted(said.items())}"


def _plain(words: str) -> str:
    """What a person reads of it."""
    return words.split("\n", 1)[0]


def _known(side: Annotation | None, track: int | None) -> str:
    """In how many frames a side knows a point, "" without it."""
    return "" if side is None or track is None else str(int((side.track(track).state != NONE).sum()))


def _changed(base: Annotation, b: int, side: Annotation, track: int | None) -> bool:
    """Whether a side has changed a point since the base."""
    if track is None:
        return False
    words = [replace(info, id=0) for info in (base.tracks[b], side.tracks[track])]
    return words[0] != words[1] or bool(_differs(base.track(b), side.track(track), 1e-3).any())


def _object_changes(mine: Annotation, theirs: Annotation, things: list[MergeThing]) -> list[Change]:
    """Objects as they have them, and the objects of points that are taken over."""
    wanted: dict[int, ObjectInfo] = {}
    order = max((o.order for o in mine.objects.values()), default=0)
    for one in things:
        other, own = theirs.objects.get(one.object), wanted.get(one.object, mine.objects.get(one.object))
        if one.what == "object":
            plain = own or other or ObjectInfo(one.object, "")
            status = other.status if other is not None else "candidate"
            order += status == "chosen"
            place = order if status == "chosen" else plain.order
            wanted[one.object] = replace(plain, status=status, order=place, reason=other.reason if other else "")
        elif one.what == "object name" and own is not None and other is not None:
            wanted[one.object] = replace(own, name=other.name)
        elif one.what == "point" and one.their is not None and one.object and (own is None or own.status != "chosen"):
            order += 1
            plain = own or other or ObjectInfo(one.object, "")
            wanted[one.object] = replace(plain, status="chosen", order=order)
    return [ObjectChange(owner, mine.objects.get(owner), info) for owner, info in wanted.items()
            if mine.objects.get(owner) != info]  # fmt: skip


def _new_points(mine: Annotation, theirs: Annotation, things: list[MergeThing]) -> list[Change]:
    """Points that only they have."""
    found: list[Change] = []
    last = mine.new_track_id() - 1
    frames = np.arange(mine.frames, dtype=np.int32)
    for one in things:
        if one.what == "point" and one.track is None and one.their is not None:
            last += 1
            known = frames[theirs.track(one.their).state != NONE]
            found += [TrackChange(last, None, replace(theirs.tracks[one.their], id=last)),
                      CellsChange(last, known, Cells.empty(len(known)), theirs.cells(one.their, known)),
                      *given(last, {}, theirs.proposals.get(one.their, {}), frames, mine.frames)]  # fmt: skip
    if found:
        found.append(MetaChange("last_track", mine.meta.get("last_track"), str(last)))
    return found


def _cell_changes(mine: Annotation, theirs: Annotation, runs: list[tuple[MergeRun, Choice]]) -> list[Change]:
    """Frames of points that both have."""
    taken: dict[int, Cells] = {}
    for run, choice in runs:
        cells = taken.setdefault(run.track, mine.track(run.track).copy())
        span = np.arange(run.first, run.last + 1)
        other = theirs.cells(run.their, span)
        middle = 0.5 * (cells.xy[span] + other.xy)
        for own, new in zip(cells.arrays(), other.arrays(), strict=True):
            own[span] = new
        if choice == "middle":
            both = (mine.track(run.track).state[span] != NONE) & (other.state != NONE)
            cells.xy[span[both]] = middle[both]
    made = [cells_change(mine, track, np.arange(mine.frames), cells) for track, cells in taken.items()]
    return [change for change in made if change is not None]


def _proposal_changes(
    mine: Annotation, theirs: Annotation, runs: list[tuple[MergeRun, Choice]]
) -> list[ProposalChange]:
    """What trackers proposed for frames that are taken over: it goes on to lead them. Trackers that have proposed
    nothing to them keep what they proposed here, but for those that would lead a track."""
    taken: dict[tuple[int, int], list[np.ndarray]] = {}
    for run, _ in runs:
        taken.setdefault((run.track, run.their), []).append(np.arange(run.first, run.last + 1))
    found = []
    for (track, their), spans in taken.items():
        other = theirs.proposals.get(their, {})
        own = {name: p for name, p in mine.proposals.get(track, {}).items() if name in other or name in PROPOSED}
        found += given(track, own, other, np.concatenate(spans), mine.frames)
    return found


def _word_changes(mine: Annotation, theirs: Annotation, things: list[MergeThing]) -> list[Change]:
    """Names, notes and reviews of points that both have; several of one point are one change."""
    wanted: dict[int, TrackInfo] = {}
    for one in things:
        if one.what in ("name", "note", "review") and one.track is not None and one.their is not None:
            names = _REVIEW if one.what == "review" else (one.what,)
            words: dict[str, Any] = {name: getattr(theirs.tracks[one.their], name) for name in names}
            wanted[one.track] = replace(wanted.get(one.track, mine.tracks[one.track]), **words)
    return [TrackChange(track, mine.tracks[track], info) for track, info in wanted.items()]


def _deletions(mine: Annotation, things: list[MergeThing]) -> list[Change]:
    """Points that they deleted."""
    found: list[Change] = []
    for one in things:
        if one.what == "point" and one.their is None and one.track is not None:
            cells = cells_change(mine, one.track, np.arange(mine.frames), Cells.empty(mine.frames))
            found += [cells] if cells is not None else []
            found.append(TrackChange(one.track, mine.tracks[one.track], None))
    return found


def _differs(a: Cells, b: Cells, pixels: float) -> np.ndarray:  # (T,) bool
    """Where states or doubts differ, or places of points that both see are farther apart than that."""
    apart = np.linalg.norm(a.xy - b.xy, axis=1) > pixels
    matters = (a.state != NONE) & (b.state != NONE)
    hidden = (a.state != VISIBLE) & (b.state != VISIBLE)
    doubt = ((a.flags ^ b.flags) & UNCERTAIN) > 0
    return (a.state != b.state) | (apart & matters & ~hidden) | (doubt & matters)
