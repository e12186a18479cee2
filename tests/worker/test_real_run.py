"""The real optimiser as a worker, on a clip of a few small frames: from the first cloud to a scene, through a kill."""

from __future__ import annotations

import random
from dataclasses import replace

import numpy as np
import pytest

from genmojo_core.clip.synthetic import generate
from genmojo_core.clip.synthetic_files import write
from genmojo_core.clip.synthetic_specs import spec
from genmojo_core.store import scene_hdf5
from genmojo_studio.worker.protocol import RunRequest
from tests.optimise.small_runs import small_config
from tests.worker.driving import watched


@pytest.fixture(scope="module")
def clip_path(tmp_path_factory):
    folder = tmp_path_factory.mktemp("clip") / "small"
    made, truth = generate(replace(spec("crossing-shapes"), frames=5, size=(80, 45), tracks=4))
    write(made, truth, folder)
    return str(folder)


def request(clip_path, run_dir, **changes):
    config = small_config(lift_steps=10, joint_steps=4000, checkpoint_seconds=0.2, **changes).to_json()
    names = ("gaussians_per_object", "background_gaussians", "lift_steps", "joint_steps", "plane_resolution",
             "plane_channels", "field_width", "motion_bases", "densify_every", "neighbours", "short_side",
             "checkpoint_seconds")  # fmt: skip
    return RunRequest(
        clip_path, str(run_dir), "draft", {name: config[name] for name in names} | {"budget_seconds": 1e6}
    )


def test_cloud_pause_kill_resume_scene(clip_path, tmp_path):
    with watched(None) as window:
        window.client.start(request(clip_path, tmp_path))
        window.until(lambda: window.snapshots)
        first = window.snapshots[0]
        assert first.stage == "points" and first.T == 5 and {o.id for o in first.objects} >= {0, 1, 2}
        window.until(lambda: window.steps() >= 15)
        assert any(s.stage == "first scene" for s in window.snapshots)
        window.answer(window.client.pause())
        window.answer(window.client.look(4))
        window.answer(window.client.sweep())
        window.until(lambda: window.snapshots[-1].frames is not None and window.snapshots[-1].frame == 4)
        shown = window.snapshots[-1]
        again = shown.at(3).at(4)
        np.testing.assert_allclose(again.positions, shown.positions, atol=1e-5)
        np.testing.assert_allclose(again.scales, shown.scales, rtol=4e-3)
        assert window.answer(window.client.set_parameter("rates.means", 1e-3)) == (True, 1e-3)
        window.answer(window.client.checkpoint())
        at = window.steps()
        window.client.kill()
        window.until_state("failed")
        assert window.reports[-1].kind == "killed" and window.reports[-1].checkpoint
        window.client.resume_run(tmp_path)
        window.until_state("running")  # what was told before the kill is told again, so count from here
        told = window.steps()
        window.until(lambda: window.steps() >= told + 3)
        window.answer(window.client.stop(keep=True))
        window.until_state("done")
    scene = scene_hdf5.read(tmp_path / "scene.h5")
    assert scene.metrics["steps"] >= at + 1 and len(scene) == 5
    assert [(o.id, o.name) for o in scene.objects] == [(o.id, o.name) for o in window.snapshots[-1].objects]


def test_a_clip_that_is_none_is_told_in_one_sentence(tmp_path):
    (tmp_path / "clip").mkdir()
    with watched(None) as window:
        window.client.start(RunRequest(str(tmp_path / "clip"), str(tmp_path / "run"), "draft"))
        window.until(lambda: window.reports)
        (report,) = window.reports
        assert report.kind == "input" and "clip" in report.title and "Traceback" not in report.detail


@pytest.mark.slow
def test_killed_anywhere_it_can_go_on(clip_path, tmp_path):
    """The real optimiser killed at random moments of its life, checkpoints included, until it has finished."""
    dice = random.Random(1)
    folder = tmp_path / "run"
    with watched(None) as window:
        for _ in range(6):
            if window.reports and window.reports[-1].checkpoint:
                window.client.resume_run(folder)
            else:
                window.client.start(request(clip_path, folder))
            window.until_state("running")
            before, wait = window.steps(), dice.randint(1, 60)
            window.until(lambda before=before, wait=wait: window.steps() >= before + wait)
            window.client.kill()
            window.until_state("failed")
            assert window.reports[-1].kind == "killed"
        window.client.resume_run(folder)
        window.until(lambda: window.client.state == "running")
        window.answer(window.client.stop())
        window.until_state("done")
    assert scene_hdf5.validate(folder / "scene.h5") == []
