"""Objects compared one by one, each alone before the background: what joint splatting is measured against.

An object's mask then says "empty" also where another object hides it, as in methods that optimise every object on its
own; nothing explains the missing pixels. Only for `--effects -joint_occlusion` and the methods that lack it.
"""

from __future__ import annotations

from dataclasses import replace

import torch
from torch import Tensor

from genmojo_core.optimise import losses
from genmojo_core.optimise.objective import Objective, States
from genmojo_core.optimise.targets import FrameTargets
from genmojo_core.render.rasterizer import Rendering, Splats
from genmojo_core.scene.scene4d import ObjectState


class SeparateObjective(Objective):
    """The joint objective with data terms per object; pictures and held-out pixels are still judged together."""

    def _render(self, frames: list[int], states: States) -> list[Rendering]:
        self._states = states
        with torch.no_grad():
            return super()._render(frames, states)

    def _data_terms(
        self, t: int, now: list[ObjectState], rendering: Rendering, target: FrameTargets, similar: Tensor
    ) -> dict[str, Tensor]:
        self.order = False
        terms: dict[str, Tensor] = {}
        for k in range(len(now)):
            alone = self._alone(t, now, k)
            own = target.labels == k + 1
            others = (target.labels > 0) & ~own
            seen = target.seen * (~others).float()
            mine = replace(target, labels=torch.where(own, target.labels, 0), seen=seen)
            values = super()._data_terms(t, now, alone, mine, losses.similarity(alone, mine))
            inside = own.float()
            coverage = alone.features[..., 3 : 3 + self.scene.layout.labels].sum(-1)
            values["alpha"] = ((coverage - inside) ** 2 * target.seen).mean() / inside.mean().clamp(min=1e-3)
            for name, value in values.items():
                terms[name] = terms.get(name, 0.0) + value / len(now)
        return terms

    def _alone(self, t: int, now: list[ObjectState], k: int) -> Rendering:
        """Object k and the background."""
        layout = self.scene.layout
        c = self.scene.compose(t, now, self._states.get(t + 1) if layout.flow else None)
        sizes = [len(state.means) for state in now]
        start = sum(sizes[:k])
        rows = torch.cat([torch.arange(start, start + sizes[k]), torch.arange(sum(sizes), len(c.means))])
        splats = Splats(c.means[rows], c.quats[rows], c.scales[rows], c.opacities[rows], c.features[rows])
        return self.splat(splats, self.scene.cameras.view(t), detached_channels=2 if layout.flow else 0)
