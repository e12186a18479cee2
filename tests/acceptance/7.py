"""Issue 7, "Shown by": accuracy against time, effects planned rightly that cost nothing when off, stable hard cases.

    python tests/acceptance/7.py --work DIR [--only shared,hard,...] [--again] [--data ../shared/data]

Results are kept in DIR/results, decisions on made clips in DIR/plans, so an interrupted run goes on where it stopped;
--again measures anew. Prints the table as Markdown and writes it with all figures to DIR/7.json; misses of the plan are
in DIR/misses.json, the shared clips' effect tables in DIR/shared_effects.json.
"""

from __future__ import annotations

import sys

from effect_rows import full, misses, right, shared, simple, spared
from hard_case_rows import coverage, hard, mutations, soak
from table import Rows, main
from tradeoff_rows import AUTO, REPORTS, forecasts, told

ROWS: Rows = {
    **REPORTS,
    **AUTO,
    "forecast": ("forecasts, each clip by a model of the others", forecasts),
    "told": ("forecasts of clips that nothing was fitted on", told),
    "shared": ("evidence and decisions, shared clips", shared),
    "right": ("decisions on made clips", right),
    "spared": ("objects that stay rigid beside ones that bend", spared),
    "misses": ("what wrong decisions cost", misses),
    "simple": ("planned against all effects, one rigid object", simple),
    "full": ("planned against all effects, blender-trio", full),
    "hard": ("hard cases on this machine", hard),
    "mutations": ("guards taken away in turn", mutations),
    "coverage": ("rows N01 to N33 have tests", coverage),
    "soak": ("20,000 steps on a hostile clip", soak),
}


if __name__ == "__main__":
    sys.exit(main(ROWS, __doc__, "7"))
