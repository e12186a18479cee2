"""What effects cost and gain here, kept from `genmojo tradeoff` for the effect tables of command line and app."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from genmojo_core.effects.decide import NAMES
from genmojo_core.effects.machine import costs_file, known_costs
from genmojo_core.errors import GenmojoError
from genmojo_core.store.atomic import write_bytes


def keep(told: Mapping[str, Any]) -> bool:
    """Store the effects of a report (its JSON) beside what is known of others; False where the cache is read-only."""
    found = known_costs()
    for part in told["parts"]:
        name = str(part["title"]).replace(" ", "_")
        if part["kind"] == "effect" and name in NAMES:
            gain = {"psnr": part["gain"]["psnr"]} if "psnr" in part["gain"] else {}
            found[name] = {"clip": told["clip"], "ms": part["ms"], **gain}
    try:
        write_bytes(costs_file(), json.dumps(found).encode())
    except GenmojoError:
        return False
    return True
