"""From judgements to gradients: one family of scalar weights, exact in float64, quiet in hard cases."""

import math

import pytest
import torch

from genmojo_core.errors import GenmojoError
from genmojo_core.priors.prior import Judgement, ViewOffsets
from genmojo_core.priors.sds import distil


class Toy:
    """A prior in float64 whose denoiser is linear: clean = a noisy + b."""

    resolution, channels, kind, scope = 4, "rgba", "embedded", "object"

    def __init__(self, sigma=0.7, a=0.4, b=0.1, mean=0.3, broken=False):
        self.sigma, self.a, self.b, self.mean, self.broken = sigma, a, b, mean, broken

    def embed(self, renders):
        return torch.nn.functional.interpolate(renders, (4, 4), mode="area")

    def judge(self, x, condition, views, level, generator):
        noise = torch.randn(x.shape, generator=generator, dtype=x.dtype)
        clean = self.a * (x + self.sigma * noise) + self.b
        if self.broken:
            clean[:, 0] = math.nan
        weight = torch.full((len(x),), self.sigma / (1 + self.sigma**2), dtype=x.dtype)
        mean = None if self.mean is None else torch.full_like(x, self.mean)
        return Judgement(clean, weight, mean, torch.ones_like(x[:, :1]))


VIEWS = ViewOffsets(torch.zeros(2), torch.full((2,), 90.0), torch.zeros(2))


def renders():
    return torch.rand(2, 4, 8, 8, generator=torch.Generator().manual_seed(1), dtype=torch.float64)


def told(prior, pictures, mode):
    return distil(prior, pictures, None, VIEWS, 0.5, mode, torch.Generator().manual_seed(2))


@pytest.mark.parametrize("mode", ["sds", "x0", "pseudo"])
def test_autograd_of_the_loss_is_the_gradient(mode):
    x = renders().requires_grad_(True)
    said = told(Toy(), x, mode)
    said.loss.backward()
    through_resampling = said.gradient.repeat_interleave(2, 2).repeat_interleave(2, 3) / 4  # area: mean of 2 x 2
    torch.testing.assert_close(x.grad, through_resampling, rtol=1e-12, atol=1e-15)


def test_score_distillation_is_a_scalar_times_reconstruction():
    """w (noise predicted - noise) with w = s^2 / (1 + s^2) equals s / (1 + s^2) (x - D): PRIOR.md section 1."""
    toy, x = Toy(), renders()
    small = toy.embed(x)
    noise = torch.randn(small.shape, generator=torch.Generator().manual_seed(2), dtype=torch.float64)
    noisy = small + toy.sigma * noise
    predicted = (noisy - (toy.a * noisy + toy.b)) / toy.sigma
    w = toy.sigma**2 / (1 + toy.sigma**2)
    expected = w * (predicted - noise)
    torch.testing.assert_close(told(toy, x, "sds").gradient, expected, rtol=1e-10, atol=1e-12)
    scalar = toy.sigma / (1 + toy.sigma**2)
    torch.testing.assert_close(told(toy, x, "x0").gradient * scalar, expected, rtol=1e-10, atol=1e-12)


def test_pseudo_views_pull_to_the_mean_whatever_the_noise():
    torch.testing.assert_close(told(Toy(sigma=9.0), renders(), "pseudo").gradient, Toy().embed(renders()) - 0.3)


def test_what_is_not_finite_does_not_count():
    x = renders().requires_grad_(True)
    said = told(Toy(broken=True), x, "sds")
    said.loss.backward()
    assert torch.isfinite(x.grad).all() and not x.grad[:, 0].any() and x.grad[:, 1:].abs().max() > 0


def test_pseudo_views_of_a_prior_without_mean_views_are_refused():
    with pytest.raises(GenmojoError, match="mean views"):
        told(Toy(mean=None), renders(), "pseudo")
