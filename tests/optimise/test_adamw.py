"""Our AdamW is torch's to the last bit, and leaves torch's compiler alone."""

import copy
import subprocess
import sys

import pytest
import torch

from genmojo_core.optimise.adamw import AdamW


@pytest.mark.parametrize("fused", [True, False])
def test_steps_are_those_of_torch(fused):
    start = [torch.randn(7, 3, generator=torch.Generator().manual_seed(k)) for k in range(2)]
    made = []
    for kind in (AdamW, torch.optim.AdamW):
        parameters = [torch.nn.Parameter(p.clone()) for p in start]
        groups = [{"params": [parameters[0]], "lr": 0.1}, {"params": [parameters[1]], "lr": 0.01, "weight_decay": 0.3}]
        optimiser = kind(groups, betas=(0.9, 0.99), eps=1e-15, weight_decay=0.0, fused=fused)
        for step in range(5):
            optimiser.zero_grad(set_to_none=True)
            (parameters[0].square().sum() + (parameters[1] ** 3).sum() * (step + 1)).backward()
            optimiser.step()
            if step == 2:  # as a checkpoint does
                optimiser.load_state_dict(copy.deepcopy(optimiser.state_dict()))
        assert parameters[0].requires_grad and torch.is_grad_enabled()
        made.append(parameters)
    for ours, theirs in zip(*made, strict=True):
        assert torch.equal(ours, theirs)


def test_the_compiler_is_not_imported():
    code = (
        "import sys, torch; from genmojo_core.optimise.adamw import AdamW\n"
        "p = torch.nn.Parameter(torch.ones(3)); o = AdamW([p], fused=True)\n"
        "o.zero_grad(); p.sum().backward(); o.step()\n"
        "o.load_state_dict(o.state_dict()); sys.exit('torch._dynamo' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code]).returncode == 0
