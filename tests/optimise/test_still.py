"""A background that stands still: held, drawn once, and the windows over it equal the joint splat of everything."""

from __future__ import annotations

import numpy as np
import pytest
import torch

from genmojo_core.clip.clip import Clip
from genmojo_core.config import LossWeights
from genmojo_core.events import Finished, Preview, StageStarted
from genmojo_core.optimise.objective import Objective
from genmojo_core.optimise.run import Run
from genmojo_core.optimise.still import StillObjective
from genmojo_core.optimise.targets import Window
from tests.optimise.small_runs import small_clip, small_run


@pytest.fixture(scope="module")
def clip() -> Clip:
    return small_clip(frames=4)


def ready(clip: Clip, **changes: object) -> Run:
    """A run up to its first optimiser step."""
    run = small_run(clip, **{"background_gaussians": 2500, **changes})
    next(e for e in run if isinstance(e, Preview) and e.stage == "motion")
    return run


def plain(run: Run) -> Objective:
    """The objective that draws everything in every frame, of the same scene."""
    still = run.objective
    return Objective(still.scene, still.targets, run.plan, still.weights, still.splat, still.tracks, still.count)


def close(a: torch.Tensor, b: torch.Tensor) -> bool:
    """Pictures are equal but for a rim here and there, where a Gaussian of the ground reaches before an object's."""
    gap = (a - b).detach().abs()
    return float(gap.mean()) < 1e-3 and float(gap.max()) < 0.2


def test_a_window_shows_what_the_joint_splat_shows_there(clip: Clip) -> None:
    run = ready(clip)
    assert isinstance(run.objective, StillObjective) and run.objective.held
    everything = plain(run)
    for t in range(len(clip)):
        whole = everything.picture(t, True)
        assert close(run.objective.picture(t, True), whole)
        now = run.scene.states([t], True)[0]
        [(target, seen)] = run.objective._compared([t], {t: now})
        rows, columns = target.window.slices()
        assert close(seen.features[..., :3], whole[rows, columns])
        assert bool((run.targets.frame(t).labels[rows, columns] > 0).sum() == (run.targets.frame(t).labels > 0).sum())


def test_loss_and_gradient_are_those_of_the_joint_splat(clip: Clip) -> None:
    """But for what the background outside the windows adds, which no object changes."""
    run = ready(clip)
    gradients, losses = [], []
    for objective in (run.objective, plain(run)):
        run.scene.zero_grad()
        outcome = objective.evaluate([1, 2], True, torch.Generator().manual_seed(0))
        outcome.loss.backward()
        gradients.append(torch.cat([o.gaussians.means.grad.flatten() for o in run.scene.objects]))
        losses.append(outcome)
    cosine = torch.nn.functional.cosine_similarity(gradients[0], gradients[1], dim=0)
    assert float(cosine) > 0.98
    assert float(gradients[0].norm() / gradients[1].norm()) == pytest.approx(1.0, abs=0.1)
    for (frame, psnr), (other, expected) in zip(losses[0].foreground, losses[1].foreground, strict=True):
        assert frame == other and psnr == pytest.approx(expected, abs=0.1)
    for (_, shown, wanted), (_, shown_all, wanted_all) in zip(losses[0].light, losses[1].light, strict=True):
        assert torch.allclose(wanted, wanted_all, atol=1e-5) and torch.allclose(shown, shown_all, atol=5e-3)


def test_the_background_is_fitted_to_its_plate_once_and_never_touched_again(clip: Clip) -> None:
    raw, settled = (ready(clip, settle_steps=steps) for steps in (0, 80))
    plate = torch.from_numpy(clip.background.value.astype(np.float32) / 255.0)
    errors = [float(((run.objective.backdrop().features - plate) ** 2).mean()) for run in (raw, settled)]
    assert errors[1] < 0.8 * errors[0]
    before = settled.scene.background.dc.detach().clone()
    assert isinstance(list(settled)[-1], Finished)
    assert torch.equal(before, settled.scene.background.dc.detach())
    assert all(p is not settled.scene.background.dc for g in settled.optimiser.param_groups for p in g["params"])


def test_a_background_that_was_fitted_lets_less_through(clip: Clip) -> None:
    runs = [ready(clip, settle_steps=80, weights=LossWeights(gaps=weight)) for weight in (0.0, 1.0)]
    without, closed = (float(((1.0 - run.objective.backdrop().alpha) ** 2).mean()) for run in runs)
    assert closed < 0.8 * without


def test_where_camera_or_light_changes_nothing_is_held() -> None:
    still = small_clip(frames=3)
    cases = [(small_clip("moving-camera", frames=3), {})]
    cases += [(still, {name: on}) for name, on in (("appearance_change", True), ("camera_motion", True),
                                                   ("background", False))]  # fmt: skip
    for clip, effects in cases:
        run = small_run(clip, effects)
        stages = []
        for event in run:
            if isinstance(event, StageStarted):
                stages.append(event.stage)
            if isinstance(event, Preview) and event.stage == "motion":
                break
        assert type(run.objective) is Objective and "background" not in stages


def test_a_resumed_run_goes_on_with_the_background_it_had(clip: Clip, tmp_path) -> None:
    first = small_run(clip, None, tmp_path)
    first.step_limit = 4
    list(first)
    second = small_run(clip, None, tmp_path, True)
    list(second)
    assert torch.equal(first.scene.background.dc.detach(), second.scene.background.dc.detach())


def test_targets_of_a_window_keep_their_places(clip: Clip) -> None:
    run = ready(clip)
    whole = run.targets.frame(1)
    cut = whole.cut(Window(8, 4, 40, 36))
    assert torch.equal(cut.rgb, whole.rgb[4:36, 8:40]) and cut.diagonal == whole.diagonal
    free = ((cut.labels == 0) * cut.seen).sum() + cut.beyond
    assert float(free) == float(((whole.labels == 0) * whole.seen).sum())
    assert cut.corner().tolist() == [8.0, 4.0] and whole.corner().tolist() == [0.0, 0.0]
