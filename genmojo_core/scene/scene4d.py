"""The trainable 4D scene: objects (canonical Gaussians, placement, deformation), background, light.

What the effect plan leaves out does not exist here: no field, no gain, no channel, no parameter.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import torch
from torch import Tensor, nn

from genmojo_core.clip.cameras import Cameras
from genmojo_core.conventions import SH_C0
from genmojo_core.scene import safemath
from genmojo_core.scene.appearance import FrameGain
from genmojo_core.scene.deform import Deformation, DeformationField
from genmojo_core.scene.gaussians import Gaussians
from genmojo_core.scene.placement import Placement
from genmojo_core.scene.shading import Shade, outward, thin_axes


@dataclass(frozen=True)
class ObjectState:
    """One object's Gaussians at one frame.

    local_means (N, 3) and local_quats (N, 4) unit in object space; means (N, 3), quats (N, 4), scales (N, 3) in world;
    rgb (N, 3) before any frame gain; deformation as the field gave it (None: rigid).
    """

    local_means: Tensor
    local_quats: Tensor
    means: Tensor
    quats: Tensor
    scales: Tensor
    rgb: Tensor
    deformation: Deformation | None


class ObjectModel(nn.Module):
    """One object over the whole clip.

    Args:
        id, name: as in the clip. ref_frame: canonical frame. gaussians: canonical, object units.
        placement: object to world per frame. field: deformation, or None when the object moves rigidly.
    """

    def __init__(
        self, id: int, name: str, ref_frame: int, gaussians: Gaussians, placement: Placement,
        field: DeformationField | None,
    ) -> None:  # fmt: skip
        super().__init__()
        self.id, self.name, self.ref_frame = id, name, ref_frame
        self.gaussians = gaussians
        self.placement = placement
        self.field = field

    def states(self, frames: list[int], deform: bool = True) -> list[ObjectState]:
        """The object at some frames; with deform=False only placed (the static lift)."""
        g = self.gaussians
        field = self.field if deform else None
        deformation = None if field is None else field(g.means, torch.tensor(frames))
        states = []
        for b, t in enumerate(frames):
            d = None if deformation is None else deformation.at(b)
            states.append(self._place(t, d))
        return states

    def _place(self, t: int, d: Deformation | None) -> ObjectState:
        g = self.gaussians
        size, turn, origin = self.placement.similarity(t)
        means = g.means if d is None else g.means + d.d_means
        quats = safemath.normalise(g.quats if d is None else g.quats + d.d_quats)
        scales = safemath.exp_scale(g.log_scales if d is None else g.log_scales + d.d_log_scales)
        dc = g.dc if d is None or d.d_dc is None else g.dc + d.d_dc
        return ObjectState(
            means, quats, size * safemath.rotate(turn, means) + origin,
            safemath.quaternion_multiply(turn.expand_as(quats), quats), size * scales, 0.5 + SH_C0 * dc, d,
        )  # fmt: skip

    def facing(self, state: ObjectState) -> tuple[Tensor, Tensor]:
        """World normals (N, 3) of the Gaussians in the canonical frame and in a state; they carry no gradient."""
        g = self.gaussians
        with torch.no_grad():
            own = safemath.normalise(g.quats)
            axes = outward(g.means, own, thin_axes(g.log_scales))
            turn = self.placement.similarity(self.ref_frame)[1]
            there = safemath.rotate(safemath.quaternion_multiply(turn.expand_as(own), own), axes)
            return there, safemath.rotate(state.quats, axes)

    def carry(self, points: Tensor, frames: list[int]) -> Tensor:  # (P, 3) canonical -> (B, P, 3) world
        """World positions of canonical points (not Gaussians) at some frames."""
        deformation = None if self.field is None else self.field(points, torch.tensor(frames))
        placed = []
        for b, t in enumerate(frames):
            size, turn, origin = self.placement.similarity(t)
            local = points if deformation is None else points + deformation.d_means[b]
            placed.append(size * safemath.rotate(turn, local) + origin)
        return torch.stack(placed)


@dataclass(frozen=True)
class Layout:
    """Which feature channel holds what: rgb 0..2, then `labels` channels, then 2 flow channels if `flow`."""

    labels: int
    flow: bool

    @property
    def channels(self) -> int:
        """Number of feature channels."""
        return 3 + self.labels + (2 if self.flow else 0)


@dataclass(frozen=True)
class Composed:
    """World-space splats of one frame: means (N, 3), quats, scales, opacities (N,), features (N, C); objects first."""

    means: Tensor
    quats: Tensor
    scales: Tensor
    opacities: Tensor
    features: Tensor


class Scene4D(nn.Module):
    """All objects, the background and the light.

    Args:
        objects: K object models in the clip's order. background: world-space Gaussians with fixed means, or None; its
        `invented` ones stay as they are.
        gain: light per frame, or None. cameras: the clip's, for the optimised image size. layout: feature channels.

    `shade`: how bright a surface is by where it faces, or None (the light follows objects that turn).
    """

    def __init__(
        self, objects: list[ObjectModel], background: Gaussians | None, gain: FrameGain | None, cameras: Cameras,
        layout: Layout,
    ) -> None:  # fmt: skip
        super().__init__()
        self.objects = nn.ModuleList(objects)
        self.background = background
        if background is not None:
            background.means.requires_grad_(False)
        self.gain = gain
        self.shade: Shade | None = None
        self.cameras = cameras
        self.layout = layout
        self.register_buffer("w2c", torch.tensor(cameras.world_to_camera, dtype=torch.float32))
        self.register_buffer("K", torch.tensor(cameras.K, dtype=torch.float32))

    w2c: Tensor
    K: Tensor

    def __len__(self) -> int:
        """Number of Gaussians, background included."""
        return sum(len(o.gaussians) for o in self.objects) + (0 if self.background is None else len(self.background))

    def states(self, frames: list[int], deform: bool = True) -> list[list[ObjectState]]:
        """States of all objects, first index the frame's position in `frames`."""
        by_object = [o.states(frames, deform) for o in self.objects]
        return [[self.shaded(model, states[b]) for model, states in zip(self.objects, by_object, strict=True)]
                for b in range(len(frames))]  # fmt: skip

    def shaded(self, model: ObjectModel, state: ObjectState) -> ObjectState:
        """The state of an object with its colours under the light it turns in."""
        return state if self.shade is None else replace(state, rgb=state.rgb * self.shade(*model.facing(state)))

    def compose(
        self, t: int, now: list[ObjectState], after: list[ObjectState] | None = None, with_background: bool = True
    ) -> Composed:
        """Everything in world space at frame t.

        Args:
            now: object states at t. after: states at t + 1, for the flow channels (None: flow 0).
            with_background: False leaves it out.
        """
        parts: list[tuple[Tensor, ...]] = []
        gain = None if self.gain is None else self.gain(t)
        for k, (model, state) in enumerate(zip(self.objects, now, strict=True)):
            rgb = state.rgb if gain is None else state.rgb * gain
            flow = self._flow(t, state, None if after is None else after[k]) if self.layout.flow else None
            parts.append(
                (state.means, state.quats, state.scales, model.gaussians.opacities(), self._features(rgb, k, flow))
            )
        if self.background is not None and with_background:
            g = self.background
            rgb = 0.5 + SH_C0 * g.dc
            rgb = rgb if gain is None else rgb * gain
            columns = (g.means, g.quats, g.scales(), g.opacities(), self._features(rgb, None, None))
            parts.append(_held(columns, g.invented))
        return Composed(*(torch.cat(columns) for columns in zip(*parts, strict=True)))

    def background_alone(self) -> Composed:
        """The background in world space, its colours as features, without light. ValueError where there is none."""
        if self.background is None:
            raise ValueError("the scene has no background")
        g = self.background
        return Composed(*_held((g.means, g.quats, g.scales(), g.opacities(), 0.5 + SH_C0 * g.dc), g.invented))

    def _features(self, rgb: Tensor, k: int | None, flow: Tensor | None) -> Tensor:
        columns = [rgb]
        labels = torch.zeros(len(rgb), self.layout.labels)
        if k is not None and self.layout.labels:
            labels[:, min(k, self.layout.labels - 1)] = 1.0
        columns.append(labels)
        if self.layout.flow:
            columns.append(torch.zeros(len(rgb), 2) if flow is None else flow)
        return torch.cat(columns, dim=1)

    def _flow(self, t: int, now: ObjectState, after: ObjectState | None) -> Tensor | None:
        """Pixel motion of every centre to frame t + 1, each frame under its own camera; gradient only to `after`."""
        if after is None:
            return None
        near = self.cameras.near
        here, _ = safemath.project(now.means.detach(), self.w2c[t], self.K[t], near)
        there, z = safemath.project(after.means, self.w2c[t + 1], self.K[t + 1], near)
        return torch.where((z > near)[:, None], there - here, torch.zeros_like(here))


def _held(columns: tuple[Tensor, ...], rows: Tensor) -> tuple[Tensor, ...]:
    """Columns (N, ...) of which some rows (N,) bool get no gradient."""
    if not bool(rows.any()):
        return columns
    return tuple(torch.where(rows.reshape(-1, *[1] * (c.dim() - 1)), c.detach(), c) for c in columns)
