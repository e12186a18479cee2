"""Words that go out without people: their names taken out of what was written freely, sentences of `say` left whole."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import replace

from genmojo_core.sentences import SENTENCES, origin
from genmojo_core.store.project_log import Row
from genmojo_core.tracks.annotation import ObjectInfo, TrackInfo
from genmojo_core.tracks.edits import Change, Edit, ObjectChange, TrackChange

HIDDEN = "(name)"
_FREE = tuple(SENTENCES[key] for key in ("needs_fix_note", "reject_note", "log_note", "log_review_note"))
_NAMING = tuple(SENTENCES[key] for key in ("log_person", "log_reviewer"))


class Nameless:
    """Takes some people's names out of words.

    Args:
        people: their names; each part of two letters or more counts by itself, whatever its case.
    """

    def __init__(self, people: Iterable[str]) -> None:
        parts = {part for name in people for part in (name.strip(), *name.split()) if len(part) > 1}
        longest_first = sorted(parts, key=lambda part: (-len(part), part))
        words = "|".join(rf"(?<!\w){re.escape(part)}(?!\w)" for part in longest_first)
        self._names = re.compile(words, re.IGNORECASE) if words else None

    def text(self, words: str) -> str:
        """What somebody wrote, with `HIDDEN` for every name."""
        return words if self._names is None else self._names.sub(HIDDEN, words)

    def sentence(self, words: str) -> str:
        """A sentence of `say` with what somebody wrote into it."""
        template, values = origin(words)
        return template.format(**values | {"name": self.text(values["name"])}) if template in _FREE else words

    def sentences(self, many: Sequence[str]) -> list[str]:
        """Sentences of the log but those that only name a person."""
        return [self.sentence(words) for words in many if origin(words)[0] not in _NAMING]

    def title(self, verb: str, words: str) -> str:
        """What a line of the log is called; a moment is called what somebody wrote."""
        return self.text(words) if verb == "checkpoint" else self.sentence(words)

    def row(self, row: Row) -> Row:
        """A line of the log by nobody, on a day."""
        return replace(row, who="", at=row.at[:10], title=self.title(row.verb, row.title))

    def edit(self, edit: Edit) -> Edit:
        """An edit of tracks that belong to nobody."""
        return replace(edit, changes=tuple(self._change(change) for change in edit.changes))

    def track(self, info: TrackInfo) -> TrackInfo:
        """A track of nobody."""
        note, said = self.text(info.note), self.text(info.review_note)
        return replace(info, person="", reviewer="", note=note, review_note=said)

    def object(self, info: ObjectInfo) -> ObjectInfo:
        """An object, with why it is one."""
        return replace(info, reason=self.text(info.reason))

    def _change(self, change: Change) -> Change:
        if isinstance(change, TrackChange):
            tracks = [None if info is None else self.track(info) for info in (change.before, change.after)]
            return TrackChange(change.id, *tracks)
        if isinstance(change, ObjectChange):
            objects = [None if info is None else self.object(info) for info in (change.before, change.after)]
            return ObjectChange(change.id, *objects)
        return change


def people_of(row: Row, edit: Edit | None) -> set[str]:
    """Who is named by a line of the log and by what it did."""
    tracks = [c for c in edit.changes if isinstance(c, TrackChange)] if edit is not None else []
    infos = [info for change in tracks for info in (change.before, change.after) if info is not None]
    return {row.who, *(info.person for info in infos), *(info.reviewer for info in infos)} - {""}
