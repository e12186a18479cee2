"""Keeps the canvas in step with the session: a frame and its overlay change together, or not at all."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QObject

from genmojo_core.tracks.model import NONE
from genmojo_studio.annotate.canvas import Canvas
from genmojo_studio.annotate.loupe import Source
from genmojo_studio.annotate.overlay import Picture
from genmojo_studio.annotate.presenter import Presenter
from genmojo_studio.annotate.session import Session
from genmojo_studio.annotate.snap import corner, snapped
from genmojo_studio.annotate.strip import Strip
from genmojo_studio.translate import tr


class Screen(QObject):
    """Shows the session's frame as soon as it is decoded; feeds the loupe, the snap and the strip."""

    def __init__(self, session: Session, canvas: Canvas, strip: Strip) -> None:
        super().__init__(canvas)
        self._session, self._canvas, self._strip = session, canvas, strip
        self.presenter = Presenter(session)
        self.follow = False
        self.painted = -1  # the frame on show
        self._on_point = False  # whether the loupe stays on the point although the mouse is elsewhere
        self._nothing = False  # whether it was said that there is nothing to snap to
        session.frame_changed.connect(self.show_frame)
        session.shown.connect(self.refresh)
        session.edited.connect(self._edited)
        session.cache.arrived.connect(self._arrived)
        session.cache.filled.connect(self._filled)
        session.cache.failed.connect(self._failed)
        canvas.hovered.connect(self._hovered)

    def show_frame(self, frame: int) -> None:
        """Put a frame on show; the old picture stays whole until the new one is there."""
        self._session.cache.want(frame)
        if self._session.cache.get(frame) is not None:
            self._paint(frame)

    def refresh(self) -> None:
        """Paint the frame on show again with what stands now."""
        self._pin()
        if self.painted >= 0:
            self._paint(self.painted)

    def set_loupe(self, on: bool) -> None:
        """Open or close the loupe."""
        self._canvas.loupe.on = on
        self._pin()
        if on:
            self._feed_loupe()
        self._canvas.update()

    def switch_smooth(self) -> None:
        """The loupe's pixels as squares, or melting into each other."""
        self._canvas.loupe.smooth = not self._canvas.loupe.smooth
        self._canvas.update()

    def stay_on_point(self) -> None:
        """The point is moved by keys: the loupe shows it, not the mouse, until that moves."""
        self._on_point = True

    def aim(self) -> None:
        """Work out where a click at the mouse would snap to; it is said where that is nowhere."""
        mouse = self._canvas.mouse_raster() if self._session.snap else None
        self._canvas.ghost = self._snap(mouse) if mouse is not None else None
        nothing = mouse is not None and self._canvas.ghost is None
        if nothing and not self._nothing:
            self._session.said.emit(tr("Nothing to snap to here: a click goes where the mouse is."))
        self._nothing = nothing

    def set_follow(self, on: bool) -> None:
        """Keep the active point in the middle."""
        self.follow = on
        if not on:
            self._canvas.locked_on = None
        self.refresh()

    def place(self) -> tuple[float, float] | None:
        """Where the active point is in the frame on show."""
        return self._place_in(self.painted)

    def _paint(self, frame: int) -> None:
        picture = self._session.cache.get(frame)
        if picture is None:
            return
        self.painted = frame
        if self._session.snap:
            self.aim()
        if self.follow:
            self._canvas.locked_on = self.place() or self._canvas.locked_on
        if self._canvas.loupe.on:
            self._feed_loupe()
        self._canvas.show_frame(picture, self.presenter.picture(frame))
        self._strip.show_frame()  # with the frame, not before it: until then its painting would only delay decoding

    def _arrived(self, frame: int, _generation: int) -> None:
        if frame == self._session.frame:
            self._paint(frame)

    def _filled(self, frame: int) -> None:
        """A frame besides the one on show has come that the loupe or the snap waits for."""
        waits = self._canvas.loupe.on or self._session.snap
        if waits and self.painted >= 0 and frame in (self._key_before(), self._first_frame()):
            self.aim()
            if self._canvas.loupe.on:
                self._feed_loupe()
            self._canvas.update()

    def _failed(self, frame: int, sentence: str) -> None:
        """A frame that cannot be read is said, not shown as another one."""
        if frame == self._session.frame:
            self.painted = -1
            self._canvas.show_frame(None, Picture())
            self._session.said.emit(sentence)

    def _edited(self, touched: object) -> None:
        if getattr(touched, "objects", None):
            self.presenter.forget_masks()

    def _hovered(self, _x: float, _y: float) -> None:
        self._on_point = False
        if self._session.snap or self._canvas.ghost is not None:
            self.aim()
        if self._canvas.loupe.on:
            self._feed_loupe()

    def _track(self) -> int | None:
        """The track that is looked at: the active point's, after a nudge the one that it moved."""
        return self._session.nudged if self._on_point else self._session.track

    def _place_in(self, frame: int) -> tuple[float, float] | None:
        track = self._track()
        if track is None or frame < 0:
            return None
        cells = self._session.annotation.cells(track, np.array([frame]))
        return (float(cells.xy[0, 0]), float(cells.xy[0, 1])) if cells.state[0] != NONE else None

    def _key_before(self) -> int | None:
        """The frame of the last key before the one on show, else the next after it."""
        track = self._track()
        if track is None:
            return None
        keys = self._session.annotation.keys(track)
        before, after = keys[keys < self.painted], keys[keys > self.painted]
        return int(before[-1]) if len(before) else int(after[0]) if len(after) else None

    def _snap(self, xy: tuple[float, float]) -> tuple[float, float] | None:
        """Near the mouse, the best likeness of the point as it looks in the key before; without one, a corner."""
        key, frame = self._key_before(), self._session.cache.get(self.painted)
        if key is None and frame is not None:
            return corner(frame, xy)
        there = self._place_in(key) if key is not None else None
        source = self._session.cache.get(key) if key is not None else None
        if there is None or source is None or frame is None:
            return None
        return snapped(source, there, frame, xy)

    def _feed_loupe(self) -> None:
        frame, place = self._session.cache.get(self.painted), self._canvas.dragged_to() or self.place()
        mouse = None if self._on_point else self._canvas.mouse_raster()
        here = self._canvas.dragged_to() or mouse or place
        sources: dict[str, Source] = {}
        if frame is not None and here is not None:
            sources["now"] = Source(frame, here, place)
        key = self._key_before()
        for name, at in (("key", key), ("first", self._first_frame())):
            there = self._place_in(at) if at is not None else None
            picture = self._session.cache.get(at) if at is not None else None
            if picture is not None and there is not None:
                sources[name] = Source(picture, there, there)
        self._canvas.loupe.sources = sources
        info = self._session.annotation.tracks.get(self._track() or 0)
        if info is not None:
            self._canvas.loupe.looks = (self._session.place_of(info.object), info.number - 1)

    def _first_frame(self) -> int | None:
        track = self._track()
        if track is None:
            return None
        known = np.flatnonzero(self._session.annotation.track(track).state == 1)
        return int(known[0]) if len(known) else None

    def _pin(self) -> None:
        """Frames that the loupe and the strip need."""
        wanted = [f for f in (self._key_before(), self._first_frame()) if f is not None]
        if self._strip.isVisible():
            wanted += self._strip.frames()
        self._session.cache.pin(wanted)
