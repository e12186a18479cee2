"""The light that objects turn under: measured before the first step, kept only where it explains what is seen.

Places that face the camera both in the canonical frame and in another are compared: how their brightness changed
against how their normals turned. Where normals explain next to nothing, shading is left out, whatever turns.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np
import torch
from torch import Tensor

from genmojo_core.effects.plan import EffectPlan
from genmojo_core.events import Event
from genmojo_core.optimise import checkpoint
from genmojo_core.optimise.call_in import changed
from genmojo_core.optimise.targets import Targets
from genmojo_core.scene import safemath
from genmojo_core.scene.scene4d import ObjectModel, ObjectState, Scene4D
from genmojo_core.scene.shading import TERMS, Shade, fitted, harmonics

if TYPE_CHECKING:
    from genmojo_core.optimise.run import Run

LEAST = 0.1  # of the changes of brightness: normals that explain less are none of the light's business
FRAMES = 12  # that are compared with the canonical one, spread over the clip
FACING = 0.35  # cosine to the camera: what is turned further away is seen blurred
DARKEST, BRIGHTEST = 0.06, 0.95  # brightness outside of which a change says nothing


def start_shading(run: Run) -> Iterator[Event]:
    """Give the scene of a run its shading, if the plan asks for it and the clip's pixels agree."""
    if not run.plan.on("shading"):
        return
    if run.resume and run.run_dir is not None:  # as it was decided then
        if checkpoint.holds(run.run_dir, "shade.shade"):
            run.scene.shade = Shade()
        else:
            run.plan = run.plan.decided("shading", False, ("left_out_before", {}))
        return
    start, share = measured(run.scene, run.targets)
    if share < LEAST and not run.plan.get("shading").overridden:
        run.plan = run.plan.decided("shading", False, ("no_shading", {"percent": 100 * share}))
        yield changed(run, "shading")
        return
    run.scene.shade = Shade(start)


def with_shade(plan: EffectPlan, scene: Scene4D) -> EffectPlan:
    """The plan with the light's coefficients, for readers of the scene's file."""
    if scene.shade is None:
        return plan
    values = scene.shade.shade.detach().tolist()
    return plan.changed("shading", settings={str(k): value for k, value in enumerate(values)})


@torch.no_grad()
def measured(scene: Scene4D, targets: Targets) -> tuple[Tensor, float]:
    """Coefficients (8,) of the light and the share of the changes of brightness that they explain, at most 1.

    The share is that of the usual change or that of all squared changes, whichever is less: a few places that something
    came by must not count as light, nor a trifle that most places share.
    """
    changes, ratios = [], []
    for k, model in enumerate(scene.objects):
        before = model.states([model.ref_frame])[0]
        normals, _ = model.facing(before)
        level, shown = _brightness(scene, targets, k, model.ref_frame, before)
        for t in np.unique(np.linspace(0, len(targets) - 1, FRAMES).round().astype(int)):
            state = model.states([int(t)])[0]
            now, there = _brightness(scene, targets, k, int(t), state)
            both = shown & there
            changes.append((harmonics(model.facing(state)[1]) - harmonics(normals))[both])
            ratios.append(safemath.safe_log(now[both], DARKEST / 2) - safemath.safe_log(level[both], DARKEST / 2))
    start = fitted(changes, ratios)
    if start is None:
        return torch.zeros(TERMS), 0.0
    rows, wanted = torch.cat(changes), torch.cat(ratios)
    off = wanted - rows @ start
    usual = 1.0 - float(off.abs().median() / wanted.abs().median().clamp(min=1e-6))
    return start, min(usual, 1.0 - float(off.square().mean() / wanted.square().mean().clamp(min=1e-12)))


def _brightness(scene: Scene4D, targets: Targets, k: int, t: int, state: ObjectState) -> tuple[Tensor, Tensor]:
    """Of object k's Gaussians in frame t: brightness (N,) of their pixels without the frame's gain, and where seen."""
    model: ObjectModel = scene.objects[k]  # type: ignore[assignment]
    w2c, target = scene.w2c[t], targets.frame(t)
    ray = state.means + w2c[:3, :3].T @ w2c[:3, 3]
    facing = -(model.facing(state)[1] * ray).sum(dim=1) > FACING * safemath.safe_norm(ray)
    pixels, z = safemath.project(state.means, w2c, scene.K[t], scene.cameras.near)
    size = torch.tensor(scene.cameras.size)
    inside = (z > scene.cameras.near) & ((pixels >= 0) & (pixels < size)).all(dim=1)
    column, row = torch.where(inside[:, None], pixels, 0.0).long().unbind(dim=1)
    rgb = target.rgb[row, column] if scene.gain is None else target.rgb[row, column] / scene.gain(t)
    level = rgb.mean(dim=1)
    own = (target.labels[row, column] == k + 1) & (target.seen[row, column] > 0)
    return level, inside & facing & own & (level > DARKEST) & (level < BRIGHTEST)
