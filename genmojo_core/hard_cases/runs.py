"""Whole runs on hostile clips, seconds each, and what has to hold after any of them."""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import torch

from genmojo_core.clip.clip import Clip
from genmojo_core.config import RunConfig, preset
from genmojo_core.effects.decide import plan
from genmojo_core.errors import GenmojoError
from genmojo_core.estimate.complete import complete
from genmojo_core.events import Event, Failed, Finished, Step, Warned
from genmojo_core.hard_cases.case import hold
from genmojo_core.optimise.run import Run
from genmojo_core.store.scene_file import BakedScene

REACH = 10.0  # object sizes: no Gaussian goes farther (RELIABILITY.md N28)
BENDING = {"non_rigid_motion": True, "appearance_change": True, "background": True}  # everything there is to go wrong


@dataclass(frozen=True)
class Outcome:
    """A finished run: the clip as it was optimised, the run, its events, the scene it gave."""

    clip: Clip
    run: Run
    events: list[Event]
    scene: BakedScene

    @property
    def psnr(self) -> float:
        """Foreground PSNR in dB of the last preview or step."""
        with torch.no_grad():
            seen = self.run.objective.evaluate(list(range(len(self.clip))), True, torch.Generator().manual_seed(0))
        return float(np.mean([psnr for _, psnr in seen.foreground])) if seen.foreground else 0.0

    @property
    def warnings(self) -> list[str]:
        """What the user was told."""
        return [event.message for event in self.events if isinstance(event, Warned)]


def small_config(**changes: Any) -> RunConfig:
    """A run of seconds with everything in it that a long one has."""
    settings: dict[str, Any] = {
        "gaussians_per_object": 120, "background_gaussians": 200, "lift_steps": 5, "joint_steps": 10, "settle_steps": 5,
        "budget_seconds": 1e6, "plane_resolution": 8, "plane_levels": (1,), "plane_channels": 8, "field_width": 16,
        "motion_bases": 3, "densify_every": 4, "neighbours": 5, "frames_per_step": 2, "short_side": 32,
    }  # fmt: skip
    return preset("draft", **{**settings, **changes})


def started(clip: Clip, effects: dict[str, bool] | None = None, **changes: Any) -> Run:
    """A run of the clip, completed first; by default with every effect that fits it."""
    config = small_config(**changes)
    whole = complete(clip)
    wanted = (BENDING if len(whole) > 1 else {}) if effects is None else effects
    return Run(whole, plan(whole, config, wanted), config)


def finished(clip: Clip, effects: dict[str, bool] | None = None, **changes: Any) -> Outcome:
    """Run the clip to its end and check what has to hold after every run. Raises BrokenError."""
    run = started(clip, effects, **changes)
    events = list(run)
    return checked(run, events)


def checked(run: Run, events: list[Event]) -> Outcome:
    """The outcome of a run that reached its end with sound numbers. Raises BrokenError."""
    last = events[-1]
    hold(not isinstance(last, Failed), f"the run failed: {getattr(last, 'message', '')}")
    hold(isinstance(last, Finished), f"the run ended with {type(last).__name__}")
    for event in events:
        if isinstance(event, Step):
            hold(math.isfinite(event.loss) or any("left out" in w for w in _warned(events)),
                 f"the loss of step {event.step} was {event.loss} and nobody was told")  # fmt: skip
            hold(event.psnr_held_out is None or math.isfinite(event.psnr_held_out), "the held-out PSNR is no number")
    for name, value in run.scene.named_parameters():
        hold(bool(torch.isfinite(value).all()), f"{name} is not finite")
    for model in run.scene.objects:
        far = float(model.gaussians.means.detach().abs().max())
        hold(far < REACH, f"a Gaussian of {model.name} is {far:.1f} object sizes away")
    scene = run.bake()
    arrays = {"xyz": scene.xyz, "scale": scene.scale, "d_xyz": scene.d_xyz, "object_to_world": scene.object_to_world}
    for name, array in arrays.items():
        hold(bool(np.isfinite(array).all()), f"{name} of the scene is not finite")
    return Outcome(run.clip, run, events, scene)


def refused(clip: Clip, **changes: Any) -> GenmojoError:
    """The one sentence a clip without anything to optimise is refused with. Raises BrokenError if it is not refused."""
    try:
        list(started(clip, **changes))
    except GenmojoError as error:
        hold("\n" not in error.sentence(), "the refusal is longer than a sentence")
        return error
    hold(False, "it was not refused")
    raise ValueError("unreachable")


def same_scene(a: Outcome, b: Outcome) -> bool:
    """Whether two runs ended with the same parameters, bit for bit."""
    pairs = zip(_parameters(a), _parameters(b), strict=True)
    return all(torch.equal(x, y) for x, y in pairs)


def centre(outcome: Outcome, k: int, t: int) -> np.ndarray:  # (2,) raster pixels
    """Where scene object k is drawn in frame t: the mean of its Gaussians, projected."""
    model = outcome.run.scene.objects[k]
    with torch.no_grad():
        world = model.states([t], True)[0].means.double().mean(dim=0).numpy()
    cameras = outcome.clip.cameras.value
    place = cameras.world_to_camera[t] @ [*world, 1.0]
    k3 = cameras.K[t]
    return np.array([k3[0, 0] * place[0] / place[2] + k3[0, 2], k3[1, 1] * place[1] / place[2] + k3[1, 2]])


def memory_mb() -> float:
    """Largest resident memory of this process so far in MiB; 0 where the system does not tell."""
    try:
        import resource
    except ImportError:  # Windows
        return 0.0
    most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return most / (1 << 20) if sys.platform == "darwin" else most / 1024


def _parameters(outcome: Outcome) -> Iterator[torch.Tensor]:
    return (value.detach() for _, value in outcome.run.scene.named_parameters())


def _warned(events: list[Event]) -> list[str]:
    return [event.message for event in events if isinstance(event, Warned)]
