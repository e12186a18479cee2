"""A project: one annotation in a `.genmojo` file in which nothing is ever lost.

`do`, `undo`, `redo` change the annotation at once and hand the row to the writing thread; `saved` tells when it is on
the disk. There is no Save. The second program to open a file gets it read-only.

    project = Project.create("clip.genmojo", info, person="Ada")
    project.do(keys.set_key(project.annotation, track, t, (812.25, 401.5)))
    step = project.undo()          # step.frame, step.track: where to look; step.titles: what was undone
    project.checkpoint("first pass")
    project.close()
"""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import IO

import numpy as np

from genmojo_core.errors import GenmojoError
from genmojo_core.store import project_file, project_news
from genmojo_core.store.edit_codec import encode_annotation, encode_edit, encode_proposal
from genmojo_core.store.project_db import RAISE_VERSION, VERSION, Statement, Writer, take_lock
from genmojo_core.store.project_file import ClipInfo, Loaded
from genmojo_core.store.project_log import Row
from genmojo_core.store.project_news import News
from genmojo_core.store.safe import json_text
from genmojo_core.tracks.annotation import EARLIER, Proposal
from genmojo_core.tracks.edits import Edit, ObjectChange, ProposalChange, TrackChange

_SNAPSHOT_EVERY = 300  # edits after which opening gets a shortcut
_CACHE = 500  # edits whose data stay in memory


@dataclass(frozen=True)
class Step:
    """What an undo or redo did: titles newest first, and the frame and track to show (None: nowhere in particular)."""

    titles: tuple[str, ...]
    frame: int | None
    track: int | None


class Project:
    """An open project. Make one with `create` or `open`; `close` it.

    Args:
        path: its file. annotation: what stands now. log: its history. info: the clip.
        read_only: another program has it open; `do` and its kin raise GenmojoError("io").
        person: who is named in the log.

    `saved` (sequence number, seconds since the edit) and `failed` (GenmojoError) may be set; both are called in the
    writing thread.
    """

    def __init__(self, path: Path, loaded: Loaded, person: str, lock: IO[bytes] | None) -> None:
        self.path, self.person = path, person
        self.annotation, self.log, self.info = loaded.annotation, loaded.log, loaded.info
        self.saved: Callable[[int, float], None] | None = None
        self.failed: Callable[[GenmojoError], None] | None = None
        self.read_only = True
        self._writer: Writer | None = None
        self._lock: IO[bytes] | None = None
        self._recent: dict[int, Edit] = {}
        self._snapshot_at, self._older = loaded.snapshot, loaded.version < VERSION
        if lock is not None:
            self._begin_writing(lock)

    @classmethod
    def create(cls, path: str | Path, info: ClipInfo, person: str = "") -> Project:
        """A new project file. Raises GenmojoError("io") if the file exists already or cannot be made."""
        file = Path(path)
        if file.exists():
            raise GenmojoError("io", "exists already", str(path), "open it, or choose another name")
        project_file.create(file, info)
        return cls(file, project_file.load(file), person, take_lock(file, person))

    @classmethod
    def open(cls, path: str | Path, person: str = "", backup: bool = True) -> Project:
        """Open a project where it was left, read-only if another program has it open.

        Raises GenmojoError: "io" missing, "format" no project, "version" of a newer program, "corrupt" damaged.
        """
        file = Path(path)
        if not file.is_file():
            raise GenmojoError("io", "does not exist or is no file", str(path), "check the name")
        lock = take_lock(file, person)
        try:
            loaded = project_file.load(file)
            if lock is not None and backup and len(loaded.log):
                project_file.back_up(file)
        except GenmojoError:
            if lock is not None:
                lock.close()
            raise
        return cls(file, loaded, person, lock)

    @classmethod
    def open_or_create(cls, path: str | Path, info: ClipInfo, person: str = "") -> Project:
        """The project of a clip, new if there is none. Raises as `open`, and "value" if it belongs to another clip."""
        if not Path(path).exists():
            return cls.create(path, info, person)
        project = cls.open(path, person)
        if (project.info.frames, project.info.size) != (info.frames, info.size):
            project.close()
            raise GenmojoError("value", f"belongs to a clip of {project.info.frames} frames of {project.info.size}, "
                               f"not {info.frames} of {info.size}", str(path), "choose another file")  # fmt: skip
        return project

    def do(self, edit: Edit, step: int | None = None) -> int | None:
        """Apply and store an edit; returns its step, None if nothing was done.

        Args:
            edit: made from the annotation as it stands. One without changes is not recorded.
            step: join the step of this number, for what a machine finds in answer to a person's edit. If it is no
                longer in effect, nothing is done; if another came after it, the edit is a step of its own, so that
                nobody takes back two deeds at once.
        """
        self._check_writable()
        if not edit.changes or (step is not None and not self.log.on_path(step)):
            return None
        edit.do(self.annotation)
        own = {"kind": edit.kind, "title": edit.title, "frame": edit.frame, "track": edit.track}
        if step is not None and self.log.edit(self.log.head).step == step:
            own["step"] = step
        row = self.log.new_row("do", self.log.head, self.person, own)
        self._remember(row.seq, edit)
        self._append(row, encode_edit(edit), _tables(edit))
        if len(self.log) - self._snapshot_at >= _SNAPSHOT_EVERY:
            self._snapshot()
        return row.step

    def undo(self) -> Step | None:
        """Take the newest step back; None at the beginning."""
        return self._move(self.log.undo_target())

    def redo(self) -> Step | None:
        """Do the step last taken back again; None if there is none."""
        return self._move(self.log.redo_target())

    def go_to(self, seq: int) -> Step | None:
        """Move to any place in the history, also to another branch (0: the beginning)."""
        if seq and not self.log.has_edit(seq):
            raise GenmojoError("argument", f"there is no edit {seq}", str(self.path))
        return self._move(seq if seq != self.log.head else None)

    def checkpoint(self, name: str) -> None:
        """Give the present state a name, keep a shortcut to it and a backup copy of the file."""
        self._check_writable()
        self._append(self.log.new_row("checkpoint", self.log.head, self.person, {"title": name}), b"", [])
        self._snapshot()
        if self.wait():
            project_file.back_up(self.path)

    def checkpoints(self) -> list[Row]:
        """Named states, oldest first; `go_to(row.parent)` returns to one."""
        return [row for row in self.log.rows if row.verb == "checkpoint"]

    def history(self) -> list[Row]:
        """Every edit ever made, oldest first, those undone included (`log.on_path(seq)` tells)."""
        return [row for row in self.log.rows if row.verb == "do"]

    def propose(self, track: int, proposal: Proposal) -> None:
        """Keep a tracker's proposal, untouched, beside the track; the one before it of the same tracker stays, too."""
        self._check_writable()
        before = self.annotation.proposals.get(track, {}).get(proposal.tracker)
        if before is not None and not np.array_equal(before.xy, proposal.xy):
            older = replace(before, tracker=f"{proposal.tracker}{EARLIER}")
            self.annotation.propose(track, older)
            self.put_blob(_proposal_name(track, older.tracker), encode_proposal(older))
        self.annotation.propose(track, proposal)
        self.put_blob(_proposal_name(track, proposal.tracker), encode_proposal(proposal))

    def put_blob(self, name: str, data: bytes) -> None:
        """Keep any bytes under a name (time sheets, layouts), outside the history."""
        self._check_writable()
        sql = "INSERT OR REPLACE INTO blobs (name, seq, data) VALUES (?, ?, ?)"
        if self._writer is not None:
            self._writer.put([(sql, (name, len(self.log), data))])

    def blob(self, name: str) -> bytes | None:
        """Bytes kept under a name, None if there are none."""
        self.wait()
        return project_file.blob(self.path, name)

    def wait(self, seconds: float | None = 10.0) -> bool:
        """Until everything is on the disk; False if that cannot be."""
        return self._writer is None or self._writer.wait(seconds)

    def save_copy(self, path: str | Path) -> None:
        """A whole project file elsewhere, with what could not be written here. Raises GenmojoError("io")."""
        self.wait()
        project_file.copy(self.path, Path(path), self._writer.unsaved() if self._writer is not None else [])

    def unsaved(self) -> int:
        """How many transactions could not be written so far."""
        return 0 if self._writer is None else self._writer.failing()

    def retry(self) -> None:
        """Try again to write what could not be written."""
        if self._writer is not None:
            self._writer.put([])

    def moved_clip(self, path: str | Path) -> None:
        """The clip lies elsewhere by now. Raises GenmojoError("io") if the project is read only."""
        self._check_writable()
        self.info = replace(self.info, path=str(path))
        if self._writer is not None:
            self._writer.put([("UPDATE clip SET value = ? WHERE key = 'path'", (str(path),))])

    def note_digests(self, found: Mapping[int, str]) -> None:
        """Digests of frames (`clip/digests.py`), by frame. Raises GenmojoError("io") if the project is read only."""
        self._check_writable()
        held = list(self.info.sha256 or ("",) * self.info.frames)
        for frame, digest in found.items():
            held[frame] = digest
        self.info = replace(self.info, sha256=tuple(held))
        if self._writer is not None:
            sql = "UPDATE frames SET sha256 = ? WHERE position = ?"
            self._writer.put([(sql, (digest, frame)) for frame, digest in found.items()])

    def follow(self, news: News) -> None:
        """Do here what another program did; listeners are told, as of edits of one's own.

        Args:
            news: what follows the log as it stands (`project_news.read`); older news are left alone.
        """
        if not self.read_only or news.rows[0].seq != len(self.log) + 1:
            return
        for seq, edit in news.edits.items():
            self._remember(seq, edit)
        with self.annotation.at_once():
            for row in news.rows:
                if row.verb == "do":
                    news.edits[row.seq].do(self.annotation)
                elif row.verb == "move":
                    self._walk(*self.log.path(row.parent))
                self.log.follow(row)
            self.log.set_chain(news.chain)
        for track, proposal in news.proposals:
            if track in self.annotation.tracks:
                self.annotation.propose(track, proposal)

    def take_over(self) -> bool:
        """Write from now on, if no other program does any more; what that one wrote last is followed first."""
        lock = take_lock(self.path, self.person) if self.read_only else None
        if lock is None:
            return False
        try:
            news = project_news.read(self.path, len(self.log), self.log.chain)
            if news is not None:
                self.follow(news)
            project_file.read_proposals(self.path, self.annotation)  # also those that no edit told of
        except GenmojoError:
            lock.close()
            raise
        self._begin_writing(lock)
        return True

    def _begin_writing(self, lock: IO[bytes]) -> None:
        self._lock, self.read_only = lock, False
        self._writer = Writer(self.path, lambda error: self.failed(error) if self.failed else None)

    def close(self) -> None:
        """Write what waits, leave one file, release the lock."""
        if self._writer is not None:
            if len(self.log) > self._snapshot_at:
                self._snapshot()
            self._writer.close()
            self._writer = None
        if self._lock is not None:
            self._lock.close()
            self._lock = None
        self.read_only = True

    def _move(self, target: int | None) -> Step | None:
        """Make another edit the head."""
        self._check_writable()
        if target is None:
            return None
        back, forth = self.log.path(target)
        with self.annotation.at_once():
            edits = self._walk(back, forth)
        moved = [edits[seq] for seq in (back or forth[::-1])]
        last = next((e for e in moved if e.frame is not None), moved[0])
        own = {"kind": "undo" if back else "redo", "title": last.title, "frame": last.frame, "track": last.track}
        tables = [s for seq in [*back, *forth] for s in _tables(edits[seq], undone=seq in back)]
        self._append(self.log.new_row("move", target, self.person, own), b"", tables)
        return Step(tuple(e.title for e in moved), last.frame, last.track)

    def _walk(self, back: list[int], forth: list[int]) -> dict[int, Edit]:
        """Undo edits, then do others; their data."""
        edits = self._edits([*back, *forth])
        for seq in back:
            edits[seq].undo(self.annotation)
        for seq in forth:
            edits[seq].do(self.annotation)
        return edits

    def _append(self, row: Row, payload: bytes, more: list[Statement]) -> None:
        """Add a row to the log and hand it to the writing thread."""
        chain = self.log.add(row, payload)
        began = time.monotonic()

        def durable() -> None:
            if self.saved is not None:
                self.saved(row.seq, time.monotonic() - began)

        self._put([project_file.row_statement(row, payload, chain), *more], durable)

    def _put(self, statements: list[Statement], done: Callable[[], None] | None = None) -> None:
        """Hand over what programs older than this one cannot read; they say so from then on."""
        if self._writer is not None:
            self._writer.put([RAISE_VERSION, *statements] if self._older else statements, done)
            self._older = False

    def _edits(self, wanted: list[int]) -> dict[int, Edit]:
        """Data of edits, from memory or from the file."""
        missing = [seq for seq in wanted if seq not in self._recent]
        found = {seq: self._recent[seq] for seq in wanted if seq in self._recent}
        if missing:
            self.wait()
            found |= project_file.edits(self.path, [self.log.edit(seq) for seq in missing])
        for seq in missing:
            self._remember(seq, found[seq])
        return found

    def _remember(self, seq: int, edit: Edit) -> None:
        self._recent[seq] = edit
        if len(self._recent) > 2 * _CACHE:
            self._recent = dict(list(self._recent.items())[-_CACHE:])

    def _snapshot(self) -> None:
        """Store the whole annotation, so that opening need not replay everything."""
        self._snapshot_at = len(self.log)
        data = encode_annotation(self.annotation)
        self._put(project_file.snapshot_statements(len(self.log), data, self.log.chain))

    def _check_writable(self) -> None:
        if self.read_only:
            raise GenmojoError("io", "is open in another program", str(self.path), "close it there, or save a copy")


def _proposal_name(track: int, tracker: str) -> str:
    """The blob that keeps a proposal."""
    return f"proposal:{track}:{tracker}"


def _tables(edit: Edit, undone: bool = False) -> list[Statement]:
    """Statements that keep the tables of objects and tracks, and the proposals, as the annotation."""
    statements: list[Statement] = []
    for change in edit.changes:
        if isinstance(change, ProposalChange):
            kept = change.before if undone else change.after
            name = _proposal_name(change.track, change.tracker)
            statements.append(("DELETE FROM blobs WHERE name = ?", (name,)))
            if kept is not None:
                sql = "INSERT INTO blobs (name, seq, data) VALUES (?, 0, ?)"
                statements.append((sql, (name, encode_proposal(kept))))
        if isinstance(change, ObjectChange | TrackChange):
            table = "objects" if isinstance(change, ObjectChange) else "tracks"
            value = change.before if undone else change.after
            if value is None:
                statements.append((f"DELETE FROM {table} WHERE id = ?", (change.id,)))
            else:
                sql = f"INSERT OR REPLACE INTO {table} (id, data) VALUES (?, ?)"
                statements.append((sql, (change.id, json_text(asdict(value)))))
    return statements


def info_of(frames: int, size: tuple[int, int], name: str = "", path: str = "") -> ClipInfo:
    """A ClipInfo of frames numbered from 0 at 24 a second, for clips without time stamps."""
    return ClipInfo(name, path, size, np.arange(frames), np.arange(frames) / 24.0)
