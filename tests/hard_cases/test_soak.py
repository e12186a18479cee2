"""A long run on a hostile clip: no drift of parameters or accuracy, no growth of memory (issue 7).

`STEPS` steps; the environment's SOAK_STEPS takes another number for a shorter try.
"""

from __future__ import annotations

import gc
import os

import numpy as np
import pytest
import torch

from genmojo_core.events import Finished, Preview, Step
from genmojo_core.hard_cases import clips
from genmojo_core.hard_cases.runs import REACH, memory_mb, started

STEPS = int(os.environ.get("SOAK_STEPS", "20000"))


@pytest.mark.slow
@pytest.mark.timeout(7200)
def test_n27_a_long_run_on_a_hostile_clip_neither_drifts_nor_grows() -> None:
    """An object that vanishes and returns, noise for depth in places; a Gaussian is lost every 500 steps."""
    clip = clips.without(clips.plain(6, (36, 24)), 0, slice(2, 4))
    holes = np.random.default_rng(0).random(clip.frames.shape[:3]) < 0.8
    run = started(clips.partly_deep(clip, holes, -1.0), lift_steps=10, joint_steps=STEPS, densify_every=200,
                  gaussians_per_object=80, background_gaussians=100, frames_per_step=1)  # fmt: skip
    psnr, memory, objects, reach = [], [], [], []
    threads = torch.get_num_threads()
    for event in run:
        if isinstance(event, Preview):
            psnr.append(event.psnr)
        if not isinstance(event, Step):
            continue
        if event.step % 500 == 250:
            with torch.no_grad():
                run.scene.objects[1].gaussians.means[0] = float("nan")
        if event.step % max(STEPS // 40, 1) == 0:
            gc.collect()
            memory.append(memory_mb())
            objects.append(len(gc.get_objects()))
            reach.append(max(float(m.gaussians.means.detach().abs().max()) for m in run.scene.objects))
    assert isinstance(event, Finished)
    assert torch.get_num_threads() == threads
    half, middle = len(memory) // 2, len(psnr) // 2
    figures = (
        f"dB {np.mean(psnr[:middle]):.2f} -> {np.mean(psnr[middle:]):.2f}, MiB {memory[half]:.0f} -> {memory[-1]:.0f}, "
        f"objects {objects[half]} -> {objects[-1]}, reach {max(reach):.2f}"
    )
    print(figures)
    assert np.mean(psnr[middle:]) > np.mean(psnr[:middle]) - 0.5, figures
    assert memory[-1] - memory[half] < 8, figures
    assert objects[-1] < 1.02 * objects[half] + 500, figures
    assert max(reach) < REACH, figures
