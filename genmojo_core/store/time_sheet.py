"""Who worked how long on a project: from its log, pauses left out; and copies of projects without names.

Times and names are data about people: they are exported only where the project's note `consent` is "yes".
"""

from __future__ import annotations

import sqlite3
from collections.abc import Mapping, Sequence
from contextlib import closing
from dataclasses import asdict, dataclass
from datetime import datetime
from pathlib import Path

from genmojo_core.errors import GenmojoError
from genmojo_core.store import project_file
from genmojo_core.store.audit import local, write_table
from genmojo_core.store.edit_codec import decode_edit, encode_edit
from genmojo_core.store.nameless import Nameless, people_of
from genmojo_core.store.project_db import RAISE_VERSION
from genmojo_core.store.project_log import COLUMNS, Row
from genmojo_core.store.safe import json_text
from genmojo_core.tracks.edits import Edit

IDLE_SECONDS = 60.0  # a pause longer than this is no work; what came before it counts that long


@dataclass(frozen=True)
class WorkDay:
    """A person's work on one day of this machine's zone: seconds, edits, keys placed, undone steps, tracks touched."""

    person: str
    day: str
    seconds: float
    edits: int
    keys: int
    undone: int
    tracks: int


def time_sheet(rows: Sequence[Row], idle: float = IDLE_SECONDS, keys: Mapping[int, int] | None = None) -> list[WorkDay]:
    """Work per person and day, oldest first. What machines add within a step counts as the person's.

    Args:
        idle: longest pause, seconds, that counts as work. keys: placed by each line, by its number
            (`work_figures.placed_keys`); without it lines that only placed a key count, first placements do not.
    """
    groups: dict[tuple[str, str], list[Row]] = {}
    for row in rows:
        groups.setdefault((row.who, local(row.at)[:10]), []).append(row)
    sheet = []
    for (who, day), mine in sorted(groups.items(), key=lambda g: (g[0][1], g[0][0])):
        stamps = [datetime.fromisoformat(row.at).timestamp() for row in mine]
        gaps = [max(later - earlier, 0.0) for earlier, later in zip(stamps[:-1], stamps[1:], strict=True)]
        seconds = sum(min(gap, idle) for gap in gaps) + min(idle, 5.0)
        placed = sum(r.kind == "key" if keys is None else keys.get(r.seq, 0) for r in mine)
        sheet.append(WorkDay(who, day, seconds, sum(r.verb == "do" for r in mine), placed,
                             sum(r.kind == "undo" for r in mine),
                             len({r.track for r in mine if r.track is not None})))  # fmt: skip
    return sheet


def write_time_sheet(rows: Sequence[Row], consent: str, path: str | Path, clip: str = "",
                     keys: Mapping[int, int] | None = None) -> None:  # fmt: skip
    """The time sheet as csv, with the clip's name in a column; `keys` as for `time_sheet`.

    Raises GenmojoError("argument") without consent, "io".
    """
    if consent != "yes":
        raise GenmojoError("argument", "has no consent to export times of people", str(path),
                           "ask them and set the consent flag")  # fmt: skip
    days = time_sheet(rows, keys=keys)
    write_table(path, ["clip", *WorkDay.__dataclass_fields__], [{"clip": clip} | asdict(day) for day in days])


def without_people(path: str | Path, target: str | Path) -> None:
    """A copy of a project in which no person is named, no time of day stands and no path (it may hold an account's
    name); its chain of hashes is made anew. Notes and names of moments stay, without the names of who worked on it.

    Raises GenmojoError("io", "format", "corrupt").
    """
    project_file.copy(Path(path), Path(target))
    loaded = project_file.load(Path(target))
    with closing(sqlite3.connect(target, isolation_level=None)) as connection:
        connection.execute("BEGIN IMMEDIATE")
        connection.execute(*RAISE_VERSION)
        found = connection.execute(f"SELECT {COLUMNS}, payload FROM edits ORDER BY seq").fetchall()
        rows = [(row := Row(*columns), payload, _edit_of(row, payload)) for *columns, payload in found]
        nameless = Nameless(name for row, _, edit in rows for name in people_of(row, edit))
        chain = b""
        for row, payload, edit in rows:
            bare, clean = nameless.row(row), payload if edit is None else encode_edit(nameless.edit(edit))
            chain = bare.hash(clean, chain)
            connection.execute("UPDATE edits SET who = '', at = ?, title = ?, payload = ?, hash = ? WHERE seq = ?",
                               (bare.at, bare.title, clean, chain, bare.seq))  # fmt: skip
        connection.execute("DELETE FROM blobs WHERE name LIKE 'snapshot:%'")
        tracks = [nameless.track(info) for info in loaded.annotation.tracks.values()]
        objects = [nameless.object(info) for info in loaded.annotation.objects.values()]
        for table, infos in (("tracks", tracks), ("objects", objects)):
            connection.execute(f"DELETE FROM {table}")
            connection.executemany(f"INSERT INTO {table} (id, data) VALUES (?, ?)",
                                   [(info.id, json_text(asdict(info))) for info in infos])  # fmt: skip
        connection.execute("UPDATE clip SET value = ? WHERE key = 'path'", (Path(loaded.info.path).name,))
        connection.execute("COMMIT")
        connection.execute("VACUUM")


def _edit_of(row: Row, payload: bytes) -> Edit | None:
    """What a line of the log did, None where it moved or named something."""
    return decode_edit(payload, row.kind, row.title, row.frame, row.track) if row.verb == "do" else None
