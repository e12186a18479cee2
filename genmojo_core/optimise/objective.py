"""One micro-batch: states of all objects, one joint splat per frame, every loss the plan calls for, one scalar."""

from __future__ import annotations

import math
from dataclasses import dataclass

import torch
from torch import Tensor

from genmojo_core.clip.cameras import View
from genmojo_core.config import LossWeights
from genmojo_core.effects.plan import EffectPlan
from genmojo_core.errors import GenmojoError
from genmojo_core.optimise import losses
from genmojo_core.optimise.joint_loss import Wanted, data_terms
from genmojo_core.optimise.regularise import Neighbours, nearest, rigidity, scale_terms
from genmojo_core.optimise.targets import FrameTargets, Targets
from genmojo_core.render.backend import Splat, splat_frames
from genmojo_core.render.rasterizer import Rendering, Splats
from genmojo_core.scene import safemath
from genmojo_core.scene.scene4d import ObjectState, Scene4D

States = dict[int, list[ObjectState]]  # of all objects, by frame
SAMPLED_ROWS = 1024  # Gaussians per object and step that the neighbour terms look at


@dataclass(frozen=True)
class TrackSupervision:
    """Tracks of one object: canonical points (P, 3) object units, xy (P, T, 2) px, conf (P, T)."""

    points: Tensor
    xy: Tensor
    conf: Tensor


@dataclass(frozen=True)
class HeldOut:
    """One frame's `count` held-out pixels: sums of squared error and of SSIM (of windows around them)."""

    frame: int
    squared: float
    similar: float
    count: int


@dataclass
class Outcome:
    """Loss of one micro-batch, its weighted parts, errors on held-out and foreground pixels, and light."""

    loss: Tensor
    parts: dict[str, float]
    held_out: list[HeldOut]
    foreground: list[tuple[int, float]]  # frame, PSNR in dB
    light: list[tuple[int, Tensor, Tensor]]  # frame, mean colour shown and wanted (3,) where something is drawn


class Objective:
    """The joint loss for one scene.

    Args:
        scene, targets, weights: what is compared. plan: which terms exist at all. splat: rasteriser.
        tracks: one per object of the scene, used if the plan has track supervision.
    """

    def __init__(
        self, scene: Scene4D, targets: Targets, plan: EffectPlan, weights: LossWeights, splat: Splat,
        tracks: list[TrackSupervision], neighbours: int,
    ) -> None:  # fmt: skip
        self.scene, self.targets, self.weights, self.splat = scene, targets, weights, splat
        self.tracks = tracks if plan.on("track_supervision") else []
        self.labels = scene.layout.labels > 1
        self.depth = plan.on("depth_order")
        self.order = self.depth and self.labels and plan.on("joint_occlusion")
        self.count = neighbours
        self.frames = len(targets)
        self.refresh_neighbours()

    def refresh_neighbours(self) -> None:
        """After density control: nearest neighbours of every object's canonical Gaussians."""
        self.neighbours: list[Neighbours | None] = [
            None if o.field is None else nearest(o.gaussians.means, self.count) for o in self.scene.objects
        ]

    def evaluate(self, frames: list[int], deform: bool, generator: torch.Generator) -> Outcome:
        """All terms over some frames; the mean over frames, regularisers once."""
        pairs = self.scene.layout.flow or (deform and any(o.field is not None for o in self.scene.objects))
        needed = sorted({*frames, *(min(t + 1, self.frames - 1) for t in frames)}) if pairs else frames
        states = dict(zip(needed, self.scene.states(needed, deform), strict=True))
        terms: dict[str, Tensor] = {}
        held_out, foreground, light = [], [], []
        for t, (target, rendering) in zip(frames, self._compared(frames, states), strict=True):
            with torch.set_grad_enabled(self.compares_windows):
                similar = losses.similarity(rendering, target)
            for name, value in self._data_terms(t, states[t], rendering, target, similar).items():
                terms[name] = terms.get(name, 0.0) + value / len(frames)
            shown = rendering.features[..., :3].detach()
            light.append((t, *self._levels(t, rendering, target)))
            squared = ((shown - target.rgb) ** 2).mean(-1)
            cut = target.held_out
            held_out.append(HeldOut(t, float(squared[cut].sum()), float(similar.detach()[cut].sum()), int(cut.sum())))
            inside = target.labels > 0
            if bool(inside.any()):
                foreground.append((t, -10.0 * math.log10(max(float(squared[inside].mean()), 1e-10))))
        if self.weights.hull > 0:
            terms["hull"] = self._hull_term(frames, states)
        if deform:
            for name, value in self._motion_terms(frames, states, generator).items():
                terms[name] = value
        weighted = {name: getattr(self.weights, name) * value for name, value in terms.items()}
        loss = torch.stack(list(weighted.values())).sum()
        return Outcome(loss, {n: float(v.detach()) for n, v in weighted.items()}, held_out, foreground, light)

    def picture(self, t: int, deform: bool) -> Tensor:
        """Colours (H, W, 3) of frame t as the scene stands, whether or not the frame is in any loss."""
        return self._render([t], {t: self.scene.states([t], deform)[0]})[0].features[..., :3]

    def _compared(self, frames: list[int], states: States) -> list[tuple[FrameTargets, Rendering]]:
        """What is compared in each frame: its targets and what the scene shows there."""
        return list(zip(map(self.targets.frame, frames), self._render(frames, states), strict=True))

    def _render(self, frames: list[int], states: States) -> list[Rendering]:
        return self._splatted(frames, states, [self.scene.cameras.view(t) for t in frames])

    def _splatted(
        self, frames: list[int], states: States, views: list[View], with_background: bool = True
    ) -> list[Rendering]:
        """A view of each frame, drawn at once; GenmojoError("budget") with the name of an object that fills one."""
        layout, splats = self.scene.layout, []
        for t in frames:
            c = self.scene.compose(t, states[t], states.get(t + 1) if layout.flow else None, with_background)
            splats.append(Splats(c.means, c.quats, c.scales, c.opacities, c.features))
        try:
            return splat_frames(self.splat, splats, views, detached_channels=2 if layout.flow else 0)
        except GenmojoError as error:
            if error.code != "budget":
                raise
            shown = [(float(s.scales.detach().max()), k) for t in frames for k, s in enumerate(states[t])]
            name = self.scene.objects[max(shown)[1]].name if shown else "the background"
            raise GenmojoError("budget", f"the Gaussians of {name} fill the view: {error.what}", "",
                               "go on from the last checkpoint with smaller learning rates") from error  # fmt: skip

    def _levels(self, t: int, rendering: Rendering, target: FrameTargets) -> tuple[Tensor, Tensor]:
        """Mean colours (3,) of frame t as shown and as wanted, over the pixels that count."""
        shown, seen = rendering.features[..., :3].detach(), target.seen[..., None]
        total = target.seen.sum().clamp(min=1.0)
        return (shown * seen).sum((0, 1)) / total, (target.rgb * seen).sum((0, 1)) / total

    @property
    def compares_windows(self) -> bool:
        """True if SSIM is a part of the loss; without a background the frame's rest is empty and it is not."""
        return self.weights.ssim > 0 and self.scene.background is not None

    @property
    def fits_background(self) -> bool:
        """True if the scene has a background that these losses form."""
        return self.scene.background is not None

    def _data_terms(
        self, t: int, now: list[ObjectState], rendering: Rendering, target: FrameTargets, similar: Tensor
    ) -> dict[str, Tensor]:
        layout = self.scene.layout
        wanted = Wanted(self.scene.background is not None, self.labels, self.depth)
        terms = data_terms(rendering, layout, target, wanted)
        if self.compares_windows:
            terms["ssim"] = losses.similarity_loss(similar, target)
        if self.fits_background and self.weights.gaps > 0:
            terms["gaps"] = losses.gap_loss(rendering.alpha, target.seen)
        if now:
            centres = self._centres(t, now) - target.corner()
            terms["alpha"] = terms["alpha"] + losses.miss_loss(rendering, layout, target, centres)
        if self.order:
            terms["depth_order"] = self._order_term(t, now, rendering, target)
        return terms

    def _centres(self, t: int, now: list[ObjectState]) -> Tensor:
        """(objects, 2) pixels of the objects' mean positions."""
        means = torch.stack([s.means.mean(dim=0) for s in now])
        return safemath.project(means, self.scene.w2c[t], self.scene.K[t], self.scene.cameras.near)[0]

    def _order_term(self, t: int, now: list[ObjectState], rendering: Rendering, target: FrameTargets) -> Tensor:
        means = torch.cat([s.means for s in now])
        owner = torch.cat([torch.full((len(s.means),), k) for k, s in enumerate(now)])
        pixels, depths = safemath.project(means, self.scene.w2c[t], self.scene.K[t], self.scene.cameras.near)
        return losses.order_loss(pixels - target.corner(), depths, owner, rendering, target, self.scene.layout)

    def _motion_terms(
        self, frames: list[int], states: dict[int, list[ObjectState]], generator: torch.Generator
    ) -> dict[str, Tensor]:
        """Regularisers over pairs of frames, and the tracks."""
        zero, weights = self.scene.w2c.sum() * 0.0, self.weights
        terms = {"smooth": zero}
        objects = len(self.scene.objects)
        for k, (model, near) in enumerate(zip(self.scene.objects, self.neighbours, strict=True)):
            for part in (model.placement, model.field) if weights.smooth > 0 else ():
                if part is not None:
                    terms["smooth"] = terms["smooth"] + part.smoothness() * self.frames / objects
            if model.field is None or near is None:
                continue
            rows = torch.randperm(len(model.gaussians), generator=generator)[:SAMPLED_ROWS]
            for t in frames:
                now, after = states[t][k], states.get(t + 1)
                if now.deformation is None:
                    continue
                share = 1.0 / (objects * len(frames))
                found: dict[str, Tensor] = {}
                if weights.local_scale > 0 or weights.delta_scale > 0:
                    found["local_scale"], found["delta_scale"] = scale_terms(now.deformation, near, rows)
                if after is not None and (weights.rigidity > 0 or weights.rotation > 0):
                    found["rigidity"], found["rotation"] = rigidity(now, after[k], near, rows)
                for name, value in found.items():
                    terms[name] = terms.get(name, zero) + share * value
                if now.deformation.d_dc is not None:
                    terms["delta_color"] = terms.get("delta_color", zero) + share * now.deformation.d_dc.abs().mean()
        if self.tracks:
            terms["tracks"] = self._track_term(frames)
        return terms

    def _hull_term(self, frames: list[int], states: States) -> Tensor:
        """Objects stay inside the hull of their silhouettes; mean over frames and objects."""
        total = self.scene.w2c.sum() * 0.0
        for t in frames:
            for k, (model, state) in enumerate(zip(self.scene.objects, states[t], strict=True)):
                far = losses.hull_map(self.targets.frame(t), k)
                if far is None:
                    continue
                pixels, depths = safemath.project(state.means, self.scene.w2c[t], self.scene.K[t],
                                                  self.scene.cameras.near)  # fmt: skip
                value = losses.hull_loss(pixels, depths, model.gaussians.opacities(), far)
                total = total + value / (len(frames) * len(self.scene.objects))
        return total

    def _track_term(self, frames: list[int]) -> Tensor:
        width, height = self.scene.cameras.size
        diagonal = (width * width + height * height) ** 0.5
        total = self.scene.w2c.sum() * 0.0
        for model, tracks in zip(self.scene.objects, self.tracks, strict=True):
            if not len(tracks.points):
                continue
            carried = model.carry(tracks.points, frames)
            for b, t in enumerate(frames):
                pixels, _ = safemath.project(carried[b], self.scene.w2c[t], self.scene.K[t], self.scene.cameras.near)
                value = losses.track_loss(pixels, tracks.xy[:, t], tracks.conf[:, t], diagonal)
                total = total + value / (len(frames) * len(self.tracks))
        return total
