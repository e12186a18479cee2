"""What the log of a project tells about the work: counts, effort, who did what when. No Qt.

Effort is the time between a person's consecutive edits, pauses cut at `IDLE` seconds. It belongs to the people who did
the work: it is exported only with their consent, which stands in the project's notes.
"""

from __future__ import annotations

import csv
import io
from dataclasses import dataclass
from datetime import datetime

import numpy as np

from genmojo_core.store.project_log import Row
from genmojo_core.tracks.annotation import CONFIRMED, KEY, Annotation

IDLE = 60.0  # seconds after which a pause is no work


@dataclass(frozen=True)
class Sheet:
    """One person's share: edits, seconds of effort, keys placed, tracks sent back to them."""

    person: str
    edits: int
    seconds: float
    keys: int
    returned: int


def sheets(rows: list[Row], annotation: Annotation) -> list[Sheet]:
    """Effort per person, most first. Edits of machines count for the person whose step they answered."""
    people: dict[str, list[Row]] = {}
    for row in rows:
        people.setdefault(row.who or "?", []).append(row)
    found = []
    for person, own in people.items():
        times = np.array([datetime.fromisoformat(row.at).timestamp() for row in own])
        seconds = float(np.minimum(np.diff(np.sort(times)), IDLE).sum()) if len(times) > 1 else 0.0
        returned = sum(i.rounds for i in annotation.tracks.values() if i.person == person)
        found.append(Sheet(person, len(own), seconds, sum(row.kind == "key" for row in own), returned))
    return sorted(found, key=lambda sheet: -sheet.seconds)


def figures(annotation: Annotation, stride: int) -> list[tuple[str, str]]:
    """Counts of the whole clip, as (what, how much) for people."""
    tracks = list(annotation.tracks)
    if not tracks:
        return [("tracks", "0")]
    cells = [annotation.track(t) for t in tracks]
    state = np.stack([c.state for c in cells])
    keys = np.array([(c.flags & KEY > 0).sum() for c in cells])
    settled = np.stack([(c.flags & (KEY | CONFIRMED)) > 0 for c in cells])[:, ::stride]
    reviews = [annotation.tracks[t].review for t in tracks]
    total = max(int((state > 0).sum()), 1)
    return [("tracks", str(len(tracks))), ("keys per track (median)", f"{np.median(keys):g}"),
             ("keys per track (most)", str(int(keys.max()))),
             ("frames of the stride accepted", f"{settled.mean():.0%}"),
             ("visible", f"{(state == 1).sum() / total:.0%}"), ("occluded", f"{(state == 2).sum() / total:.0%}"),
             ("out of view", f"{(state == 3).sum() / total:.0%}"), ("approved", str(reviews.count("approved"))),
             ("sent back (rounds)", str(sum(annotation.tracks[t].rounds for t in tracks)))]  # fmt: skip


def log_csv(rows: list[Row], *, with_effort: bool) -> str:
    """The audit log as CSV; without consent the times and names of people are left out."""
    stream = io.StringIO()
    writer = csv.writer(stream)
    writer.writerow(["number", "what", "kind", "frame", "track", *(["who", "when"] if with_effort else [])])
    for row in rows:
        extra = [row.who, row.at] if with_effort else []
        writer.writerow([row.seq, row.title, f"{row.verb}:{row.kind}", row.frame, row.track, *extra])
    return stream.getvalue()
