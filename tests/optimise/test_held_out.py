"""What is held out stays out: of losses, gradients, motion. And the clock that stands still while it is scored."""

import json
from dataclasses import replace

import numpy as np
import pytest
import torch

from genmojo_core.effects.decide import plan
from genmojo_core.events import Step
from genmojo_core.optimise.held_out import held_frames, without
from genmojo_core.optimise.progress import Clock
from genmojo_core.optimise.run import Run
from genmojo_core.optimise.schedule import Pace, Stage
from tests.optimise.small_runs import small_clip, small_config, small_run


@pytest.fixture(scope="module")
def clip():
    return small_clip(frames=6)


def loss_and_gradients(run, frames):
    generator = torch.Generator().manual_seed(0)
    run.scene.zero_grad(set_to_none=True)
    outcome = run.objective.evaluate(frames, True, generator)
    outcome.loss.backward()
    return outcome, {n: p.grad.clone() for n, p in run.scene.named_parameters() if p.grad is not None}


def test_pixels_held_out_change_no_loss_and_no_gradient_but_are_scored(clip):
    run = small_run(clip, held_out_share=0.2)
    list(run)
    before, gradients = loss_and_gradients(run, [1, 2])
    for t in (1, 2):
        target = run.targets.frame(t)
        assert target.held_out.any()
        target.rgb[target.held_out] = 1.0 - target.rgb[target.held_out]
    run.objective.hold()  # windows of the targets are cut anew
    after, changed = loss_and_gradients(run, [1, 2])
    assert before.parts == after.parts and "ssim" in before.parts
    assert gradients.keys() == changed.keys() and all(torch.equal(gradients[n], changed[n]) for n in gradients)
    assert all(a.squared != b.squared and a.similar != b.similar
               for a, b in zip(before.held_out, after.held_out, strict=True))  # fmt: skip


def test_frames_held_out_change_nothing_but_their_own_score(clip):
    changed = replace(clip, frames=clip.frames.copy())
    assert held_frames(6, 3) == (1, 4) and held_frames(6, 0) == () and held_frames(2, 2) == ()
    changed.frames[[1, 4]] = 255 - changed.frames[[1, 4]]
    config = small_config(held_out_every=3)
    effects = plan(clip, config)
    runs = [Run(c, effects, config) for c in (clip, changed)]
    losses = [[e.loss for e in run if isinstance(e, Step)] for run in runs]
    assert losses[0] == losses[1]
    first, second = (run.progress.curve[-1] for run in runs)
    assert first["psnr_held_out"] == second["psnr_held_out"]
    assert first["psnr_held_frames"] > 10 > second["psnr_held_frames"]


def test_a_clip_without_frames_says_nothing_about_them(clip):
    seen = without(clip, (1, 4))
    assert not seen.masks.valid[[1, 4]].any() and not seen.depth.valid[[1, 4]].any()
    assert not seen.flow.valid[[0, 1, 3, 4]].any() and np.array_equal(seen.flow.valid[2], clip.flow.valid[2])
    assert np.array_equal(seen.frames[2], clip.frames[2]) and clip.masks.valid[1].any()


def test_the_curve_is_written_line_by_line(clip, tmp_path):
    run = small_run(clip, run_dir=tmp_path)
    list(run)
    rows = [json.loads(line) for line in (tmp_path / "curve.jsonl").read_text().splitlines()]
    assert rows == json.loads(json.dumps(run.progress.curve)) and len(rows) >= 1
    assert {"seconds", "cpu_seconds", "step", "psnr_held_out", "ssim_held_out"} <= set(rows[-1])
    assert run.bake().curve == run.progress.curve


def test_a_held_clock_stands_still():
    clock = Clock()
    clock.hold()
    first = clock.now()
    sum(range(200_000))
    assert clock.now() == first and clock.this_run() == first[0]
    clock.go_on()
    assert clock.now()[0] < first[0] + 1.0 and clock.now() != first


def test_pace_gives_a_stage_the_steps_its_time_allows():
    pace = Pace("joint", 4, now=10.0, end=110.0)
    stage = Stage("joint", 7, True)
    assert pace.refit(stage, 4, 10.0).steps == 7
    assert pace.refit(stage, 14, 20.0).steps == 104  # ten steps took ten seconds, ninety are left
    assert pace.refit(stage, 24, 120.0).steps == 24


def test_a_paced_run_ends_its_schedule_with_its_time(clip):
    list(small_run(clip))  # kernels are compiled
    told = small_run(clip, paced=True, clock="cpu", budget_seconds=6.0, joint_steps=5)
    events = [event for event in told if isinstance(event, Step)]
    assert events[-1].stage == "joint" and events[-1].steps > 5
    assert events[-1].step >= 0.9 * events[-1].steps  # rates and frames went through their whole course
