"""Proposals that were taken for tracks go on to lead them: what a scene, CoTracker or a file knows behind what hides a
point, the pixels do not (ANNOTATOR.md section 6.3)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from genmojo_core.tracks.annotation import HUMAN, PROPOSED, TRACKER, Annotation, Cells, Proposal
from genmojo_core.tracks.interpolate import through
from genmojo_core.tracks.model import NONE


@dataclass(frozen=True)
class Guide:
    """Where proposals lead n points of one object.

    xy (n, T, 2) held px, on (n, T) bool: where they say something, state (n, T) uint8, conf (n, T) 0..1, source (n, T)
    uint8 of what is found there.
    """

    xy: np.ndarray
    on: np.ndarray
    state: np.ndarray
    conf: np.ndarray
    source: np.ndarray

    def of(self, rows: list[int]) -> Guide:
        """The guide of some of the points."""
        return Guide(*(a[rows] for a in (self.xy, self.on, self.state, self.conf, self.source)))

    def led(self, xy: np.ndarray, sure: np.ndarray, row: int) -> np.ndarray:  # (1, T, 2) held px
        """Places (1, T, 2) of a point, where it is led on the guide's way through those of frames sure (1, T)."""
        at = np.flatnonzero(sure[0])
        way = through(self.xy[row], self.on[row], at, xy[0, at])
        return np.where(self.on[row][None, :, None], way[None], xy)


def taken(annotation: Annotation, track: int) -> Proposal | None:
    """The proposal that a track follows: that of the tracker that most of its places name as their source."""
    source = annotation.track(track).source
    counts = {name: int((source == code).sum()) for name, code in PROPOSED.items()}
    name = max(counts, key=lambda each: counts[each])
    return annotation.proposals.get(track, {}).get(name) if counts[name] else None


def guide_of(proposals: Sequence[Proposal | None], cells: Sequence[Cells], scale: np.ndarray) -> Guide | None:
    """The guide of some tracks, in held px; None where no proposal leads any of them.

    Args:
        proposals: per track what it follows. cells: all frames of each, which tell by their source where it does.
        scale: source -> held px.
    """
    if all(p is None for p in proposals):
        return None
    shape = (len(cells), len(cells[0]))
    xy, on = np.zeros((*shape, 2)), np.zeros(shape, bool)
    state, conf, source = np.zeros(shape, np.uint8), np.zeros(shape), np.full(shape, TRACKER, np.uint8)
    for n, (proposal, now) in enumerate(zip(proposals, cells, strict=True)):
        if proposal is None:
            continue
        xy[n], state[n], conf[n] = proposal.xy * scale, proposal.state, proposal.conf
        on[n] = np.isin(now.source, [HUMAN, *PROPOSED.values()]) & (proposal.state != NONE)
        source[n] = np.where(on[n], PROPOSED[proposal.tracker], TRACKER)
    return Guide(xy, on, state, conf, source)
