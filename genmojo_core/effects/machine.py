"""How fast this machine is: a short calibration, kept in the user's cache folder under the machine, our version and
what speeds are compared with.

The measuring itself takes optimiser steps and lies in optimise/calibrate.py; this module imports no torch.
"""

from __future__ import annotations

import hashlib
import json
import os
import platform
import time
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np

from genmojo_core import __version__
from genmojo_core.effects.forecast import REFERENCE_STEP_MS
from genmojo_core.kernels.cache import user_cache

_PROBE_SECONDS = 0.15


@dataclass(frozen=True)
class Machine:
    """A calibrated machine.

    Args:
        speed: against the one that the shipped model of costs was fitted on; 2 is twice as fast.
        wall_per_cpu: wall seconds of a CPU second of optimiser steps, on the machine as busy as it was then; below 1
            where kernels use several cores.
        contention: `contention()` at that time.
    """

    speed: float = 1.0
    wall_per_cpu: float = 1.0
    contention: float = 1.0

    def wall_now(self) -> float:
        """`wall_per_cpu` on the machine as busy as it is now."""
        return self.wall_per_cpu * contention() / self.contention


def machine_file() -> Path:
    """Where this machine's calibration lies."""
    told = (platform.node(), platform.machine(), platform.processor(), str(os.cpu_count()), __version__,
            str(REFERENCE_STEP_MS))  # fmt: skip
    name = hashlib.sha256("\0".join(told).encode()).hexdigest()[:16]
    return user_cache() / "genmojo" / "machines" / f"{name}.json"


def load() -> Machine | None:
    """This machine's calibration; None before the first, or where the file is not one."""
    try:
        stored = json.loads(machine_file().read_text())
        values = {f.name: float(stored[f.name]) for f in fields(Machine)}
    except (OSError, ValueError, KeyError, TypeError):
        return None
    sound = all(np.isfinite(v) and v > 0 for v in values.values())
    return Machine(**values) if sound else None


def costs_file() -> Path:
    """Where lies what effects cost and gained on this machine (measure/effect_costs.py)."""
    return machine_file().with_name(f"{machine_file().stem}-effects.json")


def known_costs() -> dict[str, dict[str, Any]]:
    """Effect name -> `ms` per step and its `ms_clip`, `psnr` gained in dB and its `psnr_clip`, as last measured here.

    {} before anything was measured, or where the file is not one.
    """
    try:
        stored = json.loads(costs_file().read_text())
        return {str(name): _known(row) for name, row in stored.items()}
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return {}


def _known(row: dict[str, Any]) -> dict[str, Any]:
    return {k: float(row[k]) for k in ("ms", "psnr") if k in row} | {
        f"{k}_clip": str(row[f"{k}_clip"]) for k in ("ms", "psnr") if k in row
    }


def contention() -> float:
    """Wall seconds per CPU second of one thread that never waits, measured in a moment: 1 on a free core."""
    values = np.random.default_rng(0).random(20_000)
    wall, cpu = time.perf_counter(), time.process_time()
    while time.perf_counter() - wall < _PROBE_SECONDS:
        np.sort(values)
    return max(1.0, (time.perf_counter() - wall) / max(time.process_time() - cpu, 1e-6))
