"""Where a track is probably wrong, and why: nine signals, one probability, one ranked queue (ANNOTATOR.md 6.4).

Every signal gives each frame of a track a probability 0..1 of an error; they are joined by a noisy-OR with a trust per
signal, which can be learnt anew from what people accepted and corrected. Positions are source pixels.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from types import MappingProxyType

import numpy as np

from genmojo_core.sentences import say
from genmojo_core.tracks.annotation import CONFIRMED, KEY, PAINTED, Annotation, Cells
from genmojo_core.tracks.model import NONE, OCCLUDED, VISIBLE
from genmojo_core.tracks.signals import (
    Scene,
    affine_residual,
    away_from_keys,
    confidence,
    flicker,
    kinematics,
    links,
    look,
    mask,
    object_size,
    opinions,
    other_tracker,
)

TRUST = MappingProxyType({
    "motion": 0.75, "links": 0.8, "look": 0.35, "trackers": 0.5, "mask": 0.97, "affine": 0.7, "flicker": 0.6,
    "confidence": 0.3, "keys": 0.1,
})  # fmt: skip
SIGNALS = MappingProxyType({name: say(f"doubt_{name}") for name in TRUST})  # in words
SUSPICIOUS = 0.5  # score from which a frame is worth a visit of its own
RUN = 4  # frames that one visit shows where nothing is suspicious, and twice as many where something is
_LEAST_TRUST = 0.3  # share of its first trust that a signal keeps, however often it was wrong
_LOOKED_AT = 0.25  # share of the suspicion that is left where a person accepted the place


@dataclass(frozen=True)
class Evidence:
    """What pictures say about one track; any part may be missing.

    gap (T,) source px between the place and where matches from frames nearby put it (NaN: no match), agreement (T,)
    0..1 of those matches, likeness (T,) -1..1 of the pixels with those at the keys, also where the point is said to be
    hidden (NaN: unknown), other (T, 2) a second tracker's places (NaN: none).
    """

    gap: np.ndarray | None = None
    agreement: np.ndarray | None = None
    likeness: np.ndarray | None = None
    other: np.ndarray | None = None


@dataclass(frozen=True)
class Suspicion:
    """Scores (T,) 0..1 of one track, the parts (9, T) they come from in the order of SIGNALS, trust (9,) in each."""

    score: np.ndarray
    parts: np.ndarray
    trust: np.ndarray

    def reasons(self, t: int, count: int = 2) -> list[str]:
        """The strongest reasons at frame t in words, strongest first."""
        order = np.argsort(-self.parts[:, t])[:count]
        return [list(SIGNALS.values())[i] for i in order if self.parts[i, t] > 0.1]


@dataclass(frozen=True)
class Spot:
    """A run of frames first..last of a track to look at, the worst of them, its score and why."""

    track: int
    first: int
    last: int
    frame: int
    score: float
    reasons: tuple[str, ...]


@dataclass
class Calibration:
    """How much each signal is trusted, learnt from outcomes; starts at TRUST as if seen `prior` times.

    One outcome per place: what spoke against it (9,) when a person first judged it, and whether it was ever corrected.
    """

    prior: float = 20.0
    outcomes: dict[tuple[int, int], tuple[np.ndarray, bool]] = field(default_factory=dict)  # (track, frame) ->

    def trust(self, annotation: Annotation | None = None) -> np.ndarray:  # (9,)
        """Trust per signal, in the order of SIGNALS, never below a share of TRUST.

        With `annotation` only from places that stand as a person left them: what was undone teaches nothing.
        """
        first = np.array(list(TRUST.values()))
        told = list(self.outcomes.values()) if annotation is None else self._standing(annotation)
        fired = np.array([o[0] for o in told]).reshape(-1, len(first))
        right = np.array([o[1] for o in told], bool)
        learnt = (first * self.prior + fired[right].sum(axis=0)) / (self.prior + fired.sum(axis=0))
        return np.asarray(np.maximum(learnt, _LEAST_TRUST * first))

    def copy(self) -> Calibration:
        """What was learnt so far, for another thread."""
        return Calibration(self.prior, dict(self.outcomes))

    def _standing(self, annotation: Annotation) -> list[tuple[np.ndarray, bool]]:
        """Outcomes of places on which a person's word is still there."""
        flags = {t: annotation.track(t).flags for t in {track for track, _ in self.outcomes} & set(annotation.tracks)}
        return [o for (track, t), o in self.outcomes.items() if track in flags and flags[track][t] & (KEY | CONFIRMED)]

    def learn(self, track: int, t: int, suspicion: Suspicion, corrected: bool) -> None:
        """A person looked at frame t of a track and corrected it or accepted it; again says nothing new."""
        known = self.outcomes.get((track, t))
        if known is not None:
            self.outcomes[track, t] = (known[0], known[1] or corrected)
        else:
            self.outcomes[track, t] = (np.round(suspicion.parts[:, t] / suspicion.trust, 2), corrected)

    def rows(self) -> list[list[object]]:
        """What was learnt, as plain data: track, frame, whether it was corrected, what spoke against it."""
        return [[*cell, corrected, fired.tolist()] for cell, (fired, corrected) in self.outcomes.items()]

    def put_rows(self, rows: list[tuple[int, int, bool, list[float]]]) -> None:
        """Learnt before; outcomes of other signals than today's are left out."""
        for track, t, corrected, fired in rows:
            if len(fired) == len(TRUST):
                self.outcomes[int(track), int(t)] = (np.array(fired, float), bool(corrected))


def assess(
    annotation: Annotation,
    scene: Scene | None = None,
    evidence: dict[int, Evidence] | None = None,
    calibration: Calibration | None = None,
    tracks: list[int] | None = None,
) -> dict[int, Suspicion]:
    """Suspicion of every track (or of some), from the tracks themselves and whatever else is known.

    Args:
        annotation: the tracks. scene: masks of the clip. evidence: per track. calibration: learnt trust.
    """
    trust = (calibration or Calibration()).trust(annotation)
    found = {}
    for track in [i.id for i in annotation.active()] if tracks is None else tracks:
        cells = annotation.track(track)
        others = [annotation.track(i.id) for i in annotation.tracks_of(annotation.tracks[track].object)
                  if i.id != track]  # fmt: skip
        parts = _parts(annotation, track, cells, others, (scene, (evidence or {}).get(track, Evidence())))
        parts *= trust[:, None]
        found[track] = _judged(cells, parts, trust)
    return found


def queue(annotation: Annotation, suspicions: dict[int, Suspicion]) -> list[Spot]:
    """Every frame that has a state, as runs, worst first: suspicious ones of 2 RUN frames at most, calm ones of RUN."""
    spots = []
    for track, suspicion in suspicions.items():
        state = annotation.track(track).state
        label = np.where(state == NONE, 0, np.where(suspicion.score >= SUSPICIOUS, 2, 1))
        edges = np.flatnonzero(np.diff(label, prepend=-1, append=-1))
        for first, end in zip(edges[:-1], edges[1:], strict=True):
            step = RUN if label[first] == 1 else 2 * RUN
            for begin in range(int(first), int(end if label[first] else first), step):
                run = suspicion.score[begin : min(begin + step, end)]
                worst = begin + int(np.argmax(run))
                reasons = tuple(suspicion.reasons(worst))
                spots.append(Spot(track, begin, begin + len(run) - 1, worst, float(run.max()), reasons))
    return sorted(spots, key=lambda s: (-s.score, s.frame, s.track))


def _parts(
    annotation: Annotation, track: int, cells: Cells, others: list[Cells], known: tuple[Scene | None, Evidence]
) -> np.ndarray:  # (9, T)
    """Every signal before trust, in the order of SIGNALS."""
    scene, evidence = known
    unit = max(annotation.size[1] / 1080.0, 1e-6)  # px that are one at 1080p
    owner = annotation.tracks[track].object
    size = object_size(cells, others, scene, owner, unit)
    if evidence.other is None:
        away = opinions(cells, annotation.proposals.get(track, {}))
    else:
        away = np.linalg.norm(cells.xy - evidence.other, axis=1)
    parts = np.stack([
        kinematics(cells, others, unit), links(cells, evidence.gap, size), look(evidence.likeness, cells),
        other_tracker(cells, away, size), mask(cells, scene, owner, evidence.agreement, evidence.likeness),
        affine_residual(cells, others, unit), flicker(cells, annotation.size), confidence(cells), away_from_keys(cells),
    ])  # fmt: skip
    return np.clip(np.nan_to_num(parts), 0.0, 1.0)


def _judged(cells: Cells, parts: np.ndarray, trust: np.ndarray) -> Suspicion:
    """Noisy-OR; keys keep only what masks say against them, accepted frames a quarter, painted states half of that."""
    is_key, accepted = (cells.flags & KEY) > 0, (cells.flags & CONFIRMED) > 0
    on_mask = list(SIGNALS).index("mask")
    kept = np.where(is_key, 0.0, np.where(accepted, _LOOKED_AT, 1.0)) * np.ones_like(parts)
    kept[on_mask] = np.where((cells.flags & PAINTED) > 0, 0.5 * _LOOKED_AT, np.where(accepted, _LOOKED_AT, 1.0))
    kept[on_mask, is_key & (cells.state == VISIBLE)] = 1.0
    kept[on_mask, is_key & (cells.state == OCCLUDED)] = _LOOKED_AT
    parts = parts * kept * (cells.state != NONE)
    return Suspicion(1.0 - np.prod(1.0 - parts, axis=0), parts, trust)
