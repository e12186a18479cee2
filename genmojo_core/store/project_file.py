"""Reading, making, copying and checking project files; what `Project` does with the disk besides appending."""

from __future__ import annotations

import hashlib
import sqlite3
from collections.abc import Callable, Iterator, Sequence
from contextlib import closing
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Literal, TypeVar

import numpy as np

from genmojo_core.clip import digests
from genmojo_core.clip.clip import Clip
from genmojo_core.errors import GenmojoError
from genmojo_core.store.atomic import staged
from genmojo_core.store.edit_codec import decode_annotation, decode_edit, decode_proposal
from genmojo_core.store.project_db import Statement, check_file, connect, connect_to_read, make_tables
from genmojo_core.store.project_log import COLUMNS, ROOT, Log, Row
from genmojo_core.tracks.annotation import Annotation
from genmojo_core.tracks.edits import Edit

_KEEP = 10  # newest backup copies; beyond them one a day is kept for _DAYS days
_DAYS = 14


_Found = TypeVar("_Found")


@dataclass(frozen=True)
class ClipInfo:
    """The clip a project belongs to.

    name, path: of the clip. size: (width, height) of its source. frame_index (T,) numbers in the source, seconds (T,)
    time stamps, sha256: T digests of what is stored of each frame (`clip/digests.py`; empty strings where unknown), or
    none at all.
    """

    name: str
    path: str
    size: tuple[int, int]
    frame_index: np.ndarray
    seconds: np.ndarray
    sha256: tuple[str, ...] = ()

    @property
    def frames(self) -> int:
        """Number of frames T."""
        return len(self.frame_index)

    @staticmethod
    def of(clip: Clip) -> ClipInfo:
        """Of a clip that was read whole."""
        return ClipInfo(clip.name, clip.path, clip.source_size, clip.frame_index, clip.seconds)


def clip_doubt(one: ClipInfo, other: ClipInfo) -> Literal["", "pictures", "times", "name"]:
    """What speaks against two projects being of the same clip, by their frames' digests, time stamps and names."""
    changed, compared = digests.differing(one.sha256, other.sha256)
    if compared:
        return "pictures" if changed else ""
    if one.frames != other.frames or not np.allclose(one.seconds, other.seconds, atol=1e-3):
        return "times"
    return "" if one.name == other.name else "name"


@dataclass(frozen=True)
class Loaded:
    """A project as read; `snapshot` is the number of log rows its shortcut covered, `version` that of the file."""

    annotation: Annotation
    log: Log
    info: ClipInfo
    snapshot: int
    version: int


def create(path: Path, info: ClipInfo) -> None:
    """An empty project file, whole or not at all. Raises GenmojoError("io")."""
    with staged(path) as part, closing(connect(part)) as connection:
        connection.execute("PRAGMA journal_mode=DELETE")
        make_tables(connection)
        pairs = {"name": info.name, "path": info.path, "width": str(info.size[0]), "height": str(info.size[1])}
        digests = info.sha256 or ("",) * info.frames
        with connection:
            connection.execute("BEGIN")
            connection.executemany("INSERT INTO clip (key, value) VALUES (?, ?)", pairs.items())
            rows = [(i, int(n), float(s), d) for i, (n, s, d) in
                    enumerate(zip(info.frame_index, info.seconds, digests, strict=True))]  # fmt: skip
            connection.executemany("INSERT INTO frames VALUES (?, ?, ?, ?)", rows)


def load(path: Path) -> Loaded:
    """The newest state of a project. Raises GenmojoError: "io", "format", "version", "corrupt"."""
    return _read(path, lambda connection: _loaded(connection, path))


def clip_of(path: Path) -> ClipInfo:
    """The clip of a project, without its history. Raises as `load`."""
    return _read(path, _clip_info)


def _read(path: Path, read: Callable[[sqlite3.Connection], _Found]) -> _Found:
    if not path.is_file():
        raise GenmojoError("io", "does not exist or is no file", str(path), "check the name")
    with closing(connect_to_read(path)) as connection:
        check_file(connection, path)
        try:
            return read(connection)
        except (sqlite3.DatabaseError, KeyError, ValueError, TypeError) as error:
            raise GenmojoError("corrupt", "holds a history that does not fit together", str(path),
                               "open a backup copy") from error  # fmt: skip


@dataclass(frozen=True)
class Chain:
    """What checking the hashes of a project found: number of entries, those that do not continue the chain, numbers of
    entries that are missing, and numbers of entries after which another state was kept than they lead to."""

    entries: int
    broken: tuple[Row, ...]
    missing: tuple[int, ...]
    states: tuple[int, ...] = ()


def check_chain(path: Path) -> Chain:
    """Whether every entry of the log is as it was made and follows the one before, and whether the states that are kept
    as shortcuts are those that the entries lead to. Raises as `load`."""
    broken: list[Row] = []
    missing: list[int] = []
    count = 0
    with closing(connect_to_read(path)) as connection:
        check_file(connection, path)
        previous = b""
        for *columns, payload, stored in connection.execute(f"SELECT {COLUMNS}, payload, hash FROM edits ORDER BY seq"):
            row = Row(*columns)
            missing += range(count + 1, row.seq)
            if row.hash(payload, previous) != stored and row.seq == count + 1:
                broken.append(row)
            previous, count = stored, row.seq
        states = () if broken or missing else _other_states(connection)
    return Chain(count - len(missing), tuple(broken), tuple(missing), states)


def verify(path: Path) -> list[str]:
    """Faults of a project: rows whose hash does not continue the chain. Raises as `load`."""
    chain = check_chain(path)
    return [*(f"edit {number} is missing" for number in chain.missing),
            *(f"edit {row.seq} ({row.title}) was changed after it was made" for row in chain.broken),
            *(f"the state kept after edit {n} is not what the edits lead to" for n in chain.states)]  # fmt: skip


def edits(path: Path, rows: Sequence[Row]) -> dict[int, Edit]:
    """Data of some edits by sequence number."""
    with closing(connect_to_read(path)) as connection:
        return {row.seq: _edit(connection, row) for row in rows}


def blob(path: Path, name: str) -> bytes | None:
    """Bytes kept under a name."""
    with closing(connect_to_read(path)) as connection:
        found = connection.execute("SELECT data FROM blobs WHERE name = ?", (name,)).fetchone()
        return bytes(found[0]) if found else None


def row_statement(row: Row, payload: bytes, chain: bytes) -> Statement:
    """The statement that appends a row to the log."""
    values = (row.seq, row.parent, row.step, row.verb, row.kind, row.title, row.frame, row.track, row.who, row.at,
              row.version, payload, chain)  # fmt: skip
    return f"INSERT INTO edits ({COLUMNS}, payload, hash) VALUES ({', '.join('?' * 13)})", values


def snapshot_statements(rows: int, data: bytes, chain: bytes) -> list[Statement]:
    """Statements that store the annotation after so many rows, of which the last has the hash `chain`, and forget older
    ones but the last two. Its name has a hash of both, so that one that was changed is not believed."""
    name = f"snapshot:{rows}:{_snapshot_hash(chain, data)}"
    return [("INSERT OR REPLACE INTO blobs (name, seq, data) VALUES (?, ?, ?)", (name, rows, data)),
            ("DELETE FROM blobs WHERE name LIKE 'snapshot:%' AND seq NOT IN (SELECT seq FROM blobs WHERE name LIKE "
             "'snapshot:%' ORDER BY seq DESC LIMIT 3)", ())]  # fmt: skip


def copy(path: Path, target: Path, more: Sequence[Statement] = ()) -> None:
    """A consistent copy of a project that may be open, with further statements. Raises GenmojoError("io")."""
    with staged(target) as part:
        try:
            with closing(connect_to_read(path)) as source, closing(sqlite3.connect(part, isolation_level=None)) as made:
                source.backup(made)
                made.execute("PRAGMA journal_mode=DELETE")
                for sql, values in more:
                    made.execute(sql, values)
        except sqlite3.Error as error:
            raise GenmojoError("io", f"cannot be copied ({error})", str(path), "free some space") from error


def back_up(path: Path) -> Path:
    """A copy in the folder `<name>.backups`; old ones are thinned out. Returns it. Raises GenmojoError("io")."""
    folder = path.with_name(path.name + ".backups")
    made = folder / f"{datetime.now(UTC):%Y%m%dT%H%M%S%f}.genmojo"
    copy(path, made)
    kept_days: set[str] = set()
    for number, old in enumerate(backups(path)):
        day = old.stem[:8]
        if number >= _KEEP and (day in kept_days or len(kept_days) >= _DAYS):
            old.unlink(missing_ok=True)
        kept_days.add(day)
    return made


def backups(path: Path) -> list[Path]:
    """Backup copies of a project, newest first."""
    return sorted(path.with_name(path.name + ".backups").glob("*.genmojo"), reverse=True)


def _clip_info(connection: sqlite3.Connection) -> ClipInfo:
    about = dict(connection.execute("SELECT key, value FROM clip"))
    frames = connection.execute("SELECT number, seconds, sha256 FROM frames ORDER BY position").fetchall()
    return ClipInfo(about["name"], about["path"], (int(about["width"]), int(about["height"])),
                    np.array([f[0] for f in frames], np.int64), np.array([f[1] for f in frames], np.float64),
                    tuple(f[2] or "" for f in frames))  # fmt: skip


def _loaded(connection: sqlite3.Connection, path: Path) -> Loaded:
    info = _clip_info(connection)
    rows = [Row(*columns) for columns in connection.execute(f"SELECT {COLUMNS} FROM edits ORDER BY seq")]
    if [row.seq for row in rows] != list(range(1, len(rows) + 1)):
        raise GenmojoError("corrupt", "lacks rows of its history", str(path), "open a backup copy")
    annotation, covered = _newest_snapshot(connection, info, len(rows))
    log = Log()
    for row in rows:
        if row.seq > covered:
            _replay(connection, annotation, log, row)
        log.follow(row)
    last = connection.execute("SELECT hash FROM edits ORDER BY seq DESC LIMIT 1").fetchone()
    log.set_chain(last[0] if last else b"")
    _propose(connection, annotation)
    version = int(connection.execute("PRAGMA user_version").fetchone()[0])
    return Loaded(annotation, log, info, covered, version)


def read_proposals(path: Path, annotation: Annotation) -> None:
    """Give an annotation the proposals that a project keeps, and no others. Raises GenmojoError("io")."""
    try:
        with closing(connect_to_read(path)) as connection:
            annotation.proposals.clear()
            _propose(connection, annotation)
    except sqlite3.Error as error:
        raise GenmojoError("io", f"cannot be read ({error})", str(path), "open it again") from error


def _propose(connection: sqlite3.Connection, annotation: Annotation) -> None:
    """What trackers proposed for the tracks there are."""
    for name, data in connection.execute("SELECT name, data FROM blobs WHERE name LIKE 'proposal:%'"):
        track = int(name.split(":")[1])
        if track in annotation.tracks:
            annotation.propose(track, decode_proposal(data))


def _newest_snapshot(connection: sqlite3.Connection, info: ClipInfo, rows: int) -> tuple[Annotation, int]:
    """The annotation of the newest shortcut that can be believed, and how many rows it covers."""
    for covered, annotation in _snapshots(connection):
        if annotation is not None and covered <= rows:
            return annotation, covered
    return Annotation(info.frames, info.size), ROOT  # the whole history will do


def _snapshots(connection: sqlite3.Connection) -> Iterator[tuple[int, Annotation | None]]:
    """Shortcuts, newest first: rows covered and the annotation, None if it was changed or cannot be read."""
    found = connection.execute("SELECT name, blobs.seq, data, hash FROM blobs LEFT JOIN edits ON edits.seq = blobs.seq "
                               "WHERE name LIKE 'snapshot:%' ORDER BY blobs.seq DESC")  # fmt: skip
    for name, covered, data, chain in found:
        told = name.split(":")[2:]  # none in files of version 1
        try:
            true = not told or told[0] == _snapshot_hash(chain or b"", data)
            yield covered, decode_annotation(data) if true else None
        except GenmojoError:
            yield covered, None


def _snapshot_hash(chain: bytes, data: bytes) -> str:
    return hashlib.sha256(chain + data).hexdigest()


def _other_states(connection: sqlite3.Connection) -> tuple[int, ...]:
    """Rows after which a shortcut holds another annotation than all rows up to there lead to."""
    kept: dict[int, list[str]] = {}
    for covered, annotation in _snapshots(connection):
        kept.setdefault(covered, []).append("" if annotation is None else annotation.digest())
    info, log = _clip_info(connection), Log()
    annotation, wrong = Annotation(info.frames, info.size), []
    rows = [Row(*columns) for columns in connection.execute(f"SELECT {COLUMNS} FROM edits ORDER BY seq")]
    for row in rows[: max(kept, default=0)]:
        _replay(connection, annotation, log, row)
        log.follow(row)
        if any(digest != annotation.digest() for digest in kept.pop(row.seq, [])):
            wrong.append(row.seq)
    return (*wrong, *sorted(kept))


def _replay(connection: sqlite3.Connection, annotation: Annotation, log: Log, row: Row) -> None:
    """Do to the annotation what a row of the log did."""
    if row.verb == "do":
        _edit(connection, row).do(annotation)
    elif row.verb == "move":
        back, forth = log.path(row.parent)
        for seq in back:
            _edit(connection, log.edit(seq)).undo(annotation)
        for seq in forth:
            _edit(connection, log.edit(seq)).do(annotation)


def _edit(connection: sqlite3.Connection, row: Row) -> Edit:
    """The data of one edit."""
    found = connection.execute("SELECT payload FROM edits WHERE seq = ?", (row.seq,)).fetchone()
    if found is None:
        raise GenmojoError("corrupt", f"has no edit {row.seq}", "project", "open a backup copy")
    return decode_edit(found[0], row.kind, row.title, row.frame, row.track)
