"""Every function of scene/safemath.py at its edges: value and gradient (RELIABILITY.md N01 to N03, N11, N14, N30)."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial

import torch
from torch import Tensor

from genmojo_core.hard_cases.case import Case, hold
from genmojo_core.scene import safemath

DENORMAL = 1e-40
NUMBERS = (0.0, DENORMAL, -DENORMAL, 1e-20, 1e-8, 1e-4, 0.5, 1.0, -1.0, 16.7, 89.0, 1e4, 1e18, -1e18)
TURNS = (0.0, DENORMAL, 1e-9, 1e-4, 1.0, math.pi, 2 * math.pi)


def edges(call: Callable[[Tensor], Tensor], numbers: tuple[float, ...], largest: float) -> str:
    """Value and gradient at every number alone are finite, the gradient at most `largest`."""
    for number in numbers:
        leaf = torch.tensor([number], requires_grad=True)
        value = call(leaf)
        value.sum().backward()
        hold(bool(torch.isfinite(value).all()), f"the value at {number:g} is {value.tolist()}")
        hold(bool(torch.isfinite(leaf.grad).all()), f"the gradient at {number:g} is not finite")
        steepest = float(leaf.grad.abs().max())
        hold(steepest <= largest, f"the gradient at {number:g} is {steepest:g}, at most {largest:g} is bearable")
    return f"finite at {len(numbers)} edges, gradients at most {largest:g}"


def slopes(call: Callable[[Tensor], Tensor], numbers: tuple[float, ...]) -> str:
    """Gradients agree with differences in float64 on either side of every branch."""
    for number in numbers:
        leaf = torch.tensor([number], dtype=torch.float64, requires_grad=True)
        hold(torch.autograd.gradcheck(call, (leaf,), atol=1e-6, raise_exception=False), f"wrong slope at {number:g}")
    return f"exact at {len(numbers)} places"


def _of(name: str) -> Callable[[Tensor], Tensor]:
    """A function of safemath, looked up when it is called."""
    return lambda x: getattr(safemath, name)(x)


def _along(x: Tensor) -> Tensor:
    """A rotation vector of this length."""
    return safemath.rotation_vector_to_quaternion(x * torch.tensor([0.36, -0.48, 0.8], dtype=x.dtype))


def _quat(x: Tensor) -> Tensor:
    """A quaternion of this length, made a unit one; times its length, so that the gradient's bound is 1."""
    return safemath.normalise(x * torch.tensor([0.1, 0.7, -0.5, 0.5], dtype=x.dtype))


def _vector(x: Tensor) -> Tensor:
    return safemath.safe_norm(x * torch.tensor([0.6, 0.0, 0.8], dtype=x.dtype))


def _reciprocal(x: Tensor) -> Tensor:
    return safemath.safe_divide(torch.ones_like(x), x, 1e-4)


def _projected(x: Tensor) -> Tensor:
    """A point at this depth, before a camera with the near plane at 0.01."""
    point = torch.cat([torch.ones(2, dtype=x.dtype), x])
    return safemath.project(point[None], torch.eye(4, dtype=x.dtype), torch.eye(3, dtype=x.dtype), 0.01)[0]


SMALL = tuple(n for n in NUMBERS if abs(n) < 1e10)
CASES = (
    Case("N01", "division by nothing", partial(edges, _reciprocal, NUMBERS, 1e8)),
    Case("N01", "projection through the camera", partial(edges, _projected, SMALL, 1e5)),
    Case("N02", "quaternions of any length", partial(edges, _quat, NUMBERS, 1.0)),
    Case("N03", "exponentials of scales", partial(edges, _of("exp_scale"), NUMBERS, math.exp(20.1))),
    Case("N11", "logits of 0 and 1", partial(edges, _of("logit"), (0.0, DENORMAL, 1e-20, 0.5, 1 - 6e-8, 1.0), 2e5)),
    Case("N14", "logarithm of nothing", partial(edges, _of("safe_log"), (0.0, DENORMAL, 1e-20, 1e-4, 1.0), 1.01e4)),
    Case("N30", "roots of nothing", partial(edges, _of("safe_sqrt"), (0.0, DENORMAL, -1.0, 1e-20, 1e-12, 1.0), 1e6)),
    Case("N30", "length of no vector", partial(edges, _vector, SMALL, 1.01)),
    Case("N30", "rotation by nothing", partial(edges, _along, TURNS, 1.01)),
    Case("N30", "slopes of rotations", partial(slopes, _along, TURNS)),
    Case("N14", "slopes of the logarithm", partial(slopes, _of("safe_log"), (1e-6, 5e-5, 2e-4, 1.0))),
)
