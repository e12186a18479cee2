"""The rasteriser's twelve cases: ours against the naive torch tile renderer, forward and backward, on one thread.

    python -m tests.benchmarks.rasterizer [--json FILE] [--plot FILE.png] [--rounds N] [--opponent-rounds N]
                                          [--opponent-seconds S] [--case N:WxH ...]

Times are process CPU time, medians of interleaved rounds, so that other load on the machine counts as little as it can.
Where gsplat and a CUDA device are at hand, its wall time there stands beside ours.
`pairs` are contributing (splat, pixel) pairs. The share of the peak takes 48 operations per pair forward and 92
backward, over the tile kernels alone, against the fused multiply-adds measured by `peak`.
"""

from __future__ import annotations

import argparse
import importlib.util
import json
import os
import statistics
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import torch

from genmojo_core.clip.cameras import View
from genmojo_core.kernels import threads
from genmojo_core.render import autograd, torch_tiles
from genmojo_core.render.cpu import rasterize
from genmojo_core.render.rasterizer import Rendering, Splats
from tests.benchmarks.peak import multiply_seconds, peak_flops
from tests.benchmarks.plot import draw_plot, linear_cost
from tests.benchmarks.workload import CHANNELS, COUNTS, FLOW, SIZES, count_pairs, scene, view_of

FORWARD_OPERATIONS, BACKWARD_OPERATIONS = 48, 92  # per contributing pair
NAMES = ("means", "quats", "scales", "opacities", "features")


def main() -> None:
    """Run the cases and print a table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--json", type=Path, help="write the figures there")
    parser.add_argument("--rounds", type=int, default=9)
    parser.add_argument("--opponent-seconds", type=float, default=60.0, help="leave the opponent out beyond that")
    parser.add_argument("--opponent-rounds", type=int, default=1)
    parser.add_argument("--plot", type=Path, help="write cost over contributing pairs there, as PNG")
    parser.add_argument("--case", nargs="*", default=[], help="only these, e.g. 10000:256x256")
    arguments = parser.parse_args()
    threads.set_threads(1)
    torch.set_num_threads(1)
    peak = peak_flops()
    print(f"peak of one core: {peak / 1e9:.0f} GFLOP/s")
    rows: list[dict[str, float]] = []
    for width, height in SIZES:
        for count in COUNTS:
            if arguments.case and f"{count}:{width}x{height}" not in arguments.case:
                continue
            per_entry = rows[-1]["opponent"] / rows[-1]["entries"] if rows and "opponent" in rows[-1] else 1e-4
            row = run_case(count, width, height, arguments, per_entry)
            row["forward_share_of_peak"] = row["pairs"] * FORWARD_OPERATIONS / row["tiles_forward"] / peak
            row["backward_share_of_peak"] = row["pairs"] * BACKWARD_OPERATIONS / row["tiles_backward"] / peak
            rows.append(row)
            print(sentence(row), flush=True)
    figures = {"peak": peak, "cases": rows, "threads": two_threads()}
    ratios = [r["ratio"] for r in rows if "ratio" in r]
    if ratios:
        figures["median_ratio"] = statistics.median(ratios)
        print(f"median ratio over {len(ratios)} cases: {figures['median_ratio']:.0f}")
    if len(rows) > 2:
        figures["cost"] = linear_cost(rows)
        print("cost: {per_pair:.3g} s per pair, {per_splat:.3g} s per splat, median error {median_error:.0%}".format(
            **figures["cost"]))  # fmt: skip
    print("two threads: {ratio:.2f}x the speed of one (best {best:.2f}x), bare multiply-adds {machine:.2f}x (best"
          " {machine_best:.2f}x), load {load:.1f}".format(**figures["threads"]))  # fmt: skip
    if arguments.plot:
        draw_plot(rows, arguments.plot)
    if arguments.json:
        arguments.json.write_text(json.dumps(figures, indent=1))


def run_case(
    count: int, width: int, height: int, arguments: argparse.Namespace, seconds_per_entry: float
) -> dict[str, float]:
    """Medians in seconds of our forward and backward pass and of their tile kernels, and of the opponents' passes."""
    splats, view = scene(count, width, height), view_of(width, height)
    drawn = rasterize.draw(splats, view, detached_channels=FLOW)
    row: dict[str, float] = {"count": count, "width": width, "height": height, "pairs": count_pairs(drawn)}
    row["entries"] = len(drawn.bins.rank)
    del drawn
    compared = seconds_per_entry * row["entries"] < arguments.opponent_seconds
    times: dict[str, list[float]] = {k: [] for k in ("forward", "backward", "tiles_forward", "tiles_backward")}
    opponent, on_gpu = [], []
    for _ in range(arguments.opponent_rounds):
        if compared:
            opponent.append(sum(both_passes(torch_tiles.splat, splats, view)))
        own_rounds(splats, view, arguments.rounds, times)
        on_gpu += gsplat_seconds(splats, view)
    row |= {key: statistics.median(values) for key, values in times.items()}
    if compared:
        row["opponent"] = statistics.median(opponent)
        row["ratio"] = row["opponent"] / (row["forward"] + row["backward"])
    if on_gpu:
        row["gsplat"] = statistics.median(on_gpu)
    return row


def own_rounds(splats: Splats[np.ndarray], view: View, rounds: int, times: dict[str, list[float]]) -> None:
    """Some passes of ours; CPU seconds are added to `times`."""
    with Stopwatch("draw_tiles") as drawing, Stopwatch("slope_tiles") as sloping:
        for _ in range(rounds):
            drawing.seconds = sloping.seconds = 0.0
            for key, value in zip(("forward", "backward"), both_passes(autograd.splat, splats, view), strict=True):
                times[key].append(value)
            times["tiles_forward"].append(drawing.seconds)
            times["tiles_backward"].append(sloping.seconds)


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


def two_threads(rounds: int = 40) -> dict[str, float]:
    """How many times as fast (wall time) two threads are as one, at 10k splats 256 x 256, interleaved.

    `machine` is the same ratio of a loop of nothing but multiply-adds, measured between the rounds: what the two
    processors give at that moment. `load` is the machine's load average before.
    """
    splats, view = scene(10_000, 256, 256), view_of(256, 256)
    upstream = Rendering(*(np.ones((256, 256, *tail), np.float32) for tail in ((CHANNELS,), (), ())))
    seconds: dict[int, list[float]] = {1: [], 2: []}
    loops: dict[int, list[float]] = {1: [], 2: []}
    load = os.getloadavg()[0] if hasattr(os, "getloadavg") else float("nan")
    for _ in range(rounds):
        for count, found in seconds.items():
            threads.set_threads(count)
            multiply_seconds(count)  # starts the threads and wakes the processors alike
            loops[count].append(multiply_seconds(count))
            start = time.perf_counter()
            rasterize.backward(rasterize.draw(splats, view, detached_channels=FLOW), upstream)
            found.append(time.perf_counter() - start)
    threads.set_threads(1)
    one, two = statistics.median(loops[1]), statistics.median(loops[2])
    return {"ratio": statistics.median(seconds[1]) / statistics.median(seconds[2]),
            "best": min(seconds[1]) / min(seconds[2]), "machine": 2 * one / two,
            "machine_best": 2 * min(loops[1]) / min(loops[2]), "load": load}  # fmt: skip


def both_passes(draw: Callable, splats: Splats[np.ndarray], view: View) -> tuple[float, float]:
    """CPU seconds of one forward and one backward pass with upstream gradients on all planes."""
    leaves = Splats(*(torch.from_numpy(getattr(splats, n)).clone().requires_grad_() for n in NAMES))
    generator = torch.Generator().manual_seed(0)
    size = (view.height, view.width)
    upstream = [torch.randn(*size, *tail, generator=generator) for tail in ((CHANNELS,), (), ())]
    start = time.process_time()
    picture = draw(leaves, view, detached_channels=FLOW)
    middle = time.process_time()
    torch.autograd.backward([picture.features, picture.depth, picture.alpha], upstream)
    return middle - start, time.process_time() - middle


class Stopwatch:
    """Adds up the CPU time spent in one kernel of render/cpu/rasterize.py while the context is open."""

    def __init__(self, name: str) -> None:
        self.name, self.seconds = name, 0.0
        self.kernel = getattr(rasterize, name)

    def __call__(self, *arguments: object) -> None:
        start = time.process_time()
        self.kernel(*arguments)
        self.seconds += time.process_time() - start

    def __enter__(self) -> Stopwatch:
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
