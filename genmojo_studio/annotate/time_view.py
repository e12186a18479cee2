"""The part of the clip that is on show over time: one for the dope sheet, the timeline and the graphs."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import QObject, Signal

from genmojo_studio.annotate.session import Session

LEAST = 2.0  # frames that are always on show
STEP = 1.25  # of a zoom
_MARGIN = 0.08  # share of the frames on show that stays before or after a frame that was paged to


@dataclass(frozen=True)
class Axis:
    """Frames first .. first + span between left and left + width, in pixels of a widget."""

    first: float
    span: float
    left: float
    width: float

    def x_of(self, frame: float) -> float:
        """Where a frame begins."""
        return self.left + (frame - self.first) * self.width / self.span

    def frame_at(self, x: float) -> float:
        """The frame under x, and how far into it."""
        return self.first + (x - self.left) * self.span / max(self.width, 1.0)

    @property
    def wide(self) -> float:
        """Pixels of one frame."""
        return self.width / self.span


class TimeView(QObject):
    """Frames first .. first + span, where frame t covers t .. t + 1; zooms, scrolls, follows the frame on show."""

    changed = Signal()

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self.first, self.span = 0.0, float(self.frames)
        session.frame_changed.connect(self.keep)

    @property
    def frames(self) -> int:
        """Number of frames of the clip."""
        return max(self._session.annotation.frames, 1)

    @property
    def end(self) -> float:
        """Where the last frame on show ends."""
        return self.first + self.span

    @property
    def whole(self) -> bool:
        """Whether the whole clip is on show."""
        return self.span >= self.frames

    def cells(self) -> tuple[int, int]:
        """First frame on show and the one after the last, both whole."""
        return max(int(self.first), 0), min(int(-(-self.end // 1)), self.frames)

    def show(self, first: float, end: float) -> None:
        """Put frames first .. end on show, at least `LEAST` and never beyond the clip."""
        span = min(max(end - first, min(LEAST, self.frames)), float(self.frames))
        start = min(max((first + end - span) / 2, 0.0), self.frames - span)
        if (start, span) != (self.first, self.span):
            self.first, self.span = start, span
            self.changed.emit()

    def fit(self) -> None:
        """The whole clip."""
        self.show(0.0, float(self.frames))

    def zoom(self, steps: float, about: float | None = None) -> None:
        """Closer by so many steps (below 0: farther); the place `about` stays where it is.

        Without `about` that is the frame on show, or the middle where that is not in the view.
        """
        if about is None:
            now = self._session.frame + 0.5
            about = now if self.first <= now <= self.end else self.first + self.span / 2
        span = min(max(self.span / STEP**steps, min(LEAST, self.frames)), float(self.frames))
        first = about - (about - self.first) * span / self.span
        self.show(first, first + span)

    def scroll(self, frames: float) -> None:
        """On by so many frames, back where it is below 0."""
        first = min(max(self.first + frames, 0.0), self.frames - self.span)
        self.show(first, first + self.span)

    def keep(self, frame: int) -> None:
        """A page on or back if a frame is not on show."""
        margin = _MARGIN * self.span
        if frame + 1 > self.end:
            self.scroll(frame - margin - self.first)
        elif frame < self.first:
            self.scroll(frame + 1 + margin - self.end)
