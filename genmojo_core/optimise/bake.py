"""From the trainable scene to the file's scene: motion evaluated at every frame, in the clip's own pixels."""

from __future__ import annotations

import uuid
from dataclasses import dataclass, field
from datetime import UTC, datetime
from typing import Any

import numpy as np
import torch

from genmojo_core import __version__
from genmojo_core.clip.clip import Clip
from genmojo_core.conventions import SH_C0
from genmojo_core.scene import safemath
from genmojo_core.scene.gaussians import Gaussians
from genmojo_core.scene.scene4d import ObjectModel, Scene4D
from genmojo_core.store.scene_file import BakedScene, SceneObject

PALETTE = ((0.90, 0.30, 0.25), (0.25, 0.60, 0.90), (0.35, 0.75, 0.35), (0.95, 0.70, 0.20), (0.65, 0.40, 0.80),
           (0.30, 0.75, 0.75), (0.95, 0.50, 0.70), (0.60, 0.55, 0.35))  # fmt: skip


@dataclass(frozen=True)
class Provenance:
    """What a scene file says about its making, all JSON-able."""

    config: dict[str, Any] = field(default_factory=dict)
    effects: list[dict[str, Any]] = field(default_factory=list)
    curve: list[dict[str, float]] = field(default_factory=list)
    metrics: dict[str, float] = field(default_factory=dict)
    run_uuid: str = field(default_factory=lambda: str(uuid.uuid4()))


@torch.no_grad()
def bake(scene: Scene4D, clip: Clip, provenance: Provenance, judged: np.ndarray | None = None) -> BakedScene:
    """The scene with its motion written out; cameras are scaled to the clip's source pixels.

    judged: (M, 3) rows elevation, azimuth (degrees), frame of views that a prior supervised besides the frames.
    """
    frames = len(clip)
    parts = [_object_rows(scene, model, frames) for model in scene.objects]
    objects, first = [], 0
    for i, (model, part) in enumerate(zip(scene.objects, parts, strict=True)):
        objects.append(SceneObject(model.id, model.name, PALETTE[i % len(PALETTE)], False, first, len(part["xyz"])))
        first += len(part["xyz"])
    placements = [model.placement.baked() for model in scene.objects]
    if scene.background is not None:
        parts.append(_static_rows(scene.background, frames))
        objects.append(SceneObject(0, "background", (0.5, 0.5, 0.5), True, first, len(scene.background)))
        placements.append((np.tile(np.eye(3, 4), (frames, 1, 1)), np.ones(frames)))
    columns = {name: np.concatenate([p[name] for p in parts], axis=1 if name in _TIMED else 0) for name in parts[0]}
    d_dc = columns.pop("d_dc")
    if scene.gain is not None:
        d_dc = _with_gain(columns["dc"], d_dc, torch.stack([scene.gain(t) for t in range(frames)]).numpy())
    own = any(m.field is not None and m.field.shape.appearance for m in scene.objects)
    keep_color = scene.gain is not None or scene.shade is not None or own
    cameras = scene.cameras.resized(*clip.source_size)
    return BakedScene(
        clip.frame_index, clip.seconds, clip.source_names, tuple(objects), columns["xyz"], columns["rot"],
        columns["scale"], columns["opacity"], columns["dc"], _uids(columns["uid"], objects), columns["d_xyz"],
        columns["rot_t"], columns["log_scale_t"], np.stack([p for p, _ in placements], axis=1).astype(np.float32),
        np.stack([k for _, k in placements], axis=1).astype(np.float32), cameras,
        np.array([m.ref_frame for m in scene.objects] + [0] * (len(objects) - len(scene.objects))),
        np.asarray(clip.world_up, float), d_dc if keep_color else None,
        supervised=_supervised(frames, judged),
        config=provenance.config, effects=provenance.effects, curve=provenance.curve, metrics=provenance.metrics,
        fps=_fps(clip.seconds), pixel_aspect=clip.pixel_aspect, run_uuid=provenance.run_uuid,
        created_utc=datetime.now(UTC).isoformat(timespec="seconds"), generator=f"genmojo {__version__}",
    )  # fmt: skip


def _supervised(frames: int, judged: np.ndarray | None) -> np.ndarray:
    """The frames' own views, then those of a prior."""
    own = np.stack([np.zeros(frames), np.zeros(frames), np.arange(frames)], 1)
    return (own if judged is None else np.concatenate([own, judged])).astype(np.float32)


_TIMED = ("d_xyz", "rot_t", "log_scale_t", "d_dc")


def _static_rows(g: Gaussians, frames: int) -> dict[str, np.ndarray]:
    """Rows of Gaussians that do not move."""
    rot = safemath.normalise(g.quats).numpy()
    count = len(g)
    zeros = np.zeros((frames, count, 3), np.float32)
    return {
        "xyz": g.means.numpy().copy(), "rot": rot, "scale": g.scales().numpy(), "opacity": g.opacities().numpy(),
        "dc": g.dc.numpy().copy(), "uid": g.uid.numpy().astype(np.uint64), "d_xyz": zeros,
        "rot_t": np.broadcast_to(rot, (frames, count, 4)).astype(np.float32), "log_scale_t": zeros.copy(),
        "d_dc": zeros.copy(),
    }  # fmt: skip


def _object_rows(scene: Scene4D, model: ObjectModel, frames: int) -> dict[str, np.ndarray]:
    """Rows of one object with its deformation and shading at every frame."""
    rows = _static_rows(model.gaussians, frames)
    if scene.shade is not None:
        for t in range(frames):
            rgb = scene.shaded(model, model.states([t])[0]).rgb
            rows["d_dc"][t] = ((rgb - 0.5) / SH_C0 - model.gaussians.dc).numpy()
    if model.field is None:
        return rows
    for t in range(frames):
        d = model.field(model.gaussians.means, torch.tensor([t])).at(0)
        rows["d_xyz"][t] = d.d_means.numpy()
        rows["rot_t"][t] = safemath.normalise(model.gaussians.quats + d.d_quats).numpy()
        rows["log_scale_t"][t] = d.d_log_scales.numpy()
        if d.d_dc is not None and scene.shade is None:
            rows["d_dc"][t] = d.d_dc.numpy()
    return rows


def _with_gain(dc: np.ndarray, d_dc: np.ndarray, gains: np.ndarray) -> np.ndarray:
    """Colour change that includes the frame's gain: 0.5 + C0 (dc + d) = gain (0.5 + C0 (dc + d_head))."""
    rgb = 0.5 + SH_C0 * (dc[None] + d_dc)
    return ((rgb * gains[:, None] - 0.5) / SH_C0 - dc[None]).astype(np.float32)


def _uids(uid: np.ndarray, objects: list[SceneObject]) -> np.ndarray:
    """Unique over the scene: the object's position in the upper 16 bits."""
    owner = np.repeat(np.arange(len(objects), dtype=np.uint64), [o.count for o in objects])
    return uid + (owner << np.uint64(48))


def _fps(seconds: np.ndarray) -> float:
    """Frames per second from the median time step; 24 for a still."""
    steps = np.diff(seconds)
    return float(1.0 / np.median(steps)) if len(steps) and np.median(steps) > 0 else 24.0
