"""What looking costs a run: its step with the view off, and with a window that orbits all the time, turn by turn.

    xvfb-run -a python tests/benchmarks/orbit_overhead.py CLIP [--turns 12] [--steps 8] [--shared]

The optimiser is pinned to the first core, the window to the second (--shared: both on both). Medians over turns of
neighbours, wall and CPU seconds per step. Goals: 1.15 pinned, 1.10 where the cores are shared and the view runs at the
governor's pace.
"""

from __future__ import annotations

import argparse
import json
import os
import statistics
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT), str(ROOT / "tests")]

from genmojo_studio.app import make_application  # noqa: E402 - after the path is set
from genmojo_studio.view3d.orbit import Orbit  # noqa: E402
from genmojo_studio.view3d.scene_view import SceneView  # noqa: E402
from genmojo_studio.watch.draw_cost import DrawCost  # noqa: E402
from genmojo_studio.worker.protocol import RunRequest  # noqa: E402
from tests.benchmarks.worker_overhead import compared, pin, turn  # noqa: E402
from tests.worker.driving import Watched, watched  # noqa: E402


class Looker:
    """A view that shows every preview and, while `moving`, is turned with every event loop."""

    def __init__(self, window: Watched) -> None:
        self.view = SceneView()
        self.view.resize(960, 600)
        self.view.show()
        self.frames = 0
        self.angle = 0.0
        self.moving = False
        self.view.frame_drawn.connect(self._drawn)
        window.client.preview_ready.connect(self.view.set_snapshot)
        self.draw_cost = DrawCost(self.view, window.client)

    def start(self, moving: bool) -> None:
        """Orbit from now on, or rest."""
        self.moving = moving
        if moving:
            self._drawn(None)

    def _drawn(self, _: object) -> None:
        self.frames += 1
        if self.moving:
            self.angle += 1.0
            self.view._go(Orbit(elevation=10.0, azimuth=(self.angle % 120.0) - 60.0))


def main() -> None:
    """Measure and print one JSON object."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("clip")
    parser.add_argument("--turns", type=int, default=12)
    parser.add_argument("--steps", type=int, default=8)
    parser.add_argument("--frames", default="0:8")
    parser.add_argument("--shared", action="store_true")
    args = parser.parse_args()
    first, end = map(int, args.frames.split(":"))
    application = make_application()
    changes = {"joint_steps": 100_000, "budget_seconds": 1e6, "lift_steps": 10, "densify_every": 1_000_000}
    if not args.shared:
        pin(0, 1)
    rows: dict[str, list[tuple[float, float]]] = {"off": [], "orbiting": []}
    rates: list[float] = []  # frames a second while orbiting
    with tempfile.TemporaryDirectory() as folder:
        os.environ["GENMOJO_RUNS"] = folder
        request = RunRequest(args.clip, str(Path(folder) / "run"), "draft", changes, frames=(first, end), cadence="off")
        Path(request.run_dir).mkdir()
        with watched(None) as window:
            looker = Looker(window)
            window.client.start(request)
            if not args.shared:
                pin(window.client._process.pid, 0)
            window.until(lambda: window.steps() >= 20, 900)
            for _ in range(args.turns):
                looker.start(False)
                rows["off"].append(turn(window, "off", args.steps))
                looker.start(True)
                begun, before = time.monotonic(), looker.frames
                rows["orbiting"].append(turn(window, "live", args.steps))
                rates.append((looker.frames - before) / (time.monotonic() - begun))
            beat = window.client.beat
            looker.start(False)
            looker.view.close()
            window.answer(window.client.stop(keep=False), 60)
    found = compared(rows, "orbiting", "off")
    print(json.dumps({"orbiting_over_off": found, "frames": looker.frames, "shared": args.shared, "view": beat["view"],
                      "told": looker.draw_cost.share, "fps": statistics.median(rates),
                      "load": os.getloadavg()[0]}))  # fmt: skip
    del application


if __name__ == "__main__":
    main()
