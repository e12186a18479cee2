"""What the command line shows: progress on stderr, one JSON object or plain lines on stdout."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
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
    """Nested data as `key: value` lines."""
    for key, item in value.items():
        if isinstance(item, Mapping):
            yield f"{prefix}{key}:"
            yield from _lines(item, prefix + "  ")
        elif isinstance(item, list | tuple) and item and isinstance(item[0], Mapping):
            yield f"{prefix}{key}:"
            for row in item:
                yield f"{prefix}  " + ", ".join(f"{k} {_short(v)}" for k, v in row.items())
        else:
            yield f"{prefix}{key}: {_short(item)}"


def _short(value: Any) -> str:
    """Numbers with a sensible number of digits."""
    if isinstance(value, float):
        return f"{value:.4g}"
    if isinstance(value, list | tuple):
        return ", ".join(_short(v) for v in value) or "none"
    return str(value)
