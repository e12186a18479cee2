"""What another program that has a project open did to it: read beside it, for a project that is read only here."""

from __future__ import annotations

import sqlite3
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

from genmojo_core.errors import GenmojoError
from genmojo_core.store.edit_codec import decode_edit, decode_proposal
from genmojo_core.store.project_db import connect_to_read
from genmojo_core.store.project_log import COLUMNS, Row
from genmojo_core.tracks.annotation import Proposal
from genmojo_core.tracks.edits import Edit


@dataclass(frozen=True)
class News:
    """Rows that are new, data of those that are edits, the hash of the last, proposals (track, proposal) since."""

    rows: list[Row]
    edits: dict[int, Edit]
    chain: bytes
    proposals: list[tuple[int, Proposal]]


def stamp(path: Path) -> tuple[tuple[int, int], ...]:
    """Changes whenever something was written: times and sizes of the file and of its write-ahead log."""
    found = []
    for file in (path, path.with_name(path.name + "-wal")):
        try:
            about = file.stat()
            found.append((about.st_mtime_ns, about.st_size))
        except OSError:
            found.append((0, 0))
    return tuple(found)


def read(path: Path, known: int, chain: bytes) -> News | None:
    """What is new after `known` rows, of which the last has the hash `chain`; None if nothing is. For any thread.

    Raises GenmojoError: "io" cannot be read, "corrupt" another history lies there by now.
    """
    try:
        with closing(connect_to_read(path)) as connection:
            connection.execute("BEGIN")  # rows and proposals of one moment
            last = connection.execute("SELECT hash FROM edits WHERE seq = ?", (known,)).fetchone()
            if known and (last is None or bytes(last[0]) != chain):
                raise GenmojoError("corrupt", "holds another history by now", str(path), "open it again")
            found = connection.execute(f"SELECT {COLUMNS}, payload, hash FROM edits WHERE seq > ? ORDER BY seq",
                                       (known,)).fetchall()  # fmt: skip
            if not found:
                return None
            proposals = connection.execute("SELECT name, data FROM blobs WHERE name LIKE 'proposal:%' AND seq >= ?",
                                           (known,)).fetchall()  # fmt: skip
    except sqlite3.Error as error:
        raise GenmojoError("io", f"cannot be read ({error})", str(path), "open it again") from error
    rows, edits, newest = [], {}, chain
    for *columns, payload, hash_ in found:
        row = Row(*columns)
        rows.append(row)
        newest = bytes(hash_)
        if row.verb == "do":
            edits[row.seq] = decode_edit(payload, row.kind, row.title, row.frame, row.track)
    return News(rows, edits, newest, [(int(name.split(":")[1]), decode_proposal(data)) for name, data in proposals])
