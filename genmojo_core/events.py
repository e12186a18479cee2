"""What an optimisation says while it runs: frozen, JSON-able events, the only way out of the loop.

The command line prints them, the app's worker forwards them, tests assert on them (ARCHITECTURE.md section 2).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any


@dataclass(frozen=True)
class Event:
    """Base: wall and CPU seconds since the optimisation started."""

    seconds: float
    cpu_seconds: float

    def to_json(self) -> dict[str, Any]:
        """The event as plain data with its kind under "event"."""
        return {"event": type(self).__name__, **asdict(self)}


@dataclass(frozen=True)
class StageStarted(Event):
    """A stage begins: lift, motion, joint, refine ...; `steps` is how many steps it tells of one by one, or 0."""

    stage: str
    steps: int
    note: str = ""


@dataclass(frozen=True)
class Step(Event):
    """One optimiser step is done.

    `losses` by name, already weighted; `psnr_held_out` in dB on held-out blocks (None between measurements);
    `progress` 0..1 of the whole run; `eta_seconds` to its end.
    """

    stage: str
    step: int
    steps: int
    loss: float
    losses: Mapping[str, float]
    gaussians: int
    psnr_held_out: float | None = None
    progress: float = 0.0
    eta_seconds: float = 0.0


@dataclass(frozen=True)
class Preview(Event):
    """A scene worth showing exists; the first one marks "first valid scene". `psnr` is the foreground's, in dB."""

    stage: str
    step: int
    frame: int
    psnr: float


@dataclass(frozen=True)
class EffectChanged(Event):
    """An effect was switched during the run, with the reason; `said`: the same by key (effects/texts.py)."""

    effect: str
    on: bool
    reason: str
    said: tuple[tuple[str, Mapping[str, Any]], ...] = ()


@dataclass(frozen=True)
class ParameterChanged(Event):
    """A parameter (optimise/parameters.py) was changed by hand; it holds from the step after `step` on."""

    step: int
    name: str
    old: float
    new: float


@dataclass(frozen=True)
class Warned(Event):
    """Something the user should know; stable `code`."""

    code: str
    message: str


@dataclass(frozen=True)
class Checkpointed(Event):
    """A checkpoint was written and verified."""

    step: int
    path: str


@dataclass(frozen=True)
class Finished(Event):
    """The run is over and the scene stands. `reason`: done, goal, budget or interrupted."""

    step: int
    reason: str
    metrics: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Failed(Event):
    """The run cannot go on. `code` and `message` as in GenmojoError; the last checkpoint stays."""

    step: int
    code: str
    message: str
