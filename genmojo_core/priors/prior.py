"""The seam for view-synthesis priors: what one must offer so that unseen sides can be optimised (METHOD.md section 2).

A prior looks at one object alone, in a space of its own (see generator.py): the axes of a camera that looks at the
object (OpenCV), the origin where views turn about, `distance` in front of that camera. It is shown renders of the
object from views that no frame shows and says what they would look like if the object were plausible; sds.py turns
that into a gradient.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Literal, Protocol

import torch
from torch import Tensor


@dataclass(frozen=True)
class Reference:
    """What is known of one object in one frame: a square crop that it fills to 65 %.

    Args:
        picture: (4, H, W) RGB and alpha 0..1, straight alpha. hidden: (H, W) 1 where something in front hides.
        depth: (H, W) relative to the origin, the prior's units, 0 where unknown. known: (H, W) 1 where it is known.
        elevation: degrees of the camera over the horizon. distance: of the camera to the origin, the prior's units.
        up: (3,) unit vector, against gravity, in the prior's space.
    """

    picture: Tensor
    hidden: Tensor
    depth: Tensor
    known: Tensor
    elevation: float
    distance: float
    up: tuple[float, float, float]


@dataclass(frozen=True)
class ViewOffsets:
    """B views relative to the reference view of one object.

    Args:
        elevation, azimuth: (B,) degrees in the convention of conventions.py (+ = from above, + = camera to its right).
        radius: (B,) difference of the distance to the object's centre, in the prior's units.
    """

    elevation: Tensor
    azimuth: Tensor
    radius: Tensor


@dataclass(frozen=True)
class Judgement:
    """What a prior says about B renders x in its own space.

    Args:
        clean: (B, C, h, w) its idea of the noise-free picture. weight: (B,) what score distillation multiplies
            x - clean with at this noise level. mean: (B, C, h, w) the view expected without looking at x, or None.
        confidence: (B, 1, h, w) 0..1, how much each place is worth.
    """

    clean: Tensor
    weight: Tensor
    mean: Tensor | None
    confidence: Tensor


@dataclass(frozen=True)
class PriorGradient:
    """A gradient on B renders.

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

    `resolution` is the side of its pictures in pixels, `channels` whether it reads coverage, `kind` its family;
    `scope` whether it looks at one object or at the whole scene.
    """

    resolution: int
    channels: Literal["rgb", "rgba"]
    kind: Literal["embedded", "zero123", "zeronvs"]
    scope: Literal["object", "scene"]

    def encode(self, reference: Reference) -> Any:
        """Condition on one reference; cached by the caller per object and frame."""
        ...

    def distance(self, reference: Reference) -> float:
        """How far its cameras are from the origin: the reference's, or the one it was trained with."""
        ...

    def embed(self, renders: Tensor) -> Tensor:
        """Renders (B, 4, H, W), premultiplied RGBA of any size, in the prior's own space; differentiable."""
        ...

    def judge(
        self, embedded: Tensor, condition: Any, views: ViewOffsets, level: float, generator: torch.Generator
    ) -> Judgement:
        """Look at embedded renders at a noise level 0..1; the same generator state gives the same bits."""
        ...

    def predict(self, condition: Any, views: ViewOffsets) -> Tensor | None:
        """The prior's mean pictures (B, 4, h, w) of the views, premultiplied RGBA, or None if it has none."""
        ...
