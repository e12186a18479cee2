"""The main job's steps with the CPU kernels or in plain torch: seconds per step, and quality over time.

    python -m tests.benchmarks.main_job CLIP [--frames 0:24] [--preset draft] [--torch] [--lift N] [--joint N]

Same clip, same seed, no budget: learning rates follow the steps. Prints JSON. --torch leaves the kernels out, as on a
machine where they do not compile.
"""

from __future__ import annotations

import argparse
import itertools
import json
import statistics
import sys
import time

from genmojo_core.clip import folders
from genmojo_core.config import preset
from genmojo_core.effects.decide import plan
from genmojo_core.estimate.complete import complete
from genmojo_core.events import Event, Step
from genmojo_core.kernels import trial


def main() -> None:
    """Run and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("clip")
    parser.add_argument("--frames", default="0:24")
    parser.add_argument("--preset", default="draft")
    parser.add_argument("--torch", action="store_true")
    parser.add_argument("--lift", type=int)
    parser.add_argument("--joint", type=int)
    arguments = parser.parse_args()
    if arguments.torch:
        trial.run = lambda: "left out for a comparison"
    counts = {"lift_steps": arguments.lift, "joint_steps": arguments.joint}
    changes = {name: count for name, count in counts.items() if count is not None}
    config = preset(arguments.preset, budget_seconds=1e6, **changes)
    first, last = (int(n) for n in arguments.frames.split(":"))
    clip = complete(folders.read(arguments.clip, frames=(first, last), short_side=config.short_side))
    from genmojo_core.optimise.run import Run

    run = Run(clip, plan(clip, config, {}), config)
    start = time.monotonic()
    events = []
    for event in run:
        events.append(event)
        if isinstance(event, Step):
            print(
                f"{event.stage} {event.step}: {event.psnr_held_out:.2f} dB, {event.cpu_seconds:.1f} s", file=sys.stderr
            )
    print(json.dumps(figures(events) | {"seconds": time.monotonic() - start}))


def figures(events: list[Event]) -> dict[str, object]:
    """Median wall and CPU seconds of a step of each stage, and the curve: CPU seconds, wall seconds, dB."""
    steps = [event for event in events if isinstance(event, Step)]
    per_step: dict[str, dict[str, float]] = {}
    for stage, members in itertools.groupby(steps, key=lambda step: step.stage):
        pairs = list(itertools.pairwise(members))
        per_step[stage] = {
            "wall": statistics.median(b.seconds - a.seconds for a, b in pairs),
            "cpu": statistics.median(b.cpu_seconds - a.cpu_seconds for a, b in pairs),
            "steps": len(pairs) + 1,
        }
    curve = [(step.cpu_seconds, step.seconds, step.psnr_held_out) for step in steps]
    return {"per_step": per_step, "curve": curve, "psnr": curve[-1][2]}


if __name__ == "__main__":
    main()
