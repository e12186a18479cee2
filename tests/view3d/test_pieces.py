"""Order, detail, mouse, safe band, snapshots: the view's small parts on their own."""

from __future__ import annotations

import threading
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from PySide6.QtCore import Qt
from scenes import small_scene

from genmojo_core.clip.cameras import View
from genmojo_core.conventions import axis_angle_matrix
from genmojo_core.errors import GenmojoError
from genmojo_studio.view3d.frames import FrameRequest
from genmojo_studio.view3d.look import Look, Mode, object_table
from genmojo_studio.view3d.navigation import Action, action, dragged, elevation_range, wheeled
from genmojo_studio.view3d.orbit import Orbit, Reference, reference_of
from genmojo_studio.view3d.order import Sorter, back_to_front
from genmojo_studio.view3d.quality import FULL, STEPS, Detail
from genmojo_studio.view3d.safe_band import degrees_outside
from genmojo_studio.view3d.snapshot import SceneSnapshot
from tests.view3d.scenes_gl import random_snapshot


@settings(max_examples=60, deadline=None)
@given(hnp.arrays(np.float32, st.integers(0, 200), elements=st.floats(width=32, allow_nan=False)))
def test_the_order_is_a_stable_sort_by_depth(depth: np.ndarray) -> None:
    """Farthest first, for any float32 (negative, subnormal, infinite); of equal depths the first row is drawn last."""
    wanted = np.argsort(depth + np.float32(0), kind="stable")[::-1]
    assert np.array_equal(back_to_front(depth + np.float32(0)), wanted)


def test_large_scenes_sort_on_a_thread_and_the_newest_request_wins() -> None:
    ready = threading.Event()
    sorter = Sorter(ready.set)
    rng = np.random.default_rng(0)
    for key in range(5):
        depth = rng.random(200_000).astype(np.float32)
        sorter.request(key, np.arange(200_000), depth)
    found = None
    while found is None or found[0] != 4:
        assert ready.wait(20)
        ready.clear()
        found = sorter.take() or found
    assert np.all(np.diff(depth[found[1]]) <= 0)
    sorter.stop()


def test_detail_follows_what_frames_cost() -> None:
    """A machine on which a full frame takes a second drops at once and stays under the limit; a fast one never."""

    def cost(full_ms: float, quality: object) -> float:
        return full_ms * (0.3 / quality.stride + 0.7 * quality.scale**2)

    for full_ms, steps in ((30.0, {FULL}), (250.0, set(STEPS[1:4])), (1500.0, set(STEPS[4:]))):
        detail = Detail()
        detail.begin(full_ms)
        used = []
        for _ in range(30):
            used.append(detail.quality)
            detail.took(cost(full_ms, detail.quality))
        assert set(used[3:]) <= steps
        assert all(cost(full_ms, quality) <= 100 for quality in used[3:])
        assert len(set(used[5:])) == 1  # no flicker between two steps


def test_detail_comes_back_when_the_machine_is_free_again() -> None:
    detail = Detail()
    detail.begin(None)
    for _ in range(6):
        detail.took(400.0)
    assert detail.quality == STEPS[-1]
    detail.begin(40.0)
    assert detail.quality == FULL


def plain_reference() -> Reference:
    return Reference(View(np.eye(4), 300, 300, 160, 120, 320, 240), np.array([0, 0, 2.0]), np.array([0, -1.0, 0]))


def test_the_scene_follows_the_hand() -> None:
    """Dragging to the right turns the scene to the right. Moving keeps the point under the hand."""
    ref, view = plain_reference(), plain_reference().view
    turned = dragged(Orbit(), ref, view, (100.0, 40.0), Action.TURN)
    assert (turned.azimuth, turned.elevation) == (-35.0, 14.0)
    moved = dragged(Orbit(), ref, view, (30.0, -12.0), Action.MOVE)
    pose = ref.pose(moved)
    point = pose[:3, :3] @ ref.target + pose[:3, 3]
    assert view.fx * point[0] / point[2] + view.cx == pytest.approx(160 + 30)
    assert view.fy * point[1] / point[2] + view.cy == pytest.approx(120 - 12)
    assert dragged(Orbit(), ref, view, (0.0, 100.0), Action.DISTANCE).radius > 2.0
    assert dragged(Orbit(), ref, view, (9.0, 9.0), Action.NONE) == Orbit()


def test_dragging_stops_at_the_poles_of_a_tilted_camera() -> None:
    pose = np.eye(4)
    pose[:3, :3] = axis_angle_matrix(np.array([1.0, 0, 0]), 25)  # looks down by 25 degrees
    ref = replace(plain_reference(), view=plain_reference().view.with_pose(pose))
    lowest, highest = elevation_range(ref)
    assert (lowest, highest) == pytest.approx((-90 - 25 + 0.1, 90 - 25 - 0.1))
    orbit = Orbit()
    for _ in range(20):
        orbit = dragged(orbit, ref, ref.view, (0.0, 100.0), Action.TURN)
    assert orbit.elevation == pytest.approx(highest)
    looking = ref.pose(orbit)[2, :3]
    assert looking @ ref.up == pytest.approx(-1, abs=1e-4)  # straight down, not over


def test_the_wheel_goes_nearer_within_limits() -> None:
    ref, orbit = plain_reference(), Orbit()
    assert wheeled(orbit, ref, 1, lens=False).radius == pytest.approx(2 * 0.88)
    for _ in range(200):
        orbit = wheeled(orbit, ref, 1, lens=False)
    assert orbit.radius == pytest.approx(0.04)
    assert wheeled(Orbit(), ref, 1, lens=True).fov < ref.fov
    assert wheeled(Orbit(fov=3.0), ref, 50, lens=True).fov == 2.0


def test_buttons() -> None:
    left, right, middle = Qt.MouseButton.LeftButton, Qt.MouseButton.RightButton, Qt.MouseButton.MiddleButton
    none, shift = Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.ShiftModifier
    assert [action(b, none) for b in (left, middle, right, Qt.MouseButton.NoButton)] == [
        Action.TURN, Action.MOVE, Action.DISTANCE, Action.NONE,
    ]  # fmt: skip
    assert action(left, shift) == Action.MOVE


def test_how_far_a_view_is_from_supervision() -> None:
    """The input view always counts; azimuth matters less near the pole; the frame column is no angle."""
    nothing = np.zeros((0, 3))
    assert degrees_outside(Orbit(), nothing) == 0
    assert degrees_outside(Orbit(elevation=-30), nothing) == pytest.approx(30)
    rows = np.array([[20, 40, 90], [-10, 0, 0]])
    assert degrees_outside(Orbit(20, 47), rows) == pytest.approx(7 * np.cos(np.deg2rad(20)), abs=0.05)
    assert degrees_outside(Orbit(0, 180), rows) > 100


def test_snapshots_refuse_arrays_that_do_not_fit() -> None:
    good = random_snapshot(4)
    with pytest.raises(GenmojoError, match="rotations has shape"):
        replace(good, rotations=np.zeros((4, 3)))
    with pytest.raises(GenmojoError, match="uid"):
        replace(good, uid=np.arange(5))
    assert good.positions.dtype == np.float32
    assert good.object_id.dtype == np.uint16


def test_objects_without_a_name_are_drawn_too() -> None:
    snapshot = replace(random_snapshot(6, objects=2), object_id=np.array([0, 1, 9, 9, 1, 0]))
    assert snapshot.object_ids.tolist() == [0, 1, 9]
    assert snapshot.object_of(9).name == "object 9"
    table = object_table(snapshot, Look(show_background=False, solo=frozenset({0, 9})))
    assert table.shown.tolist() == [False, False, True]
    assert snapshot.is_background.tolist() == [True, False, False, False, False, True]


def test_a_snapshot_of_a_file_goes_to_any_frame() -> None:
    scene = small_scene(frames=3, shift=0.5)
    snapshot = SceneSnapshot.from_baked(scene, 99)
    assert snapshot.frame == 2
    assert snapshot.at(2) is snapshot
    assert snapshot.at(0).positions == pytest.approx(scene.frame(0).means)
    assert snapshot.at(-5).frame == 0
    assert random_snapshot(3).at(7).frame == 0  # a preview knows its own frame only


def test_pixels_that_are_not_square_are_shown_square() -> None:
    """A clip of anamorphic pixels (fy twice fx) fills a window of its true shape; nearly square ones stay."""
    reference = plain_reference()
    source = reference.view
    wide = replace(reference, view=View(source.world_to_camera, 150, 300, 80, 120, 160, 240))
    request = FrameRequest(random_snapshot(1), wide, Orbit(), Look(), 0.0)
    view = request.view(320, 240)
    assert (view.fx, view.fy, view.cx, view.cy) == pytest.approx((300, 300, 160, 120))
    nearly = replace(reference, view=View(source.world_to_camera, 300, 303, 160, 120, 320, 240))
    assert FrameRequest(random_snapshot(1), nearly, Orbit(), Look(), 0.0).view(320, 240).fy == 303


def test_a_reference_of_a_preview_is_its_frames_camera() -> None:
    scene = small_scene(frames=2)
    poses = scene.cameras.world_to_camera.copy()
    poses[1, 0, 3] = 0.7
    snapshot = SceneSnapshot.from_baked(replace(scene, cameras=replace(scene.cameras, world_to_camera=poses)), 1)
    assert reference_of(snapshot).view.world_to_camera[0, 3] == 0.7
    assert Mode("depth") is Mode.DEPTH
