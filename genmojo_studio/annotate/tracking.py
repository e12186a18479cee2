"""The solver at work beside the window: seeds, segments solved again after a key, suspicion.

One thread asks the solver, which keeps what it matched. Requests are copies of what stands; an answer that comes after
its key was changed again, or after its step was undone, changes nothing.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QObject, QTimer, Signal

from genmojo_core.clip.clip import Clip
from genmojo_core.errors import GenmojoError
from genmojo_core.sentences import say
from genmojo_core.trackers.evidence import scene_of
from genmojo_core.trackers.seeding import OpticalSeeder, Queries, Seeder, merged, proposals
from genmojo_core.trackers.solver import SolveAnswer, SolveRequest, TrackSolver
from genmojo_core.tracks import keys, suspicion
from genmojo_core.tracks.annotation import PROPOSED, TRACKER, Proposal
from genmojo_core.tracks.edits import join
from genmojo_core.tracks.model import NONE
from genmojo_core.tracks.suspicion import Evidence, Spot, Suspicion
from genmojo_studio import notify
from genmojo_studio.annotate.learnt import Learnt
from genmojo_studio.annotate.seed_task import SeedTask, seedable, seeded_words
from genmojo_studio.annotate.segments import by_rule, frames_between, is_key, within
from genmojo_studio.annotate.session import Session
from genmojo_studio.background import Tasks
from genmojo_studio.translate import fault, tr

SHOWN = 0.15  # score from which a spot stands in the queue
_PATIENCE = 350  # ms without an edit after which suspicion is ranked anew


@dataclass(frozen=True)
class _Key:
    """A key to answer: track, frame, the step it was placed in, and the frames to be solved."""

    track: int
    frame: int
    step: int | None


@dataclass(frozen=True)
class _Judged:
    """What was found of the annotation of a revision: all evidence so far, suspicion by track, spots, worst first."""

    revision: int
    evidence: dict[int, Evidence]
    found: dict[int, Suspicion]
    spots: list[Spot]


class Tracking(QObject):
    """Solves and judges the tracks of a session."""

    spots_ready = Signal(object)  # list of Spot, worst first
    busy_changed = Signal(str)
    solved = Signal(int)  # tracks changed
    progressed = Signal(float)  # 0..1 of a seeding
    measured = Signal(object)  # track -> {"fb": (T,) px, "ncc": (T,)}, for graphs
    settled = Signal()  # every solution that was asked for is there
    seeded = Signal(int)  # tracks filled, 0 if cancelled or failed

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self.tasks = Tasks()
        self.learnt = Learnt(session.project)
        self.suspicions: dict[int, Suspicion] = {}
        self.evidence: dict[int, Evidence] = {}
        self._solver: TrackSolver | None = None
        self._solved_clip: Clip | None = None
        self._stale: set[int] = set()  # objects whose evidence is to be gathered again
        self._gathering = False
        self._closed = False
        self.pending = 0  # solutions asked for and not there yet
        self._following: list[int] = []  # directions to follow the active point in, one after the other
        self._seeding = SeedTask(self.tasks, self._gave_up_seeding)
        self._look = QTimer(self, singleShot=True, interval=_PATIENCE)
        self._look.timeout.connect(self._judge)
        session.edited.connect(self._edited)
        session.judged.connect(self._learn)

    def close(self) -> None:
        """Drop what is going on."""
        self.learnt.keep(now=True)
        self._closed = True
        self._seeding.cancel()
        self._look.stop()
        self.tasks.close()

    def look_again(self) -> None:
        """Rank suspicious spots anew, soon; pictures are looked at again where tracks have changed."""
        self._stale |= {i.object for i in self._session.annotation.tracks.values()}
        self._look.start()

    # ---- solving

    def seed(self, objects: list[int]) -> bool:
        """Fill the tracks of objects from the pixels, wherever nobody said otherwise; False if that cannot begin."""
        clip = self._clip_with_masks()
        if clip is None:
            return False
        requests, left_out = seedable(self._session.annotation, objects, clip)
        if not requests:
            self._session.said.emit(left_out or tr("Place points first."))
            return False
        self.busy_changed.emit(tr("Seeding {n} tracks …").format(n=sum(len(r.tracks) for r in requests)))

        def work(cancelled: Callable[[], bool]) -> list[SolveAnswer]:
            solver = self._solver_for(clip)
            return [solver.answer(r, self._progress(n, len(requests)), cancelled)
                    for n, r in enumerate(requests)]  # fmt: skip

        self._seeding.run(work, lambda answers: self._seeded(answers, left_out), self._failed)
        return True

    def optical_seconds(self, clip: Clip, queries: Queries) -> float:
        """What seeding these points from the pixels is guessed to take: objects matched before cost next to nothing."""
        solver = self._solver if self._solved_clip is clip else None
        new = np.array([solver is None or not solver.has_matched(int(o)) for o in queries.object], bool)
        return OpticalSeeder().forecast(clip, Queries(queries.t[new], queries.xy[new], queries.object[new]))

    def seed_by(self, seeder: Seeder, objects: list[int]) -> bool:
        """Let another tracker propose positions for the tracks of objects; False if there is nothing to seed."""
        session, clip = self._session, self._session.clip
        asked = [i.id for o in objects for i in session.annotation.tracks_of(o) if len(session.annotation.keys(i.id))]
        ids, queries = Queries.of(session.annotation, asked)
        if clip is None or not ids:
            lacking = tr("Place points where they are seen.") if asked else tr("Place points first.")
            session.said.emit(tr("The clip is still being read.") if clip is None else lacking)
            return False
        self.busy_changed.emit(tr("Seeding by {name} …").format(name=seeder.name))

        def work(cancelled: Callable[[], bool]) -> dict[int, Proposal]:
            found = merged(seeder.seed(clip, queries, self._progress(0, 1), cancelled), queries)
            return proposals(found, ids, seeder.name)

        self._seeding.run(work, lambda found: self._proposed(found, asked), self._failed)
        return True

    def _gave_up_seeding(self) -> None:
        if not self._closed:
            self.busy_changed.emit("")
            self._session.said.emit(tr("Seeding was cancelled; nothing was changed."))
            self.seeded.emit(0)

    def _proposed(self, found: dict[int, Proposal], asked: list[int]) -> None:
        """Keep proposals beside the tracks, and take them wherever no person said otherwise."""
        if self._closed:
            return
        self.busy_changed.emit("")
        session = self._session
        there = {t: p for t, p in found.items() if t in session.annotation.tracks and (p.state != NONE).any()}
        for track, proposal in there.items():
            session.project.propose(track, proposal)
        if there:
            name = next(iter(there.values())).tracker
            session.do(keys.accept(session.annotation, there, PROPOSED.get(name, TRACKER)))
        self._stale |= {session.annotation.tracks[t].object for t in there}
        self._look.start()
        self._tell_seeded(len(there), [t for t in asked if t in session.annotation.tracks and t not in there])

    def _progress(self, done: int, count: int) -> Callable[[float], None]:
        """Tells the share of the whole of one object's progress."""
        return lambda share: self.progressed.emit((done + share) / count)

    def cancel(self) -> None:
        """End a seeding that runs; nothing is changed."""
        self._seeding.cancel()

    def _seeded(self, answers: list[SolveAnswer], left_out: str) -> None:
        """All objects as one step. left_out: a sentence on those that were not seeded."""
        if self._closed:
            return
        self.busy_changed.emit("")
        annotation = self._session.annotation
        parts = [answer.edit(annotation) for answer in answers]
        made = [part for part in parts if part.changes]
        count = sum(len(answer.found) for answer in answers)
        if made and self._session.do(join("seed", say("seed", count=count), made)) is not None:
            for track, kept in (pair for answer in answers for pair in answer.proposals(annotation.frames).items()):
                self._session.project.propose(track, kept)  # a second opinion, once segments are solved again
        self._stale |= {answer.request.object_id for answer in answers}
        self._look.start()
        self._tell_seeded(count, [], left_out)

    def _tell_seeded(self, count: int, lost: list[int], left_out: str = "") -> None:
        """What the status line said before, that seeding comes next, is over; what was not found is named."""
        words = seeded_words(self._session.annotation, count, lost)
        if words:
            self._session.said.emit(f"{words} {left_out}".strip())
        self.seeded.emit(count)

    def after_key(self, track: int, frame: int, step: int | None) -> None:
        """Solve the segments on both sides of a key that a person has just placed, as part of that step; where the
        key was taken away, the segment that it divided."""
        annotation = self._session.annotation
        info = annotation.tracks.get(track)
        if info is None:
            return
        span = None
        if not is_key(annotation, track, frame):
            start, end = annotation.segment(track, frame)
            anchor = start if start is not None else end
            if anchor is None or by_rule(annotation, track, start, end):
                return
            span, frame = frames_between(annotation, start, end), anchor
        request = SolveRequest.of(annotation, info.object, (track, frame), anew=span is not None)
        if (np.count_nonzero(request.cells[request.tracks.index(track)].state)) > 1 or step is None:
            self._ask(request, _Key(track, frame, step), span)

    def run(self, direction: int) -> None:
        """Solve the active track from this frame to the next key (1), back to the one before (-1), or both (0)."""
        session, track = self._session, self._session.track
        if track is None:
            return
        annotation, frame = session.annotation, session.frame
        start, end = annotation.segment(track, frame)
        anchor = start if start is not None else end
        if anchor is None:
            session.said.emit(tr("Place this point first."))
            return
        if anchor == frame and direction <= 0:  # on a key: what lies before it begins at the key before
            start = max((k for k in annotation.keys(track).tolist() if k < frame), default=None)
        first, last = frames_between(annotation, start, end)
        span = {1: (frame, last), -1: (first, frame), 0: (first, last)}[direction]
        if by_rule(annotation, track, start, end):
            session.said.emit(tr("This segment is filled by line or hold; I changes that."))
            return
        info = annotation.tracks[track]
        self._ask(SolveRequest.of(annotation, info.object, (track, anchor), anew=True), _Key(track, anchor, None), span)

    def one(self, direction: int) -> None:
        """Match the active point from this frame to the next or the one before, and go there.

        What a person placed, accepted or painted there stays. While one is under way, the next waits its turn.
        """
        self._following.append(direction)
        if len(self._following) == 1:
            self._follow(direction)

    def _followed(self) -> None:
        """One frame is done; the next, if it was asked for."""
        self._following = self._following[1:]
        if self._following:
            self._follow(self._following[0])

    def _follow(self, direction: int) -> None:
        session, track, annotation = self._session, self._session.track, self._session.annotation
        frame, there = session.frame, session.frame + direction
        if track is None or not 0 <= there < annotation.frames:
            self._following.clear()
            return
        cells = annotation.track(track).copy()
        if cells.state[frame] == NONE:
            session.said.emit(tr("Place this point first."))
            self._following.clear()
            return
        clip = self._clip_with_masks()
        if clip is None:
            self._following.clear()
            return
        request = SolveRequest(annotation.tracks[track].object, annotation.size, (track,), (cells,), (track, frame))

        def followed(answer: SolveAnswer) -> None:
            self._answered(answer, _Key(track, frame, None), None)
            if not answer.found:
                session.said.emit(tr("The object is not seen in both frames; the point stays where it is."))
                self._following.clear()
            self._followed()

        self.pending += 1
        self.tasks.run(lambda: self._solver_for(clip).follow(request, there), followed, self._gave_up)
        session.go(there)

    def _ask(self, request: SolveRequest, key: _Key, span: tuple[int, int] | None = None) -> None:
        clip = self._clip_with_masks()
        if clip is None or not request.tracks:
            return
        self.busy_changed.emit(tr("Solving …"))
        self.pending += 1

        def work() -> SolveAnswer:
            return self._solver_for(clip).answer(request)

        self.tasks.run(work, lambda answer: self._answered(answer, key, span), self._gave_up)

    def _clip_with_masks(self) -> Clip | None:
        """The clip to track in; says so if there is none."""
        clip = self._session.clip
        if clip is not None and clip.masks is not None:
            return clip
        reading = tr("The clip is still being read.")
        lacking = tr("There are no masks to track in: make one in step 1.")
        self._session.said.emit(reading if clip is None else lacking)
        return None

    def _solver_for(self, clip: Clip) -> TrackSolver:
        """The solver of a clip; made on the thread that uses it."""
        if self._solver is None or self._solved_clip is not clip:
            self._solver, self._solved_clip = TrackSolver(clip), clip
        return self._solver

    def _answered(self, answer: SolveAnswer, key: _Key, span: tuple[int, int] | None) -> None:
        if self._closed:
            return
        self.busy_changed.emit("")
        if span is not None:
            answer = within(answer, span)
        edit = answer.edit(self._session.annotation)
        if edit.changes:
            self._session.do(edit, key.step)
        self.solved.emit(len(answer.found))
        self._stale.add(answer.request.object_id)
        self._look.start()
        self._arrived()

    def _arrived(self) -> None:
        """An answer, or word that there will be none."""
        self.pending -= 1
        if not self.pending:
            self.settled.emit()

    def _gave_up(self, error: BaseException) -> None:
        self._following.clear()
        self._failed(error)
        if not self._closed:
            self._arrived()

    # ---- judging

    def _edited(self, touched: object) -> None:
        tracks = self._session.annotation.tracks
        self._stale |= {tracks[t].object for t in getattr(touched, "tracks", ()) if t in tracks}
        self._look.start()

    def _judge(self) -> None:
        """Gather evidence of changed objects and rank what is suspicious, on the thread; one round at a time."""
        session, clip = self._session, self._session.clip
        if self._closed or self._gathering or clip is None:
            return
        ids = clip.object_ids.tolist() if clip.masks is not None else []  # without masks other signals tell
        requests = [SolveRequest.of(session.annotation, o) for o in self._stale if o in ids and self._is_seeded(o)]
        self._stale.clear()
        self.learnt.keep()
        self._gathering = True
        now, known, taught = session.annotation.copy(), dict(self.evidence), self.learnt.calibration.copy()

        def work() -> _Judged:
            for request in requests:
                known.update(self._solver_for(clip).evidence(request))
            there = {t: e for t, e in known.items() if t in now.tracks}
            found = suspicion.assess(now, scene_of(clip), there, taught)
            return _Judged(now.revision, known, found, suspicion.queue(now, found))

        self.tasks.run(work, self._judged, self._failed)

    def _is_seeded(self, object_id: int) -> bool:
        """Whether any track of an object goes beyond the frames that a person placed."""
        annotation = self._session.annotation
        return any(np.count_nonzero(annotation.track(i.id).state) > len(annotation.keys(i.id))
                   for i in annotation.tracks_of(object_id))  # fmt: skip

    def _judged(self, judged: _Judged) -> None:
        self._gathering = False
        session = self._session
        if self._closed or session.clip is None:
            return
        tracks, self.evidence = session.annotation.tracks, judged.evidence
        self.suspicions = {t: s for t, s in judged.found.items() if t in tracks}
        session.suspicions = self.suspicions
        session.suspicion = {t: s.score for t, s in self.suspicions.items()}
        self.measured.emit({t: {"fb": e.gap, "ncc": e.likeness} for t, e in self.evidence.items() if t in tracks})
        self.spots_ready.emit([s for s in judged.spots if s.score >= SHOWN and s.track in tracks])
        session.shown.emit()
        if self._stale or session.annotation.revision != judged.revision:
            self._look.start()

    def _learn(self, track: int, frame: int, corrected: bool) -> None:
        """A person judged a place: signals that were right count for more from now on, in this project."""
        if track in self.suspicions:
            self.learnt.learn(track, frame, self.suspicions[track], corrected=corrected)

    def _failed(self, error: BaseException) -> None:
        self._gathering = False
        if self._closed:
            return
        self.busy_changed.emit("")
        if isinstance(error, GenmojoError):
            self._session.said.emit(fault(error))
        else:
            notify.tell(error)
        self.seeded.emit(0)
