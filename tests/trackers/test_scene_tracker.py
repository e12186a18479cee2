"""Tracks out of scenes whose motion is known: exact under shifts and turns, never dropped, honest about hiding."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scenes import small_scene

from genmojo_core.clip.cameras import Cameras
from genmojo_core.errors import GenmojoError
from genmojo_core.measure.views import render_frame
from genmojo_core.store.scene_file import BakedScene
from genmojo_core.trackers.scene import project, track
from genmojo_core.tracks.model import OCCLUDED, OUT_OF_VIEW, VISIBLE


def disc_path(scene, k: int, local: np.ndarray) -> np.ndarray:  # (T, 2) px
    """Where a point of disc k (object space) is in every frame."""
    row = [o.id for o in scene.objects].index(k)
    world = scene.object_to_world[:, row, :, :3] @ local + scene.object_to_world[:, row, :, 3]
    return np.stack([project(w[None], scene.cameras.view(t))[0][0] for t, w in enumerate(world)])


@pytest.mark.parametrize("turn", [0.0, 12.0])
@pytest.mark.parametrize("asked", [0, 5])
def test_points_of_moving_turning_discs(turn, asked):
    """Queries anywhere on a disc, at any frame, follow it to a fraction of a pixel; offsets turn with the disc."""
    scene = small_scene(frames=8, size=(192, 144), per_object=500, turn=turn, shift=0.03)
    points = np.array([[0.0, 0.0, 0.0], [0.3, 0.1, 0.0], [-0.2, 0.3, 0.0], [0.1, -0.37, 0.0]])
    paths = np.stack([disc_path(scene, 1, p) for p in points])
    found = track(scene, np.full(len(points), asked), paths[:, asked])
    assert found.object.tolist() == [1] * 4 and found.xy.shape == (4, 8, 2)
    assert np.linalg.norm(found.xy - paths, axis=-1).max() < 0.6
    np.testing.assert_array_equal(found.xy[:, asked], paths[:, asked].astype(np.float32))
    assert np.abs(found.xyz[..., 2] - 4).max() < 0.1
    assert (found.state == VISIBLE).mean() > 0.9


def test_rotation_matters():
    """A bar of two far-apart Gaussians: the offset of a query turns with them (a centre alone would miss by pixels)."""
    scene = small_scene(frames=4, size=(192, 144), per_object=1, turn=30.0, shift=0.0)
    xyz, scale = scene.xyz.copy(), scene.scale.copy()
    row = scene.objects[1].first
    xyz[row], scale[row] = 0, [0.5, 0.5, 0.02]
    scene = replace(scene, xyz=xyz, scale=scale)
    path = disc_path(scene, 1, np.array([0.3, 0.0, 0.0]))
    found = track(scene, np.array([0]), path[:1])
    assert np.linalg.norm(found.xy[0] - path, axis=-1).max() < 0.5
    assert np.linalg.norm(path[3] - path[0]) > 20


def test_growing_objects_carry_their_points_outward():
    """Placement scale s multiplies offsets."""
    scene = small_scene(frames=3, size=(192, 144), per_object=300, shift=0.0)
    placement = scene.object_to_world.copy()
    placement[2, 1, :, :3] *= 1.5
    scene = replace(scene, object_to_world=placement)
    path = disc_path(scene, 1, np.array([0.35, 0.1, 0.0]))
    found = track(scene, np.array([0]), path[:1])
    assert np.linalg.norm(found.xy[0, 2] - path[2]) < 1.0


def test_hidden_and_out_of_view():
    """Disc 2 (z = 5) passes behind disc 1 (z = 4) and leaves the picture on the left."""
    scene = small_scene(frames=24, size=(192, 144), per_object=600, shift=0.13)
    path = disc_path(scene, 2, np.zeros(3))
    found = track(scene, np.array([0]), path[:1])
    front = disc_path(scene, 1, np.zeros(3))
    state = found.state[0]
    behind = np.linalg.norm(front - path, axis=1) < 12
    gone = path[:, 0] < -2
    free = (np.linalg.norm(front - path, axis=1) > 60) & (path[:, 0] > 4)
    assert behind.any() and gone.any() and free.any()
    assert (state[behind] == OCCLUDED).all() and (state[gone] == OUT_OF_VIEW).all() and (state[free] == VISIBLE).all()


def turning_ball(frames: int, turn: float) -> BakedScene:
    """A ball of radius 0.5, opaque on its surface only, that turns about the vertical axis before the wall."""
    scene = small_scene(frames=frames, size=(192, 144), per_object=4000, shift=0.0)
    ball, other = scene.objects[1:]
    i = np.arange(ball.count) + 0.5
    height, angle = 1 - 2 * i / ball.count, i * np.pi * (1 + 5**0.5)
    ring = np.sqrt(1 - height**2)
    normal = np.stack([ring * np.cos(angle), height, ring * np.sin(angle)], axis=-1)
    xyz, scale, rot = scene.xyz.copy(), scene.scale.copy(), scene.rot.copy()
    rows = slice(ball.first, ball.first + ball.count)
    xyz[rows], scale[rows] = 0.5 * normal, [0.02, 0.02, 0.002]
    half = np.concatenate([1 + normal[:, 2:], np.stack([-normal[:, 1], normal[:, 0], 0 * angle], -1)], axis=1)
    rot[rows] = half / np.linalg.norm(half, axis=1, keepdims=True)  # z axis onto the normal
    xyz[other.first :] += [0, 50, 0]
    placement = scene.object_to_world.copy()
    for t in range(frames):
        a = np.deg2rad(turn * t)
        placement[t, 1, :, :3] = [[np.cos(a), 0, np.sin(a)], [0, 1, 0], [-np.sin(a), 0, np.cos(a)]]
        placement[t, 1, :, 3] = [0, 0, 4]
    return replace(scene, xyz=xyz, scale=scale, rot=rot, rot_t=np.tile(rot, (frames, 1, 1)), object_to_world=placement)


def test_a_solid_hides_its_far_side():
    """A point of a turning ball is seen until it is at the ball's horizon, to 8 degrees, and from there again."""
    scene = turning_ball(frames=37, turn=10.0)
    start = np.array([[0.0, 0.0, -0.5], [0.3, 0.0, -0.4], [-0.2, 0.3, -np.sqrt(0.25 - 0.13)]])
    paths = np.stack([disc_path(scene, 1, p) for p in start])
    found = track(scene, np.zeros(3, int), paths[:, 0])
    world = np.einsum("tij,pj->pti", scene.object_to_world[:, 1, :, :3], start) + [0, 0, 4]
    facing = np.einsum("pti,pti->pt", (world - [0, 0, 4]) / 0.5, -world / np.linalg.norm(world, axis=-1, keepdims=True))
    angle = np.degrees(np.arcsin(facing))  # above the horizon
    assert (angle > 8).any(axis=1).all() and (angle < -8).sum() > 40
    assert (found.state[angle > 8] == VISIBLE).all()
    assert (found.state[angle < -8] == OCCLUDED).all()


def test_background_moves_with_the_camera_only():
    """A point of the wall, under a camera that travels: the projection of one fixed place."""
    scene = small_scene(frames=4, size=(192, 144))
    poses = scene.cameras.world_to_camera.copy()
    poses[:, 0, 3] = [0, 0.2, 0.4, 0.6]
    scene = replace(scene, cameras=Cameras(scene.cameras.K, poses, scene.cameras.size))
    found = track(scene, np.array([0]), np.array([[10.0, 10.0]]))
    expected = 10 + 1.2 * 192 * np.array([0, 0.2, 0.4, 0.6]) / found.xyz[0, :, 2]
    assert found.object.tolist() == [0]
    np.testing.assert_allclose(found.xy[0, :, 0], expected, atol=0.01)
    np.testing.assert_allclose(found.xyz[0], found.xyz[0, :1].repeat(4, 0), atol=1e-5)


def test_a_query_just_beside_an_object_is_its_own():
    """Outlines are good to a pixel or two: 1 px outside the disc still follows the disc, 12 px outside the wall."""
    scene = small_scene(frames=4, size=(192, 144), per_object=900)
    view = scene.cameras.view(0)
    disc = render_frame(scene, 0, view).instance() == 1
    edge = np.nonzero(disc[72])[0].min()
    found = track(scene, np.zeros(2, int), np.array([[edge - 0.5, 72.5], [edge - 12.0, 72.5]]))
    assert found.object.tolist() == [1, 0]
    np.testing.assert_allclose(found.xy[0, :, 0] - (edge - 0.5), 1.2 * 192 * 0.1 / 4 * np.arange(4), atol=0.5)


def test_no_query_is_dropped():
    """Where nothing shows (no background), the nearest Gaussian carries the point."""
    scene = small_scene(background=False, shift=0.1)
    found = track(scene, np.array([0, 2]), np.array([[1.0, 1.0], [63.0, 47.0]]))
    assert np.isfinite(found.xy).all() and (found.object > 0).all()
    np.testing.assert_allclose(found.xy[0, 0], [1, 1], atol=1e-5)


def test_bad_queries():
    scene = small_scene()
    for t, xy in (([9], [[1, 1]]), ([-1], [[1, 1]]), ([0], [[70, 1]]), ([0], [[-1, 1]]), ([], np.zeros((0, 2)))):
        with pytest.raises(GenmojoError):
            track(scene, np.array(t, int), np.array(xy, float))
    with pytest.raises(GenmojoError, match="no Gaussians"):
        track(replace(scene, xyz=scene.xyz[:0]), np.array([0]), np.array([[1.0, 1.0]]))


def test_a_query_goes_with_its_own_object_behind_another():
    """Where disc 2 is behind disc 1, a place asked for disc 2 follows disc 2; without an owner what shows there."""
    scene = small_scene(frames=24, size=(192, 144), per_object=600, shift=0.13)
    back, front = disc_path(scene, 2, np.zeros(3)), disc_path(scene, 1, np.zeros(3))
    t = int(np.argmin(np.linalg.norm(front - back, axis=1)))
    assert np.linalg.norm(front - back, axis=1)[t] < 12
    asked = np.full(2, t), back[[t, t]]
    found = track(scene, *asked, owner=np.array([2, 0]))
    assert found.object.tolist() == [2, 1]
    assert np.linalg.norm(found.xy[0] - back, axis=1).max() < 1.0
    with pytest.raises(GenmojoError, match="no object 7"):
        track(scene, *asked, owner=np.array([7, 0]))


def test_tracking_stops_when_it_is_told_to():
    scene, shares = small_scene(frames=6), []
    with pytest.raises(GenmojoError, match="cancelled"):
        track(scene, np.array([0]), np.array([[30.0, 20.0]]), shares.append, cancelled=lambda: len(shares) == 2)
    assert len(shares) == 2
