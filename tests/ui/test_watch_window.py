"""The workspace Watch on a scene: what a person sees and changes, and that previews do not hold up the window."""

import threading
import time
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QPushButton

from genmojo_core.clip.cameras import Cameras
from genmojo_core.clip.clip import Clip
from genmojo_core.store import scene_hdf5
from genmojo_core.store.scene_file import BakedScene, SceneObject
from genmojo_core.tracks.model import VISIBLE, PointTracks
from genmojo_studio import theme
from genmojo_studio.view3d.look import Mode
from genmojo_studio.view3d.orbit import Orbit
from genmojo_studio.view3d.quality import FULL
from genmojo_studio.view3d.scene_view import REST_MS
from genmojo_studio.view3d.snapshot import SceneSnapshot
from genmojo_studio.watch import track_overlay, view_map
from genmojo_studio.watch.time_bar import TimeBar

_FRAMES = 4


def _scene(count=60):
    """Two objects in front of a background; object 1 moves to the right."""
    rng = np.random.default_rng(3)
    owners = (SceneObject(0, "background", (0.5, 0.5, 0.5), True, 0, count),
              SceneObject(1, "ball", (0.9, 0.3, 0.2), False, count, count),
              SceneObject(2, "box", (0.2, 0.5, 0.9), False, 2 * count, count))  # fmt: skip
    xyz = rng.normal(0, 0.15, (3 * count, 3)).astype(np.float32)
    xyz[:count] = rng.uniform(-2, 2, (count, 3)) * (1, 1, 0) + (0, 0, 3)
    xyz[count : 2 * count] += (-0.6, 0, 0)
    xyz[2 * count :] += (0.6, 0, 0)
    moved = np.zeros((_FRAMES, 3 * count, 3), np.float32)
    moved[:, count : 2 * count, 0] = np.arange(_FRAMES)[:, None] * 0.1
    unit = np.tile(np.array([1, 0, 0, 0], np.float32), (3 * count, 1))
    pose = np.eye(4)
    pose[2, 3] = 4.0
    k = np.array([[160.0, 0, 80], [0, 160.0, 45], [0, 0, 1]])
    cameras = Cameras(np.tile(k, (_FRAMES, 1, 1)), np.tile(pose, (_FRAMES, 1, 1)), (160, 90))
    return BakedScene(
        frame_index=np.arange(_FRAMES), seconds=np.arange(_FRAMES) / 24, source_names=tuple("abcd"), objects=owners,
        xyz=xyz, rot=unit, scale=np.full((3 * count, 3), 0.08, np.float32), opacity=np.full(3 * count, 0.9, np.float32),
        dc=rng.normal(0, 0.5, (3 * count, 3)).astype(np.float32), uid=np.arange(3 * count, dtype=np.uint64),
        d_xyz=moved, rot_t=np.tile(unit, (_FRAMES, 1, 1)), log_scale_t=np.zeros((_FRAMES, 3 * count, 3), np.float32),
        object_to_world=np.tile(np.eye(3, 4, dtype=np.float32), (_FRAMES, 3, 1, 1)),
        depth_scale=np.ones((_FRAMES, 3), np.float32), cameras=cameras, ref_frame=np.zeros(3, np.int64),
        world_up=np.array([0.0, -1, 0]), supervised=np.array([[0.0, 0, 0]], np.float32),
    )  # fmt: skip


@pytest.fixture
def watch(window, qtbot, tmp_path):
    path = tmp_path / "scene.h5"
    scene_hdf5.write(_scene(), path)
    window.open_path(path)
    qtbot.waitUntil(lambda: "watch" in window.workspaces, timeout=60_000)
    qtbot.waitUntil(lambda: window.workspaces["watch"].session.scene is not None, timeout=60_000)
    return window.workspaces["watch"]


def test_a_scene_file_opens_with_its_objects_and_frames(window, watch):
    assert window.workspace == "watch" and window.state.frame_count == _FRAMES
    names = [watch.objects_panel.list.topLevelItem(i).text(0) for i in range(3)]
    assert names == ["Background", "ball", "box"]


def test_typed_angles_turn_the_view_and_undo_turns_it_back(window, watch):
    watch.view_panel.fields["elevation"].setValue(30.0)
    assert watch.view.orbit.elevation == pytest.approx(30.0, abs=1e-9)
    assert "30" in watch.view_panel.badge.text() and watch.view_panel.badge.property("role") == "warn"
    assert window.table.trigger("edit.undo")
    assert watch.view.orbit.elevation == 0.0 and watch.view_panel.fields["elevation"].value() == 0.0


def test_a_preset_arrives_exactly_where_it_says(window, watch, qtbot):
    window.table.trigger("view.right_30")
    qtbot.waitUntil(lambda: watch.view.orbit.azimuth == 30.0, timeout=60_000)
    window.table.trigger("view.input")
    qtbot.waitUntil(lambda: watch.view.orbit.azimuth == 0.0, timeout=60_000)


def test_solo_hides_the_others_and_all_brings_them_back(window, watch):
    window.state.set(selected_object=1)
    window.table.trigger("view.solo")
    boxes = [watch.objects_panel.list.topLevelItem(i).checkState(0) for i in range(3)]
    assert boxes == [Qt.CheckState.Unchecked, Qt.CheckState.Checked, Qt.CheckState.Unchecked]
    window.table.trigger("view.all")
    assert watch.view.look.solo == frozenset()


def test_modes_from_the_menu_reach_the_view_and_are_ticked(window, watch):
    window.table.trigger("mode.depth")
    assert watch.view.look.mode == Mode.DEPTH and window.table.is_checked("mode.depth")
    assert watch.center.mode_choice.currentData() == "mode.depth"


def test_scrubbing_moves_view_bar_and_time_together(window, watch):
    bar = watch.findChild(TimeBar)
    bar.slider.setValue(2)
    assert window.state.frame == 2 and watch.view.time == 2.0 and bar.frame.value() == 3


def test_a_click_names_the_gaussian_and_follows_it_over_all_frames(watch, qtbot):
    watch.center.set_mode("scene")
    QTest.qWait(50)
    x, y = _pixel_of(watch, np.array([-0.6, 0, 0]))
    QTest.mouseClick(watch.view, Qt.MouseButton.LeftButton, pos=watch.view.rect().topLeft() + _point(x, y))
    qtbot.waitUntil(lambda: watch.picking.trajectory is not None, timeout=60_000)
    way = watch.picking.trajectory
    assert way.object_id == 1 and watch.state.selected_object == 1
    assert way.position[:, 0] - way.position[0, 0] == pytest.approx(np.arange(_FRAMES) * 0.1, abs=1e-5)


def test_tracks_of_another_run_come_from_its_scene(watch, qtbot, tmp_path):
    """A scene file without tracks carries the points of the set that stands as reference."""
    clip_tracks = PointTracks(np.full((1, _FRAMES, 2), 45.0, np.float32) + np.float32([11, 0]),
                              np.full((1, _FRAMES), VISIBLE, np.uint8), np.ones(1, np.int64), (160, 90))  # fmt: skip
    frames = np.zeros((_FRAMES, 90, 160, 3), np.uint8)
    clip = Clip("c", "", frames, np.arange(_FRAMES), np.arange(_FRAMES) / 24, tuple("abcd"), (160, 90))
    watch.state.open_clip(clip, tmp_path / "c")
    watch.tracks.add("mine", "annotated", clip_tracks)
    watch.tracks.bring(tmp_path / "scene.h5")
    name = f"{tmp_path.name}/scene.h5"
    qtbot.waitUntil(lambda: name in watch.tracks.sets.sets, timeout=60_000)
    found = watch.tracks.sets.sets[name].tracks
    assert watch.tracks.which.currentData() == name and watch.tracks.reference.currentData() == "mine"
    assert found.xy.shape == (1, _FRAMES, 2) and np.linalg.norm(found.xy[0, 0] - (56, 45)) < 1.5


def test_a_frozen_scene_is_compared_with_what_comes_after(watch, qtbot):
    watch.compare.freeze.click()
    qtbot.waitUntil(lambda: watch.compare._pair is not None, timeout=60_000)
    assert (watch.compare._pair.first == watch.compare._pair.second).all()
    assert watch.compare.table.topLevelItem(0).text(3) == "+0"


def test_checkpoints_of_the_run_are_offered_for_comparing(watch, qtbot):
    snapshot = replace(SceneSnapshot.from_baked(_scene()), step=30)
    watch.session.take_preview(snapshot)
    watch.control.state = "running"
    for step in range(30, 130, 10):
        watch.control.client.event_received.emit({"event": "Checkpointed", "seconds": 1.0, "step": step, "path": ""})
    watch.control.state = "done"
    watch.compare.offers.aboutToShow.emit()
    offered = [action.text() for action in watch.compare.offers.actions() if action.text()]
    assert offered[:6] == [f"Checkpoint at step {step}" for step in (120, 110, 100, 90, 80, 30)]
    assert offered[-1].startswith("A file")
    watch.compare.offers.actions()[5].trigger()
    assert watch.compare.active and watch.compare.second.snapshot is snapshot
    watch.control.began.emit()
    watch.compare.offers.aboutToShow.emit()
    assert not [action for action in watch.compare.offers.actions() if "Checkpoint" in action.text()]


@pytest.mark.parametrize("end", ["paused", "done", "failed"])
def test_a_measurement_that_was_cut_short_keeps_nothing_from_the_view(watch, end):
    newer = replace(watch.session.snapshot, version=99)
    watch.control.client.state_changed.emit("running")
    watch.control.client.probe_changed.emit(True)
    watch.view.show_snapshot(newer)
    assert watch.view.snapshot is not newer
    watch.control.client.state_changed.emit(end)
    watch.control.state = "done"  # there is no worker that the window would have to ask about when it closes
    assert watch.view.snapshot is newer


@pytest.mark.parametrize("end", ["done", "failed"])
def test_an_export_that_waits_for_the_run_is_answered_when_the_run_ends(watch, told, tmp_path, monkeypatch, end):
    control, got = watch.control, []
    monkeypatch.setattr(control.client, "write_scene", lambda path: 1)
    control.client.run_dir = str(tmp_path)  # where scene.h5 lies
    control.scene_so_far(got.append)
    control.client.state_changed.emit(end)
    if end == "done":
        assert got == [tmp_path / "scene.h5"] and not told
    else:
        assert not got and len(told) == 1 and "before its scene was written" in told[0][1]


def test_while_a_run_goes_on_frames_keep_a_pace(watch, qtbot):
    client, moments = watch.control.client, []
    watch.view.frame_drawn.connect(lambda _: moments.append(time.monotonic()))
    client.state_changed.emit("running")
    watch.view.set_pace(0.3)
    for azimuth in range(1, 200):
        watch.view.set_orbit(Orbit(azimuth=azimuth / 10))
        QTest.qWait(5)
    qtbot.waitUntil(lambda: moments and watch.view.overlay.report.request.orbit.azimuth == 19.9, timeout=30_000)
    asked = moments[-1] - moments[0]
    assert len(moments) <= asked / 0.3 + 3  # the first, the last, and the full one at rest
    client.state_changed.emit("done")
    assert watch.view._pace == 0.0


def test_a_picture_of_the_view_has_the_size_asked_for(watch, qtbot, tmp_path):
    output = tmp_path / "view.png"
    watch.take_away.save_picture(str(output), (320, 180), True)
    qtbot.waitUntil(lambda: watch.take_away.last is not None, timeout=60_000)
    from PySide6.QtGui import QImage

    picture = QImage(str(output))
    assert (picture.width(), picture.height()) == (320, 180) and picture.hasAlphaChannel()
    assert output.with_suffix(".json").exists()


def test_previews_hold_up_the_window_for_a_few_milliseconds_only(window, watch, qtbot):
    """A preview of 20,000 Gaussians costs the UI thread about what one of 20 does: nothing is done by Gaussian."""

    def spent(first, begin):
        found = []
        for i in range(15):
            preview = replace(first, version=begin + i, step=i)
            begun = time.thread_time()
            watch.session.take_preview(preview)
            QTest.qWait(5)
            found.append(time.thread_time() - begun)
        return sorted(found)[7]

    small, large = (replace(SceneSnapshot.from_baked(_scene(count)), frames=None) for count in (7, 7000))
    rounds = [(spent(small, 100 * k), spent(large, 100 * k + 50)) for k in range(1, 4)]
    assert min(b / a for a, b in rounds) < 4.0
    assert len(watch.objects_panel.list.findItems("", Qt.MatchFlag.MatchContains)) == 3


def _pixel_of(watch, point):
    view = watch.view.view()
    camera = view.world_to_camera[:3, :3] @ point + view.world_to_camera[:3, 3]
    return view.fx * camera[0] / camera[2] + view.cx, view.fy * camera[1] / camera[2] + view.cy


def _point(x, y):
    from PySide6.QtCore import QPoint

    return QPoint(round(x), round(y))


def test_the_map_shows_what_was_supervised_and_turns_the_view(window, watch, qtbot):
    found = view_map.distances(np.array([[0.0, 90.0, 0.0]]))
    assert found[18, 53] < 4 and found[18, 36] < 4  # azimuth 87.5 and 2.5: the supervised view and the input camera
    assert found[18, 0] == pytest.approx(92.5, abs=0.1) and found[0, 36] == pytest.approx(
        87.5, abs=0.1
    )  # behind, above
    shown = watch.view_panel.map
    field = shown._field()
    for elevation, azimuth in ((30.0, -60.0), (0.0, 0.0), (-45.0, 120.0)):
        back = view_map.angles_at(field, view_map._place(field, elevation, azimuth))
        assert back == pytest.approx((elevation, azimuth), abs=1e-9)
    there = view_map._place(field, 40.0, 80.0).toPoint()
    QTest.mouseClick(shown, Qt.MouseButton.LeftButton, pos=there)
    qtbot.waitUntil(
        lambda: abs(watch.view.orbit.azimuth - 80) < 2 and abs(watch.view.orbit.elevation - 40) < 2, timeout=60_000
    )
    azimuth = watch.view.orbit.azimuth
    QTest.keyClick(shown, Qt.Key.Key_Left)
    qtbot.waitUntil(lambda: watch.view.orbit.azimuth == pytest.approx(azimuth - 5), timeout=60_000)
    assert watch.view_panel.badge.property("role") == "warn"


def test_what_is_behind_the_scene_follows_the_theme_or_the_choice(window, watch):
    def behind():
        return QColor.fromRgbF(*watch.view.look.backdrop).name()

    dark = theme.colours(window.state.theme).canvas
    assert behind() == dark
    window.table.trigger("view.background")  # something to undo, in the old theme
    window.table.trigger("window.theme")
    light = theme.colours(window.state.theme).canvas
    window.table.trigger("edit.undo")
    assert behind() == light != dark
    box = watch.view_panel.backdrop
    box.setCurrentIndex(box.findData("#ffffff"))
    box.activated.emit(box.currentIndex())
    window.table.trigger("window.theme")
    assert behind() == "#ffffff"
    box.setCurrentIndex(0)
    box.activated.emit(0)
    assert behind() == dark


def test_directions_that_a_prior_judges_come_to_the_map_while_the_run_goes_on(watch, qtbot):
    own = np.zeros((_FRAMES, 3), np.float32)
    more = np.array([[20.0, 120.0, 1.0]], np.float32)
    watch.session.take_preview(replace(watch.session.snapshot, supervised=own, version=50))
    watch.view.set_orbit(Orbit(elevation=20.0, azimuth=118.0))
    assert watch.view_panel.badge.property("role") == "warn"
    watch.session.take_preview(replace(watch.session.snapshot, supervised=np.concatenate([own, more]), version=51))
    assert watch.view_panel.badge.property("role") == "good"
    shown, wanted = watch.view_panel.map, np.concatenate([own, more])
    qtbot.waitUntil(lambda: np.array_equal(shown._supervised, wanted), timeout=60_000)
    np.testing.assert_allclose(shown._away, view_map.distances(wanted), atol=1e-9)


def test_how_far_the_map_is_from_thousands_of_views_is_found_on_a_thread(watch, qtbot, monkeypatch):
    """A run that ends brings them all at once: the window goes on meanwhile."""
    on, go, real = [], threading.Event(), view_map.distances

    def slow(supervised):
        on.append(threading.current_thread())
        assert go.wait(60)
        return real(supervised)

    monkeypatch.setattr(view_map, "distances", slow)
    shown = watch.view_panel.map
    wanted = np.stack([np.linspace(-40, 40, 3000), np.linspace(-180, 180, 3000), np.zeros(3000)], 1).astype(np.float32)
    watch.session.take_preview(replace(watch.session.snapshot, supervised=wanted, version=70))
    qtbot.waitUntil(lambda: bool(on), timeout=60_000)
    assert threading.main_thread() not in on and len(shown._supervised) < 3000
    go.set()
    qtbot.waitUntil(lambda: len(shown._supervised) == 3000, timeout=60_000)
    np.testing.assert_allclose(shown._away, real(wanted), atol=1e-9)


def test_thousands_of_supervised_directions_are_a_point_for_every_place_on_the_map(watch):
    """What is painted is bounded by the map, not by how long a run has gone on."""
    rng = np.random.default_rng(5)
    many = np.stack([rng.uniform(-40, 40, 20_000), rng.uniform(-180, 180, 20_000), np.zeros(20_000)], axis=1)
    field = watch.view_panel.map._field()
    spots = view_map._spots(field, many)
    assert len(spots) <= (field.width() / view_map._SPOT + 2) * (field.height() / view_map._SPOT + 2)
    few = view_map._spots(field, many[:5])
    places = sorted((point.x(), point.y()) for point in (few.at(i) for i in range(few.size())))
    wanted = [view_map._place(field, elevation, azimuth) for elevation, azimuth, _ in many[:5]]
    np.testing.assert_allclose(places, sorted((point.x(), point.y()) for point in wanted), atol=1e-9)
    alone = np.min([view_map.distances(row[None]) for row in many[:300]], axis=0)
    np.testing.assert_allclose(view_map.distances(many[:300]), alone, atol=1e-6)


def test_a_turn_of_the_time_bar_as_the_run_ends_is_no_fault(window, watch, told):
    """The worker refuses what came too late; only what a person asked for is told."""
    control = watch.control
    control._unasked.add(7)
    control._acknowledged(7, False, "The run is over.")
    assert told == []
    control._acknowledged(8, False, "The run is over.")
    assert len(told) == 1


def test_two_scenes_get_equal_room_and_the_input_comes_back(window, watch, qtbot):
    watch.compare._freeze()
    pane, view = watch.compare.pane, watch.view
    qtbot.waitUntil(lambda: pane.isVisible() and abs(pane.width() - view.width()) < 12, timeout=60_000)
    assert not watch.center.input_picture.isVisible() and pane.width() > 250
    watch.compare.mode.setCurrentIndex(0)
    watch.compare._take_mode()
    assert watch.center.input_picture.isVisible() and not pane.isVisible()


def test_another_theme_is_on_show_soon_and_then_everywhere(window, watch, qtbot):
    def ground(button):
        return button.grab().toImage().pixelColor(button.width() // 2, 3).name()

    button = watch.view_panel.findChild(QPushButton)
    window.table.trigger("window.theme")
    other = theme.colours(window.state.theme)
    qtbot.waitUntil(lambda: ground(button) == other.raised and window.updatesEnabled(), timeout=60_000)
    window.show_workspace("")  # was hidden
    plain = next(b for b in window.welcome.findChildren(QPushButton) if not b.isDefault())
    qtbot.waitUntil(lambda: ground(plain) == other.raised, timeout=60_000)
    window.table.trigger("window.theme")


def test_the_worst_track_and_the_one_it_is_compared_with_stand_out(watch, qtbot):
    """Both drawn bright with a line between them, all others pale; a second click lets them be."""
    panel, size = watch.tracks, (160, 90)
    at = np.stack([np.linspace(30, 60, 3), np.full(3, 40.0)], axis=1)[:, None].repeat(_FRAMES, axis=1)
    states, owners = np.full((3, _FRAMES), VISIBLE, np.uint8), np.array([1, 1, 2])
    off = at.copy()
    off[1, 2] += (0, 6)
    panel.add("truth", "annotated", PointTracks(at.astype(np.float32), states, owners, size))
    panel.add("found", "imported", PointTracks(off.astype(np.float32), states, owners, size))
    panel.which.setCurrentIndex(panel.which.findData("found"))
    panel.reference.setCurrentIndex(panel.reference.findData("truth"))
    panel.which.activated.emit(panel.which.currentIndex())
    assert panel.selected == ()
    panel.jump_to_worst()
    assert watch.state.frame == 2 and panel.selected == (("found", 1), ("truth", 1))

    class Painted:
        """What is drawn, with the opacity at that time."""

        def __init__(self):
            self.opacity, self.marks, self.joined = 1.0, [], []

        def setOpacity(self, share):  # noqa: N802 - Qt's name
            self.opacity = share

        def drawPolygon(self, corners):  # noqa: N802 - Qt's name
            self.marks.append(("imported", self.opacity))

        def drawRect(self, *box):  # noqa: N802 - Qt's name
            self.marks.append(("annotated", self.opacity))

        def drawPolyline(self, line):  # noqa: N802 - Qt's name
            self.joined += [(line.at(i).x(), line.at(i).y()) for i in range(line.size())]

        def __getattr__(self, name):
            return lambda *_: None

    def painted():
        found = Painted()
        track_overlay.paint(found, panel.sets.sets.values(), 2, lambda tracks, t: tracks.xy[:, t], panel.selected)
        return found

    chosen = painted()
    assert chosen.marks[-2:] == [("imported", 1.0), ("annotated", 1.0)]
    assert sorted(share < 1 for _, share in chosen.marks) == [False, False, True, True, True, True]
    np.testing.assert_allclose(chosen.joined, [off[1, 2], at[1, 2]], atol=1e-4)
    panel._toggle(panel.worst.topLevelItem(0))
    assert panel.selected == () and all(share == 1.0 for _, share in painted().marks) and not painted().joined


def test_one_change_alone_never_shows_a_picture_of_less_detail(watch, qtbot):
    """Showing one object, or undoing that, is no movement: the old picture stays until the full one is there."""
    view, drawn = watch.view, []
    qtbot.waitUntil(lambda: view.overlay.report is not None, timeout=60_000)
    view.frame_drawn.connect(drawn.append)
    watch.state.set(selected_object=1)
    changes = (lambda: watch.table.trigger("view.solo"), watch.undo.undo, lambda: view.set_orbit(Orbit(20)))
    for change in changes:
        qtbot.waitUntil(lambda: not view._rest.isActive(), timeout=60_000)
        QTest.qWait(REST_MS + 20)  # changes nearer to each other would be a movement
        before = view.frame_request()
        change()
        wanted = view.frame_request()
        assert (wanted.look, wanted.orbit) != (before.look, before.orbit)
        qtbot.waitUntil(lambda wanted=wanted: bool(drawn) and _same(drawn[-1].request, wanted), timeout=60_000)
    assert all(report.quality == FULL and not report.request.moving for report in drawn)


def _same(drawn, wanted):
    return (drawn.look, drawn.orbit) == (wanted.look, wanted.orbit)
