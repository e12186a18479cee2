"""An effect that the plan left out although the clip needs it is called in by the run, which then recovers.

The plan is spoiled on purpose: evidence says "off" where the clip's makers put light that fades or a body that bends.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import torch

from genmojo_core.clip.clip import Clip
from genmojo_core.clip.synthetic import generate
from genmojo_core.clip.synthetic_specs import CYLINDER, spec
from genmojo_core.effects.decide import plan
from genmojo_core.effects.texts import sentence
from genmojo_core.estimate.complete import complete
from genmojo_core.events import EffectChanged, Event, Finished, Step
from genmojo_core.optimise import call_in
from genmojo_core.optimise import run as run_module
from genmojo_core.optimise.call_in import BENDS, LOOKS, LightWatch
from genmojo_core.optimise.motion import initial_motion
from genmojo_core.optimise.run import Run
from tests.optimise.small_runs import small_clip, small_config, small_run

LONG = {"lift_steps": 10, "joint_steps": 60, "held_out_share": 0.2}


def wrongly_off(clip: Clip, name: Any, **options: Any) -> Run:
    """A run whose plan left an effect out, not by the user's word."""
    run = small_run(clip, **options)
    run.plan = run.plan.changed(name, on=False, overridden=False)
    return run


def unexplained(run: Run) -> float:
    """Change of brightness over the clip that the scene as it stands does not show."""
    watch = LightWatch(len(run.clip))
    with torch.no_grad():
        light = run.objective.evaluate(list(range(len(run.clip))), True, run.generator).light
    for _ in range(LOOKS):
        watch.hear(light)
    return watch.change()


def calls(events: list[Event]) -> list[tuple[str, bool]]:
    """Effects that changed, but for shading, which is test_shading's."""
    return [(e.effect, e.on) for e in events if isinstance(e, EffectChanged) and e.effect != "shading"]


@pytest.fixture(scope="module")
def fading() -> Iterator[Clip]:
    """A clip whose light fades; its motion is solved once for all runs."""
    clip = small_clip("moving-camera", frames=4, width=64)
    solved = initial_motion(clip)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(run_module, "initial_motion", lambda *_, **__: solved)
        yield clip


def test_light_that_was_left_out_is_called_in_and_the_run_recovers(fading: Clip) -> None:
    planned = small_run(fading, {"appearance_change": True}, **LONG)
    list(planned)
    left_out = small_run(fading, {"appearance_change": False}, **LONG)
    stubborn = list(left_out)
    run = wrongly_off(fading, "appearance_change", **LONG)
    events = list(run)
    assert calls(events) == [("appearance_change", True)]
    assert calls(stubborn) == []  # the user's word holds
    assert isinstance(events[-1], Finished)
    assert unexplained(left_out) > 2 * unexplained(run) and unexplained(run) < unexplained(planned) + 0.03
    effect = run.plan.get("appearance_change")
    assert effect.on and "brightness" in effect.reason
    assert next(e for e in run.bake().effects if e["name"] == "appearance_change")["on"]
    gains = run.scene.gain.log_gain.detach().mean(dim=1).exp()
    assert float(gains[-1] / gains[0]) < 0.92


def test_a_run_with_light_called_in_resumes(fading: Clip, tmp_path) -> None:
    whole = [e.loss for e in wrongly_off(fading, "appearance_change", run_dir=tmp_path / "a", **LONG)
             if isinstance(e, Step)]  # fmt: skip
    first = wrongly_off(fading, "appearance_change", run_dir=tmp_path / "b", **LONG)
    seen = []
    for event in first:
        if isinstance(event, Step):
            seen.append(event.loss)
            if len(seen) == 50:
                assert first.light_called_in
                first.stop()
    second = wrongly_off(fading, "appearance_change", run_dir=tmp_path / "b", resume=True, **LONG)
    seen += [e.loss for e in second if isinstance(e, Step)]
    assert second.scene.gain is not None
    assert seen == pytest.approx(whole, rel=1e-4)


def test_bending_that_was_left_out_is_called_in(monkeypatch: pytest.MonkeyPatch) -> None:
    base = spec("crossing-shapes")
    swaying = replace(CYLINDER, path=((0.0, 0.0, 0.8),), sway=0.6, spin=0.0)
    made, _ = generate(replace(base, shapes=(swaying,), frames=8, size=(128, 72), tracks=4))
    clip = complete(made)
    solved = initial_motion(clip)
    monkeypatch.setattr(run_module, "initial_motion", lambda *_, **__: solved)
    run = wrongly_off(clip, "non_rigid_motion", joint_steps=5, rigid_steps=8)
    events = list(run)
    assert ("non_rigid_motion", True) in calls(events)
    assert [stage.steps for stage in run.progress.stages] == [6, 5]  # not those of a rigid object any more
    assert all(o.field is not None for o in run.scene.objects)
    assert run.plan.get("non_rigid_motion").settings["motion_bases"] >= 1

    rigid = small_run(clip, {"non_rigid_motion": False}, joint_steps=5, rigid_steps=8)
    assert calls(list(rigid)) == []
    assert [stage.steps for stage in rigid.progress.stages] == [6, 8]


def test_still_light_is_not_called_in_by_noise() -> None:
    rng = np.random.default_rng(0)
    watch = LightWatch(4)
    for _ in range(5):
        shown = torch.rand(3) * 0.4 + 0.3
        watch.hear([(t, shown, shown * (1 + float(rng.normal()) * 0.01)) for t in range(4)])
    assert watch.called_for() is None
    for _ in range(9):
        watch.hear([(3, shown, shown * 0.8)])
    assert watch.change() == pytest.approx(0.2, abs=0.03) and "brightness" in sentence([watch.called_for()])


def test_an_object_that_was_held_for_rigid_is_called_in_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    clip = small_clip("moving-camera", frames=4)
    ids = tuple(int(i) for i in clip.object_ids)
    decided = plan(clip, small_config()).changed("non_rigid_motion", on=True, overridden=False, spared=ids)
    motions = initial_motion(clip)
    shares = dict.fromkeys(range(len(ids)), 0.0) | {1: 2 * BENDS}
    monkeypatch.setattr(call_in, "bent_share", lambda _, k, __: shares[k])
    after = call_in.bending(clip, decided, motions, 4).get("non_rigid_motion")
    assert after.on and after.spared == tuple(i for i in ids if i != ids[1])
    assert clip.object_names[1] in after.reason
    by_hand = decided.changed("non_rigid_motion", overridden=True)
    assert call_in.bending(clip, by_hand, motions, 4) is by_hand
