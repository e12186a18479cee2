"""The seam for view-synthesis priors: what one must offer so that unseen sides can be optimised (METHOD.md section 2).

No prior is part of this version; `RunConfig.prior` other than "none" is refused. The optimiser will hand a prior
renders of one object alone, in its own coordinates, seen from views no frame shows, and take its gradient.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Literal, Protocol

import torch
from torch import Tensor


@dataclass(frozen=True)
class ViewOffsets:
    """B views relative to the reference view of one object.

    Args:
        elevation, azimuth: (B,) degrees in the convention of conventions.py (+ = from above, + = camera to its right).
        radius: (B,) difference of the distance to the object's centre, in units of the object's size.
    """

    elevation: Tensor
    azimuth: Tensor
    radius: Tensor


@dataclass(frozen=True)
class PriorGradient:
    """What a prior says about B renders.

    Args:
        gradient: (B, C, h, w) in the prior's own space. clean: (B, C, h, w) its idea of the noise-free picture.
        weight: (B,) the noise level's weight. loss: scalar whose autograd gives `gradient` to the renders.
        statistics: numbers for the log.
    """

    gradient: Tensor
    clean: Tensor
    weight: Tensor
    loss: Tensor
    statistics: dict[str, float] = field(default_factory=dict)


class ViewPrior(Protocol):
    """A model that knows what an object may look like from another side.

    `resolution` is the side of its pictures in pixels, `channels` whether it reads coverage, `kind` its family.
    """

    resolution: int
    channels: Literal["rgb", "rgba"]
    kind: Literal["embedded", "zero123"]

    def encode(self, picture: Tensor, elevation: float) -> Any:
        """Condition on one reference crop: (4, H, W) RGBA 0..1, straight alpha; elevation of its camera in degrees."""

    def gradient(
        self, renders: Tensor, condition: Any, views: ViewOffsets, level: float, generator: torch.Generator
    ) -> PriorGradient:
        """Judge renders (B, 4, H, W) RGBA at a noise level 0..1; the same generator state gives the same bits."""

    def predict(self, condition: Any, views: ViewOffsets) -> Tensor | None:
        """The prior's mean pictures (B, 4, h, w) of the views, or None if it has none."""
