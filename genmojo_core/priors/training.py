"""Training of the embedded prior on its own procedural objects: resumable, on the CPU or a GPU, with a log.

Two parts, one after the other: "volume" (VolumeNet), then "denoiser" around the pictures of the finished volume. A
folder holds the state (`volume.safetensors`, `denoiser.safetensors`) and `training.jsonl`, one line per measurement.
Every batch is drawn from (seed, step), so a resumed run sees what an uninterrupted one would have seen.
"""

from __future__ import annotations

import json
import math
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

import numpy as np
import torch
from safetensors.torch import load_file, save
from torch import Tensor, nn

from genmojo_core.errors import GenmojoError
from genmojo_core.priors.batches import Batch, batch_of, make_batch
from genmojo_core.priors.test_set import frozen_examples
from genmojo_core.store.atomic import write_bytes

EMA = 0.995
REPORT_EVERY = 60.0  # seconds of CPU time between measurements and checkpoints
LAST_SEED = 2**31 - 1


@dataclass(frozen=True)
class TrainingPlan:
    """One part's training.

    Args:
        seconds: CPU seconds (wall seconds on a GPU) that the learning rate's cosine spans; training ends there.
        objects: per step. rate: largest learning rate. seed: of the batches. device: "cpu" or "cuda".
    """

    seconds: float
    objects: int = 8
    rate: float = 1.5e-3
    seed: int = 0
    device: str = "cpu"


class Task(Protocol):
    """What one part learns: `name`, `net`, a loss on a batch, figures on the frozen test set."""

    name: str
    net: nn.Module

    def loss(self, batch: Batch, generator: torch.Generator) -> Tensor:
        """Scalar to minimise."""
        ...

    def measure(self, batch: Batch) -> dict[str, float]:
        """Figures of `net` on the test set, with the weights it has."""
        ...


@dataclass(frozen=True)
class Progress:
    """Where training stands; figures by name, seconds as in `TrainingPlan`."""

    step: int
    seconds: float
    share: float
    figures: dict[str, float]


def train(task: Task, folder: Path, plan: TrainingPlan, report: Callable[[Progress], bool]) -> nn.Module:
    """Train one part until its time is used up or `report` returns False; returns the net with averaged weights.

    A state in `folder` is gone on from; its spent seconds count. Raises GenmojoError("schema") for a state of another
    architecture, "io" where the folder cannot be written.
    """
    state = _State(task, plan)
    state.restore(folder)
    if not state.steps:
        state.save(folder)
    test = batch_of(frozen_examples(), plan.device)
    clock, last, losses = _clock(plan), state.seconds, [0.0]
    begin = clock() - state.seconds
    while state.seconds < plan.seconds:
        losses.append(state.step())
        state.seconds = clock() - begin
        if state.seconds - last > REPORT_EVERY or state.seconds >= plan.seconds:
            last = state.seconds
            figures = {"loss": float(np.mean(losses[-400:])), **state.averaged(lambda: task.measure(test))}
            state.save(folder)
            progress = Progress(state.steps, state.seconds, min(1.0, state.seconds / plan.seconds), figures)
            _log(folder, task.name, progress)
            if not report(progress):
                break
            begin = clock() - state.seconds  # measuring is not training
    state.use_averages()
    return task.net


class _State:
    """Weights, their running average, optimiser."""

    def __init__(self, task: Task, plan: TrainingPlan) -> None:
        self.task, self.plan = task, plan
        task.net.to(plan.device)
        self.parameters = {name: p for name, p in task.net.named_parameters() if p.requires_grad}
        self.average = {name: p.detach().clone() for name, p in self.parameters.items()}
        self.optimiser = torch.optim.AdamW(self.parameters.values(), lr=plan.rate, betas=(0.9, 0.99))
        self.steps, self.seconds = 0, 0.0

    def step(self) -> float:
        """One batch; returns its loss."""
        share = min(1.0, self.seconds / self.plan.seconds)
        warm = min(1.0, (self.steps + 1) / 100)
        for group in self.optimiser.param_groups:
            group["lr"] = self.plan.rate * warm * (0.02 + 0.98 * 0.5 * (1 + math.cos(math.pi * share)))
        batch = make_batch(np.random.default_rng((self.plan.seed, self.steps)), self.plan.objects, self.plan.device)
        generator = torch.Generator(self.plan.device).manual_seed(hash((self.plan.seed, self.steps)) % LAST_SEED)
        loss = self.task.loss(batch, generator)
        self.optimiser.zero_grad(set_to_none=True)
        loss.backward()
        nn.utils.clip_grad_norm_(self.parameters.values(), 1.0)
        self.optimiser.step()
        self.steps += 1
        keep = min(EMA, self.steps / (self.steps + 10))
        with torch.no_grad():
            for name, p in self.parameters.items():
                self.average[name].lerp_(p, 1 - keep)
        return float(loss.detach())

    def averaged(self, measure: Callable[[], dict[str, float]]) -> dict[str, float]:
        """What `measure` says with the averaged weights in place."""
        own = {name: p.detach().clone() for name, p in self.parameters.items()}
        self.use_averages()
        with torch.no_grad():
            figures = measure()
            for name, p in self.parameters.items():
                p.copy_(own[name])
        return figures

    def use_averages(self) -> None:
        """Put the averaged weights into the net."""
        with torch.no_grad():
            for name, p in self.parameters.items():
                p.copy_(self.average[name])

    def save(self, folder: Path) -> None:
        """Write everything a resumed run needs."""
        tensors = {f"net/{name}": p.detach() for name, p in self.parameters.items()}
        tensors |= {f"average/{name}": a for name, a in self.average.items()}
        for name, p in self.parameters.items():
            tensors |= {f"optimiser/{name}/{k}": v for k, v in self.optimiser.state[p].items() if torch.is_tensor(v)}
        meta = {"steps": str(self.steps), "seconds": str(self.seconds)}
        write_bytes(folder / f"{self.task.name}.safetensors",
                    save({k: v.contiguous().cpu() for k, v in tensors.items()}, metadata=meta))  # fmt: skip

    def restore(self, folder: Path) -> None:
        """Go on from the state in `folder`, if there is one."""
        path = folder / f"{self.task.name}.safetensors"
        if not path.is_file():
            return
        tensors = load_file(path, device=self.plan.device)
        with torch.no_grad():
            for name, p in self.parameters.items():
                stored = tensors.get(f"net/{name}")
                if stored is None or stored.shape != p.shape:
                    raise GenmojoError("schema", f"holds the state of another network (differs in {name})", str(path),
                                       "use another folder")  # fmt: skip
                p.copy_(stored)
                self.average[name].copy_(tensors[f"average/{name}"])
                keys = [k for k in tensors if k.startswith(f"optimiser/{name}/")]
                self.optimiser.state[p] = {k.rsplit("/", 1)[1]: tensors[k].clone() for k in keys}
        meta = read_metadata(path)
        self.steps, self.seconds = int(meta["steps"]), float(meta["seconds"])


def read_metadata(path: Path) -> dict[str, Any]:
    """The metadata of a safetensors file. Raises GenmojoError("corrupt") for another kind of file."""
    with open(path, "rb") as stream:
        size = int.from_bytes(stream.read(8), "little")
        if not 2 <= size < 1 << 24:
            raise GenmojoError("corrupt", "is no safetensors file", str(path))
        try:
            header = json.loads(stream.read(size))
        except ValueError as error:
            raise GenmojoError("corrupt", "is no safetensors file", str(path)) from error
    return dict(header.get("__metadata__") or {})


def _clock(plan: TrainingPlan) -> Callable[[], float]:
    """CPU seconds of this process; wall seconds where a GPU does the work."""
    return time.process_time if plan.device == "cpu" else time.monotonic


def _log(folder: Path, name: str, progress: Progress) -> None:
    """One line of the log."""
    row = {"part": name, "step": progress.step, "seconds": round(progress.seconds, 1), **progress.figures}
    with open(folder / "training.jsonl", "a") as stream:
        stream.write(json.dumps({k: round(v, 5) if isinstance(v, float) else v for k, v in row.items()}) + "\n")
