"""The annotation of a clip in memory: objects, point tracks, and what is known of every point in every frame.

Views read it, edits (`tracks/edits.py`) change it, `store/project.py` keeps it. Positions are raster pixels of the
clip's source. Cells are held frame by frame, so what one frame shows is one slice however long the clip is.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field
from typing import Any, Literal

import numpy as np

from genmojo_core.errors import GenmojoError
from genmojo_core.sentences import say
from genmojo_core.tracks.model import NONE, PointTracks

KEY, UNCERTAIN, CONFIRMED, SNAPPED, PAINTED = 1, 2, 4, 8, 16  # flags: a person placed it; ...; gave its state
HUMAN, TRACKER, FLOW, LINEAR, IMPORT, HOLD = 1, 2, 3, 4, 5, 6  # source of a position; 0 for none
SCENE, COTRACKER, FILE = 7, 8, 9  # ... by the proposal of that tracker, which goes on to lead it between new keys
EARLIER = " before"  # behind a tracker's name: what it proposed the time before
PROPOSED = {"scene": SCENE, "cotracker": COTRACKER, "file": FILE}
BY_TRACKER, BY_LINE, BY_HOLD = 0, 1, 2  # mode of the segment that begins at a key

ObjectStatus = Literal["candidate", "chosen", "rejected"]
Review = Literal["draft", "in_progress", "needs_fix", "fixed", "approved", "rejected"]
_FAULTS = ("drift", "jump", "swap", "occlusion", "part", "imprecise")
REASONS = tuple(say(f"fault_{name}") for name in _FAULTS)  # why a reviewer returns a track


@dataclass(frozen=True)
class ObjectInfo:
    """An object: `id` of its mask, name, place in the order (1..), whether it is annotated, and why.

    `mask` names the mask that a person drew for it (blob `mask:<number>` of the project); 0 is the clip's own.
    """

    id: int
    name: str
    order: int = 0
    status: ObjectStatus = "candidate"
    reason: str = ""
    mask: int = 0


@dataclass(frozen=True)
class TrackInfo:
    """A track: key point `number` (1..5) of an object, who made it, and where its review stands.

    `reason`, `run` (first and last frame, both included) and `review_note` are what `reviewer` found in the decision
    that stands; `note` is the annotators' own. `rounds` counts how often the track went back to `person`.
    """

    id: int
    object: int
    number: int
    name: str = ""
    person: str = ""
    review: Review = "draft"
    reviewer: str = ""
    reason: str = ""
    run: tuple[int, int] | None = None
    note: str = ""
    rounds: int = 0
    locked: bool = False
    review_note: str = ""


@dataclass(frozen=True)
class Cells:
    """What is known of one track in n frames.

    xy (n, 2) float32 raster pixels (0 where state is NONE), state (n,) uint8, flags (n,) uint8 (KEY | ...), source
    (n,) uint8, conf (n,) float32 0..1, mode (n,) uint8 of the segment that begins here.
    """

    xy: np.ndarray
    state: np.ndarray
    flags: np.ndarray
    source: np.ndarray
    conf: np.ndarray
    mode: np.ndarray

    def __len__(self) -> int:
        return len(self.state)

    def copy(self) -> Cells:
        """Arrays of its own."""
        return Cells(*(np.array(a) for a in self.arrays()))

    def arrays(self) -> tuple[np.ndarray, ...]:
        """All arrays, in the order of the fields."""
        return self.xy, self.state, self.flags, self.source, self.conf, self.mode

    @staticmethod
    def empty(count: int) -> Cells:
        """Cells that know nothing."""
        small = [np.zeros(count, np.uint8) for _ in range(4)]
        return Cells(np.zeros((count, 2), np.float32), small[0], small[1], small[2], np.zeros(count, np.float32),
                     small[3])  # fmt: skip


@dataclass(frozen=True)
class FrameView:
    """All tracks with a state in one frame: ids (n,), rows (n,), xy (n, 2), state, flags, conf (n,)."""

    ids: np.ndarray
    rows: np.ndarray
    xy: np.ndarray
    state: np.ndarray
    flags: np.ndarray
    conf: np.ndarray


@dataclass(frozen=True)
class Proposal:
    """What a tracker proposes for one track; never touched by edits.

    tracker: its name. xy (T, 2) float32 raster px, state (T,) uint8, conf (T,) float32 0..1.
    """

    tracker: str
    xy: np.ndarray
    state: np.ndarray
    conf: np.ndarray


@dataclass
class Touched:
    """What an edit changed, for views: track ids, object ids, first and last frame (0, -1 if no cell changed)."""

    tracks: set[int] = field(default_factory=set)
    objects: set[int] = field(default_factory=set)
    first: int = 0
    last: int = -1

    def add_frames(self, first: int, last: int) -> None:
        """Widen the range of frames."""
        if self.last < self.first:
            self.first, self.last = first, last
        else:
            self.first, self.last = min(self.first, first), max(self.last, last)

    def add(self, other: Touched) -> None:
        """What another edit changed, too."""
        self.tracks |= other.tracks
        self.objects |= other.objects
        if other.last >= other.first:
            self.add_frames(other.first, other.last)


class Annotation:
    """Objects and tracks of one clip.

    Args:
        frames: number of frames T.
        size: (width, height) of the clip's source.
    """

    def __init__(self, frames: int, size: tuple[int, int]) -> None:
        if frames < 1 or min(size) < 1:
            raise GenmojoError("value", f"{frames} frames of {size[0]} x {size[1]} pixels cannot be annotated")
        self.frames = frames
        self.size = size
        self.objects: dict[int, ObjectInfo] = {}
        self.tracks: dict[int, TrackInfo] = {}
        self.meta: dict[str, str] = {}
        self.proposals: dict[int, dict[str, Proposal]] = {}
        self.listeners: list[Callable[[Touched], None]] = []
        self.revision = 0  # grows with every edit done or undone
        self._held: Touched | None = None  # what listeners are told later
        self._rows: dict[int, int] = {}
        self._ids = np.zeros(0, np.int64)  # row -> track id, -1 where free
        self._aside = np.zeros(0, bool)  # row -> whether its track's object was rejected
        self._cells = _blank(frames, 0)

    def at(self, t: int) -> FrameView:
        """Every active track that has a state in frame t, in order of rows. Costs the same for any number of frames."""
        c = self._cells
        rows = np.flatnonzero((c.state[t] > 0) & ~self._aside)
        return FrameView(self._ids.take(rows), rows, *(a[t].take(rows, 0) for a in (c.xy, c.state, c.flags, c.conf)))

    def track(self, track: int) -> Cells:
        """All T frames of a track: views, not to be written to."""
        row = self.row(track)
        return Cells(*(a[:, row] for a in self._cells.arrays()))

    def cells(self, track: int, frames: np.ndarray) -> Cells:
        """Copies of some frames of a track."""
        row = self.row(track)
        return Cells(*(a[frames, row] for a in self._cells.arrays()))

    def window(self, tracks: list[int], first: int, end: int) -> tuple[np.ndarray, np.ndarray]:
        """xy (end - first, n, 2) and state (end - first, n) of some tracks, for trails and the dope sheet."""
        rows = [self.row(track) for track in tracks]
        return self._cells.xy[first:end, rows], self._cells.state[first:end, rows]

    def flags(self, tracks: list[int], frames: np.ndarray) -> np.ndarray:  # (n, tracks) uint8
        """Flags of some tracks in frames (n,), copied."""
        rows = [self.row(track) for track in tracks]
        return self._cells.flags[frames].take(rows, axis=1)

    def row(self, track: int) -> int:
        """Row of a track. Raises GenmojoError("argument") if there is none of that id."""
        if track not in self._rows:
            raise GenmojoError("argument", f"there is no track {track}")
        return self._rows[track]

    def keys(self, track: int) -> np.ndarray:
        """Frames (n,) in which a person placed the point, rising."""
        return np.flatnonzero(self._cells.flags[:, self.row(track)] & KEY)

    def segment(self, track: int, t: int) -> tuple[int | None, int | None]:
        """The keys around frame t: the last at or before it, the first after it; None where there is none."""
        keys = self.keys(track)
        at = int(np.searchsorted(keys, t, side="right"))
        return int(keys[at - 1]) if at else None, int(keys[at]) if at < len(keys) else None

    def tracks_of(self, object_id: int) -> list[TrackInfo]:
        """Tracks of an object by their number."""
        return sorted((i for i in self.tracks.values() if i.object == object_id), key=lambda i: (i.number, i.id))

    def active(self) -> list[TrackInfo]:
        """Tracks that are worked on and given away: all but those of rejected objects, which are put aside."""
        return [i for i in self.tracks.values() if not self._is_aside(i)]

    def chosen_objects(self) -> list[ObjectInfo]:
        """Objects that are annotated, in their order."""
        return sorted((o for o in self.objects.values() if o.status == "chosen"), key=lambda o: (o.order, o.id))

    def new_track_id(self) -> int:
        """An id no track has; ids of deleted tracks may come back only with them."""
        return max([*self.tracks, int(self.meta.get("last_track", "0"))], default=0) + 1

    def propose(self, track: int, proposal: Proposal) -> None:
        """Keep a tracker's proposal beside the track; the track itself is not changed (see `edits.accept`)."""
        self.row(track)
        self.proposals.setdefault(track, {})[proposal.tracker] = proposal

    def to_tracks(self, tracks: list[int] | None = None) -> PointTracks:
        """Tracks as `PointTracks`, by default the active ones by object, number and id; unknown positions are NaN."""
        if tracks is None:
            place = {o.id: n for n, o in enumerate(self.chosen_objects())}
            infos = sorted(self.active(), key=lambda i: (place.get(i.object, len(place)), i.number, i.id))
            tracks = [i.id for i in infos]
        rows = [self.row(track) for track in tracks]
        c = Cells(*(np.moveaxis(a[:, rows], 0, 1).copy() for a in self._cells.arrays()))
        xy = np.where((c.state == NONE)[..., None], np.float32(np.nan), c.xy)
        owner = np.array([self.tracks[track].object for track in tracks], np.int64)
        return PointTracks(xy, c.state, owner, self.size, None, c.conf, c.flags, c.source)

    def copy(self) -> Annotation:
        """All of it as it stands, for another thread; nobody listens to the copy."""
        made = Annotation(self.frames, self.size)
        made.objects, made.tracks, made.meta = dict(self.objects), dict(self.tracks), dict(self.meta)
        made.proposals = {track: dict(kept) for track, kept in self.proposals.items()}
        made.revision, made._rows = self.revision, dict(self._rows)
        made._ids, made._aside, made._cells = self._ids.copy(), self._aside.copy(), self._cells.copy()
        return made

    def digest(self) -> str:
        """SHA-256 over everything an edit can change; equal for equal annotations."""
        total = hashlib.sha256(repr((self.frames, self.size, sorted(self.meta.items()))).encode())
        for table in (self.objects, self.tracks):
            for key in sorted(table):
                total.update(repr(asdict(table[key])).encode())  # type: ignore[index]
        for track in sorted(self.tracks):
            for array in self.track(track).arrays():
                total.update(np.ascontiguousarray(array).tobytes())
        return total.hexdigest()

    # Used by edits and by the project file only.

    def write_cells(self, track: int, frames: np.ndarray, cells: Cells) -> None:
        """Overwrite some frames of a track."""
        row = self.row(track)
        for mine, theirs in zip(self._cells.arrays(), cells.arrays(), strict=True):
            mine[frames, row] = theirs

    def put_object(self, object_id: int, info: ObjectInfo | None) -> None:
        """Set or remove an object."""
        _put(self.objects, object_id, info)
        for track in self.tracks_of(object_id):
            self._aside[self._rows[track.id]] = self._is_aside(track)

    def put_track(self, track: int, info: TrackInfo | None) -> None:
        """Set or remove a track's description; a removed one loses its row, a new one begins without any state."""
        if info is None and track in self._rows:
            row = self._rows.pop(track)
            for array in self._cells.arrays():
                array[:, row] = 0
            self._ids[row], self._aside[row] = -1, False
        elif info is not None and track not in self._rows:
            free = np.flatnonzero(self._ids < 0)
            if not len(free):
                self.reserve(max(32, 2 * len(self._ids)))
                free = np.flatnonzero(self._ids < 0)
            self._rows[track] = int(free[0])
            self._ids[free[0]] = track
        _put(self.tracks, track, info)
        if info is not None:
            self._aside[self._rows[track]] = self._is_aside(info)

    def put_meta(self, key: str, value: str | None) -> None:
        """Set or remove a note about the whole annotation."""
        _put(self.meta, key, value)

    def put_proposal(self, track: int, tracker: str, proposal: Proposal | None) -> None:
        """Set or remove a tracker's proposal."""
        _put(self.proposals.setdefault(track, {}), tracker, proposal)

    def reserve(self, count: int) -> None:
        """Make room for `count` tracks in all, so that adding many does not copy often."""
        if count <= len(self._ids):
            return
        grown = _blank(self.frames, count)
        for old, new in zip(self._cells.arrays(), grown.arrays(), strict=True):
            new[:, : len(self._ids)] = old
        self._cells = grown
        self._ids = np.concatenate([self._ids, np.full(count - len(self._ids), -1, np.int64)])
        self._aside = np.concatenate([self._aside, np.zeros(count - len(self._aside), bool)])

    def _is_aside(self, track: TrackInfo) -> bool:
        owner = self.objects.get(track.object)
        return owner is not None and owner.status == "rejected"

    @contextmanager
    def at_once(self) -> Iterator[None]:
        """Listeners are told of all that is done inside together, at its end: of hundreds of edits as of one."""
        held = self._held = Touched()
        before = self.revision
        try:
            yield
        finally:
            self._held = None
            if self.revision != before:
                self.notify(held)

    def notify(self, touched: Touched) -> None:
        """Count the change and tell every listener."""
        self.revision += 1
        if self._held is not None:
            self._held.add(touched)
            return
        for listener in tuple(self.listeners):
            listener(touched)


def _blank(frames: int, count: int) -> Cells:
    """Cells (T, N): untouched zeros cost no memory until they are written."""
    small = [np.zeros((frames, count), np.uint8) for _ in range(4)]
    return Cells(np.zeros((frames, count, 2), np.float32), small[0], small[1], small[2],
                 np.zeros((frames, count), np.float32), small[3])  # fmt: skip


def _put(table: dict[Any, Any], key: Any, value: Any) -> None:
    """Set, or remove with None."""
    if value is None:
        table.pop(key, None)
    else:
        table[key] = value
