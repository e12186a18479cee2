"""What may be changed while a run is going on, and how: a whitelist with ranges. Imports no torch.

Changes take effect at the next step; `Run.change` applies them and tells of each in a `ParameterChanged` event.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields, replace

from genmojo_core.config import LearningRates, LossWeights, RunConfig
from genmojo_core.errors import GenmojoError

STEP_LIMIT = "step_limit"


@dataclass(frozen=True)
class Parameter:
    """One number a person may change during a run.

    Args:
        name: "rates.means", "weights.rgb", "budget_seconds" ...; the path in RunConfig.
        group: "learning rate", "loss weight" or "course". low, high: allowed range. whole: integers only.
    """

    name: str
    group: str
    low: float
    high: float
    whole: bool = False


PARAMETERS: dict[str, Parameter] = {
    p.name: p
    for p in (
        *(Parameter(f"rates.{f.name}", "learning rate", 0.0, 1.0) for f in fields(LearningRates)),
        *(Parameter(f"weights.{f.name}", "loss weight", 0.0, 1000.0) for f in fields(LossWeights)),
        Parameter("budget_seconds", "course", 1.0, math.inf),
        Parameter("checkpoint_seconds", "course", 1.0, math.inf),
        Parameter("frames_per_step", "course", 1, 64, whole=True),
        Parameter("densify_every", "course", 1, 1_000_000, whole=True),
        Parameter("gaussians_per_object", "course", 16, 200_000, whole=True),
        Parameter(STEP_LIMIT, "course", 0, 10_000_000, whole=True),
    )
}


def checked(name: str, value: float) -> float | int:
    """The value as it will be used. Raises GenmojoError("argument") for an unknown name or a value out of range."""
    parameter = PARAMETERS.get(name)
    if parameter is None:
        raise GenmojoError("argument", f"'{name}' cannot be changed during a run", "",
                           "change it before the next start")  # fmt: skip
    number = isinstance(value, int | float) and not isinstance(value, bool) and not math.isnan(value)
    if not number or not parameter.low <= value <= parameter.high or (parameter.whole and value != int(value)):
        kind = "a whole number" if parameter.whole else "a number"
        raise GenmojoError("argument", f"{name} cannot be {value}", "",
                           f"give {kind} from {parameter.low:g} to {parameter.high:g}")  # fmt: skip
    return int(value) if parameter.whole else float(value)


def get(config: RunConfig, name: str) -> float:
    """The present value of a parameter that is part of the configuration."""
    group, _, leaf = name.rpartition(".")
    return float(getattr(getattr(config, group) if group else config, leaf))


def put(config: RunConfig, name: str, value: float) -> RunConfig:
    """The configuration with one (checked) parameter replaced."""
    group, _, leaf = name.rpartition(".")
    if not group:
        return replace(config, **{leaf: value})  # type: ignore[arg-type]
    return replace(config, **{group: replace(getattr(config, group), **{leaf: value})})  # type: ignore[arg-type]
