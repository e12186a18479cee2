"""From nothing to a weight file: both trainings, the table, the description."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import torch

from genmojo_core import __version__
from genmojo_core.errors import GenmojoError
from genmojo_core.priors import generator, weights
from genmojo_core.priors.agreement import training_percentile
from genmojo_core.priors.denoiser import LOG_SIGMA, Denoiser
from genmojo_core.priors.embedded import EmbeddedPrior
from genmojo_core.priors.held_out import table
from genmojo_core.priors.tasks import DenoiserTask, VolumeTask
from genmojo_core.priors.test_set import recorded
from genmojo_core.priors.training import Progress, TrainingPlan, read_metadata, train
from genmojo_core.priors.volume import VolumeNet


@dataclass(frozen=True)
class Times:
    """CPU seconds for the volume and the denoiser, objects per step, seed, device; weight file to start from."""

    volume: float
    denoiser: float
    objects: int = 8
    seed: int = 0
    device: str = "cpu"
    start: Path | None = None


def make_prior(folder: Path, times: Times, hear: Callable[[str, Progress], None]) -> Path:
    """Train in `folder`, or go on there; returns the path of the weight file.

    Raises GenmojoError("io") where the folder cannot be written, "schema" for a state of other networks, and as
    `weights.read` for the file to start from.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise GenmojoError("io", f"cannot be made ({error.strerror})", str(folder), "choose another folder") from error
    torch.manual_seed(times.seed)
    if times.start is None:
        volume, denoiser = VolumeNet(), Denoiser()
    else:
        known = weights.read(times.start)
        volume, denoiser = known.volume.requires_grad_(True), known.denoiser.requires_grad_(True)

    def report(part: str) -> Callable[[Progress], bool]:
        def tell(progress: Progress) -> bool:
            hear(part, progress)
            return True

        return tell

    plan = TrainingPlan(times.volume, times.objects, seed=times.seed, device=times.device)
    train(VolumeTask(volume), folder, plan, report("volume"))
    plan = replace(plan, seconds=times.denoiser)
    train(DenoiserTask(denoiser, volume), folder, plan, report("denoiser"))  # freezes the volume
    prior = EmbeddedPrior(volume.cpu(), denoiser.cpu())
    prior.agreement = training_percentile(prior.volume)
    path = folder / weights.SHIPPED.name
    states = {part: read_metadata(folder / f"{part}.safetensors") for part in ("volume", "denoiser")}
    weights.write(path, prior, description(prior, times, states))
    return path


def description(prior: EmbeddedPrior, times: Times, states: dict[str, dict[str, Any]]) -> dict[str, Any]:
    """What the file says about itself: origin, training, the table on the frozen test set.

    states: by part, the state's `steps` and `seconds`, earlier runs included; what the file that training started from
    had seen is added.
    """
    before = {} if times.start is None else weights.describe(times.start)
    seen, spent = before.get("objects_seen", {}), before.get("seconds", {})
    return {
        "program": f"genmojo {__version__}", "licence": "as the program's",
        "data": "procedural objects of this program only; no third-party image, mesh or weight",
        "generator": generator.VERSION, "test_set": recorded()["sha256"], "seed": times.seed,
        "objects_seen": {p: int(s["steps"]) * times.objects + seen.get(p, 0) for p, s in states.items()},
        "seconds": {p: round(float(s["seconds"]) + spent.get(p, 0.0), 1) for p, s in states.items()},
        "sigma": [2.718281828**level for level in LOG_SIGMA],
        "held_out": {name: {k: round(v, 3) for k, v in row.items()} for name, row in table(prior.volume).items()},
    }  # fmt: skip


def described(path: Path) -> dict[str, Any]:
    """The description of a weight file."""
    return weights.describe(path)
