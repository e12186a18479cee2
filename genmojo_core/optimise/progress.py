"""Where a run stands: clocks, steps, the accuracy-against-time curve, time left."""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any, Literal

import torch

from genmojo_core.config import LIFT_SHARE, OUTWARD_SHARE, RunConfig, goal_of
from genmojo_core.events import Step
from genmojo_core.optimise.gain import StopRule
from genmojo_core.optimise.objective import HeldOut, Objective, Outcome
from genmojo_core.optimise.schedule import Pace, Stage
from genmojo_core.store.atomic import append_line, write_bytes
from genmojo_core.store.safe import json_text

CURVE_EVERY = 20  # steps between points of the curve
SCORED_FRAMES = 48  # frames that took no part yet and are looked at, at most


class Clock:
    """Wall and CPU seconds since the optimisation started, over interruptions; `counts`: which the budget counts."""

    def __init__(self, counts: Literal["wall", "cpu"] = "wall") -> None:
        self._counts = counts
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
        wall, cpu = self._held or (time.perf_counter(), time.process_time())
        return wall - self._wall + self._earlier[0], cpu - self._cpu + self._earlier[1]

    def this_run(self) -> float:
        """Seconds since this run started, earlier runs of a resumed one left out: what the budget counts."""
        wall, cpu = self._held or (time.perf_counter(), time.process_time())
        return cpu - self._cpu if self._counts == "cpu" else wall - self._wall

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
        self.curve: list[dict[str, float]] = []
        self.window = max(8, frames)
        self.curve_path: Path | None = None
        self._held: dict[int, HeldOut] = {}  # latest held-out errors of every frame
        self._in_play: set[int] = set()  # frames that took part in a step
        self._last: Outcome | None = None
        self._stage = stages[0]
        self._stage_step = 0
        self._saved_at = 0.0
        self._pace: Pace | None = None
        self._paced_from = ("", 0, 0.0)  # stage, step and seconds of this run at the first event of a stage
        self._goal = goal_of(config.until)
        self._rule = StopRule()

    @property
    def total(self) -> int:
        """Steps of all stages."""
        return max(1, sum(s.steps for s in self.stages))

    def begin(self, stage: Stage) -> int:
        """Enter a stage; returns the step within it to go on from (not 0 after a resume)."""
        before = sum(s.steps for s in self.stages[: self.stages.index(stage)])
        self._stage = stage
        self._stage_step = min(max(self.step - before, 0), stage.steps)
        return self._stage_step

    def advance(self, outcome: Outcome) -> bool:
        """Count a step; True if the curve should get a point now."""
        self.step += 1
        self._stage_step += 1
        self._last = outcome
        self._in_play.update(row.frame for row in outcome.held_out)
        self._take(outcome)
        return self.step % CURVE_EVERY == 0 or self.step == 1

    def score_rest(self, objective: Objective, apart: Sequence[int], deform: bool, clock: Clock) -> None:
        """Held-out errors of frames that took no part yet, so that the curve is about the whole clip from its start.

        Else it falls whenever frames join that no step has seen. `apart`: frames that never take part. The clock
        stands still.
        """
        rest = [t for t in range(objective.frames) if t not in self._in_play and t not in apart]
        clock.hold()
        with torch.no_grad():
            for t in rest[:: max(1, math.ceil(len(rest) / SCORED_FRAMES))]:
                self._take(objective.evaluate([t], deform, torch.Generator().manual_seed(0)))
        clock.go_on()

    def _take(self, outcome: Outcome) -> None:
        self._held.update({row.frame: row for row in outcome.held_out if row.count and math.isfinite(row.squared)})

    def point(self, clock: Clock, gaussians: int, **figures: float) -> None:
        """Add a point to the curve, with further figures of this moment, and a line to its file if it has one.

        Raises GenmojoError("io").
        """
        wall, cpu = clock.now()
        row = {"seconds": wall, "cpu_seconds": cpu, "step": float(self.step), "gaussians": float(gaussians)}
        self.curve.append({**row, "psnr_held_out": self.psnr(), "ssim_held_out": self.ssim(), **figures})
        if self.curve_path is not None:
            append_line(self.curve_path, json_text(self.curve[-1]), first=len(self.curve) == 1)

    def psnr(self) -> float:
        """PSNR in dB over the held-out blocks of all frames, each as last rendered; 0 if there are none."""
        error = sum(row.squared for row in self._held.values())
        count = sum(row.count for row in self._held.values())
        return -10.0 * math.log10(max(error / count, 1e-10)) if count else 0.0

    def ssim(self) -> float:
        """Mean SSIM of the windows around held-out pixels, each as last rendered; 0 if there are none."""
        count = sum(row.count for row in self._held.values())
        return sum(row.similar for row in self._held.values()) / count if count else 0.0

    def pace(self, stage: Stage, done: int, clock: Clock) -> Stage:
        """In a paced run: the stage with as many steps as its time allows, known from now on."""
        now, budget = clock.this_run(), self.config.budget_seconds
        if self._pace is None or self._pace.name != stage.name:
            share = 1.0 if stage is self.stages[-1] else LIFT_SHARE
            self._pace = Pace(stage.name, done, now, now + share * max(budget - now, 0.0))
        fitted = self._pace.refit(stage, done, now)
        self.stages = [fitted if known is stage else known for known in self.stages]
        self._stage = fitted
        return fitted

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
        outcome = self._last
        return Step(wall, cpu, self._stage.name, self._stage_step, self._stage.steps, float(outcome.loss.detach()),
                    outcome.parts, gaussians, self.psnr(), self.fraction(clock), self._seconds_left(clock))  # fmt: skip

    def _seconds_left(self, clock: Clock) -> float:
        """Until the run ends, by the pace of this stage's steps (not by what went before them), within the budget."""
        spent = clock.this_run()
        if self._paced_from[0] != self._stage.name:
            self._paced_from = self._stage.name, self.step, spent
        _, step, began = self._paced_from
        seconds, steps = (spent - began, self.step - step) if self.step > step else (spent, self.step)
        return max(0.0, min(seconds / steps * (self.total - self.step), self.config.budget_seconds - spent))

    def checkpoint_due(self, clock: Clock) -> bool:
        """True every `checkpoint_seconds`."""
        return clock.now()[0] - self._saved_at >= self.config.checkpoint_seconds

    def checkpointed(self, clock: Clock) -> None:
        """Restart the interval."""
        self._saved_at = clock.now()[0]

    def state(self) -> dict[str, Any]:
        """JSON-able state for a checkpoint."""
        return {"step": self.step, "curve": self.curve, "held": [asdict(row) for row in self._held.values()]}

    def restore(self, meta: dict[str, Any]) -> None:
        """The state of a checkpoint."""
        self.step = int(meta["step"])
        self.curve = list(meta["curve"])
        self._held = {int(row["frame"]): HeldOut(**row) for row in meta["held"]}
        if self.curve_path is not None and self.curve:
            write_bytes(self.curve_path, "".join(f"{json_text(row)}\n" for row in self.curve).encode())
