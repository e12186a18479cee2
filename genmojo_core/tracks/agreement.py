"""Two annotators of one clip: which points both have, and how far they agree."""

from __future__ import annotations

import numpy as np

from genmojo_core.errors import GenmojoError
from genmojo_core.tracks.annotation import Annotation
from genmojo_core.tracks.metrics import track_metrics
from genmojo_core.tracks.model import NONE


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
    states (share of frames with the same state), tracks, frames. A figure that nothing tells is NaN: scores need a
    frame after the one in which a point is first seen. Raises GenmojoError("empty") without a common track.
    """
    both = pairs(mine, theirs)
    if not both:
        raise GenmojoError("empty", "has no point in common with the first", "second annotation")
    a, b = mine.to_tracks([m for m, _ in both]), theirs.to_tracks([t for _, t in both])
    sides = track_metrics(a, b), track_metrics(b, a)
    figures = {key: 0.5 * sum(side.get(key, float("nan")) for side in sides) for key in ("aj", "delta", "oa")}
    seen = a.visible & b.visible
    gap = np.linalg.norm(a.xy - b.xy, axis=-1)[seen] * (1080.0 / mine.size[1])
    known = (a.state != NONE) & (b.state != NONE)
    return figures | {
        "median_px": float(np.median(gap)) if len(gap) else float("nan"),
        "p90_px": float(np.quantile(gap, 0.9)) if len(gap) else float("nan"),
        "states": float((a.state == b.state)[known].mean()) if known.any() else float("nan"),
        "tracks": float(len(both)), "frames": float(known.sum()),
    }  # fmt: skip
