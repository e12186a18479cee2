"""The loop as a user meets it: events in order, a better scene, stop and resume, effects that cost nothing when off."""

import json

import numpy as np
import pytest
import torch

from genmojo_core.clip.clip import Clip
from genmojo_core.errors import GenmojoError
from genmojo_core.events import Checkpointed, Event, Failed, Finished, Preview, StageStarted, Step
from genmojo_core.optimise import run as run_module
from genmojo_core.optimise.schedule import wear_factor
from tests.optimise.small_runs import small_clip, small_run

BENDING = {"non_rigid_motion": True}


@pytest.fixture(scope="module")
def clip() -> Clip:
    return small_clip()


def steps(events: list[Event]) -> list[Step]:
    return [e for e in events if isinstance(e, Step)]


def test_a_run_tells_its_stages_and_ends_with_a_better_scene(clip: Clip) -> None:
    run = small_run(clip, BENDING, lift_steps=30, joint_steps=30, held_out_share=0.2)
    events = list(run)
    assert [e.stage for e in events if isinstance(e, StageStarted)] == [
        "first scene",
        "motion",
        "background",
        "lift",
        "joint",
    ]
    first = next(i for i, e in enumerate(events) if isinstance(e, Preview))
    assert first < next(i for i, e in enumerate(events) if isinstance(e, Step))  # a scene before the first step
    assert isinstance(events[-1], Finished)
    assert events[-1].reason == "done"
    assert steps(events)[-1].step == 30
    assert run.progress.curve[-1]["psnr_held_out"] > run.progress.curve[0]["psnr_held_out"]
    assert all(json.dumps(e.to_json()) for e in events)
    baked = run.bake()
    assert baked.d_xyz.shape == (len(clip), len(baked.xyz), 3)
    assert np.isfinite(baked.frame(len(clip) - 1).means).all()
    assert [o.id for o in baked.objects] == [1, 2, 3, 0]
    assert len(set(baked.uid.tolist())) == len(baked.uid)


def test_the_curve_is_about_the_whole_clip_from_the_first_step_on() -> None:
    """Frames that no step has seen count too: else the curve would fall whenever they join."""
    clip = small_clip(frames=12, width=48)
    run = small_run(clip, lift_steps=4, joint_steps=2, held_out_share=0.3)
    for event in run:
        if isinstance(event, Step):
            assert [row["frame"] for row in sorted(run.progress.state()["held"], key=lambda row: row["frame"])] == list(
                range(len(clip))
            )


def test_a_run_ends_when_its_goal_is_reached(clip: Clip) -> None:
    """Not before all frames take part, and with a scene; a goal out of reach changes nothing."""
    whole = list(small_run(clip, joint_steps=40, held_out_share=0.2))
    short = list(small_run(clip, joint_steps=40, held_out_share=0.2, until="psnr>=5"))
    assert isinstance(short[-1], Finished) and short[-1].reason == "goal"
    assert 12 <= steps(short)[-1].step < 40 and steps(short)[-1].stage == "joint"
    assert steps(short)[-1].psnr_held_out >= 5
    never = list(small_run(clip, joint_steps=40, held_out_share=0.2, until="psnr>=90"))
    assert never[-1].reason == "done" and len(steps(never)) == len(steps(whole))


def test_the_same_seed_gives_the_same_scene_bit_for_bit(clip: Clip) -> None:
    first, second = (small_run(clip, BENDING) for _ in range(2))
    losses = [[s.loss for s in steps(list(run))] for run in (first, second)]
    assert losses[0] == losses[1]
    assert np.array_equal(first.bake().xyz, second.bake().xyz)


def test_resume_goes_on_with_the_same_losses(clip: Clip, tmp_path, monkeypatch) -> None:
    """Measuring what effects cost, which a resumed run does anew, changes nothing either."""
    monkeypatch.setattr(run_module, "COST_STEP", 2)
    whole = [s.loss for s in steps(list(small_run(clip, BENDING, tmp_path / "whole")))]
    first = small_run(clip, BENDING, tmp_path / "cut")
    seen = []
    for event in first:
        if isinstance(event, Step):
            seen.append(event.loss)
            if len(seen) == 9:
                first.stop()
    assert len(seen) == 9
    second = small_run(clip, BENDING, tmp_path / "cut", resume=True)
    seen += [s.loss for s in steps(list(second))]
    assert seen == pytest.approx(whole, rel=1e-5)
    assert second.plan.get("non_rigid_motion").measured_ms > 0


def test_stop_keeps_the_work(clip: Clip, tmp_path) -> None:
    run = small_run(clip, run_dir=tmp_path)
    events = []
    for event in run:
        events.append(event)
        if isinstance(event, Step):
            run.stop()
    assert len(steps(events)) == 1
    assert isinstance(events[-1], Finished)
    assert events[-1].reason == "interrupted"
    assert any(isinstance(e, Checkpointed) for e in events)
    assert len(run.bake().xyz)


def test_the_budget_ends_a_run(clip: Clip) -> None:
    events = list(small_run(clip, joint_steps=100_000, budget_seconds=4.0))
    assert events[-1].reason == "budget"
    assert events[-1].step < 100_000


def test_n27_a_spoiled_gaussian_is_dropped_and_the_rest_goes_on(clip: Clip) -> None:
    run = small_run(clip)
    events = []
    for event in run:
        events.append(event)
        if isinstance(event, Step) and event.step == 3 and event.stage == "lift":
            with torch.no_grad():
                run.scene.objects[1].gaussians.means[4] = float("nan")
    assert isinstance(events[-1], Finished)
    assert run.guard.quarantined == {run.scene.objects[1].name: 1}
    assert all(np.isfinite(s.loss) for s in steps(events))
    assert all(bool(torch.isfinite(p).all()) for p in run.scene.parameters())


def test_n27_a_spoiled_shared_parameter_rolls_back_and_a_hopeless_run_fails_in_one_sentence(clip: Clip) -> None:
    run = small_run(clip, BENDING, lift_steps=0, joint_steps=30)
    events = []
    for event in run:
        events.append(event)
        if isinstance(event, Step):
            with torch.no_grad():
                run.scene.objects[0].field.bases.fill_(float("nan"))
    assert isinstance(events[-1], Failed)
    assert events[-1].code == "numeric"
    assert "\n" not in events[-1].message


@pytest.mark.parametrize("name", ["still", "pixel"])
def test_n18_n19_a_still_and_a_speck_work(name: str) -> None:
    tiny = small_clip(name, frames=3, width=96)
    run = small_run(tiny)
    events = list(run)
    assert isinstance(events[-1], Finished)
    assert np.isfinite(run.bake().frame(0).means).all()


def test_n28_the_size_of_the_world_does_not_matter(clip: Clip) -> None:
    import dataclasses

    def scaled(factor: float) -> float:
        cameras = clip.cameras.value
        poses = cameras.world_to_camera.copy()
        poses[:, :3, 3] *= factor
        other = clip.with_channels(
            cameras=dataclasses.replace(clip.cameras, value=dataclasses.replace(
                cameras, world_to_camera=poses, near=cameras.near * factor, far=cameras.far * factor)),
            depth=dataclasses.replace(clip.depth, value=clip.depth.value * np.float32(factor)),
            background_depth=dataclasses.replace(
                clip.background_depth, value=clip.background_depth.value * np.float32(factor)),
        )  # fmt: skip
        run = small_run(other, BENDING, lift_steps=15, joint_steps=15)
        list(run)
        return run.progress.psnr()

    reference = scaled(1.0)
    assert scaled(100.0) == pytest.approx(reference, abs=0.3)
    assert scaled(0.01) == pytest.approx(reference, abs=0.3)


def test_resuming_without_a_checkpoint_is_one_sentence(clip: Clip, tmp_path) -> None:
    with pytest.raises(GenmojoError, match="no checkpoint"):
        list(small_run(clip, run_dir=tmp_path, resume=True))
    with pytest.raises(GenmojoError, match="--run-dir"):
        list(small_run(clip, resume=True))


def test_a_checkpoint_of_another_plan_is_refused(clip: Clip, tmp_path) -> None:
    list(small_run(clip, BENDING, tmp_path))
    with pytest.raises(GenmojoError, match="another clip or effect plan"):
        list(small_run(clip, {"non_rigid_motion": False}, tmp_path, resume=True))


def test_a_damaged_checkpoint_is_refused(clip: Clip, tmp_path) -> None:
    list(small_run(clip, run_dir=tmp_path))
    path = next(tmp_path.glob("checkpoint-*.safetensors"))
    data = bytearray(path.read_bytes())
    data[len(data) // 2] ^= 1
    path.write_bytes(data)
    with pytest.raises(GenmojoError, match="checksum"):
        list(small_run(clip, run_dir=tmp_path, resume=True))


def test_an_object_that_cannot_be_followed_does_not_spoil_the_others(clip: Clip, monkeypatch) -> None:
    from dataclasses import replace

    from genmojo_core.events import Warned
    from genmojo_core.optimise import run as run_module

    solved = run_module.initial_motion

    def spoiled(given: Clip, **options: object) -> list:
        motions = solved(given, **options)
        return [replace(motions[0], pose=motions[0].pose * np.nan), *motions[1:]]

    monkeypatch.setattr(run_module, "initial_motion", spoiled)
    run = small_run(clip)
    events = list(run)
    assert isinstance(events[-1], Finished)
    assert [e.code for e in events if isinstance(e, Warned)] == ["motion_not_found"]
    assert np.isfinite(run.bake().frame(2).means).all()


def test_learning_rates_fall_once_every_frame_was_seen_often() -> None:
    assert wear_factor(0, 24, 3) == wear_factor(400, 24, 3) == 1.0
    assert wear_factor(20_000, 6, 1) == pytest.approx(300 / 20_000)
    assert wear_factor(10_000, 1, 1) == wear_factor(10_000, 3, 3) == 1.0  # every step sees every frame
