"""The history of a project as a tree of states, for a person to look at: which deed led to each, and what branches off.

An edit and what a machine found in answer to it are one state, unless somebody stands, or gave a name, between them.
"""

from __future__ import annotations

from dataclasses import dataclass

from genmojo_core.store.project_log import ROOT, Log, Row


@dataclass(frozen=True)
class State:
    """A place in the history.

    seq: for `Project.go_to`. parent: the state before. row: the deed that led here, None at the beginning. names: those
    given to it. ahead: it was undone, or lies on another branch.
    """

    seq: int
    parent: int
    row: Row | None
    names: tuple[str, ...]
    ahead: bool


class History:
    """States of a log as it stands. `head` is where we are; `before_jump` where the last jump came from, or None.

    A jump is a move that leads further than one undo or redo.
    """

    def __init__(self, log: Log) -> None:
        self.head = log.head
        self._log = log
        self.names: dict[int, list[str]] = {}
        for row in log.rows:
            if row.verb == "checkpoint":
                self.names.setdefault(row.parent, []).append(row.title)
        below: dict[int, list[Row]] = {}
        for row in log.rows:
            if row.verb == "do":
                below.setdefault(row.parent, []).append(row)
        on_path = self._path()
        self.states: dict[int, State] = {ROOT: self._state(ROOT, ROOT, None, ahead=False)}
        self.children: dict[int, list[int]] = {}
        waiting = [(ROOT, row) for row in reversed(below.get(ROOT, []))]
        while waiting:  # no recursion: histories are as long as people work
            parent, row = waiting.pop()
            last = row
            while len(following := below.get(last.seq, [])) == 1 and self._goes_on(last, following[0]):
                last = following[0]
            self.states[last.seq] = self._state(last.seq, parent, row, ahead=last.seq not in on_path)
            self.children.setdefault(parent, []).append(last.seq)
            waiting += [(last.seq, one) for one in reversed(below.get(last.seq, []))]
        self.before_jump = self._before_jump()

    def line(self, first: int, branch: bool = False) -> list[int]:
        """States from one on, oldest first: where redo leads, or in a branch always along the newest."""
        found = [first]
        while after := self.children.get(found[-1], []):
            on_way = [seq for seq in after if self._log.on_way(found[-1], seq)]
            found.append(on_way[0] if on_way and not branch else max(after))
        return found

    def branches(self, seq: int, line: set[int]) -> list[int]:
        """First states of the branches that leave a state, those on `line` left out."""
        return [child for child in self.children.get(seq, []) if child not in line]

    def _path(self) -> set[int]:
        """Edits that are in effect."""
        found, at = set(), self.head
        while at != ROOT:
            found.add(at)
            at = self._log.edit(at).parent
        return found

    def _goes_on(self, row: Row, after: Row) -> bool:
        """Whether the next edit belongs to the same state."""
        return after.step == row.step and row.seq != self.head and row.seq not in self.names

    def _state(self, seq: int, parent: int, row: Row | None, ahead: bool) -> State:
        return State(seq, parent, row, tuple(self.names.get(seq, ())), ahead)

    def _before_jump(self) -> int | None:
        head, found = ROOT, None
        for row in self._log.rows:
            if row.verb == "do":
                head = row.seq
            elif row.verb == "move":
                one, other = self._state_of(head), self._state_of(row.parent)
                if one != other and self.states[one].parent != other and self.states[other].parent != one:
                    found = head
                head = row.parent
        return None if found is None else self._state_of(found)

    def _state_of(self, seq: int) -> int:
        """The state that an edit belongs to: its own, or the one that its step ends in."""
        while seq not in self.states:
            seq = next(r.seq for r in self._log.rows[seq:] if r.verb == "do" and r.parent == seq)
        return seq
