"""Where a run stands: clocks, steps, the accuracy-against-time curve, time left."""

from __future__ import annotations

import math
import time
from typing import Any

from genmojo_core.config import RunConfig, goal_of
from genmojo_core.events import Step
from genmojo_core.optimise.gain import StopRule
from genmojo_core.optimise.objective import Outcome
from genmojo_core.optimise.schedule import OUTWARD_SHARE, Stage

CURVE_EVERY = 20  # steps between points of the curve


class Clock:
    """Wall and CPU seconds since the optimisation started, over interruptions."""

    def __init__(self) -> None:
        self._wall, self._cpu = time.perf_counter(), time.process_time()
        self._earlier = (0.0, 0.0)
        self._held: tuple[float, float] | None = None

    def hold(self) -> None:
        """Stand still, e.g. while a run is paused, until `go_on`."""
        self._held = self._held or (time.perf_counter(), time.process_time())

    def go_on(self) -> None:
        """Go on after `hold`; what passed meanwhile does not count."""
        if self._held is not None:
            self._wall += time.perf_counter() - self._held[0]
            self._cpu += time.process_time() - self._held[1]
            self._held = None

    def now(self) -> tuple[float, float]:
        """(wall, CPU) seconds."""
        return (time.perf_counter() - self._wall + self._earlier[0], time.process_time() - self._cpu + self._earlier[1])

    def this_run(self) -> float:
        """Wall seconds since this run started, earlier runs of a resumed one left out: what the budget counts."""
        return time.perf_counter() - self._wall

    def add(self, wall: float, cpu: float) -> None:
        """Count the seconds of the run that is being resumed."""
        self._earlier = (wall, cpu)


class Progress:
    """Steps done, curve and forecasts of one run.

    Args:
        config: budget and checkpoint interval. stages: what will be done. frames: T, the window of the running mean.
    """

    def __init__(self, config: RunConfig, stages: list[Stage], frames: int) -> None:
        self.config, self.stages = config, stages
        self.step = 0
        self.total = max(1, sum(s.steps for s in stages))
        self.curve: list[dict[str, float]] = []
        self.window = max(8, frames)
        self._held: dict[int, tuple[float, int]] = {}  # latest held-out error of every frame
        self._last: Outcome | None = None
        self._stage = stages[0]
        self._stage_step = 0
        self._saved_at = 0.0
        self._goal = goal_of(config.until)
        self._rule = StopRule()

    def begin(self, stage: Stage) -> int:
        """Enter a stage; returns the step within it to go on from (not 0 after a resume)."""
        before = sum(s.steps for s in self.stages[: self.stages.index(stage)])
        self._stage = stage
        self._stage_step = min(max(self.step - before, 0), stage.steps)
        return self._stage_step

    def advance(self, outcome: Outcome, clock: Clock, gaussians: int) -> None:
        """Count a step and, every CURVE_EVERY of them, add a point to the curve."""
        self.step += 1
        self._stage_step += 1
        self._last = outcome
        for frame, error, count in outcome.held_out:
            if count:
                self._held[frame] = (error, count)
        if self.step % CURVE_EVERY == 0 or self.step == 1:
            wall, cpu = clock.now()
            self.curve.append({"seconds": wall, "cpu_seconds": cpu, "step": float(self.step),
                               "psnr_held_out": self.psnr(), "gaussians": float(gaussians)})  # fmt: skip

    def psnr(self) -> float:
        """PSNR in dB over the held-out blocks of all frames, each as last rendered; 0 if there are none."""
        error = sum(e for e, _ in self._held.values())
        count = sum(n for _, n in self._held.values())
        return -10.0 * math.log10(max(error / count, 1e-10)) if count else 0.0

    def fraction(self, clock: Clock) -> float:
        """0..1 of the run done, by steps or by budget, whichever is further."""
        return min(1.0, max(self.step / self.total, clock.this_run() / self.config.budget_seconds))

    def out_of_time(self, clock: Clock) -> bool:
        """True once the budget is spent."""
        return clock.this_run() >= self.config.budget_seconds

    def goal_reached(self) -> bool:
        """True once the goal of the configuration holds. Nothing is judged before all frames take part."""
        joint = self._stage is self.stages[-1] and self._stage_step >= OUTWARD_SHARE * self._stage.steps
        if self._goal is None or not joint:
            return False
        if self._goal.kind == "psnr":
            return self.psnr() >= self._goal.value
        settled = self.step - self._stage_step + OUTWARD_SHARE * self._stage.steps
        rows = [(row["seconds"], row["psnr_held_out"]) for row in self.curve if row["step"] >= settled]
        return self._rule.reached(rows, self._goal.value)

    def event(self, clock: Clock, gaussians: int) -> Step:
        """The step just done, as an event."""
        wall, cpu = clock.now()
        done = self.fraction(clock)
        spent = clock.this_run()
        left = min(spent * (1.0 - done) / max(done, 1e-6), self.config.budget_seconds - spent)
        outcome = self._last
        return Step(wall, cpu, self._stage.name, self._stage_step, self._stage.steps, float(outcome.loss.detach()),
                    outcome.parts, gaussians, self.psnr(), done, max(0.0, left))  # fmt: skip

    def checkpoint_due(self, clock: Clock) -> bool:
        """True every `checkpoint_seconds`."""
        return clock.now()[0] - self._saved_at >= self.config.checkpoint_seconds

    def checkpointed(self, clock: Clock) -> None:
        """Restart the interval."""
        self._saved_at = clock.now()[0]

    def state(self) -> dict[str, Any]:
        """JSON-able state for a checkpoint."""
        return {"step": self.step, "curve": self.curve, "held": [[k, *v] for k, v in self._held.items()]}

    def restore(self, meta: dict[str, Any]) -> None:
        """The state of a checkpoint."""
        self.step = int(meta["step"])
        self.curve = list(meta["curve"])
        self._held = {int(k): (float(e), int(n)) for k, e, n in meta["held"]}
