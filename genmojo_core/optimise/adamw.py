"""torch's AdamW without torch's compiler: nothing here is compiled, and importing it takes 1.5 CPU s of every run."""

from __future__ import annotations

import inspect
from typing import Any

import torch
from torch.optim.optimizer import Optimizer

_STEP = inspect.unwrap(torch.optim.Adam.step)  # AdamW's too; what wraps it only breaks graphs of the compiler
for _name in ("add_param_group", "zero_grad", "state_dict", "load_state_dict"):
    _inner = inspect.unwrap(getattr(Optimizer, _name))
    if _inner is not getattr(Optimizer, _name):
        _inner.__dict__.setdefault("__dynamo_disable", _inner)  # what torch keeps once the compiler has let it alone


class AdamW(torch.optim.AdamW):
    """As torch.optim.AdamW, number for number."""

    @torch.no_grad()
    def step(self, closure: Any = None) -> Any:
        """One step from the gradients as they are; `closure` as in torch.optim.AdamW."""
        return _STEP(self, closure)
