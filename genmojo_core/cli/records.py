"""`genmojo log`: the audit log of a project as a table, and whether it is as it was written."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any


def add_commands(commands: Any) -> None:
    """Add `log`."""
    log = commands.add_parser("log", help="who did what to an annotation: checks its chain, writes CSV or JSON")
    log.add_argument("file", metavar="FILE.genmojo")
    log.add_argument("-o", "--output", metavar="LOG.csv|LOG.json", help="names and times only where consent is given")
    log.add_argument("--track", type=int, metavar="ID", help="only edits of one track")
    log.add_argument("--person", metavar="NAME", help="only edits of one person")
    log.add_argument("--standing", action="store_true", help="leave out what was undone")
    log.set_defaults(run=run_log)


def run_log(args: argparse.Namespace) -> dict[str, Any]:
    """Check the chain, write the lines asked for; exit 2 if the chain is broken."""
    from genmojo_core.store import audit, project_file
    from genmojo_core.store.atomic import check_writable

    if args.output:
        check_writable(args.output)
    path = Path(args.file)
    loaded = project_file.load(path)
    faults = project_file.verify(path)
    found = [e for e in audit.entries(path)
             if (args.track is None or e.touches(args.track)) and (args.person is None or e.row.who == args.person)
             and (e.stands or not args.standing)]  # fmt: skip
    if args.output:
        audit.write(found, args.output, loaded.info.name, loaded.annotation.meta.get("consent", ""))
    return {"file": args.file, "lines": len(found), "undone": sum(not e.stands for e in found), "whole": not faults,
            "faults": faults, **({"path": args.output} if args.output else {}),
            "exit_code": 2 if faults else 0}  # fmt: skip
