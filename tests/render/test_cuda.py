"""gsplat on a CUDA device against the CPU rasteriser: same pictures, same directions of gradients."""

from __future__ import annotations

import pytest
import torch

from genmojo_core.render import autograd
from genmojo_core.render.rasterizer import Splats
from tests.render.scenes import NAMES, camera, random_splats, run, turned_pose, upstream

pytestmark = [
    pytest.mark.gpu,
    pytest.mark.skipif(not torch.cuda.is_available(), reason="needs a CUDA device"),
]


def _on_gpu(splats: Splats) -> Splats:
    return Splats(*(getattr(splats, n).cuda() for n in NAMES))


@pytest.mark.parametrize("detached", [0, 2])
def test_cuda_draws_what_the_cpu_draws(detached: int) -> None:
    from genmojo_core.render import cuda

    splats, view = random_splats(300, 7, 0), camera(70, 50).with_pose(turned_pose())
    splats.opacities.clamp_(max=0.95)  # the two clamp alpha at 0.99 and 0.999
    weights = upstream(view, 7)
    ours, gradients = run(autograd.splat, splats, view, weights, detached_channels=detached)
    on_gpu = type(weights)(*(getattr(weights, p).cuda() for p in ("features", "depth", "alpha")))
    theirs, others = run(cuda.splat, _on_gpu(splats), view, on_gpu, detached_channels=detached)
    for part, limit in (("features", 2e-3), ("alpha", 2e-3), ("depth", 1e-2)):
        difference = (getattr(ours, part) - getattr(theirs, part).cpu()).abs()
        assert difference.quantile(0.99) < limit, part
    for name in NAMES:
        a, b = gradients[name].flatten(), others[name].cpu().flatten()
        assert torch.nn.functional.cosine_similarity(a, b, dim=0) > 0.999, name
        assert (a.norm() / b.norm() - 1).abs() < 2e-2, name


def test_cuda_draws_nothing_from_nothing() -> None:
    from genmojo_core.render import cuda

    empty = Splats(*(getattr(_on_gpu(random_splats(2, 3, 0)), n)[:0] for n in NAMES))
    assert (cuda.splat(empty, camera(8, 8)).alpha == 0).all()
