"""The queue of suspicious spots: worst first, what a person has looked at, and the one on show.

A spot that was looked at is left out until its run changes, however often the ranking does. What a reviewer sent
back stands before everything else until it is fixed.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QObject, Signal

from genmojo_core.tracks.review import SETTLED
from genmojo_core.tracks.suspicion import Spot
from genmojo_studio.annotate import returned
from genmojo_studio.annotate.session import Session


@dataclass(frozen=True)
class _Seen:
    """A spot that was looked at, and what stood in its run then."""

    spot: Spot
    stood: bytes


class SpotQueue(QObject):
    """Spots of a session; views listen to `changed`."""

    changed = Signal()

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self.current: Spot | None = None
        self._ranked: list[Spot] = []
        self._seen: list[_Seen] = []
        self.pins, self.spots = self._arranged()
        session.edited.connect(self._edited)
        session.settings_changed.connect(self._edited)

    def set_spots(self, spots: list[Spot]) -> None:
        """Ranked anew; tracks that are locked, approved or rejected need no look."""
        self._ranked = spots
        self._arrange()

    def _edited(self, _touched: object = None) -> None:
        """Something may have come back, been answered or been settled, or another person sits here."""
        if self._arranged() != (self.pins, self.spots):
            self._arrange()

    def _arranged(self) -> tuple[list[Spot], list[Spot]]:
        """What came back, and that followed by the ranked spots of other places."""
        pins = returned.pins(self._session)
        open_ = {i.id for i in self._session.annotation.active() if not i.locked and i.review not in SETTLED}
        pinned = {pin.track: pin for pin in pins}
        ranked = [s for s in self._ranked if s.track in open_ and not (
            s.track in pinned and _same(s, pinned[s.track]))]  # fmt: skip
        return pins, [*pins, *ranked]

    def _arrange(self) -> None:
        self.pins, self.spots = self._arranged()
        if self.current is not None:
            shown = self.current
            self.current = next((s for s in self.spots if s.track == shown.track and _inside(shown.frame, s)), None)
        self.changed.emit()

    def left(self) -> list[Spot]:
        """What nobody has looked at as it stands, worst first."""
        self._seen = [s for s in self._seen if self._stands(s)]
        seen: dict[int, list[Spot]] = {}
        for looked in self._seen:
            seen.setdefault(looked.spot.track, []).append(looked.spot)
        return [s for s in self.spots if not any(_same(s, other) for other in seen.get(s.track, ()))]

    def next(self) -> Spot | None:
        """The worst one left becomes the one on show."""
        spot = next(iter(self.left()), None)
        if spot is not None:
            self.show(spot)
        return spot

    def back(self) -> Spot | None:
        """The one looked at before the last."""
        if len(self._seen) < 2:
            return None
        self._seen.pop()
        self.current = self._seen[-1].spot
        self.changed.emit()
        return self.current

    def again(self) -> None:
        """From the worst one on, as if nobody had looked."""
        self._seen = []

    def show(self, spot: Spot) -> None:
        """A person looks at this one."""
        self._seen = [s for s in self._seen if not _same(s.spot, spot)] + [_Seen(spot, self._print(spot))]
        self.current = spot
        self.changed.emit()

    def _print(self, spot: Spot) -> bytes:
        cells = self._session.annotation.cells(spot.track, np.arange(spot.first, spot.last + 1))
        return cells.xy.tobytes() + cells.state.tobytes()

    def _stands(self, seen: _Seen) -> bool:
        return seen.spot.track in self._session.annotation.tracks and self._print(seen.spot) == seen.stood


def _inside(frame: int, spot: Spot) -> bool:
    return spot.first <= frame <= spot.last


def _same(one: Spot, other: Spot) -> bool:
    """Whether two spots are the same place: of one track, and sharing half of the shorter run."""
    shared = min(one.last, other.last) - max(one.first, other.first) + 1
    shorter = min(one.last - one.first, other.last - other.first) + 1
    return one.track == other.track and 2 * shared >= shorter


def spot_at(spots: list[Spot], track: int, frame: int) -> Spot | None:
    """The spot that covers a frame of a track."""
    return next((s for s in spots if s.track == track and _inside(frame, s)), None)
