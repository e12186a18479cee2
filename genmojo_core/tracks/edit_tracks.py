"""Edits of objects and whole tracks: make, delete, rename, and the steps of a review."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from genmojo_core.errors import GenmojoError
from genmojo_core.sentences import say
from genmojo_core.tracks import review
from genmojo_core.tracks.annotation import REASONS, Annotation, Cells, ObjectInfo, TrackInfo
from genmojo_core.tracks.edits import Edit, MetaChange, ObjectChange, TrackChange, cells_change
from genmojo_core.tracks.model import NONE


def put_objects(annotation: Annotation, objects: list[ObjectInfo], title: str = "") -> Edit:
    """Make objects, or give existing ones (same id) another description."""
    changes = tuple(ObjectChange(o.id, annotation.objects.get(o.id), o) for o in objects
                    if annotation.objects.get(o.id) != o)  # fmt: skip
    return Edit("objects", title or say("set_objects"), changes)


def add_track(annotation: Annotation, object_id: int, number: int, person: str = "", name: str = "") -> Edit:
    """An empty track for key point `number` of an object; its id is `edit.track`.

    Raises GenmojoError("argument") if the object already has that point.
    """
    if object_id and object_id not in annotation.objects:
        raise GenmojoError("argument", f"there is no object {object_id}")
    if any(i.number == number for i in annotation.tracks_of(object_id)):
        raise GenmojoError("argument", f"object {object_id} already has a point {number}")
    track = annotation.new_track_id()
    info = TrackInfo(track, object_id, number, name, person)
    last = MetaChange("last_track", annotation.meta.get("last_track"), str(track))
    return Edit("track", say("add_point", number=number), (last, TrackChange(track, None, info)), 0, track)


def delete_track(annotation: Annotation, track: int) -> Edit:
    """Remove a track with all its cells; undo brings them back."""
    info = unlocked(annotation, track)
    cells = cells_change(annotation, track, np.arange(annotation.frames), Cells.empty(annotation.frames))
    gone = TrackChange(track, info, None)
    changes = (gone,) if cells is None else (cells, gone)
    return Edit("delete", say("delete_point", number=info.number), changes, 0, track)


def update_track(annotation: Annotation, track: int, title: str = "", frame: int | None = None, **fields: Any) -> Edit:
    """Give a track another name, number, person, lock, ... (fields of TrackInfo)."""
    info = annotation.tracks[track] if track in annotation.tracks else unlocked(annotation, track)
    new = replace(info, **fields)
    changes = (TrackChange(track, info, new),) if new != info else ()
    return Edit("track", title or say("change_point", number=info.number), changes, frame, track)


def begin(annotation: Annotation, track: int) -> Edit:
    """A person works on a track: a draft is in progress from now on; any other stays as it is."""
    info = annotation.tracks[track]
    stands = review.after(info, "begin") if review.allowed(info.review, "begin") else info.review
    return update_track(annotation, track, review=stands)


def needs_fix(annotation: Annotation, track: int, reason: str, run: tuple[int, int], reviewer: str, note: str) -> Edit:
    """A reviewer returns a track to its annotator with a reason of REASONS and the frames (first, last) concerned.

    Returning what has not come back yet says it anew and is no further round.
    """
    if reason not in REASONS:
        raise GenmojoError("argument", f"'{reason}' is no reason", hint=f"use {', '.join(REASONS)}")
    info = annotation.tracks[track]
    title = say("needs_fix_note", reason=reason, name=note) if note else say("needs_fix", reason=reason)
    return update_track(annotation, track, title, run[0], review=review.after(info, "return"), reason=reason, run=run,
                        reviewer=reviewer, review_note=note, rounds=info.rounds + (info.review != "needs_fix"),
                        locked=False)  # fmt: skip


def fixed(annotation: Annotation, track: int) -> Edit:
    """The annotator answers: the spot was worked on. What the reviewer said stays for the next look.

    Raises GenmojoError("argument") unless a reviewer returned the track.
    """
    info = annotation.tracks[track]
    return update_track(annotation, track, say("fixed"), info.run[0] if info.run else 0,
                        review=review.after(info, "fix"))  # fmt: skip


def approve(annotation: Annotation, track: int, reviewer: str, note: str = "") -> Edit:
    """A reviewer is content; the track is locked. Every frame must have a state.

    Raises GenmojoError("argument") where one has not, and if the track is approved already.
    """
    stands = review.after(annotation.tracks[track], "approve")
    blank = np.flatnonzero(annotation.track(track).state == NONE)
    if len(blank):
        raise GenmojoError("argument", f"track {track} says nothing about frame {blank[0]} and {len(blank) - 1} others",
                           hint="annotate them first")  # fmt: skip
    return update_track(annotation, track, say("approve"), 0, review=stands, reviewer=reviewer, reason="", run=None,
                        review_note=note, locked=True)  # fmt: skip


def reject(annotation: Annotation, track: int, reviewer: str, note: str) -> Edit:
    """A reviewer gives a track up. Raises GenmojoError("argument") if it is given up already."""
    stands = review.after(annotation.tracks[track], "reject")
    title = say("reject_note", name=note) if note else say("reject")
    return update_track(annotation, track, title, 0, review=stands, reviewer=reviewer, reason="", run=None,
                        review_note=note)  # fmt: skip


def lock(annotation: Annotation, track: int, frame: int, *, on: bool) -> Edit:
    """Lock a track or unlock it. Unlocking an approved one takes the approval back."""
    info = annotation.tracks[track]
    stands = review.after(info, "reopen") if not on and review.allowed(info.review, "reopen") else info.review
    return update_track(annotation, track, say("lock" if on else "unlock"), frame, locked=on, review=stands)


def unlocked(annotation: Annotation, track: int) -> TrackInfo:
    """A track's description. Raises GenmojoError("argument") if it is missing or locked."""
    annotation.row(track)
    info = annotation.tracks[track]
    if info.locked:
        raise GenmojoError("argument", f"track {track} is locked", hint="unlock it first")
    return info
