"""Rows of issue 7 on stability: hard cases, guards taken away in turn, which row of the study has which tests, soak."""

from __future__ import annotations

import json
import re

from table import Bench, Check

ROWS = [f"N{n:02d}" for n in range(1, 34)]  # of the reliability study


def hard(bench: Bench) -> list[Check]:
    """`genmojo selftest --hard`: every case, and how many do not hold."""
    told = json.loads(bench.python("-m", "genmojo_core.cli.main", "selftest", "--hard", "--json", ends=(0, 1)))
    (bench.work / "hard_cases.json").write_text(json.dumps(told["verdicts"], indent=1))
    return [Check("cases", told["cases"], 50), Check("broken", told["failed"], 0, at_most=True),
            Check("seconds", told["seconds"])]  # fmt: skip


def mutations(bench: Bench) -> list[Check]:
    """Guards taken away in turn: each must make a named case fail."""
    table = bench.python("-m", "tests.acceptance.mutations", "--kept", str(bench.work / "mutations.jsonl"), ends=(0, 1))
    (bench.work / "mutations.md").write_text(table)
    rows = table.strip().splitlines()[2:]
    return [Check("guards", len(rows), 20),
            Check("missed by nobody", sum("| NONE |" in row for row in rows), 0, at_most=True)]  # fmt: skip


def coverage(bench: Bench) -> list[Check]:
    """Which row of the study has which tests, by their names."""
    listed = bench.python("-m", "pytest", "--collect-only", "-q", "tests")
    tests: dict[str, set[str]] = {row: set() for row in ROWS}
    for line in listed.splitlines():
        for number in re.findall(r"(?<=_)n(\d\d)(?=_)", line.split("::")[-1]):
            tests.setdefault(f"N{number}", set()).add(line.split("[")[0])
    (bench.work / "rows.json").write_text(json.dumps({row: sorted(found) for row, found in tests.items()}, indent=1))
    bare = [row for row in ROWS if not tests[row]]
    if bare:
        bench.log.append(f"rows without a test of their name: {', '.join(bare)}")
    return [Check("rows with tests", len(ROWS) - len(bare), len(ROWS)), Check("tests", sum(map(len, tests.values())))]


def soak(bench: Bench) -> list[Check]:
    """20,000 steps on a hostile clip: no drift, no growth."""
    said = bench.python("-m", "pytest", "-q", "-s", "tests/hard_cases/test_soak.py", ends=(0, 1))
    (bench.work / "soak.txt").write_text(said)
    return [Check("holds", float("1 passed" in said), 1)]
