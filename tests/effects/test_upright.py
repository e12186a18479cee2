"""Stretching and leaning against what rigid bodies do: turning about the vertical, coming nearer, rolling.

Outlines and flow are exact, of a box under a linear map per frame. Not covered: flat things that tip.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from genmojo_core.clip.clip import Channel, Clip
from genmojo_core.effects.objects import describe
from genmojo_core.effects.occlusion import Cover
from genmojo_core.effects.upright import affine_change, roll
from tests.effects.test_effects import make_clip

SIDE, FRAMES = 128, 10


def box(shape_at: Callable[[float], np.ndarray]) -> Clip:
    """A box of 36 x 52 pixels under a (2, 2) map that depends on a phase 0..1, with the flow it implies."""
    y, x = np.mgrid[:SIDE, :SIDE] + 0.5 - SIDE / 2
    places = np.stack([x, y], axis=-1)
    maps = [shape_at(t / (FRAMES - 1)) for t in range(FRAMES)]
    labels, flow = np.zeros((FRAMES, SIDE, SIDE), np.uint8), np.zeros((FRAMES, SIDE, SIDE, 2), np.float32)
    for t in range(FRAMES):
        material = places @ np.linalg.inv(maps[t]).T
        labels[t] = (np.abs(material) < [18, 26]).all(axis=-1)
        flow[t] = material @ maps[min(t + 1, FRAMES - 1)].T - places
    clip = make_clip(np.zeros((1, FRAMES, 2)), (10,))
    depth = Channel(np.full(labels.shape, 5.0, np.float32), clip.masks.valid, "estimated: formula")
    return replace(clip, masks=replace(clip.masks, value=labels), flow=replace(clip.flow, value=flow), depth=depth)


def change(clip: Clip, covers: tuple[Cover, ...] = ()) -> float:
    return affine_change(clip, 0, describe(clip)[0], covers)


def turned(radians: float) -> np.ndarray:
    c, s = np.cos(radians), np.sin(radians)
    return np.array([[c, -s], [s, c]])


@pytest.mark.parametrize(
    "shape_at",
    [
        lambda p: np.diag([1 - 0.4 * p, 1.0]),  # turns about the vertical
        lambda p: np.eye(2) * (1 + 0.5 * p),  # comes nearer, and its depth does not say so
        lambda p: turned(1.2 * p),  # rolls
        lambda p: turned(-2.5 * p),
    ],
)
def test_what_rigid_bodies_do_is_no_change_of_shape(shape_at: Callable[[float], np.ndarray]) -> None:
    assert change(box(shape_at)) < 0.7


@pytest.mark.parametrize(
    "shape_at",
    [
        lambda p: np.diag([1.0, 1 + 0.2 * np.sin(2 * np.pi * p)]),  # stretches
        lambda p: np.array([[1.0, 0.3 * np.sin(2 * np.pi * p)], [0.0, 1.0]]),  # leans
        lambda p: np.array([[1 - 0.3 * p, 0.3 * np.sin(2 * np.pi * p)], [0.0, 1.0]]),  # leans as it turns
    ],
)
def test_stretching_and_leaning_are_seen(shape_at: Callable[[float], np.ndarray]) -> None:
    assert change(box(shape_at)) > 1.3


def test_frames_that_do_not_show_the_outline_whole_say_nothing() -> None:
    clip = box(lambda p: np.diag([1.0, 1 + 0.2 * np.sin(2 * np.pi * p)]))
    assert change(clip, (Cover(1, 0, tuple(range(1, FRAMES))),)) == 0.0
    assert change(clip, (Cover(0, 1, tuple(range(1, FRAMES))),)) > 1.3  # it is the one in front
    labels = clip.masks.value.copy()
    labels[1:] = 0
    assert change(replace(clip, masks=replace(clip.masks, value=labels))) == 0.0


def test_one_frame_that_is_wrong_is_not_a_change() -> None:
    clip = box(lambda p: np.eye(2))
    labels = clip.masks.value.copy()
    labels[4, :60] = 0
    assert change(replace(clip, masks=replace(clip.masks, value=labels))) < 0.7


def test_roll_is_the_turn_of_the_flow() -> None:
    clip = box(lambda p: turned(1.2 * p))
    assert roll(clip, clip.object_mask(0))[-1] == pytest.approx(1.2, abs=0.05)
    assert not roll(replace(clip, flow=None), clip.object_mask(0)).any()
