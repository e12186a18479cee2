"""The plate behind objects: exact where seen, painted and said so where not, carried by moving cameras."""

import numpy as np
import pytest
from estimate_pictures import squares, texture

from genmojo_core.clip.cameras import Cameras
from genmojo_core.estimate.background import fill_smoothly, make_plate, masked_median, paint, plate_depth

LENS = np.array([[100.0, 0, 48], [0, 100, 48], [0, 0, 1]])


def rig(poses):
    return Cameras(np.tile(LENS, (len(poses), 1, 1)), np.stack(poses), (96, 96))


def test_the_plate_behind_a_moving_square_is_exact():
    frames, labels, background = squares(count=12, step=5)
    color, seen = make_plate(frames, labels == 0, rig([np.eye(4)] * 12), np.full((96, 96), 3.0, np.float32))
    assert seen.all()
    assert np.abs(color.astype(int) - background).max() <= 1


def test_a_fading_light_leaves_the_plate_as_bright_as_its_frame():
    frames, labels, background = squares(count=10, step=5)
    light = np.linspace(1.0, 0.4, 10)[:, None, None, None]
    dim = (background * 0.8 + 20).astype(np.uint8)
    faded = np.where(labels[..., None] > 0, frames, (dim * light).astype(np.uint8)).astype(np.uint8)
    color, seen = make_plate(faded, labels == 0, rig([np.eye(4)] * 10), np.full((96, 96), 3.0, np.float32))
    assert seen.all() and np.abs(color.astype(int) - dim).mean() < 3


def test_never_seen_pixels_are_painted_and_marked():
    frames, labels, background = squares(count=4, step=0)
    color, seen = make_plate(frames, labels == 0, rig([np.eye(4)] * 4), np.full((96, 96), 3.0, np.float32))
    assert np.array_equal(seen, labels[0] == 0)
    assert np.array_equal(color[seen], background[seen])
    inside = color[labels[0] > 0].astype(float)
    assert np.abs(inside.mean(axis=0) - background.reshape(-1, 3).mean(axis=0)).max() < 60


def test_a_sliding_camera_shows_what_frame_0_hid():
    wall, depth = texture(96, 200), 5.0
    poses, frames = [], []
    for t in range(5):
        pose = np.eye(4)
        pose[0, 3] = -6 * t * depth / 100  # 6 pixels a frame
        poses.append(pose)
        frames.append(wall[:, 20 + 6 * t : 116 + 6 * t].copy())
    free = np.ones((5, 96, 96), bool)
    free[:, 30:60, 40:52] = False  # an object that stays put in the picture
    for frame in frames:
        frame[30:60, 40:52] = 0
    color, seen = make_plate(np.stack(frames), free, rig(poses), np.full((96, 96), depth, np.float32))
    assert seen.all()
    assert np.abs(color.astype(int) - wall[:, 20:116])[:, 2:-2].mean() < 1.0


def test_depth_of_the_plate_is_the_median_and_smooth_behind_objects():
    depth, free = np.full((3, 96, 96), 7.0, np.float32), np.ones((3, 96, 96), bool)
    depth[:, 40:50, 40:50], free[:, 40:50, 40:50] = 2.0, False
    depth[1, 0, 0] = 100.0
    plane, seen = plate_depth(depth, np.ones(depth.shape, bool), free, rig([np.eye(4)] * 3))
    assert np.allclose(plane, 7.0) and not seen[45, 45] and seen[0, 0]


def test_depth_moves_with_a_camera_that_walks_forward():
    poses = [np.eye(4), np.eye(4)]
    poses[1] = poses[1].copy()
    poses[1][2, 3] = -1.0
    depth = np.stack([np.full((96, 96), 5.0), np.full((96, 96), 4.0)]).astype(np.float32)
    free = np.stack([np.zeros((96, 96), bool), np.ones((96, 96), bool)])
    plane, seen = plate_depth(depth, np.ones(depth.shape, bool), free, rig(poses))
    assert seen.mean() > 0.5 and np.allclose(plane, 5.0, atol=1e-4)


def test_nothing_known_is_still_a_picture():
    unknown = np.ones((20, 30), bool)
    assert (paint(np.zeros((20, 30, 3), np.uint8), unknown) == 128).all()
    assert (fill_smoothly(np.zeros((5, 7), np.float32), np.zeros((5, 7), bool)) == 1).all()
    assert fill_smoothly(np.full((1, 1), 3.0, np.float32), np.ones((1, 1), bool))[0, 0] == 3


@pytest.mark.parametrize("values, expected", [([1, 9, 4], 4), ([1, 3, np.nan, np.nan], 2), ([np.nan, 5], 5)])
def test_median_of_what_is_known(values, expected):
    assert masked_median(np.array(values, np.float32)[:, None])[0] == expected


def test_median_of_nothing_is_zero():
    assert masked_median(np.full((3, 1), np.nan, np.float32))[0] == 0
