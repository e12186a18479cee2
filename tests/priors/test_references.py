"""References from clips: crop rule at any aspect ratio, the space in the world, what hides, when a frame is off."""

import numpy as np
import pytest

from genmojo_core.clip.cameras import Cameras
from genmojo_core.clip.clip import Channel, Clip
from genmojo_core.priors.generator import FILL, FRONT
from genmojo_core.priors.references import SIDE, reference_of, visible_share
from genmojo_core.priors.solids import HALF_EXTENT


def clip_with(boxes, size=(120, 80), depths=(4.0, 2.0), frames=1, focal=100.0):
    """Boxes (x0, y0, x1, y1) of objects 1, 2 ... in every frame, later ones drawn over earlier ones."""
    width, height = size
    labels = np.zeros((frames, height, width), np.uint8)
    depth = np.full((frames, height, width), 9.0, np.float32)
    for k, (x0, y0, x1, y1) in enumerate(boxes):
        labels[:, y0:y1, x0:x1] = k + 1
        depth[:, y0:y1, x0:x1] = depths[k]
    pose = np.tile(np.eye(4), (frames, 1, 1))
    K = np.tile(np.array([[focal, 0, width / 2], [0, focal, height / 2], [0, 0, 1]]), (frames, 1, 1))
    everywhere = np.ones(labels.shape, bool)
    images = np.zeros((*labels.shape, 3), np.uint8)
    images[labels == 1] = (200, 100, 50)
    return Clip(
        "boxes", "procedural", images, np.arange(frames), np.arange(frames) / 24.0, ("a",) * frames, size,
        object_ids=np.arange(1, len(boxes) + 1), object_names=tuple(f"object {k + 1}" for k in range(len(boxes))),
        masks=Channel(labels, everywhere, "given: test"), depth=Channel(depth, everywhere.copy(), "given: test"),
        cameras=Channel(Cameras(K, pose, size), np.ones(frames, bool), "given: test"),
    )  # fmt: skip


@pytest.mark.parametrize("box", [(50, 30, 70, 50), (10, 20, 60, 40), (90, 10, 110, 70)])
@pytest.mark.parametrize("size", [(120, 80), (80, 120), (100, 100)])
def test_the_longer_side_fills_65_percent_and_the_object_is_centred(box, size):
    x1, y1 = min(box[2], size[0] - 3), min(box[3], size[1] - 3)
    box = (min(box[0], x1 - 15), box[1], x1, y1)
    alpha = reference_of(clip_with([box], size), (0,), 0).reference.picture[3].numpy()
    rows, columns = np.nonzero(alpha > 0.5)
    extent = np.array([np.ptp(columns) + 1, np.ptp(rows) + 1]) / SIDE
    assert extent.max() == pytest.approx(FILL, abs=0.03)
    assert (rows.min() + rows.max() + 1) / 2 == pytest.approx(SIDE / 2, abs=6)
    assert (columns.min() + columns.max() + 1) / 2 == pytest.approx(SIDE / 2, abs=6)


def test_the_space_lies_where_the_pixels_and_the_depth_say():
    placed = reference_of(clip_with([(50, 30, 70, 50)]), (0,), 0)
    distance = placed.reference.distance
    assert distance == pytest.approx(HALF_EXTENT * 100 * FILL / 10, rel=0.01)
    front = placed.to_world @ np.array([0.0, 0.0, -FRONT, 1.0])
    np.testing.assert_allclose(front[:3], [0, 0, 4.0], atol=1e-3)
    corner = FILL * HALF_EXTENT * (distance - FRONT) / distance
    edge = placed.to_world @ np.array([corner, 0.0, -FRONT, 1.0])
    assert edge[0] / edge[2] * 100 == pytest.approx(10, abs=0.05), "the box's edge is where its pixels end"
    known = placed.reference.known.numpy() > 0
    np.testing.assert_allclose(placed.reference.depth.numpy()[known], -FRONT, atol=1e-3)
    assert placed.reference.elevation == pytest.approx(0.0, abs=1e-6)


def test_nearer_objects_hide_and_farther_ones_do_not():
    boxes = [(40, 30, 80, 50), (60, 20, 70, 60)]
    hidden = reference_of(clip_with(boxes), (0,), 0).reference.hidden
    assert hidden.sum() > 0
    assert not (hidden * (reference_of(clip_with(boxes), (0,), 0).reference.picture[3] > 0.99)).any()
    assert reference_of(clip_with(boxes, depths=(4.0, 6.0)), (0,), 0).reference.hidden.sum() == 0


def test_visible_share_falls_with_what_is_hidden():
    clip = clip_with([(40, 30, 80, 50), (0, 0, 1, 1)], frames=3)
    clip.masks.value[1, 30:50, 50:80] = 2
    clip.depth.value[1, 30:50, 50:80] = 2.0
    assert visible_share(clip, 0, 0) == 1.0
    assert visible_share(clip, 0, 1) == pytest.approx(0.25, abs=0.02)


@pytest.mark.parametrize(
    ("box", "why"),
    [((0, 0, 0, 0), "does not show"), ((50, 40, 51, 41), "smaller"), ((50, 40, 58, 44), "smaller"),
     ((0, 0, 60, 60), "two sides")],
)  # fmt: skip
def test_frames_that_cannot_be_references_say_why(box, why):
    assert why in reference_of(clip_with([box]), (0,), 0)


def test_several_objects_make_one_reference():
    both = reference_of(clip_with([(20, 30, 40, 50), (70, 30, 100, 50)]), (0, 1), 0)
    columns = np.flatnonzero((both.reference.picture[3] > 0.5).any(dim=0).numpy())
    assert np.ptp(columns) + 1 == pytest.approx(FILL * SIDE, abs=6) and both.reference.hidden.sum() == 0


def test_no_depth_no_reference():
    clip = clip_with([(40, 30, 80, 50)])
    clip.depth.valid[:] = False
    assert "depth" in reference_of(clip, (0,), 0)
