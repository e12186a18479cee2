"""What the rows of `genmojo tradeoff` say: best accuracy for any time, cost and gain of parts, growth, advice."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

SHARES = (0.90, 0.95, 0.99)
GAIN = ("psnr", "psnr_held_out", "psnr_held_frames", "ate", "instance_iou", "novel_psnr", "novel_iou")
Row = Mapping[str, Any]


@dataclass(frozen=True)
class Point:
    """A scene that could be had: seconds of the run, foreground PSNR in dB, and the trial it comes from."""

    seconds: float
    psnr: float
    title: str


def clock_of(row: Row) -> str:
    """Which seconds count in a row: those that its budget counted."""
    return "cpu_seconds" if row["config"].get("clock") == "cpu" else "seconds"


def points(rows: Sequence[Row]) -> list[Point]:
    """Scored moments and ends of all presets and sizes, seeds averaged where several ran."""
    found: dict[tuple[str, float], list[tuple[float, float]]] = {}
    for row in rows:
        if row["kind"] not in ("preset", "size"):
            continue
        key = clock_of(row)
        scored = [(p[key], p["psnr"]) for p in row["curve"] if "psnr" in p] + [(row[key], row["psnr"])]
        for i, (seconds, psnr) in enumerate(scored):
            place = -1.0 if i == len(scored) - 1 else float(i)
            found.setdefault((row["title"], place), []).append((seconds, psnr))
    means = {key: np.mean(values, axis=0) for key, values in found.items()}
    return [Point(float(mean[0]), float(mean[1]), title) for (title, _), mean in means.items()]


def pareto(candidates: Sequence[Point]) -> list[Point]:
    """The points that no other beats: none is at least as good in no more time. Ascending in time."""
    front: list[Point] = []
    for point in sorted(candidates, key=lambda p: (p.seconds, -p.psnr)):
        if not front or point.psnr > front[-1].psnr:
            front.append(point)
    return front


def seconds_to_share(curve: Sequence[tuple[float, float]], share: float) -> float | None:
    """When a curve (seconds, dB) has come a share of the way from its first to its best value, between points in line.

    Dips count for nothing: what was reached once was reached. None for fewer than two points or no gain at all.
    """
    if len(curve) < 2:
        return None
    best = np.maximum.accumulate([value for _, value in curve])
    if best[-1] <= best[0]:
        return None
    wanted = best[0] + share * (best[-1] - best[0])
    i = int(np.argmax(best >= wanted - 1e-12))
    if i == 0:
        return float(curve[0][0])
    part = (wanted - best[i - 1]) / (best[i] - best[i - 1])
    return float(curve[i - 1][0] + part * (curve[i][0] - curve[i - 1][0]))


def exponent(x: Sequence[float], y: Sequence[float]) -> tuple[float, float] | None:
    """(k, standard error) of y = c x^k by least squares of logarithms; None for fewer than two different x.

    The error is 0 for exactly two points.
    """
    pairs = [(math.log(a), math.log(b)) for a, b in zip(x, y, strict=True) if a > 0 and b > 0]
    if len({a for a, _ in pairs}) < 2:
        return None
    lx, ly = np.array(pairs).T
    spread = float(((lx - lx.mean()) ** 2).sum())
    slope = float(((lx - lx.mean()) * (ly - ly.mean())).sum() / spread)
    rest = ly - ly.mean() - slope * (lx - lx.mean())
    error = math.sqrt(float((rest**2).sum()) / max(len(pairs) - 2, 1) / spread)
    return slope, error


def shares_table(rows: Sequence[Row]) -> list[dict[str, Any]]:
    """For every preset and size: final figures, steps, seconds, and seconds to SHARES of the held-out accuracy."""
    entries = []
    for title, group in _grouped(rows, ("preset", "size")).items():
        curves = [[(p[clock_of(r)], p["psnr_held_out"]) for p in r["curve"]] for r in group]
        reached = {s: [t for t in (seconds_to_share(c, s) for c in curves) if t is not None] for s in SHARES}
        entries.append(
            {
                "title": title,
                "kind": group[0]["kind"],
                "moment": group[0]["moment"],
                "runs": len(group),
                **_mean_spread(group, (*GAIN, "psnr_full", "ssim", "ssim_held_out", "mte", "seconds", "cpu_seconds")),
                "steps": float(np.mean([r["steps"] for r in group])),
                "size": group[0]["size"],
                "gaussians": float(np.mean([r["gaussians"] for r in group])),
                "reached": {f"{s:.0%}": float(np.mean(t)) if t else None for s, t in reached.items()},
            }
        )
    return entries


def parts_table(rows: Sequence[Row]) -> list[dict[str, Any]]:
    """Cost and gain of every effect and loss term: the planned small run against the one with it taken away or added.

    `ms`, `mb` and `gain` are what it costs and brings where it is there: positive ms = slower with it, positive dB =
    better with it, negative px = smaller track error with it. `noise` is the planned run's spread over seeds in dB.
    """
    base = {row["seed"]: row for row in rows if row["key"].startswith("base-")}
    entries = []
    for title, group in _grouped(rows, ("effect", "loss")).items():
        pairs = [(base[r["seed"]], r) for r in group if r["seed"] in base and not r["key"].startswith("base-")]
        if not pairs:
            continue
        sign = 1.0 if title.startswith("without") else -1.0
        gains = {key: [sign * (a[key] - b[key]) for a, b in pairs if key in a and key in b] for key in GAIN}
        entries.append(
            {
                "title": title.split(" ", 1)[1],
                "kind": group[0]["kind"],
                "on": sign > 0,
                "runs": len(pairs),
                "ms": float(np.mean([_cost(b["key"], *((a, b) if sign > 0 else (b, a))) for a, b in pairs])),
                "mb": float(np.mean([sign * (a["model_mb"] - b["model_mb"]) for a, b in pairs])),
                "gain": {key: float(np.mean(v)) for key, v in gains.items() if v},
                "spread": {key: float(np.std(v)) for key, v in gains.items() if len(v) > 1},
            }
        )
    return sorted(entries, key=lambda e: (e["kind"], -e["ms"]))


def _cost(key: str, there: Row, without: Row) -> float:
    """CPU ms a step of the part that a trial is about, as the run that has it took it out of one step.

    A part that such a run does not name has none in a step. The prior's views are none either, but follow each step:
    for them, and where nothing was taken out, the difference between two runs, which other work on the machine blurs.
    """
    kind, part = key.split("-")[:2]
    within = there.get("costs" if kind == "effect" else "term_costs")
    if within and part != "unseen_views":
        return float(within.get(part, 0.0))
    return float(_step_ms(there) - _step_ms(without))


def base_step_ms(rows: Sequence[Row]) -> float | None:
    """CPU milliseconds of a step of the planned small run, on average; None without one."""
    there = [_step_ms(row) for row in rows if row["key"].startswith("base-")]
    return float(np.mean(there)) if there else None


def growth_table(rows: Sequence[Row]) -> list[dict[str, Any]]:
    """How CPU time grows with each varied quantity: fitted exponents with standard errors and what they rest on."""
    entries: list[dict[str, Any]] = []
    for vary in ("pixels", "Gaussians", "objects", "frames"):
        group = [row for row in rows if row["kind"] == "growth" and row["vary"] == vary]
        for what, label in (("step_ms", "a step"), ("motion_seconds", "search for motion")):
            there = [(_amount(row), float(row[what])) for row in group if what in row]
            found = exponent([a for a, _ in there], [b for _, b in there])
            if found is not None:
                entries.append(
                    {"vary": vary, "what": label, "exponent": found[0], "error": found[1], "points": sorted(there)}
                )
    return entries


def against_auto(rows: Sequence[Row]) -> list[dict[str, Any]]:
    """At every moment the budget-aware schedule against each preset stopped there: dB (mean over common seeds), each.

    A preset that ended by itself earlier stands for all later moments too.
    """
    entries = []
    presets = [r for r in rows if r["kind"] == "preset"]
    for moment in sorted({r["moment"] for r in presets}):
        ours = {r["seed"]: r for r in presets if r["moment"] == moment and r["title"].startswith("auto")}
        if not ours:
            continue
        entry: dict[str, Any] = {
            "moment": moment,
            "auto": float(np.mean([r["psnr"] for r in ours.values()])),
            "others": {},
        }
        for name in dict.fromkeys(r["title"].split(",")[0] for r in presets if not r["title"].startswith("auto")):
            stopped = [r for r in presets if r["title"].startswith(f"{name},") and r["moment"] <= moment]
            latest = max((r["moment"] for r in stopped), default=None)
            same = {r["seed"]: r for r in stopped if r["moment"] == latest}
            if latest != moment and any(
                r["reason"] == "budget" and r[clock_of(r)] >= 0.95 * r["moment"] for r in same.values()
            ):
                continue
            common = sorted(set(same) & set(ours))
            if common:
                lead = [ours[s]["psnr"] - same[s]["psnr"] for s in common]
                entry["others"][name] = {
                    "psnr": float(np.mean([same[s]["psnr"] for s in common])),
                    "lead": float(np.mean(lead)),
                    "runs": len(common),
                }
        entries.append(entry)
    return entries


def advice(rows: Sequence[Row]) -> list[str]:
    """What to do, in sentences with numbers."""
    front = pareto(points([row for row in rows if row["kind"] == "preset"]))
    said = []
    if front:
        first, best = front[0], front[-1]
        near = next((p for p in front if p.psnr >= best.psnr - 1.0), best)
        said.append(f"The best scene measured took {_time(best.seconds)} ({best.title}): {best.psnr:.1f} dB.")
        if near is not best:
            said.append(
                f"{near.psnr:.1f} dB stand after {_time(near.seconds)} ({near.title}): "
                f"{best.psnr - near.psnr:.1f} dB more cost {_time(best.seconds - near.seconds)}."
            )
        if first is not near and first is not best:
            said.append(
                f"The quickest, {first.title}, gives {first.psnr:.1f} dB after {_time(first.seconds)}; "
                f"{near.psnr - first.psnr:.1f} dB more cost {_time(near.seconds - first.seconds)}."
            )
    parts = parts_table(rows)
    total = base_step_ms(rows)
    dear = [e for e in parts if e["on"] and total and e["ms"] > 0.05 * total and e["gain"].get("psnr", 0.0) < 0.05]
    for entry in dear[:2]:
        said.append(
            f"{entry['title'].capitalize()} takes {100 * entry['ms'] / total:.0f} % of a step here and gains "
            f"{entry['gain'].get('psnr', 0.0):+.2f} dB{_tracks(entry)}."
        )
    worth = [e for e in parts if e["gain"].get("psnr", 0.0) > 0.2]
    if worth:
        top = max(worth, key=lambda e: e["gain"]["psnr"])
        said.append(
            f"{top['title'].capitalize()} is worth most: {top['gain']['psnr']:+.2f} dB for {top['ms']:.0f} ms a step."
        )
    return said


def _tracks(entry: Mapping[str, Any]) -> str:
    """ ", 0.3 px of track error" where truth tells."""
    return f" and {entry['gain']['ate']:+.2f} px of track error" if "ate" in entry["gain"] else ""


def _time(seconds: float) -> str:
    """ "45 s" or "2.5 min"."""
    return f"{seconds:.0f} s" if seconds < 100 else f"{seconds / 60:.1f} min"


def _amount(row: Row) -> float:
    """How much there is of what a growth row varies."""
    return {
        "pixels": float(row["size"][0] * row["size"][1]),
        "Gaussians": float(row["gaussians"]),
        "objects": float(row["objects"]),
        "frames": float(row["frames"]),
    }[row["vary"]]


def _step_ms(row: Row) -> float:
    """CPU milliseconds of one joint step."""
    joint = row["stages"]["joint"]
    return 1000 * joint["cpu_seconds"] / max(joint["steps"], 1)


def _grouped(rows: Sequence[Row], kinds: tuple[str, ...]) -> dict[str, list[Row]]:
    """Rows of some kinds by title, in their order; the seeds of a title together."""
    groups: dict[str, list[Row]] = {}
    for row in rows:
        if row["kind"] in kinds:
            groups.setdefault(row["title"], []).append(row)
    return groups


def _mean_spread(group: Sequence[Row], keys: tuple[str, ...]) -> dict[str, Any]:
    """Means of what all rows have, and their standard deviations under "spread"."""
    there = [key for key in keys if all(key in row for row in group)]
    return {key: float(np.mean([row[key] for row in group])) for key in there} | {
        "spread": {key: float(np.std([row[key] for row in group])) for key in there}
    }
