"""Scenes at `standard` that several rows of issue 6's table look at: made once per program, kept with their figures."""

from __future__ import annotations

import json
import time
from typing import Any

from table import Bench

_DIGEST = "from genmojo_core.measure.sources import digest; print(digest())"


def genmojo(bench: Bench, *argv: str) -> dict[str, Any]:
    """A command's JSON."""
    result: dict[str, Any] = json.loads(bench.python("-m", "genmojo_core.cli.main", *argv, "--json"))
    return result


def scores(bench: Bench, name: str, kind: str, *options: str) -> dict[str, Any]:
    """`evaluate --turntable` of a clip's scene at standard, with `seconds`, the wall seconds of the run.

    A scene of the same program (its sources and prior) is not made again. kind: names the options.
    """
    program = bench.python("-c", _DIGEST).strip()
    scene = bench.work / "scenes" / f"{name}-{kind}-{program}.h5"
    kept = scene.with_suffix(".json")
    if not kept.exists():
        scene.parent.mkdir(exist_ok=True)
        clip, start = str(bench.data / name), time.monotonic()
        genmojo(bench, "optimize", clip, "-o", str(scene), "--preset", "standard", *options)
        seconds = time.monotonic() - start
        kept.write_text(json.dumps({**genmojo(bench, "evaluate", str(scene), clip, "--turntable"), "seconds": seconds}))
    result: dict[str, Any] = json.loads(kept.read_text())
    return result
