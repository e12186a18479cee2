"""What the tour is given on: the demo clip in a project that is thrown away, filled as far as a stop needs it."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from genmojo_core.errors import GenmojoError
from genmojo_core.tracks import keys
from genmojo_core.tracks.annotation import TRACKER, Proposal
from genmojo_core.tracks.edit_tracks import put_objects
from genmojo_core.tracks.model import NONE, OCCLUDED, VISIBLE
from genmojo_studio import demo, notify
from genmojo_studio.annotate import verbs
from genmojo_studio.annotate.session import Session, open_session
from genmojo_studio.background import Tasks
from genmojo_studio.state import AppState

if TYPE_CHECKING:
    from genmojo_studio.annotate.workspace import AnnotateWorkspace

_DRIFT = 9.0  # pixels of the demo clip, small as it is, by which some tracks are spoilt for the queue
_HIDDEN = 5  # frames that some tracks call occluded though the point is seen


class TourClip:
    """Opens the demo clip in a workspace, beside what the rest of the app shows.

    `before`: the project that was open, None if none was. `session`: the tour's own, None until it is there.
    """

    def __init__(self, workspace: AnnotateWorkspace) -> None:
        self._w = workspace
        self._state = AppState()  # of its own: the other workspace keeps its clip
        self._state.set(theme=workspace.state.theme)
        self._unsubscribe = workspace.state.subscribe(self._dress, "theme")
        self._folder = tempfile.TemporaryDirectory(prefix="genmojo-tour-", ignore_cleanup_errors=True)
        self._tasks = Tasks()
        self.before = workspace.session.project.path if workspace.session is not None else None
        self.session: Session | None = None
        self._truth: dict[str, np.ndarray] = {}

    def open(self, then: Callable[[], object]) -> None:
        """Make the clip on a thread, put it on show, and go on once its masks have been counted."""

        def made(folder: Path) -> None:
            with np.load(folder / "truth.npz", allow_pickle=False) as file:
                self._truth = {name: file[name] for name in ("tracks", "state", "track_object")}
            try:
                project = Path(self._folder.name) / "tour.genmojo"
                session = open_session(self._state, folder, self._w.person(), project)
            except GenmojoError as error:
                self._failed(error)
                return
            self._w.close_clip()
            self.session = session
            self._w.open_with(session)
            self._w.work.figures_ready.connect(lambda _figures: then())

        self._tasks.run(demo.write, made, self._failed)

    def remove(self) -> None:
        """Throw the project away."""
        self._unsubscribe()
        self._tasks.close()
        self._folder.cleanup()

    def prepare(self, session: Session, needs: str) -> None:
        """Make what a stop needs and a person has not made: "objects", then "points", then "tracks"."""
        if needs and not session.objects():
            found = session.annotation.objects.values()
            session.do(put_objects(session.annotation, [
                replace(info, status="chosen", order=n) for n, info in enumerate(found, 1)]))  # fmt: skip
        if needs in ("points", "tracks"):
            self._place(session)
        if needs == "tracks":
            self._fill(session)

    def _place(self, session: Session) -> None:
        """Points without a track get a place that the truth knows of; the point active before is active again."""
        active = session.active
        for info in session.objects():
            frame = session.first_frame(info.id)
            seen = (self._truth["track_object"] == info.id) & (self._truth["state"][:, frame] == VISIBLE)
            rows = _spread(self._truth["tracks"][:, frame], np.flatnonzero(seen), session.limit("points"))
            for number, row in enumerate(rows, 1):
                if session.track_of(info.id, number) is None:
                    session.select(info.id, number)
                    session.go(frame)
                    verbs.place(session, tuple(self._truth["tracks"][row, frame].tolist()))
        session.select(*active)

    def _fill(self, session: Session) -> None:
        """Tracks that are not seeded yet take the true motion near them, some of it spoilt: the queue shall find it."""
        annotation, found = session.annotation, {}
        for track, info in annotation.tracks.items():
            cells, start = annotation.track(track), annotation.keys(track)[:1]
            rows = np.flatnonzero(self._truth["track_object"] == info.object)
            if not len(start) or not len(rows) or not (cells.state == NONE).any():
                continue
            shift = cells.xy[start[0]] - self._truth["tracks"][rows, start[0]]
            near = int(np.hypot(*shift.T).argmin())
            xy = (self._truth["tracks"][rows[near]] + shift[near]).astype(np.float32)
            state = self._truth["state"][rows[near]].astype(np.uint8)
            middle = annotation.frames // 2
            if track % 5 == 2:
                xy[middle:] += np.linspace(0, _DRIFT, annotation.frames - middle, dtype=np.float32)[:, None]
            elif track % 5 == 4:
                state[middle : middle + _HIDDEN] = OCCLUDED
            found[track] = Proposal("tour", xy, state, np.full(annotation.frames, 0.9, np.float32))
        if found:
            session.do(keys.accept(annotation, found, TRACKER))
            self._w.work.tracker.look_again()

    def _dress(self) -> None:
        self._state.set(theme=self._w.state.theme)

    def _failed(self, error: BaseException) -> None:
        self._w.tour_clip = None
        self.remove()
        notify.tell(error, self._w)


def _spread(xy: np.ndarray, rows: np.ndarray, count: int) -> list[int]:
    """`count` of the rows of places xy (P, 2), at most: the middle one, then each farthest from those taken."""
    if not len(rows):
        return []
    away = -np.hypot(*(xy[rows] - xy[rows].mean(axis=0)).T)
    taken: list[int] = []
    for _ in range(min(count, len(rows))):
        k = int(away.argmax())
        gone = np.hypot(*(xy[rows] - xy[rows[k]]).T)
        away = gone if not taken else np.minimum(away, gone)
        taken.append(int(rows[k]))
    return taken
