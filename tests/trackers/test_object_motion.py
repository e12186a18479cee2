"""Links between frames that are far apart."""

import cv2
import numpy as np
import pytest

from genmojo_core.trackers.object_motion import ObjectMotion
from genmojo_core.trackers.stabilise import Layer

STEP, FRAMES = 22.0, 12  # px per frame: over eight frames twice the size of the object


@pytest.fixture(scope="module")
def fast() -> ObjectMotion:
    """A textured square of 90 px that flies through a picture of 480 x 160, and is not seen in frame 5."""
    rng = np.random.default_rng(0)
    texture = cv2.GaussianBlur(rng.integers(0, 256, (90, 90)).astype(np.uint8), (0, 0), 2.0)
    texture = cv2.normalize(texture, None, 20, 235, cv2.NORM_MINMAX)
    shade, mask = np.full((FRAMES, 160, 480), 128, np.uint8), np.zeros((FRAMES, 160, 480), bool)
    for t in range(FRAMES):
        x = 10 + round(STEP * t)
        if t != 5:
            shade[t, 35:125, x : x + 90], mask[t, 35:125, x : x + 90] = texture, True
    return ObjectMotion(Layer(shade, mask, np.zeros_like(mask)))


@pytest.mark.parametrize(("s", "t"), [(0, 8), (8, 0), (1, 9), (0, 6), (6, 0), (11, 3), (4, 6), (6, 4), (2, 1)])
def test_a_link_over_many_frames_begins_where_shorter_ones_lead(fast: ObjectMotion, s: int, t: int) -> None:
    places = np.array([[55.0, 80.0], [40.0, 60.0], [75.0, 100.0]]) + [STEP * s, 0.0]
    carried, weight, _ = fast.carry(s, t, places)
    assert np.abs(carried - places - [STEP * (t - s), 0.0]).max() < 0.5
    assert weight.min() > 0.5


def test_nothing_leads_to_a_frame_that_does_not_show_the_object(fast: ObjectMotion) -> None:
    assert fast.carry(4, 5, np.zeros((1, 2))) is None and fast.path(5, 8) is None
