"""`genmojo`: one command per job (ARCHITECTURE.md section 5).

Exit codes: 0 done, 2 bad input (one sentence on stderr), 130 interrupted (the work is kept), 1 a fault of ours.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from types import TracebackType

from genmojo_core import __version__
from genmojo_core.cli import (
    ablate,
    demo,
    export,
    files,
    optimise,
    pictures,
    priors,
    records,
    scores,
    selftest,
    track_files,
    tradeoff,
)
from genmojo_core.cli.arguments import Parser
from genmojo_core.cli.output import say, show
from genmojo_core.errors import GenmojoError

INTERRUPTED = 130


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command; returns its exit code. Faults of ours are raised (exit 1 with a traceback, see `_report`)."""
    if argv is None:
        sys.excepthook = _report
    try:
        args = _parser().parse_args(argv)
        result = args.run(args)
        code = int(result.pop("exit_code", 0))
        show(result, args.json)
        return code
    except GenmojoError as error:
        say(error.sentence())
        return 2
    except KeyboardInterrupt:
        say("Interrupted; nothing was written.")
        return INTERRUPTED


def _parser() -> Parser:
    """All commands."""
    parser = Parser(prog="genmojo", description="Multi-object video to 4D Gaussian scenes and point tracks.")
    parser.add_argument("--version", action="version", version=f"genmojo {__version__}")
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for group in (
        demo,
        optimise,
        pictures,
        scores,
        files,
        export,
        track_files,
        records,
        priors,
        ablate,
        tradeoff,
        selftest,
    ):
        group.add_commands(commands)
    for command in commands.choices.values():
        command.add_argument("--json", action="store_true", help="one JSON object on stdout")
    return parser


def _report(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
    """The traceback of a fault of ours, and what to do with it."""
    sys.__excepthook__(kind, error, trace)
    say(f"This is a fault of genmojo {__version__}, not of your input; please report it with the lines above and the "
        "command you gave.")  # fmt: skip


if __name__ == "__main__":
    sys.exit(main())
