"""Clicks, drags and nudges: where points go, which one comes next, and on which frame."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtWidgets import QMainWindow

from genmojo_core.tracks import edit_tracks
from genmojo_core.tracks.model import NONE
from genmojo_studio.annotate import steps, verbs
from genmojo_studio.annotate.candidates import Figures
from genmojo_studio.annotate.canvas import REACH, Tool
from genmojo_studio.annotate.going import Going
from genmojo_studio.translate import tr

if TYPE_CHECKING:
    from genmojo_studio.annotate.workspace import AnnotateWorkspace

_ELSEWHERE = ("move.worst", "move.worst_back", "move.back", "move.ahead")
_PAINTING = tuple(f"point.{name}" for name in verbs.STATES)


class Placing:
    """What a hand on the frame does to points in the step on show.

    Where points are placed one after the other, each object's are placed on the frame in which it is first seen, and a
    point that has its place stays there unless it is dragged, nudged, or clicked at.
    """

    def __init__(self, workspace: AnnotateWorkspace, going: Going) -> None:
        if workspace.session is None:
            raise RuntimeError("a session is needed before points can be placed")
        self._w, self._s, self._going = workspace, workspace.session, going
        self._owner = self._s.active[0]
        self._hint = ""  # what is to be done next, as long as it is
        self._s.edited.connect(self._edited)
        workspace.canvas.clicked.connect(self.clicked)
        workspace.canvas.dragged.connect(self.dragged)
        workspace.canvas.held.connect(self.held)
        workspace.canvas.sought.connect(self.seek)
        workspace.work.figures_ready.connect(self._take_figures)
        self._s.selected.connect(self._selected)

    def begin(self) -> None:
        """The step is entered: the first point without a place is next, on its object's first frame."""
        if self._s.track is not None:
            self._going.next_unplaced()
        self._to_first()

    def clicked(self, x: float, y: float) -> None:
        """A click places the active point."""
        session, step = self._s, steps.STEPS[self._w.step]
        if self._w.canvas.tool != Tool.POINT or not step.clicks:
            return
        if self._w.screen_link.painted != session.frame:
            session.said.emit(tr("This frame is not on show yet."))
            return
        new = session.track is None
        if step.places_points and not new and self._far(x, y):
            title = session.title(*session.active)
            session.said.emit(tr("{point} has its place: drag it, or delete its track first.").format(point=title))
            return
        done = verbs.place(session, (x, y), snapped=self._w.canvas.ghost is not None)
        if done is None:
            return
        if new and step.places_points:
            self._placed()
        elif session.track is not None:
            self._w.work.tracker.after_key(session.track, session.frame, done)

    def held(self, on: bool) -> None:
        """A point is under the pressed button: until it is let go the clip stands still, as the key is for this frame.

        One that was taken from a frame which is about to go is not held at all.
        """
        self._s.holding = on
        if on and self._w.screen_link.painted != self._s.frame:
            self._w.canvas.put_back()
            self._s.said.emit(tr("This frame is not on show yet."))
        elif on and self._w.play.player.playing:
            self._w.play.player.stop()

    def guarded(self, name: str, verb: Callable[[], object]) -> Callable[[], object]:
        """The verb, which does nothing while a point is being dragged, unless it changes the view alone.

        A state that is painted with its key held is stored first where another deed begins, or a jump elsewhere: its
        frames are those that a person stepped through.
        """
        if name.startswith(("view.", "panel.")) or name == "move.frame":
            return verb
        stepping = name.startswith("move.") and name not in _ELSEWHERE
        goes_on = stepping or name in _PAINTING

        def guarded() -> None:
            if self._s.holding:
                self._s.said.emit(tr("A point is being dragged: let it go first, or press Esc."))
                return
            if not goes_on:
                verbs.end_painting(self._s)
            verb()

        return guarded

    def seek(self, track: int | None) -> None:
        """Bring a track's point into the middle of the view, beyond the picture too, and make it active."""
        if track is None or track not in self._s.annotation.tracks:
            return
        cells = self._s.annotation.cells(track, np.array([self._w.screen_link.painted]))
        if cells.state[0] == NONE:
            self._s.said.emit(tr("The point has no place in this frame."))
            return
        self._s.remember()
        self._s.select_track(track)
        self._w.canvas.centre_on(float(cells.xy[0, 0]), float(cells.xy[0, 1]))

    def dragged(self, track: int, x: float, y: float) -> None:
        """Letting go of a point makes a key and solves the segments on both sides, as one step."""
        self._s.select_track(track)
        step = verbs.set_key(self._s, track, (x, y))
        if step is not None:
            self._w.work.tracker.after_key(track, self._s.frame, step)

    def nudge(self, dx: float, dy: float) -> None:
        """Move the active point a little; the one placed last while the active one has no place."""
        track = self._s.nudged
        self._w.screen_link.stay_on_point()
        step = verbs.nudge(self._s, dx, dy)
        if step is not None and track is not None:
            self._w.work.tracker.after_key(track, self._s.frame, step)

    def _placed(self) -> None:
        """A new point takes the template's name, in the same step; the next one is active."""
        session, placed = self._s, self._s.active
        name = self._w.points.point_name(placed[1])
        if session.track is not None and name:
            edit = edit_tracks.update_track(session.annotation, session.track, name=name)
            session.do(edit, session.project.log.edit(session.project.log.head).step)
        if not self._going.next_unplaced():
            self._hint = tr("All points are placed. Seed the tracks now (Ctrl+G).")
            session.said.emit(self._hint)
        session.set_placed(placed)

    def _edited(self) -> None:
        """What to do next is not said any more once it is done, in whichever way."""
        step = steps.STEPS[steps.place_of("points")]
        if self._hint and not step.missing(self._s.annotation, self._s.limit("points"), self._s.stride):
            window, hint, self._hint = self._w.window(), self._hint, ""
            if isinstance(window, QMainWindow) and window.statusBar().currentMessage() == hint:
                self._s.said.emit("")

    def _far(self, x: float, y: float) -> bool:
        """Whether a click is out of reach of the active point, if that has a place in this frame."""
        session, canvas = self._s, self._w.canvas
        cells = session.annotation.cells(session.track or 0, np.array([session.frame]))
        if cells.state[0] == NONE:
            return False
        mouse = canvas.mouse_raster() or (x, y)  # a click that snaps goes elsewhere than the mouse
        return math.dist(mouse, cells.xy[0].tolist()) * canvas.mapping.zoom > REACH

    def _to_first(self) -> None:
        """To the frame on which the active point is to be placed, if it has no place."""
        if self._s.track is None and self._s.objects():
            self._s.go(self._s.first_frame(self._s.active[0]))

    def _selected(self) -> None:
        """Another object's points are placed on another frame."""
        owner, self._owner = self._owner, self._s.active[0]
        if owner != self._owner and steps.STEPS[self._w.step].places_points:
            self._to_first()

    def _take_figures(self, figures: dict[int, Figures]) -> None:
        """The masks have been read: they tell when each object is seen first."""
        session = self._s
        session.first_frames = {i: max(f.first, 0) for i, f in figures.items()}
        early = session.frame < session.first_frame(session.active[0])
        if early and steps.STEPS[self._w.step].places_points:
            self._to_first()
        self._w.points.refresh()
