"""One optimiser step, part by part, ours against the same step in plain torch, on one thread.

    python -m tests.benchmarks.step [--json FILE] [--rounds N] [--no-torch]

The step: 8 frames of 256 x 256, 3 objects of 3,000 Gaussians and a background of 5,000; per object a K-plane field
(64 and 128 nodes, 25 times, 32 channels each) read at 8 times with a trunk of width 64 and ten outputs; L1 + SSIM on
the colours, and the joint loss's own data terms (colour, coverage, labels, depth, flow), an object on an eighth of the
picture each; AdamW. The full step reads the field at two times per frame and adds the rigidity and rotation terms
between them, as optimise/objective.py does. CPU seconds, medians of rounds.
"""

from __future__ import annotations

import argparse
import json
import statistics
import time
from collections.abc import Callable
from pathlib import Path

import torch
from torch import Tensor, nn

from genmojo_core.kernels import threads
from genmojo_core.optimise.joint_loss import Wanted, data_terms, data_terms_torch
from genmojo_core.optimise.objective import SAMPLED_ROWS
from genmojo_core.optimise.regularise import nearest, rigidity
from genmojo_core.optimise.targets import FrameTargets
from genmojo_core.render import autograd, ssim, torch_tiles
from genmojo_core.render.rasterizer import Rendering, Splats
from genmojo_core.scene import plane_sampling
from genmojo_core.scene.scene4d import Layout, ObjectState
from tests.benchmarks.workload import FLOW, scene, view_of

FRAMES, SIDE, OBJECTS, PER_OBJECT, BACKGROUND = 8, 256, 3, 3000, 5000
NEIGHBOURS = 15  # config.py
NAMES = ("means", "quats", "scales", "opacities", "features")


def main() -> None:
    """Measure every part and print a table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--json", type=Path)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--no-torch", action="store_true", help="leave the plain torch step out")
    arguments = parser.parse_args()
    threads.set_threads(1)
    torch.set_num_threads(1)
    figures = {}
    for part, (ours, plain) in parts().items():
        figures[part] = {"ours": median_seconds(ours, arguments.rounds)}
        if not arguments.no_torch:
            figures[part]["torch"] = median_seconds(plain, 1)
        print(part.ljust(12), *(f"{k} {1e3 * v:9.1f} ms" for k, v in figures[part].items()), flush=True)
    sums = {}
    for name, absent in (("step", ("field x 2", "rigidity")), ("full step", ("field",))):
        rows = [row for part, row in figures.items() if part not in absent]
        sums[name] = {k: sum(row[k] for row in rows) for k in rows[0]}
        print(name.ljust(12), *(f"{k} {1e3 * v:9.1f} ms" for k, v in sums[name].items()))
    if arguments.json:
        arguments.json.write_text(json.dumps({"parts": figures, "sums": sums}, indent=1))


def median_seconds(work: Callable[[], None], rounds: int) -> float:
    """Median CPU seconds of some rounds, after one that compiles."""
    if rounds > 1:
        work()
    seconds = []
    for _ in range(rounds):
        start = time.process_time()
        work()
        seconds.append(time.process_time() - start)
    return statistics.median(seconds)


def parts() -> dict[str, tuple[Callable[[], None], Callable[[], None]]]:
    """(ours, plain torch) of every part of a step."""
    return {
        "raster": (lambda: raster(autograd.splat), lambda: raster(torch_tiles.splat)),
        "field": field_pair(FRAMES),
        "field x 2": field_pair(2 * FRAMES),
        "rigidity": rigidity_pair(),
        "ssim": (lambda: colours(ssim.ssim_map), lambda: colours(ssim.ssim_map_torch)),
        "data losses": losses_pair(),
        "adamw": (lambda: adamw(fused=True), lambda: adamw(fused=False)),
    }  # type: ignore[return-value]


_SPLATS = scene(OBJECTS * PER_OBJECT + BACKGROUND, SIDE, SIDE)
_UPSTREAM = torch.randn(SIDE, SIDE, _SPLATS.features.shape[1] + 2, generator=torch.Generator().manual_seed(0))


def raster(draw: Callable) -> None:
    """Forward and backward of eight views of the whole scene."""
    leaves = Splats(*(torch.from_numpy(getattr(_SPLATS, n)).clone().requires_grad_() for n in NAMES))
    for _ in range(FRAMES):
        picture = draw(leaves, view_of(SIDE, SIDE), detached_channels=FLOW)
        planes = [picture.features, picture.depth, picture.alpha]
        torch.autograd.backward(planes, [_UPSTREAM[..., 2:], _UPSTREAM[..., 0], _UPSTREAM[..., 1]])


def field_pair(moments: int) -> tuple[Callable[[], None], Callable[[], None]]:
    """The fields of all objects at some times: fused plane reads, and plain torch's own grid_sample frame by frame."""
    space = [nn.Parameter(torch.rand(3, 64 * m, 64 * m, 32)) for m in (1, 2)]
    time_planes = [nn.Parameter(torch.ones(3, 64 * m, 25, 32)) for m in (1, 2)]
    trunk = nn.Sequential(nn.Linear(64, 64), nn.ReLU(), nn.Linear(64, 10))
    coords = torch.rand(OBJECTS * PER_OBJECT, 3) * 2 - 1
    times = torch.linspace(-1, 1, moments)

    def ours() -> None:
        levels = [
            plane_sampling.sample_planes(s, coords)[None] * plane_sampling.sample_time_planes(t, coords, times)
            for s, t in zip(space, time_planes, strict=True)
        ]
        trunk(torch.cat(levels, dim=-1)).sum().backward()

    def plain() -> None:
        for moment in times:
            levels = [
                _grid(s, coords, moment) * _time_grid(t, coords, moment)
                for s, t in zip(space, time_planes, strict=True)
            ]
            trunk(torch.cat(levels, dim=-1)).sum().backward()

    return ours, plain


def _read(plane: Tensor, across: Tensor, down: Tensor) -> Tensor:
    """(rows, columns, C) at (N,) coordinates by grid_sample: (N, C)."""
    grid = torch.stack([across, down], dim=-1)[None, None]
    picture = plane.permute(2, 0, 1)[None]
    return nn.functional.grid_sample(picture, grid, align_corners=True, padding_mode="border")[0, :, 0].T


def _grid(planes: Tensor, coords: Tensor, _: Tensor) -> Tensor:
    """Product over the three space planes."""
    a, b, c = (_read(p, coords[:, i], coords[:, j]) for p, (i, j) in zip(planes, plane_sampling.PAIRS, strict=True))
    return a * b * c


def _time_grid(planes: Tensor, coords: Tensor, moment: Tensor) -> Tensor:
    """Product over the three space-time planes."""
    a, b, c = (_read(planes[i], moment.expand(len(coords)), coords[:, i]) for i in range(3))
    return a * b * c


def rigidity_pair() -> tuple[Callable[[], None], Callable[[], None]]:
    """Rigidity and rotation of every object between the two times of every frame, on the rows a step samples."""
    generator = torch.Generator().manual_seed(1)
    points = torch.rand(PER_OBJECT, 3, generator=generator)
    near = nearest(points, NEIGHBOURS)
    means = nn.Parameter(points + 0.01 * torch.randn(2 * FRAMES, PER_OBJECT, 3, generator=generator))
    quats = nn.Parameter(torch.nn.functional.normalize(torch.rand(2 * FRAMES, PER_OBJECT, 4), dim=-1))

    def work() -> None:
        states = [ObjectState(m, q, m, q, m, m, None) for m, q in zip(means, quats, strict=True)]
        for _ in range(OBJECTS):
            rows = torch.randperm(PER_OBJECT, generator=generator)[:SAMPLED_ROWS]
            terms = [rigidity(a, b, near, rows) for a, b in zip(states[::2], states[1::2], strict=True)]
            torch.stack([value for pair in terms for value in pair]).sum().backward(retain_graph=True)

    return work, work


def colours(similarity: Callable) -> None:
    """L1 and SSIM of eight frames."""
    prediction = torch.rand(FRAMES, SIDE, SIDE, 3, requires_grad=True)
    target = torch.rand(FRAMES, SIDE, SIDE, 3)
    loss = (prediction - target).abs().mean() + (1 - similarity(prediction, target)).mean()
    loss.backward()


def losses_pair() -> tuple[Callable[[], None], Callable[[], None]]:
    """The data terms of eight frames (colour, coverage, labels, depth, flow): fused kernels, and plain torch."""
    generator = torch.Generator().manual_seed(2)
    bands = torch.arange(SIDE) * 8 // SIDE
    labels = torch.where(bands <= OBJECTS, bands, 0).expand(SIDE, SIDE).contiguous()
    shown = torch.nn.functional.one_hot(labels, OBJECTS + 1)[..., 1:] * 0.9
    seen, flow = torch.ones(SIDE, SIDE), torch.randn(SIDE, SIDE, 2, generator=generator)
    colors = torch.rand(2, SIDE, SIDE, 3, generator=generator)
    target = FrameTargets(colors[0], labels, seen, seen < 0, 2 + seen, seen, flow, seen, True)
    layout, wanted = Layout(OBJECTS, flow=True), Wanted(background=True, labels=True, depth=True)
    features = torch.cat([colors[1], shown, flow + 1], dim=-1).permute(2, 0, 1).contiguous()
    leaves = [features.requires_grad_(), (2 * seen).requires_grad_(), (0.9 * seen).requires_grad_()]

    def work(terms: Callable) -> None:
        for _ in range(FRAMES):
            picture = Rendering(leaves[0].permute(1, 2, 0), *leaves[1:])
            torch.stack(list(terms(picture, layout, target, wanted).values())).sum().backward()

    return lambda: work(data_terms), lambda: work(data_terms_torch)


def adamw(*, fused: bool) -> None:
    """One AdamW step over 2.45 million numbers."""
    if fused not in _OPTIMISERS:
        parameters = [nn.Parameter(torch.rand(2_450_000 // 10)) for _ in range(10)]
        for parameter in parameters:
            parameter.grad = torch.rand_like(parameter)
        _OPTIMISERS[fused] = torch.optim.AdamW(parameters, lr=1e-3, fused=fused)
        _OPTIMISERS[fused].step()
    _OPTIMISERS[fused].step()


_OPTIMISERS: dict[bool, torch.optim.AdamW] = {}


if __name__ == "__main__":
    main()
