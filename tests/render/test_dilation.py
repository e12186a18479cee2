"""The dilation is the view's: a scene looks the same at every size, and its gradients stay exact."""

import numpy as np
import pytest
import torch

from genmojo_core.clip.cameras import View
from genmojo_core.render import autograd, reference, torch_tiles
from genmojo_core.render.rasterizer import Splats

NAMES = ("means", "quats", "scales", "opacities", "features")


def tiny_splats() -> Splats:
    """Splats far smaller than a pixel, whose look is all dilation."""
    generator = torch.Generator().manual_seed(3)
    count = 40
    means = torch.rand(count, 3, generator=generator) * 2 - 1
    means[:, 2] += 5.0
    quats = torch.randn(count, 4, generator=generator)
    scales = torch.tensor([0.02, 0.01, 0.005]).repeat(count, 1)
    return Splats(means, quats, scales, torch.full((count,), 0.8), torch.rand(count, 4, generator=generator))


VIEW = View(np.eye(4), 60.0, 60.0, 24.0, 20.0, 48, 40)


def test_twice_the_size_shows_the_same_picture() -> None:
    small = autograd.splat(tiny_splats(), VIEW).alpha
    large = autograd.splat(tiny_splats(), VIEW.resized(96, 80)).alpha
    pooled = torch.nn.functional.avg_pool2d(large[None, None], 2)[0, 0]
    assert float((pooled - small).abs().mean()) < 0.01
    assert float(large.sum() / 4) == pytest.approx(float(small.sum()), rel=0.05)


@pytest.mark.parametrize("dilation", [0.05, 0.3, 1.2, 20.0])
def test_every_backend_agrees_on_it_with_gradients(dilation: float) -> None:
    view = View(np.eye(4), 60.0, 60.0, 24.0, 20.0, 48, 40, dilation=dilation)
    gradients = []
    for splat in (autograd.splat, torch_tiles.splat, reference.splat):
        splats = tiny_splats()
        wide = torch.float64 if splat is reference.splat else torch.float32
        leaves = {name: getattr(splats, name).to(wide).requires_grad_() for name in NAMES}
        drawn = splat(Splats(**leaves), view)
        ((drawn.features**2).sum() + drawn.alpha.sum()).backward()
        gradients.append({name: leaf.grad.double() for name, leaf in leaves.items()})
    for name in NAMES:
        scale = gradients[2][name].norm()
        assert float((gradients[0][name] - gradients[2][name]).norm() / scale) < 1e-4
        assert float((gradients[1][name] - gradients[2][name]).norm() / scale) < 1e-4
