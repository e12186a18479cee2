"""Rows of issue 7 about accuracy against time: the reports of four clips, and forecasts of clips left out.

The reports count CPU seconds, which other work on the machine changes little; each takes eight to twenty CPU minutes,
and its rows lie in DIR/reports, so that an interrupted one goes on where it stopped. Schedules that know their budget
are compared with the presets at longer times in rows of their own.
"""

from __future__ import annotations

import json
import re
from typing import Any

from table import Bench, Check, Rows

CLIPS = {"crossing": "0:24", "gold-fish": "0:24", "blender-cross": "", "blender-trio": ""}
NOISE = 0.2  # dB that two runs of the same settings may differ by
REPORT = ("--seeds", "1", "--clock", "cpu", "--json")


def report(name: str) -> Rows:
    """The report on one clip: whole, alone on its page, and the schedule that knows its budget at least as good."""

    def row(bench: Bench) -> list[Check]:
        folder = bench.work / "reports" / name
        frames = ("--frames", CLIPS[name]) if CLIPS[name] else ()
        command = ("-m", "genmojo_core.cli.main", "tradeoff", str(bench.data / name), "-o", str(folder), *frames)
        told = json.loads(bench.python(*command, *REPORT, "--budget", "1200s", "--moments", "30s,60s,120s"))
        page = (folder / "tradeoff.html").read_text()
        alone = not re.search(r"https?://|src=|<script|@import|url\(", page)
        checks = [Check("trials", told["trials"], 20), Check("page stands alone", float(alone), 1),
                  Check("effects and loss terms", len(told["parts"]), 8), Check("exponents", len(told["growth"]), 5),
                  Check("sentences of advice", len(told["advice"]), 2)]  # fmt: skip
        return [*checks, *_leads(told)]

    return {f"report-{name}": (f"tradeoff {name}", row)}


def auto(name: str, moment: int) -> Rows:
    """The schedule that knew of a moment against presets stopped then: three runs of one clip."""

    def row(bench: Bench) -> list[Check]:
        folder = bench.work / "auto" / f"{name}-{moment}"
        frames = ("--frames", CLIPS[name]) if CLIPS[name] else ()
        command = ("-m", "genmojo_core.cli.main", "tradeoff", str(bench.data / name), "-o", str(folder), *frames)
        enough = 100 + moment  # seconds: draft and standard take less, then auto begins and nothing after it
        told = json.loads(bench.python(*command, *REPORT, "--budget", f"{enough}s", "--moments", f"{moment}s"))
        return _leads(told)

    return {f"auto-{moment}-{name}": (f"auto against presets, {moment} s, {name}", row)}


def _leads(told: dict[str, Any]) -> list[Check]:
    """How far the schedule that knew its budget is above the best preset, at every moment of a report."""
    checks = []
    for entry in told["auto"]:
        best = max((o["psnr"] for o in entry["others"].values()), default=None)
        checks.append(Check(f"auto dB at {entry['moment']:g} s", entry["auto"]))
        if best is not None:
            checks.append(Check("above the best preset", entry["auto"] - best, -NOISE))
    return checks


def forecasts(bench: Bench) -> list[Check]:
    """Seconds and decibels foretold for each clip by a model of the others."""
    out = bench.work / "forecast.json"
    folders = [str(p) for p in sorted((bench.work / "reports").iterdir()) if (p / "rows").is_dir()]
    bench.python("-m", "tests.benchmarks.forecast", *folders, "--json", str(out))
    rows = json.loads(out.read_text())["rows"]
    off = [abs(r["told_db"] - r["psnr"]) for r in rows]
    time = [abs(r["told_s"] / r["seconds"] - 1) for r in rows if r["free"]]
    pace = [abs(r["told_steps"] / r["steps"] - 1) for r in rows if r["steps"]]
    return [
        Check("clips", len(folders)), Check("runs", len(rows)),
        Check("% within 1.0 dB", 100 * sum(o <= 1.0 for o in off) / len(off), 100),
        Check("largest dB off", max(off)),
        Check("% of seconds within 25 %", 100 * sum(t <= 0.25 for t in time) / len(time) if time else None, 100),
        Check("% of steps got to within 25 %", 100 * sum(p <= 0.25 for p in pace) / len(pace) if pace else None, 100),
    ]  # fmt: skip


REPORTS: Rows = {**report("crossing"), **report("gold-fish"), **report("blender-cross"), **report("blender-trio")}
AUTO: Rows = {**auto("crossing", 120), **auto("blender-cross", 120), **auto("crossing", 300)}
