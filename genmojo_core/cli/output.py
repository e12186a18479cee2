"""What the command line shows: progress on stderr, one JSON object or plain lines on stdout."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from textwrap import wrap
from typing import Any

from genmojo_core.store.safe import json_text


def show(result: Mapping[str, Any], as_json: bool) -> None:
    """The result of a command on stdout."""
    if as_json:
        sys.stdout.write(json_text(result) + "\n")
    else:
        sys.stdout.write("".join(f"{line}\n" for line in _lines(result)))
    sys.stdout.flush()


def say(text: str) -> None:
    """One line for people, on stderr."""
    sys.stderr.write(f"{text}\n")
    sys.stderr.flush()


@contextmanager
def progress(title: str) -> Iterator[Callable[[float], None]]:
    """A progress bar with an estimate of the time left; the function it gives takes a share 0..1."""
    from tqdm import tqdm

    with tqdm(total=100, desc=title, unit="%", file=sys.stderr, bar_format=_FORMAT, leave=False) as bar:

        def tell(share: float) -> None:
            bar.update(min(100.0, max(0.0, 100 * share)) - bar.n)

        yield tell


_FORMAT = "{desc}: {percentage:3.0f}% |{bar:24}| {elapsed}, {remaining} left {postfix}"


def _lines(value: Mapping[str, Any], prefix: str = "") -> Iterator[str]:
    """Nested data as `key: value` lines; rows of equal kind as a table, several sentences one to a line."""
    for key, item in value.items():
        if isinstance(item, Mapping):
            yield f"{prefix}{key}:"
            yield from _lines(item, prefix + "  ")
        elif isinstance(item, list | tuple) and item and isinstance(item[0], Mapping):
            yield f"{prefix}{key}:"
            yield from _table(item, prefix + "  ")
        elif isinstance(item, list | tuple) and len(item) > 1 and any(len(str(v)) > LONG for v in item):
            yield f"{prefix}{key}:"
            yield from (f"{prefix}  - {_short(v)}" for v in item)
        else:
            yield f"{prefix}{key}: {_short(item)}"


LONG = 24  # characters: a longer text is no cell of a table
MOST_ROWS = 24


def _table(rows: Sequence[Mapping[str, Any]], prefix: str) -> Iterator[str]:
    """Rows in columns under their names; what is long stands under its row, what no row has is left out.

    Of many rows the first and the last are shown, and how many lie between.
    """
    rows = [{key: _cell(value) for key, value in row.items()} for row in rows]
    names = list(dict.fromkeys(key for row in rows for key in row))
    names = [name for name in names if any(row.get(name) for row in rows)]
    below = [name for name in names if any(len(row.get(name, "")) > LONG for row in rows)]
    columns = [name for name in names if name not in below]
    widths = {name: max(len(name), *(len(row.get(name, "")) for row in rows)) for name in columns}
    yield prefix + "  ".join(name.ljust(widths[name]) for name in columns).rstrip()
    for i, row in enumerate(rows):
        if len(rows) - 1 >= MOST_ROWS and MOST_ROWS // 2 <= i < len(rows) - MOST_ROWS // 2:
            if i == MOST_ROWS // 2:
                yield f"{prefix}... {len(rows) - MOST_ROWS} more (--json has all)"
            continue
        yield prefix + "  ".join(row.get(name, "").ljust(widths[name]) for name in columns).rstrip()
        for name in below:
            if row.get(name):
                yield from wrap(f"{name}: {row[name]}", 116, initial_indent=f"{prefix}    ",
                                subsequent_indent=f"{prefix}      ")  # fmt: skip


def _cell(value: Any) -> str:
    """A value as a cell; nothing for what is not there."""
    if isinstance(value, Mapping):
        return ", ".join(f"{key} {_short(item)}" for key, item in value.items())
    return "" if value is None else _short(value)


def _short(value: Any) -> str:
    """Numbers with a sensible number of digits, truths in words."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.4g}"
    if isinstance(value, list | tuple):
        return ", ".join(_short(v) for v in value) or "none"
    return str(value)
