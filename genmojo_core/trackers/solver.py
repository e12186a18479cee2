"""Seeds and re-solves the tracks of an annotation from the pixels of its clip (ANNOTATOR.md section 6.3).

solver = TrackSolver(clip)                                # the clip at 540 pixels on the short side or less
request = SolveRequest.of(annotation, object_id)          # copies; on the thread that owns the annotation
answer = solver.answer(request)                           # slow; on any one thread
project.do(answer.edit(annotation), step=step_of_the_key)
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from genmojo_core.clip.clip import Channel, Clip
from genmojo_core.errors import GenmojoError
from genmojo_core.sentences import say
from genmojo_core.trackers.evidence import evidence_of
from genmojo_core.trackers.guide import Guide, guide_of, taken
from genmojo_core.trackers.object_motion import ObjectMotion
from genmojo_core.trackers.segment_solver import SPANS, solve_points
from genmojo_core.trackers.slide import slides
from genmojo_core.trackers.stabilise import Layer, flat_shade
from genmojo_core.trackers.visibility import states_in, states_of
from genmojo_core.tracks import keys
from genmojo_core.tracks.annotation import CONFIRMED, KEY, TRACKER, Annotation, Cells, Proposal
from genmojo_core.tracks.edits import Edit, join
from genmojo_core.tracks.model import NONE, VISIBLE
from genmojo_core.tracks.suspicion import Evidence

SHORT_SIDE = 540  # held px from which more only costs time
OPTICAL = "optical"
_SLACK = 4.0  # source px at 1080p by which a link may miss a key before it is matched again


@dataclass(frozen=True)
class SolveRequest:
    """What a solution needs to know; no view of the annotation.

    Args:
        object_id: whose tracks. size: (width, height) of the source.
        tracks: ids (n,). cells: all T frames of each, copied.
        key: (track, frame) of the key to answer; None to seed everything.
        anew: the key's segments are followed anew, not begun from where they stand: for places that a deleted key, a
            line or a hold has left behind.
        proposals: per track the proposal it follows, None for those that follow the pixels alone.
    """

    object_id: int
    size: tuple[int, int]
    tracks: tuple[int, ...]
    cells: tuple[Cells, ...]
    key: tuple[int, int] | None
    anew: bool = False
    proposals: tuple[Proposal | None, ...] = ()

    @staticmethod
    def of(
        annotation: Annotation, object_id: int, key: tuple[int, int] | None = None, anew: bool = False
    ) -> SolveRequest:
        """The tracks of an object that have a key."""
        ids = tuple(i.id for i in annotation.tracks_of(object_id) if len(annotation.keys(i.id)))
        cells = tuple(annotation.track(i).copy() for i in ids)
        led = () if key is None else tuple(taken(annotation, i) for i in ids)
        return SolveRequest(object_id, annotation.size, ids, cells, key, anew, led)


@dataclass(frozen=True)
class SolveAnswer:
    """Cells found: track -> (frames (m,), Cells of m); `seconds` of process time."""

    request: SolveRequest
    found: dict[int, tuple[np.ndarray, Cells]]

    def edit(self, annotation: Annotation) -> Edit:
        """One machine's edit; tracks whose keys changed since they were asked about are left as they are."""
        parts = []
        for track, (frames, cells) in self.found.items():
            asked = self.request.cells[self.request.tracks.index(track)]
            if track in annotation.tracks and _same_keys(annotation.track(track), asked):
                parts.append(keys.solved(annotation, track, frames, cells))
        made = [part for part in parts if part.changes]
        title = made[0].title if len(made) == 1 else say("solve_tracks", count=len(made))
        return join("solve", title, made)

    def proposals(self, frames: int) -> dict[int, Proposal]:
        """What was found, as proposals named "optical" over all frames: what later solutions are held to."""
        kept = {}
        for track, (at, found) in self.found.items():
            cells = Cells.empty(frames)
            for mine, theirs in zip(cells.arrays(), found.arrays(), strict=True):
                mine[at] = theirs
            kept[track] = Proposal(OPTICAL, cells.xy, cells.state, cells.conf)
        return kept


class TrackSolver:
    """Solves tracks inside objects' masks. Keeps what it matched, so later answers are quick. One thread at a time.

    Args:
        clip: with masks; held at about SHORT_SIDE pixels.
    Raises GenmojoError("schema") if the clip has no masks.
    """

    def __init__(self, clip: Clip) -> None:
        if clip.masks is None:
            raise GenmojoError("schema", "has no masks, and points are tracked inside them", clip.path,
                               "give masks or boxes")  # fmt: skip
        self._clip = clip
        self._shade: np.ndarray | None = None
        self._motions: dict[int, ObjectMotion] = {}
        self.scale = np.array(clip.size, np.float64) / np.array(clip.source_size, np.float64)  # source -> held px

    def answer(
        self,
        request: SolveRequest,
        progress: Callable[[float], None] | None = None,
        cancelled: Callable[[], bool] | None = None,
    ) -> SolveAnswer:
        """Positions and states of the request's tracks: all frames when seeding, else the segments next to the key,
        and of the object's other tracks what a corrected match changes.

        Raises GenmojoError("argument") if the clip has no such object.
        """
        if not request.tracks or (request.key is not None and request.key[0] not in request.tracks):
            return SolveAnswer(request, {})
        motion = self._motion(request.object_id)
        xy = np.stack([c.xy for c in request.cells]).astype(np.float64) * self.scale
        fixed = np.stack([(c.flags & (KEY | CONFIRMED)) > 0 for c in request.cells])
        known = np.stack([c.state != NONE for c in request.cells])
        seen = np.stack([c.state == VISIBLE for c in request.cells])
        guide = guide_of(request.proposals, request.cells, self.scale)
        rows, first, end = list(range(len(xy))), 0, len(self._clip)
        if request.key is None:
            xy = _chained(motion, xy, known, fixed, progress, cancelled)
        else:
            row, t = request.tracks.index(request.key[0]), request.key[1]
            if request.anew:
                start, stop = _segments(request.cells[row], t)
                again = _chained(motion, xy[[row]], known[[row]], fixed[[row]], None, cancelled)
                again = again if guide is None else guide.led(again, fixed[[row]] & known[[row]], row)
                xy[row, start:stop] = again[0, start:stop]
            relinked = self._relink(motion, xy, fixed, t)
            first, end = (max(t - max(SPANS), 0), end) if relinked else _segments(request.cells[row], t)
            rows = rows if relinked else [row]
        slid = slides(motion, xy, fixed & seen)
        if request.key is not None and slid.any():
            rows, first, end = list(range(len(xy))), max(t - max(SPANS), 0), len(self._clip)
        mine = None if guide is None else guide.of(rows)
        xy[rows] = solve_points(motion, xy[rows], fixed[rows], first, end, slid[rows], mine)
        return SolveAnswer(request, self._cells(motion, request, xy, mine, (rows, first, end)))

    def has_matched(self, object_id: int) -> bool:
        """Whether the object was asked about before, so that answers are quick; on any thread."""
        return object_id in self._motions

    def follow(self, request: SolveRequest, t: int) -> SolveAnswer:
        """The point of the request's key in one other frame t, by the match of these two frames alone.

        Nothing is found where the object is not seen in either.
        """
        if request.key is None or request.key[0] not in request.tracks:
            return SolveAnswer(request, {})
        motion, (track, s) = self._motion(request.object_id), request.key
        cells = request.cells[request.tracks.index(track)]
        carried = motion.carry(s, t, cells.xy[s : s + 1].astype(np.float64) * self.scale)
        if carried is None:
            return SolveAnswer(request, {})
        place, conf = carried[0], carried[1].astype(np.float32)
        state = states_in(motion, t, place, self._clip.size)
        none, source = np.zeros(1, np.uint8), np.full(1, TRACKER, np.uint8)
        found = Cells((place / self.scale).astype(np.float32), state, none, source, conf, none)
        return SolveAnswer(request, {track: (np.array([t]), found)})

    def evidence(self, request: SolveRequest) -> dict[int, Evidence]:
        """What the pictures say about the request's tracks as they stand, for `suspicion.assess`."""
        if not request.tracks:
            return {}
        motion = self._motion(request.object_id)
        xy = np.stack([c.xy for c in request.cells]).astype(np.float64) * self.scale
        keyed = np.stack([(c.flags & KEY) > 0 for c in request.cells])
        for t in np.flatnonzero(keyed.any(axis=0)):
            self._relink(motion, xy, keyed, int(t))
        found = evidence_of(motion, self._clip.frames, list(request.cells), self.scale)
        return dict(zip(request.tracks, found, strict=True))

    def _relink(self, motion: ObjectMotion, xy: np.ndarray, fixed: np.ndarray, t: int) -> bool:
        """Match again what contradicts the places people are sure of in frame t and in frames around it."""
        slack = _SLACK * self._clip.size[1] / 1080.0
        changed = False
        for s in [t + sign * span for span in SPANS for sign in (-1, 1)]:
            if 0 <= s < motion.frames and (both := fixed[:, s] & fixed[:, t]).any():
                changed |= motion.relink(s, t, xy[both, s], xy[both, t], slack)
                changed |= motion.relink(t, s, xy[both, t], xy[both, s], slack)
        return changed

    def _cells(
        self, motion: ObjectMotion, request: SolveRequest, xy: np.ndarray, guide: Guide | None,
        what: tuple[list[int], int, int],
    ) -> dict[int, tuple[np.ndarray, Cells]]:  # fmt: skip
        """The solved frames as cells in source pixels."""
        rows, first, end = what
        frames = np.arange(first, end)
        state, conf = states_of(motion, xy[rows], [request.cells[row] for row in rows], self._clip.size, guide)
        none = np.zeros(len(frames), np.uint8)
        source = np.full((len(rows), len(frames)), TRACKER, np.uint8) if guide is None else guide.source[:, frames]
        found = {}
        for n, row in enumerate(rows):
            place = (xy[row, frames] / self.scale).astype(np.float32)
            told = Cells(place, state[n, frames], none, source[n], conf[n, frames], none)
            found[request.tracks[row]] = (frames, told)
        return found

    def _motion(self, object_id: int) -> ObjectMotion:
        """The object's links, made when first asked for."""
        if object_id not in self._motions:
            at = np.flatnonzero(self._clip.object_ids == object_id)
            if not len(at):
                raise GenmojoError("argument", f"has no object {object_id} to track", self._clip.path)
            if self._shade is None:
                self._shade = np.stack([flat_shade(frame) for frame in self._clip.frames])
            mask = self._clip.object_mask(int(at[0]))
            masks: Channel = self._clip.masks  # type: ignore[assignment]
            layer = Layer(self._shade, mask, (masks.value > 0) & ~mask)
            known = np.mean(masks.valid, axis=(1, 2)) > 0.5  # a mask drawn by hand makes only its own pixels known
            self._motions[object_id] = ObjectMotion(layer, known)
        return self._motions[object_id]


def _chained(
    motion: ObjectMotion, xy: np.ndarray, known: np.ndarray, fixed: np.ndarray,
    progress: Callable[[float], None] | None, cancelled: Callable[[], bool] | None,
) -> np.ndarray:  # (n, T, 2)  # fmt: skip
    """First places where there is none yet: outward from each point's first sure frame.

    Where the object is not seen at all a point stays; from there on it is carried from the last frame that shows it.
    """
    out = xy.copy()
    sure = fixed & known
    begin = np.argmax(sure, axis=1)
    homes = np.unique(begin[sure.any(axis=1)])
    jobs = [(q, range(q + step, end, step)) for q in homes.tolist() for step, end in ((1, motion.frames), (-1, -1))]
    for count, (q, frames) in enumerate(jobs):
        mine, source = np.flatnonzero(sure.any(axis=1) & (begin == q)), q
        for t in frames:
            rows = mine[~fixed[mine, t]]
            carried = motion.carry(source, t, out[rows, source]) if len(rows) else None
            out[rows, t] = out[rows, source] if carried is None else carried[0]
            source = t if motion.grid(t) is not None else source
            if cancelled is not None and cancelled():
                raise GenmojoError("argument", "was cancelled", "seeding")
        if progress is not None:
            progress((count + 1) / (2 * len(jobs)))
    return out


def _segments(cells: Cells, t: int) -> tuple[int, int]:
    """First frame and end of the two segments next to a key."""
    found = np.flatnonzero(cells.flags & KEY)
    before, after = found[found < t], found[found > t]
    return int(before[-1]) if len(before) else 0, int(after[0]) + 1 if len(after) else len(cells)


def _same_keys(now: Cells, then: Cells) -> bool:
    """Whether no key was placed, moved or deleted since."""
    mine, theirs = (now.flags & KEY) > 0, (then.flags & KEY) > 0
    return bool(np.array_equal(mine, theirs) and np.array_equal(now.xy[mine], then.xy[theirs]))
