"""Off means off: what an effect that is left out would have cost does not exist anywhere.

For every effect: its parameters, its feature channels as the rasteriser gets them, its loss terms, its nodes in the
autograd graph and its line in the measured profile.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import pytest
import torch

from genmojo_core.clip.clip import Clip
from genmojo_core.effects.decide import ALL, NAMES
from genmojo_core.events import Preview
from genmojo_core.optimise import cost
from genmojo_core.optimise import run as run_module
from genmojo_core.optimise.cost import measured_costs, term_costs
from genmojo_core.optimise.objective import Objective
from genmojo_core.optimise.run import Run
from tests.optimise.small_runs import small_clip, small_run

TERMS = {
    "background": {"ssim", "gaps"},  # structure is compared over whole pictures, which it covers
    "non_rigid_motion": {"rigidity", "rotation", "local_scale", "delta_scale", "delta_color"},
    "appearance_change": {"delta_color"},
    "instance_labels": {"labels", "depth_order"},
    "joint_occlusion": {"depth_order"},
    "depth_order": {"depth", "depth_order"},
    "flow": {"flow"},
    "track_supervision": {"tracks"},
    "unseen_views": {"unseen"},
}
PARAMETERS = {
    "non_rigid_motion": ".field.", "appearance_change": "gain.", "background": "background.", "shading": "shade.",
}  # fmt: skip
CHANNELS = {"instance_labels": 2, "flow": 2}  # three labels become one coverage channel


@pytest.fixture(scope="module")
def clip() -> Clip:
    return small_clip("moving-camera", frames=4)


@pytest.fixture(scope="module", autouse=True)
def motion_once(clip: Clip) -> Iterator[None]:
    """The initial motion does not depend on the effects looked at here: it is solved once."""
    motions = run_module.initial_motion(clip)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(run_module, "initial_motion", lambda *_, **__: motions)
        yield


@pytest.fixture(scope="module")
def whole(clip: Clip) -> Run:
    return ready(clip, {ALL: True})


def ready(clip: Clip, effects: dict[str, bool]) -> Run:
    """A run up to its first optimiser step."""
    run = small_run(clip, effects)
    next(e for e in run if isinstance(e, Preview) and e.stage == "motion")
    return run


def evaluated(run: Run, monkeypatch: pytest.MonkeyPatch) -> tuple[set[str], int, int]:
    """Loss terms of a step, channels that the rasteriser was given, nodes of the autograd graph."""
    seen: list[int] = []
    splat = run.objective.splat

    def counting(splats: Any, view: Any, **options: Any) -> Any:
        seen.append(splats.features.shape[1])
        return splat(splats, view, **options)

    monkeypatch.setattr(run.objective, "splat", counting)
    outcome = run.objective.evaluate([1, 2], True, torch.Generator().manual_seed(0))
    return set(outcome.parts), max(seen), sum(1 for _ in graph(outcome.loss))


def graph(loss: torch.Tensor) -> Iterator[Any]:
    """Every node that the gradient of a loss goes through."""
    found, todo = set(), [loss.grad_fn]
    while todo:
        node = todo.pop()
        if node is not None and node not in found:
            found.add(node)
            yield node
            todo += [after for after, _ in node.next_functions]


@pytest.mark.parametrize("name", [n for n in NAMES if n not in ("unseen_views", "joint_occlusion", "reappearance")])
def test_what_is_off_does_not_exist(name: str, clip: Clip, whole: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    run = ready(clip, {ALL: True, name: False})
    with monkeypatch.context() as patch:
        all_terms, all_channels, all_nodes = evaluated(whole, patch)
        terms, channels, nodes = evaluated(run, patch)
    assert all_terms - terms == TERMS.get(name, set()) & all_terms
    assert all_channels - channels == CHANNELS.get(name, 0)
    assert nodes < all_nodes or name == "camera_motion"
    mark = PARAMETERS.get(name)
    owned = [p for p, _ in run.scene.named_parameters() if mark is not None and mark in p]
    assert not owned
    assert mark is None or any(mark in p for p, _ in whole.scene.named_parameters())
    assert name not in measured_costs(run.objective, run.plan, [1])
    if name == "track_supervision":
        assert run.objective.tracks == []


def test_a_spared_object_has_no_field_while_others_bend(clip: Clip, whole: Run) -> None:
    run = small_run(clip, {ALL: True})
    first = int(clip.object_ids[0])
    run.plan = run.plan.changed("non_rigid_motion", spared=(first,), overridden=False)
    list(run)
    fields = {model.id: model.field is not None for model in run.scene.objects}
    assert fields == {int(i): int(i) != first for i in clip.object_ids}
    owned = {name.split(".")[1] for name, _ in run.scene.named_parameters() if ".field." in name}
    assert len(owned) == len(fields) - 1
    frames = run.bake()
    still, later = (frames.frame(t).object_index == 0 for t in (0, 3))
    scales = [frames.frame(t).scales[chosen] for t, chosen in ((0, still), (3, later))]
    growth = scales[1] / scales[0]
    assert growth == pytest.approx(growth[0, 0], rel=1e-4)  # nearer or farther, but of the same shape


def test_joint_occlusion_off_by_evidence_adds_no_term_between_objects(clip: Clip) -> None:
    """By evidence, not by the user, whose word means objects compared one by one (separate.py)."""
    run = small_run(clip)
    run.plan = run.plan.changed("joint_occlusion", on=False)
    next(e for e in run if isinstance(e, Preview) and e.stage == "motion")
    assert "depth_order" not in run.objective.evaluate([1], True, run.generator).parts
    assert "joint_occlusion" not in measured_costs(run.objective, run.plan, [1])


def test_prior_that_is_off_is_never_made(clip: Clip, monkeypatch: pytest.MonkeyPatch) -> None:
    def made(*_: Any) -> None:
        raise AssertionError("the prior was made")

    monkeypatch.setattr(run_module, "choose_prior", made)
    assert ready(clip, {"unseen_views": False}).unseen is None


def test_still_camera_is_one_camera_for_all_frames(clip: Clip, whole: Run) -> None:
    run = ready(clip, {"camera_motion": False})
    poses = run.scene.cameras.world_to_camera
    assert (poses == poses[0]).all() and not (whole.scene.cameras.world_to_camera == poses[0]).all()


def test_rigid_run_without_flow_looks_at_no_second_time(clip: Clip, monkeypatch: pytest.MonkeyPatch) -> None:
    run = ready(clip, {"non_rigid_motion": False, "flow": False})
    asked: list[int] = []
    states = run.scene.states

    def noting(frames: list[int], deform: bool = True) -> Any:
        asked.extend(frames)
        return states(frames, deform)

    monkeypatch.setattr(run.scene, "states", noting)
    run.objective.evaluate([1], True, run.generator)
    assert asked == [1]


def test_profile_names_every_effect_with_a_part_and_changes_nothing(whole: Run) -> None:
    before = [p.detach().clone() for p in whole.scene.parameters()]
    layout, tracks = whole.scene.layout, whole.objective.tracks
    costs = measured_costs(whole.objective, whole.plan, [1, 2])
    assert set(costs) == {"joint_occlusion", "background", "non_rigid_motion", "appearance_change", "shading",
                          "instance_labels", "depth_order", "flow", "track_supervision"}  # fmt: skip
    assert costs["non_rigid_motion"][0] > 0 and costs["non_rigid_motion"][1] > costs["appearance_change"][1] > 0
    assert whole.scene.layout is layout and whole.objective.tracks is tracks
    assert all(torch.equal(a, b) for a, b in zip(before, whole.scene.parameters(), strict=True))
    assert all(p.grad is None for p in whole.scene.parameters())


def test_a_loss_term_costs_what_its_weight_of_zero_saves_and_stays_as_it_was(whole: Run) -> None:
    weights = whole.objective.weights
    costs = term_costs(whole.objective, [1, 2], ["hull", "rigidity", "rotation"])
    assert set(costs) == {"hull", "rigidity", "rotation"} and all(ms >= 0 for ms in costs.values())
    assert whole.objective.weights is weights
    assert all(p.grad is None for p in whole.scene.parameters())


def test_the_cost_of_a_term_is_the_time_that_goes_with_its_weight(whole: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    def seconds(objective: Objective, frames: list[int]) -> float:
        """A clock without noise: a frame takes 5 ms, hull 2 ms and rigidity 1 ms more, rotation comes with rigidity."""
        assert len(frames) == 1
        return 0.005 + 0.002 * (objective.weights.hull > 0) + 0.001 * (objective.weights.rigidity > 0)

    monkeypatch.setattr(cost, "_seconds", seconds)
    costs = term_costs(whole.objective, [1, 2], ["hull", "rigidity", "rotation"])
    assert costs == pytest.approx({"hull": 4.0, "rigidity": 2.0, "rotation": 0.0})


def test_terms_of_no_weight_are_not_worked_out(whole: Run) -> None:
    parts = whole.objective.evaluate([1, 2], True, torch.Generator().manual_seed(0)).parts
    weights = whole.objective.weights
    none = {"rigidity": 0.0, "rotation": 0.0, "local_scale": 0.0, "delta_scale": 0.0}
    whole.objective.weights = replace(weights, **none)
    fewer = whole.objective.evaluate([1, 2], True, torch.Generator().manual_seed(0)).parts
    whole.objective.weights = weights
    assert set(parts) - set(fewer) == set(none)
    assert all(fewer[name] == parts[name] for name in fewer)
