"""A camera and a background that stand still: the background is fitted once and drawn once, frames are windows.

Where neither camera nor light changes and no shadow passes (effects/still.py), its picture is the same in every frame.
It is fitted to the plate alone, then held; every step draws the objects only, in a window around them and their masks,
over the stored picture. What lies outside the window does not depend on the objects. The background is moved behind
every object first, so that "over" is what the joint splat of the finished scene shows as well.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

import cv2
import numpy as np
import torch
from torch import Tensor

from genmojo_core.clip.clip import Clip
from genmojo_core.config import SETTLE_SHARE, RunConfig
from genmojo_core.effects.plan import EffectPlan
from genmojo_core.effects.still import background_is_still
from genmojo_core.events import Event, StageStarted
from genmojo_core.optimise import losses
from genmojo_core.optimise.adamw import AdamW
from genmojo_core.optimise.objective import Objective, States
from genmojo_core.optimise.schedule import rate_factor, start_rate
from genmojo_core.optimise.separate import SeparateObjective
from genmojo_core.optimise.targets import FrameTargets, Window
from genmojo_core.render.rasterizer import Rendering, Splats
from genmojo_core.render.ssim import ssim_map
from genmojo_core.scene import safemath
from genmojo_core.scene.gaussians import Gaussians
from genmojo_core.scene.scene4d import ObjectState, Scene4D

if TYPE_CHECKING:
    from genmojo_core.optimise.run import Run

MARGIN = 12  # pixels of a window beyond what it must show: SSIM looks 5 pixels far, a rim of a Gaussian some more
GRID = 8  # windows end on multiples of it, so that few of them are cut anew


COVER = 2  # pixels round an object's Gaussians that they may cover
BEHIND = 1.02  # of an object's depth: where the background begins


def objective_for(run: Run) -> type[Objective]:
    """Which objective a run's scene is optimised by: objects apart where the user wants it, still or plain."""
    joint = run.plan.get("joint_occlusion")
    if joint.overridden and not joint.on:
        return SeparateObjective
    return StillObjective if stands_still(run.clip, run.plan, run.scene) else Objective


def settle(run: Run) -> Iterator[Event]:
    """Fit the background of a run that stands still, and hold it; a resumed run has it in its checkpoint."""
    if not isinstance(run.objective, StillObjective):
        return
    steps = run.config.settle_steps
    if not run.resume:
        yield StageStarted(*run.clock.now(), "background", 0, "the background stands still and is fitted once")
        end = run.clock.this_run() + SETTLE_SHARE * run.config.budget_seconds
        push_back(run.scene)
        plate = torch.from_numpy(run.clip.background.value.astype(np.float32) / 255.0)
        run.objective.settle(plate, run.config, steps, lambda: run.stopped or run.clock.this_run() >= end)
    run.objective.hold()


def stands_still(clip: Clip, plan: EffectPlan, scene: Scene4D) -> bool:
    """True where the background's picture is one for all frames: camera, light and pixels stand still."""
    changes = plan.on("camera_motion") or plan.on("appearance_change")
    return not changes and scene.background is not None and background_is_still(clip)


@torch.no_grad()
def push_back(scene: Scene4D) -> None:
    """Move background Gaussians away from the still camera, along their rays, behind every object that passes there.

    They grow with their distance, so the picture stays the same. A guessed plate, or cells larger than the gap between
    an object and the ground it stands on, would else show through the object.
    """
    background = scene.background
    if background is None:
        return
    width, height = scene.cameras.size
    deepest = np.zeros((height, width), np.float32)
    for t, states in enumerate(scene.states(list(range(len(scene.w2c))), True)):
        means = torch.cat([s.means for s in states])
        _, row, column, z = _pixels(scene, t, means)
        np.maximum.at(deepest, (row, column), z)
    near = cv2.dilate(deepest, np.ones((2 * COVER + 1, 2 * COVER + 1), np.uint8))
    rows, row, column, z = _pixels(scene, 0, background.means)
    factor = np.ones(len(background), np.float32)
    factor[rows] = np.maximum(near[row, column] * BEHIND / z, 1.0)
    pushed, grown = torch.from_numpy(factor)[:, None], torch.from_numpy(np.log(factor))[:, None]
    w2c = scene.w2c[0]
    centre = -w2c[:3, :3].T @ w2c[:3, 3]
    background.means.copy_(centre + (background.means - centre) * pushed)
    background.log_scales.add_(grown)


def _pixels(scene: Scene4D, t: int, means: Tensor) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Of world points (N, 3) in the picture of frame t: their rows among N, pixel row, pixel column, depth."""
    width, height = scene.cameras.size
    xy, z = (a.numpy() for a in safemath.project(means, scene.w2c[t], scene.K[t], scene.cameras.near))
    rows = np.flatnonzero((z > scene.cameras.near) & ((xy >= 0) & (xy < [width, height])).all(axis=1))
    column, row = xy[rows].astype(np.int64).T
    return rows, row, column, z[rows]


class StillObjective(Objective):
    """The joint objective with the background held, once `hold` was called; before that the plain one."""

    held = False
    _backdrop: Rendering | None = None

    def hold(self) -> None:
        """From now on the background is not trained; its picture is drawn when it is next needed."""
        self.held, self._backdrop = True, None
        self._sums: dict[int, tuple[Tensor, Tensor, Tensor]] = {}
        self._cut: dict[int, tuple[Window, FrameTargets]] = {}
        background = self._background()
        background.zero_grad(set_to_none=True)  # the last of its own fit
        background.requires_grad_(False)

    @property
    def fits_background(self) -> bool:
        """False once it is held."""
        return not self.held and super().fits_background

    def backdrop(self) -> Rendering:
        """The background alone, without light: features (H, W, 3), depth and alpha (H, W)."""
        if self._backdrop is None:
            with torch.no_grad():
                self._backdrop = self._draw_background()
        return self._backdrop

    def settle(self, plate: Tensor, config: RunConfig, steps: int, over: Callable[[], bool]) -> int:
        """Fit the background to its plate (H, W, 3), every pixel alike; returns the steps done before `over()`.

        Colour and structure count as in the joint loss. Parts painted in behind the objects keep their colours
        (`invented`), as there.
        """
        background = self._background()
        parameters = [(name, p) for name, p in background.named_parameters() if p.requires_grad]
        optimiser = AdamW(
            [{"params": [p], "lr": start_rate(name, config.rates), "name": name} for name, p in parameters],
            eps=1e-15, betas=(0.9, 0.99), weight_decay=0.0, fused=True,
        )  # fmt: skip
        for step in range(steps):
            if over():
                return step
            for group in optimiser.param_groups:
                group["lr"] = start_rate(group["name"], config.rates) * rate_factor(step / steps)
            optimiser.zero_grad(set_to_none=True)
            drawn = self._draw_background()
            difference = drawn.features - plate
            error = 0.5 * difference.abs().mean() + 5.0 * (difference * difference).mean()
            if self.weights.ssim > 0:
                similar = ssim_map((difference + plate)[None], plate[None]).mean()
                error = self.weights.rgb * error + self.weights.ssim * (1.0 - similar)
            error = error + self.weights.gaps * losses.gap_loss(drawn.alpha, torch.ones_like(drawn.alpha))
            error.backward()
            optimiser.step()
        return steps

    def _background(self) -> Gaussians:
        if self.scene.background is None:
            raise ValueError("a scene without background has nothing that stands still")
        return self.scene.background

    def _draw_background(self) -> Rendering:
        c = self.scene.background_alone()
        splats = Splats(c.means, c.quats, c.scales, c.opacities, c.features)
        return self.splat(splats, self.scene.cameras.view(0))

    def _compared(self, frames: list[int], states: States) -> list[tuple[FrameTargets, Rendering]]:
        if not self.held:
            return super()._compared(frames, states)
        windows = [self._window(t, states[t]) for t in frames]
        targets = [self._cut_target(t, window) for t, window in zip(frames, windows, strict=True)]
        return list(zip(targets, self._windows(frames, states, windows), strict=True))

    def _cut_target(self, t: int, window: Window) -> FrameTargets:
        known = self._cut.get(t)
        if known is None or known[0] != window:
            self._cut[t] = (window, self.targets.frame(t).cut(window))
        return self._cut[t][1]

    def _render(self, frames: list[int], states: States) -> list[Rendering]:
        if not self.held:
            return super()._render(frames, states)
        return self._windows(frames, states, [Window(0, 0, *self.scene.cameras.size)] * len(frames))

    def _windows(self, frames: list[int], states: States, windows: list[Window]) -> list[Rendering]:
        """The objects of each frame in its window, over the backdrop."""
        views = [self.scene.cameras.view(t).cropped(w.left, w.top, w.width, w.height)
                 for t, w in zip(frames, windows, strict=True)]  # fmt: skip
        fronts = self._splatted(frames, states, views, with_background=False)
        return [self._over(*one) for one in zip(frames, fronts, windows, strict=True)]

    def _over(self, t: int, front: Rendering, window: Window) -> Rendering:
        """What is in front of the backdrop in a window, and the backdrop."""
        behind, rows, columns = self.backdrop(), *window.slices()
        rgb = behind.features[rows, columns]
        rgb = rgb if self.scene.gain is None else rgb * self.scene.gain(t)
        open_share = 1.0 - front.alpha
        colour = front.features[..., :3] + open_share[..., None] * rgb
        return Rendering(
            torch.cat([colour, front.features[..., 3:]], dim=-1),
            front.depth + open_share * behind.depth[rows, columns],
            front.alpha + open_share * behind.alpha[rows, columns],
        )

    @torch.no_grad()
    def _window(self, t: int, now: list[ObjectState]) -> Window:
        """What the objects and their masks take up in frame t, with a margin."""
        width, height = self.scene.cameras.size
        rows, columns = torch.nonzero(self.targets.frame(t).labels > 0, as_tuple=True)
        places = [torch.stack([columns, rows], dim=1).float()]
        if now:
            xy, z = safemath.project(torch.cat([s.means for s in now]), self.scene.w2c[t], self.scene.K[t],
                                     self.scene.cameras.near)  # fmt: skip
            size = torch.tensor([width, height])
            places.append(xy[(z > self.scene.cameras.near) & ((xy >= 0) & (xy < size)).all(dim=1)])
        spots = torch.cat(places)
        if not len(spots):
            return Window(0, 0, min(width, 2 * GRID), min(height, 2 * GRID))
        (left, top), (right, bottom) = (spots.amin(dim=0) - MARGIN).tolist(), (spots.amax(dim=0) + MARGIN + 1).tolist()
        return Window(
            max(0, int(left) // GRID * GRID), max(0, int(top) // GRID * GRID),
            min(width, -(-int(right) // GRID) * GRID), min(height, -(-int(bottom) // GRID) * GRID),
        )  # fmt: skip

    def _levels(self, t: int, rendering: Rendering, target: FrameTargets) -> tuple[Tensor, Tensor]:
        """Mean colours of the whole frame: the window's, and the backdrop's outside it."""
        if not self.held or target.window is None:
            return super()._levels(t, rendering, target)
        if t not in self._sums:
            whole = self.targets.frame(t)
            seen = whole.seen[..., None]
            self._sums[t] = (
                (self.backdrop().features * seen).sum((0, 1)), (whole.rgb * seen).sum((0, 1)),
                whole.seen.sum().clamp(min=1.0),
            )  # fmt: skip
        behind, wanted, total = self._sums[t]
        rows, columns = target.window.slices()
        seen = target.seen[..., None]
        outside = behind - (self.backdrop().features[rows, columns] * seen).sum((0, 1))
        outside = outside if self.scene.gain is None else outside * self.scene.gain(t).detach()
        shown = (rendering.features[..., :3].detach() * seen).sum((0, 1)) + outside
        return shown / total, wanted / total
