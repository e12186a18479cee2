"""Enter: accepts what a person has seen, and nothing that is still being solved."""

from __future__ import annotations

from genmojo_studio.annotate import verbs
from genmojo_studio.annotate.screen import Screen
from genmojo_studio.annotate.session import Session
from genmojo_studio.annotate.tracking import Tracking
from genmojo_studio.translate import tr


class Accepting:
    """Waits for the solver where it is at work, and refuses frames that are not on show yet."""

    def __init__(self, session: Session, screen: Screen, tracker: Tracking) -> None:
        self._s, self._screen, self._tracker = session, screen, tracker
        self._waits: tuple[int, int] | None = None  # direction, frame
        tracker.settled.connect(self._settled)

    def accept(self, direction: int = 1) -> None:
        """Accept the frame on show and go on, as soon as its points are where they will stay."""
        if self._screen.painted != self._s.frame:
            self._s.said.emit(tr("This frame is not on show yet."))
        elif self._tracker.pending:
            self._waits = (direction, self._s.frame)
            self._s.said.emit(tr("Solving; the frame is accepted right after."))
        else:
            verbs.accept(self._s, direction)

    def _settled(self) -> None:
        waits, self._waits = self._waits, None
        if waits is not None and waits[1] == self._s.frame:
            verbs.accept(self._s, waits[0])
