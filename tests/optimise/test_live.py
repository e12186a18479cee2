"""What a window may do between two events of a run: look, wait, change a parameter, write a checkpoint."""

from __future__ import annotations

import time

import numpy as np
import pytest

from genmojo_core import events
from genmojo_core.config import LearningRates
from genmojo_core.errors import GenmojoError
from genmojo_core.optimise import checkpoint, parameters
from genmojo_core.optimise.progress import Clock
from tests.optimise.small_runs import small_clip, small_run


def until_step(run, step):
    """Events up to a step; the iterator to go on with."""
    stream = iter(run)
    for event in stream:
        if isinstance(event, events.Step) and run.progress.step == step:
            return stream
    raise AssertionError("the run ended before that step")


def test_live_gaussians_are_the_baked_ones():
    run = small_run(small_clip())
    with pytest.raises(GenmojoError):
        run.live(0)
    until_step(run, 8)
    scene = run.bake()
    for t in (0, 4):
        live, baked = run.live(t), scene.frame(t)
        for ours, theirs in ((live.means, baked.means), (live.scales, baked.scales), (live.rgb, baked.rgb),
                             (live.opacities, baked.opacities)):  # fmt: skip
            np.testing.assert_allclose(ours, theirs, atol=2e-5)
        same = np.abs((live.quats * baked.quats).sum(1)) / np.linalg.norm(live.quats, axis=1)
        np.testing.assert_allclose(same, 1, atol=1e-5)
        np.testing.assert_array_equal(live.uid, scene.uid)
        np.testing.assert_array_equal(live.object_id, np.array([o.id for o in scene.objects])[baked.object_index])


def test_positions_of_rigid_objects_have_a_rate_of_their_own_in_proportion_to_the_others():
    rates = LearningRates(means=2e-3, rigid_means=0.25)
    run = small_run(small_clip(frames=3), {"non_rigid_motion": False}, rates=rates)
    until_step(run, 1)

    def rate() -> float:
        means = run.scene.objects[0].gaussians.means
        return next(g["start_lr"] for g in run.optimiser.param_groups if any(p is means for p in g["params"]))

    assert rate() == pytest.approx(5e-4)
    run.change("rates.means", 4e-3)
    assert rate() == pytest.approx(1e-3)


def test_changes_hold_from_the_next_step_on_and_are_recorded():
    run = small_run(small_clip())
    stream = until_step(run, 7)
    told = run.change("rates.means", 0.0)
    run.change("rates.placement", 0.0)
    run.change("weights.rgb", 0.0)
    run.change("step_limit", 9)
    assert (told.old, told.new, told.step) == (1.6e-3, 0.0, 7)
    before = run.scene.objects[0].gaussians.means.detach().clone()
    after = [e for e in stream if isinstance(e, events.Step)]
    assert len(after) == 2 and after[0].losses["rgb"] == 0.0
    np.testing.assert_array_equal(before, run.scene.objects[0].gaussians.means.detach())
    assert run.bake().config["changes"][0]["name"] == "rates.means" and run.bake().config["rates"]["means"] == 0.0


@pytest.mark.parametrize(
    ("name", "value"),
    [("seed", 1), ("rates.means", -1), ("rates.means", float("nan")), ("step_limit", 2.5), ("weights.rgb", "a lot"),
     ("weights", 1), ("rates.__class__", 1), ("step_limit", True)],
)  # fmt: skip
def test_only_listed_parameters_within_their_range_change(name, value):
    with pytest.raises(GenmojoError, match=r"cannot be"):
        parameters.checked(name, value)


def test_every_listed_parameter_has_a_value_to_start_from():
    run = small_run(small_clip())
    for name, parameter in parameters.PARAMETERS.items():
        value = min(32.0, parameter.high)
        assert run.change(name, value).new == value


def test_waiting_does_not_count():
    clock = Clock()
    clock.hold()
    time.sleep(0.05)
    clock.go_on()
    assert clock.this_run() < 0.04 and clock.now()[0] < 0.04


def test_checkpoint_on_demand(tmp_path):
    run = small_run(small_clip(), run_dir=tmp_path, checkpoint_seconds=1e6)
    assert run.checkpoint() is None
    until_step(run, 3)
    told = run.checkpoint()
    assert told.step == 3 and checkpoint.exists(tmp_path)
