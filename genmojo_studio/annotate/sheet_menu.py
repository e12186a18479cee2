"""What the right button offers in the dope sheet: the deeds of the menus, for the track and frame under the mouse."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMenu

from genmojo_core.tracks.annotation import BY_HOLD, BY_LINE, BY_TRACKER
from genmojo_studio.annotate import verbs
from genmojo_studio.annotate.session import Session
from genmojo_studio.annotate.sheet_painter import marked
from genmojo_studio.annotate.sheet_words import label
from genmojo_studio.translate import tr

if TYPE_CHECKING:
    from genmojo_studio.annotate.workspace import AnnotateWorkspace

_STATES = ("point.visible", "point.occluded", "point.outside", "point.nothing", "point.uncertain")
Verb = Callable[[Session], object]


class SheetMenu:
    """Makes the menu of a cell; whatever is chosen goes there first, so that a person sees what it does.

    Args:
        solved_after: does a verb and has the segments beside it solved again.
    """

    def __init__(self, workspace: AnnotateWorkspace, session: Session, solved_after: Callable[[Verb], None]) -> None:
        self._w, self._s, self._solved_after = workspace, session, solved_after
        workspace.play.sheet.asked.connect(self.ask)

    def ask(self, track: int, frame: int, place: QPoint) -> None:
        """Open the menu at a place of the screen."""
        self._s.select_track(track)
        menu = self.menu(track, frame)
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        menu.popup(place)

    def menu(self, track: int, frame: int) -> QMenu:
        """What can be done with a track in a frame, or in the run that is marked there."""
        s, menu = self._s, QMenu(self._w.play.sheet)
        run = marked(s) if s.run_track == track else None
        inside = run is not None and run[0] <= frame <= run[1]
        menu.addAction("".join(label(s, track))).setEnabled(False)
        menu.addSeparator()
        menu.addAction(tr("Go to frame {n}").format(n=frame), partial(self._go, track, frame))
        for name in ("point.run_start", "point.run_end"):
            self._add(menu, name, track, frame)
        title = tr("Frames {a} to {b} are").format(a=run[0], b=run[1]) if run and inside else tr("Frame {n} is").format(
            n=frame)  # fmt: skip
        states = menu.addMenu(title)
        for name in _STATES:
            self._add(states, name, track, None if inside else frame, alone=not inside)
        self._add(menu, "point.key", track, frame)
        menu.addMenu(self._fillings(menu, track, frame))
        self._add(menu, "review.fix", track, None if inside else frame, alone=not inside)
        menu.addSeparator()
        start, end = s.annotation.segment(track, frame)
        if start is not None and end is not None:
            menu.addAction(tr("Zoom to this segment"), partial(self._w.play.view.show, start - 1.0, end + 2.0))
        for name in ("view.time_fit", "view.legend"):
            self._add(menu, name, track, None)
        return menu

    def _fillings(self, menu: QMenu, track: int, frame: int) -> QMenu:
        """Tracker, line or hold for the segment around a frame."""
        made, s = QMenu(tr("Segment filled by"), menu), self._s
        start, end = s.annotation.segment(track, frame)
        made.setEnabled(start is not None and end is not None and not s.annotation.tracks[track].locked)
        now = int(s.annotation.track(track).mode[start]) if start is not None else BY_TRACKER
        for mode, title in ((BY_TRACKER, tr("tracker")), (BY_LINE, tr("line")), (BY_HOLD, tr("hold"))):
            action = made.addAction(title, partial(self._fill, track, frame, mode))
            action.setCheckable(True)
            action.setChecked(mode == now)
        return made

    def _add(self, menu: QMenu, name: str, track: int, frame: int | None, *, alone: bool = False) -> QAction:
        """An action of the table, its key beside it; done in `frame`, None: where one is. `alone`: a run that is marked
        elsewhere is forgotten first, as the deed would be done to it."""
        known = self._w.table[f"annotate.{name}"]
        keys = self._w.table.keys(known.id)
        action = menu.addAction(tr(known.text) + (f"\t{keys[0]}" if keys else ""))
        action.setObjectName(known.id)

        def chosen() -> None:
            if frame is not None:
                self._go(track, frame)
            if alone:
                self._s.run = (None, None)
            self._w.table.trigger(known.id)

        action.triggered.connect(chosen)
        return action

    def _go(self, track: int, frame: int) -> None:
        self._s.select_track(track)
        self._s.go(frame, jump=True)

    def _fill(self, track: int, frame: int, mode: int) -> None:
        self._go(track, frame)
        self._solved_after(partial(verbs.set_mode, mode=mode))
