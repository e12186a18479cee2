"""The rasteriser's twelve cases: ours against the naive torch tile renderer, forward and backward, on one thread.

    python -m tests.benchmarks.rasterizer [--json FILE] [--plot FILE.png] [--rounds N] [--opponent-seconds S]
                                          [--case N:WxH ...]

Times are process CPU time, medians over rounds that visit every case in turn, so that other load and the processor's
changing speed touch all cases alike. Where gsplat and a CUDA device are at hand, its wall time there stands beside
ours. `pairs` are contributing (splat, pixel) pairs. The share of the peak takes 48 operations per pair forward and 92
backward, over the tile kernels alone, against the fused multiply-adds that `peak` measures just before: the best of a
few short runs of either, the median over the visits.
"""

from __future__ import annotations

import argparse
import importlib.util
import json
import os
import statistics
import time
from collections import defaultdict
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import torch

from genmojo_core.clip.cameras import View
from genmojo_core.kernels import threads
from genmojo_core.kernels.stage import Stage, alone
from genmojo_core.render import autograd, torch_tiles
from genmojo_core.render.cpu import rasterize
from genmojo_core.render.rasterizer import Splats
from tests.benchmarks.peak import multiply_seconds, peak_flops
from tests.benchmarks.plot import draw_plot, linear_cost
from tests.benchmarks.workload import CHANNELS, COUNTS, FLOW, SIZES, count_pairs, scene, view_of

FORWARD_OPERATIONS, BACKWARD_OPERATIONS = 48, 92  # per contributing pair
OWN = ("forward", "backward", "tiles_forward", "tiles_backward")
PICTURES = 8  # of an optimiser step
NAMES = ("means", "quats", "scales", "opacities", "features")


@dataclass
class Case:
    """One workload and what was measured of it, by name."""

    splats: Splats[np.ndarray]
    view: View
    row: dict[str, float]
    seconds: dict[str, list[float]] = field(default_factory=lambda: defaultdict(list))


def main() -> None:
    """Run the cases and print a table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--json", type=Path, help="write the figures there")
    parser.add_argument("--rounds", type=int, default=9)
    parser.add_argument("--opponent-seconds", type=float, default=60.0, help="leave the opponent out beyond that")
    parser.add_argument("--plot", type=Path, help="write cost over contributing pairs there, as PNG")
    parser.add_argument("--case", nargs="*", default=[], help="only these, e.g. 10000:256x256")
    arguments = parser.parse_args()
    threads.set_threads(1)
    torch.set_num_threads(1)
    peak = peak_flops()
    print(f"peak of one core: {peak / 1e9:.0f} GFLOP/s")
    wanted = [(count, *size) for size in SIZES for count in COUNTS]
    cases = [make_case(*one) for one in wanted if not arguments.case or "{}:{}x{}".format(*one) in arguments.case]
    compare(cases, arguments.opponent_seconds)
    for _ in range(arguments.rounds):
        for case in cases:
            visit(case)
    rows = [finished(case) for case in cases]
    figures = {"peak": peak, "cases": rows, "threads": {str(n): two_threads(n) for n in (1, PICTURES)}}
    for row in rows:
        print(sentence(row))
    ratios = [r["ratio"] for r in rows if "ratio" in r]
    if ratios:
        figures["median_ratio"] = statistics.median(ratios)
        print(f"median ratio over {len(ratios)} cases: {figures['median_ratio']:.0f}")
    if len(rows) > 2:
        figures["cost"] = linear_cost(rows)
        print("cost: {per_pair:.3g} s per pair, {per_splat:.3g} s per splat, {per_picture:.3g} s per picture,"
              " median error {median_error:.0%}".format(**figures["cost"]))  # fmt: skip
    for pictures, found in figures["threads"].items():
        print("two threads, {} at once: {ratio:.2f}x the speed of one (best {best:.2f}x), bare multiply-adds"
              " {machine:.2f}x (best {machine_best:.2f}x), load {load:.1f}".format(pictures, **found))  # fmt: skip
    if arguments.plot:
        draw_plot(rows, arguments.plot)
    if arguments.json:
        arguments.json.write_text(json.dumps(figures, indent=1))


def make_case(count: int, width: int, height: int) -> Case:
    """A workload with its pairs and entries counted."""
    splats, view = scene(count, width, height), view_of(width, height)
    drawn = rasterize.draw(splats, view, detached_channels=FLOW)
    row: dict[str, float] = {"count": count, "width": width, "height": height, "pairs": count_pairs(drawn)}
    row["entries"] = len(drawn.bins.rank)
    return Case(splats, view, row)


def compare(cases: list[Case], limit: float) -> None:
    """CPU seconds of the opponents, one pass each; torch's where the case before lets expect at most `limit`."""
    per_entry = 1e-4
    for case in cases:
        case.seconds["gsplat"] = gsplat_seconds(case.splats, case.view)
        if per_entry * case.row["entries"] < limit:
            visit(case)
            case.seconds["opponent"].append(sum(both_passes(torch_tiles.splat, case.splats, case.view)))
            per_entry = case.seconds["opponent"][0] / case.row["entries"]


def visit(case: Case, passes: int = 3) -> None:
    """The processor's peak, then some passes of ours after one that only fills the caches."""
    peak = peak_flops(0.005)
    both_passes(autograd.splat, case.splats, case.view)
    found: dict[str, list[float]] = defaultdict(list)
    for _ in range(passes):
        times = both_passes(autograd.splat, case.splats, case.view)
        with TilesAgain("bin_and_draw", 2) as drawing, TilesAgain("find_gradients", 1) as sloping:
            both_passes(autograd.splat, case.splats, case.view)
        for name, value in zip(OWN, (*times, drawing.seconds, sloping.seconds), strict=True):
            found[name].append(value)
    for name, values in found.items():
        case.seconds[name] += values
    for name, operations in (("forward", FORWARD_OPERATIONS), ("backward", BACKWARD_OPERATIONS)):
        best = min(found[f"tiles_{name}"])
        case.seconds[f"{name}_share_of_peak"].append(case.row["pairs"] * operations / best / peak)


def finished(case: Case) -> dict[str, float]:
    """The case's row: medians of all that was measured, and the opponent's ratio."""
    row = case.row | {name: statistics.median(values) for name, values in case.seconds.items() if values}
    if "opponent" in row:
        row["ratio"] = row["opponent"] / (row["forward"] + row["backward"])
    return row


def gsplat_seconds(splats: Splats[np.ndarray], view: View) -> list[float]:
    """Wall seconds of forward and backward of gsplat on CUDA, a few times; empty where there is none."""
    if not torch.cuda.is_available() or importlib.util.find_spec("gsplat") is None:
        return []
    from genmojo_core.render import cuda

    seconds = []
    for _ in range(5):
        leaves = Splats(*(torch.from_numpy(getattr(splats, n)).cuda().requires_grad_() for n in NAMES))
        torch.cuda.synchronize()
        start = time.perf_counter()
        picture = cuda.splat(leaves, view, detached_channels=FLOW)
        (picture.features.sum() + picture.depth.sum() + picture.alpha.sum()).backward()
        torch.cuda.synchronize()
        seconds.append(time.perf_counter() - start)
    return seconds[1:]


def two_threads(pictures: int, rounds: int = 40) -> dict[str, float]:
    """How many times as fast (wall time) two threads are as one, at 10k splats 256 x 256, interleaved.

    pictures: drawn at once, as an optimiser step draws its frames. `machine` is the same ratio of a loop of nothing but
    multiply-adds, measured between the rounds: what the two processors give at that moment. `load` is the machine's
    load average before.
    """
    splats, view = scene(10_000, 256, 256), view_of(256, 256)
    seconds: dict[int, list[float]] = {1: [], 2: []}
    loops: dict[int, list[float]] = {1: [], 2: []}
    load = os.getloadavg()[0] if hasattr(os, "getloadavg") else float("nan")
    for _ in range(rounds):
        for count, found in seconds.items():
            threads.set_threads(count)
            multiply_seconds(count)  # starts the threads and wakes the processors alike
            loops[count].append(multiply_seconds(count))
            found.append(sum(both_passes(autograd.splat_frames, splats, view, pictures, time.perf_counter)))
    threads.set_threads(1)
    one, two = statistics.median(loops[1]), statistics.median(loops[2])
    return {"ratio": statistics.median(seconds[1]) / statistics.median(seconds[2]),
            "best": min(seconds[1]) / min(seconds[2]), "machine": 2 * one / two,
            "machine_best": 2 * min(loops[1]) / min(loops[2]), "load": load}  # fmt: skip


def both_passes(
    draw: Callable,
    splats: Splats[np.ndarray],
    view: View,
    pictures: int = 0,
    clock: Callable[[], float] = time.process_time,
) -> tuple[float, float]:
    """Seconds of one forward and one backward pass with upstream gradients on all planes; CPU time by default.

    pictures: 0 where `draw` draws one, else so many of the same scene at once.
    """
    leaves = Splats(*(torch.from_numpy(getattr(splats, n)).clone().requires_grad_() for n in NAMES))
    generator = torch.Generator().manual_seed(0)
    size = (view.height, view.width)
    upstream = [torch.randn(*size, *tail, generator=generator) for tail in ((CHANNELS,), (), ())]
    many = ([leaves] * pictures, [view] * pictures) if pictures else (leaves, view)
    start = clock()
    drawn = draw(*many, detached_channels=FLOW)
    middle = clock()
    planes = [plane for one in (drawn if pictures else [drawn]) for plane in (one.features, one.depth, one.alpha)]
    torch.autograd.backward(planes, upstream * max(pictures, 1))
    return middle - start, clock() - middle


class TilesAgain:
    """While the context is open, a kernel of render/cpu/passes.py goes once more through the tiles, and that alone.

    kernel: its name; stage: which of its stages the tiles are. `seconds` adds up the CPU time of that second time.
    """

    def __init__(self, kernel: str, stage: int) -> None:
        self.name, self.stage, self.seconds = kernel, stage, 0.0
        self.kernel = getattr(rasterize, kernel)

    def __call__(self, stages: tuple[Stage, ...], done: int, *arguments: object) -> int:
        tiles = [alone(one.size if k == self.stage else 0, one.chunk) for k, one in enumerate(stages)]
        after = self.kernel(stages, done, *arguments)
        start = time.process_time()
        self.kernel(tuple(tiles), self.stage, *arguments)
        self.seconds += time.process_time() - start
        return after

    def __enter__(self) -> TilesAgain:
        setattr(rasterize, self.name, self)
        return self

    def __exit__(self, *_: object) -> None:
        setattr(rasterize, self.name, self.kernel)


def sentence(row: dict[str, float]) -> str:
    """One line of the table."""
    total = row["forward"] + row["backward"]
    text = (
        f"{int(row['count']):6d} {int(row['width'])}x{int(row['height'])}: {row['pairs'] / 1e6:6.2f} M pairs,"
        f" {1e3 * row['forward']:7.2f} + {1e3 * row['backward']:7.2f} ms, {row['pairs'] / total / 1e6:4.0f} M pairs/s,"
        f" {100 * row['forward_share_of_peak']:.0f} / {100 * row['backward_share_of_peak']:.0f} % of peak"
    )
    if "ratio" in row:
        text += f", torch tiles {row['opponent']:.1f} s = {row['ratio']:.0f}x"
    return text + (f", gsplat on CUDA {1e3 * row['gsplat']:.2f} ms" if "gsplat" in row else "")


if __name__ == "__main__":
    main()
