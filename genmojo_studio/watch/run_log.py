"""What a run has said so far, as columns: curves, CSV and forecasts are made from it. Knows no Qt."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from genmojo_core.effects.texts import Said


@dataclass(frozen=True)
class Mark:
    """Something that happened at a moment of the run: a stage, a checkpoint, an effect, a warning.

    `said`: of an effect, why it was switched, by key (effects/texts.py); `text` has the same in English.
    """

    seconds: float
    kind: str
    text: str
    said: tuple[Said, ...] = ()


@dataclass
class StageTime:
    """A stage of the run: planned and done steps, and seconds since the start of the run."""

    name: str
    steps: int
    began: float
    done: int = 0
    ended: float | None = None


@dataclass
class RunLog:
    """Columns over the optimiser's steps, in the order they came.

    seconds, step, stage, gaussians, step_ms: one value per step. A resumed run takes steps after its checkpoint again:
    the newer ones stand for the older. losses: name -> values, NaN where a step has not that loss.
    accuracy: rows (seconds, step, held-out PSNR in dB). memory: rows (seconds, MB). marks, stages: see there.
    """

    seconds: list[float] = field(default_factory=list)
    step: list[int] = field(default_factory=list)
    stage: list[str] = field(default_factory=list)
    gaussians: list[int] = field(default_factory=list)
    step_ms: list[float] = field(default_factory=list)
    losses: dict[str, list[float]] = field(default_factory=dict)
    accuracy: list[tuple[float, int, float]] = field(default_factory=list)
    memory: list[tuple[float, float]] = field(default_factory=list)
    marks: list[Mark] = field(default_factory=list)
    stages: list[StageTime] = field(default_factory=list)
    progress: float = 0.0
    eta_seconds: float = math.nan
    outcome: str = ""

    def add(self, event: Mapping[str, Any]) -> None:
        """Takes an event of `genmojo_core.events` as JSON; kinds it does not know are left out."""
        kind, at = str(event.get("event", "")), float(event.get("seconds", 0.0))
        if kind == "Step":
            self._add_step(event, at)
        elif kind == "StageStarted":
            self._close_stage(at)
            names = [stage.name for stage in self.stages]
            if event["stage"] in names:  # resumed: this stage and those after it come again
                del self.stages[names.index(event["stage"]) :]
            self.stages.append(StageTime(str(event["stage"]), int(event["steps"]), at))
            self.marks.append(Mark(at, "stage", str(event["stage"])))
        elif kind == "EffectChanged":
            said = tuple((str(key), values) for key, values in event.get("said") or ())
            self.marks.append(Mark(at, "effect", str(event["reason"]), said))
        elif kind == "ParameterChanged":
            self.marks.append(Mark(at, "parameter", f"{event['name']}: {event['old']:g} → {event['new']:g}"))
        elif kind == "Checkpointed":
            self.marks.append(Mark(at, "checkpoint", str(event["step"])))
        elif kind == "Warned":
            self.marks.append(Mark(at, "warning", str(event["message"])))
        elif kind in ("Finished", "Failed"):
            self._close_stage(at)
            self.outcome = str(event.get("reason") or event.get("message") or "")

    @classmethod
    def of_scene(cls, curve: Iterable[Mapping[str, float]]) -> RunLog:
        """The log of a scene file: only its accuracy-against-time curve is kept there."""
        log = cls()
        for row in curve:
            log.accuracy.append((float(row["seconds"]), int(row["step"]), float(row["psnr_held_out"])))
            log.seconds.append(float(row["seconds"]))
            log.step.append(int(row["step"]))
            log.stage.append("")
            log.gaussians.append(int(row.get("gaussians", 0)))
            log.step_ms.append(math.nan)
        return log

    def add_memory(self, megabytes: float) -> None:
        """The worker's memory as its heartbeat told it, at the time of the newest step."""
        self.memory.append((self.now, megabytes))

    @property
    def now(self) -> float:
        """Seconds of the run that the newest step tells."""
        return self.seconds[-1] if self.seconds else 0.0

    def column(self, name: str) -> np.ndarray:
        """One column by name: "seconds", "step", "gaussians", "step_ms" or a loss."""
        values = getattr(self, name) if name in ("seconds", "step", "gaussians", "step_ms") else self.losses[name]
        return np.asarray(values, np.float64)

    def to_csv(self) -> str:
        """Every step as a row; the newest held-out PSNR stands in the row of the step it was measured at."""
        measured = {step: value for _, step, value in self.accuracy}
        buffer = io.StringIO()
        writer = csv.writer(buffer)
        names = list(self.losses)
        writer.writerow(["seconds", "step", "gaussians", "step_ms", "psnr_held_out_db", *names])
        for i, step in enumerate(self.step):
            row = [f"{self.seconds[i]:.4f}", step, self.gaussians[i], f"{self.step_ms[i]:.3f}", measured.get(step, "")]
            writer.writerow([*row, *(_number(self.losses[name][i]) for name in names)])
        return buffer.getvalue()

    def _add_step(self, event: Mapping[str, Any], at: float) -> None:
        stage, step = str(event.get("stage", "")), int(event["step"])
        if self.step and (step <= self.step[-1] or stage != self.stage[-1]):
            self._take_back(stage, step)
        before = self.seconds[-1] if self.seconds else None
        self.step_ms.append((at - before) * 1000 if before is not None and at >= before else math.nan)
        self.seconds.append(at)
        self.step.append(step)
        self.stage.append(stage)
        self.gaussians.append(int(event["gaussians"]))
        values = {"total": float(event["loss"]), **{k: float(v) for k, v in dict(event["losses"]).items()}}
        for name, value in values.items():
            if name not in self.losses:
                self.losses[name] = [math.nan] * (len(self.seconds) - 1)
            self.losses[name].append(value)
        for name, column in self.losses.items():
            if name not in values:
                column.append(math.nan)
        measured = event.get("psnr_held_out")
        if measured is not None and (not self.accuracy or self.accuracy[-1][2] != float(measured)):
            self.accuracy.append((at, int(event["step"]), float(measured)))
        self.progress = float(event.get("progress", 0.0))
        self.eta_seconds = float(event.get("eta_seconds", math.nan))
        if self.stages:
            self.stages[-1].done = self.stage.count(stage)

    def _take_back(self, stage: str, step: int) -> None:
        """Forgets a step that comes again, and everything after it."""
        known = list(zip(self.stage, self.step, strict=True))
        if (stage, step) not in known:
            return
        first = known.index((stage, step))
        last = self.seconds[first]
        self.accuracy = [row for row in self.accuracy if row[0] < last]
        self.memory = [row for row in self.memory if row[0] < last]
        for column in (self.seconds, self.step, self.stage, self.gaussians, self.step_ms, *self.losses.values()):
            del column[first:]  # type: ignore[attr-defined]

    def _close_stage(self, at: float) -> None:
        if self.stages and self.stages[-1].ended is None:
            self.stages[-1].ended = at


def _number(value: float) -> str:
    return "" if math.isnan(value) else f"{value:.6g}"
