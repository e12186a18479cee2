"""The prior in a run: points only where no frame objects, a loss in both stages, places untouched, off where told.

The networks here are untrained (the shipped file's quality is tests/priors' business); what is tested is the wiring.
"""

import numpy as np
import pytest
import torch

from genmojo_core.events import EffectChanged, Finished, Step, Warned
from genmojo_core.optimise import methods, unseen
from genmojo_core.optimise.separate import SeparateObjective
from genmojo_core.optimise.unseen import Moment
from genmojo_core.priors.denoiser import Denoiser
from genmojo_core.priors.embedded import EmbeddedPrior
from genmojo_core.priors.volume import VolumeNet
from tests.optimise.small_runs import small_clip, small_config, small_run


@pytest.fixture(autouse=True)
def untrained(monkeypatch):
    """Everybody's prior is a filled slab, without a file."""
    torch.manual_seed(0)
    prior = EmbeddedPrior(VolumeNet(), Denoiser())
    monkeypatch.setattr("genmojo_core.optimise.run.choose_prior", lambda name: None if name == "none" else prior)
    return prior


@pytest.fixture(scope="module")
def clip():
    return small_clip(width=112)


def steps(events):
    return [e for e in events if isinstance(e, Step)]


@pytest.mark.parametrize("mode", ["pseudo", "x0", "sds"])
def test_the_prior_speaks_in_both_stages_and_its_views_are_recorded(clip, mode, monkeypatch):
    monkeypatch.setattr("genmojo_core.optimise.unseen.WORSE", np.inf)  # this one has learned nothing
    run = small_run(clip, prior="embedded", prior_mode=mode)
    events = list(run)
    assert isinstance(events[-1], Finished)
    assert {e.stage for e in steps(events) if e.losses.get("unseen", 0) > 0} == {"lift", "joint"}
    rows = run.bake().supervised
    judged = rows[len(clip) :]
    assert len(judged) == 16 * 4 and np.abs(judged[:, 0]).max() <= 30 and np.ptp(judged[:, 1]) > 180


def test_none_costs_nothing(clip):
    run = small_run(clip)
    assert not run.plan.on("unseen_views")
    assert all("unseen" not in e.losses for e in steps(list(run))) and run.unseen is None


def test_added_points_never_show_where_a_frame_shows_something_else(clip):
    """Drawn from every frame's own camera, the added Gaussians stay behind the object they belong to."""
    plain, with_prior = small_run(clip), small_run(clip, prior="embedded")
    started = [next(e for e in run if isinstance(e, Step)) for run in (plain, with_prior)]
    assert started[1].gaussians > started[0].gaussians
    before = next(e for e in small_run(clip) if type(e).__name__ == "Preview" and e.stage == "motion").psnr
    after = next(e for e in small_run(clip, prior="embedded") if type(e).__name__ == "Preview" and e.stage == "motion")
    assert after.psnr > before - 0.3


def made(clip, untrained, **changes):
    run = small_run(clip, prior="embedded", **changes)
    next(e for e in run if isinstance(e, Step))
    return run


def test_no_gradient_reaches_places_motion_or_light(clip, untrained):
    run = made(clip, untrained)
    run.optimiser.zero_grad(set_to_none=True)
    outcome = type("Outcome", (), {"loss": torch.zeros(()), "parts": {}})()
    run.unseen.add_to(outcome, Moment(0.1, True, 3), 1.0, torch.Generator().manual_seed(0))
    outcome.loss.backward()
    touched = {name for name, p in run.scene.named_parameters() if p.grad is not None and p.grad.any()}
    assert any(name.endswith("means") for name in touched) and any(name.endswith("dc") for name in touched)
    assert [name for name in touched if ".gaussians." not in name] == [], "no place, light, background or motion"


def test_all_objects_or_one_per_step_and_the_scene_as_one(clip, untrained):
    assert len(made(clip, untrained).unseen.subjects) == clip.objects
    scene = made(clip, untrained, prior_scope="scene").unseen
    assert len(scene.subjects) == 1 and len(scene.subjects[0].models) == clip.objects


def test_objects_that_cannot_be_references_are_named(clip):
    hidden = small_clip(width=112)
    hidden.masks.value[hidden.masks.value == 1] = 0
    hidden.masks.value[2, 20:22, 20:22] = 1
    events = list(small_run(hidden, prior="embedded"))
    said = [e.message for e in events if isinstance(e, Warned) and e.code == "prior"]
    assert any(hidden.object_names[0] in text and "smaller than" in text for text in said)


def test_two_frames_that_do_not_agree_switch_it_off(clip, untrained, monkeypatch):
    monkeypatch.setattr(untrained, "agreement", -1.0)
    run = small_run(clip, prior="embedded", lift_steps=1, joint_steps=1)
    said = [e.message for e in run if isinstance(e, Warned) and e.code == "prior"]
    assert all(any(name in text and "differs by" in text for text in said) for name in clip.object_names)
    assert not any(model.gaussians.invented.any() for model in run.scene.objects)


def test_held_out_pixels_can_switch_it_off(clip, monkeypatch):
    """The untrained slab is in the way or not: either answer is asked for, and what it invented goes with it."""
    monkeypatch.setattr(unseen, "WORSE", -100.0)
    run = small_run(clip, prior="embedded")
    events = list(run)
    changed = [e for e in events if isinstance(e, EffectChanged)]
    assert len(changed) == 1 and changed[0].effect == "unseen_views" and "Held-out" in changed[0].reason
    assert changed[0].reason.count("dB") == 2 and "unseen" not in steps(events)[-1].losses
    assert not any(model.gaussians.invented.any() for model in run.scene.objects)
    monkeypatch.setattr(unseen, "WORSE", 100.0)
    run = small_run(clip, prior="embedded")
    assert not any(isinstance(e, EffectChanged) for e in run)
    assert any(model.gaussians.invented.any() for model in run.scene.objects)


def test_schedules():
    assert unseen.fade(0.0) == unseen.fade(0.6) == 1.0 and unseen.fade(1.0) == pytest.approx(unseen.LAST_WEIGHT)
    assert [unseen.render_factor(share) for share in (0.0, 0.5, 1.0)] == [2, 3, 4]
    low, high = unseen.levels(0.0)
    assert (low, high) == (0.25, 1.0) and unseen.levels(1.0)[1] < 0.5
    drawn = unseen.draw_views(np.random.default_rng(0), 200)
    assert drawn.elevation.abs().max() <= 30 and drawn.azimuth.min() < -150 and drawn.azimuth.max() > 150


@pytest.mark.slow
def test_methods_are_configurations(clip):
    for name in methods.TABLE:
        changed, overrides = methods.prepared(clip, name)
        run = small_run(changed, overrides, method=name, prior="embedded", lift_steps=1, joint_steps=1)
        assert isinstance(list(run)[-1], Finished), name
        assert len(run.scene.objects) == (1 if name == "dreamgaussian4d" else clip.objects)
        assert isinstance(run.objective, SeparateObjective) == (name == "dreamscene4d")
        assert (run.unseen is None) == (name == "shape-of-motion")
    assert small_config(method="dreamscene4d").method == "dreamscene4d"


def test_what_frames_show_does_not_follow_the_prior(clip, untrained):
    run = made(clip, untrained)
    run.optimiser.zero_grad(set_to_none=True)
    outcome = type("Outcome", (), {"loss": torch.zeros(()), "parts": {}})()
    for step in range(6):
        run.unseen.add_to(outcome, Moment(0.1, False, step), 1.0, torch.Generator().manual_seed(0))
    outcome.loss.backward()
    followed = 0
    for model in run.scene.objects:
        gradient, invented = model.gaussians.means.grad, model.gaussians.invented
        if gradient is not None:
            assert not gradient[~invented].any()
            followed += int(gradient[invented].any())
    assert followed
