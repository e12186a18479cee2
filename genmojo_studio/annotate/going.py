"""Ways through a clip: frames, strides, keys, gaps, suspicious spots, points."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from genmojo_core.tracks.suspicion import Spot
from genmojo_studio.annotate.play_panel import Player
from genmojo_studio.annotate.session import Session
from genmojo_studio.annotate.spot_queue import SpotQueue
from genmojo_studio.translate import told, tr


class Going:
    """Moves a session's frame and active point."""

    def __init__(self, session: Session, player: Player) -> None:
        self._s, self._player = session, player
        self.queue = SpotQueue(session)

    @property
    def spots(self) -> list[Spot]:
        """Suspicious spots, worst first."""
        return self.queue.spots

    def table(self) -> dict[str, Callable[[], object]]:
        """Verbs by the names of their actions, without "annotate."."""
        s = self._s
        return {
            "move.next": lambda: self.step(1),
            "move.previous": lambda: self.step(-1),
            "move.stride_next": lambda: self.step(s.stride),
            "move.stride_previous": lambda: self.step(-s.stride),
            "move.ten_next": lambda: self.step(10),
            "move.ten_previous": lambda: self.step(-10),
            "move.hundred_next": lambda: self.step(100),
            "move.hundred_previous": lambda: self.step(-100),
            "move.first": lambda: s.go(0, jump=True),
            "move.last": lambda: s.go(s.annotation.frames - 1, jump=True),
            "move.play": self._player.toggle,
            "move.loop": lambda: self._player.toggle(self.segment()),
            "move.key_next": lambda: self.key(1),
            "move.key_previous": lambda: self.key(-1),
            "move.bisect": self.bisect,
            "move.worst": self.worst,
            "move.worst_back": self.worst_back,
            "move.back": s.go_back,
            "move.ahead": s.go_ahead,
        }

    def step(self, frames: int) -> None:
        """On or back by frames; playing ends."""
        if self._player.playing:
            self._player.stop()
        self._s.go(self._s.frame + frames)

    def segment(self) -> tuple[int, int]:
        """Frames from the key before to the key after this frame; the clip's ends where there is none."""
        start, end = (None, None) if self._s.track is None else self._s.annotation.segment(self._s.track, self._s.frame)
        last = self._s.annotation.frames - 1
        return (0 if start is None else start), (last if end is None else end)

    def key(self, direction: int) -> None:
        """The next or previous key of the active track."""
        if self._s.track is None:
            return
        keys = self._s.annotation.keys(self._s.track)
        found = keys[keys > self._s.frame][:1] if direction > 0 else keys[keys < self._s.frame][-1:]
        if len(found):
            self._s.go(int(found[0]), jump=True)
        else:
            self._s.said.emit(tr("No more keys that way."))

    def bisect(self) -> None:
        """Halfway between the keys around this frame."""
        first, last = self.segment()
        self._s.go((first + last) // 2, jump=True)

    def worst(self) -> None:
        """The worst spot that nobody looked at since it changed; after the last it says so and begins again."""
        spot, again = self.queue.next(), False
        if spot is None and self.spots:
            self.queue.again()
            spot, again = self.queue.next(), True
        if spot is not None:
            self._show(spot, tr("All were looked at; again from the worst: ") if again else "")
            return
        clip = self._s.clip
        if clip is None:
            self._s.said.emit(tr("The clip is still being read."))
        elif clip.masks is None:
            self._s.said.emit(tr("Nothing suspicious is left, as far as motion tells: there are no masks."))
        else:
            self._s.said.emit(tr("Nothing suspicious is left."))

    def worst_back(self) -> None:
        """The spot shown before."""
        spot = self.queue.back()
        if spot is not None:
            self._show(spot)

    def show_spot(self, spot: Spot) -> None:
        """A spot chosen in the list."""
        self.queue.show(spot)
        self._show(spot)

    def cycle(self, step: int) -> None:
        """The next or previous point over all objects."""
        places = [(o.id, n) for o in self._s.objects() for n in range(1, self._s.limit("points") + 1)]
        if places:
            at = places.index(self._s.active) if self._s.active in places else -1
            self._s.select(*places[(at + step) % len(places)])

    def next_unplaced(self) -> bool:
        """The next point without a track: of this object first, then of the next ones. False if there is none."""
        objects = [o.id for o in self._s.objects()]
        own = self._s.active[0]
        order = [own, *(o for o in objects if o != own)] if own in objects else objects
        for object_id in order:
            for number in range(1, self._s.limit("points") + 1):
                if self._s.track_of(object_id, number) is None:
                    self._s.select(object_id, number)
                    return True
        return False

    def _show(self, spot: Spot, before: str = "") -> None:
        self._s.remember()
        self._s.go(spot.frame)
        self._s.select_track(spot.track)
        self._s.said.emit(before + ", ".join(map(told, spot.reasons[:2])))


def worst_runs(doubt: np.ndarray, least: float = 0.3) -> list[tuple[int, int, int]]:
    """Runs of frames (first, last, worst) in which a doubt (T,) reaches `least`."""
    hot = np.flatnonzero(doubt >= least)
    if not len(hot):
        return []
    runs = np.split(hot, np.flatnonzero(np.diff(hot) > 1) + 1)
    return [(int(run[0]), int(run[-1]), int(run[np.argmax(doubt[run])])) for run in runs]
