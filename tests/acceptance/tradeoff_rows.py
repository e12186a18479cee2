"""Rows of issue 7 about accuracy against time: the reports of four clips, and forecasts of clips left out.

The reports count CPU seconds, which other work on the machine changes little; each takes eight to twenty CPU minutes,
and its rows lie in DIR/reports, so that an interrupted one goes on where it stopped. Schedules that know their budget
are compared with the presets at longer times in rows of their own. What forecasts are judged on lies in DIR/forecast, a
folder a clip.
"""

from __future__ import annotations

import json
import re
import shutil
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

from table import Bench, Check, Rows

from genmojo_core.clip.synthetic import generate
from genmojo_core.clip.synthetic_effects import made_clip
from genmojo_core.clip.synthetic_files import write
from genmojo_core.config import preset
from genmojo_core.effects import decide
from genmojo_core.estimate.masks import Box
from genmojo_core.measure import trials
from genmojo_core.measure.pilot_run import piloted
from genmojo_core.measure.scoring import Scorer
from genmojo_core.store.safe import json_text

CLIPS = {"crossing": "0:24", "gold-fish": "0:24", "blender-cross": "", "blender-trio": ""}
NOISE = 0.2  # dB that two runs of the same settings may differ by
MADE = (203, 213)  # seeds of made clips that forecasts are judged on beside the shared ones
UNSEEN = {"crossing": "28:52", "gold-fish": "40:64", **dict.fromkeys(("made-301", "made-302", "made-303"), "0:24")}
BOXES: dict[str, Box] = {"bear": Box(0, 70, 150, 500, 430, 1), "cups": Box(0, 560, 282, 745, 550, 1)}
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
    """Seconds and decibels foretold for each clip by a model of the others, dB from pilots of the clips."""
    names = [*CLIPS, "tennis", "dogs-jump", *BOXES, *(f"made-{seed}" for seed in MADE)]
    pilots, folders = {}, []
    for name in names:
        folder = bench.work / "forecast" / name
        pilots[name] = _judged(bench, name, folder)
        folders.append(str(folder))
        for row in sorted((bench.work / "reports" / name / "rows").glob("*.json")):
            shutil.copy(row, folder / "rows" / row.name)
    told, out = bench.work / "forecast" / "pilots.json", bench.work / "forecast.json"
    told.write_text(json.dumps(pilots))
    bench.python("-m", "tests.benchmarks.forecast", *folders, "--pilots", str(told), "--json", str(out))
    rows = json.loads(out.read_text())["rows"]
    by_clip = {name: [abs(r["told_db"] - r["psnr"]) for r in rows if r["clip"] == name] for name in names}
    off = [one for own in by_clip.values() for one in own]
    mean = sum(sum(own) / len(own) for own in by_clip.values()) / len(by_clip)
    time = [abs(r["told_s"] / r["seconds"] - 1) for r in rows if r["free"]]
    pace = [abs(r["told_steps"] / r["steps"] - 1) for r in rows if r["steps"]]
    return [
        Check("clips", len(folders)), Check("runs", len(rows)), Check("dB off per clip on average", mean, 1.0, True),
        Check("% within 1.0 dB", 100 * sum(o <= 1.0 for o in off) / len(off), 100), Check("largest dB off", max(off)),
        Check("% of seconds within 25 %", 100 * sum(t <= 0.25 for t in time) / len(time) if time else None, 100),
        Check("% of steps got to within 25 %", 100 * sum(p <= 0.25 for p in pace) / len(pace) if pace else None, 100),
    ]  # fmt: skip


def told(bench: Bench) -> list[Check]:
    """What `genmojo optimize` foretold and what came, on frames and made clips that nothing was fitted on."""
    came = {}
    for name, frames in UNSEEN.items():
        folder = bench.work / "told" / name
        kept = folder / "outcome.json"
        if not kept.exists():
            folder.mkdir(parents=True, exist_ok=True)
            path = _made(name, folder) if name.startswith("made-") else bench.data / name
            options = (str(path), "--frames", frames, "--preset", "draft", "--json")
            command = ("-m", "genmojo_core.cli.main")
            bench.python(*command, "effects", *options, "--pilot")
            found = bench.python(*command, "optimize", *options, "-o", str(folder / "scene.h5"), "--budget", "1200")
            kept.write_text(json.dumps(json.loads(found)["forecast"]))
        came[name] = json.loads(kept.read_text())
    decibels = [abs(one["psnr_off"]) for one in came.values()]
    seconds = [abs(one["seconds_off"]) for one in came.values()]
    checks = [Check(f"{name}: dB off", one["psnr_off"]) for name, one in came.items()]
    return [
        *checks, Check("dB off on average", sum(decibels) / len(decibels), 1.0, True),
        Check("% within 1.0 dB", 100 * sum(d <= 1.0 for d in decibels) / len(decibels), 100),
        Check("% of seconds within 25 %", 100 * sum(s <= 0.25 for s in seconds) / len(seconds), 100),
        Check("largest part of seconds off", max(seconds)),
    ]  # fmt: skip


def _made(name: str, folder: Path) -> Path:
    """The clip of a seed, "made-203", written into a folder."""
    path = folder / "clip"
    write(*generate(replace(made_clip(int(name[5:])).spec, name=name, frames=24, size=(320, 240))), path)
    return path


def _judged(bench: Bench, name: str, folder: Path) -> dict[str, float]:
    """Whole runs of a clip, their rows in folder/rows, and the clip's pilot; all kept.

    Drafts, and of the reports' clips `standard` too: pilots are sent ahead of such runs, which no report has.
    """
    told, presets = folder / "pilot.json", ("draft", "standard") if name in CLIPS else ("draft",)
    rows = {one: folder / "rows" / f"{one}-whole.json" for one in presets}
    if told.exists() and all(row.exists() for row in rows.values()):
        return dict(json.loads(told.read_text()))
    (folder / "rows").mkdir(parents=True, exist_ok=True)
    path = bench.data / ("cups/cups.mp4" if name == "cups" else name)
    path = _made(name, folder) if name.startswith("made-") else path
    boxes = (BOXES[name],) if name in BOXES else ()
    config = preset("draft", clock="cpu", budget_seconds=1200.0, device="cpu")
    runs = trials.Bench(trials.Source(str(path), (0, 24), boxes))
    clip, _ = runs.clip(config)
    pilot = piloted(clip, decide.plan(clip, config), Scorer(str(path), (0, 24), clip).measured(), lambda _: None)
    for one, row in rows.items():
        if not row.exists():
            whole = trials.Trial(one, "preset", one, preset(one, clock="cpu", budget_seconds=1200.0, device="cpu"))
            row.write_text(json_text(runs.run(whole, lambda _: None)))
    told.write_text(json.dumps(asdict(pilot)))
    return asdict(pilot)


REPORTS: Rows = {**report("crossing"), **report("gold-fish"), **report("blender-cross"), **report("blender-trio")}
AUTO: Rows = {**auto("crossing", 120), **auto("blender-cross", 120), **auto("crossing", 300)}
