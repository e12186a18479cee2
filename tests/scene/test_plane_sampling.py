"""K-plane reads equal torch's own grid_sample, kernels and plain torch alike, and do not depend on threads."""

from __future__ import annotations

import pytest
import torch
from torch.nn.functional import grid_sample

from genmojo_core.kernels import threads
from genmojo_core.scene.plane_sampling import (
    PAIRS,
    sample_planes,
    sample_planes_torch,
    sample_time_planes,
    sample_time_planes_torch,
)  # fmt: skip


def _read(plane: torch.Tensor, across: torch.Tensor, down: torch.Tensor) -> torch.Tensor:
    """(rows, columns, C) plane at (P,) coordinates by grid_sample: (P, C)."""
    grid = torch.stack([across, down], dim=-1)[None, None].to(plane.dtype)
    picture = plane.permute(2, 0, 1)[None]
    return grid_sample(picture, grid, align_corners=True, padding_mode="border")[0, :, 0].T


def _oracle_space(planes: torch.Tensor, coords: torch.Tensor) -> torch.Tensor:
    a, b, c = (_read(plane, coords[:, i], coords[:, j]) for plane, (i, j) in zip(planes, PAIRS, strict=True))
    return a * b * c


def _oracle_time(planes: torch.Tensor, coords: torch.Tensor, times: torch.Tensor) -> torch.Tensor:
    rows = []
    for time in times:
        a, b, c = (_read(planes[i], time.expand(len(coords)), coords[:, i]) for i in range(3))
        rows.append(a * b * c)
    return torch.stack(rows)


def _scene(channels: int, nodes: int, points: int) -> tuple[torch.Tensor, torch.Tensor, torch.Tensor]:
    generator = torch.Generator().manual_seed(3)
    space = torch.rand(3, nodes, nodes, channels, generator=generator) + 0.1
    time = torch.rand(3, nodes, 7, channels, generator=generator) + 0.5
    coords = torch.rand(points, 3, generator=generator) * 2.6 - 1.3  # some outside the box
    coords[0], coords[1] = 1.0, -1.0
    return space, time, coords


@pytest.mark.parametrize(("channels", "nodes"), [(16, 12), (8, 2), (32, 5), (5, 9)])
@pytest.mark.parametrize("read", [sample_planes, sample_planes_torch])
def test_space_planes_and_gradient_equal_grid_sample(read, channels, nodes) -> None:
    space, _, coords = _scene(channels, nodes, 300)
    weight = torch.randn(300, channels, generator=torch.Generator().manual_seed(4))
    ours, oracle = space.clone().requires_grad_(), space.double().requires_grad_()
    out, expected = read(ours, coords), _oracle_space(oracle, coords.double())
    torch.testing.assert_close(out.double(), expected, rtol=2e-5, atol=2e-6)
    (out * weight).sum().backward()
    (expected * weight.double()).sum().backward()
    torch.testing.assert_close(ours.grad.double(), oracle.grad, rtol=1e-4, atol=2e-5)


@pytest.mark.parametrize(("channels", "nodes"), [(16, 12), (5, 9)])
@pytest.mark.parametrize("read", [sample_time_planes, sample_time_planes_torch])
def test_time_planes_and_gradient_equal_grid_sample(read, channels, nodes) -> None:
    _, time, coords = _scene(channels, nodes, 200)
    times = torch.tensor([-1.0, -0.3, 0.25, 1.0, 1.5])
    weight = torch.randn(5, 200, channels, generator=torch.Generator().manual_seed(5))
    ours, oracle = time.clone().requires_grad_(), time.double().requires_grad_()
    out, expected = read(ours, coords, times), _oracle_time(oracle, coords.double(), times.double())
    torch.testing.assert_close(out.double(), expected, rtol=2e-5, atol=2e-6)
    (out * weight).sum().backward()
    (expected * weight.double()).sum().backward()
    torch.testing.assert_close(ours.grad.double(), oracle.grad, rtol=1e-4, atol=2e-5)


@pytest.mark.parametrize("read", [sample_planes, sample_planes_torch])
def test_one_node_or_nan_coordinate_or_no_point_stays_finite(read) -> None:
    planes = torch.full((3, 1, 1, 8), 2.0, requires_grad=True)
    coords = torch.tensor([[float("nan"), 0.0, 1.0], [0.2, -5.0, 5.0]])
    out = read(planes, coords)
    assert torch.equal(out, torch.full((2, 8), 8.0))
    assert read(planes, coords[:0]).shape == (0, 8)
    single = torch.ones(3, 4, 1, 8)
    assert torch.equal(sample_time_planes(single, coords, torch.zeros(1)), torch.ones(1, 2, 8))


def test_same_bits_for_any_number_of_threads() -> None:
    space, time, coords = _scene(16, 12, 5000)
    times = torch.linspace(-1, 1, 5)
    results = []
    try:
        for count in (1, 2, 4, 2):
            threads.set_threads(count)
            s, t = space.clone().requires_grad_(), time.clone().requires_grad_()
            out = sample_planes(s, coords)[None] * sample_time_planes(t, coords, times)
            (out**2).sum().backward()
            results.append((out.detach(), s.grad, t.grad))
    finally:
        threads.set_threads(0)
    for other in results[1:]:
        assert all(torch.equal(a, b) for a, b in zip(results[0], other, strict=True))
