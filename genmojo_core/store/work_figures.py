"""What a clip's annotation cost and how far it is: for the clip and for each person, from the project and its log.

    for row in figures(loaded.annotation, audit.entries(path), "clip"):
        row.person, row.seconds, row.keys, row.unknown

A key belongs to whoever placed or moved it last, the first placement of a point included.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any

import numpy as np

from genmojo_core.sentences import say
from genmojo_core.store import project_file
from genmojo_core.store.audit import Entry, write_table
from genmojo_core.store.time_sheet import time_sheet
from genmojo_core.tracks.annotation import CONFIRMED, KEY, UNCERTAIN, Annotation, TrackInfo
from genmojo_core.tracks.coverage import open_points
from genmojo_core.tracks.model import NONE, OCCLUDED, OUT_OF_VIEW, VISIBLE
from genmojo_core.tracks.review import SETTLED, closed

STRIDE = 2  # of every so many frames one is looked at, where the project says nothing else
STRIDE_BLOB = "stride"  # of the project
POINTS = 5  # of an object, where the project says nothing else
PACE_PLACES, PACE_SECONDS = 10, 30.0  # less work tells no pace
_TIMES = ("seconds", "seconds_per_track", "eta_seconds")


@dataclass(frozen=True)
class Figures:
    """Figures of a clip, or of one person's part in it (`person`; "" for the whole clip).

    seconds: at work, pauses trimmed. tracks: worked on. keys, confirmed: standing keys, standing places that are keys
    or were accepted. reopened: share (0..1) of reviewed tracks that went back. visible, occluded, out_of_view,
    uncertain: shares of what is annotated. left: places still to be looked at. eta_seconds: for them, at the pace so
    far (clip only). None where a figure is not known; `unknown` says why, sentences of `say`.
    """

    clip: str
    person: str
    seconds: float | None
    tracks: int
    keys: int
    keys_per_track: float | None
    seconds_per_track: float | None
    confirmed: int
    confirmed_share: float | None
    visible: float | None
    occluded: float | None
    out_of_view: float | None
    uncertain: float | None
    returned: int
    reopened: float | None
    left: int | None = None
    eta_seconds: float | None = None
    unknown: Mapping[str, str] = field(default_factory=dict)


def figures(annotation: Annotation, entries: Sequence[Entry], clip: str, stride: int = STRIDE) -> list[Figures]:
    """Of the whole clip first, then of each person who did something, by name. Tracks put aside do not count."""
    seconds = _seconds(entries)
    active = {info.id: info for info in annotation.active()}
    keyed, looked = _owners(entries, annotation, active)
    whole = _row(annotation, list(active.values()), (clip, ""), None if None in seconds.values() else
                 sum(s for s in seconds.values() if s), _count(annotation, list(active), KEY),
                 _count(annotation, list(active), KEY | CONFIRMED))  # fmt: skip
    rows = [_with_eta(whole, annotation, stride)]
    for who in sorted(seconds):
        mine = {track for (track, _), person in (*keyed.items(), *looked.items()) if person == who}
        infos = [info for info in active.values() if info.id in mine or (info.person == who and who)]
        rows.append(_row(annotation, infos, (clip, who), seconds[who], sum(p == who for p in keyed.values()),
                         sum(p == who for p in looked.values())))  # fmt: skip
    return rows


def stride_of(path: Path) -> int:
    """The stride that a project was left with; `STRIDE` where none was chosen."""
    kept = (project_file.blob(path, STRIDE_BLOB) or b"").decode("ascii", "replace")
    return int(kept) if kept.isdecimal() and int(kept) > 0 else STRIDE


def write(rows: Sequence[Figures], path: str | Path, consent: str) -> None:
    """Figures as CSV, those of several clips too. Unless consent is "yes", people and times are left out.

    Raises GenmojoError("io").
    """
    records = given(rows, consent)
    titles = [*(f.name for f in fields(Figures) if f.name != "unknown"), "not_known_yet"]
    write_table(path, titles, records)


def given(rows: Sequence[Figures], consent: str) -> list[dict[str, Any]]:
    """Figures as they may be given away: with people and times only if consent is "yes"."""
    records = []
    for row in rows if consent == "yes" else [r for r in rows if not r.person]:
        hidden = {} if consent == "yes" else dict.fromkeys(_TIMES)
        words = "; ".join(f"{name}: {why}" for name, why in row.unknown.items() if name not in hidden)
        record = {f.name: getattr(row, f.name) for f in fields(row) if f.name != "unknown"}
        records.append(record | hidden | {"not_known_yet": words})
    return records


def placed_keys(entries: Sequence[Entry]) -> dict[int, int]:
    """Keys that each line of the log placed or moved, by its number."""
    return {e.row.seq: len(e.words.placed) for e in entries}


def _seconds(entries: Sequence[Entry]) -> dict[str, float | None]:
    """Seconds at work per person; None where times were taken out of the project."""
    rows = [e.row for e in entries]
    found: dict[str, float | None] = {}
    for day in time_sheet(rows):
        found[day.person] = (found.get(day.person) or 0.0) + day.seconds
    dateless = {row.who for row in rows if len(row.at) <= 10}
    return {who: None if who in dateless else s for who, s in found.items()}


def _owners(
    entries: Sequence[Entry], annotation: Annotation, active: Mapping[int, TrackInfo]
) -> tuple[dict[tuple[int, int], str], dict[tuple[int, int], str]]:
    """Who placed each key, and who looked at each place last, of those that stand: (track, frame) -> person."""
    keyed: dict[tuple[int, int], str] = {}
    looked: dict[tuple[int, int], str] = {}
    for entry in entries:
        if entry.stands and entry.row.verb == "do":
            keyed |= dict.fromkeys(entry.words.placed, entry.row.who)
            looked |= dict.fromkeys((*entry.words.accepted, *entry.words.placed), entry.row.who)
    flags = {track: annotation.track(track).flags for track in active}

    def standing(found: dict[tuple[int, int], str], bits: int) -> dict[tuple[int, int], str]:
        return {(track, t): who for (track, t), who in found.items() if track in flags and flags[track][t] & bits}

    return standing(keyed, KEY), standing(looked, KEY | CONFIRMED)


def _count(annotation: Annotation, tracks: list[int], bits: int) -> int:
    return sum(int((annotation.track(track).flags & bits > 0).sum()) for track in tracks)


def _row(annotation: Annotation, infos: list[TrackInfo], place: tuple[str, str], seconds: float | None, keys: int,
         confirmed: int) -> Figures:  # fmt: skip
    """Figures of some tracks; what nothing tells is None, with the reason."""
    unknown: dict[str, str] = {}
    count, total = len(infos), len(infos) * annotation.frames
    if seconds is None:
        unknown |= {"seconds": say("figure_no_times"), "seconds_per_track": say("figure_no_times")}
    if not count:
        unknown |= dict.fromkeys(("keys_per_track", "confirmed_share"), say("figure_no_track"))
        unknown.setdefault("seconds_per_track", say("figure_no_track"))
    state = np.concatenate([annotation.track(i.id).state for i in infos] or [np.zeros(0, np.uint8)])
    flags = np.concatenate([annotation.track(i.id).flags for i in infos] or [np.zeros(0, np.uint8)])
    known = int((state != NONE).sum())
    names = ("visible", "occluded", "out_of_view")
    shares: dict[str, float | None] = dict.fromkeys((*names, "uncertain"))
    if known:
        shares = {n: float((state == s).sum()) / known for n, s in zip(names, (VISIBLE, OCCLUDED, OUT_OF_VIEW),
                                                                       strict=True)}  # fmt: skip
        shares["uncertain"] = float(((flags & UNCERTAIN > 0) & (state != NONE)).sum()) / known
    else:
        unknown |= dict.fromkeys(shares, say("figure_empty" if count else "figure_no_track"))
    returned = sum(i.rounds > 0 for i in infos)
    reviewed = sum(i.rounds > 0 or i.review in ("approved", "rejected", "needs_fix", "fixed") for i in infos)
    if not reviewed:
        unknown["reopened"] = say("figure_no_review" if count else "figure_no_track")
    return Figures(*place, seconds, count, keys, keys / count if count else None,
                   seconds / count if count and seconds is not None else None, confirmed,
                   confirmed / total if total else None, shares["visible"], shares["occluded"],
                   shares["out_of_view"], shares["uncertain"], returned,
                   returned / reviewed if reviewed else None, unknown=unknown)  # fmt: skip


def _with_eta(row: Figures, annotation: Annotation, stride: int) -> Figures:
    """The clip's figures with what is left in the frames of the stride and how long that takes at the pace so far.

    Points that objects may have beside those they have are left, too, until every track is decided.
    """
    frames = np.arange(0, annotation.frames, max(stride, 1))
    most = int(annotation.meta.get("limit_points", POINTS))
    infos = annotation.active()
    undecided = [i.id for i in infos if i.review not in SETTLED]
    left = int(open_points(annotation, undecided, frames).sum())
    for owner in annotation.chosen_objects() if not closed(annotation) else ():
        left += max(most - sum(i.object == owner.id for i in infos), 0) * len(frames)
    unknown, eta = dict(row.unknown), None
    if row.seconds is None:
        unknown["eta_seconds"] = say("figure_no_times")
    elif not infos:
        unknown["eta_seconds"] = say("figure_no_track")
    elif not left:
        eta = 0.0
    elif row.confirmed < PACE_PLACES or row.seconds < PACE_SECONDS:
        unknown["eta_seconds"] = say("figure_pace", count=PACE_PLACES, seconds=int(PACE_SECONDS))
    else:
        eta = row.seconds * left / row.confirmed
    values = {f.name: getattr(row, f.name) for f in fields(row)}
    return Figures(**values | {"left": left, "eta_seconds": eta, "unknown": unknown})
