"""From the annotation to what is drawn: marks, trails and outlines of one frame, looked up without any search."""

from __future__ import annotations

import numpy as np

from genmojo_core.tracks.annotation import FrameView
from genmojo_core.tracks.model import NONE
from genmojo_studio.annotate.overlay import DETAILED, MANY, Ghost, Mark, Picture, contours_of
from genmojo_studio.annotate.session import Other, Session


class Presenter:
    """Builds the `Picture` of a frame; keeps outlines of masks and the colours of tracks between frames."""

    def __init__(self, session: Session) -> None:
        self._session = session
        self._contours: dict[int, dict] = {}
        self._owners: dict[int, tuple[int, int]] = {}
        self._revision = -1

    def picture(self, frame: int) -> Picture:
        """What is shown over a frame."""
        session = self._session
        self._refresh()
        view = session.annotation.at(frame)
        detailed = self._detailed(view)
        marks = [self._mark(view, n, frame) for n in detailed]
        painting = session.painting
        if painting is not None and painting.run()[0] <= frame <= painting.run()[1]:
            marks = [m if m.track != painting.track else _with_state(m, painting.state) for m in marks]
        rest = np.ones(len(view.ids), bool)
        rest[detailed] = False
        return Picture(
            marks, view.xy[rest], self._trails(marks, frame), self.contours(frame), session.mask_mode,
            session.track, session.active[0], [p for p in session.sketch if p.frame == frame and session.sketching],
            [self._ghost(other, frame) for other in session.others],
        )  # fmt: skip

    def contours(self, frame: int) -> dict:
        """Outlines of the objects in a frame, as `contours_of`."""
        labels = self._session.cache.mask(frame)
        hand = self._session.hand_masks
        if not self._session.mask_mode or (labels is None and (not hand or self._session.cache.has_masks)):
            return {}
        if frame not in self._contours:
            if len(self._contours) > 400:
                self._contours.clear()
            places = self._session.places()
            found = {} if labels is None else contours_of(labels, {i: n for i, n in places.items() if i not in hand})
            for i, masks in hand.items():
                lines = contours_of(masks[frame].astype(np.uint8) * np.uint8(i), {i: places.get(i, 0)})
                found |= self._scaled(lines, masks)
            self._contours[frame] = found
        return self._contours[frame]

    def _scaled(self, found: dict, masks: np.ndarray) -> dict:
        """Outlines of masks of another resolution (T, h, w) in raster pixels of the clip."""
        scale = np.array(self._session.cache.size, np.float32) / np.array(masks.shape[2:0:-1], np.float32)
        return {i: (place, [line * scale for line in lines]) for i, (place, lines) in found.items()}

    def forget_masks(self) -> None:
        """Masks have changed."""
        self._contours.clear()

    def _refresh(self) -> None:
        """Owners of all tracks, once per edit rather than once per frame."""
        annotation = self._session.annotation
        if annotation.revision == self._revision:
            return
        self._revision = annotation.revision
        places = {o.id: n for n, o in enumerate(self._session.objects())}
        owners = {t: (places.get(i.object, len(places)), i.number - 1) for t, i in annotation.tracks.items()}
        if {o for o, _ in owners.values()} != {o for o, _ in self._owners.values()}:
            self._contours.clear()
        self._owners = owners

    def _detailed(self, view: FrameView) -> np.ndarray:
        """Places in `view` of the tracks with glyphs: all if they are few, else the active object's and the first."""
        if len(view.ids) <= MANY:
            return np.arange(len(view.ids))
        annotation, track = self._session.annotation, self._session.track
        own = [] if track is None else [annotation.row(track)]
        if len(view.ids) < 500:
            own += [annotation.row(i.id) for i in annotation.tracks_of(self._session.active[0]) if i.id != track]
        near = np.searchsorted(view.rows, own[:DETAILED]).tolist()  # rows rise, so nothing is searched through
        mine = [n for n, row in zip(near, own, strict=False) if n < len(view.rows) and view.rows[n] == row]
        others = [n for n in range(min(2 * DETAILED, len(view.rows))) if n not in mine]
        return np.array(others[: DETAILED - len(mine)] + mine, int)

    def _mark(self, view: FrameView, n: int, frame: int) -> Mark:
        track = int(view.ids[n])
        place, point = self._owners.get(track, (0, 0))
        doubt = self._session.suspicion.get(track)
        return Mark(track, (float(view.xy[n, 0]), float(view.xy[n, 1])), int(view.state[n]), int(view.flags[n]), place,
                    point, float(doubt[frame]) if doubt is not None and frame < len(doubt) else 0.0)  # fmt: skip

    def _ghost(self, other: Other, frame: int) -> Ghost:
        """A track that is being compared, or what one is about to become."""
        reach = self._session.trail
        first, end = max(0, frame - reach), min(other.annotation.frames, frame + reach + 1)
        xy, state = other.annotation.window([other.track], first, end)
        return Ghost(other.label, xy[:, 0], state[:, 0], frame - first, other.colour)

    def _trails(self, marks: list[Mark], frame: int) -> list[tuple[Mark, np.ndarray, np.ndarray, int]]:
        """Trails of the marks in one lookup."""
        reach = self._session.trail
        shown = [m for m in marks if m.state != NONE]
        if not reach or not shown:
            return []
        first, end = max(0, frame - reach), min(self._session.annotation.frames, frame + reach + 1)
        xy, state = self._session.annotation.window([m.track for m in shown], first, end)
        return [(mark, xy[:, k], state[:, k], frame - first) for k, mark in enumerate(shown)]


def _with_state(mark: Mark, state: int) -> Mark:
    return Mark(mark.track, mark.xy, state, mark.flags, mark.place, mark.point, mark.suspicion)
