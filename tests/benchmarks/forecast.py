"""The forecast's numbers, fitted on rows of `genmojo tradeoff`, and its errors on clips left out.

    python -m tests.benchmarks.forecast REPORT_FOLDER... [--pilots FILE] [--json FILE]

Prints the `Model` to put into effects/forecast.py. Errors are leave-one-clip-out: every clip is foretold by a model
fitted on the others. Times are CPU seconds, so a busy machine does no harm; the rows must all come from one machine.
Rows of older code, whose steps cost something else, tell dB only: set their CPU seconds to null.
--pilots: {clip: Pilot.to_json}, as `genmojo effects CLIP --pilot --json` tells them in `forecast.clip`; clips that are
in it are foretold from their pilots.
"""

from __future__ import annotations

import argparse
import json
import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from genmojo_core.config import LearningRates, LossWeights, RunConfig
from genmojo_core.effects.difficulty import Difficulty
from genmojo_core.effects.forecast import (
    PILOT_SIDE,
    Model,
    Work,
    ceiling,
    decibel_features,
    foretold,
    motion_features,
    pilot_features,
    remainder,
    side_of,
    step_features,
    work_of,
)
from genmojo_core.optimise.held_out import held_frames

PENALTY = np.array([0.02, 0.02, 0.02])  # of steps, pixels and Gaussians
PILOT_PENALTY = np.array([0.0, 0.05, 0.05])  # of the terms of PILOT_NAMES
ODD = 1.5  # dB from which an error counts by its size, not its square
_HURRIED = 0.38  # of the budget: from here the motion was cut short


def config_of(row: dict[str, Any]) -> RunConfig:
    stored = dict(row["config"])
    stored |= {"weights": LossWeights(**stored["weights"]), "rates": LearningRates(**stored["rates"])}
    stored |= {"plane_levels": tuple(stored["plane_levels"]), "ignore": tuple(stored["ignore"])}
    return RunConfig(**stored)


def work(row: dict[str, Any]) -> Work:
    made = planned_work(row)
    splatted = row["gaussians"] - made.settled
    return replace(made, moving=row.get("moving") or made.moving, total=splatted)


def planned_work(row: dict[str, Any]) -> Work:
    """As it is foretold, before the run has its Gaussians."""
    return work_of(tuple(row["size"]), row["frames"], row["objects"], row["on"], config_of(row), row.get("window"),
                   row.get("rigid", 0))  # fmt: skip


def non_negative(a: np.ndarray, b: np.ndarray, rounds: int = 3000) -> np.ndarray:
    """Least squares of relative errors with coefficients of at least 0 (coordinate descent)."""
    a, b = a / b[:, None], np.ones(len(b))
    x = np.zeros(a.shape[1])
    norms = (a * a).sum(axis=0) + 1e-12
    for _ in range(rounds):
        for j in range(len(x)):
            x[j] = max(0.0, x[j] + float(a[:, j] @ (b - a @ x)) / norms[j])
    return x


def decibel_law(a: np.ndarray, b: np.ndarray, clips: list[str]) -> np.ndarray:
    """Constant, slope of the clip's motion, slopes of what a run spends.

    What a run spends tells by the differences within clips, what a clip is like by the means of clips; every clip
    counts as one, however many rows it has. Slopes of spending are drawn to 0 by PENALTY, and none
    says that more is worse.
    """
    names = sorted(set(clips))
    member = np.array([[name == one for one in clips] for name in names], float)
    share = member / member.sum(axis=1, keepdims=True)
    spent, off = a[:, 2:] - member.T @ (share @ a[:, 2:]), b - member.T @ (share @ b)
    weight = member.T @ (1.0 / member.sum(axis=1))
    square = (spent * weight[:, None]).T @ spent + np.diag(PENALTY)
    slopes = np.maximum(np.linalg.solve(square, spent.T @ (weight * off)), 0.0)
    level, motion = share @ (b - a[:, 2:] @ slopes), share @ a[:, 1]
    middle, usual = motion.mean(), level.mean()
    slope = (motion - middle) @ (level - usual) / ((motion - middle) @ (motion - middle) + 1e-9)
    return np.concatenate([[usual - slope * middle, slope], slopes])


def pilot_law(rows: list[dict[str, Any]]) -> tuple[float, ...]:
    """What rows of clips with pilots gain over the pilots' remainders; () without any.

    Every clip counts as one; a row counts by the share of its error that does not come from few pixels.
    """
    rows = [row for row in rows if row["difficulty"].get("reached") is not None]
    if not rows:
        return ()
    a, b, weight = [], [], []
    for row in rows:
        clip, made, got = Difficulty(**row["difficulty"]), work(row), seen_psnr(row)
        left = remainder(got, ceiling(clip, side_of(made)))
        a.append(pilot_features(made, *spent(row)[1:], row["config"]["gaussians_per_object"]))
        b.append(left - remainder(clip.reached or 0.0, ceiling(clip, PILOT_SIDE)))
        weight.append(10 ** ((got - left) / 10) / sum(other["clip"] == row["clip"] for other in rows))
    features, gained, law = np.array(a), np.array(b), np.zeros(len(a[0]))
    for i in range(30):  # a clip that is out of the way does not turn the law (Huber)
        off = np.abs(gained - features @ law)
        weights = np.array(weight) * (np.minimum(1.0, ODD / np.maximum(off, 1e-6)) if i else 1.0)
        square = (features * weights[:, None]).T @ features + np.diag(PILOT_PENALTY + 1e-9)
        law = np.linalg.solve(square, features.T @ (weights * gained))
    return tuple(law.tolist())


def spent(row: dict[str, Any]) -> tuple[float, float, float]:
    """Steps of the lift and of the joint stage, and joint steps of the whole schedule."""
    config, done = config_of(row), {name: row["stages"].get(name, {"steps": 0})["steps"] for name in ("lift", "joint")}
    planned = done["joint"] if config.paced else config.joint_steps_of("non_rigid_motion" in row["on"])
    return done["lift"], done["joint"], planned


def motion_law(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """ln c and exponents of the motion, drawn towards 1 (frames), 1 (objects) and 0.3 (pixels)."""
    usual = np.array([0.0, 1.0, 1.0, 0.3])
    penalty = np.diag([0.0, 1.0, 1.0, 1.0])
    return usual + np.linalg.solve(a.T @ a + penalty, a.T @ (b - a @ usual))


def fit(rows: list[dict[str, Any]], errors: tuple[float, float] = (1.0, 0.2)) -> Model:
    steps, ms, motions, seconds, levels, psnr, clips = [], [], [], [], [], [], []
    for row in rows:
        if row["kind"] == "growth":
            steps.append(step_features(work(row)))
            ms.append(row["step_ms"])
            if row.get("motion_seconds", 0) > 0.05:
                motions.append(motion_features(work(row)))
                seconds.append(math.log(row["motion_seconds"]))
            continue
        for name in ("lift", "joint"):
            stage = row["stages"].get(name, {"steps": 0})
            if stage["steps"] >= 10 and stage["cpu_seconds"]:
                steps.append(step_features(work(row), name == "joint"))
                ms.append(1000 * stage["cpu_seconds"] / stage["steps"])
        if row["kind"] not in ("preset", "size"):
            continue
        motion = row["stages"]["motion"]["cpu_seconds"] or math.inf
        if motion < min(_HURRIED * row["config"]["budget_seconds"], 1e6):
            motions.append(motion_features(work(row)))
            seconds.append(math.log(motion))
        levels.append(level(row))
        psnr.append(seen_psnr(row))
        clips.append(row["clip"])
    shown = [row for row in rows if row["kind"] in ("preset", "size")]
    return Model(
        tuple(non_negative(np.array(steps), np.array(ms)).tolist()),
        tuple(motion_law(np.array(motions), np.array(seconds)).tolist()),
        tuple(decibel_law(np.array(levels), np.array(psnr), clips).tolist()), *errors, pilot_law(shown), errors[0],
    )  # fmt: skip


def seen_psnr(row: dict[str, Any]) -> float:
    """PSNR over the frames that the run saw: a run that is foretold holds none out, the rows of a report do."""
    held = len(held_frames(int(row["frames"]), int(row["config"]["held_out_every"])))
    unseen = row.get("psnr_held_frames", 0.0)
    return (row["psnr"] * row["frames"] - unseen * held) / (row["frames"] - held) if unseen else row["psnr"]


def level(row: dict[str, Any]) -> np.ndarray:
    return decibel_features(Difficulty(**row["difficulty"]), work(row), spent(row)[:2],
                            row["config"]["gaussians_per_object"])  # fmt: skip


def left_out(clips: dict[str, list[dict[str, Any]]]) -> list[dict[str, Any]]:
    """Every preset row foretold by a model of the other clips; the run's own clock is the CPU's."""
    found = []
    for name, rows in clips.items():
        model = fit([r for other, rs in clips.items() if other != name for r in rs])
        for row in rows:
            if row["kind"] not in ("preset", "size"):
                continue
            told = foretold(planned_work(row), Difficulty(**row["difficulty"]), config_of(row), 1.0, model)
            free = row["reason"] == "done" and not row["config"]["paced"]
            found.append({"clip": name, "run": row["title"], "seconds": row["cpu_seconds"], "told_s": told.seconds,
                          "psnr": seen_psnr(row), "told_db": told.decibel, "free": free, "steps": row["steps"],
                          "told_steps": told.steps})  # fmt: skip
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument("--pilots", type=Path)
    parser.add_argument("--json", type=Path)
    args = parser.parse_args()
    clips = {f.name: [json.loads(p.read_text()) for p in sorted((f / "rows").glob("*.json"))] for f in args.folders}
    pilots = json.loads(args.pilots.read_text()) if args.pilots else {}
    for name, rows in clips.items():
        for row in rows:
            row["clip"] = name
            if "difficulty" in row:
                row["difficulty"] |= pilots.get(name, {})
    found = left_out(clips)
    for row in found:
        print(f"{row['clip']:15} {row['run']:18} {row['told_s']:6.1f} s told, {row['seconds'] or 0:6.1f} taken;  "
              f"{row['told_steps']:5.0f} / {row['steps']:5.0f} steps;  {row['told_db']:5.1f} dB told, "
              f"{row['psnr']:5.1f} got")  # fmt: skip
    off = np.array([row["told_db"] - row["psnr"] for row in found])
    pace = np.array([row["told_steps"] / row["steps"] - 1 for row in found if row["steps"] and row["seconds"]])
    time = np.array([row["told_s"] / row["seconds"] - 1 for row in found if row["free"] and row["seconds"]])
    clip_off = [(off[[row["clip"] == name for row in found]] ** 2).mean() for name in {row["clip"] for row in found}]
    errors = (float(np.sqrt(np.mean(clip_off))), float(np.sqrt((np.concatenate([time, pace]) ** 2).mean())))
    mean = np.mean([np.abs(off[[row["clip"] == name for row in found]]).mean() for name in clips])
    print(f"dB: rms {errors[0]:.2f} and mean {mean:.2f} per clip, within 1.0: {(np.abs(off) <= 1).sum()} of {len(off)}")
    print(f"seconds and steps: rms {100 * errors[1]:.0f} %; seconds of runs that ended by themselves: within 25 %: "
          f"{(np.abs(time) <= 0.25).sum()} of {len(time)}; steps got to: within 25 %: "
          f"{(np.abs(pace) <= 0.25).sum()} of {len(pace)}")  # fmt: skip
    print(fit([row for rows in clips.values() for row in rows], errors))
    if args.json:
        args.json.write_text(json.dumps({"rows": found, "errors": errors}, indent=1))


if __name__ == "__main__":
    main()
