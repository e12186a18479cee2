"""The stops of the tour, as data: where, what is said, what to try, and how it is seen that it was tried."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from PySide6.QtWidgets import QWidget

from genmojo_core.tracks.model import NONE
from genmojo_studio.annotate.session import Session
from genmojo_studio.translate import mark

if TYPE_CHECKING:
    from genmojo_studio.annotate.workspace import AnnotateWorkspace


@dataclass(frozen=True)
class Now:
    """What a person can change at a stop: numbers of chosen, placed, blank and approved, frame and point, last edit."""

    chosen: int
    placed: int
    blank: int
    approved: int
    frame: int
    active: tuple[int, int]
    edit: int

    @classmethod
    def of(cls, session: Session) -> Now:
        """As it stands."""
        annotation = session.annotation
        blank = sum(bool((annotation.track(track).state == NONE).any()) for track in annotation.tracks)
        approved = sum(info.review == "approved" for info in annotation.tracks.values())
        return cls(len(session.objects()), len(annotation.tracks), blank, approved, session.frame, session.active,
                   session.project.log.head)  # fmt: skip


@dataclass(frozen=True)
class Stop:
    """One stop of the tour.

    Args:
        step: name of the step it belongs to. target: what it points at. title, text: what is said.
        needs: what must be there before: "", "objects", "points" or "tracks"; the tour makes what is lacking.
        ask: what to try, "" for nothing. done: whether it was, from how things stood on arrival and stand now.
    """

    step: str
    target: Callable[[AnnotateWorkspace], QWidget]
    title: str
    text: str
    needs: str = ""
    ask: str = ""
    done: Callable[[Now, Now], bool] | None = None


STOPS = (
    Stop(
        "objects",
        lambda w: w.bar,
        mark("Four steps"),
        mark(
            "Objects, points, refining, review. Each says what it still lacks. You can "
            "go back at any time: Alt+1 to Alt+4."
        ),
    ),
    Stop(
        "objects",
        lambda w: w.objects.table,
        mark("Objects"),
        mark(
            "Every mask is a candidate, with size, motion and how often it is "
            "hidden. Select a row and press Choose, or leave it out with a reason."
        ),
        ask=mark("Try it: choose an object."),
        done=lambda before, now: now.chosen > before.chosen,
    ),
    Stop(
        "objects",
        lambda w: w.objects.cut,
        mark("More objects"),
        mark(
            "No mask, or a wrong one? Draw a box around the object, click and scribble on "
            "it and beside it, then Cut out. It is followed through the clip."
        ),
    ),
    Stop(
        "points",
        lambda w: w.canvas,
        mark("Points"),
        mark(
            "Click five points on each object; the next one is chosen for you. Hold Z "
            "for the loupe, Ctrl and an arrow nudge by a quarter of a pixel."
        ),
        "objects",
        mark("Try it: click on a corner of an object."),
        lambda before, now: now.placed > before.placed,
    ),
    Stop(
        "points",
        lambda w: w.points.meter,
        mark("A good place"),
        mark(
            "A corner can be followed, an edge slides, a flat place is lost. "
            "The bar shows it for the place under the mouse."
        ),
        "objects",
    ),
    Stop(
        "points",
        lambda w: w.points.seed,
        mark("Seed"),
        mark("A tracker proposes the rest. It never overwrites what you placed."),
        "points",
        mark("Try it: press Seed tracks, then Start. It takes some seconds."),
        lambda before, now: now.placed > 0 and now.blank == 0,
    ),
    Stop(
        "refine",
        lambda w: w.play.sheet,
        mark("Dope sheet"),
        mark(
            "Fill: visible. Hatch: occluded. Diamond: your key. Red: doubtful. "
            "Click to go there, drag to paint a state."
        ),
        "tracks",
        mark("Try it: click on another frame."),
        lambda before, now: now.frame != before.frame,
    ),
    Stop(
        "refine",
        lambda w: w.canvas,
        mark("Refine"),
        mark(
            "Enter accepts the points of a frame and goes on. Drag a point that is off: "
            "both segments beside it are solved again. Hold Q and step to paint occlusion."
        ),
        "tracks",
        mark("Try it: press Enter, or drag a point."),
        lambda before, now: now.edit != before.edit,
    ),
    Stop(
        "refine",
        lambda w: w.refine.queue,
        mark("The queue"),
        mark("N goes to the next most suspicious spot, and says why it is suspicious."),
        "tracks",
        mark("Try it: press N."),
        lambda before, now: (now.frame, now.active) != (before.frame, before.active),
    ),
    Stop(
        "review",
        lambda w: w.review.approve_button,
        mark("Review"),
        mark(
            "Somebody else approves each track, or returns it with a "
            "reason. Everything is stored as you work; Ctrl+Z takes back anything, even tomorrow."
        ),
        "tracks",
        mark("Try it: approve a track."),
        lambda before, now: now.approved > before.approved,
    ),
)
