"""The rasteriser's twelve cases: ours against the naive torch tile renderer, forward and backward, on one thread.

    python -m tests.benchmarks.rasterizer [--json FILE] [--rounds N] [--opponent-seconds S] [--case N:WxH ...]

Times are process CPU time, medians of interleaved rounds, so that other load on the machine counts as little as it can.
`pairs` are contributing (splat, pixel) pairs. The share of the peak takes 48 operations per pair forward and 92
backward, over the tile kernels alone, against the fused multiply-adds measured by `peak`.
"""

from __future__ import annotations

import argparse
import json
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
from genmojo_core.render.rasterizer import Splats
from tests.benchmarks.peak import peak_flops
from tests.benchmarks.workload import CHANNELS, COUNTS, FLOW, SIZES, count_pairs, scene, view_of

FORWARD_OPERATIONS, BACKWARD_OPERATIONS = 48, 92  # per contributing pair
NAMES = ("means", "quats", "scales", "opacities", "features")


def main() -> None:
    """Run the cases and print a table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--json", type=Path, help="write the figures there")
    parser.add_argument("--rounds", type=int, default=9)
    parser.add_argument("--opponent-seconds", type=float, default=60.0, help="leave the opponent out beyond that")
    parser.add_argument("--case", nargs="*", default=[], help="only these, e.g. 10000:256x256")
    arguments = parser.parse_args()
    threads.set_threads(1)
    torch.set_num_threads(1)
    peak = peak_flops()
    print(f"peak of one core: {peak / 1e9:.0f} GFLOP/s")
    rows, seconds_per_entry = [], 1e-4
    for width, height in SIZES:
        for count in COUNTS:
            if arguments.case and f"{count}:{width}x{height}" not in arguments.case:
                continue
            row = run_case(count, width, height, arguments.rounds)
            row["forward_share_of_peak"] = row["pairs"] * FORWARD_OPERATIONS / row["tiles_forward"] / peak
            row["backward_share_of_peak"] = row["pairs"] * BACKWARD_OPERATIONS / row["tiles_backward"] / peak
            if seconds_per_entry * row["entries"] < arguments.opponent_seconds:
                row["opponent"] = opponent_seconds(count, width, height)
                row["ratio"] = row["opponent"] / (row["forward"] + row["backward"])
                seconds_per_entry = row["opponent"] / row["entries"]
            rows.append(row)
            print(sentence(row), flush=True)
    ratios = [r["ratio"] for r in rows if "ratio" in r]
    if ratios:
        print(f"median ratio over {len(ratios)} cases: {statistics.median(ratios):.0f}")
    if arguments.json:
        arguments.json.write_text(json.dumps({"peak": peak, "cases": rows}, indent=1))


def run_case(count: int, width: int, height: int, rounds: int) -> dict[str, float]:
    """Medians in seconds of our forward and backward pass, and of their tile kernels."""
    splats, view = scene(count, width, height), view_of(width, height)
    drawn = rasterize.draw(splats, view, detached_channels=FLOW)
    row = {"count": count, "width": width, "height": height, "pairs": count_pairs(drawn)}
    row["entries"] = len(drawn.bins.rank)
    times: dict[str, list[float]] = {k: [] for k in ("forward", "backward", "tiles_forward", "tiles_backward")}
    with Stopwatch("draw_tiles") as drawing, Stopwatch("slope_tiles") as sloping:
        for _ in range(rounds):
            drawing.seconds = sloping.seconds = 0.0
            for key, value in zip(("forward", "backward"), both_passes(autograd.splat, splats, view), strict=True):
                times[key].append(value)
            times["tiles_forward"].append(drawing.seconds)
            times["tiles_backward"].append(sloping.seconds)
    return row | {key: statistics.median(values) for key, values in times.items()}


def opponent_seconds(count: int, width: int, height: int) -> float:
    """CPU seconds of forward and backward of the naive torch tile renderer."""
    return sum(both_passes(torch_tiles.splat, scene(count, width, height), view_of(width, height)))


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
    return text + (f", torch tiles {row['opponent']:.1f} s = {row['ratio']:.0f}x" if "ratio" in row else "")


if __name__ == "__main__":
    main()
