"""Frames of the stride: which of them a person has gone through, kept up to date edit by edit."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QObject, Signal

from genmojo_core.tracks.annotation import Touched
from genmojo_core.tracks.coverage import open_points, open_tracks
from genmojo_studio.annotate.session import Session
from genmojo_studio.translate import tr


class StrideMarks(QObject):
    """Counts per frame of the stride what is still open there; an edit costs the frames that it touched."""

    changed = Signal()

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._stride = 0  # of the counts
        self._tracks: list[int] = []
        self._open = np.zeros(0, np.int64)
        session.edited.connect(self._edited)
        session.settings_changed.connect(self._other_stride)

    def frames(self) -> np.ndarray:
        """Frames of the stride, rising."""
        return np.arange(0, self._session.annotation.frames, self._session.stride)

    def done(self) -> np.ndarray:
        """(n,) bool: whether every track that is not locked is placed or accepted there; none without tracks."""
        if self._stride != self._session.stride:
            self._count()
        return (self._open == 0) & bool(self._session.annotation.tracks)

    def go(self, direction: int) -> None:
        """To the next frame of the stride (-1: the one before) where something is still open."""
        session, left = self._session, self.frames()[~self.done()]
        found = left[left > session.frame][:1] if direction > 0 else left[left < session.frame][-1:]
        if len(found):
            session.go(int(found[0]), jump=True)
        elif len(left):
            session.said.emit(tr("Nothing is open that way; {n} frames of the stride still are.").format(n=len(left)))
        else:
            session.said.emit(tr("Every frame of the stride is accepted."))

    def _count(self) -> None:
        annotation = self._session.annotation
        self._stride, self._tracks = self._session.stride, open_tracks(annotation)
        self._open = open_points(annotation, self._tracks, self.frames())

    def _edited(self, touched: Touched) -> None:
        if self._stride != self._session.stride or open_tracks(self._session.annotation) != self._tracks:
            self._count()
        elif touched.last >= touched.first:
            part = slice(-(-touched.first // self._stride), touched.last // self._stride + 1)
            frames = self.frames()[part]
            self._open[part] = open_points(self._session.annotation, self._tracks, frames)
        self.changed.emit()

    def _other_stride(self) -> None:
        if self._stride != self._session.stride:
            self.changed.emit()
