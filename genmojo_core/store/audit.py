"""The history of a project for people: who did what to which point, what stood before and after, and whether it stands.

    for entry in audit.entries(Path("clip.genmojo")):
        entry.row.who, entry.row.title, entry.before, entry.after, entry.stands

Words are English sentences of `sentences.say`; the app translates each.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any

import numpy as np

from genmojo_core.errors import GenmojoError
from genmojo_core.store.atomic import write_bytes
from genmojo_core.store.edit_codec import decode_edit
from genmojo_core.store.edit_words import Known, Words, words_of
from genmojo_core.store.nameless import Nameless, people_of
from genmojo_core.store.project_db import check_file, connect_to_read
from genmojo_core.store.project_log import COLUMNS, Log, Row
from genmojo_core.store.safe import json_text
from genmojo_core.tracks.edits import Edit

FIELDS = ("clip", "seq", "at", "who", "verb", "what", "stands", "tracks", "points", "first_frame", "last_frame",
          "frames", "before", "after", "moved_px", "keys_before", "keys_after", "version", "hash")  # fmt: skip


@dataclass(frozen=True)
class Entry:
    """One line of the log.

    row: what the project holds. words: what it did, in words and figures. stands: False for an edit that was undone.
    hash: its link of the chain, in hexadecimal. people: who is named by it.
    """

    row: Row
    words: Words
    stands: bool
    hash: str
    people: frozenset[str] = frozenset()

    def touches(self, track: int) -> bool:
        """Whether it changed that track."""
        return track == self.row.track or any(point.track == track for point in self.words.points)


def entries(path: Path) -> list[Entry]:
    """Every line of a project's log, oldest first. Raises GenmojoError: "io", "format", "version", "corrupt"."""
    if not path.is_file():
        raise GenmojoError("io", "does not exist or is no file", str(path), "check the name")
    read: list[tuple[Row, Words, str, frozenset[str]]] = []
    log, known = Log(), Known()
    with closing(connect_to_read(path)) as connection:
        check_file(connection, path)
        for *columns, payload, link in connection.execute(f"SELECT {COLUMNS}, payload, hash FROM edits ORDER BY seq"):
            row, edit, words = Row(*columns), None, Words()
            if row.verb == "do":
                edit = decode_edit(payload, row.kind, row.title, row.frame, row.track)
                known.do(row.seq, edit)
                words = words_of(edit, known)
            elif row.verb == "move":
                known.move(*log.path(row.parent))
                words = words_of(Edit(row.kind, row.title, (), row.frame, row.track), known)
            log.follow(row)
            read.append((row, words, bytes(link).hex(), frozenset(people_of(row, edit))))
    standing = {row.seq for row in log.standing()}
    return [Entry(row, words, row.verb != "do" or row.seq in standing, link, people)
            for row, words, link, people in read]  # fmt: skip


def write(found: Sequence[Entry], path: str | Path, clip: str, consent: str, people: Iterable[str] = ()) -> None:
    """Write the log as JSON where the path ends so, else as CSV.

    Args:
        clip: its name, a column. consent: note of the project; unless it is "yes", people are numbered and times of day
            and hashes are left out. people: named by lines that are not written; notes may name them.
    Raises GenmojoError("io").
    """
    rows = [_record(entry, clip) for entry in found]
    if consent != "yes":
        number = {name: f"person {n + 1}" for n, name in enumerate(dict.fromkeys(r["who"] for r in rows))}
        bare = Nameless({*people, *(name for entry in found for name in entry.people)})
        rows = [r | {"who": number[r["who"]], "at": r["at"][:10], "hash": "", "before": bare.sentences(r["before"]),
                     "after": bare.sentences(r["after"]), "what": bare.title(r["verb"], r["what"])}
                for r in rows]  # fmt: skip
    if str(path).lower().endswith(".json"):
        write_bytes(path, json_text({"clip": clip, "log": rows}).encode())
        return
    write_table(path, FIELDS, rows)


def write_table(path: str | Path, titles: Sequence[str], rows: Iterable[Mapping[str, object]]) -> None:
    """Rows with these titles as CSV, in which nothing is a formula. Raises GenmojoError("io")."""
    out = io.StringIO()
    writer = csv.DictWriter(out, titles, lineterminator="\n")
    writer.writeheader()
    writer.writerows({name: _cell(value) for name, value in row.items()} for row in rows)
    write_bytes(path, out.getvalue().encode("utf-8-sig"))  # spreadsheets tell UTF-8 by its mark


def local(at: str) -> str:
    """A time of the log in this machine's zone, with the zone: "2026-01-05 11:00:00 +01:00"; days stay days."""
    if len(at) <= 10:
        return at
    text = datetime.fromisoformat(at).astimezone().isoformat(" ", "seconds")
    return f"{text[:19]} {text[19:]}"


def _record(entry: Entry, clip: str) -> dict[str, Any]:
    row, words = entry.row, entry.words
    return {
        "clip": clip, "seq": row.seq, "at": row.at, "who": row.who,
        "verb": row.kind if row.verb == "move" else row.verb, "what": row.title, "stands": entry.stands,
        "tracks": [p.track for p in words.points if p.track is not None],
        "points": [p.title() for p in words.points],
        "first_frame": words.first, "last_frame": words.last, "frames": words.frames,
        "before": list(words.before), "after": list(words.after),
        "moved_px": None if not np.isfinite(words.moved) else round(words.moved, 3),
        "keys_before": words.keys[0], "keys_after": words.keys[1], "version": row.version, "hash": entry.hash,
    }  # fmt: skip


def _cell(value: object) -> object:
    """A value in a table: lists in one cell, truths in words, what a spreadsheet might run as text."""
    if isinstance(value, list):
        value = "; ".join(map(str, value))
    if isinstance(value, bool):
        return "yes" if value else "no"
    return f"'{value}" if isinstance(value, str) and value[:1] in ("=", "+", "-", "@") else value
