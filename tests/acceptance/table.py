"""Tables of an issue's figures: rows that each run programs of their own, kept as they come, printed as Markdown.

A row is a function from a `Bench` to `Check`s. An interrupted table goes on where it stopped.
"""

from __future__ import annotations

import argparse
import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))  # rows that measure in this process judge this checkout, whatever is installed


@dataclass
class Check:
    """One figure and what it must be: `at_most` or at least a limit; `limit` None is only reported."""

    name: str
    value: float | None
    limit: float | None = None
    at_most: bool = False

    @property
    def met(self) -> bool:
        """Whether the figure is what it must be."""
        if self.limit is None or self.value is None:
            return self.limit is None
        return self.value <= self.limit if self.at_most else self.value >= self.limit

    def text(self) -> str:
        """For the table."""
        shown = "none" if self.value is None else f"{self.value:.4g}"
        sign = "≤" if self.at_most else "≥"
        limit = "" if self.limit is None else f" ({sign} {self.limit:g}{'' if self.met else ', NOT MET'})"
        return f"{self.name} {shown}{limit}"


@dataclass
class Bench:
    """Where things are; `log` collects the commands of the row being measured."""

    work: Path
    data: Path
    log: list[str] = field(default_factory=list)

    def python(self, *argv: str, ends: tuple[int, ...] = (0,), **environment: str) -> str:
        """Standard output of `python ...` in the project's root. Raises RuntimeError where it ends in another way."""
        return self.run(sys.executable, *argv, ends=ends, **environment)

    def run(self, *argv: str, ends: tuple[int, ...] = (0,), **environment: str) -> str:
        """Standard output of a program in the project's root. Raises RuntimeError where it ends in another way."""
        self.log.append(" ".join(argv).replace(sys.executable, "python"))
        variables = {**os.environ, "PYTHONPATH": str(ROOT), "OPENBLAS_NUM_THREADS": "1", **environment}
        done = subprocess.run(list(argv), cwd=ROOT, env=variables, capture_output=True, text=True)
        if done.returncode not in ends:
            said = f"{done.stdout[-300:]} {done.stderr[-800:]}"
            raise RuntimeError(f"{self.log[-1]} ended with {done.returncode}: {said}")
        return done.stdout


Rows = dict[str, tuple[str, Callable[[Bench], list[Check]]]]


def main(rows: Rows, about: str, name: str) -> int:
    """Measure the rows that are asked for and not yet known, then print the table."""
    parser = argparse.ArgumentParser(description=about, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--work", type=Path, required=True, help="folder for results")
    parser.add_argument("--data", type=Path, default=ROOT.parent / "shared" / "data")
    parser.add_argument("--only", default="", help=f"comma-separated rows of {', '.join(rows)}")
    parser.add_argument("--again", action="store_true", help="measure anew what is known already")
    args = parser.parse_args()
    bench = Bench(args.work.resolve(), args.data.resolve())
    (bench.work / "results").mkdir(parents=True, exist_ok=True)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    for key in [key for key in args.only.split(",") if key] or rows:
        measure(bench, key, rows[key], args.again)
    report(bench, list(rows), name)
    return 0


def measure(bench: Bench, key: str, of: tuple[str, Callable[[Bench], list[Check]]], again: bool) -> None:
    """One row, unless its result is there already."""
    kept = bench.work / "results" / f"{key}.json"
    if kept.exists() and not again:
        return
    title, row = of
    print(f"{time.strftime('%H:%M:%S')} {key} ...", file=sys.stderr, flush=True)
    bench.log, start, failure = [], time.monotonic(), ""
    checks: list[Check] = []
    try:
        checks = row(bench)
    except (RuntimeError, OSError, KeyError, ValueError) as error:
        failure = f"{type(error).__name__}: {error}"
    commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], cwd=ROOT, capture_output=True, text=True).stdout
    result: dict[str, Any] = {
        "row": key, "title": title, "met": not failure and all(c.met for c in checks), "failure": failure,
        "checks": [{**asdict(c), "met": c.met, "text": c.text()} for c in checks], "commands": bench.log,
        "figures": {c.name: c.value for c in checks},
        "seconds": time.monotonic() - start, "commit": commit.strip(), "load": os.getloadavg()[0],
    }  # fmt: skip
    kept.write_text(json.dumps(result, indent=1))


def report(bench: Bench, keys: list[str], name: str) -> None:
    """The table of all known rows, and everything as JSON."""
    rows = [json.loads(path.read_text()) for key in keys if (path := bench.work / "results" / f"{key}.json").exists()]
    print("| what | figures (limit) | met | load | commit |\n|---|---|---|---|---|")
    for row in rows:
        shown = row["failure"].replace("\n", " ")[:400] or ", ".join(check["text"] for check in row["checks"])
        met = "yes" if row["met"] else "NO"
        print(f"| {row['title']} | {shown} | {met} | {row['load']:.1f} | {row['commit']} |")
    (bench.work / f"{name}.json").write_text(json.dumps(rows, indent=1))
