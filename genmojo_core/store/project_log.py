"""The history of a project: a tree of edits, where we stand in it, and a chain of hashes over every row.

Nothing is ever taken out: undoing and redoing are rows too, which move the head. So one table is undo tree and audit
log in one.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import UTC, datetime
from typing import Any

from genmojo_core import __version__

ROOT = 0
COLUMNS = "seq, parent, step, verb, kind, title, frame, track, who, at, version"


@dataclass(frozen=True)
class Row:
    """One line of the log.

    verb is "do" (parent is the edit before), "move" (undo or redo: parent is the new head) or "checkpoint" (a name
    for the head, which is its parent). Rows of one `step` are undone together.
    """

    seq: int
    parent: int
    step: int
    verb: str
    kind: str
    title: str
    frame: int | None
    track: int | None
    who: str
    at: str
    version: str

    def hash(self, payload: bytes, previous: bytes) -> bytes:
        """The chain's next link."""
        head = repr((self.seq, self.parent, self.step, self.verb, self.kind, self.title, self.frame, self.track,
                     self.who, self.at, self.version)).encode()  # fmt: skip
        return hashlib.sha256(previous + head + b"\0" + payload).digest()


class Log:
    """Rows, the tree they form and the head; knows no file and no annotation."""

    def __init__(self) -> None:
        self.rows: list[Row] = []
        self.head = ROOT
        self._edits: dict[int, Row] = {}
        self._next: dict[int, int] = {}  # edit -> the child redo goes to
        self._chain: bytes = b""

    def __len__(self) -> int:
        return len(self.rows)

    def new_row(self, verb: str, parent: int, who: str, fields: dict[str, Any]) -> Row:
        """A row to be added; `fields` may hold step, kind, title, frame and track."""
        seq = len(self.rows) + 1
        values = {"kind": "", "title": "", "frame": None, "track": None, "step": seq} | fields
        now = datetime.now(UTC).isoformat(timespec="milliseconds")
        return Row(seq=seq, parent=parent, verb=verb, who=who, at=now, version=__version__, **values)

    def add(self, row: Row, payload: bytes) -> bytes:
        """Append a row; returns its hash."""
        self._chain = row.hash(payload, self._chain)
        self.follow(row)
        return self._chain

    def follow(self, row: Row) -> None:
        """Append a row whose hash is known already (`set_chain` after the last one)."""
        self.rows.append(row)
        if row.verb == "do":
            self._edits[row.seq] = row
            self._next[row.parent] = row.seq
            self.head = row.seq
        elif row.verb == "move":
            for seq in self.path(row.parent)[1]:
                self._next[self._edits[seq].parent] = seq
            self.head = row.parent

    @property
    def chain(self) -> bytes:
        """The hash of the last row."""
        return self._chain

    def set_chain(self, value: bytes) -> None:
        """The hash of the last row."""
        self._chain = value

    def edit(self, seq: int) -> Row:
        """The row of an edit."""
        return self._edits[seq]

    def has_edit(self, seq: int) -> bool:
        """Whether there is an edit of that number, done or undone."""
        return seq in self._edits

    def undo_target(self) -> int | None:
        """Where undo leads: before the head's step; None at the beginning."""
        if self.head == ROOT:
            return None
        seq, step = self.head, self._edits[self.head].step
        while seq != ROOT and self._edits[seq].step == step:
            seq = self._edits[seq].parent
        return seq

    def redo_target(self) -> int | None:
        """Where redo leads: the end of the next step; None where nothing was undone."""
        seq = self._next.get(self.head)
        if seq is None:
            return None
        while (after := self._next.get(seq)) is not None and self._edits[after].step == self._edits[seq].step:
            seq = after
        return seq

    def on_way(self, seq: int, target: int) -> bool:
        """Whether redoing from an edit on leads through a later one."""
        at: int | None = seq
        while at is not None and at < target:
            at = self._next.get(at)
        return at == target

    def path(self, target: int) -> tuple[list[int], list[int]]:
        """From the head to another place: edits to undo, newest first, and edits to do, oldest first."""
        back, forth, here = [], [], self.head
        while here != target:  # a parent is always older than its child
            if here > target:
                back.append(here)
                here = self._edits[here].parent
            else:
                forth.append(target)
                target = self._edits[target].parent
        return back, forth[::-1]

    def standing(self) -> Iterator[Row]:
        """Edits in effect, newest first."""
        at = self.head
        while at != ROOT:
            yield self._edits[at]
            at = self._edits[at].parent

    def on_path(self, seq: int) -> bool:
        """Whether an edit is in effect."""
        at = self.head
        while at > seq:
            at = self._edits[at].parent
        return at == seq
