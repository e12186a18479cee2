"""Shading: a ball that turns under a light that stands still keeps the colours of its surface; unlit, it has none.

The light of the procedural clip is known (ambient and one direction), so what is measured can be told from its formula.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import torch

from genmojo_core.clip import shapes, synthetic
from genmojo_core.clip.clip import Clip
from genmojo_core.clip.synthetic_specs import BALL, SyntheticSpec
from genmojo_core.conventions import harmonics as plain_harmonics
from genmojo_core.conventions import shade_factors
from genmojo_core.effects import decide
from genmojo_core.estimate.complete import complete
from genmojo_core.events import EffectChanged, Preview
from genmojo_core.measure.reconstruction import reconstruction
from genmojo_core.optimise.run import Run
from genmojo_core.scene.shading import TERMS, Shade, fitted, harmonics
from tests.optimise.small_runs import small_config


def unit(count: int, seed: int) -> np.ndarray:
    normals = np.random.default_rng(seed).normal(size=(count, 3))
    return normals / np.linalg.norm(normals, axis=1, keepdims=True)


def ball(light: float = 1.0, spin: float = 100.0) -> Clip:
    shape = replace(BALL, path=((-0.4, -0.5, 0.5), (0.4, -0.5, 0.5)), spin=spin)
    made, _ = synthetic.generate(SyntheticSpec("ball", (shape,), size=(112, 64), frames=8, light=(light, light)))
    return complete(made)


def begun(clip: Clip, **effects: bool) -> tuple[Run, list[EffectChanged]]:
    """A run up to its first step, and the effects that were switched on the way."""
    config = small_config(gaussians_per_object=400, joint_steps=30, lift_steps=10)
    run = Run(clip, decide.plan(clip, config, effects), config)
    changed = []
    for event in run:
        changed += [event] if isinstance(event, EffectChanged) else []
        if isinstance(event, Preview) and event.stage == "motion":
            break
    return run, changed


@pytest.fixture(scope="module")
def lit() -> Run:
    return begun(ball())[0]


def test_harmonics_and_factors_are_the_same_in_both_forms() -> None:
    before, now = unit(50, 0), unit(50, 1)
    light = np.random.default_rng(2).normal(size=TERMS) * 0.2
    tensors = [torch.from_numpy(n).float() for n in (before, now)]
    assert np.allclose(harmonics(tensors[1]).numpy(), plain_harmonics(now), atol=1e-5)
    factors = Shade(torch.from_numpy(light))(*tensors)
    assert factors.shape == (50, 1)
    assert np.allclose(factors.detach().numpy()[:, 0], shade_factors(before, now, light), rtol=1e-4)
    assert torch.allclose(Shade()(*tensors), torch.ones(50, 1))


def test_the_fit_finds_the_light_among_stray_places() -> None:
    light = np.random.default_rng(3).normal(size=TERMS) * 0.3
    change = torch.from_numpy(plain_harmonics(unit(800, 4)) - plain_harmonics(unit(800, 5)))
    ratio = change @ torch.from_numpy(light)
    ratio[:80] += 2.0  # other things came by
    found = fitted([change[:300], change[300:]], [ratio[:300], ratio[300:]])
    assert found is not None and np.abs(found.numpy() - light).max() < 0.1 * np.abs(light).max()
    assert fitted([change[:10]], [ratio[:10]]) is None


def test_a_ball_turning_under_a_light_gets_its_shading(lit: Run) -> None:
    assert lit.plan.on("shading") and lit.scene.shade is not None
    # Turning about the vertical says nothing about above and below: a level ring of normals that face the camera.
    around = np.deg2rad(np.linspace(200, 340, 60))
    towards = np.stack([np.cos(around), np.sin(around), np.full(60, 0.3)], axis=1)
    towards /= np.linalg.norm(towards, axis=1, keepdims=True)
    bright = shapes.AMBIENT + (1 - shapes.AMBIENT) * np.maximum(towards @ shapes.LIGHT, 0)
    told = plain_harmonics(towards) @ lit.scene.shade.shade.detach().numpy()
    assert np.corrcoef(np.log(bright), told)[0, 1] > 0.8


def test_shading_counts_as_light_and_not_as_colours_of_their_own(lit: Run) -> None:
    list(lit)
    found = reconstruction(lit.bake(), lit.clip)
    assert abs(found["color_share_db"]) < 0.2 and found["light_share_db"] > 0.5


@pytest.mark.parametrize("clip, on", [(ball(light=0.0), True), (ball(spin=2.0), False)])
def test_without_light_or_turning_there_is_none(clip: Clip, on: bool) -> None:
    """By ambient light alone a ball turns and shows it (the plan), but its normals explain nothing (the run)."""
    assert decide.plan(clip, small_config()).on("shading") is on
    run, changed = begun(clip)
    assert run.scene.shade is None and not run.plan.on("shading")
    assert [event.effect for event in changed if not event.on] == (["shading"] if on else [])
    assert begun(clip, shading=True)[0].scene.shade is not None  # the person's word
