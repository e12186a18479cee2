"""The fused SSIM equals convolutions in float64, map and gradient, at any size; masked windows say nothing."""

from __future__ import annotations

import pytest
import torch
from torch.nn.functional import conv2d, pad

from genmojo_core.kernels import threads
from genmojo_core.render.ssim import ssim_map, ssim_map_torch, whole_windows


def _pictures(size: tuple[int, int], batch: int = 2) -> tuple[torch.Tensor, torch.Tensor]:
    generator = torch.Generator().manual_seed(size[0] * 1000 + size[1])
    target = torch.rand(batch, *size, 3, generator=generator)
    return (target + 0.2 * torch.randn(target.shape, generator=generator)).clamp(0, 1), target


def test_plain_torch_is_the_textbook_formula_with_a_two_dimensional_window() -> None:
    x, y = (p.double().permute(0, 3, 1, 2) for p in _pictures((23, 31)))
    line = torch.exp(-0.5 * (torch.arange(-5, 6, dtype=torch.float64) / 1.5) ** 2)
    window = (torch.outer(line, line) / line.sum() ** 2).expand(3, 1, 11, 11)

    def average(p: torch.Tensor) -> torch.Tensor:
        return conv2d(pad(p, (5, 5, 5, 5), mode="reflect"), window, groups=3)

    mx, my = average(x), average(y)
    sx, sy, sxy = average(x * x) - mx**2, average(y * y) - my**2, average(x * y) - mx * my
    textbook = (2 * mx * my + 1e-4) * (2 * sxy + 9e-4) / ((mx**2 + my**2 + 1e-4) * (sx + sy + 9e-4))
    ours = ssim_map_torch(x.permute(0, 2, 3, 1), y.permute(0, 2, 3, 1)).permute(0, 3, 1, 2)
    torch.testing.assert_close(ours, textbook, rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("size", [(1, 1), (1, 9), (5, 5), (6, 2), (11, 11), (17, 31), (32, 64), (40, 23)])
def test_kernels_equal_float64_at_any_size(size: tuple[int, int]) -> None:
    x, y = _pictures(size)
    weight = torch.randn(x.shape, generator=torch.Generator().manual_seed(1))
    ours, oracle = x.clone().requires_grad_(), x.double().requires_grad_()
    out, expected = ssim_map(ours, y), ssim_map_torch(oracle, y.double())
    torch.testing.assert_close(out.double(), expected, rtol=0, atol=2e-4)
    (out * weight).sum().backward()
    (expected * weight.double()).sum().backward()
    error = (ours.grad.double() - oracle.grad).norm() / oracle.grad.norm().clamp(min=1e-3)
    assert error < 2e-4


def test_equal_pictures_give_one_and_no_gradient() -> None:
    _, y = _pictures((20, 30))
    x = y.clone().requires_grad_()
    out = ssim_map(x, y)
    out.sum().backward()
    assert (out - 1).abs().max() < 1e-4
    assert x.grad.abs().max() < 1e-2


def test_masked_pixels_change_nothing() -> None:
    x, y = _pictures((40, 40))
    mask = torch.ones(2, 40, 40, dtype=torch.bool)
    mask[0, 5:15, 5:12] = False
    wild = x.clone()
    wild[~mask] = 7.0
    results = []
    for picture in (x, wild):
        p = picture.clone().requires_grad_()
        out = ssim_map(p, y, mask)
        (1 - out).sum().backward()
        results.append((out.detach(), p.grad))
    torch.testing.assert_close(results[0][0], results[1][0])
    torch.testing.assert_close(results[0][1], results[1][1])
    assert (results[1][1][~mask] == 0).all()
    whole = whole_windows(mask)
    assert not whole[0, 19, 16]
    assert whole[0, 20, 17]
    assert whole[0, 0, 39]


def test_same_bits_for_any_number_of_threads() -> None:
    x, y = _pictures((45, 70), batch=3)
    results = []
    try:
        for count in (1, 2, 4):
            threads.set_threads(count)
            p = x.clone().requires_grad_()
            out = ssim_map(p, y)
            out.square().sum().backward()
            results.append((out.detach(), p.grad))
    finally:
        threads.set_threads(0)
    assert all(torch.equal(a, b) for other in results[1:] for a, b in zip(results[0], other, strict=True))
