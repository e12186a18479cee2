"""Masks from boxes and scribbles: cut, followed, hidden and found again; prompts that cannot be meant."""

import numpy as np
import pytest
from estimate_pictures import clip_of, squares, texture

from genmojo_core.errors import GenmojoError
from genmojo_core.estimate.flow import sequence_flow
from genmojo_core.estimate.masks import Box, Helpers, Scribble, masks_from_prompts
from genmojo_core.estimate.models import Models
from genmojo_core.estimate.objects import with_objects


def red_square(count=10, step=6, hidden=()):
    """A red textured square (24 px) crossing a grey-green scene; a grey post hides it in some frames."""
    rng = np.random.default_rng(0)
    scene = (texture(96, 120) * 0.3 + [40, 90, 60]).astype(np.uint8)
    body = np.clip(np.array([200, 30, 30]) + rng.normal(0, 25, (24, 24, 1)), 0, 255).astype(np.uint8)
    frames, labels = np.repeat(scene[None], count, axis=0), np.zeros((count, 96, 120), np.uint8)
    for t in range(count):
        x = 6 + step * t
        if t not in hidden:
            frames[t, 36:60, x : x + 24] = body
            labels[t, 36:60, x : x + 24] = 1
    return frames, labels


def iou(a, b):
    return (a & b).sum() / max(1, (a | b).sum())


def test_a_box_is_cut_and_followed_both_ways():
    frames, labels = red_square()
    box = Box(4, 2 * 27, 2 * 33, 2 * 57, 2 * 63)  # source is twice as large as the frames held
    found = masks_from_prompts(frames, [box], (240, 192))
    assert min(iou(found[t] == 1, labels[t] == 1) for t in range(len(frames))) > 0.9


def test_a_scribble_is_enough():
    frames, labels = red_square(count=4)
    stroke = Scribble(0, np.array([[10.0, 40], [24, 55]]))
    found = masks_from_prompts(frames, [stroke, Scribble(0, np.array([[60.0, 10]]), foreground=False)], (120, 96))
    assert iou(found[0] == 1, labels[0] == 1) > 0.85


def test_an_object_as_large_as_the_picture_is_followed():
    """More than 32,767 pixels, where OpenCV's remap of a row of places ends."""
    frames, labels, _ = squares(count=3, size=320, side=230, step=3)
    y, x = np.nonzero(labels[0])
    box = Box(0, float(x.min()), float(y.min()), float(x.max()), float(y.max()))
    found = masks_from_prompts(frames, [box], (320, 320))
    assert labels[0].sum() > 40_000
    assert min(iou(found[t] == 1, labels[t] == 1) for t in range(3)) > 0.7


def test_a_hidden_object_is_empty_and_found_when_it_returns():
    frames, labels = red_square(count=12, step=3, hidden=(5, 6, 7))
    found = masks_from_prompts(frames, [Box(0, 3, 33, 33, 63)], (120, 96))
    assert not found[6].any()
    assert iou(found[10] == 1, labels[10] == 1) > 0.8


def test_a_jump_that_flow_cannot_follow_is_followed():
    frames, labels = red_square(count=4, step=22)
    found = masks_from_prompts(frames, [Box(0, 3, 33, 33, 63)], (120, 96))
    assert min(iou(found[t] == 1, labels[t] == 1) for t in range(4)) > 0.8


def test_frames_without_a_mask_take_it_from_their_neighbours():
    frames, labels = red_square(count=6)
    clip = clip_of(frames, labels)
    valid = np.zeros(labels.shape, bool)
    valid[0] = True
    masks = clip.masks.__class__(np.where(valid, labels, 0).astype(np.uint8), valid, "given: first frame only")
    done = with_objects(clip.with_channels(masks=masks), (), lambda: sequence_flow(frames), Models())
    assert done.masks.valid.all() and done.masks.given and "5 of 6" in done.guesses[-1]
    assert min(iou(done.masks.value[t] == 1, labels[t] == 1) for t in range(6)) > 0.9


def test_a_box_on_a_flat_picture_still_gives_a_mask():
    frames = np.full((2, 40, 40, 3), 128, np.uint8)
    found = masks_from_prompts(frames, [Box(0, 10, 10, 30, 30)], (40, 40), Helpers(sequence_flow(frames)))
    assert found[0].any() and not found[0, :5].any()


def test_a_box_of_one_pixel_gives_one_object():
    frames, _, _ = squares(count=2)
    assert masks_from_prompts(frames, [Box(0, 5, 40, 6, 41)], (96, 96))[0].any()


@pytest.mark.parametrize(
    "prompt",
    [
        Box(9, 0, 0, 5, 5),
        Box(-1, 0, 0, 5, 5),
        Box(0, 5, 5, 5, 9),
        Box(0, 500, 500, 600, 600),
        Box(0, float("nan"), 0, 5, 5),
        Box(0, 0, 0, 5, 5, label=0),
        Box(0, 0, 0, 5, 5, label=300),
        Scribble(0, np.zeros((0, 2))),
        Scribble(0, np.array([[np.inf, 1.0]])),
    ],
)
def test_prompts_that_cannot_be_meant_are_refused_in_a_sentence(prompt):
    frames, _, _ = squares(count=2)
    with pytest.raises(GenmojoError) as fault:
        masks_from_prompts(frames, [prompt], (96, 96))
    assert fault.value.code == "argument"


def test_no_mask_and_no_box_is_said():
    frames, _, _ = squares(count=2)
    with pytest.raises(GenmojoError) as fault:
        with_objects(clip_of(frames), (), lambda: sequence_flow(frames), Models())
    assert fault.value.code == "empty"
