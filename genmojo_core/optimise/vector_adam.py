"""AdamW in which positions move along their gradient: one step size for the three coordinates of a point.

Adam makes steps of a coordinate as long as the rate, however small its gradient is. What pictures hardly tell of a
point is its depth: with a step size of its own it walks along its ray at random, and bodies scatter as seen from the
side. Here the second moment is of the gradient's length, as in VectorAdam (Ling, Sharp, Jacobson, 2022), so that steps
do not depend on how the axes lie either.
"""

from __future__ import annotations

from typing import Any

import torch
from torch import Tensor

from genmojo_core.optimise.adamw import AdamW


class VectorAdamW(AdamW):
    """AdamW whose groups with `vectors` set hold parameters (..., 3), each row a vector."""

    @torch.no_grad()
    def step(self, closure: Any = None) -> Any:
        """One step of every parameter with a gradient; gradients stay."""
        apart: list[tuple[Tensor, Tensor]] = []
        for group in self.param_groups:
            for parameter in group["params"] if group.get("vectors") else ():
                if parameter.grad is not None:
                    self._step_vectors(parameter, group)
                    apart.append((parameter, parameter.grad))
                    parameter.grad = None
        result = super().step(closure)
        for parameter, gradient in apart:
            parameter.grad = gradient
        return result

    def _step_vectors(self, parameter: Tensor, group: dict[str, Any]) -> None:
        """AdamW's step and state, with the mean square of a row's coordinates for each of them."""
        state, gradient = self.state[parameter], parameter.grad
        if gradient is None:
            return
        if not state:
            state["step"] = torch.zeros((), dtype=torch.float32)
            state["exp_avg"], state["exp_avg_sq"] = torch.zeros_like(parameter), torch.zeros_like(parameter)
        first, second = group["betas"]
        state["step"] += 1
        count = float(state["step"])
        state["exp_avg"].lerp_(gradient, 1.0 - first)
        state["exp_avg_sq"].lerp_((gradient * gradient).mean(dim=-1, keepdim=True).expand_as(gradient), 1.0 - second)
        size = (state["exp_avg_sq"] / (1.0 - second**count)).sqrt_().add_(group["eps"])
        parameter.mul_(1.0 - group["lr"] * group["weight_decay"])
        parameter.addcdiv_(state["exp_avg"], size, value=-group["lr"] / (1.0 - first**count))
