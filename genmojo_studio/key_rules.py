"""Which keys an action may have: what clashes, what taking a key over changes, and files of keys. No widgets."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from PySide6.QtGui import QKeySequence

from genmojo_core.errors import GenmojoError
from genmojo_core.store.atomic import write_bytes
from genmojo_core.store.safe import json_text, parse_json
from genmojo_studio.actions import EVERYWHERE, PRESETS, Action, ActionTable, normal_key, overlap
from genmojo_studio.translate import mark, tr

FORMAT, VERSION = "genmojo-studio keys", 1
_LARGEST = 1 << 20  # bytes of a key file


@dataclass(frozen=True)
class Fixed:
    """A key that windows, dialogs or panels keep; `owners` are the actions that may have it all the same."""

    key: str
    workspace: str
    does: str
    owners: tuple[str, ...] = ()


FIXED = (
    Fixed("Tab", EVERYWHERE, mark("goes to the next point or field"), ()),
    Fixed("Shift+Tab", EVERYWHERE, mark("goes to the point or field before"), ()),
    Fixed("Esc", EVERYWHERE, mark("closes dialogs and puts tools away"), ("annotate.move.frame",)),
    Fixed("Alt+F4", EVERYWHERE, mark("closes the window"), ()),
)


@dataclass(frozen=True)
class Clash:
    """Why an action cannot have a key: `other` has `other_key`; or, with `other` "", `fixed` keeps it; or, with
    neither, the action acts while it is held and wants a single key."""

    key: str
    other: str = ""
    other_key: str = ""
    fixed: Fixed | None = None


def clashes(table: ActionTable, action_id: str, wanted: Iterable[str]) -> list[Clash]:
    """What speaks against an action having these keys, besides the keys that the table gives it now."""
    action, found = table[action_id], []
    for key in wanted:
        fixed = next((f for f in FIXED if overlap(f.key, key) and _meet(action.workspace, f.workspace)), None)
        if fixed is not None and action_id not in fixed.owners:
            found.append(Clash(key, fixed=fixed))
        elif action.held and "," in key.strip(",") and len(key) > 1:
            found.append(Clash(key))
        else:
            found += [Clash(key, other.id, taken) for other in table if _meet(action.workspace, other.workspace)
                      for taken in table.keys(other.id) if overlap(key, taken)
                      and (other.id != action_id or normal_key(key) != normal_key(taken))]  # fmt: skip
    return found


def sentence(table: ActionTable, action_id: str, clash: Clash) -> str:
    """What a person is told of a clash: it names the other action."""
    names = {"key": native(clash.key), "taken": native(clash.other_key), "action": tr(table[action_id].text)}
    if clash.fixed is not None:
        return tr("{key} {does} everywhere and cannot be given away.").format(does=tr(clash.fixed.does), **names)
    if not clash.other:
        return tr("“{action}” acts as long as its key is held: it takes a single key, no sequence.").format(**names)
    names["other"] = tr(table[clash.other].text)
    one, two = len(normal_key(clash.key).split(", ")), len(normal_key(clash.other_key).split(", "))
    if one == two:
        return tr("{key} belongs to “{other}”.").format(**names)
    if one < two:
        return tr("{key} begins {taken} of “{other}”, which could not be reached any more.").format(**names)
    return tr("{key} begins with {taken}, which belongs to “{other}”.").format(**names)


def take_over(table: ActionTable, action_id: str, wanted: tuple[str, ...] | None, found: list[Clash]) -> None:
    """Give an action keys (None: those it was delivered with) and take those that clash from the others."""
    for clash in found:
        if clash.other and clash.other != action_id:
            table.set_keys(clash.other, tuple(k for k in table.keys(clash.other) if k != clash.other_key))
    lost = {c.other_key for c in found if c.other == action_id}  # a sequence of its own that could not be reached
    table.set_keys(action_id, None if wanted is None else tuple(k for k in wanted if k not in lost))


def trial(table: ActionTable, preset: str | None = None) -> ActionTable:
    """A table with the same keys, to try changes on; with another preset, if one is given."""
    made = ActionTable(list(table))
    made.set_preset(preset or table.preset)
    for action_id, keys in table.own_keys().items():
        made.set_keys(action_id, keys)
    return made


def own_that_clash(table: ActionTable, preset: str) -> list[str]:
    """Actions whose keys of one's own clash with those of a preset; without them it has no conflict."""
    tried, dropped = trial(table, preset), []
    while conflicts := [c for c in tried.conflicts() if {c.first, c.second} & set(tried.own_keys())]:
        own = next(i for i in (conflicts[0].second, conflicts[0].first) if i in tried.own_keys())
        tried.set_keys(own, None)
        dropped.append(own)
    return dropped


def native(key: str) -> str:
    """A key as the system writes it."""
    return QKeySequence(key).toString(QKeySequence.SequenceFormat.NativeText)


def write_file(table: ActionTable, path: Path) -> None:
    """All keys into a file. Raises GenmojoError("io")."""
    content = {"format": FORMAT, "version": VERSION, "preset": table.preset,
               "keys": {action.id: list(table.keys(action.id)) for action in table}}  # fmt: skip
    write_bytes(path, json_text(content, 1).encode())


def read_file(table: ActionTable, path: Path) -> int:
    """Take the keys of a file, all or none; returns how many of its actions are not known here.

    Raises GenmojoError: "io" cannot be read, "format" is no key file, "version" of a newer program, "value" names a key
    that is none or that two actions have.
    """
    try:
        if path.stat().st_size > _LARGEST:
            raise GenmojoError("format", "is no file of shortcuts", str(path), "choose one that was exported here")
        content = parse_json(path.read_bytes(), str(path))
    except OSError as error:
        raise GenmojoError("io", f"cannot be read ({error})", str(path), "check the name") from error
    given = content.get("keys") if isinstance(content, dict) and content.get("format") == FORMAT else None
    preset = content.get("preset", PRESETS[0]) if isinstance(content, dict) else ""
    if not isinstance(given, dict) or preset not in PRESETS:
        raise GenmojoError("format", "is no file of shortcuts", str(path), "choose one that was exported here")
    if content.get("version") != VERSION:
        raise GenmojoError("version", "was written by a newer program", str(path), "export it with this version")
    tried = ActionTable(list(table))
    tried.set_preset(preset)
    for action_id, keys in given.items():
        if tried.has(action_id):
            tried.set_keys(action_id, _spelled(keys, tried[action_id], path))
    _check(tried, path)
    table.set_preset(preset)
    for action in table:
        table.set_keys(action.id, tried.own_keys().get(action.id))
    return sum(not table.has(action_id) for action_id in given)


def _spelled(keys: object, action: Action, path: Path) -> tuple[str, ...]:
    """Keys of a file as Qt spells them."""
    spelled = [QKeySequence(str(key)) for key in (keys if isinstance(keys, list) else ["?none?"])]
    texts = [sequence.toString(QKeySequence.SequenceFormat.PortableText) for sequence in spelled]
    if not isinstance(keys, list) or not all(texts) or len(keys) > 8:
        raise GenmojoError("value", f"gives {action.id} a key that there is not", str(path), "put it right in the file")
    return tuple(dict.fromkeys(texts))


def _check(tried: ActionTable, path: Path) -> None:
    """No key of a file may mean two things."""
    for action in tried:
        found = clashes(tried, action.id, tried.keys(action.id))
        if found:
            other = found[0].other or (found[0].fixed.key if found[0].fixed else found[0].key)
            raise GenmojoError("value", f"gives {found[0].key} to {action.id}, which clashes with {other}", str(path),
                               "put it right in the file")  # fmt: skip


def _meet(one: str, other: str) -> bool:
    """Whether actions of two workspaces work at the same time."""
    return EVERYWHERE in (one, other) or one == other
