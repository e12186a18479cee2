"""What watching costs a run: CPU and wall time per step of a plain `Run`, of a worker, and with previews.

    python tests/benchmarks/worker_overhead.py CLIP [--turns 30] [--steps 6] [--frames 0:12]

Two optimisers of the same clip, a plain `Run` and a worker, lie on the first core and take turns of some steps each, so
that only one of them works at a time and slow drift of the machine cancels; this process (the window's part) is on the
second core. Ratios are medians over turns of neighbours, with a bootstrap interval of 95 %. Goals: 1.03 for each.
"""

from __future__ import annotations

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT), str(ROOT / "tests")]

from genmojo_studio.worker.protocol import RunRequest  # noqa: E402 - after the path is set
from tests.worker.driving import Watched, watched  # noqa: E402

PLAIN = """
import json, sys
from genmojo_studio.worker import preparing
from genmojo_studio.worker.protocol import RunRequest
request = RunRequest.from_json(json.loads(sys.argv[1]))
clip, plan, config = preparing.prepare(request, lambda *a: None, lambda: False)
preparing.load_and_compile(config, lambda *a: None).join()
run, mark, begin, wanted = preparing.build(clip, plan, config, request), None, 18, 20
for event in run:
    if type(event).__name__ != "Step":
        continue
    if run.steps_done == begin:
        mark = (event.seconds, event.cpu_seconds)
    if run.steps_done == wanted:
        print(json.dumps([b - a for a, b in zip(mark, (event.seconds, event.cpu_seconds))]), flush=True)
        line = sys.stdin.readline()
        if not line:
            break
        begin = run.steps_done + 2  # the first ones after a rest find cold caches; the worker's are left out too
        wanted = begin + int(line)
"""


def pin(pid: int, core: int) -> None:
    """Keep a process on one core, where the system can."""
    if hasattr(os, "sched_setaffinity") and os.cpu_count() > 1:
        os.sched_setaffinity(pid, {core})


def turn(window: Watched, cadence: str, steps: int) -> tuple[float, float]:
    """Wall and CPU seconds per step over some steps in one cadence."""
    window.answer(window.client.set_view(cadence), 60)
    first = window.steps() + 2
    window.until(lambda: window.steps() >= first + steps, 600)
    rows = [e for e in window.events if e["event"] == "Step"]
    begin, end = rows[first - 1], rows[first - 1 + steps]
    return tuple((end[name] - begin[name]) / steps for name in ("seconds", "cpu_seconds"))


class Plain:
    """A run without a worker, in a process of its own, that takes steps when asked."""

    def __init__(self, request: RunRequest) -> None:
        command = [sys.executable, "-c", PLAIN, json.dumps(request.to_json())]
        self.process = subprocess.Popen(command, cwd=ROOT, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.process.stdout.readline()

    def turn(self, steps: int) -> tuple[float, float]:
        """Wall and CPU seconds per step of the next steps."""
        self.process.stdin.write(f"{steps}\n")
        self.process.stdin.flush()
        wall, cpu = json.loads(self.process.stdout.readline())
        return wall / steps, cpu / steps


def compared(rows: dict[str, list[tuple[float, float]]], one: str, other: str) -> dict[str, dict[str, float]]:
    """Median of `one` / `other` over the turns, wall and CPU, each with a bootstrap interval of 95 %."""
    found = {}
    for i, kind in enumerate(("wall", "cpu")):
        ratios = np.array([a[i] / b[i] for a, b in zip(rows[one], rows[other], strict=True)])
        drawn = np.random.default_rng(0).choice(ratios, (2000, len(ratios)))
        low, high = np.percentile(np.median(drawn, axis=1), (2.5, 97.5))
        found[kind] = {"ratio": float(np.median(ratios)), "low": float(low), "high": float(high)}
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("clip")
    parser.add_argument("--turns", type=int, default=30)
    parser.add_argument("--steps", type=int, default=6)
    parser.add_argument("--frames", default="0:12")
    args = parser.parse_args()
    first, end = map(int, args.frames.split(":"))
    changes = {"joint_steps": 100_000, "budget_seconds": 1e6, "lift_steps": 10, "densify_every": 1_000_000}
    with tempfile.TemporaryDirectory() as folder:
        os.environ["GENMOJO_RUNS"] = folder
        request = RunRequest(args.clip, str(Path(folder) / "run"), "draft", changes, frames=(first, end), cadence="off")
        alone = replace(request, run_dir=str(Path(folder) / "plain"))
        for each in (request, alone):
            Path(each.run_dir).mkdir()
        rows: dict[str, list[tuple[float, float]]] = {"plain": [], "off": [], "live": []}
        with watched(None) as window:
            pin(0, 0)  # both begin on this process's core, with all threads they will ever have
            plain = Plain(alone)
            window.client.start(request)
            pin(0, 1)
            window.until(lambda: window.steps() >= 20, 600)
            window.answer(window.client.pause(), 60)
            for i in range(args.turns):
                for name in list(rows)[i % 3 :] + list(rows)[: i % 3]:
                    if name == "plain":
                        rows[name].append(plain.turn(args.steps))
                        continue
                    window.answer(window.client.resume(), 60)
                    rows[name].append(turn(window, name, args.steps))
                    window.answer(window.client.pause(), 60)
            plain.process.stdin.close()
            plain.process.wait(60)
            window.answer(window.client.stop(keep=False), 60)
    result = {
        "live_over_off": compared(rows, "live", "off"), "off_over_plain": compared(rows, "off", "plain"),
        "live_over_plain": compared(rows, "live", "plain"), "turns": args.turns, "previews": len(window.snapshots),
        "ms_per_step": {name: 1e3 * statistics.median(row[1] for row in found) for name, found in rows.items()},
        "load": os.getloadavg()[0],
    }  # fmt: skip
    print(json.dumps(result))


if __name__ == "__main__":
    main()
