"""The annotator with real widgets: what a person does with mouse and keys, and what stands afterwards.

Not covered here: how good the trackers are (tests/trackers, tests/acceptance/5.py) and speed (tests/benchmarks).
"""

import sys

import numpy as np
import pyqtgraph
from annotating import at, choose_all, click, fill, place_points
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from genmojo_core.store.npz import read_tracks
from genmojo_core.store.project import Project
from genmojo_core.tracks.annotation import KEY
from genmojo_core.tracks.model import NONE, OCCLUDED, OUT_OF_VIEW, VISIBLE
from genmojo_studio.annotate import verbs
from genmojo_studio.annotate.take_tracks import ExportDialog


def drag(workspace, start, end):
    """Press at a raster place, move in three steps, let go."""
    QTest.mousePress(workspace.canvas, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, at(workspace, *start))
    for share in (0.4, 0.8, 1.0):
        x, y = (a + (b - a) * share for a, b in zip(start, end, strict=True))
        QTest.mouseMove(workspace.canvas, at(workspace, x, y))
    QTest.mouseRelease(workspace.canvas, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, at(workspace, *end))


def seed(workspace, qtbot):
    workspace.work.tracker.seed([o.id for o in workspace.session.objects()])
    qtbot.waitUntil(lambda: all((workspace.session.annotation.track(t).state != NONE).all()
                                for t in workspace.session.annotation.tracks), timeout=120_000)  # fmt: skip


def test_the_whole_path_with_mouse_and_keys(workspace, qtbot, tmp_path, monkeypatch):
    """Open, objects, points, seed, correct, states, review, export: and the file holds what was done."""
    session = workspace.session
    assert workspace.objects.table.rowCount() == len(session.clip.object_ids) >= 2
    choose_all(workspace)
    assert [o.status for o in session.objects()] == ["chosen"] * len(session.clip.object_ids)
    places = place_points(workspace)
    assert len(session.annotation.tracks) == len(places)
    for track, (x, y) in zip(session.annotation.tracks, places, strict=True):
        np.testing.assert_allclose(
            session.annotation.track(track).xy[0], (x, y), atol=0.5 / workspace.canvas.mapping.zoom
        )
    said = []
    session.said.connect(said.append)
    seed(workspace, qtbot)
    assert said[-1] == f"{len(places)} tracks are seeded.", "not that they are to be seeded now"
    workspace.show_step(2)

    track, t = next(iter(session.annotation.tracks)), 6
    session.select_track(track)
    session.go(t)
    qtbot.waitUntil(lambda: workspace.screen_link.painted == t, timeout=60_000)
    x, y = map(float, session.annotation.track(track).xy[t])
    before = session.annotation.digest()
    shift = 30 / workspace.canvas.mapping.zoom
    drag(workspace, (x, y), (x + shift, y))
    cells = session.annotation.track(track)
    assert cells.flags[t] & KEY and abs(cells.xy[t, 0] - x - shift) < 1.5 / workspace.canvas.mapping.zoom
    qtbot.waitUntil(lambda: not workspace.work.tracker.tasks.busy, timeout=60_000)
    session.undo()  # key and what the solver made of it are one step
    assert session.annotation.digest() == before
    session.redo()
    assert session.annotation.track(track).flags[t] & KEY

    workspace.show_step(3)
    workspace.table.trigger("annotate.review.approve")
    assert session.annotation.tracks[track].review == "approved"
    target = tmp_path / "out.npz"
    monkeypatch.setattr("PySide6.QtWidgets.QFileDialog.getSaveFileName", lambda *a, **k: (str(target), ""))
    workspace.table.trigger("annotate.file.export")
    workspace.findChild(ExportDialog).choose.click()
    qtbot.waitUntil(target.exists, timeout=60_000)
    stored = read_tracks(target, session.annotation.size)
    assert stored.xy.shape[:2] == (len(places), session.annotation.frames)

    path, digest = session.project.path, session.annotation.digest()
    workspace.close_clip()
    again = Project.open(path)
    assert again.annotation.digest() == digest
    again.close()


def test_a_state_key_held_while_stepping_paints_one_run(workspace, qtbot):
    choose_all(workspace)
    place_points(workspace, each=1)
    fill(workspace)
    workspace.show_step(2)
    session = workspace.session
    track = session.track
    session.go(4)
    steps = len(session.project.history())
    workspace.canvas.setFocus()
    QTest.keyPress(workspace.canvas, Qt.Key.Key_Q)
    for _ in range(3):
        QTest.keyClick(workspace.canvas, Qt.Key.Key_Right)
    assert len(session.project.history()) == steps, "nothing is stored before the key comes up"
    QTest.keyRelease(workspace.canvas, Qt.Key.Key_Q)
    assert (session.annotation.track(track).state[4:8] == OCCLUDED).all() and session.frame == 7
    session.undo()
    assert not (session.annotation.track(track).state[4:8] == OCCLUDED).all()


def test_a_state_key_held_over_an_undo_or_a_jump_paints_only_the_frames_stepped_through(workspace, qtbot):
    choose_all(workspace)
    place_points(workspace, each=1)
    fill(workspace)
    workspace.show_step(2)
    workspace.work.tracker.close()
    session = workspace.session
    track, canvas = session.track, workspace.canvas
    verbs.paint(session, track, OUT_OF_VIEW, 1, 1)  # undone it leads to frame 1
    session.go(9, jump=True)
    before = session.annotation.track(track).state.copy()
    canvas.setFocus()
    QTest.keyPress(canvas, Qt.Key.Key_Q)
    QTest.keyClick(canvas, Qt.Key.Key_Right)
    QTest.keyClick(canvas, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    QTest.keyRelease(canvas, Qt.Key.Key_Q)
    assert (session.annotation.track(track).state == before).all(), "what was being painted is what is undone"
    QTest.keyPress(canvas, Qt.Key.Key_Q)
    QTest.keyClick(canvas, Qt.Key.Key_Right)
    last = session.frame
    QTest.keyClick(canvas, Qt.Key.Key_Home, Qt.KeyboardModifier.AltModifier)
    assert session.frame != last
    QTest.keyRelease(canvas, Qt.Key.Key_Q)
    painted = np.flatnonzero(session.annotation.track(track).state != before)
    assert painted.tolist() == [last - 1, last]


def test_enter_stops_at_doubts_and_accepts_the_rest(workspace, qtbot):
    choose_all(workspace)
    place_points(workspace, each=1)
    fill(workspace)
    workspace.show_step(2)
    session = workspace.session
    workspace.work.tracker.close()  # the doubts of this test are made by hand
    session.suspicion = {t: np.zeros(session.annotation.frames) for t in session.annotation.tracks}
    doubted = list(session.annotation.tracks)[-1]
    session.suspicion[doubted][2] = 0.9
    session.select_track(next(iter(session.annotation.tracks)))
    session.go(2)
    workspace.table.trigger("annotate.move.accept")
    assert session.frame == 2 and session.track == doubted
    workspace.table.trigger("annotate.move.accept")
    assert session.frame == 4
    confirmed = session.annotation.at(2).flags
    assert (confirmed & 4).all()


def test_a_click_hits_the_pixel_it_shows_at_every_zoom(workspace):
    """Clicking the middle of a widget pixel gives the raster place under it, at any zoom and pan."""
    choose_all(workspace)
    workspace.show_step(1)
    canvas, got = workspace.canvas, []
    canvas.clicked.connect(lambda x, y: got.append((x, y)))
    for zoom in (1.0, 3.0, 7.5):
        canvas.zoom(zoom / canvas.mapping.zoom)
        for x, y in ((12.5, 20.5), (40.5, 33.5)):
            canvas.mapping = canvas.mapping.centred(x, y, (canvas.width(), canvas.height()))
            workspace.session.select(workspace.session.objects()[0].id, 1)
            click(workspace, x, y)
            assert np.hypot(got[-1][0] - x, got[-1][1] - y) <= 0.75 / zoom


def test_zoom_survives_frame_changes_and_nudges_are_a_quarter_pixel(workspace, qtbot):
    choose_all(workspace)
    place_points(workspace, each=1)
    fill(workspace)
    session, canvas = workspace.session, workspace.canvas
    canvas.zoom(3.0)
    zoom = canvas.mapping
    session.go(5)
    qtbot.waitUntil(lambda: workspace.screen_link.painted == 5, timeout=60_000)
    assert canvas.mapping == zoom
    session.go(0)
    x, y = session.annotation.track(session.track).xy[0].tolist()
    QTest.keyClick(canvas, Qt.Key.Key_Right, Qt.KeyboardModifier.ControlModifier)
    QTest.keyClick(canvas, Qt.Key.Key_Down, Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier)
    np.testing.assert_allclose(session.annotation.track(session.track).xy[0], (x + 0.25, y + 1.0), atol=1e-4)


def test_the_dope_sheet_seeks_and_paints(workspace, qtbot):
    choose_all(workspace)
    place_points(workspace, each=1)
    fill(workspace)
    workspace.show_step(2)
    sheet, session = workspace.play.sheet, workspace.session
    qtbot.wait(50)
    row, view = 0, sheet.viewport()

    def cell(frame):
        return QPoint(round(sheet.x_of(frame + 0.5)), 30 + 18 * row + 9)

    QTest.mouseClick(view, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, cell(9))
    assert session.frame == 9 and session.track == sheet.rows()[0]
    QTest.mousePress(view, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, cell(10))
    QTest.mouseMove(view, cell(11))
    QTest.mouseMove(view, cell(13))
    QTest.mouseRelease(view, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, cell(13))
    assert (session.annotation.track(sheet.rows()[0]).state[10:14] == OCCLUDED).all()
    assert session.annotation.track(sheet.rows()[0]).state[9] == VISIBLE


def test_review_returns_a_track_with_reason_and_run(workspace, qtbot, monkeypatch):
    choose_all(workspace)
    place_points(workspace, each=1)
    fill(workspace)
    workspace.show_step(3)
    session, track = workspace.session, workspace.session.track
    session.go(3)
    workspace.table.trigger("annotate.point.run_start")
    session.go(6)
    workspace.table.trigger("annotate.point.run_end")
    workspace.review.reason.setCurrentIndex(2)
    workspace.review.note.setText("jumps to the other one")
    workspace.review.fix_button.click()
    info = session.annotation.tracks[track]
    assert (info.review, info.reason, info.run, info.person) == ("needs_fix", "swap", (3, 6), "Ada")
    assert "came back" in workspace.bar.buttons[2].toolTip() or workspace._steps_later.isActive()


def test_every_action_is_bound_and_has_no_rival(workspace):
    from genmojo_studio.actions import PRESETS
    from genmojo_studio.annotate.actions import ACTIONS

    unbound = [a.id for a in ACTIONS if not workspace.table.is_bound(a.id)]
    assert not unbound
    for preset in PRESETS:
        workspace.table.set_preset(preset)
        assert workspace.table.conflicts() == []
    workspace.table.set_preset("Studio")


def test_all_that_can_be_pressed_has_a_name_and_takes_the_keyboard(workspace):
    from PySide6.QtWidgets import QAbstractButton, QAbstractItemView, QComboBox, QHeaderView

    nameless = []
    for kind in (QAbstractButton, QAbstractItemView, QComboBox):
        for widget in workspace.findChildren(kind):
            parents = ("QDockWidget", "QComboBoxPrivateContainer", "QTabBar", "QTableWidget", "QSpinBox")
            inner = isinstance(widget, QHeaderView) or isinstance(widget.parent(), QComboBox)
            if inner or widget.objectName().startswith("qt_") or widget.parent().metaObject().className() in parents:
                continue
            text = widget.accessibleName() or (widget.text() if isinstance(widget, QAbstractButton) else "")
            if not (text or widget.toolTip()):
                nameless.append((widget.metaObject().className(), widget.objectName()))
    assert not nameless
    workspace.canvas.setFocus()
    seen = set()
    panels = (workspace.canvas, workspace.bar, workspace.buttons, workspace.pages, workspace.play)
    for _ in panels:
        workspace.table.trigger("annotate.move.panel")
        focus = workspace.focusWidget()
        seen.add(next(n for n, w in enumerate(panels) if w is focus or w.isAncestorOf(focus)))
    assert seen == {0, 1, 2, 3, 4}


def test_repaints_do_not_lose_references_to_none(workspace, qapp):
    """PySide6 6.12.0 drops None in every paint until the interpreter dies; the pinned versions must not."""
    choose_all(workspace)
    place_points(workspace, each=1)
    for _ in range(20):
        workspace.canvas.repaint()
    start = sys.getrefcount(None)
    for k in range(400):
        workspace.session.go(k % 6)
        workspace.canvas.repaint()
        workspace.play.sheet.viewport().repaint()
        qapp.processEvents()
    assert abs(sys.getrefcount(None) - start) < 300, "one reference per repaint is lost or leaked"


def test_keys_stay_with_the_field_or_list_that_has_the_keyboard(workspace, qtbot):
    """Enter in a note must not accept a frame, Space on a button must press it, arrows in the tree must move in it."""
    choose_all(workspace)
    place_points(workspace, each=2)
    fill(workspace)
    workspace.show_step(2)
    session = workspace.session
    session.go(4)
    note = workspace.refine.note
    note.setFocus()
    QTest.keyClicks(note, "a dot")
    QTest.keyClick(note, Qt.Key.Key_Return)
    assert session.frame == 4 and session.annotation.tracks[session.track].note == "a dot"
    tree = workspace.refine.tree
    tree.setFocus()
    before = session.active
    QTest.keyClick(tree, Qt.Key.Key_Down)
    assert session.active == (before[0], before[1] + 1) and session.frame == 4
    QTest.keyClick(tree, Qt.Key.Key_Right)
    assert session.frame == 5
    workspace.show_step(3)
    session.select_track(next(iter(session.annotation.tracks)))
    track = session.track
    workspace.review.approve_button.setFocus()
    QTest.keyClick(workspace.review.approve_button, Qt.Key.Key_Space)
    assert session.annotation.tracks[track].review == "approved" and not workspace.play.player.playing


def test_another_clip_takes_the_place_of_the_first_and_nothing_is_lost(workspace, clip_folder, tmp_path):
    from genmojo_studio.annotate.session import open_session

    choose_all(workspace)
    first = workspace.session.project.path
    digest = workspace.session.annotation.digest()
    workspace.close_clip()
    workspace.open_with(open_session(workspace.state, clip_folder, "Bea", tmp_path / "b.genmojo"))
    assert not workspace.session.objects() and workspace.session.project.person == "Bea"
    again = Project.open(first)
    assert again.annotation.digest() == digest
    again.close()


def test_figures_come_however_slowly_a_clip_is_put_on_show(workspace, qtbot, clip_folder):
    """The window answers between the parts of opening: what a thread finds meanwhile must not be lost."""
    before = workspace.work
    for _ in workspace.opening(clip_folder):
        if workspace.work is not before:
            qtbot.wait(20)
            qtbot.waitUntil(lambda: not workspace.work.tasks.busy, timeout=60_000)
    qtbot.waitUntil(lambda: bool(workspace.objects.figures), timeout=60_000)


def test_tracking_one_frame_matches_the_pixels(workspace, qtbot):
    """Alt+Right takes the point where the object went, not where it was."""
    choose_all(workspace)
    places = place_points(workspace, each=1)
    workspace.show_step(2)
    session = workspace.session
    track, (x, y) = next(iter(session.annotation.tracks)), places[0]
    session.select_track(track)
    workspace.canvas.setFocus()
    QTest.keyClick(workspace.canvas, Qt.Key.Key_Right, Qt.KeyboardModifier.AltModifier)
    qtbot.waitUntil(lambda: session.annotation.track(track).state[1] != NONE, timeout=60_000)
    labels = [
        np.argwhere(session.cache.read(t) is not None and session.cache.mask(t) == session.active[0]) for t in (0, 1)
    ]
    moved = (labels[1].mean(axis=0) - labels[0].mean(axis=0))[::-1]
    assert session.frame == 1 and np.linalg.norm(moved) > 0.5
    np.testing.assert_allclose(session.annotation.track(track).xy[1] - (x, y), moved, atol=1.5)


def test_a_step_without_points_is_not_done_and_states_are_readable_in_both_themes(workspace, qapp, qtbot):
    from genmojo_studio import theme

    assert not workspace.bar.buttons[2].text().endswith("✓"), "there is nothing to refine yet"
    choose_all(workspace)
    place_points(workspace, each=1)
    fill(workspace)
    workspace.show_step(3)
    item = workspace.review.tree.topLevelItem(0).child(0)
    for name in ("dark", "light"):
        theme.apply(qapp, name)
        workspace.state.set(theme=name)
        shade = workspace.review.tree.palette().text().color()
        qtbot.waitUntil(lambda shade=shade: item.foreground(1).color() == shade, timeout=60_000)


def test_a_knot_of_a_curve_is_dragged_to_another_place(workspace, qtbot, monkeypatch):
    """The key moves in the curve's own direction and by what the plot shows, nowhere else; undo takes it back."""
    choose_all(workspace)
    place_points(workspace, each=1)
    fill(workspace)
    workspace.show_step(2)
    session, graphs = workspace.session, workspace.play.graphs
    monkeypatch.setitem(pyqtgraph.CONFIG_OPTIONS, "mouseRateLimit", 0)  # moves of a test come in no time
    workspace.play.tabs.setCurrentIndex(1)
    graphs.choice.setCurrentIndex(1)  # y
    qtbot.waitUntil(lambda: graphs.knots is not None and graphs.plot.isVisible(), timeout=60_000)
    view, track, before = graphs.plot.getPlotItem().vb, session.track, session.annotation.digest()
    x, y = session.annotation.track(track).xy[0].tolist()
    session.go(9)

    def pixel(value):
        return graphs.plot.mapFromScene(view.mapViewToScene(QPointF(0.0, value)))

    viewport = graphs.plot.viewport()
    qtbot.waitUntil(lambda: viewport.rect().adjusted(5, 25, -5, -25).contains(pixel(y)), timeout=60_000)
    start = pixel(y)
    per_pixel = view.viewPixelSize()[1]
    for kind, point, buttons in (
        (QEvent.Type.MouseButtonPress, start, Qt.MouseButton.LeftButton),
        *((QEvent.Type.MouseMove, start - QPoint(0, d), Qt.MouseButton.LeftButton) for d in (4, 8, 14, 20)),
        (QEvent.Type.MouseButtonRelease, start - QPoint(0, 20), Qt.MouseButton.NoButton),
    ):
        button = Qt.MouseButton.NoButton if kind == QEvent.Type.MouseMove else Qt.MouseButton.LeftButton
        place = QPointF(point)
        event = QMouseEvent(kind, place, viewport.mapToGlobal(place), button, buttons, Qt.KeyboardModifier.NoModifier)
        QApplication.sendEvent(viewport, event)
    moved = session.annotation.track(track).xy[0].tolist()
    assert session.frame == 0 and moved[0] == x
    assert abs(moved[1] - y - 20 * per_pixel) <= 2 * per_pixel and moved[1] != y
    qtbot.waitUntil(lambda: not workspace.work.tracker.tasks.busy, timeout=60_000)
    session.undo()
    assert session.annotation.digest() == before


def test_a_track_is_rejected_and_limits_are_ones_own(workspace):
    choose_all(workspace)
    workspace.objects.limits["points"].setValue(6)
    place_points(workspace, each=6)
    session = workspace.session
    assert {i.number for i in session.annotation.tracks.values()} == {1, 2, 3, 4, 5, 6}
    fill(workspace)
    workspace.show_step(3)
    track = session.track
    workspace.review.note.setText("cannot be told from its neighbour")
    workspace.table.trigger("annotate.review.reject")
    info = session.annotation.tracks[track]
    assert (info.review, info.review_note, info.reviewer) == ("rejected", "cannot be told from its neighbour", "Ada")
    assert session.track != track
    session.undo()
    assert session.annotation.tracks[track].review != "rejected"
