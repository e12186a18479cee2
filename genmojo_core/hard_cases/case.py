"""What a hard case is, and how a list of them becomes a list of verdicts."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from genmojo_core.errors import GenmojoError


class BrokenError(Exception):
    """The property of a hard case does not hold; the message says what was seen instead."""


# What a case may end in besides `BrokenError`: each is a finding, none may end the others.
FAULTS = (GenmojoError, ArithmeticError, ValueError, TypeError, LookupError, AttributeError, RuntimeError, OSError,
          MemoryError)  # fmt: skip


@dataclass(frozen=True)
class Case:
    """One hard case.

    Args:
        row: of the reliability study, "N01" to "N33". name: a few words, unique.
        run: does it and returns what happened in a few words; raises `BrokenError` where the property does not hold.
    """

    row: str
    name: str
    run: Callable[[], str]


@dataclass(frozen=True)
class Verdict:
    """How a case ended: `happened` in a few words, `holds` if its property does, `seconds` of wall time."""

    row: str
    name: str
    happened: str
    holds: bool
    seconds: float


def hold(condition: bool, otherwise: str) -> None:
    """Go on if the condition is true. Raises BrokenError(otherwise)."""
    if not condition:
        raise BrokenError(otherwise)


def verdicts(cases: Sequence[Case]) -> Iterator[Verdict]:
    """Run the cases one after the other; a case that breaks or ends in an error is a verdict too."""
    for case in cases:
        start = time.monotonic()
        try:
            happened, holds = case.run(), True
        except BrokenError as broken:
            happened, holds = str(broken), False
        except FAULTS as fault:
            happened, holds = f"{type(fault).__name__}: {fault}", False
        yield Verdict(case.row, case.name, happened, holds, time.monotonic() - start)
