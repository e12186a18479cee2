"""What effects cost and gain here, kept for the effect tables of command line and app.

Milliseconds come from runs, which take each effect out of one and the same step (optimise/cost.py); decibels come from
`genmojo tradeoff`, whose runs with and without an effect differ by the machine's other work in time, not in accuracy.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from genmojo_core.effects.decide import NAMES
from genmojo_core.effects.machine import costs_file, known_costs
from genmojo_core.effects.plan import EffectPlan
from genmojo_core.errors import GenmojoError
from genmojo_core.store.atomic import write_bytes


def keep_run(clip: str, plan: EffectPlan) -> bool:
    """Store the milliseconds that a run measured; False where the cache is read-only or nothing was measured."""
    cost = {str(e.name): {"ms": e.measured_ms, "ms_clip": clip} for e in plan.effects if e.measured_ms is not None}
    return _added(cost)


def keep_report(told: Mapping[str, Any]) -> bool:
    """Store the decibels that a report (its JSON) measured; False as `keep_run`."""
    gain: dict[str, dict[str, Any]] = {}
    for part in told["parts"]:
        name = str(part["title"]).replace(" ", "_")
        if part["kind"] == "effect" and name in NAMES and "psnr" in part["gain"]:
            gain[name] = {"psnr": part["gain"]["psnr"], "psnr_clip": told["clip"]}
    return _added(gain)


def _added(found: Mapping[str, Mapping[str, Any]]) -> bool:
    """Add to what is known already."""
    if not found:
        return False
    known = known_costs()
    both = known | {name: {**known.get(name, {}), **values} for name, values in found.items()}
    try:
        write_bytes(costs_file(), json.dumps(both).encode())
    except GenmojoError:
        return False
    return True
