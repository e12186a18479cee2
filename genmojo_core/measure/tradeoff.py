"""`genmojo tradeoff`: which trials are run on a clip, in which order, within a budget, kept row by row."""

from __future__ import annotations

import hashlib
import json
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Any, Literal

from genmojo_core import __version__
from genmojo_core.clip.clip import Clip
from genmojo_core.config import LossWeights, RunConfig, preset
from genmojo_core.effects import decide
from genmojo_core.effects.auto import for_budget
from genmojo_core.effects.plan import EffectPlan
from genmojo_core.errors import GenmojoError
from genmojo_core.events import Event
from genmojo_core.measure.trials import Bench, Source, Trial
from genmojo_core.store.atomic import write_bytes
from genmojo_core.store.safe import json_text

EARLY = 1  # moments that come before the parts: every short report has some of everything
EVERY = 8  # of the frames is held out in every trial
LONGEST = 100_000  # joint steps: more than any time allows
SIZES = (128, 176)  # pixels: draft at other sizes than its own
# losses, no effects
TERMS = ("ssim", "alpha", "spill", "gaps", "hull", "depth", "rigidity", "rotation", "local_scale", "smooth")
BASE: dict[str, Any] = {
    "short_side": 128, "gaussians_per_object": 1000, "background_gaussians": 5000, "lift_steps": 20, "joint_steps": 80,
    "budget_seconds": 1e6,
}  # fmt: skip


@dataclass(frozen=True)
class Wanted:
    """What a report is made of.

    Args:
        source: the clip. budget: seconds of runs after which nothing new begins. seeds: most repetitions.
        moments: seconds at which presets are stopped and the budget-aware schedule is compared with them.
        presets: fixed ones. device, clock: as in RunConfig; with "cpu" all budgets and times are CPU seconds.
    """

    source: Source
    budget: float
    seeds: int = 3
    moments: tuple[float, ...] = (30.0, 60.0, 120.0)
    presets: tuple[str, ...] = ("draft", "standard")
    device: str = "auto"
    clock: Literal["wall", "cpu"] = "wall"

    @property
    def common(self) -> dict[str, Any]:
        """What all configurations share."""
        return {"device": self.device, "clock": self.clock, "held_out_every": EVERY}


def tradeoff(
    wanted: Wanted, folder: Path, hear: Callable[[str, Event], None]
) -> tuple[list[dict[str, Any]], list[str]]:
    """Rows of all trials there was time for, and the titles of those there was not.

    A row that lies in `folder/rows` already, of the same clip, configuration and version, is not run again, and what
    it took counts: a report that was broken off goes on where it stopped. `hear` takes a trial's title and its events.

    Raises GenmojoError as reading the clip.
    """
    bench = Bench(wanted.source)
    now = time.process_time if wanted.clock == "cpu" else time.monotonic
    clip, _ = bench.clip(preset("draft", **BASE))
    rows, left, spent = [], [], 0.0
    for trial in trials(clip, wanted):
        path = folder / "rows" / f"{trial.key}.json"
        digest = _digest(trial, wanted.source)
        row = _kept(path, digest)
        if row is None and spent >= wanted.budget:
            left.append(f"{trial.title}, seed {trial.config.seed}")
            continue
        if row is None:
            began = now()
            row = bench.run(trial, lambda event, name=trial.title: hear(name, event))  # type: ignore[misc]
            row |= {"digest": digest, "took": now() - began}
            write_bytes(path, json_text(row).encode())
        spent += float(row["took"])
        rows.append(row)
    return rows, left


def trials(clip: Clip, wanted: Wanted) -> Iterator[Trial]:
    """All trials in the order they are run: seed by seed, alternating forwards and backwards, neighbours comparable."""
    for seed in range(wanted.seeds):
        forward = seed % 2 == 0
        blocks = [list(_at_moments(clip, wanted, moment, seed)) for moment in wanted.moments]
        blocks = [block if (i % 2 == 0) == forward else block[::-1] for i, block in enumerate(blocks)]
        parts = list(_parts(clip, wanted, seed))
        growing = list(_growing(clip, wanted, seed)) if seed < 2 else []  # fitted exponents have a spread of their own
        sizes = list(_sizes(wanted, seed))
        for group in (*blocks[:EARLY], parts if forward else parts[::-1], growing, *blocks[EARLY:], sizes):
            yield from group


def _at_moments(clip: Clip, wanted: Wanted, moment: float, seed: int) -> Iterator[Trial]:
    """Fixed presets stopped at a moment, and the schedule that knew of it; draft has ended by itself after a while."""
    for name in wanted.presets:
        budget = min(moment, preset(name).budget_seconds)
        if moment > min((m for m in wanted.moments if m >= preset(name).budget_seconds), default=moment):
            continue
        config = preset(name, budget_seconds=budget, seed=seed, **wanted.common)
        yield Trial(f"{name}-{moment:g}s-{seed}", "preset", f"{name}, {moment:g} s", config, moment=moment)
    config = for_budget(moment, clip, seed=seed, **wanted.common)
    yield Trial(f"auto-{moment:g}s-{seed}", "preset", f"auto, {moment:g} s", config, moment=moment)


def _sizes(wanted: Wanted, seed: int) -> Iterator[Trial]:
    for size in SIZES:
        config = preset("draft", short_side=size, seed=seed, **wanted.common)
        yield Trial(f"size-{size}-{seed}", "size", f"draft at {size} px", config)


def _parts(clip: Clip, wanted: Wanted, seed: int) -> Iterator[Trial]:
    """A small run as it is planned, and the same steps with one effect or one loss term taken away or added."""
    base = preset("draft", seed=seed, **wanted.common, **BASE)
    plan = decide.plan(clip, base)
    terms = _terms(plan)
    yield Trial(f"base-{seed}", "effect", "as planned", base, terms=tuple(terms))
    for effect in plan.effects:
        config, switched = base, {str(effect.name): not effect.on}
        if effect.name == "unseen_views" and not effect.on:
            config = replace(base, prior="embedded")
            switched = {}
        if effect.name == "reappearance":
            continue  # costs and changes nothing by itself: it is how motion and lift treat hidden frames
        if _possible(clip, config, switched):
            sign = "without" if effect.on else "with"
            title = f"{sign} {effect.name.replace('_', ' ')}"
            yield Trial(f"effect-{effect.name}-{seed}", "effect", title, config, switched)
    for term in terms:
        weights = replace(base.weights, **{term: 0.0})
        yield Trial(f"loss-{term}-{seed}", "loss", f"without {term.replace('_', ' ')}", replace(base, weights=weights))


def _terms(plan: EffectPlan) -> list[str]:
    """Loss terms that this plan computes and that are no effects of their own."""
    bends = plan.on("non_rigid_motion")
    fielded = ("rigidity", "rotation", "local_scale")
    known = {f.name for f in fields(LossWeights)}
    return [t for t in TERMS if t in known and (bends or t not in fielded) and (t != "depth" or plan.on("depth_order"))]


def _possible(clip: Clip, config: RunConfig, switched: dict[str, bool]) -> bool:
    """False for an effect that this clip cannot do."""
    try:
        decide.plan(clip, config, switched)
    except GenmojoError:
        return False
    return True


def _growing(clip: Clip, wanted: Wanted, seed: int) -> Iterator[Trial]:
    """Steps timed with one quantity varied, the others as in the small run."""
    base = preset("draft", seed=seed, device=wanted.device, **BASE)

    def trial(vary: str, value: int, config: RunConfig = base, frames: int = 0, objects: int = 0) -> Trial:
        return Trial(f"growth-{vary}-{value}-{seed}", "growth", f"{value} {vary}", config, {}, 0.0, vary, frames,
                     objects)  # fmt: skip

    for share in (0.25, 0.5, 1.0):
        count = max(3, round(len(clip) * share))
        yield trial("frames", count, frames=count)
    for count in range(1, clip.objects + 1) if clip.objects > 1 else ():
        yield trial("objects", count, objects=count)
    for size in (96, 128, 176, 240):
        yield trial("pixels", size, replace(base, short_side=size))
    for factor in (0.5, 1.0, 2.0, 4.0):
        changes: dict[str, Any] = {k: int(BASE[k] * factor) for k in ("gaussians_per_object", "background_gaussians")}
        yield trial("Gaussians", changes["gaussians_per_object"], replace(base, **changes))


def _digest(trial: Trial, source: Source) -> str:
    """What makes two rows the same trial: whatever differs from the defaults, so that new settings spoil no old row."""
    usual = RunConfig().to_json()
    config = {key: value for key, value in trial.config.to_json().items() if value != usual[key]}
    parts = [config, dict(trial.effects), trial.kind, trial.frames, trial.objects, *trial.terms,
             str(Path(source.path).resolve()), source.frames, __version__]  # fmt: skip
    return hashlib.sha256(json.dumps(parts, sort_keys=True, default=str).encode()).hexdigest()[:16]


def _kept(path: Path, digest: str) -> dict[str, Any] | None:
    """A finished row, if it is there and of the same trial."""
    try:
        row = json.loads(path.read_text())
    except (OSError, ValueError):
        return None
    return row if isinstance(row, dict) and row.get("digest") == digest and "took" in row else None
