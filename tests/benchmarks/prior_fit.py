"""What the embedded prior gives to a fit: 600 Gaussians and one picture of an object nobody has seen (PRIOR.md 5).

    python -m tests.benchmarks.prior_fit [--objects 4] [--weights FILE]

The Gaussians start in a ball and follow one 32 x 32 picture for 220 steps: alone, with a regulariser (compact, solid),
and with four unseen views a step besides, judged by the prior as pseudo-views, by x0, by sds, and as pseudo-views of
another object's condition. Figures against truth by angle: PSNR inside the union of the silhouettes, IoU. Prints JSON.
One seed; the objects are the first of the frozen test set.
"""

from __future__ import annotations

import argparse
import json
import time
from pathlib import Path

import numpy as np
import torch
from torch import Tensor

from genmojo_core.clip.cameras import View
from genmojo_core.optimise.unseen import draw_views, fade, levels
from genmojo_core.priors import weights
from genmojo_core.priors.embedded import Condition, EmbeddedPrior, view_cameras
from genmojo_core.priors.generator import SIDE, Example
from genmojo_core.priors.prior import Reference, ViewOffsets
from genmojo_core.priors.sds import Mode, distil
from genmojo_core.priors.solids import HALF_EXTENT
from genmojo_core.priors.tasks import scores
from genmojo_core.priors.test_set import VIEWS, frozen_examples
from genmojo_core.render.backend import choose
from genmojo_core.render.rasterizer import Splats
from genmojo_core.scene import safemath

GAUSSIANS, STEPS, NOVEL = 600, 220, 4
RATES = {"means": 0.01, "log_scales": 0.02, "logits": 0.05, "rgb": 0.03}
PRIOR_WEIGHT = {"pseudo": 1.0, "x0": 1.0, "sds": 3.0}  # sds carries a weight of at most 1/2 of its own
KINDS = ("none", "regularised", "pseudo", "x0", "sds", "another object's")
SPLAT = choose("cpu")


def main() -> None:
    """One JSON object: kind -> figures."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--objects", type=int, default=4)
    parser.add_argument("--weights", type=Path, default=weights.SHIPPED)
    args = parser.parse_args()
    torch.set_num_threads(1)
    prior = weights.read(args.weights)
    examples = frozen_examples()[: args.objects]
    references = [reference_of(one) for one in examples]
    conditions = [prior.encode(one) for one in references]
    truth = torch.from_numpy(np.stack([one.targets for one in examples]))
    result = {}
    for kind in KINDS:
        began = time.process_time()
        shown = conditions[-1:] + conditions[:-1] if kind == "another object's" else conditions
        pictures = [fitted(prior, *pair, kind) for pair in zip(references, shown, strict=True)]
        result[kind] = {**figures(torch.stack(pictures), truth), "cpu": time.process_time() - began}
    print(json.dumps(result))


def figures(ours: Tensor, truth: Tensor) -> dict[str, float]:
    """Inside the union in dB by angle, IoU over all."""
    rows: dict[str, float] = {}
    for angle in (30, 90, 180):
        views = (np.abs(VIEWS[:, 1]) == angle) & (VIEWS[:, 0] == 0)
        rows[str(angle)] = scores(ours[:, views], truth[:, views])["inside"]
    return rows | {"all": scores(ours, truth)["inside"], "iou": scores(ours, truth)["iou"]}


def fitted(prior: EmbeddedPrior, reference: Reference, condition: Condition, kind: str) -> Tensor:
    """(views, 4, SIDE, SIDE) of the Gaussians after the fit, from the frozen views."""
    generator = torch.Generator().manual_seed(0)
    rng = np.random.default_rng(0)
    ball = torch.randn(GAUSSIANS, 3, generator=generator)
    ball = ball / ball.norm(dim=1, keepdim=True) * 0.5 * torch.rand(GAUSSIANS, 1, generator=generator) ** (1 / 3)
    held = {"means": ball, "log_scales": torch.full((GAUSSIANS,), float(np.log(0.06))),
            "logits": torch.zeros(GAUSSIANS), "rgb": torch.full((GAUSSIANS, 3), 0.5)}  # fmt: skip
    held = {name: value.requires_grad_(True) for name, value in held.items()}
    optimiser = torch.optim.Adam([{"params": [held[name]], "lr": rate} for name, rate in RATES.items()])
    small = torch.nn.functional.avg_pool2d(torch.cat([reference.picture[:3] * reference.picture[3:],
                                                      reference.picture[3:]])[None], 2)[0]  # fmt: skip
    own = ViewOffsets(torch.zeros(1), torch.zeros(1), torch.zeros(1))
    for step in range(STEPS):
        share = step / STEPS
        loss = ((drawn(held, reference, own)[0] - small) ** 2).mean()
        if kind != "none":
            opacity = torch.sigmoid(held["logits"])
            loss = loss + 1e-3 * (held["means"] ** 2).mean() + 1e-3 * (opacity * (1 - opacity)).mean()
        mode: Mode | None = "pseudo" if kind == "another object's" else kind if kind in PRIOR_WEIGHT else None
        if mode is not None:
            views = draw_views(rng, NOVEL)
            level = float(rng.uniform(*levels(share)))
            said = distil(prior, drawn(held, reference, views), condition, views, level, mode, generator)
            loss = loss + PRIOR_WEIGHT[mode] * fade(share) * said.loss * 2.0 / said.gradient.numel()
        optimiser.zero_grad()
        loss.backward()
        optimiser.step()
    angles = torch.tensor(VIEWS, dtype=torch.float32)
    with torch.no_grad():
        return drawn(held, reference, ViewOffsets(angles[:, 0], angles[:, 1], torch.zeros(len(angles))))


def drawn(held: dict[str, Tensor], reference: Reference, views: ViewOffsets) -> Tensor:  # (B, 4, SIDE, SIDE)
    """The Gaussians from the prior's cameras, premultiplied RGBA."""
    focal = SIDE / 2 * reference.distance / HALF_EXTENT
    quats = torch.zeros(GAUSSIANS, 4)
    quats[:, 0] = 1.0
    scales = safemath.exp_scale(held["log_scales"])[:, None].expand(-1, 3)
    splats = Splats(held["means"], quats, scales, torch.sigmoid(held["logits"]), held["rgb"])
    pictures = []
    for pose in view_cameras(reference, views, reference.distance):
        one = SPLAT(splats, View(pose, focal, focal, SIDE / 2, SIDE / 2, SIDE, SIDE))
        pictures.append(torch.cat([one.features, one.alpha[..., None]], dim=-1).movedim(-1, 0))
    return torch.stack(pictures)


def reference_of(one: Example) -> Reference:
    """What the prior is told of a test object."""
    c = torch.from_numpy(one.condition)
    angle = np.deg2rad(one.elevation)
    up = (0.0, float(-np.cos(angle)), float(-np.sin(angle)))
    return Reference(c[:4], c[4], c[5], c[6], one.elevation, one.distance, up)


if __name__ == "__main__":
    main()
