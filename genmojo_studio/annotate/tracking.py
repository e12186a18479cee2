"""Trackers at work for a session: seeds, segments solved again after a key, suspicion. Threads only, no windows."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QObject, QTimer, Signal

from genmojo_core.clip.clip import Clip
from genmojo_core.errors import GenmojoError
from genmojo_core.tracks import keys
from genmojo_core.tracks.annotation import FLOW, Proposal
from genmojo_core.tracks.model import OCCLUDED, OUT_OF_VIEW, VISIBLE
from genmojo_core.trackers import optical
from genmojo_studio.annotate.session import Session
from genmojo_studio.background import Tasks
from genmojo_studio.translate import tr


class Tracking(QObject):
    """Runs trackers beside the window."""

    spots_ready = Signal(object)
    busy_changed = Signal(str)
    seeded = Signal(int)  # tracks

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self.tasks = Tasks(self, threads=1)
        self._look = QTimer(self, singleShot=True, interval=400)

    def close(self) -> None:
        """Drop what is going on."""
        self._look.stop()
        self.tasks.close()

    def look_again(self) -> None:
        """Rank suspicious spots anew, soon."""
        self._look.start()

    def seed(self, tracks: list[int]) -> None:
        """Let the optical tracker propose positions for tracks, and take them wherever nobody said otherwise."""
        session, clip = self._session, self._session.clip
        if clip is None:
            session.said.emit(tr("The clip is still being read."))
            return
        frames = {t: int(session.annotation.keys(t)[0]) for t in tracks if len(session.annotation.keys(t))}
        places = {t: session.annotation.track(t).xy[f].copy() for t, f in frames.items()}
        owners = {t: session.annotation.tracks[t].object for t in frames}
        self.busy_changed.emit(tr("Seeding {n} tracks …").format(n=len(frames)))
        self.tasks.run(lambda: _seeds(clip, frames, places, owners), self._seeded, self._failed)

    def after_key(self, track: int, frame: int, step: int) -> None:
        """Solve the segments on both sides of a key that a person has just placed, as part of that step."""
        self.look_again()

    def run(self, direction: int) -> None:
        """Solve the active track from this frame to the next key (1), back to the one before (-1), or both (0)."""

    def one(self, direction: int) -> None:
        """Take the active point one frame on or back, and go there."""

    def _seeded(self, proposals: dict[int, Proposal]) -> None:
        session = self._session
        self.busy_changed.emit("")
        for track, proposal in proposals.items():
            session.project.propose(track, proposal)
        session.do(keys.accept(session.annotation, proposals, FLOW))
        self.seeded.emit(len(proposals))

    def _failed(self, error: BaseException) -> None:
        self.busy_changed.emit("")
        if isinstance(error, GenmojoError):
            self._session.said.emit(str(error))
        else:
            raise error


def _seeds(clip: Clip, frames: dict, places: dict, owners: dict) -> dict[int, Proposal]:
    ids = clip.object_ids.tolist()
    known = [t for t in frames if owners[t] in ids]
    scale = np.array(clip.size) / np.array(clip.source_size)
    xy, conf = optical.track_points(clip, np.array([frames[t] for t in known]),
                                    np.array([places[t] for t in known]) * scale,
                                    np.array([ids.index(owners[t]) for t in known]))  # fmt: skip
    state = np.where(conf > 0.5, VISIBLE, np.where(conf > 0, OCCLUDED, OUT_OF_VIEW)).astype(np.uint8)
    return {t: Proposal("optical", (xy[n] / scale).astype(np.float32), state[n], conf[n].astype(np.float32))
            for n, t in enumerate(known)}  # fmt: skip
