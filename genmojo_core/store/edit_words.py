"""What an edit did, in words and figures: points, frames, what stood before and after, pixels moved, keys."""

from __future__ import annotations

from dataclasses import dataclass, field, fields

import numpy as np

from genmojo_core.sentences import say
from genmojo_core.tracks.annotation import CONFIRMED, KEY, UNCERTAIN, Cells, ObjectInfo, TrackInfo
from genmojo_core.tracks.edits import CellsChange, Edit, MetaChange, ObjectChange, ProposalChange, TrackChange
from genmojo_core.tracks.model import NONE, OCCLUDED, OUT_OF_VIEW, VISIBLE

_STATES = ((VISIBLE, "log_visible"), (OCCLUDED, "log_occluded"), (OUT_OF_VIEW, "log_out_of_view"))
_FLAGS = ((KEY, KEY, "log_keys"), (KEY | CONFIRMED, CONFIRMED, "log_accepted"), (UNCERTAIN, UNCERTAIN, "log_uncertain"))
_MODES = ("log_by_tracker", "log_by_line", "log_by_hold")
_CARRIED = ("merge", "import", "swap", "split", "join", "delete")  # keys that these bring were placed elsewhere
_WORDY = {
    "name": "log_name",
    "note": "log_note",
    "person": "log_person",
    "reviewer": "log_reviewer",
    "review_note": "log_review_note",
}


@dataclass(frozen=True)
class Point:
    """A point that an edit touched, as it was called then; number 0 is the object itself, object "" has no name."""

    track: int | None
    owner: int
    object: str
    number: int
    name: str = ""

    def title(self, called: str = "") -> str:
        """ "dog · 2 nose"; `called`: what to call an object without a name."""
        owner = self.object or called or say("object_number", number=self.owner)
        return f"{owner} · {self.number} {self.name}".rstrip() if self.number else owner


@dataclass(frozen=True)
class Words:
    """What an edit did.

    points: touched ones. first, last, frames: where (None, None, 0: no frame). before, after: sentences of `say`, only
    what differs. moved: largest way of a point, source px (NaN: none moved). keys: in the frames touched, before and
    after. placed: keys that a person put or moved. accepted: places accepted. machine: a tracker made it.
    """

    points: tuple[Point, ...] = ()
    first: int | None = None
    last: int | None = None
    frames: int = 0
    before: tuple[str, ...] = ()
    after: tuple[str, ...] = ()
    moved: float = float("nan")
    keys: tuple[int, int] = (0, 0)
    placed: tuple[tuple[int, int], ...] = ()
    accepted: tuple[tuple[int, int], ...] = ()
    machine: bool = False


@dataclass
class Known:
    """What tracks and objects are called at some place of the history."""

    tracks: dict[int, TrackInfo] = field(default_factory=dict)
    objects: dict[int, ObjectInfo] = field(default_factory=dict)
    _changes: dict[int, list[TrackChange | ObjectChange]] = field(default_factory=dict)

    def do(self, seq: int, edit: Edit) -> None:
        """An edit was done; what it removes keeps its name until something else takes its place."""
        self._changes[seq] = [c for c in edit.changes if isinstance(c, TrackChange | ObjectChange)]
        self._put(seq, forward=True)

    def move(self, back: list[int], forth: list[int]) -> None:
        """Edits were undone and done again."""
        for seq in back:
            self._put(seq, forward=False)
        for seq in forth:
            self._put(seq, forward=True)

    def point(self, track: int) -> Point:
        """A track, as it is called."""
        info = self.tracks.get(track)
        if info is None:
            return Point(track, 0, "", 0)
        owner = self.objects.get(info.object)
        return Point(track, info.object, owner.name if owner is not None else "", info.number, info.name)

    def _put(self, seq: int, forward: bool) -> None:
        for change in self._changes[seq]:
            value = change.after if forward else change.before
            if isinstance(value, TrackInfo):
                self.tracks[change.id] = value
            elif isinstance(value, ObjectInfo):
                self.objects[change.id] = value


def words_of(edit: Edit, known: Known) -> Words:
    """What an edit did; `known` has it done already."""
    cells = [c for c in edit.changes if isinstance(c, CellsChange) and len(c.frames)]
    tracks = dict.fromkeys(c.track if isinstance(c, CellsChange) else c.id for c in edit.changes
                           if isinstance(c, CellsChange | TrackChange))  # fmt: skip
    if not tracks and edit.track is not None:
        tracks = {edit.track: None}
    points = tuple(known.point(track) for track in tracks)
    before, after = [], []
    for change in edit.changes:
        if not isinstance(change, CellsChange | ProposalChange):  # proposals follow what their points do
            sides = _sides(change)
            before += sides[0]
            after += sides[1]
    objects = [c for c in edit.changes if isinstance(c, ObjectChange)]
    points += tuple(Point(None, c.id, one.name, 0) for c in objects if (one := c.after or c.before) is not None)
    if not cells:
        return Words(points, edit.frame, edit.frame, int(edit.frame is not None), tuple(dict.fromkeys(before)),
                     tuple(dict.fromkeys(after)), machine=edit.machine)  # fmt: skip
    (old, old_ways), (new, new_ways) = _figures([c.before for c in cells]), _figures([c.after for c in cells])
    if old_ways and new_ways:
        old, new = old + old_ways, new + new_ways
    moved, place = _moved(cells), _place(edit, cells)
    before += [*place[0], *(words for words in old if words not in new)]
    after += [*place[1], *(words for words in new if words not in old)]
    if np.isfinite(moved) and moved > 0:
        many = sum(len(c.frames) for c in cells) > 1
        after.append(say("log_moved_most" if many else "log_moved", pixels=moved))
    frames = np.concatenate([c.frames for c in cells])
    hands = not edit.machine
    return Words(points, int(frames.min()), int(frames.max()), len(np.unique(frames)), tuple(dict.fromkeys(before)),
                 tuple(dict.fromkeys(after)), moved, (_count(cells, KEY, 0), _count(cells, KEY, 1)),
                 _placed(cells) if hands and edit.kind not in _CARRIED else (),
                 _accepted(cells) if hands and edit.kind not in _CARRIED else (), edit.machine)  # fmt: skip


def _figures(sides: list[Cells]) -> tuple[list[str], list[str]]:
    """States, keys, accepted places and doubts of some cells in words, and how what follows their keys is filled."""
    state, flags, mode = (
        np.concatenate([getattr(side, name) for side in sides]) for name in ("state", "flags", "mode")
    )
    found = [say(key, count=int((state == value).sum())) for value, key in _STATES if (state == value).any()]
    blank = int((state == NONE).sum())
    found += [say("log_none", count=blank)] if blank else []
    found += [say(key, count=int(((flags & bits) == value).sum())) for bits, value, key in _FLAGS]
    keyed = mode[(flags & KEY) > 0]
    return found, [say(key) for n, key in enumerate(_MODES) if (keyed == n).any()]


def _place(edit: Edit, cells: list[CellsChange]) -> tuple[list[str], list[str]]:
    """Where the one point that a person touched was and is, in the frame in which that happened."""
    alone = len(cells) == 1 and not edit.machine
    at = np.flatnonzero(cells[0].frames == edit.frame) if alone else np.zeros(0, np.int64)
    if not len(at) or (cells[0].before.xy[at[0]] == cells[0].after.xy[at[0]]).all():
        return [], []
    one, other = ([say("log_place", x=float(side.xy[at[0], 0]), y=float(side.xy[at[0], 1]))]
                  if side.state[at[0]] != NONE else [] for side in (cells[0].before, cells[0].after))  # fmt: skip
    return one, other


def _moved(cells: list[CellsChange]) -> float:
    """The largest way, source px, of places known on both sides; NaN if none is."""
    ways = []
    for change in cells:
        both = (change.before.state != NONE) & (change.after.state != NONE)
        if both.any():
            ways.append(float(np.linalg.norm(change.after.xy[both] - change.before.xy[both], axis=1).max()))
    return max(ways, default=float("nan"))


def _count(cells: list[CellsChange], bit: int, side: int) -> int:
    return sum(int(((c.after if side else c.before).flags & bit > 0).sum()) for c in cells)


def _placed(cells: list[CellsChange]) -> tuple[tuple[int, int], ...]:
    """(track, frame) of keys that were made or moved; the first placement of a point is one."""
    return _where(cells, lambda c: (c.after.flags & KEY > 0)
                  & ((c.before.flags & KEY == 0) | (c.before.xy != c.after.xy).any(axis=1)))  # fmt: skip


def _accepted(cells: list[CellsChange]) -> tuple[tuple[int, int], ...]:
    """(track, frame) of places that were accepted."""
    return _where(cells, lambda c: (c.after.flags & CONFIRMED > 0) & (c.before.flags & CONFIRMED == 0))


def _where(cells: list[CellsChange], which: object) -> tuple[tuple[int, int], ...]:
    return tuple((c.track, int(t)) for c in cells for t in c.frames[which(c)])  # type: ignore[operator]


def _sides(change: TrackChange | ObjectChange | MetaChange) -> tuple[list[str], list[str]]:
    """What differs between the two sides of a description, in words."""
    if isinstance(change, MetaChange):
        if change.key == "last_track":
            return [], []  # bookkeeping
        one, other = ([say("log_meta", what=change.key, name=v)] if v else [] for v in (change.before, change.after))
        return one, other
    if change.after is None:
        return [], [say("log_gone")]
    if change.before is None:
        told = [_field(n, change.after) for n in ("name", "status", "person") if hasattr(change.after, n)]
        return [], [say("log_made"), *filter(None, told)]
    before, after = change.before, change.after
    names = [f.name for f in fields(before) if getattr(before, f.name) != getattr(after, f.name)]
    return ([w for n in names if (w := _field(n, before))], [w for n in names if (w := _field(n, after))])


def _field(name: str, info: TrackInfo | ObjectInfo) -> str:
    """One field of a description in words, "" where nothing is to be said."""
    value = getattr(info, name)
    if name in ("review", "status"):
        return say(f"log_{value}")
    if name == "locked":
        return say("log_locked" if value else "log_unlocked")
    if name == "run":
        if value is None:
            return ""
        one = value[0] == value[1]
        return say("frame", first=value[0]) if one else say("frames", first=value[0], last=value[1])
    if name == "reason" and isinstance(info, TrackInfo):
        return str(value)  # a sentence already
    if name in _WORDY:
        return say(_WORDY[name], name=value) if value else ""
    return say(f"log_{name}", count=value) if name in ("order", "number", "mask", "rounds") else ""
