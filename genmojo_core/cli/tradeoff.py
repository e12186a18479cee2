"""`genmojo tradeoff`: what accuracy costs in time on a clip, as a report that stands alone."""

from __future__ import annotations

import argparse
from typing import Any

from genmojo_core.cli import arguments
from genmojo_core.cli.output import progress, say
from genmojo_core.errors import GenmojoError


def add_commands(commands: Any) -> None:
    """Add `tradeoff`."""
    parser = commands.add_parser("tradeoff", help="accuracy against time on a clip: presets, sizes, effects, growth")
    parser.add_argument("clip", metavar="CLIP")
    parser.add_argument(
        "-o",
        "--output",
        required=True,
        metavar="DIR",
        help="report (HTML, PNG, JSON) and its rows; rows that lie there already are kept",
    )
    parser.add_argument(
        "--budget",
        type=arguments.seconds,
        default=1200.0,
        metavar="20m",
        help="nothing new begins after this much time of runs, those of earlier calls counted",
    )
    parser.add_argument("--seeds", type=int, default=3, metavar="N", help="repetitions, as far as the budget goes")
    parser.add_argument(
        "--moments",
        type=_moments,
        default=(30.0, 60.0, 120.0),
        metavar="30s,60s,2m",
        help="when presets are stopped and compared with the schedule that knew of it",
    )
    parser.add_argument("--presets", type=arguments.names, default=("draft", "standard"), metavar="a,b")
    parser.add_argument("--frames", type=arguments.frame_range, metavar="A:B", help="positions of the source")
    parser.add_argument(
        "--box",
        type=arguments.box,
        action="append",
        default=[],
        metavar="FRAME:X0,Y0,X1,Y1",
        help="one object in a clip without masks",
    )
    parser.add_argument("--device", default="auto")
    parser.add_argument("--clock", choices=("wall", "cpu"), default="wall", help="seconds that budgets count: CPU "
                        "seconds are comparable on a machine that others use too")  # fmt: skip
    parser.set_defaults(run=run_tradeoff)


def run_tradeoff(args: argparse.Namespace) -> dict[str, Any]:
    """Run what is missing, write the report. Ctrl-C keeps finished rows."""
    from pathlib import Path

    from genmojo_core.cli.optimise import boxes_of
    from genmojo_core.measure import effect_costs, tradeoff, tradeoff_page
    from genmojo_core.measure.trials import Source
    from genmojo_core.store.atomic import check_writable

    if args.seeds < 1:
        raise GenmojoError("argument", "at least one run per row is needed", "--seeds")
    folder = Path(args.output)
    check_writable(folder / "tradeoff.json")
    source = Source(args.clip, args.frames, tuple(boxes_of(args)))
    wanted = tradeoff.Wanted(source, args.budget, args.seeds, args.moments, args.presets, args.device, args.clock)
    told: list[str] = []
    with progress("trials") as tell:

        def hear(name: str, event: Any) -> None:
            if not told or told[-1] != name:
                told.append(name)
                say(f"{len(told)}: {name}")
            tell(getattr(event, "progress", 0.0))

        rows, left = tradeoff.tradeoff(wanted, folder, hear)
    report = tradeoff_page.write(Path(args.clip).name, rows, left, folder)
    effect_costs.keep_report(report)
    return report


def _moments(text: str) -> tuple[float, ...]:
    """ "30s,2m" as ascending seconds."""
    return tuple(sorted({arguments.seconds(part) for part in arguments.names(text)}))
