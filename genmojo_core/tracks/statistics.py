"""How far an annotation is and what it cost: per clip, per track and per person."""

from __future__ import annotations

from typing import Any

import numpy as np

from genmojo_core.tracks.annotation import CONFIRMED, KEY, UNCERTAIN, Annotation
from genmojo_core.tracks.model import NONE, OCCLUDED, OUT_OF_VIEW, VISIBLE


def track_figures(annotation: Annotation, track: int) -> dict[str, float]:
    """Shares (0..1) of frames by what is known of them; number of keys; how often a reviewer returned the track."""
    cells = annotation.track(track)
    flags, state = cells.flags, cells.state
    known = max(int((state != NONE).sum()), 1)
    return {
        "annotated": float((state != NONE).mean()), "confirmed": float(((flags & (KEY | CONFIRMED)) > 0).mean()),
        "keys": float(((flags & KEY) > 0).sum()), "visible": float((state == VISIBLE).sum()) / known,
        "occluded": float((state == OCCLUDED).sum()) / known,
        "out_of_view": float((state == OUT_OF_VIEW).sum()) / known,
        "uncertain": float(((flags & UNCERTAIN) > 0).mean()), "rounds": float(annotation.tracks[track].rounds),
    }  # fmt: skip


def clip_figures(annotation: Annotation) -> dict[str, Any]:
    """The same over all tracks (means), counts of review states, points per object, motion of visible points.

    motion is the mean step between consecutive visible frames in pixels of a 256 x 256 picture.
    """
    rows = [track_figures(annotation, info.id) for info in annotation.active()]
    means = {key: float(np.mean([r[key] for r in rows])) for key in rows[0]} if rows else {}
    reviews: dict[str, int] = {}
    people: dict[str, int] = {}
    for info in annotation.active():
        reviews[info.review] = reviews.get(info.review, 0) + 1
        people[info.person] = people.get(info.person, 0) + 1
    returned = sum(info.rounds > 0 for info in annotation.active())
    return {"objects": len(annotation.chosen_objects()), "tracks": len(rows), "frames": annotation.frames, **means,
            "motion": _motion(annotation), "reviews": reviews, "people": people,
            "reopened": returned / max(len(rows), 1), "consent": annotation.meta.get("consent", "")}  # fmt: skip


def _motion(annotation: Annotation) -> float:
    steps = []
    scale = 256.0 / np.array(annotation.size)
    for info in annotation.active():
        cells = annotation.track(info.id)
        both = (cells.state[1:] == VISIBLE) & (cells.state[:-1] == VISIBLE)
        steps.extend(np.linalg.norm(np.diff(cells.xy, axis=0)[both] * scale, axis=1).tolist())
    return float(np.mean(steps)) if steps else 0.0
