"""Tracks of a file into an annotation: whose they are, which point each of them is, and what they may fill.

A person's word stays: keys, confirmed and painted cells, cells a person placed and locked tracks are left as they are.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np

from genmojo_core.errors import GenmojoError
from genmojo_core.sentences import say
from genmojo_core.store.track_sheet import TrackSheet
from genmojo_core.tracks.annotation import (
    BY_HOLD,
    BY_LINE,
    CONFIRMED,
    HOLD,
    HUMAN,
    IMPORT,
    KEY,
    LINEAR,
    PAINTED,
    PROPOSED,
    Annotation,
    Cells,
    ObjectInfo,
    Proposal,
    TrackInfo,
)
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
from genmojo_core.tracks.interpolate import placed
from genmojo_core.tracks.model import NONE, VISIBLE, PointTracks

Masks = Callable[[int], np.ndarray | None]  # frame -> (h, w) object ids at any resolution, None where there are none
_NEAR = 0.02  # of the picture's height: a track this near a point of the same object is that point
_VOTES = 16  # frames of a track that are asked whose mask it lies on


@dataclass(frozen=True)
class Imported:
    """What an import does: the edit; tracks filled, made, locked (left alone); frames in which a person's word stayed;
    tracks without any place (left out); objects made."""

    edit: Edit
    filled: int
    made: int
    locked: int
    kept_frames: int
    placeless: int
    objects: int


@dataclass
class _Count:
    filled: int = 0
    made: int = 0
    locked: int = 0
    kept_frames: int = 0
    placeless: int = 0


@dataclass
class _Objects:
    """The objects an import touches; new ones get ids that no object has."""

    annotation: Annotation
    wanted: dict[int, str] = field(default_factory=dict)  # id -> name where the object is new

    def new(self, name: str) -> int:
        """The id of another object."""
        made = max([0, *self.annotation.objects, *self.wanted]) + 1
        self.wanted[made] = name
        return made

    def changes(self) -> list[Change]:
        """Objects that are wanted are chosen ones, in order after those that are."""
        order = max((o.order for o in self.annotation.objects.values()), default=0)
        found: list[Change] = []
        for owner, name in self.wanted.items():
            old = self.annotation.objects.get(owner)
            if old is not None and old.status == "chosen":
                continue
            order += 1
            plain = ObjectInfo(owner, name) if old is None else old
            found.append(ObjectChange(owner, old, replace(plain, status="chosen", order=order)))
        return found


def import_tracks(annotation: Annotation, sheet: TrackSheet, person: str = "", masks: Masks | None = None) -> Imported:
    """One edit that takes over a file's tracks, and what it does in figures.

    Args:
        sheet: of the file, T frames. person: who owns the new tracks. masks: of the clip, to find the object of tracks
            whose file does not say one that this annotation knows.
    Raises GenmojoError("schema") for another number of frames.
    """
    if sheet.tracks.state.shape[1] != annotation.frames:
        raise GenmojoError("schema", f"has {sheet.tracks.state.shape[1]} frames, the clip has {annotation.frames}",
                           "import", "export it from this clip")  # fmt: skip
    known = (sheet.tracks.state != NONE) & np.isfinite(sheet.tracks.xy).all(axis=-1)
    placeless = int((~known.any(axis=1)).sum())
    sheet = sheet.select(known.any(axis=1))
    sheet = replace(sheet, tracks=placed(sheet.tracks.resized(*annotation.size)))
    objects = _Objects(annotation)
    owners = _owners(annotation, sheet, objects, masks)
    numbers = _numbers(annotation, sheet, owners)
    count = _Count(placeless=placeless)
    changes: list[Change] = objects.changes()
    new_objects = sum(1 for change in changes if isinstance(change, ObjectChange) and change.before is None)
    there = {(i.object, i.number): i for i in annotation.tracks.values()}
    last = annotation.new_track_id() - 1
    for row, place in enumerate(zip(owners, numbers, strict=True)):
        info = there.get(place)
        if info is None:
            last += 1
            made = TrackInfo(last, *place, sheet.point_name(row), person)
            frames, after = imported_cells(Cells.empty(annotation.frames), sheet.tracks, row)
            changes += [TrackChange(last, None, made), CellsChange(last, frames, Cells.empty(len(frames)), after),
                        *_led(annotation, last, frames, after)]  # fmt: skip
            count.made += 1
        else:
            changes += _into(annotation, info, sheet, row, count)
    if count.made:
        changes.append(MetaChange("last_track", annotation.meta.get("last_track"), str(last)))
    edit = Edit("import", say("import", count=count.filled + count.made), tuple(changes), 0, None)
    return Imported(edit, count.filled, count.made, count.locked, count.kept_frames, placeless, new_objects)


def imported_cells(before: Cells, tracks: PointTracks, row: int) -> tuple[np.ndarray, Cells]:
    """Frames (n,) int32 that a file's track may fill, and their cells; flags and sources are the file's, if told."""
    free = (before.flags & (KEY | CONFIRMED | PAINTED)) == 0
    free &= (before.source != HUMAN) & (tracks.state[row] != NONE)
    frames = np.flatnonzero(free)
    count = len(frames)

    def cells(array: np.ndarray | None, other: float, dtype: type) -> np.ndarray:
        return np.full(count, other, dtype) if array is None else array[row, frames].astype(dtype)

    flags, source = cells(tracks.flags, 0, np.uint8), cells(tracks.source, IMPORT, np.uint8)
    mode = np.zeros(len(before), np.uint8)
    if tracks.source is not None and tracks.flags is not None:
        following = np.append(tracks.source[row, 1:], 0)
        is_key = (tracks.flags[row] & KEY) > 0
        mode[is_key & (following == LINEAR)], mode[is_key & (following == HOLD)] = BY_LINE, BY_HOLD
    return frames.astype(np.int32), Cells(tracks.xy[row, frames].astype(np.float32), tracks.state[row, frames], flags,
                                          source, cells(tracks.conf, 0.5, np.float32), mode[frames])  # fmt: skip


def nearest_object(labels: np.ndarray, share: np.ndarray) -> int:
    """The id whose mask in labels (h, w) covers a place, or is nearest; 0 without any. share (2,) of the picture."""
    size = np.array(labels.shape[::-1])
    x, y = np.clip((share * size).astype(int), 0, size - 1)
    if labels[y, x]:
        return int(labels[y, x])
    rows, columns = np.nonzero(labels)
    if not len(rows):
        return 0
    away = np.square(columns + 0.5 - share[0] * size[0]) + np.square(rows + 0.5 - share[1] * size[1])
    nearest = int(np.argmin(away))
    return int(labels[rows[nearest], columns[nearest]])


def _into(annotation: Annotation, info: TrackInfo, sheet: TrackSheet, row: int, count: _Count) -> list[Change]:
    """What a file's track changes in a point that is there."""
    if info.locked:
        count.locked += 1
        return []
    before = annotation.track(info.id)
    frames, after = imported_cells(before, sheet.tracks, row)
    count.kept_frames += int((sheet.tracks.state[row] != NONE).sum()) - len(frames)
    change = cells_change(annotation, info.id, frames, after)
    found: list[Change] = []
    if not info.name and sheet.point_name(row):
        found.append(TrackChange(info.id, info, replace(info, name=sheet.point_name(row))))
    if change is not None:
        found += [change, *_led(annotation, info.id, frames, after)]
    count.filled += bool(found)
    return found


def _led(annotation: Annotation, track: int, frames: np.ndarray, after: Cells) -> list[ProposalChange]:
    """What the file says was proposed by a tracker goes on to lead the track, not what is proposed here so far."""
    found: list[ProposalChange] = []
    for name in [name for name, code in PROPOSED.items() if (after.source == code).any()]:
        way = Cells.empty(annotation.frames)
        way.xy[frames], way.state[frames], way.conf[frames] = after.xy, after.state, after.conf
        own = annotation.proposals.get(track, {}).get(name)
        proposal = Proposal(name, way.xy, way.state, way.conf)
        found += given(track, {} if own is None else {name: own}, {name: proposal}, frames, annotation.frames)
    return found


def _owners(annotation: Annotation, sheet: TrackSheet, objects: _Objects, masks: Masks | None) -> list[int]:
    """The object of every track: told, else of that name, else of the masks it lies on, else a new one."""
    told = sheet.tracks.object
    names = {o.name.casefold(): o.id for o in annotation.objects.values() if o.name}
    whose: dict[int, int] = {}
    votes = _Votes(sheet.tracks, masks)
    for owner in np.unique(told[told != 0]).tolist():
        name = sheet.name_of(owner)
        if sheet.owners_told:
            found = owner
        else:
            found = names.get(name.casefold(), 0) or votes.of(np.flatnonzero(told == owner), set(whose.values()))
        whose[owner] = found or objects.new(name)
        objects.wanted.setdefault(whose[owner], name)
    loose = 0
    owners = []
    for row, owner in enumerate(told.tolist()):
        found = whose[owner] if owner else votes.of(np.array([row]), set())
        if not found:
            found = loose = loose or objects.new("imported")
        objects.wanted.setdefault(found, f"object {found}")
        owners.append(found)
    return owners


class _Votes:
    """Whose masks tracks lie on, each frame's masks read once."""

    def __init__(self, tracks: PointTracks, masks: Masks | None) -> None:
        self._tracks, self._masks = tracks, masks
        self._held: dict[int, np.ndarray | None] = {}

    def of(self, rows: np.ndarray, taken: set[int]) -> int:
        """The id most of some tracks' visible places lie on, of those not taken; 0 if there is none.

        One track alone is asked about in its first visible frame only: there it was placed.
        """
        votes: dict[int, int] = {}
        for row in rows.tolist():
            seen = np.flatnonzero(self._tracks.visible[row])
            asked = seen[:1] if len(rows) == 1 else seen[:: max(1, len(seen) // _VOTES)]
            for t in asked.tolist():
                labels = self._labels(t)
                if labels is None:
                    continue
                found = nearest_object(labels, self._tracks.xy[row, t] / np.array(self._tracks.size))
                if found and found not in taken:
                    votes[found] = votes.get(found, 0) + 1
        return max(votes, key=lambda owner: votes[owner]) if votes else 0

    def _labels(self, t: int) -> np.ndarray | None:
        if self._masks is not None and t not in self._held:
            self._held[t] = self._masks(t)
        return self._held.get(t)


def _numbers(annotation: Annotation, sheet: TrackSheet, owners: list[int]) -> list[int]:
    """The number of every track within its object, no two alike: told, else of the point it runs along, else free."""
    out = [0] * len(owners)
    used: set[tuple[int, int]] = set()
    named = {(i.object, i.name.casefold()): i.number for i in annotation.tracks.values() if i.name}
    if sheet.numbers_told:
        for row, (owner, number) in enumerate(zip(owners, sheet.numbers.tolist(), strict=True)):
            number = named.get((owner, sheet.point_name(row).casefold()), number) if not sheet.owners_told else number
            if number > 0 and (owner, number) not in used and sheet.tracks.object[row]:
                out[row] = number
                used.add((owner, number))
    else:
        for row, owner in enumerate(owners):
            out[row] = _along(annotation, sheet.tracks, row, owner, used)
            used.add((owner, out[row]))
    taken = used | {(i.object, i.number) for i in annotation.tracks.values()}
    for row, owner in enumerate(owners):
        if not out[row]:
            out[row] = next(n for n in range(1, len(taken) + 2) if (owner, n) not in taken)
            taken.add((owner, out[row]))
    return out


def _along(annotation: Annotation, tracks: PointTracks, row: int, owner: int, used: set[tuple[int, int]]) -> int:
    """The number of the object's point that a track runs along, 0 if there is none."""
    best, least = 0, _NEAR * annotation.size[1]
    for info in annotation.tracks_of(owner):
        cells = annotation.track(info.id)
        both = (cells.state == VISIBLE) & tracks.visible[row]
        if (owner, info.number) not in used and both.any():
            away = float(np.median(np.linalg.norm(cells.xy[both] - tracks.xy[row, both], axis=1)))
            if away <= least:
                best, least = info.number, away
    return best
