"""The report of `genmojo tradeoff`: one HTML page that needs nothing beside it, its main chart as PNG, all as JSON."""

from __future__ import annotations

import html
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from genmojo_core.measure import tradeoff_figures as figures
from genmojo_core.measure.charts import DIM, INK, SERIES, Chart, Series, table
from genmojo_core.store.atomic import write_bytes
from genmojo_core.store.safe import json_text

Row = Mapping[str, Any]
SHOWN = 6  # trials left out that are named

_STYLE = """
body{font:16px/1.5 system-ui,-apple-system,"Segoe UI",Roboto,sans-serif;color:#1a1a1a;max-width:58rem;
 margin:3rem auto;padding:0 1.2rem}
h1{font-size:1.7rem;line-height:1.2;margin:0 0 .2rem}
h2{font-size:1.15rem;margin:2.6rem 0 .5rem}
p.lead{color:#666;margin:.1rem 0 1.2rem}
figure{margin:1rem 0}
svg{max-width:100%;height:auto;font:12px system-ui,-apple-system,"Segoe UI",Roboto,sans-serif}
figcaption,p.note{color:#666;font-size:.86rem;max-width:48rem}
ul.advice{background:#f3f7fa;border-left:4px solid #0072b2;padding:.8rem 1rem .8rem 2.2rem;margin:1rem 0}
table{border-collapse:collapse;font-size:.86rem;font-variant-numeric:tabular-nums;margin:.6rem 0;width:100%}
th{font-weight:600;border-bottom:2px solid #1a1a1a;vertical-align:bottom}
td{border-bottom:1px solid #e4e4e4;white-space:nowrap}
th,td{padding:.26rem .5rem;text-align:right}
th:first-child,td:first-child{text-align:left}
tr.strong td{font-weight:600;background:#f3f7fa}
.pair{display:flex;flex-wrap:wrap;gap:.5rem}
.scroll{overflow-x:auto}
.good{color:#00694c}
.bad{color:#a33f00}
@media print{body{margin:0 auto}}
"""


def write(name: str, rows: list[dict[str, Any]], left: list[str], folder: Path) -> dict[str, Any]:
    """Write tradeoff.html, .png and .json; returns what `genmojo tradeoff --json` prints. Raises GenmojoError("io")."""
    told = summary(name, rows, left)
    write_bytes(folder / "tradeoff.json", json_text({**told, "rows": rows}, indent=1).encode())
    write_bytes(folder / "tradeoff.html", page(told, rows).encode())
    write_bytes(folder / "tradeoff.png", accuracy_chart(rows).png(f"Accuracy against time on {name}"))
    return {"path": str(folder / "tradeoff.html"), **told}


def summary(name: str, rows: Sequence[Row], left: Sequence[str]) -> dict[str, Any]:
    """Everything that the rows say, without the rows."""
    front = figures.pareto(figures.points(rows))
    return {
        "clip": name,
        "trials": len(rows),
        "left_out": list(left),
        "seconds": sum(float(r.get("took", 0)) for r in rows),
        "advice": figures.advice(rows),
        "pareto": [vars(p) for p in front],
        "runs": figures.shares_table(rows),
        "auto": figures.against_auto(rows),
        "parts": figures.parts_table(rows),
        "step_ms": figures.base_step_ms(rows),
        "growth": figures.growth_table(rows),
    }


def page(told: Mapping[str, Any], rows: Sequence[Row]) -> str:
    """The HTML page."""
    title = f"Accuracy against time: {told['clip']}"
    first = next(iter(rows), None)
    about = (
        ""
        if first is None
        else (
            f"{max(r['frames'] for r in rows):.0f} frames, {max(r['objects'] for r in rows):.0f} objects. "
            f"{told['trials']} trials, "
            f"{told['seconds'] / 60:.0f} minutes of runs. Every 8th frame and 2 % of the foreground are held out."
        )
    )
    parts = [
        f"<h1>{html.escape(title)}</h1><p class=lead>{html.escape(about)}</p>",
        _list(told["advice"], "advice"),
        *_curves(told, rows),
        *_auto(told),
        *_parts(told),
        *_growth(told),
        _left_out(told["left_out"]),
    ]
    return (
        f'<!doctype html><html lang="en"><meta charset="utf-8"><meta name="viewport" '
        f'content="width=device-width,initial-scale=1"><title>{html.escape(title)}</title><style>{_STYLE}</style>'
        f"<body>{''.join(parts)}</body></html>"
    )


def accuracy_chart(rows: Sequence[Row]) -> Chart:
    """Scored moments of every preset and the front of the best."""
    chart = Chart(_seconds_of(rows), "foreground PSNR (dB)", log_x=True)
    points = figures.points(rows)
    names = list(dict.fromkeys(_family(p.title) for p in points))
    for i, name in enumerate(names):
        own = [(p.seconds, p.psnr) for p in points if _family(p.title) == name]
        chart.series.append(Series(name, own, SERIES[i % len(SERIES)], line=False, dots=True))
    front = figures.pareto(points)
    steps = [(p.seconds, p.psnr) for p in front]
    stairs = [s for a, b in zip(steps, steps[1:], strict=False) for s in (a, (b[0], a[1]))] + steps[-1:]
    chart.series.append(Series("best for its time", stairs, INK, width=1.2))
    return chart


def _seconds_of(rows: Sequence[Row]) -> str:
    """The title of a time axis."""
    cpu = any(figures.clock_of(row) == "cpu_seconds" for row in rows)
    return "CPU seconds of the run" if cpu else "seconds of the run"


def _family(title: str) -> str:
    """ "draft" for "draft, 30 s"."""
    return title.split(",")[0]


def _curves(told: Mapping[str, Any], rows: Sequence[Row]) -> list[str]:
    """Front, held-out curves and the table of runs."""
    held = Chart(_seconds_of(rows), "held-out PSNR (dB)", log_x=True, size=(760, 340))
    shown = [r for r in rows if r["kind"] == "preset" and r["seed"] == 0]
    names = list(dict.fromkeys(_family(r["title"]) for r in shown))
    for row in shown:
        curve = [(p[figures.clock_of(row)], p["psnr_held_out"]) for p in row["curve"]]
        name = _family(row["title"])
        first = next(r for r in shown if _family(r["title"]) == name) is row
        held.series.append(Series(name if first else "", curve, SERIES[names.index(name) % len(SERIES)], width=1.4))
    return [
        "<h2>What a second buys</h2>",
        _figure_of(accuracy_chart(rows), "Every dot is a scene that could be had: a run stopped there, rendered at 256 "
                   "pixels and compared with the clip. The line joins those that no other beats."),
        _figure_of(held, "The same runs on their held-out 4 × 4 blocks, as logged every 20 steps (seed 0). Blocks of "
                   "frames that have not come into play yet do not count, so curves may dip."),
        _runs(told),
        "<p class=note>PSNR: foreground, mean over frames. Held-out: blocks in no loss. Held frames: whole frames that "
        "the run never saw, rendered at their time. ATE: pixels of 256 × 256, against truth. Last columns: seconds "
        "until a share of the held-out accuracy between the curve's first and best value is reached. Set off: on the "
        "front. ± is the standard deviation over seeds.</p>",
    ]  # fmt: skip


def _runs(told: Mapping[str, Any]) -> str:
    """The table of presets and sizes."""
    wanted = ("ssim", "psnr_held_frames", "ate", "novel_psnr", "novel_iou")
    keys = [key for key in wanted if any(key in e for e in told["runs"])]
    lines = []
    for e in told["runs"]:
        numbers = [_figure(e.get(k), _DIGITS.get(k, 2)) for k in ("psnr_held_out", *keys)]
        reached = [_figure(e["reached"][s], 0) for s in ("90%", "95%", "99%")]
        lines.append([e["title"], str(e["runs"]), _figure(e["seconds"], 0), _figure(e["cpu_seconds"], 0),
                      _figure(e["steps"], 0), _with_spread(e, "psnr"), *numbers, *reached])  # fmt: skip
    heads = ["run", "seeds", "s", "CPU s", "steps", *(_HEADS[k] for k in ("psnr", "psnr_held_out", *keys)),
             "s to 90 %", "95 %", "99 %"]  # fmt: skip
    best = [p["title"] for p in told["pareto"]]
    strong = [i for i, e in enumerate(told["runs"]) if e["title"] in best]
    return f"<div class=scroll>{table(heads, lines, strong)}</div>"


_HEADS = {
    "ssim": "SSIM",
    "psnr_held_frames": "held frames dB",
    "ate": "ATE px",
    "novel_psnr": "unseen views dB",
    "novel_iou": "unseen IoU",
    "instance_iou": "IoU",
    "psnr": "PSNR dB",
    "psnr_held_out": "held-out dB",
}
_DIGITS = {"ssim": 3, "novel_iou": 3, "instance_iou": 3}


def _auto(told: Mapping[str, Any]) -> list[str]:
    """The budget-aware schedule against presets stopped at the same moment."""
    if not told["auto"]:
        return []
    names = list(dict.fromkeys(name for e in told["auto"] for name in e["others"]))
    lines = []
    for e in told["auto"]:
        cells = [f"{e['moment']:g} s", f"{e['auto']:.2f}"]
        for name in names:
            other = e["others"].get(name)
            cells += ["", ""] if other is None else [f"{other['psnr']:.2f}", _signed(other["lead"], 2)]
        lines.append(cells)
    heads = ["stopped at", "auto dB", *(h for name in names for h in (f"{name} dB", "lead dB"))]
    return [
        "<h2>The schedule that knows its budget</h2>",
        table(heads, lines),
        "<p class=note>Foreground PSNR. A fixed preset is stopped at the moment, or stands with what it ended with "
        "before. Runs of one moment follow each other, so that other work on the machine hits them alike.</p>",
    ]


def _parts(told: Mapping[str, Any]) -> list[str]:
    """Cost and gain of effects and loss terms."""
    if not told["parts"]:
        return []
    keys = [
        k
        for k in ("psnr", "psnr_held_out", "psnr_held_frames", "instance_iou", "ate", "novel_psnr")
        if any(k in e["gain"] for e in told["parts"])
    ]
    lines = []
    for e in told["parts"]:
        kind = "loss term" if e["kind"] == "loss" else "effect" if e["on"] else "effect, off as planned"
        share = f"{100 * e['ms'] / told['step_ms']:.0f} %" if told["step_ms"] else ""
        gains = [_signed(e["gain"].get(k), _DIGITS.get(k, 2), k == "ate") for k in keys]
        lines.append([e["title"], kind, f"{e['ms']:.1f}", share, f"{e['mb']:.1f}", *gains])
    heads = ["part", "", "ms a step", "share", "MB", *(_HEADS[k] for k in keys)]
    runs = max(e["runs"] for e in told["parts"])
    return [
        "<h2>What each part costs and brings</h2>",
        f"<div class=scroll>{table(heads, lines)}</div>",
        f"<p class=note>Small runs (128 pixels, 1000 Gaussians per object, {told['step_ms'] or 0:.0f} ms of CPU time a "
        f"step) with one part taken away or added, equal steps, the same initial motion, {runs} "
        f"seed{'s' * (runs > 1)}. "
        "Milliseconds: taken out of one step of the run; of unseen views: between two runs. "
        "MB: optimised numbers with gradients and moments, and channels. What it brings: with the part minus "
        "without; more dB and fewer px are better. Differences under about 0.1 dB are within one run's noise.</p>",
    ]


def _growth(told: Mapping[str, Any]) -> list[str]:
    """Fitted exponents and their points."""
    if not told["growth"]:
        return []
    charts, lines = [], []
    for i, e in enumerate(told["growth"]):
        unit = "CPU ms" if e["what"] == "a step" else "CPU s"
        lines.append(
            [
                f"{e['what']} with {e['vary']}",
                f"{e['exponent']:.2f} ± {e['error']:.2f}",
                str(len(e["points"])),
                " · ".join(f"{y:.3g}" for _, y in _means(e["points"])) + f" {unit}",
            ]
        )
        chart = Chart(str(e["vary"]), f"{unit} of {e['what']}", log_x=True, log_y=True, size=(370, 240), legend=False)
        chart.series = [Series("", e["points"], SERIES[i % len(SERIES)], line=False, dots=True), _fitted(e)]
        charts.append(f"<figure>{chart.svg()}</figure>")
    return [
        "<h2>How cost grows</h2>",
        table(["CPU time of", "exponent", "measured", "from fewest to most"], lines),
        f"<div class=pair>{''.join(charts)}</div>",
        "<p class=note>t = c·nᵏ fitted to logarithms, k ± standard error. 0 means that it does not matter, 1 that "
        "twice as "
        "much takes twice as long. A step splats a fixed number of frames, so it does not grow with the clip.</p>",
    ]


def _fitted(entry: Mapping[str, Any]) -> Series:
    """The power law through the middle of the points."""
    x, y = ([p[i] for p in entry["points"]] for i in (0, 1))
    middle = [sum(math.log10(v) for v in values) / len(values) for values in (x, y)]
    ends = [min(x), max(x)]
    line = [(e, 10.0 ** (middle[1] + entry["exponent"] * (math.log10(e) - middle[0]))) for e in ends]
    return Series("", line, DIM, width=1.2, dashed=True)


def _means(points: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    """Mean of y for each x."""
    return [
        (x, sum(b for a, b in points if a == x) / sum(a == x for a, _ in points))
        for x in sorted({p[0] for p in points})
    ]


def _left_out(left: Sequence[str]) -> str:
    """What there was no time for."""
    if not left:
        return ""
    more = f" and {len(left) - SHOWN} more" if len(left) > SHOWN else ""
    said = f"No time for {len(left)} trials: {'; '.join(left[:SHOWN])}{more}. The same command with "
    said += "a larger --budget goes on where this ended."
    return f"<p class=note>{html.escape(said)}</p>"


def _figure_of(chart: Chart, caption: str) -> str:
    return f"<figure>{chart.svg()}<figcaption>{html.escape(caption)}</figcaption></figure>"


def _list(sentences: Sequence[str], kind: str) -> str:
    items = "".join(f"<li>{html.escape(s)}</li>" for s in sentences)
    return f"<ul class={kind}>{items}</ul>" if items else ""


def _figure(value: float | None, digits: int) -> str:
    return "" if value is None else f"{value:.{digits}f}"


def _with_spread(entry: Mapping[str, Any], key: str) -> str:
    text = f"{entry[key]:.2f}"
    return f"{text} ± {entry['spread'][key]:.2f}" if entry["runs"] > 1 else text


def _signed(value: float | None, digits: int, less_is_better: bool = False) -> str:
    """+0.12 in the colour of good or bad; nothing for nothing."""
    if value is None:
        return ""
    if round(abs(value), digits) == 0:
        return f"{0:.{digits}f}"
    good = (value < 0) == less_is_better
    text = f"{value:+.{digits}f}".replace("-", "−")
    return f"<span class={'good' if good else 'bad'}>{text}</span>"
