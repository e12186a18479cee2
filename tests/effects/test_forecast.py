"""The forecast: exact on runs of known costs, recovered by its fit, kept per machine; torch stays out of it."""

import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

from genmojo_core.config import preset
from genmojo_core.effects import forecast, machine
from genmojo_core.effects.difficulty import Difficulty, difficulty
from genmojo_core.effects.forecast import Model, cpu_seconds, foretold, step_features, work_of
from genmojo_core.effects.machine import Machine
from genmojo_core.optimise import calibrate
from tests.benchmarks.forecast import decibel_law, non_negative
from tests.optimise.small_runs import small_clip

MODEL = Model((10.0, 1.0, 2.0, 40.0, 0.0, 3.0), (0.0, 1.0, 0.0, 0.0), (20.0, 0.0, 1.0, 0.0, 0.0), 0.5, 0.1)
CLIP = Difficulty(30.0, 30.0, 20.0, 0.1, 2.0)
ON = ["background", "instance_labels", "flow", "non_rigid_motion"]


def made(config):
    return work_of((200, 100), 24, 2, ON, config)


def test_a_run_takes_its_motion_and_its_steps():
    config = preset("draft", lift_steps=10, joint_steps=100, budget_seconds=1e6)
    work = made(config)
    lift, joint = (float(step_features(work, deform) @ np.array(MODEL.step)) / 1000 for deform in (False, True))
    told = foretold(work, CLIP, config, 1.0, MODEL)
    assert told.seconds == pytest.approx(24.0 + 10 * lift + 100 * joint) and told.steps == 110
    assert told.decibel == pytest.approx(
        20.0 + np.log((0.3 * 10 + 100) * 2 / 24)
    ) and told.seconds_error == pytest.approx(0.1 * told.seconds)
    assert foretold(work, CLIP, config, 3.0, MODEL).seconds == pytest.approx(3 * told.seconds)
    assert joint > lift  # objects that bend cost more once they do


def test_a_budget_cuts_steps_and_a_paced_run_fills_it():
    free = preset("draft", budget_seconds=1e6)
    cut = foretold(made(free), CLIP, replace(free, budget_seconds=20.0), 1.0, MODEL)
    assert cut.seconds == pytest.approx(20.0) and cut.steps < free.lift_steps + free.joint_steps
    paced = foretold(made(free), CLIP, replace(free, budget_seconds=30.0, paced=True), 1.0, MODEL)
    assert paced.seconds == 30.0 and paced.steps > 10 and paced.seconds_error == 0.0
    longer = foretold(made(free), CLIP, replace(free, budget_seconds=60.0, paced=True), 1.0, MODEL)
    assert longer.steps > paced.steps and longer.decibel > paced.decibel


def test_what_is_off_costs_nothing():
    config = preset("draft")
    full = step_features(made(config))
    bare = step_features(work_of((200, 100), 24, 2, [], config))
    assert (bare <= full).all() and bare[2] == 0 and bare[3] == 0


def test_objects_that_stay_rigid_do_not_bend_for_time():
    config = preset("draft")
    both, one = made(config), work_of((200, 100), 24, 2, ON, config, rigid=1)
    assert 0 < step_features(one)[2] == pytest.approx(0.5 * step_features(both)[2])
    assert foretold(one, CLIP, config, 1.0, MODEL).seconds < foretold(both, CLIP, config, 1.0, MODEL).seconds


def test_a_step_that_looks_at_almost_nothing_still_takes_its_time():
    config = preset("draft", lift_steps=0, joint_steps=100, budget_seconds=1e6)
    told = foretold(work_of((200, 100), 24, 1, ["background"], config, 1e-6), CLIP, config, 1.0, MODEL)
    assert told.seconds >= 24.0 + 100 * MODEL.step[-1] / 1000


def test_a_background_that_stands_still_is_fitted_once_and_steps_look_at_a_window():
    config = preset("draft", lift_steps=10, joint_steps=100, budget_seconds=1e6)
    still = work_of((200, 100), 24, 2, ON, config, 0.25)
    cost, whole = cpu_seconds(still, config, MODEL), cpu_seconds(made(config), config, MODEL)
    assert cost["joint"] < whole["joint"] and cost["settle"] > whole["settle"] == 0.0
    told = foretold(still, CLIP, config, 1.0, MODEL)
    assert told.seconds == pytest.approx(24.0 + cost["settle"] + 10 * cost["lift"] + 100 * cost["joint"])
    moving = work_of((200, 100), 24, 2, [*ON, "camera_motion"], config, 0.25)
    assert cpu_seconds(moving, config, MODEL) == whole


def test_the_fit_finds_the_costs_that_made_the_rows():
    rng = np.random.default_rng(0)
    features, truth = rng.random((40, 5)) + 0.1, np.array([3.0, 0.0, 2.0, 7.0, 1.0])
    assert non_negative(features, features @ truth) == pytest.approx(truth, abs=1e-3)
    assert (non_negative(features, features @ np.array([3.0, -2.0, 2.0, 7.0, 1.0])) >= 0).all()


def test_what_runs_spend_is_told_by_differences_within_clips_and_clips_by_their_means():
    rng = np.random.default_rng(0)
    clips = [name for name in "abcd" for _ in range(30)]
    motion = np.repeat([20.0, 25.0, 30.0, 33.0], 30)
    spent = rng.normal(size=(120, 3)) + motion[:, None]  # easy clips were run for longer
    rows = np.column_stack([np.ones(120), motion, spent])
    law = np.array([-3.0, 0.9, 2.0, 1.0, 0.5])
    assert decibel_law(rows, rows @ law, clips) == pytest.approx(law, rel=0.02, abs=0.05)
    law[3] = -1.0
    assert decibel_law(rows, rows @ law, clips)[3] == 0.0  # more is never foretold to be worse


def test_calibrations_are_kept_and_bad_ones_are_none(tmp_path, monkeypatch):
    monkeypatch.setattr(machine, "user_cache", lambda: tmp_path)
    assert machine.load() is None
    assert calibrate.keep(Machine(2.0, 0.8, 1.0)) and machine.load() == Machine(2.0, 0.8, 1.0)
    for text in ("", "[]", "{}", '{"speed": 0, "wall_per_cpu": 1, "contention": 1}',
                 '{"speed": NaN, "wall_per_cpu": 1, "contention": 1}'):  # fmt: skip
        machine.machine_file().write_text(text)
        assert machine.load() is None
    monkeypatch.setattr(machine, "contention", lambda: 3.0)
    assert Machine(1.0, 0.8, 1.5).wall_now() == pytest.approx(1.6)


def test_difficulty_knows_plain_from_fine_texture_and_still_from_changing():
    clip = small_clip(frames=4, width=128)
    rng = np.random.default_rng(0)
    plain = replace(clip, frames=np.full_like(clip.frames, 90))
    noise = rng.integers(0, 255, clip.frames.shape[1:], dtype=np.uint8)
    fine = replace(clip, frames=np.broadcast_to(noise, clip.frames.shape).copy())
    easy, hard, usual = (difficulty(c) for c in (plain, fine, clip))
    assert easy.texture > 45 and easy.motion > 45 and easy.change > 45
    assert hard.texture < usual.texture < easy.texture and hard.motion < usual.motion
    assert 0 < usual.area < 1 and usual.moved > 0 and usual.area == easy.area


def test_the_outcome_says_what_was_expected():
    told = forecast.Forecast(310.0, 30.1, 40.0, 0.8, 800.0, 1.0, CLIP)
    came = forecast.outcome(told, 333.0, 31.9)
    assert came["said"] == "Expected 310 s, took 333 s; expected 30.1 dB, got 31.9 dB."
    assert came["seconds_off"] == pytest.approx(333 / 310 - 1) and came["psnr_off"] == pytest.approx(1.8)


def test_the_forecast_needs_no_torch():
    code = "import sys, genmojo_core.effects.forecast; sys.exit('torch' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code]).returncode == 0
