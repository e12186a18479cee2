"""The four steps of annotating a clip, as data: what each is for, its buttons, its page, and when it is done.

The paper names four steps without listing them; a better reading of it changes this file and nothing else.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from genmojo_core.tracks.annotation import CONFIRMED, KEY, Annotation
from genmojo_core.tracks.model import NONE
from genmojo_core.tracks.review import SETTLED, returned
from genmojo_studio.annotate.session import OBJECTS
from genmojo_studio.translate import mark, tr

MANY = 100
Gate = Callable[[Annotation, int, int], str]


@dataclass(frozen=True)
class Step:
    """A step: title, what to do in a sentence, action ids of its buttons in groups, its page of the information panel.

    `missing(annotation, points, stride)` says what is still to be done in a sentence, "" when the step is done.

    clicks: a click in the frame places or moves the active point. places_points: clicks place one point after the
    other, those of each object on the frame in which it is first seen. needs_track: begins with a track on show.
    shows_strip: begins with the stabilised strip on show.
    """

    name: str
    title: str
    task: str
    buttons: tuple[tuple[str, tuple[str, ...]], ...]
    page: str
    missing: Gate
    clicks: bool = True
    places_points: bool = False
    needs_track: bool = False
    shows_strip: bool = False


def _objects_missing(annotation: Annotation, points: int, stride: int) -> str:
    chosen = annotation.chosen_objects()
    if not chosen:
        return tr("Choose at least one object.")
    most = int(annotation.meta.get("limit_objects", OBJECTS))
    if len(chosen) > most:
        return tr("{n} objects are chosen, at most {most} are wanted.").format(n=len(chosen), most=most)
    if any(not o.name.strip() for o in chosen):
        return tr("Give every chosen object a name.")
    unjudged = [o for o in annotation.objects.values() if o.status == "candidate"]
    if unjudged:
        return tr("{n} candidates are neither chosen nor rejected.").format(n=len(unjudged))
    return ""


def _points_missing(annotation: Annotation, points: int, stride: int) -> str:
    lacking = sum(max(0, points - len(annotation.tracks_of(o.id))) for o in annotation.chosen_objects())
    tracks = annotation.active()
    if lacking or not tracks:
        return tr("{n} points are still to be placed.").format(n=lacking or points)
    blank = 0
    for info in tracks:
        blank += bool((annotation.track(info.id).state == NONE).any())
        if blank >= MANY:
            return tr("More than {n} tracks are not seeded.").format(n=MANY)
    return tr("{n} tracks are not seeded.").format(n=blank) if blank else ""


def _refine_missing(annotation: Annotation, points: int, stride: int) -> str:
    tracks = annotation.active()
    if not tracks:
        return tr("{n} points are still to be placed.").format(n=points)
    back = returned(annotation)
    if back:
        return tr("{n} tracks came back from the review.").format(n=len(back))
    frames = np.arange(0, annotation.frames, stride)
    open_frames = 0
    for info in tracks:
        if not info.locked:
            open_frames += int(((annotation.track(info.id).flags[frames] & (KEY | CONFIRMED)) == 0).sum())
        if open_frames >= 10 * MANY:  # said after every edit: never a walk through millions of cells
            return tr("More than {n} points in frames of the stride are not accepted.").format(n=10 * MANY)
    return tr("{n} points in frames of the stride are not accepted.").format(n=open_frames) if open_frames else ""


def _review_missing(annotation: Annotation, points: int, stride: int) -> str:
    tracks = annotation.active()
    waiting = sum(i.review not in (*SETTLED, "needs_fix") for i in tracks)
    away = len(returned(annotation))
    parts = [tr("{n} tracks wait for a decision.").format(n=waiting)] if waiting or not tracks else []
    parts += [tr("Sent back to their annotators: {n}.").format(n=away)] if away else []
    return " ".join(parts)


SHORT = {  # what a narrow button says where the menu's text is too long
    "move.accept": mark("Accept, go on"),
    "move.open_next": mark("Next open frame"),
    "move.worst": mark("Next doubt"),
    "move.bisect": mark("Middle of gap"),
    "move.loop": mark("Loop"),
    "object.choose": mark("Choose"),
    "object.reject": mark("Leave out"),
    "object.earlier": mark("Earlier"),
    "object.later": mark("Later"),
    "object.box": mark("Box"),
    "object.stroke": mark("On it"),
    "object.not_this": mark("Not this"),
    "object.follow": mark("Follow it"),
    "point.outside": mark("Out of view"),
    "point.key": mark("Key"),
    "point.snap": mark("Snap"),
    "point.delete_key": mark("Delete key"),
    "track.solve": mark("Solve"),
    "track.on": mark("Track on"),
    "track.back": mark("Track back"),
    "track.mode": mark("Fill mode"),
    "track.seed": mark("Seed…"),
    "track.scene": mark("From scene"),
    "track.lock": mark("Lock"),
    "track.delete": mark("Delete track"),
    "view.fit": mark("Fit"),
    "view.one": mark("1:1"),
    "view.follow": mark("Follow"),
    "view.loupe_stay": mark("Loupe"),
    "view.masks": mark("Masks"),
    "view.trails": mark("Trails"),
    "view.strip": mark("Strip"),
    "review.approve": mark("Approve"),
    "review.fix": mark("Needs a fix"),
    "review.reject": mark("Reject"),
    "review.merge": mark("Compare…"),
    "review.log": mark("Log…"),
    "file.export": mark("Export…"),
    "file.import": mark("Import…"),
    "edit.checkpoint": mark("Name…"),
}


def _ids(*names: str) -> tuple[str, ...]:
    return tuple(f"annotate.{name}" for name in names)


_STATES = (mark("States"), _ids("point.visible", "point.occluded", "point.outside", "point.uncertain"))
_LOOK = (
    mark("Look"),
    _ids("view.fit", "view.one", "view.follow", "view.loupe_stay", "view.masks", "view.trails", "view.strip"),
)

STEPS = (
    Step(
        "objects",
        mark("Objects"),
        mark("Choose the moving objects to annotate, and say why the others are left out."),
        (
            (mark("Objects"), _ids("object.choose", "object.reject", "object.earlier", "object.later")),
            (mark("Draw"), _ids("object.box", "object.stroke", "object.not_this", "object.cut", "object.follow")),
            (mark("Masks"), _ids("view.masks", "view.fit", "view.one")),
            (mark("History"), _ids("edit.undo", "edit.redo")),
        ),
        "objects",
        _objects_missing,
        clicks=False,
    ),
    Step(
        "points",
        mark("Points and seed"),
        mark("Place the key points of every object on its first frame, then seed the tracks."),
        (
            (mark("Place"), _ids("point.snap", "point.key", "point.delete_key", "track.delete")),
            (mark("Seed"), _ids("track.seed", "track.scene", "file.import")),
            _LOOK,
            (mark("History"), _ids("edit.undo", "edit.redo")),
        ),
        "points",
        _points_missing,
        places_points=True,
    ),
    Step(
        "refine",
        mark("Refine"),
        mark("Step through the clip with Enter; put right what is wrong; N goes to the next doubt."),
        (
            (mark("Step"), _ids("move.accept", "move.open_next", "move.worst", "move.bisect")),
            _STATES,
            (mark("Point"), _ids("point.key", "point.snap", "point.delete_key")),
            (
                mark("Track"),
                _ids("track.solve", "track.on", "track.back", "track.mode", "track.seed", "track.scene", "track.lock"),
            ),  # fmt: skip
            _LOOK,
            (mark("Review"), _ids("review.fixed")),
            (mark("History"), _ids("edit.undo", "edit.redo")),
        ),
        "refine",
        _refine_missing,
        needs_track=True,
        shows_strip=True,
    ),
    Step(
        "review",
        mark("Review"),
        mark("Watch every track; approve it, or return it with a reason."),
        (
            (mark("Decide"), _ids("review.approve", "review.fix", "review.reject", "move.worst", "move.loop")),
            (mark("Together"), _ids("review.merge", "review.log", "file.export")),
            _LOOK,
            (mark("History"), _ids("edit.undo", "edit.redo", "edit.checkpoint")),
        ),
        "review",
        _review_missing,
        needs_track=True,
        shows_strip=True,
    ),
)


def place_of(name: str) -> int:
    """Place (from 0) of the step of a name; ValueError where there is none."""
    return [step.name for step in STEPS].index(name)


def first_open(annotation: Annotation, points: int, stride: int) -> int:
    """The step that a clip is in: the first that lacks something, or Refine where something came back."""
    if returned(annotation):
        return place_of("refine")
    lacking = (bool(step.missing(annotation, points, stride)) for step in STEPS)
    return next((n for n, lacks in enumerate(lacking) if lacks), len(STEPS) - 1)
