"""A step's large arrays are used again: once warm, the kernels' work asks the system for no memory worth naming."""

from __future__ import annotations

import tracemalloc

import numpy as np
import torch

from genmojo_core.clip.cameras import View
from genmojo_core.kernels import buffers, threads
from genmojo_core.optimise.joint_loss import Wanted, data_terms
from genmojo_core.optimise.targets import FrameTargets
from genmojo_core.render import autograd
from genmojo_core.render.rasterizer import Splats
from genmojo_core.render.ssim import ssim_map
from genmojo_core.scene.plane_sampling import sample_planes, sample_time_planes
from genmojo_core.scene.scene4d import Layout

COUNT, WIDTH, HEIGHT, LABELS, FRAMES = 20_000, 200, 136, 2, 2
LARGEST = buffers.SMALLEST  # bytes


def work(leaves: Splats, field: tuple[torch.Tensor, ...], target: FrameTargets) -> None:
    """What kernels do in one step of some frames: fields, splatting, the data terms and SSIM, forward and backward."""
    planes, lines, coords = field
    layout = Layout(LABELS, flow=True)
    wanted = Wanted(background=True, labels=True, depth=True)
    shift = sample_planes(planes, coords)[None] * sample_time_planes(lines, coords, torch.linspace(-1, 1, FRAMES))
    loss = shift.square().mean()
    view = View(np.eye(4), 150.0, 150.0, WIDTH / 2, HEIGHT / 2, WIDTH, HEIGHT)
    for _ in range(FRAMES):
        picture = autograd.splat(leaves, view, detached_channels=2)
        loss = loss + sum(data_terms(picture, layout, target, wanted).values())
        loss = loss + 1 - ssim_map(picture.features[None, ..., :3], target.rgb[None]).mean()
    loss.backward()


def test_a_warm_step_allocates_no_large_arrays() -> None:
    """numpy's arrays, which is what kernels fill; torch keeps its own between their calls."""
    g = torch.Generator().manual_seed(0)

    def uniform(*shape: int) -> torch.Tensor:
        return torch.rand(*shape, generator=g)

    means = uniform(COUNT, 3) * torch.tensor([3.0, 2.0, 2.0]) + torch.tensor([-1.5, -1.0, 2.0])
    parts = (means, uniform(COUNT, 4) + 0.1, 0.02 + 0.03 * uniform(COUNT, 3), 0.2 + 0.7 * uniform(COUNT),
             uniform(COUNT, 3 + LABELS + 2) / 2)  # fmt: skip
    leaves = Splats(*(part.requires_grad_() for part in parts))
    field = (torch.ones(3, 32, 32, 16), torch.ones(3, 32, 9, 16), 2 * uniform(COUNT, 3) - 1)
    seen = torch.ones(HEIGHT, WIDTH)
    labels = (torch.arange(WIDTH) * 3 // WIDTH).expand(HEIGHT, WIDTH).contiguous()
    target = FrameTargets(uniform(HEIGHT, WIDTH, 3), labels, seen, seen < 0, 2 + seen, seen, uniform(HEIGHT, WIDTH, 2),
                          seen, True)  # fmt: skip
    field = tuple(part.requires_grad_() for part in field[:2]) + field[2:]
    threads.set_threads(1)  # a helper that starts late would make its own scratch only then
    for _ in range(3):
        work(leaves, field, target)
    known = {id(array) for array in buffers._kept}
    tracemalloc.start()
    try:
        before = tracemalloc.get_traced_memory()[0]
        tracemalloc.reset_peak()
        work(leaves, field, target)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
        threads.set_threads(0)
    assert {id(array) for array in buffers._kept} == known
    assert peak - before < 3 * LARGEST  # small ones; any array of a number per splat or pixel would go beyond
