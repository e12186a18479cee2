"""From a prior's judgement to a gradient: score distillation, one-step reconstruction, pseudo-views.

With x the render, x + s n what the prior is shown and D its clean picture, score distillation's gradient
w (noise predicted - noise) equals a scalar times x - D (PRIOR.md section 1). So the three modes are one family,
gradient = scalar * confidence * (x - target):

    sds     target D, scalar = the noise level's weight
    x0      target D, scalar = 1
    pseudo  target = the prior's mean view, scalar = 1: the limit of infinite noise
"""

from __future__ import annotations

from typing import Any, Literal, get_args

import torch
from torch import Tensor

from genmojo_core.errors import GenmojoError
from genmojo_core.priors.prior import PriorGradient, ViewOffsets, ViewPrior

GAP_LIMIT = 20.0  # pictures lie in 0..1, latents within a few units: a target farther from the render is no target

Mode = Literal["sds", "x0", "pseudo"]
MODES: tuple[str, ...] = get_args(Mode)


def distil(
    prior: ViewPrior, renders: Tensor, condition: Any, views: ViewOffsets, level: float, mode: Mode,
    generator: torch.Generator,
) -> PriorGradient:  # fmt: skip
    """Gradient of B renders (B, 4, H, W), premultiplied RGBA.

    `loss` is 1/2 sum of scalar * confidence * (x - target)^2 with everything but x held fixed, so that autograd gives
    exactly `gradient`; the sum runs over pictures, channels and places. Values that are not finite, or farther than
    GAP_LIMIT from the render, count as 0; `statistics["left_out"]` is their share (RELIABILITY.md N26).

    Raises:
        GenmojoError("argument"): mode "pseudo" with a prior that has no mean view.
    """
    x = prior.embed(renders)
    with torch.no_grad():
        judged = prior.judge(x.detach(), condition, views, level, generator)
        target = judged.clean
        weight = judged.weight if mode == "sds" else torch.ones_like(judged.weight)
        if mode == "pseudo":
            if judged.mean is None:
                raise GenmojoError("argument", f"the prior {prior.kind} has no mean views", "--prior-mode",
                                   "use sds or x0")  # fmt: skip
            target = judged.mean
        factor = weight[:, None, None, None] * judged.confidence
        usable = ((target - x).abs() < GAP_LIMIT) & torch.isfinite(factor)
        target = torch.where(usable, target, x)
        factor = torch.where(usable, factor, 0.0)
    gap = x - target
    loss = 0.5 * (factor * gap * gap).sum()
    gradient = (factor * gap).detach()
    statistics = {"level": level, "weight": float(weight.mean()), "gap": float((gap.detach() ** 2).mean()),
                  "left_out": 1.0 - float(usable.float().mean())}  # fmt: skip
    return PriorGradient(gradient, target, weight, loss, statistics)
