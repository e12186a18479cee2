"""Is the effect plan right? Clips made with known effects, what they truly show, and every decision judged.

Truth is measured on the exact scene of a procedural clip (hidden pixels, moved material points, lit background),
never on what the plan's evidence sees. Seeds 0-99 are there to fix thresholds on; 100-199 only report.
"""

from __future__ import annotations

import math
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from genmojo_core.clip import shapes
from genmojo_core.clip.synthetic import CENTRE, Stage, Truth, generate
from genmojo_core.clip.synthetic_effects import MadeClip, made_clip
from genmojo_core.config import RunConfig, preset
from genmojo_core.effects import decide
from genmojo_core.effects.sides import unseen_share
from genmojo_core.estimate.complete import complete

# From these amounts on a clip calls for an effect, whatever measures it: frames, px at 256, % of size, % ...
CALLS_FOR = {
    "joint_occlusion": 1.0, "camera_motion": 0.5, "non_rigid_motion": 3.0, "appearance_change": 8.0,
    "reappearance": 1.0, "instance_labels": 2.0, "unseen_views": 10.0,
}  # fmt: skip
_HIDDEN = 0.1  # of an object's greatest area: less counts as hidden
_POINTS = 300  # per object that deformation is measured on


@dataclass(frozen=True)
class Judged:
    """One decision on one clip: the true amount and the plan's evidence, what is right and what was decided."""

    seed: int
    effect: str
    amount: float
    evidence: float
    threshold: float
    right: bool
    decided: bool

    @property
    def correct(self) -> bool:
        """True if the plan decided as the scene is."""
        return self.right == self.decided


def judge(seed: int) -> tuple[list[Judged], float]:
    """Every decision on the clip of a seed, and the CPU seconds that evidence took."""
    made = made_clip(seed)
    clip, truth = generate(made.spec)
    amounts = true_amounts(made, truth)
    whole = complete(clip)
    start = time.process_time()
    plan = decide.plan(whole, config_of(made))
    seconds = time.process_time() - start
    rows = []
    for name, amount in amounts.items():
        effect = plan.get(name)  # type: ignore[arg-type]
        rows.append(Judged(seed, name, amount, effect.evidence, effect.threshold, amount >= CALLS_FOR[name],
                           effect.on))  # fmt: skip
    return rows, seconds


def judge_objects(seed: int) -> list[tuple[float, bool]]:
    """Of every object of a seed's clip: how far it is from rigid, in % of its size, and whether it may bend.

    Empty where non-rigid motion is off as a whole, which `judge` judges.
    """
    made = made_clip(seed)
    clip, truth = generate(made.spec)
    plan = decide.plan(complete(clip), config_of(made))
    if not plan.on("non_rigid_motion"):
        return []
    stage = Stage(made.spec)
    areas = [(truth.labels == k + 1).sum(axis=(1, 2)).astype(float) for k in range(clip.objects)]
    return [(100 * _deformation(stage, k, area), plan.on_object("non_rigid_motion", int(clip.object_ids[k])))
            for k, area in enumerate(areas)]  # fmt: skip


def config_of(made: MadeClip) -> RunConfig:
    """The configuration a made clip is planned for."""
    return preset("draft", prior="embedded", view_range=made.view_range)


def true_amounts(made: MadeClip, truth: Truth) -> dict[str, float]:
    """How much of every effect a made clip shows, in the units of `CALLS_FOR`."""
    stage = Stage(made.spec)
    alone = _alone(stage)  # (T, K, H, W)
    seen = np.stack([truth.labels == k + 1 for k in range(alone.shape[1])], axis=1)
    hidden = (alone & ~seen & (truth.labels > 0)[:, None]).any(axis=(1, 2, 3))  # by another object, not by ground
    area = seen.sum(axis=(2, 3)).astype(float)
    share = area / np.maximum(area.max(axis=0), 1)
    return {
        "joint_occlusion": float(hidden.sum()),
        "camera_motion": _camera_shift(stage) * 256 / min(made.spec.size),
        "non_rigid_motion": 100 * max(_deformation(stage, k, area[:, k]) for k in range(area.shape[1])),
        "appearance_change": 100 * _light_change(stage),
        "reappearance": float(max(_gap(share[:, k] >= _HIDDEN) for k in range(share.shape[1]))),
        "instance_labels": float((area.max(axis=0) > 0).sum()),
        "unseen_views": 100 * max(unseen_share(_sight(stage, k), made.view_range) for k in range(area.shape[1])),
    }


def table(rows: Sequence[Judged]) -> list[dict[str, Any]]:
    """Per effect: decisions, share that is correct, needless and missed ones."""
    result = []
    for name in CALLS_FOR:
        own = [row for row in rows if row.effect == name]
        result.append({
            "effect": name, "decisions": len(own), "called_for": sum(row.right for row in own),
            "correct": sum(row.correct for row in own) / max(len(own), 1),
            "needless": sum(row.decided and not row.right for row in own),
            "missed": sum(row.right and not row.decided for row in own),
        })  # fmt: skip
    return result


def _alone(stage: Stage) -> np.ndarray:
    """(T, K, H, W) bool: pixels each object would cover if nothing else were there."""
    objects = stage.what.object_of()
    result = []
    for t, view in enumerate(stage.views):
        frame = []
        for k in range(int(objects.max()) + 1):
            own = np.flatnonzero(objects == k)
            hits = shapes.cast(view, [stage.matrices[t][i] for i in own], [stage.kinds[i] for i in own], None, CENTRE)
            frame.append(hits.owner >= 0)
        result.append(np.stack(frame))
    return np.stack(result)


def _camera_shift(stage: Stage) -> float:
    """Largest median shift of ground and wall from frame 0 by the camera, pixels of the clip."""
    width, height = stage.what.size
    points = shapes.cast(stage.views[0], [], [], stage.what.wall, CENTRE).point.reshape(-1, 3)
    grid = np.stack(np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5), axis=-1).reshape(-1, 2)
    shifts = []
    for view in stage.views:
        local = points @ view.world_to_camera[:3, :3].T + view.world_to_camera[:3, 3]
        xy = local[:, :2] / local[:, 2:] * [view.fx, view.fy] + [view.cx, view.cy]
        shifts.append(float(np.median(np.linalg.norm(xy - grid, axis=1))))
    return max(shifts)


def _deformation(stage: Stage, k: int, area: np.ndarray) -> float:
    """How far an object's surface leaves every rigid motion from frame 0, over frames that show it well.

    The 90th percentile of the surface points' distance, as a share of the object's size (root of its visible area).
    """
    rng = np.random.default_rng(0)
    own = np.flatnonzero(stage.what.object_of() == k)
    material = [_on_surface(stage.kinds[i], rng, _POINTS // len(own)) for i in own]
    shown = np.flatnonzero(area >= 0.5 * area.max())
    if not len(shown):
        return 0.0
    places = [
        np.concatenate([stage.world(int(t), int(i), m) for i, m in zip(own, material, strict=True)]) for t in shown
    ]
    eye = np.linalg.inv(stage.views[0].world_to_camera)[:3, 3]
    distance = np.linalg.norm(places[0].mean(axis=0) - eye)
    size = math.sqrt(float(area.max())) / stage.views[0].fx * distance
    return float(max(np.percentile(_from_rigid(places[0], place), 90) for place in places) / size)


def _from_rigid(before: np.ndarray, after: np.ndarray) -> np.ndarray:  # (N, 3) each -> (N,)
    """Distances of points after the best rigid motion between two places."""
    a, b = before - before.mean(axis=0), after - after.mean(axis=0)
    u, _, vt = np.linalg.svd(a.T @ b)
    turn = u @ np.diag([1, 1, np.sign(np.linalg.det(u @ vt))]) @ vt
    distances: np.ndarray = np.linalg.norm(a @ turn - b, axis=1)
    return distances


def _on_surface(kind: str, rng: np.random.Generator, count: int) -> np.ndarray:  # (count, 3)
    """Random points on the surface of a unit solid."""
    points = rng.normal(size=(count, 3))
    if kind == "ball":
        points /= np.linalg.norm(points, axis=1, keepdims=True)
    elif kind == "cube":
        points /= np.abs(points).max(axis=1, keepdims=True)
    else:
        points[:, :2] /= np.linalg.norm(points[:, :2], axis=1, keepdims=True)
        points[:, 2] = rng.uniform(-1, 1, count)
    return points


def _light_change(stage: Stage) -> float:
    """Change of the mean brightness of ground and wall over the clip, seen by the first camera."""
    hits = shapes.cast(stage.views[0], [], [], stage.what.wall, CENTRE)
    levels = [float(shapes.shade(hits, (), [], light).mean()) for light in (min(stage.lights), max(stage.lights))]
    return 1.0 - levels[0] / levels[1]


def _gap(seen: np.ndarray) -> int:  # (T,) bool
    """Most frames in a row that are not seen between two that are."""
    frames = np.flatnonzero(seen)
    return int((np.diff(frames) - 1).max(initial=0))


def _sight(stage: Stage, k: int) -> np.ndarray:
    """(T, 3, 3) rotations from object k to the camera (of its first part, without sway and stretch)."""
    i = int(np.flatnonzero(stage.what.object_of() == k)[0])
    turns = []
    for t, view in enumerate(stage.views):
        u, _, vt = np.linalg.svd(stage.matrices[t][i][:3, :3])
        turns.append(view.world_to_camera[:3, :3] @ u @ vt)
    return np.stack(turns)


def summary(rows: Sequence[Judged]) -> Mapping[str, float]:
    """Decisions in all and the share of them that is correct."""
    return {"decisions": len(rows), "correct": sum(row.correct for row in rows) / max(len(rows), 1)}
