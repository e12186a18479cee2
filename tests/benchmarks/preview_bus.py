"""How long a preview takes from the worker's publishing to the window's snapshot: p50 and p95 at some sizes.

    python tests/benchmarks/preview_bus.py [--gaussians 50000] [--seconds 10]

A worker that publishes random Gaussians and a client with Qt's event loop; goal: p95 <= 50 ms at 50 000 Gaussians.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT), str(ROOT / "tests")]

from tests.worker.driving import fake_request, watched  # noqa: E402 - after the path is set


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--gaussians", type=int, default=50_000)
    parser.add_argument("--seconds", type=float, default=10.0)
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        os.environ["GENMOJO_RUNS"] = folder
        run_dir = Path(folder) / "run"
        run_dir.mkdir()
        latencies = []
        with watched() as window:
            client = window.client
            client.preview_ready.connect(lambda snapshot: latencies.append(client.latency))
            client.start(fake_request(run_dir, steps=10**6, step_seconds=0.05, gaussians=args.gaussians))
            window.until(lambda: latencies)
            end = time.monotonic() + args.seconds
            window.until(lambda: time.monotonic() > end, args.seconds + 5)
            view = client.beat["view"]
    latencies = sorted(latencies[1:])
    count = len(latencies)
    print(json.dumps({
        "gaussians": args.gaussians, "previews": count, "p50_ms": round(1e3 * latencies[count // 2], 2),
        "p95_ms": round(1e3 * latencies[int(0.95 * count)], 2), "worst_ms": round(1e3 * latencies[-1], 2),
        "publish_share": round(view["publish_share"], 4), "interval_ms": round(1e3 * view["interval"], 1),
    }))  # fmt: skip


if __name__ == "__main__":
    main()
