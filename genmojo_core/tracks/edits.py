"""Edits: pure data with the values before and after, so each does and undoes itself.

An `Edit` is made by one of the functions in `tracks/keys.py`, `tracks/edit_tracks.py` and here from the annotation as
it stands; `Project.do` applies and stores it. Nothing a machine proposes changes a cell that a person placed or
confirmed.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from genmojo_core.sentences import say
from genmojo_core.tracks.annotation import Annotation, Cells, ObjectInfo, Proposal, Touched, TrackInfo


@dataclass(frozen=True)
class CellsChange:
    """Frames (n,) int32 of a track, before and after."""

    track: int
    frames: np.ndarray
    before: Cells
    after: Cells


@dataclass(frozen=True)
class TrackChange:
    """A track's description; None before: it is made, None after: it is removed (its cells are emptied first)."""

    id: int
    before: TrackInfo | None
    after: TrackInfo | None


@dataclass(frozen=True)
class ObjectChange:
    """An object's description; None before: it is made, None after: it is removed."""

    id: int
    before: ObjectInfo | None
    after: ObjectInfo | None


@dataclass(frozen=True)
class MetaChange:
    """A note about the whole annotation (consent, ...)."""

    key: str
    before: str | None
    after: str | None


@dataclass(frozen=True)
class ProposalChange:
    """What a tracker proposed for a track, where tracks exchange their frames; None: nothing is kept of it."""

    track: int
    tracker: str
    before: Proposal | None
    after: Proposal | None


Change = CellsChange | TrackChange | ObjectChange | MetaChange | ProposalChange


@dataclass(frozen=True)
class Edit:
    """One change of an annotation.

    Args:
        kind: short name, e.g. "key", "states", "solve".
        title: what the history keeps, English words of `sentences.say`, e.g. "Place point 2 of dog".
        changes: in the order they are done.
        frame, track: where to look when it is done or undone; None if nowhere in particular.
        machine: made by a tracker, not by a person.
    """

    kind: str
    title: str
    changes: tuple[Change, ...] = field(default=())
    frame: int | None = None
    track: int | None = None
    machine: bool = False

    def do(self, annotation: Annotation) -> Touched:
        """Apply; listeners are told once."""
        return _apply(annotation, self.changes, forward=True)

    def undo(self, annotation: Annotation) -> Touched:
        """Take back; the annotation must be as it was after `do`."""
        return _apply(annotation, self.changes[::-1], forward=False)


def cells_change(annotation: Annotation, track: int, frames: np.ndarray, after: Cells) -> CellsChange | None:
    """A change of the frames in which `after` differs from what stands; None where none does."""
    frames = np.asarray(frames, np.int32)
    before = annotation.cells(track, frames)
    differs = np.zeros(len(frames), bool)
    for old, new in zip(before.arrays(), after.arrays(), strict=True):
        unequal = old != new
        differs |= unequal.any(axis=1) if unequal.ndim > 1 else unequal
    if not differs.any():
        return None
    return CellsChange(track, frames[differs], _rows(before, differs), _rows(after, differs))


def join(kind: str, title: str, parts: list[Edit]) -> Edit:
    """Several edits, each made on the annotation as it stands and touching cells of its own, as one."""
    first = next((p for p in parts if p.changes), parts[0] if parts else Edit(kind, title))
    changes = tuple(change for part in parts for change in part.changes)
    return Edit(kind, title, changes, first.frame, first.track, all(p.machine for p in parts) and bool(parts))


def set_meta(annotation: Annotation, key: str, value: str | None) -> Edit:
    """Set or remove (None) a note about the whole annotation, e.g. "consent"."""
    return Edit("note", say("set_note", what=key), (MetaChange(key, annotation.meta.get(key), value),))


def _apply(annotation: Annotation, changes: tuple[Change, ...], forward: bool) -> Touched:
    touched = Touched()
    for change in changes:
        value = change.after if forward else change.before
        if isinstance(change, CellsChange):
            annotation.write_cells(change.track, change.frames, value)  # type: ignore[arg-type]
            touched.tracks.add(change.track)
            if len(change.frames):
                touched.add_frames(int(change.frames.min()), int(change.frames.max()))
        elif isinstance(change, TrackChange):
            annotation.put_track(change.id, value)  # type: ignore[arg-type]
            touched.tracks.add(change.id)
        elif isinstance(change, ObjectChange):
            annotation.put_object(change.id, value)  # type: ignore[arg-type]
            touched.objects.add(change.id)
        elif isinstance(change, ProposalChange):
            annotation.put_proposal(change.track, change.tracker, value)  # type: ignore[arg-type]
        else:
            annotation.put_meta(change.key, value)  # type: ignore[arg-type]
    annotation.notify(touched)
    return touched


def _rows(cells: Cells, rows: np.ndarray) -> Cells:
    """Some of the cells."""
    return Cells(*(a[rows] for a in cells.arrays()))
