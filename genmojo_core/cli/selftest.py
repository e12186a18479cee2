"""`genmojo selftest`: hard cases tried on this machine, with a verdict for each."""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from genmojo_core.cli.arguments import names
from genmojo_core.cli.output import progress, say
from genmojo_core.errors import GenmojoError

if TYPE_CHECKING:
    from genmojo_core.hard_cases.case import Verdict


def add_commands(commands: Any) -> None:
    """Add `selftest`."""
    selftest = commands.add_parser("selftest", help="try hard cases on this machine: numbers stay finite and bounded")
    selftest.add_argument("--hard", action="store_true", help="all cases, some minutes; without it those of "
                          "splats and numbers alone, seconds")  # fmt: skip
    selftest.add_argument("--rows", type=names, default=(), metavar="N18,N27", help="only these rows")
    selftest.set_defaults(run=run_selftest)


def run_selftest(args: argparse.Namespace) -> dict[str, Any]:
    """Run the cases; a table on stdout (with --json one object), exit code 1 if one does not hold."""
    start = time.monotonic()
    say("loading the optimiser")
    import torch

    from genmojo_core.hard_cases import maths_cases, splat_cases, suite
    from genmojo_core.hard_cases.case import verdicts
    from genmojo_core.render import backend

    cases = suite.CASES if args.hard or args.rows else (*maths_cases.CASES, *splat_cases.CASES)
    chosen = [case for case in cases if not args.rows or case.row in args.rows]
    if not chosen:
        raise GenmojoError("argument", f"no case belongs to {', '.join(args.rows)}", "--rows",
                           f"use {', '.join(sorted({case.row for case in cases}))}")  # fmt: skip
    backend.warm_up(say).join()
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    found: list[Verdict] = []
    try:
        with progress("hard cases") as tell:
            for verdict in verdicts(chosen):
                found.append(verdict)
                tell(len(found) / len(chosen))
    finally:
        torch.set_num_threads(threads)
    failed = [verdict for verdict in found if not verdict.holds]
    if not args.json:
        sys.stdout.write(table(found))
    result: dict[str, Any] = {"cases": len(found), "failed": len(failed), "seconds": time.monotonic() - start,
                              "exit_code": 1 if failed else 0}  # fmt: skip
    if args.json:
        result["verdicts"] = [vars(verdict) for verdict in found]
    return result


def table(verdicts: Sequence[Verdict]) -> str:
    """Row, case, what happened, verdict and seconds, as aligned lines."""
    rows = [(v.row, v.name, _happened(v), "holds" if v.holds else "BROKEN", f"{v.seconds:.1f} s") for v in verdicts]
    rows.insert(0, ("row", "case", "what happened", "verdict", ""))
    widths = [max(len(row[i]) for row in rows) for i in range(5)]
    return "".join("  ".join(c.ljust(w) for c, w in zip(row, widths, strict=True)).rstrip() + "\n" for row in rows)


def _happened(verdict: Verdict) -> str:
    """On one line of at most 90 characters, unless it is a fault: then all of it."""
    text = " ".join(verdict.happened.split())
    return text if not verdict.holds or len(text) <= 90 else text[:87] + "..."
