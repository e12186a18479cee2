"""The paper's ablation on any clip: one variant at a time, what it loses and what it saves (METHOD.md section 8)."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from genmojo_core.clip import folders
from genmojo_core.clip.clip import Clip
from genmojo_core.config import MEASURED_SIDE, RunConfig
from genmojo_core.effects import decide
from genmojo_core.errors import GenmojoError
from genmojo_core.estimate.complete import complete
from genmojo_core.events import EffectChanged, Event, Failed, Finished
from genmojo_core.measure import sources, truth
from genmojo_core.measure.reconstruction import reconstruction
from genmojo_core.measure.scoring import novel_figures
from genmojo_core.optimise.methods import prepared
from genmojo_core.optimise.run import Run
from genmojo_core.store import scene_hdf5
from genmojo_core.store.atomic import write_bytes
from genmojo_core.store.safe import json_text

JITTER = 0.05  # relative standard deviation from frame to frame of worse depth


@dataclass(frozen=True)
class Variant:
    """The full model with one thing taken away, or another method's idea in our engine (optimise/methods.py).

    Args:
        title: as in the table. changes: of the configuration. effects: switched by hand. worse_depth: given depth is
            replaced by the estimate, with jitter over time.
    """

    title: str
    changes: Mapping[str, Any] = field(default_factory=dict)
    effects: Mapping[str, bool] = field(default_factory=dict)
    worse_depth: bool = False


VARIANTS: dict[str, Variant] = {
    "full": Variant("full"),
    "no_joint": Variant("w/o joint splatting", effects={"joint_occlusion": False}),
    "no_prior": Variant("w/o prior", {"prior": "none"}),
    "scene_prior": Variant("scene-level prior", {"prior_scope": "scene"}),
    "no_labels": Variant("w/o instance labels", effects={"instance_labels": False}),
    "worse_depth": Variant("worse depth", worse_depth=True),
}
OTHERS: dict[str, Variant] = {
    "dreamscene4d": Variant("as DreamScene4D", {"method": "dreamscene4d"}),
    "dreamgaussian4d": Variant("as DreamGaussian4D", {"method": "dreamgaussian4d"}),
    "shape-of-motion": Variant("as Shape of Motion", {"method": "shape-of-motion"}),
}


@dataclass(frozen=True)
class Plan:
    """What is run: variants by key, seeds, the configuration of the full model."""

    variants: tuple[str, ...]
    seeds: tuple[int, ...]
    config: RunConfig


def ablate(clip_path: str, plan: Plan, folder: Path, hear: Callable[[str, Event], None]) -> list[dict[str, Any]]:
    """One row per variant and seed; rows that lie in `folder` already are not run again.

    Only rows of the same clip, configuration and program (`sources.digest`) are taken over.

    Args:
        hear: takes the row's name and every event of its run.

    Raises GenmojoError: "argument" for an unknown variant, "numeric" where a run fails, and as reading the clip.
    """
    known = VARIANTS | OTHERS
    unknown = [name for name in plan.variants if name not in known]
    if unknown:
        raise GenmojoError("argument", f"there is no variant {', '.join(unknown)}", "--variants",
                           f"use {', '.join(known)}")  # fmt: skip
    rows = []
    for seed in plan.seeds:
        for name in plan.variants:
            config = replace(plan.config, seed=seed, **known[name].changes)
            path = folder / "runs" / f"{name}-{seed}.json"
            row = _kept(path, config, clip_path)
            if row is None:
                listen = partial(hear, f"{name}, seed {seed}")
                figures = run_variant(clip_path, known[name], config, path.with_suffix(".h5"), listen)
                row = {
                    "variant": name,
                    "seed": seed,
                    "digest": _digest(config, clip_path),
                    "program": sources.digest(),
                    **figures,
                }
                write_bytes(path, json_text(row).encode())
            rows.append(row)
    return rows


def run_variant(
    clip_path: str, variant: Variant, config: RunConfig, scene_path: Path, hear: Callable[[Event], None]
) -> dict[str, Any]:
    """Optimise and measure one variant; the scene stays at `scene_path`."""
    ignore = (*config.ignore, "depth") if variant.worse_depth else config.ignore
    clip = complete(folders.read(clip_path, short_side=config.short_side, ignore=ignore))
    if variant.worse_depth:
        clip = complete(with_jitter(clip, config.seed))  # jitter is part of the input, so what cures it may
    clip, switched = prepared(clip, config.method, variant.effects)
    run = Run(clip, decide.plan(clip, config, switched), config)
    said: list[str] = []
    for event in run:
        hear(event)
        if isinstance(event, Failed):
            raise GenmojoError("numeric", event.message.rstrip("."), clip_path)
        if isinstance(event, EffectChanged):
            said.append(event.reason)
        if isinstance(event, Finished):
            seconds, cpu, steps = event.seconds, event.cpu_seconds, event.step
            if event.reason == "budget":
                said.append(f"the budget ended a run after {steps} of {run.progress.total} steps")
    scene_hdf5.write(run.bake(), scene_path)
    figures = measured(scene_path, clip_path)
    return {**figures, "seconds": seconds, "cpu_seconds": cpu, "steps": float(steps), "notes": said}


def measured(scene_path: Path, clip_path: str) -> dict[str, float]:
    """Reconstruction, and against truth beside the clip: tracks and novel views in three groups of angles."""
    scene = scene_hdf5.read(scene_path)
    clip = folders.read(clip_path, short_side=MEASURED_SIDE)
    figures: dict[str, Any] = dict(reconstruction(scene, clip))
    truth_path = truth.find_truth(clip_path)
    if truth_path is not None:
        figures |= truth.track_scores(scene, clip, truth_path) | novel_figures(scene, clip, truth_path)
    return {k: float(v) for k, v in figures.items() if isinstance(v, int | float)}


def with_jitter(clip: Clip, seed: int) -> Clip:
    """The clip's depth multiplied by its own random factor in every frame."""
    if clip.depth is None:
        return clip
    factors = np.exp(np.random.default_rng(seed).normal(size=len(clip)) * JITTER).astype(np.float32)
    depth = replace(clip.depth, value=clip.depth.value * factors[:, None, None], source="estimated: with jitter")
    return clip.with_channels(depth=depth)


def summary(rows: Sequence[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """Mean and standard deviation over seeds of every figure, one entry per variant; `saves` CPU seconds of full.

    Rows that the budget cut short say so in the notes: compare them by their steps.
    """
    names = list(dict.fromkeys(row["variant"] for row in rows))
    entries: list[dict[str, Any]] = []
    for name in names:
        own = [row for row in rows if row["variant"] == name]
        keys = [k for k, v in own[0].items() if isinstance(v, float)]
        means = {k: float(np.mean([r[k] for r in own if k in r])) for k in keys}
        spread = {k: float(np.std([r[k] for r in own if k in r])) for k in keys}
        entries.append({"variant": name, "title": (VARIANTS | OTHERS)[name].title, "seeds": len(own), "mean": means,
                        "spread": spread, "notes": sorted({n for r in own for n in r.get("notes", [])})})  # fmt: skip
    full = next((e for e in entries if e["variant"] == "full"), None)
    for entry in entries:
        if full is not None and entry is not full:
            entry["mean"]["saves"] = full["mean"]["cpu_seconds"] - entry["mean"]["cpu_seconds"]
            entry["spread"]["saves"] = float(np.hypot(full["spread"]["cpu_seconds"], entry["spread"]["cpu_seconds"]))
    return entries


def _digest(config: RunConfig, clip_path: str) -> str:
    """What makes two rows comparable."""
    made_of = [asdict(config), str(Path(clip_path).resolve()), sources.digest()]
    text = json.dumps(made_of, sort_keys=True, default=str)
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def _kept(path: Path, config: RunConfig, clip_path: str) -> dict[str, Any] | None:
    """A finished row, if it is there and of the same clip, configuration and program."""
    try:
        row = json.loads(path.read_text())
    except (OSError, ValueError):
        return None
    return row if isinstance(row, dict) and row.get("digest") == _digest(config, clip_path) else None
