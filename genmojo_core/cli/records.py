"""`genmojo log` and `genmojo times`: the audit log of a project, whether it is as written, and what the work cost."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any


def add_commands(commands: Any) -> None:
    """Add `log` and `times`."""
    log = commands.add_parser("log", help="who did what to an annotation: checks its chain, writes CSV or JSON")
    log.add_argument("file", metavar="FILE.genmojo")
    log.add_argument("-o", "--output", metavar="LOG.csv|LOG.json", help="names and times only where consent is given")
    log.add_argument("--track", type=int, metavar="ID", help="only edits of one track")
    log.add_argument("--person", metavar="NAME", help="only edits of one person")
    log.add_argument("--standing", action="store_true", help="leave out what was undone")
    log.set_defaults(run=run_log)
    times = commands.add_parser("times", help="seconds, keys, accepted places, reopened tracks and time left, per clip "
                                "and person")  # fmt: skip
    times.add_argument("files", metavar="FILE.genmojo", nargs="+")
    times.add_argument("-o", "--output", metavar="FIGURES.csv", help="names and times only where consent is given")
    times.add_argument("--stride", type=int, metavar="N", help="frames from one look to the next (the project's own)")
    times.set_defaults(run=run_times)


def run_log(args: argparse.Namespace) -> dict[str, Any]:
    """Check the chain, write the lines asked for; exit 2 if the chain is broken."""
    from genmojo_core.store import audit, project_file
    from genmojo_core.store.atomic import check_writable

    if args.output:
        check_writable(args.output)
    path = Path(args.file)
    loaded = project_file.load(path)
    faults = project_file.verify(path)
    every = audit.entries(path)
    found = [e for e in every
             if (args.track is None or e.touches(args.track)) and (args.person is None or e.row.who == args.person)
             and (e.stands or not args.standing)]  # fmt: skip
    if args.output:
        people = {name for e in every for name in e.people}
        audit.write(found, args.output, loaded.info.name, loaded.annotation.meta.get("consent", ""), people)
    return {"file": args.file, "lines": len(found), "undone": sum(not e.stands for e in found), "whole": not faults,
            "faults": faults, **({"path": args.output} if args.output else {}),
            "exit_code": 2 if faults else 0}  # fmt: skip


def run_times(args: argparse.Namespace) -> dict[str, Any]:
    """Figures of each clip, and of each person where all projects have consent."""
    from genmojo_core.errors import GenmojoError
    from genmojo_core.store import audit, project_file, work_figures
    from genmojo_core.store.atomic import check_writable

    if args.stride is not None and args.stride < 1:
        raise GenmojoError("argument", "must be 1 or more", "--stride")
    if args.output:
        check_writable(args.output)
    rows, consents = [], []
    for name in args.files:
        loaded = project_file.load(Path(name))
        consents.append(loaded.annotation.meta.get("consent", ""))
        stride = args.stride or work_figures.stride_of(Path(name))
        rows += work_figures.figures(loaded.annotation, audit.entries(Path(name)), loaded.info.name, stride)
    consent = "yes" if all(c == "yes" for c in consents) else ""
    if args.output:
        work_figures.write(rows, args.output, consent)
    return {"consent": consent or "no", "rows": work_figures.given(rows, consent),
            **({"path": args.output} if args.output else {})}  # fmt: skip
