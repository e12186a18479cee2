"""Two annotators of one clip: how far they agree, and a three-way merge with a preview."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np

from genmojo_core.errors import GenmojoError
from genmojo_core.sentences import say
from genmojo_core.tracks.annotation import Annotation, Cells
from genmojo_core.tracks.edits import Edit, cells_change
from genmojo_core.tracks.metrics import track_metrics
from genmojo_core.tracks.model import NONE, VISIBLE, PointTracks

SAME_PIXELS = 1.5  # at 1080p: closer than this two people mean the same place
Side = Literal["mine", "theirs", "same", "conflict"]
Choice = Literal["mine", "theirs", "middle"]


@dataclass(frozen=True)
class MergeRun:
    """Frames first..last of my track in which one side or both changed something.

    kind: "mine" or "theirs" (only that side did), "conflict"; gap: largest distance in source px (NaN where a side has
    no place); their: the other annotation's track, None if it has no such point.
    """

    track: int
    their: int
    first: int
    last: int
    kind: Side
    gap: float


def pairs(mine: Annotation, theirs: Annotation) -> list[tuple[int, int]]:
    """Tracks of the same object and number, mine first. Raises GenmojoError("value") for annotations of other clips."""
    if (mine.frames, mine.size) != (theirs.frames, theirs.size):
        raise GenmojoError("value", f"{theirs.frames} frames of {theirs.size} are compared with {mine.frames} of "
                           f"{mine.size}", "second annotation", "give the same clip")  # fmt: skip
    known = {(i.object, i.number): i.id for i in theirs.tracks.values()}
    return [(i.id, known[i.object, i.number]) for i in mine.tracks.values() if (i.object, i.number) in known]


def agreement(mine: Annotation, theirs: Annotation) -> dict[str, float]:
    """How far two annotators agree over the points both have.

    aj, delta, oa (TAP-Vid, mean of either one as truth), median_px and p90_px at 1080p where both see the point,
    states (share of frames with the same state), tracks, frames. Raises GenmojoError("empty") without a common track.
    """
    both = pairs(mine, theirs)
    if not both:
        raise GenmojoError("empty", "has no point in common with the first", "second annotation")
    a, b = mine.to_tracks([m for m, _ in both]), theirs.to_tracks([t for _, t in both])
    figures = {key: 0.5 * (one[key] + other[key]) for key in ("aj", "delta", "oa")
               for one, other in [(_figures(a, b), _figures(b, a))]}  # fmt: skip
    seen = a.visible & b.visible
    gap = np.linalg.norm(a.xy - b.xy, axis=-1)[seen] * (1080.0 / mine.size[1])
    known = (a.state != NONE) & (b.state != NONE)
    return figures | {
        "median_px": float(np.median(gap)) if len(gap) else float("nan"),
        "p90_px": float(np.quantile(gap, 0.9)) if len(gap) else float("nan"),
        "states": float((a.state == b.state)[known].mean()) if known.any() else float("nan"),
        "tracks": float(len(both)), "frames": float(known.sum()),
    }  # fmt: skip


def preview(base: Annotation | None, mine: Annotation, theirs: Annotation) -> list[MergeRun]:
    """What a merge would meet, by track and frame.

    Args:
        base: what both began from; without it every difference is a conflict, and what only one side knows is its own.
        mine, theirs: the two sides.
    """
    found = []
    unit = mine.size[1] / 1080.0
    bases = {} if base is None else dict(pairs(mine, base))
    for track, their in pairs(mine, theirs):
        a, b = mine.track(track), theirs.track(their)
        start = base.track(bases[track]) if base is not None and track in bases else None
        differs = _differs(a, b, SAME_PIXELS * unit)
        changed_a = _differs(a, start, 1e-3) if start is not None else a.state != NONE
        changed_b = _differs(b, start, 1e-3) if start is not None else b.state != NONE
        kind = np.where(~differs, 0, np.where(changed_a & changed_b, 3, np.where(changed_b, 2, 1)))
        edges = np.flatnonzero(np.diff(kind, prepend=-1, append=-1))
        for first, end in zip(edges[:-1], edges[1:], strict=True):
            if kind[first]:
                gap = np.linalg.norm(a.xy[first:end] - b.xy[first:end], axis=1)
                gap[(a.state[first:end] == NONE) | (b.state[first:end] == NONE)] = np.nan
                worst = float(np.nanmax(gap)) if np.isfinite(gap).any() else float("nan")
                name: Side = ("same", "mine", "theirs", "conflict")[kind[first]]  # type: ignore[assignment]
                found.append(MergeRun(track, their, int(first), int(end) - 1, name, worst))
    return found


def merge(mine: Annotation, theirs: Annotation, runs: list[MergeRun], choices: Mapping[int, Choice]) -> Edit:
    """One edit of mine that takes over what only they changed, and of conflicts what was chosen.

    Args:
        runs: of `preview`. choices: position in `runs` -> "mine", "theirs" or "middle"; conflicts that are not named
            stay mine.
    Locked tracks stay as they are.
    """
    taken: dict[int, Cells] = {}
    for number, run in enumerate(runs):
        choice: Choice = choices.get(number, "theirs" if run.kind == "theirs" else "mine")
        if choice == "mine" or mine.tracks[run.track].locked:
            continue
        cells = taken.setdefault(run.track, mine.track(run.track).copy())
        span = np.arange(run.first, run.last + 1)
        other = theirs.cells(run.their, span)
        middle = 0.5 * (cells.xy[span] + other.xy)
        for own, new in zip(cells.arrays(), other.arrays(), strict=True):
            own[span] = new
        if choice == "middle":
            both = (mine.track(run.track).state[span] != NONE) & (other.state != NONE)
            cells.xy[span[both]] = middle[both]
    frames = np.arange(mine.frames)
    changes = [cells_change(mine, track, frames, cells) for track, cells in taken.items()]
    made = tuple(c for c in changes if c is not None)
    where = (int(made[0].frames[0]), made[0].track) if made else (None, None)
    return Edit("merge", say("merge", count=len(made)), made, *where)


def _figures(predicted: PointTracks, truth: PointTracks) -> dict[str, float]:
    return track_metrics(predicted, truth)


def _differs(a: Cells, b: Cells, pixels: float) -> np.ndarray:  # (T,) bool
    """Where states differ, or places of points that both know are farther apart than that."""
    apart = np.linalg.norm(a.xy - b.xy, axis=1) > pixels
    matters = (a.state != NONE) & (b.state != NONE)
    hidden = (a.state != VISIBLE) & (b.state != VISIBLE)
    return (a.state != b.state) | (apart & matters & ~hidden)
