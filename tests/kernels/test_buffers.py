"""Reused arrays: never one that somebody still reads, and no fresh memory at every step."""

from __future__ import annotations

import numpy as np
import torch

from genmojo_core.kernels.buffers import LIMIT, take
from genmojo_core.render import autograd
from tests.render.scenes import camera, random_splats, run, upstream

SHAPE = (300, 200)


def test_an_array_comes_back_once_its_last_view_is_gone() -> None:
    array = take(SHAPE)
    place = array.ctypes.data
    view = torch.from_numpy(array[3:5].T)
    del array
    assert take(SHAPE).ctypes.data != place, "a view still looked at it"
    del view
    again = {id(a): a.ctypes.data for a in [take(SHAPE) for _ in range(8)]}
    assert place in again.values()


def test_arrays_held_at_once_are_different_and_of_the_asked_type() -> None:
    held = [take(SHAPE), take(SHAPE), take((150, 200), np.float64), take((4,), np.uint32)]
    for number, array in enumerate(held):
        array[...] = number
    assert [float(a.min()) for a in held] == [float(a.max()) for a in held] == [0, 1, 2, 3]
    assert [a.dtype for a in held] == [np.float32, np.float32, np.float64, np.uint32]


def test_huge_arrays_are_not_kept() -> None:
    assert take((LIMIT // 4 + 1,)).base is None


def test_pictures_survive_the_pictures_drawn_after_them() -> None:
    view = camera(200, 180)
    first, gradients = run(autograd.splat, random_splats(300, 7, 0), view, upstream(view, 7), detached_channels=2)
    kept = first.features.clone(), gradients["means"].clone()
    for seed in range(1, 4):
        run(autograd.splat, random_splats(300, 7, seed), view, upstream(view, 7), detached_channels=2)
    assert torch.equal(first.features, kept[0])
    assert torch.equal(gradients["means"], kept[1])
