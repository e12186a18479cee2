"""How soon a window knows that and why its worker died: four kinds of death at random points, each resumed to the end.

    python tests/benchmarks/deaths.py [--points 20]

Seconds from the fault (the kill, or the worker's last word in exit.json) to the report, which names the right kind and
step; a wrong one ends the program. The worker is the tests' own, without torch. Goal: 2 s.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import statistics
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT), str(ROOT / "tests")]

from tests.crash.test_worker_death import KINDS, end_and_resume  # noqa: E402 - after the path is set


def main() -> None:
    """Measure and print one JSON object: per kind the number of deaths, the median and the longest seconds."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--points", type=int, default=20)
    args = parser.parse_args()
    found = {}
    for fault in ("killed", "shot", "allocate", "exception"):
        dice, seconds = random.Random(fault), []
        for _ in range(args.points):
            with tempfile.TemporaryDirectory() as folder:
                os.environ["GENMOJO_RUNS"] = folder
                run_dir = Path(folder) / "run"
                run_dir.mkdir()
                report, after = end_and_resume(run_dir, fault, dice.randint(0, 55))
                if report.kind != KINDS[fault]:
                    raise SystemExit(f"{fault} was called {report.kind}: {report}")
                seconds.append(after)
        found[fault] = {"deaths": len(seconds), "median_s": statistics.median(seconds), "longest_s": max(seconds)}
    print(json.dumps(found))


if __name__ == "__main__":
    main()
