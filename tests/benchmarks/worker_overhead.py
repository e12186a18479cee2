"""What watching costs a run: CPU and wall time per step with previews and without, in one run, turn by turn.

    python tests/benchmarks/worker_overhead.py CLIP [--turns 6] [--steps 20] [--frames 0:12]

The optimiser is pinned to the first core, this process (the window's part) to the second. Every turn takes some steps
with the view off and as many with it live (previews read here); medians over the turns. Then the same steps in a plain
`Run` without a worker, for the cost of the worker itself. Goals: 1.03 for both ratios.
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

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT), str(ROOT / "tests")]

from genmojo_studio.worker.protocol import RunRequest  # noqa: E402 - after the path is set
from tests.worker.driving import Watched, watched  # noqa: E402

PLAIN = """
import json, sys
from genmojo_studio.worker import preparing
from genmojo_studio.worker.protocol import RunRequest
request, first, last = RunRequest.from_json(json.loads(sys.argv[1])), int(sys.argv[2]), int(sys.argv[3])
clip, plan, config = preparing.prepare(request, lambda *a: None, lambda: False)
preparing.load_and_compile(config, lambda *a: None).join()
run, marks = preparing.build(clip, plan, config, request), {}
for event in run:
    if type(event).__name__ == "Step":
        marks[run.steps_done] = (event.seconds, event.cpu_seconds)
        if run.steps_done >= last:
            break
print(json.dumps([(b - a) / (last - first) for a, b in zip(marks[first], marks[last])]))
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


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("clip")
    parser.add_argument("--turns", type=int, default=6)
    parser.add_argument("--steps", type=int, default=20)
    parser.add_argument("--frames", default="0:12")
    args = parser.parse_args()
    first, end = map(int, args.frames.split(":"))
    changes = {"joint_steps": 100_000, "budget_seconds": 1e6, "lift_steps": 10, "densify_every": 1_000_000}
    pin(0, 1)
    with tempfile.TemporaryDirectory() as folder:
        os.environ["GENMOJO_RUNS"] = folder
        request = RunRequest(args.clip, str(Path(folder) / "run"), "draft", changes, frames=(first, end), cadence="off")
        Path(request.run_dir).mkdir()
        rows = {"off": [], "live": []}
        with watched(None) as window:
            pin(0, 0)  # a worker begins on its parent's cores, with all threads it will ever have
            window.client.start(request)
            pin(0, 1)
            window.until(lambda: window.steps() >= 20, 600)
            for i in range(args.turns):
                for cadence in list(rows) if i % 2 == 0 else list(rows)[::-1]:  # so that slow drift cancels
                    rows[cadence].append(turn(window, cadence, args.steps))
            previews = len(window.snapshots)
            beat = window.client.beat
            window.answer(window.client.stop(keep=False), 60)
        plain_request = replace(request, run_dir=str(Path(folder) / "plain"))
        Path(plain_request.run_dir).mkdir()
        pin(0, 0)
        command = [sys.executable, "-c", PLAIN, json.dumps(plain_request.to_json()), "22", str(22 + 2 * args.steps)]
        plain = json.loads(subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, text=True, check=True).stdout)
    median = {c: [statistics.median(row[i] for row in rows[c]) for i in (0, 1)] for c in rows}
    result = {
        "steps_per_turn": args.steps, "turns": args.turns, "previews": previews, "view": beat["view"],
        "live_over_off": {"wall": median["live"][0] / median["off"][0], "cpu": median["live"][1] / median["off"][1]},
        "off_over_plain": {"wall": median["off"][0] / plain[0], "cpu": median["off"][1] / plain[1]},
        "ms_per_step": {"off": 1e3 * median["off"][1], "live": 1e3 * median["live"][1], "plain": 1e3 * plain[1]},
    }  # fmt: skip
    print(json.dumps(result, indent=1))


if __name__ == "__main__":
    main()
