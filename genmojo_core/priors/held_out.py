"""The table that describes a prior: its mean views and four hand-made predictors on the frozen test set."""

from __future__ import annotations

from collections.abc import Callable

import cv2
import numpy as np
import torch
from torch import Tensor
from torch.nn import functional

from genmojo_core.priors.batches import Batch, batch_of
from genmojo_core.priors.tasks import VolumeTask, scores
from genmojo_core.priors.test_set import VIEWS, frozen_examples
from genmojo_core.priors.volume import FAR, NEAR, VolumeNet, VolumeShape, render

THICKNESSES = (0.5, 0.8, 1.2, 1.6)  # of inflated silhouettes, in units of the distance to the outline
Table = dict[str, dict[str, float]]


def table(net: VolumeNet, objects: int | None = None) -> Table:
    """Rows by predictor: PSNR on grey in dB by angle and over all views, `inside` dB, mask `iou`.

    Also the prior without depth and with the next object's condition, by which it must lose. Of the first `objects` of
    the set only, where that is given.
    """
    batch = batch_of(frozen_examples()[:objects])
    task = VolumeTask(net.eval())
    with torch.no_grad():
        best = max((inflated(batch, k) for k in THICKNESSES), key=lambda p: scores(p, batch.targets)["psnr"])
        rows: dict[str, Tensor] = {
            "empty": torch.zeros_like(batch.targets), "copy of the condition": copied(batch),
            "mean silhouette": mean_silhouette(batch), "inflated silhouette": best,
            "prior": task.predict(batch), "prior without depth": task.predict(_changed(batch, _without_depth)),
            "prior, another object's condition": task.predict(_changed(batch, lambda c: c.roll(1, 0))),
        }  # fmt: skip
    return {name: row(pictures, batch.targets) for name, pictures in rows.items()}


def row(pictures: Tensor, targets: Tensor) -> dict[str, float]:
    """Figures of pictures (B, K, 4, S, S) of the frozen views."""
    figures: dict[str, float] = {}
    for angle in (30, 60, 90, 120, 150, 180):
        views = (np.abs(VIEWS[:, 1]) == angle) & (VIEWS[:, 0] == 0)
        figures[str(angle)] = scores(pictures[:, views], targets[:, views])["psnr"]
    views = VIEWS[:, 0] > 0
    figures["above"] = scores(pictures[:, views], targets[:, views])["psnr"]
    return figures | {("all" if k == "psnr" else k): v for k, v in scores(pictures, targets).items()}


def copied(batch: Batch) -> Tensor:
    """The condition itself in every view."""
    color = batch.condition[:, :3] * batch.condition[:, 3:4]
    small = functional.avg_pool2d(torch.cat([color, batch.condition[:, 3:4]], dim=1), 2)
    return small[:, None].expand_as(batch.targets)


def mean_silhouette(batch: Batch) -> Tensor:
    """The test set's own mean coverage (generous) in the object's mean colour."""
    alpha = batch.condition[:, 3:4]
    color = (batch.condition[:, :3] * alpha).sum((2, 3)) / alpha.sum((2, 3)).clamp(min=1.0)
    mean = batch.targets[:, :, 3:].mean((0, 1), keepdim=True)
    flat = torch.cat([color, torch.ones_like(color[:, :1])], dim=1)[:, None, :, None, None]
    return (flat * mean).expand_as(batch.targets)


def inflated(batch: Batch, thickness: float) -> Tensor:
    """Pictures (B, K, 4, S, S) of `inflated_volume`."""
    side = VolumeShape().side
    drawn = render(inflated_volume(batch.condition, thickness), batch.rays(side))
    return drawn[..., :4].transpose(2, 3).unflatten(3, (side, side))


def inflated_volume(condition: Tensor, thickness: float) -> Tensor:
    """(B, 4, bins, S, S) of conditions (B, 7, 2 S, 2 S).

    The visible surface where the depth says it is, as thick as the silhouette is wide, its texture all through.
    """
    shape = VolumeShape()
    small = functional.avg_pool2d(condition, 2)
    alpha = small[:, 3]
    color = small[:, :3] / alpha.clamp(min=1e-3)[:, None]
    deep = functional.avg_pool2d(condition[:, 5:6], 2)[:, 0] / small[:, 6].clamp(min=1e-3)
    inside = [cv2.distanceTransform((a > 0.5).astype(np.uint8), cv2.DIST_L2, 5) for a in alpha.numpy()]
    reach = torch.from_numpy(np.stack(inside)) * (2.0 / shape.side) * thickness
    z = torch.linspace(NEAR, FAR, shape.bins)[None, :, None, None]
    filled = (z >= deep[:, None]) & (z <= (deep + 2.0 * reach)[:, None] + (FAR - NEAR) / shape.bins)
    density = filled * alpha[:, None] * 40.0
    return torch.cat([color[:, :, None].expand(-1, -1, shape.bins, -1, -1), density[:, None]], dim=1)


def _without_depth(condition: Tensor) -> Tensor:
    """Depth unknown everywhere."""
    changed = condition.clone()
    changed[:, 5:] = 0
    return changed


def _changed(batch: Batch, change: Callable[[Tensor], Tensor]) -> Batch:
    """The batch with other conditions."""
    return Batch(change(batch.condition), batch.facts, batch.distance, batch.to_space, batch.targets)
