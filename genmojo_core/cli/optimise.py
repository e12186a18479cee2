"""`genmojo effects` and `genmojo optimize`: a clip in, its effect plan or its 4D scene out."""

from __future__ import annotations

import argparse
import math
import signal
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from types import FrameType
from typing import TYPE_CHECKING, Any

from genmojo_core.cli import arguments, models
from genmojo_core.cli.expectation import expectation, foretell, send_pilot
from genmojo_core.cli.output import progress, say
from genmojo_core.config import RunConfig, preset
from genmojo_core.errors import GenmojoError

if TYPE_CHECKING:
    from genmojo_core.clip.clip import Clip
    from genmojo_core.effects.plan import EffectPlan
    from genmojo_core.events import Event
    from genmojo_core.optimise.run import Run
    from genmojo_core.store.scene_file import BakedScene


_GLANCE = 64  # pixels at which one frame is read to learn the clip's size


def add_commands(commands: Any) -> None:
    """Add `effects` and `optimize`."""
    effects = commands.add_parser("effects", help="what a clip calls for, and why")
    arguments.add_clip_options(effects)
    arguments.add_config_options(effects)
    models.add_model_options(effects)
    effects.add_argument("--pilot", action="store_true", help="run the clip small and short first (some seconds, "
                         "once), so that dB are foretold better, here and by later commands")  # fmt: skip
    effects.set_defaults(run=run_effects)
    optimize = commands.add_parser("optimize", help="clip to 4D scene")
    arguments.add_clip_options(optimize)
    arguments.add_config_options(optimize)
    models.add_model_options(optimize)
    optimize.add_argument("-o", "--output", required=True, metavar="scene.h5")
    optimize.add_argument("--run-dir", metavar="DIR", help="where checkpoints go")
    optimize.add_argument("--resume", action="store_true", help="go on from the run folder's checkpoint")
    optimize.add_argument("--no-pilot", action="store_true", help="foretell dB without the pilot that a run of more "
                          "than a minute sends ahead where it takes at most a tenth of the run's time")  # fmt: skip
    optimize.set_defaults(run=run_optimize)


def run_effects(args: argparse.Namespace) -> dict[str, Any]:
    """The effect plan of a clip."""
    from genmojo_core.effects.machine import known_costs

    config = configured(args)
    clip, plan = _prepare(args, config)
    if args.pilot:
        send_pilot(clip, plan, args.clip, args.frames)
    expected = expectation(clip, plan, config)
    if expected is not None:
        say(expected.sentence())
    known = known_costs()
    rows = [{**row, "known": known.get(row["name"])} for row in plan.to_json()]
    return {"clip": clip.name, "frames": len(clip), "effects": rows, "guesses": list(clip.guesses),
            "preset": config.preset, "forecast": None if expected is None else expected.forecast.to_json(),
            "pilot_seconds": None if expected is None else expected.pilot_seconds}  # fmt: skip


def run_optimize(args: argparse.Namespace) -> dict[str, Any]:
    """Optimise, write the scene, measure it. Ctrl-C ends after the present step and keeps the work (exit 130)."""
    from genmojo_core.store.atomic import check_writable

    config = configured(args)
    if args.resume and args.run_dir is None:
        raise GenmojoError("argument", "there is no run folder to resume from", "--resume", "give --run-dir")
    check_writable(args.output)
    start = time.monotonic()
    compiling = _compile_meanwhile(config)
    try:
        clip, plan = _prepare(args, config)
    finally:
        if compiling is not None:
            compiling.join()
    pilot = not (args.no_pilot or args.resume)
    job = Job(args.output, args.clip, start, args.frames, args.run_dir, args.resume, pilot)
    return optimize_clip(clip, plan, config, job)


def configured(args: argparse.Namespace) -> RunConfig:
    """The run's configuration: a preset, or with only a budget what gives most in that time (effects/auto.py).

    Raises GenmojoError as `preset` and reading the clip.
    """
    changes = arguments.config_changes(args)
    name = args.preset or ("auto" if args.budget is not None else "standard")
    if name != "auto":
        return preset(name, **changes)
    from genmojo_core.clip import folders
    from genmojo_core.effects.auto import AUTO_SECONDS, for_budget

    first = args.frames[0] if args.frames else 0
    clip = folders.read(args.clip, frames=(first, first + 1), short_side=_GLANCE, pixel_aspect=args.pixel_aspect)
    return for_budget(changes.pop("budget_seconds", AUTO_SECONDS), clip, **changes)


def _compile_meanwhile(config: RunConfig) -> threading.Thread | None:
    """Compile the CPU kernels while the clip is read; once compiled they are kept for later runs."""
    if config.device.startswith("cuda"):
        return None
    from genmojo_core.render import backend

    return backend.warm_up(say)


@dataclass(frozen=True)
class Job:
    """What a run is for.

    Args:
        output: scene file to write. source: the clip's path and frames: its positions, read again for measuring.
        start: time.monotonic() when the command began.
        run_dir: where checkpoints go, or None. resume: go on from the one there.
        pilot: send a pilot ahead where it pays (cli/expectation.py).
    """

    output: str
    source: str
    start: float
    frames: tuple[int, int | None] | None = None
    run_dir: str | None = None
    resume: bool = False
    pilot: bool = False


def optimize_clip(clip: Clip, plan: EffectPlan, config: RunConfig, job: Job) -> dict[str, Any]:
    """Run to the end or to Ctrl-C, write the scene, measure it; returns what `optimize --json` prints."""
    from genmojo_core.effects import forecast
    from genmojo_core.measure import effect_costs
    from genmojo_core.measure.scoring import Scorer
    from genmojo_core.measure.truth import find_truth
    from genmojo_core.optimise.run import Run
    from genmojo_core.store import scene_hdf5

    expected = foretell(clip, plan, config, job.source, job.frames, job.pilot)
    curve_path = Path(job.output).with_suffix(".curve.jsonl")
    run = Run(clip, plan, config, run_dir=job.run_dir, resume=job.resume, curve_path=curve_path)
    scorer = None if find_truth(job.source) is None else Scorer(job.source, job.frames)
    watched = _Watched()
    with _stop_on_signal(run) as interrupted, progress("optimising") as tell:
        for event in run:
            watched.hear(event, tell)
            if scorer is not None:
                scorer.watch(run)
    if watched.first_scene is None:
        raise watched.fault or GenmojoError("empty", "was interrupted before the first scene stood", job.output,
                                            "let it run a little longer")  # fmt: skip
    scene = run.bake()
    scene_hdf5.write(scene, job.output)
    if watched.fault is not None:
        say(f"The scene up to step {watched.step} was kept in {job.output}.")
        raise watched.fault
    result: dict[str, Any] = {
        "seconds": time.monotonic() - job.start, "steps": watched.step, "psnr": None, "psnr_full": None,
        "peak_mb": peak_mb(), "effects": run.plan.to_json(), "path": str(job.output), "curve": scene.curve,
        "guesses": list(clip.guesses), "gaussians": len(scene.xyz), "optimise_seconds": watched.seconds,
        "cpu_seconds": watched.cpu_seconds, "first_scene_seconds": watched.first_scene, "reason": watched.reason,
        "frames": len(clip), "warnings": watched.warnings,
    }  # fmt: skip
    if interrupted():
        say(f"Interrupted; what stood was written to {job.output}.")
        return result | {"exit_code": 130}
    effect_costs.keep_run(clip.name, run.plan)
    figures = _measured(scene, clip, job)
    took = watched.cpu_seconds if config.clock == "cpu" else watched.seconds
    came = None if expected is None else forecast.outcome(expected, took, figures["psnr"])
    if came is not None:
        say(came["said"])
    metrics = scene.metrics | {key: float(value) for key, value in figures.items() if math.isfinite(value)}
    scene_hdf5.write(replace(scene, config={**scene.config, "forecast": came}, metrics=metrics), job.output)
    return result | figures | {"forecast": came}


def peak_mb() -> float:
    """Largest resident memory of this process so far, in MiB; 0 where the system does not tell."""
    try:
        import resource
    except ImportError:  # Windows
        return 0.0
    most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return most / (1 << 20) if sys.platform == "darwin" else most / 1024


def _prepare(args: argparse.Namespace, config: RunConfig) -> tuple[Clip, EffectPlan]:
    """Read the clip at the size to optimise, estimate what it lacks, decide the effects."""
    from genmojo_core.clip import folders, mask_file
    from genmojo_core.effects import decide
    from genmojo_core.estimate.complete import complete
    from genmojo_core.optimise import methods
    from genmojo_core.store import annotated_tracks

    overrides = {} if args.effects == "auto" else decide.parse_overrides(args.effects)
    external = models.models_of(args)
    with progress("reading") as tell, annotated_tracks.as_npz(args.tracks) as tracks:
        clip = folders.read(args.clip, frames=args.frames, short_side=config.short_side, ignore=args.ignore,
                            pixel_aspect=args.pixel_aspect, tracks=tracks)  # fmt: skip
        clip = mask_file.with_masks(clip, args.masks) if args.masks else clip
        tell(1.0)
    with progress("looking at the clip") as tell:
        clip = complete(clip, boxes=boxes_of(args), progress=lambda _, share: tell(share), models=external)
    clip, overrides = methods.prepared(clip, config.method, overrides)
    return clip, decide.plan(clip, config, overrides)


def boxes_of(args: argparse.Namespace) -> list[Any]:
    """The boxes given, one object each, in the frames that are read."""
    if not args.box:
        return []
    from genmojo_core.estimate.masks import Box

    first = args.frames[0] if args.frames else 0
    return [Box(frame - first, x0, y0, x1, y1, i + 1) for i, (frame, (x0, y0, x1, y1)) in enumerate(args.box)]


class _Watched:
    """What the events of a run said."""

    def __init__(self) -> None:
        self.step, self.seconds, self.cpu_seconds = 0, 0.0, 0.0
        self.reason = "done"
        self.first_scene: float | None = None
        self.fault: GenmojoError | None = None
        self.warnings: list[str] = []

    def hear(self, event: Event, tell: Any) -> None:
        """Take note of one event."""
        from genmojo_core import events

        self.seconds, self.cpu_seconds = event.seconds, event.cpu_seconds
        if isinstance(event, events.Step):
            self.step = event.step
            tell(event.progress)
        elif isinstance(event, events.Preview) and self.first_scene is None:
            self.first_scene = event.seconds
        elif isinstance(event, events.Warned | events.EffectChanged):
            message = event.message if isinstance(event, events.Warned) else event.reason
            self.warnings.append(message)
            say(message)
        elif isinstance(event, events.Finished):
            self.step, self.reason = event.step, event.reason
        elif isinstance(event, events.Failed):
            self.fault = GenmojoError("numeric", event.message.rstrip("."))


def _measured(scene: BakedScene, clip: Clip, job: Job) -> dict[str, float]:
    """PSNR at 256 on the short side, against the clip read at that size."""
    from genmojo_core.measure.reconstruction import as_measured, reconstruction

    with progress("measuring") as tell:
        return reconstruction(scene, as_measured(clip, job.source, job.frames), tell)


@contextmanager
def _stop_on_signal(run: Run) -> Iterator[Any]:
    """First Ctrl-C (or SIGTERM): the run ends after its step. Second: at once. Gives a function "was it pressed"."""
    pressed: list[int] = []

    def handler(number: int, _: FrameType | None) -> None:
        if pressed:
            raise KeyboardInterrupt
        pressed.append(number)
        run.stop()
        say("\nEnding after the present step and keeping what stands; once more ends at once.")

    previous = {number: signal.signal(number, handler) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield lambda: bool(pressed)
    finally:
        for number, old in previous.items():
            signal.signal(number, old)
