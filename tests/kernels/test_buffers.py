"""Reused arrays: never one that somebody still reads, and no fresh memory at every step."""

from __future__ import annotations

import numpy as np
import torch

from genmojo_core.kernels.buffers import LIMIT, LINE, take, take_together
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


def test_arrays_of_one_block_lie_apart_and_keep_it_together() -> None:
    wanted = (((300, 70), np.float32), ((0,), np.int64), ((5,), np.int64), ((20_001,), np.uint32))
    *held, block = take_together(*wanted)
    block[:] = 0
    for number, array in enumerate(held):
        array[...] = number + 1
    assert [(a.shape, a.dtype) for a in held] == list(wanted)
    assert [set(a.ravel().tolist()) for a in held] == [{1}, set(), {3}, {4}]
    assert all(a.ctypes.data % LINE == 0 and a.flags.c_contiguous and a.flags.writeable for a in held)
    place, last = block.ctypes.data, held.pop()
    del held, block, array
    others = [take_together(*wanted) for _ in range(8)]
    assert place not in [one[-1].ctypes.data for one in others], "one of them was still held"
    del last, others
    assert place in [one[-1].ctypes.data for one in [take_together(*wanted) for _ in range(8)]]


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
