"""Depth whose scale changes from frame to frame: objects must not jump along the viewing axis."""

from dataclasses import replace

import numpy as np
import pytest

from genmojo_core.clip.clip import Clip
from genmojo_core.clip.synthetic import generate
from genmojo_core.clip.synthetic_specs import spec
from genmojo_core.estimate.complete import background_region, complete
from genmojo_core.estimate.depth_jitter import log_scales, without_jitter
from genmojo_core.optimise.motion import initial_motion


def clip_of(name: str, frames: int = 12, shapes: int = 3) -> Clip:
    base = spec(name)
    return generate(replace(base, shapes=base.shapes[:shapes], frames=frames, size=(112, 63), novel_every=0))[0]


def scaled(clip: Clip, log_factors: np.ndarray) -> Clip:
    value = clip.depth.value * np.exp(log_factors).astype(np.float32)[:, None, None]
    return clip.with_channels(depth=replace(clip.depth, value=value))


def jitter(frames: int, seed: int = 4) -> np.ndarray:
    return 0.04 * np.random.default_rng(seed).normal(size=frames)


@pytest.mark.parametrize("name", ["crossing-shapes", "moving-camera"])
@pytest.mark.parametrize("seed", [0, 1])
def test_jitter_is_found_to_a_thousandth_but_for_a_steady_drift(name, seed):
    clip = clip_of(name)
    factors = jitter(len(clip), seed)
    steady = without_jitter(scaled(clip, factors), background_region(clip))
    ratio = np.log(steady.depth.value / clip.depth.value).mean(axis=(1, 2))
    assert np.abs(np.diff(ratio, 2)).max() < 2e-3 < np.abs(np.diff(factors, 2)).max() / 20
    assert any("brought to rest" in guess for guess in steady.guesses)


def test_depth_that_does_not_jitter_is_left_alone():
    """Exact depth, a steady drift, and depth whose background nobody sees."""
    clip = clip_of("moving-camera")
    free = background_region(clip)
    assert without_jitter(clip, free) is clip
    drifting = scaled(clip, np.linspace(0, 0.3, len(clip)))
    assert without_jitter(drifting, free) is drifting
    unknown = scaled(clip, jitter(len(clip)))
    assert without_jitter(unknown, np.zeros_like(free)) is unknown


def test_a_third_of_wrong_background_depth_does_not_matter():
    clip = clip_of("crossing-shapes")
    factors, rng = jitter(len(clip)), np.random.default_rng(0)
    value = clip.depth.value * np.where(rng.random(clip.depth.value.shape) < 0.3, 1.7, 1.0).astype(np.float32)
    spoiled = scaled(clip.with_channels(depth=replace(clip.depth, value=value)), factors)
    found = log_scales(spoiled.depth, clip.cameras.value, background_region(clip))
    line = np.polyfit(np.arange(len(clip)), factors, 1)
    assert np.abs(found - (factors - np.polyval(line, np.arange(len(clip))))).max() < 0.01


def test_objects_do_not_jump_along_the_axis():
    """The initial motion of a ball and a cube: second differences of depth stay under 1 % of it."""

    def depths(clip: Clip) -> np.ndarray:  # (objects, T)
        poses = clip.cameras.value.world_to_camera
        paths = [motion.path.position for motion in initial_motion(clip)]
        return np.array([[(poses[t] @ [*p, 1])[2] for t, p in enumerate(path)] for path in paths])

    clip = clip_of("crossing-shapes", frames=8, shapes=2)
    shaken = scaled(clip, jitter(len(clip)))
    jumps = np.abs(np.diff(depths(complete(shaken)), 2)).max()
    assert jumps < 0.05, "1 % of the distance"
    assert np.abs(np.diff(depths(complete(shaken).with_channels(depth=shaken.depth)), 2)).max() > 5 * jumps
