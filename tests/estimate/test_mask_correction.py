"""Corrections of masks on a clip with exact truth: two bodies of other colours that move over a third.

How far they help on real clips depends on the pictures; see what `masks.py` measures for cutting out.
"""

import numpy as np
import pytest

from genmojo_core.errors import GenmojoError
from genmojo_core.estimate.flow import sequence_flow
from genmojo_core.estimate.mask_correction import correct_masks, corrected
from genmojo_core.estimate.masks import Box, Drawing, Helpers, Scribble

T, H, W = 9, 90, 160
SIZE = (2 * W, 2 * H)  # prompts are in pixels of a source of twice the size


@pytest.fixture(scope="module")
def clip():
    """Frames, the two bodies' masks (T, H, W), flow. The bodies touch; both go 2 px to the right per frame."""
    rng = np.random.default_rng(3)
    frames = np.zeros((T, H, W, 3), np.float32)
    frames[:] = (60, 110, 60) + rng.normal(0, 8, (H, W, 1))
    pictures = [np.array(colour) + rng.normal(0, 10, (30, 30, 1)) for colour in ((200, 60, 50), (60, 80, 210))]
    masks = np.zeros((2, T, H, W), bool)
    for t in range(T):
        for k, picture in enumerate(pictures):
            x = 20 + 30 * k + 2 * t
            frames[t, 30:60, x : x + 30] = picture
            masks[k, t, 30:60, x : x + 30] = True
    frames = frames.clip(0, 255).astype(np.uint8)
    return frames, masks[0], masks[1], Helpers(sequence_flow(frames))


def overlap(one, other):
    return (one & other).sum() / (one | other).sum()


def stroke(t, x, on, y=45.0):
    """Drawn through the middle of the bodies, in frame t's own pixels."""
    return Scribble(t, 2 * np.array([[x - 8.0, y], [x + 8.0, y]]), on)


def test_a_stroke_takes_what_is_not_part_of_it_out_of_every_frame(clip):
    frames, one, other, helpers = clip
    fixed = correct_masks(frames, one | other, [stroke(4, 73, False)], SIZE, helpers=helpers)
    assert overlap(fixed[4], one[4]) > 0.95
    assert min(overlap(fixed[t], one[t]) for t in range(T)) > 0.9
    assert overlap(one | other, one) < 0.55, "so there was something to put right"


def test_a_stroke_adds_what_was_missing_in_every_frame(clip):
    frames, one, other, helpers = clip
    fixed = correct_masks(frames, one, [stroke(4, 73, True)], SIZE, helpers=helpers)
    assert min(overlap(fixed[t], (one | other)[t]) for t in range(T)) > 0.9


def test_box_and_strokes_of_one_frame_count_together(clip):
    frames, one, other, helpers = clip
    box = Box(4, 2 * 26.0, 2 * 28.0, 2 * 92.0, 2 * 62.0)
    fixed = correct_masks(frames, np.zeros_like(one), [box, stroke(4, 73, False)], SIZE, helpers=helpers)
    assert min(overlap(fixed[t], one[t]) for t in range(T)) > 0.9


def test_a_fault_of_one_frame_is_put_right_there_alone(clip):
    frames, one, other, helpers = clip
    wrong = one.copy()
    wrong[4] |= other[4]
    fixed = correct_masks(frames, wrong, [stroke(4, 73, False)], SIZE, helpers=helpers)
    assert overlap(fixed[4], one[4]) > 0.95
    np.testing.assert_array_equal(np.delete(fixed, 4, 0), np.delete(one, 4, 0))


def test_frames_drawn_before_and_what_is_beyond_them_stay(clip):
    frames, one, other, helpers = clip
    both = one | other
    fixed = correct_masks(frames, both, [stroke(4, 73, False)], SIZE, drawn=(2, 6), helpers=helpers)
    assert all(overlap(fixed[t], one[t]) > 0.9 for t in (3, 4, 5))
    for t in (0, 1, 2, 6, 7, 8):
        np.testing.assert_array_equal(fixed[t], both[t])


def test_an_object_lost_on_the_way_is_found_by_a_box_and_what_was_right_stays(clip):
    frames, one, _, helpers = clip
    lost = one.copy()
    lost[4:] = False
    x = 20 + 2 * 6
    box = Box(6, 2 * (x - 2.0), 2 * 28.0, 2 * (x + 32.0), 2 * 62.0)
    fixed = correct_masks(frames, lost, [box], SIZE, helpers=helpers)
    np.testing.assert_array_equal(fixed[:4], one[:4])
    assert min(overlap(fixed[t], one[t]) for t in range(4, T)) > 0.85


def test_a_box_does_not_bring_in_what_merely_looks_alike():
    rng = np.random.default_rng(5)
    frame = np.zeros((H, W, 3), np.float32) + (60, 110, 60) + rng.normal(0, 8, (H, W, 1))
    twins = np.zeros((2, H, W), bool)
    twins[0, 30:60, 20:50] = twins[1, 30:60, 80:110] = True
    frame[twins.any(axis=0)] = np.array((200, 60, 50)) + rng.normal(0, 8, (int(twins.sum()), 1))
    half = twins[0].copy()
    half[45:] = False
    nothing = np.zeros((H, W), bool)
    box = Drawing(np.array([15.0, 25.0, 115.0, 65.0]), nothing, nothing)
    found = corrected(frame.clip(0, 255).astype(np.uint8), half, box)
    assert overlap(found, twins[0]) > 0.9 and not (found & twins[1]).any()


def test_a_prompt_outside_the_frame_is_refused(clip):
    frames, one, _, helpers = clip
    with pytest.raises(GenmojoError, match="no area inside"):
        correct_masks(frames, one, [Box(0, -50.0, 10.0, -5.0, 40.0)], SIZE, helpers=helpers)
