"""Issue 3, "Shown by": the rasteriser's figures, each row measured by programs of their own.

    python tests/acceptance/3.py --work DIR [--only benchmark,step] [--again] [--data ../shared/data]

Results are kept in DIR/results, so an interrupted run goes on where it stopped; --again measures anew. Prints the table
as Markdown and writes it with all figures to DIR/3.json; the benchmark's picture is DIR/cost.png. Times are CPU times
of one thread; the ratio of two threads is wall time and says something on free cores only, so the load average and
the ratio of bare multiply-adds at that moment stand beside it.
"""

from __future__ import annotations

import json
import re
import shutil
import sys

from table import Bench, Check, Rows, main

WANTED_ROWS = [*(f"n{i:02d}" for i in range(1, 15)), "n20", "n31"]  # of RELIABILITY.md


def benchmark(bench: Bench) -> list[Check]:
    """The twelve cases against the naive torch tile renderer."""
    out, picture = bench.work / "rasterizer.json", bench.work / "cost.png"
    bench.python("-m", "tests.benchmarks.rasterizer", "--json", str(out), "--plot", str(picture))
    figures = json.loads(out.read_text())
    cases = {(c["count"], c["width"]): c for c in figures["cases"]}
    usual = cases[10_000, 256]
    seconds = usual["forward"] + usual["backward"]
    shares = [(c["forward_share_of_peak"], c["backward_share_of_peak"]) for c in figures["cases"]]
    return [
        Check("times torch tiles, median", figures.get("median_ratio"), 50),
        Check("10k 256² M pairs/s", usual["pairs"] / seconds / 1e6, 70),
        Check("10k 256² ms", 1e3 * seconds, 12, at_most=True),
        Check("10k 256² % of FMA peak forward", 100 * usual["forward_share_of_peak"], 20),
        Check("backward", 100 * usual["backward_share_of_peak"], 30),
        Check("best case forward", 100 * max(f for f, _ in shares)),
        Check("backward", 100 * max(b for _, b in shares)),
        Check("cost = pairs + splats + a picture's fixed cost: median error %", 100 * figures["cost"]["median_error"]),
        *_threads(figures["threads"]),
    ]


def _threads(figures: dict[str, dict[str, float]]) -> list[Check]:
    """Two threads: the pictures of a step at once, one picture, and what bare multiply-adds reach at that moment.

    The goal is asked of both: a step's pictures, as an optimiser draws them, and a picture by itself.
    """
    checks = []
    for pictures, found in sorted(figures.items(), key=lambda one: -int(one[0])):
        checks += [
            Check(f"two threads, {pictures} at once", found["ratio"], 1.7),
            Check("best", found["best"]),
            Check("bare multiply-adds", found["machine"]),
            Check("best", found["machine_best"]),
            Check("at load", found["load"]),
        ]
    return checks


def step(bench: Bench) -> list[Check]:
    """The whole optimiser step against plain torch."""
    out = bench.work / "step.json"
    bench.python("-m", "tests.benchmarks.step", "--json", str(out))
    figures = json.loads(out.read_text())["sums"]
    plain, full = figures["step"], figures["full step"]
    return [
        Check("step s", plain["ours"], 0.5, at_most=True),
        Check("with two times, rigidity, rotation s", full["ours"], 0.8, at_most=True),
        Check("times plain torch", plain["torch"] / plain["ours"], 6),
        Check("full step times plain torch", full["torch"] / full["ours"], 6),
    ]


_COMPILE = """
import time, sys
start = time.process_time()
import torch
loaded = time.process_time()
from genmojo_core.render import backend
backend.warm_up(lambda text: print(text, file=sys.stderr)).join()
print(time.process_time() - loaded)
"""


def compilation(bench: Bench) -> list[Check]:
    """Warm-up with an empty cache, then with a full one."""
    home = bench.work / "cache"
    shutil.rmtree(home, ignore_errors=True)
    cold, warm = (float(bench.python("-c", _COMPILE, XDG_CACHE_HOME=str(home))) for _ in range(2))
    return [Check("cold CPU s", cold, 10, at_most=True), Check("cached CPU s", warm, 1, at_most=True)]


def accuracy(bench: Bench) -> list[Check]:
    """Against float64: 30 random scenes, the pose, channels, bits for 1, 2 and 4 threads."""
    names = "equal_float64 or same_bits or channels or finite_differences"
    said = bench.python("-m", "pytest", "-q", "tests/render/test_rasterizer.py", "-k", names, ends=(0, 1))
    return [Check("tests passed", _passed(said), 40), Check("failed", _failed(said), 0, at_most=True)]


def hard_cases(bench: Bench) -> list[Check]:
    """Every row of RELIABILITY.md that the issue names has passing tests of its name."""
    folders = [f"tests/{name}" for name in ("hard_cases", "render", "scene", "optimise")]
    rows = " or ".join(f"test_{row}_" for row in WANTED_ROWS)
    said = bench.python("-m", "pytest", "-q", "-rA", *folders, "-k", rows, ends=(0, 1))
    found = set(re.findall(r"PASSED \S+::test_(n\d\d)_", said))
    return [
        Check("rows with tests", len(found & set(WANTED_ROWS)), len(WANTED_ROWS)),
        Check("tests passed", _passed(said)),
        Check("failed", _failed(said), 0, at_most=True),
    ]


def main_job(bench: Bench) -> list[Check]:
    """The same steps of the main job in plain torch and with the kernels, and the time to plain torch's quality."""
    clip = str(bench.data / "crossing")
    program = ("-W", "ignore", "-m", "tests.benchmarks.main_job", clip, "--lift", "4", "--joint", "8")
    before, after = json.loads(bench.python(*program, "--torch")), json.loads(bench.python(*program))
    reached = next((cpu for cpu, _, psnr in after["curve"] if psnr >= before["psnr"] - 0.05), None)
    since = (
        before["curve"][0][0] - before["per_step"]["lift"]["cpu"],
        after["curve"][0][0] - after["per_step"]["lift"]["cpu"],
    )
    checks = []
    for stage in ("lift", "joint"):
        old, new = before["per_step"][stage]["cpu"], after["per_step"][stage]["cpu"]
        checks += [Check(f"{stage} CPU s a step before", old), Check("after", new), Check("ratio", old / new)]
    return [
        *checks,
        Check("PSNR before", before["psnr"]),
        Check("after", after["psnr"]),
        Check("CPU s of steps to the former before", before["curve"][-1][0] - since[0]),
        Check("after", None if reached is None else reached - since[1]),
    ]


def _passed(said: str) -> float:
    """Tests passed by pytest's last line."""
    found = re.findall(r"(\d+) passed", said)
    return float(found[-1]) if found else 0.0


def _failed(said: str) -> float:
    """Tests failed."""
    found = re.findall(r"(\d+) (?:failed|error)", said)
    return float(found[-1]) if found else 0.0


ROWS: Rows = {
    "benchmark": ("rasteriser, twelve cases", benchmark),
    "step": ("optimiser step, 8 frames at 256²", step),
    "compilation": ("compile once", compilation),
    "accuracy": ("against float64", accuracy),
    "hard-cases": ("rows N01-N14, N20, N31", hard_cases),
    "main-job": ("crossing 0:24 draft, before and after", main_job),
}


if __name__ == "__main__":
    sys.exit(main(ROWS, __doc__, "3"))
