"""The SQLite file of a project: its tables, its lock, and the thread that writes to it.

WAL with synchronous=FULL: what was acknowledged survives the process and the power. WAL needs one host, so projects
on network paths use the rollback journal. Table `edits` only grows.
"""

from __future__ import annotations

import os
import queue
import socket
import sqlite3
import threading
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

from genmojo_core.errors import GenmojoError
from genmojo_core.store.safe import json_text, parse_json

VERSION = 2  # 2: a reviewer's note beside the annotator's, edits that carry proposals, sources of proposals
_APPLICATION = 0x474D4A4F  # "GMJO"
_TABLES = """
CREATE TABLE clip (key TEXT PRIMARY KEY, value TEXT NOT NULL);
CREATE TABLE frames (position INTEGER PRIMARY KEY, number INTEGER NOT NULL, seconds REAL NOT NULL, sha256 TEXT);
CREATE TABLE objects (id INTEGER PRIMARY KEY, data TEXT NOT NULL);
CREATE TABLE tracks (id INTEGER PRIMARY KEY, data TEXT NOT NULL);
CREATE TABLE edits (seq INTEGER PRIMARY KEY, parent INTEGER NOT NULL, step INTEGER NOT NULL, verb TEXT NOT NULL,
  kind TEXT NOT NULL, title TEXT NOT NULL, frame INTEGER, track INTEGER, who TEXT NOT NULL, at TEXT NOT NULL,
  version TEXT NOT NULL, payload BLOB NOT NULL, hash BLOB NOT NULL);
CREATE TABLE blobs (name TEXT PRIMARY KEY, seq INTEGER NOT NULL, data BLOB NOT NULL);
"""
_REMOTE = ("nfs", "nfs4", "cifs", "smb", "smb2", "smb3", "smbfs", "fuse.sshfs", "afs", "9p", "ceph", "glusterfs")
Statement = tuple[str, Sequence[Any]]
RAISE_VERSION: Statement = (f"PRAGMA user_version={VERSION}", ())  # before what older programs would read wrongly


@dataclass
class _Job:
    """Statements of one transaction and who wants to know that they are durable."""

    statements: list[Statement]
    done: Callable[[], None] | None


class Writer:
    """The only connection that writes. Transactions wait in a queue; those that wait together are committed together.

    Args:
        path: project file, made if it does not exist.
        failed: called in the writing thread with a GenmojoError when a commit fails; the work stays queued and is
            tried again with the next one.
    """

    def __init__(self, path: Path, failed: Callable[[GenmojoError], None] | None = None) -> None:
        self._path = path
        self._failed = failed
        self._jobs: queue.SimpleQueue[_Job | None] = queue.SimpleQueue()
        self._unsaved: list[_Job] = []
        self._idle = threading.Condition()
        self._waiting = 0
        self._thread = threading.Thread(target=self._run, name="project writer", daemon=True)
        self._thread.start()

    def put(self, statements: list[Statement], done: Callable[[], None] | None = None) -> None:
        """Queue one transaction; `done` is called in the writing thread once it is on the disk."""
        with self._idle:
            self._waiting += 1
        self._jobs.put(_Job(statements, done))

    def wait(self, seconds: float | None = None) -> bool:
        """Until everything queued is durable; False if that took too long or cannot be written."""
        with self._idle:
            tried = self._idle.wait_for(lambda: self._waiting == len(self._unsaved), seconds)
            return tried and not self._unsaved

    def unsaved(self) -> list[Statement]:
        """Statements that could not be written so far."""
        return [statement for job in tuple(self._unsaved) for statement in job.statements]

    def failing(self) -> int:
        """How many transactions could not be written so far."""
        return len(self._unsaved)

    def close(self) -> None:
        """Write what waits, also what could not be written before, and stop."""
        self.put([])
        self._jobs.put(None)
        self._thread.join()

    def _run(self) -> None:
        connection = connect(self._path)
        try:
            while (job := self._jobs.get()) is not None:
                jobs, more = [*self._unsaved, job], True
                while more and not self._jobs.empty():
                    following = self._jobs.get()
                    more = following is not None
                    jobs.extend([following] if following is not None else [])
                self._commit(connection, jobs)
                if not more:
                    break
        finally:
            _leave_one_file(connection)
            connection.close()

    def _commit(self, connection: sqlite3.Connection, jobs: list[_Job]) -> None:
        try:
            with connection:
                connection.execute("BEGIN IMMEDIATE")
                for job in jobs:
                    for sql, values in job.statements:
                        connection.execute(sql, values)
        except sqlite3.Error as error:
            kept = [job for job in jobs if job.statements]  # an attempt with nothing of its own leaves nothing behind
            with self._idle:
                self._waiting -= len(jobs) - len(kept)
                self._unsaved = kept
                self._idle.notify_all()
            self._tell(error)
            return
        with self._idle:
            self._unsaved = []
            self._waiting -= len(jobs)
            self._idle.notify_all()
        for job in jobs:
            if job.done is not None:
                job.done()

    def _tell(self, error: sqlite3.Error) -> None:
        if self._failed is not None:
            self._failed(GenmojoError("io", f"cannot be saved ({error})", str(self._path),
                                      "free some space or save a copy elsewhere"))  # fmt: skip


def connect(path: Path) -> sqlite3.Connection:
    """A connection for writing, with the durability a project needs. Raises GenmojoError("format")."""
    try:
        connection = sqlite3.connect(path, isolation_level=None, check_same_thread=False)
        connection.execute(f"PRAGMA journal_mode={'DELETE' if is_remote(path) else 'WAL'}")
        connection.execute("PRAGMA synchronous=FULL")
        connection.execute("PRAGMA busy_timeout=5000")
        connection.execute("PRAGMA trusted_schema=OFF")
        return connection
    except sqlite3.DatabaseError as error:
        raise GenmojoError("format", f"is no project file or cannot be opened ({error})", str(path)) from error


def connect_to_read(path: Path) -> sqlite3.Connection:
    """A connection for reading, which leaves the file as it is but for what a dead program left to be replayed.

    Raises GenmojoError("io") if it cannot be opened.
    """
    options = "mode=rw"
    if not os.access(path.parent, os.W_OK):
        pending = path.with_name(path.name + "-wal").exists()
        options = "mode=ro" if pending else "mode=ro&immutable=1"  # WAL needs a folder that can be written to
    try:
        connection = sqlite3.connect(f"{path.absolute().as_uri()}?{options}", uri=True, isolation_level=None,
                                     check_same_thread=False)  # fmt: skip
        connection.execute("PRAGMA busy_timeout=5000")
        connection.execute("PRAGMA trusted_schema=OFF")
        return connection
    except sqlite3.Error as error:
        raise GenmojoError("io", f"cannot be opened ({error})", str(path), "check the permissions") from error


def make_tables(connection: sqlite3.Connection) -> None:
    """The tables of an empty project."""
    connection.executescript(f"BEGIN; {_TABLES} PRAGMA application_id={_APPLICATION}; PRAGMA user_version={VERSION};"
                             " COMMIT;")  # fmt: skip


def check_file(connection: sqlite3.Connection, path: Path) -> None:
    """Raise GenmojoError unless it is a sound project of a version we know ("format", "version", "corrupt")."""
    try:
        application = connection.execute("PRAGMA application_id").fetchone()[0]
        version = connection.execute("PRAGMA user_version").fetchone()[0]
        sound = connection.execute("PRAGMA quick_check(1)").fetchone()[0] == "ok"
    except sqlite3.DatabaseError as error:
        raise GenmojoError("format", "is no project file or is damaged", str(path), "open a backup copy") from error
    if application != _APPLICATION:
        raise GenmojoError("format", "is no GenMOJO project", str(path), "give a file written by the annotator")
    if version > VERSION:
        raise GenmojoError("version", f"is of version {version}, this program knows up to {VERSION}", str(path),
                           "open it with a newer version")  # fmt: skip
    if not sound:
        raise GenmojoError("corrupt", "is damaged", str(path), "open a backup copy")


def is_remote(path: Path) -> bool:
    """Whether a path lies on a network file system, as far as the system tells."""
    text = str(path.absolute())
    if text.startswith(("\\\\", "//")):
        return True
    mounts = Path("/proc/self/mounts")
    if not mounts.exists():
        return False
    found = [line.split()[1:3] for line in mounts.read_text(errors="replace").splitlines() if len(line.split()) > 2]
    over = [(len(place), kind) for place, kind in found if text == place or text.startswith(place.rstrip("/") + "/")]
    return max(over, default=(0, ""))[1] in _REMOTE


def _leave_one_file(connection: sqlite3.Connection) -> None:
    """Fold the write-ahead log into the file, so that it may be copied or put where nobody can write.

    Another program that reads just now prevents it; then the log stays beside the file, which is sound too.
    """
    with suppress(sqlite3.Error):
        connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")
        connection.execute("PRAGMA journal_mode=DELETE")


@dataclass(frozen=True)
class Holder:
    """Who has a project open for writing: a name, "" if none was given, process and machine."""

    person: str
    pid: int
    host: str


def holder(path: Path) -> Holder | None:
    """Who took a project's lock last; None where that is not written."""
    try:
        with open(path.with_name(path.name + ".lock"), "rb", buffering=0) as stream:
            stream.seek(1)  # the byte before is the lock's: Windows lets nobody else read it
            told = parse_json(stream.read(4095), str(path))
        return Holder(str(told["person"]), int(told["pid"]), str(told["host"]))
    except (OSError, GenmojoError, KeyError, TypeError, ValueError):
        return None  # nobody, or a program that does not write it


def _write_holder(stream: IO[bytes], person: str) -> None:
    """Beside the lock's own byte; a full disk must not keep anybody from opening."""
    with suppress(OSError):
        stream.truncate(0)
        stream.write(b" " + json_text({"person": person, "pid": os.getpid(), "host": socket.gethostname()}).encode())
        stream.flush()


def take_lock(path: Path, person: str | None = "") -> IO[bytes] | None:
    """The lock of a project, held until the returned file is closed or the process ends; None if another has it.

    Whoever reads meanwhile is told of `person` (None: of nobody, for one who only asks whether it is free).
    """
    try:
        stream = open(path.with_name(path.name + ".lock"), "a+b")  # noqa: SIM115 (closed by the project)
    except OSError:
        return None  # a folder that cannot be written to: read only
    try:
        if os.name == "nt":
            import msvcrt

            stream.seek(0)
            msvcrt.locking(stream.fileno(), msvcrt.LK_NBLCK, 1)  # type: ignore[attr-defined]
        else:
            import fcntl

            fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        stream.close()
        return None
    if person is not None:
        _write_holder(stream, person)
    return stream
