"""Camera motion: still is still, a turn is that turn, a move with depth is that move, oblong pixels."""

import cv2
import numpy as np
import pytest
from estimate_pictures import clip_of, squares, texture

from genmojo_core.estimate import bundle
from genmojo_core.estimate.background_points import PointPaths, drift, even_light, follow_background
from genmojo_core.estimate.bundle import Bundle, errors
from genmojo_core.estimate.cameras import Believed, default_intrinsics, estimate_cameras, solve_motion

K = np.array([[200.0, 0, 80], [0, 200, 60], [0, 0, 1]])
SIZE = (160, 120)


def no_depth(count, z=4.0):
    plane = np.full((count, SIZE[1], SIZE[0]), z, np.float32)
    return Believed(plane, np.zeros(plane.shape, bool))


def seen_through(homography, picture):
    """The picture, known in pixels of camera 0 with a margin of 100, through a homography of camera 0's pixels."""
    shift = np.array([[1, 0, 100.0], [0, 1, 100], [0, 0, 1]])
    half = np.array([[1, 0, 0.5], [0, 1, 0.5], [0, 0, 1]])
    index = np.linalg.inv(half) @ homography @ half @ np.linalg.inv(shift)
    return cv2.warpPerspective(picture, index, SIZE, flags=cv2.INTER_CUBIC)


def turn(degrees_x, degrees_y):
    return cv2.Rodrigues(np.deg2rad([degrees_x, degrees_y, 0.0]))[0]


def test_a_still_camera_is_still_though_an_object_moves_and_light_fades():
    frames, labels, _ = squares(count=6, size=128)
    faded = np.stack([(frame * (1 - 0.1 * t)).astype(np.uint8) for t, frame in enumerate(frames)])
    lens = default_intrinsics(clip_of(frames, labels))
    plane = np.ones(labels.shape, np.float32)
    found = estimate_cameras(faded, labels == 0, lens, Believed(plane, labels > 9))
    assert found.kind == "still" and found.valid.all()
    assert np.array_equal(found.cameras.world_to_camera, np.tile(np.eye(4), (6, 1, 1)))


def test_a_turning_camera_gives_its_rotation():
    picture = texture(SIZE[1] + 200, SIZE[0] + 200)
    turns = [turn(0.4 * t, -0.9 * t) for t in range(6)]
    frames = np.stack([seen_through(K @ r @ np.linalg.inv(K), picture) for r in turns])
    found = estimate_cameras(frames, np.ones(frames.shape[:3], bool), K, no_depth(6))
    assert found.kind == "turning"
    for pose, truth in zip(found.cameras.world_to_camera, turns, strict=True):
        angle = np.rad2deg(np.linalg.norm(cv2.Rodrigues(pose[:3, :3] @ truth.T)[0]))
        assert angle < 0.05
        assert not pose[:3, 3].any()


def moving_scene(count):
    """Frames of a slanted plane seen by a camera that slides and turns, its depth, and the true poses."""
    normal, offset = np.array([0.0, 0.5, 1.0]), 4.0
    picture = texture(SIZE[1] + 200, SIZE[0] + 200, seed=3)
    frames, depths, poses = [], [], []
    x, y = np.meshgrid(np.arange(SIZE[0]) + 0.5, np.arange(SIZE[1]) + 0.5)
    ray = np.stack([(x - 80) / 200, (y - 60) / 200, np.ones_like(x)], -1)
    for t in range(count):
        pose = np.eye(4)
        pose[:3, :3], pose[:3, 3] = turn(0, 0.5 * t), [-0.06 * t, 0.01 * t, 0.03 * t]
        plane_map = pose[:3, :3] + np.outer(pose[:3, 3], normal) / offset
        frames.append(seen_through(K @ plane_map @ np.linalg.inv(K), picture))
        n = pose[:3, :3] @ normal
        depths.append((offset + n @ pose[:3, 3]) / (ray @ n))
        poses.append(pose)
    return np.stack(frames), np.stack(depths).astype(np.float32), poses


def test_a_moving_camera_with_depth_gives_its_pose():
    frames, depth, poses = moving_scene(6)
    found = estimate_cameras(frames, np.ones(depth.shape, bool), K, Believed(depth, np.ones(depth.shape, bool)))
    assert found.kind == "moving"
    for pose, truth in zip(found.cameras.world_to_camera, poses, strict=True):
        assert np.abs(pose[:3, 3] - truth[:3, 3]).max() < 0.02
        assert np.rad2deg(np.linalg.norm(cv2.Rodrigues(pose[:3, :3] @ truth[:3, :3].T)[0])) < 0.3


@pytest.mark.parametrize("focal_error", [1.0, 1.5])
def test_parallax_alone_gives_the_path_up_to_scale_and_the_focal_length(focal_error):
    rng = np.random.default_rng(1)
    n, t = 150, 9
    points = np.column_stack([rng.uniform(-2, 2, (n, 2)), rng.uniform(3, 8, n)])
    poses = np.tile(np.eye(4), (t, 1, 1))
    for f in range(t):
        poses[f, :3, :3], poses[f, :3, 3] = turn(0.3 * f, -2 * f), [0.2 * f, 0.02 * f, 0.05 * np.sin(f)]
    here = np.einsum("tij,nj->nti", poses, np.column_stack([points, np.ones(n)]))[..., :3]
    xy = here[..., :2] / here[..., 2:] * 200 + [80, 60]
    lens = K @ np.diag([1 / focal_error, 1 / focal_error, 1])
    found, kind = solve_motion(PointPaths(xy, np.zeros(n, int)), lens, no_depth(t, 5.0))
    assert kind == "moving" and np.median(errors(found)) < 0.05
    assert found.lens()[0, 0] == pytest.approx(200, rel=0.08)
    centres, truth = (np.array([-p[:3, :3].T @ p[:3, 3] for p in group]) for group in (found.poses, poses))
    scale = np.linalg.norm(centres[-1]) / np.linalg.norm(truth[-1])
    assert np.abs(centres / scale - truth).max() < 0.06 * np.linalg.norm(truth[-1])
    assert np.corrcoef(found.log_depth, np.log(points[:, 2]))[0, 1] > 0.98


def test_derivatives_of_the_bundle_are_those_of_its_residuals():
    rng = np.random.default_rng(2)
    n, t, start = 30, 4, rng.integers(0, 2, 30)
    point, frame = np.nonzero(np.arange(t) > start[:, None])
    pixels = rng.uniform(10, 110, (n, t, 2))
    poses = np.tile(np.eye(4), (t, 1, 1))
    poses[:, :3, 3] = rng.normal(0, 0.1, (t, 3))
    flat = np.log(np.full(n, 5.0))
    state = Bundle(poses, K, flat, start, pixels[:, 0], point, frame, pixels[point, frame], flat, np.full(n, 0.7))
    linear, step = bundle._linearise(state), 1e-6
    turned, deeper = rng.normal(size=(t, 6)), rng.normal(size=n)
    moved = bundle._moved(state, step * turned, step * deeper, step)
    slope = (bundle._linearise(moved).residual - linear.residual) / step
    expected = np.einsum("mki,mi->mk", linear.by_pose, turned[frame]) + linear.by_depth * deeper[point][:, None]
    expected += np.einsum("mki,mi->mk", linear.by_start, turned[start[point]]) + linear.by_focal
    assert np.abs(slope - expected).max() < 0.01


def test_a_camera_whose_background_is_all_hidden_stays_where_it_was():
    frames = np.stack([texture(64, 64, t) for t in range(4)])
    plane = np.ones((4, 64, 64), np.float32)
    found = estimate_cameras(frames, np.zeros((4, 64, 64), bool), np.diag([60.0, 60, 1]), Believed(plane, plane > 2))
    assert found.kind == "still" and found.valid.tolist() == [True, False, False, False]
    assert np.isfinite(found.cameras.world_to_camera).all()


@pytest.mark.parametrize("count", [1, 2])
def test_one_and_two_frames(count):
    frames = np.repeat(texture(64, 80)[None], count, axis=0)
    plane = np.ones(frames.shape[:3], np.float32)
    found = estimate_cameras(frames, plane > 0, np.diag([60.0, 60, 1]), Believed(plane, plane > 2))
    assert found.kind == "still" and len(found.cameras) == count


def test_oblong_pixels_get_two_focal_lengths():
    clip = clip_of(np.zeros((1, 512, 512, 3), np.uint8)).with_channels(pixel_aspect=854 / 480)
    lens = default_intrinsics(clip)
    assert lens[1, 1] == pytest.approx(256 * 854 / 480 / np.tan(np.deg2rad(49.1 / 2)))
    assert lens[0, 0] == pytest.approx(lens[1, 1] / (854 / 480))
    assert lens[0, 2] == 256 and lens[1, 2] == 256


def test_points_follow_a_pan_without_drift():
    picture = texture(120, 260)
    frames = np.stack([picture[:, 6 * t : 6 * t + 160] for t in range(12)])
    moved = drift(follow_background(frames, np.ones(frames.shape[:3], bool)))
    assert np.abs(moved - np.array([[-6.0 * t, 0] for t in range(12)])).max() < 0.3


def test_even_light_forgets_brightness():
    grey = cv2.cvtColor(texture(64, 64), cv2.COLOR_RGB2GRAY)
    dim = (grey // 2).astype(np.uint8)
    assert np.abs(even_light(grey).astype(int) - even_light(dim)).mean() < 12
