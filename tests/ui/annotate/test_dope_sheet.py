"""The dope sheet's view of time in the real window: zoom, scroll, what follows it, and that drawing stays cheap.

Not covered: touch pads whose driver sends gestures instead of wheels.
"""

import numpy as np
import pytest
from annotating import refine
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from genmojo_core.tracks import edit_tracks, keys
from genmojo_core.tracks.model import OCCLUDED, OUT_OF_VIEW, VISIBLE
from genmojo_studio.annotate.sheet_columns import Line, apart, columns, segments
from genmojo_studio.annotate.sheet_painter import LABEL, ROW, RULER

LEFT, MIDDLE, RIGHT = Qt.MouseButton.LeftButton, Qt.MouseButton.MiddleButton, Qt.MouseButton.RightButton
ALT = Qt.KeyboardModifier.AltModifier
PLAIN, CTRL, SHIFT = (Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.ControlModifier,
                      Qt.KeyboardModifier.ShiftModifier)  # fmt: skip


@pytest.fixture
def refining(workspace):
    """Two points per object, filled without a tracker."""
    refine(workspace, each=2)
    workspace.canvas.setFocus()
    return workspace


def cell(sheet, frame, row=0):
    return QPoint(round(sheet.x_of(frame + 0.5)), RULER + ROW * (row - sheet.verticalScrollBar().value()) + ROW // 2)


def wheel(widget, place, notches, modifiers=PLAIN):
    """A wheel turned away from the person where `notches` is above 0."""
    event = QWheelEvent(QPointF(place), QPointF(widget.mapToGlobal(place)), QPoint(), QPoint(0, 120 * notches),
                        Qt.MouseButton.NoButton, modifiers, Qt.ScrollPhase.NoScrollPhase, False)  # fmt: skip
    QApplication.sendEvent(widget, event)


def drag(widget, start, end, button=LEFT, modifiers=PLAIN):
    QTest.mousePress(widget, button, modifiers, start)
    QTest.mouseMove(widget, (start + end) / 2)
    QTest.mouseMove(widget, end)
    QTest.mouseRelease(widget, button, modifiers, end)


def test_ctrl_and_the_wheel_zoom_about_the_mouse_and_shift_and_the_wheel_scroll(refining):
    sheet, view = refining.play.sheet, refining.play.view
    place = cell(sheet, 12)
    before = sheet.axis().frame_at(place.x())
    for _ in range(4):
        wheel(sheet.viewport(), place, 1, CTRL)
    assert view.span < 0.5 * view.frames and abs(sheet.axis().frame_at(place.x()) - before) < 1e-6
    first = view.first
    wheel(sheet.viewport(), place, -1, SHIFT)
    assert view.first > first
    for button, modifiers in ((MIDDLE, PLAIN), (LEFT, SHIFT)):
        first, digest = view.first, refining.session.annotation.digest()
        drag(sheet.viewport(), place, place + QPoint(60, 0), button, modifiers)
        assert view.first < first and refining.session.annotation.digest() == digest
    wheel(sheet.viewport(), place, -40, CTRL)
    assert view.whole and view.first == 0
    refining.table.trigger("annotate.view.time_in")
    assert not view.whole
    QTest.mouseDClick(sheet.viewport(), LEFT, PLAIN, cell(sheet, int(view.first) + 2))
    assert view.whole


def test_clicks_and_drags_in_a_zoomed_sheet_mean_the_frames_that_are_drawn_there(refining):
    sheet, view, session = refining.play.sheet, refining.play.view, refining.session
    view.show(8.0, 16.0)
    QTest.mouseClick(sheet.viewport(), LEFT, PLAIN, cell(sheet, 11))
    assert session.frame == 11
    drag(sheet.viewport(), cell(sheet, 12), cell(sheet, 14))
    state = session.annotation.track(sheet.rows()[0]).state
    assert (state[12:15] == OCCLUDED).all() and state[11] == VISIBLE and state[15] == VISIBLE


def test_the_frame_on_show_stays_in_view_while_stepping_and_playing(refining):
    sheet, view, session = refining.play.sheet, refining.play.view, refining.session
    view.show(4.0, 10.0)
    session.go(5)
    for _ in range(12):
        refining.table.trigger("annotate.move.next")
        assert view.first <= session.frame < view.end and view.span == pytest.approx(6.0)
    for _ in range(12):
        refining.table.trigger("annotate.move.previous")
        assert view.first <= session.frame < view.end
    session.go(session.annotation.frames - 1)
    assert view.end == view.frames and sheet.frame_at(sheet.x_of(session.frame + 0.5)) == session.frame


def test_timeline_and_graphs_show_the_same_frames_as_the_sheet(refining, qtbot):
    play, session = refining.play, refining.session
    timeline, view = play.timeline, play.view
    for frame in (0, 20):  # the whole clip stands below its cells
        here = timeline.mapFromGlobal(play.sheet.viewport().mapToGlobal(QPoint(round(play.sheet.x_of(frame)), 0)))
        assert abs(here.x() - timeline.axis().x_of(frame)) <= 1.5
    view.show(6.0, 12.0)
    bar = timeline.bar()
    assert bar.left() == pytest.approx(timeline.axis().x_of(6.0)) and bar.right() == pytest.approx(
        timeline.axis().x_of(12.0)
    )
    drag(timeline, bar.center().toPoint(), bar.center().toPoint() + QPoint(80, 0))
    assert view.first > 6.5 and view.span == pytest.approx(6.0)
    drag(timeline, QPoint(round(timeline.bar().right()), 15), QPoint(timeline.width() - 1, 15))
    assert view.end == view.frames
    QTest.mouseClick(timeline, LEFT, PLAIN, QPoint(round(timeline.axis().x_of(3.5)), 4))
    assert session.frame == 3 and view.first <= 3, "a click in the timeline goes there, and the view follows"
    play.tabs.setCurrentIndex(1)
    qtbot.waitUntil(play.graphs.plot.isVisible, timeout=60_000)
    box = play.graphs.plot.getViewBox()
    view.show(2.0, 9.0)
    np.testing.assert_allclose(box.viewRange()[0], (1.5, 8.5))
    box.setXRange(4.5, 7.5, padding=0)
    assert (view.first, view.end) == (5.0, 8.0)
    session.select(session.active[0], 2)
    play.tabs.setCurrentIndex(0)
    view.show(1.0, 9.0)
    session.select(session.active[0], 1)
    assert (view.first, view.end) == (1.0, 9.0), "another point leaves the sheet where it is"


def test_many_rows_scroll_and_the_active_one_comes_into_view_while_labels_stay(refining):
    session, sheet = refining.session, refining.play.sheet
    owner = session.objects()[0].id
    for number in range(3, 60):
        session.do(edit_tracks.add_track(session.annotation, owner, number))
    bar = sheet.verticalScrollBar()
    assert bar.maximum() > 30 and len(sheet.rows()) > 57
    wheel(sheet.viewport(), cell(sheet, 3), -3)
    assert bar.value() == 6
    session.select(owner, 58)
    row = sheet.rows().index(session.track)
    assert bar.value() <= row < bar.value() + (sheet.viewport().height() - RULER) // ROW + 1
    labels = sheet.grab().toImage().copy(0, RULER, LABEL - 6, ROW * 4)
    refining.play.view.show(5.0, 9.0)
    assert sheet.grab().toImage().copy(0, RULER, LABEL - 6, ROW * 4) == labels


def line_of(state, flags=None, frames=10_000):
    state = np.broadcast_to(np.asarray(state, np.uint8), frames).copy()
    flags = np.zeros(frames, np.uint8) if flags is None else flags
    found = np.flatnonzero(flags & 1)
    return Line(state, flags, np.full(frames, 0.8, np.float32), found, np.zeros(len(found), np.uint8))


def test_where_many_frames_share_a_column_the_worst_of_them_is_shown():
    line = line_of(VISIBLE)
    line.state[5003], line.state[7001], line.state[9000] = OCCLUDED, OUT_OF_VIEW, 0
    line.flags[2000], line.sure[3000] = 2, 0.1
    doubt = np.zeros(10_000)
    doubt[4242] = 0.9
    seen = columns(line, doubt, (0.0, 10_000.0), 500)
    assert seen.state[[250, 350, 450]].tolist() == [OCCLUDED, OUT_OF_VIEW, 0] and (seen.state == VISIBLE).sum() == 497
    assert seen.uncertain.nonzero()[0].tolist() == [100] and seen.doubt.nonzero()[0].tolist() == [212]
    assert seen.sure[150] == np.float32(0.1) and (seen.sure < 0.5).sum() == 1
    close = columns(line, doubt, (5000.0, 10.0), 500)
    assert (close.state == OCCLUDED).nonzero()[0].tolist() == list(range(150, 200))
    ragged = columns(line, doubt, (4999.7, 733.3), 91)
    assert len(ragged.state) == 91 and (ragged.state == OCCLUDED).sum() == 1


def test_keys_and_segments_that_reach_into_the_view_are_drawn_and_no_more_than_fit():
    flags = np.zeros(10_000, np.uint8)
    flags[::2] = 1
    assert len(apart(np.flatnonzero(flags), (0.0, 10_000.0), 20.0)) == 500
    flags[:] = 0
    flags[[10, 500, 900]] = 1
    line = line_of(VISIBLE, flags)
    assert segments(line, (100.0, 50.0), 1.0) == [(10, 500, 0)] and segments(line, (950.0, 50.0), 1.0) == []
    assert apart(line.keys, (490.0, 20.0), 1.0).tolist() == [500]


def test_an_edit_draws_one_row_anew_and_a_step_none(refining, monkeypatch):
    from genmojo_studio.annotate import sheet_painter

    sheet, session = refining.play.sheet, refining.session
    sheet.grab()
    drawn = []
    real = sheet_painter.row_picture
    monkeypatch.setattr(sheet_painter, "row_picture", lambda *a: drawn.append(1) or real(*a))
    for frame in range(6):
        session.go(frame)
        session.select(session.active[0], 1 + frame % 2)
        sheet.grab()
    assert not drawn
    session.do(keys.set_state(session.annotation, sheet.rows()[0], 3, 4, OCCLUDED))
    sheet.grab()
    assert len(drawn) == 1


def test_stride_frames_are_marked_open_or_done_and_the_next_open_one_is_found(refining):
    session, play = refining.session, refining.play
    marks, tracks = play.marks, play.sheet.rows()
    session.set_stride(3)
    assert marks.frames()[:3].tolist() == [0, 3, 6] and marks.done().tolist() == [True] + [False] * (
        len(marks.frames()) - 1
    )
    ruler = play.sheet.viewport().grab().toImage().copy(0, 13, play.sheet.viewport().width(), 9)
    lane = play.timeline.grab().toImage()
    for frame in (3, 6, 12):
        session.do(keys.confirm(session.annotation, tracks, frame))
    assert marks.done()[:6].tolist() == [True, True, True, False, True, False]
    assert play.sheet.viewport().grab().toImage().copy(0, 13, ruler.width(), 9) != ruler
    assert play.timeline.grab().toImage() != lane
    session.go(0)
    QTest.keyClick(refining.canvas, Qt.Key.Key_Period, ALT)
    assert session.frame == 9
    QTest.keyClick(refining.canvas, Qt.Key.Key_Period, ALT)
    assert session.frame == 15
    QTest.keyClick(refining.canvas, Qt.Key.Key_Comma, ALT)
    assert session.frame == 9
    session.undo()
    assert not marks.done()[4]
    session.do(edit_tracks.update_track(session.annotation, tracks[0], locked=True))
    assert marks.done()[1] and not marks.done()[3]
    for track in tracks:
        session.do(edit_tracks.update_track(session.annotation, track, locked=True))
    said = []
    session.said.connect(said.append)
    refining.table.trigger("annotate.move.open_next")
    assert said == ["Every frame of the stride is accepted."] and marks.done().all()


def test_the_stride_of_a_clip_survives_a_restart_and_is_no_step_of_the_history(refining, tmp_path, clip_folder):
    from genmojo_studio.annotate.session import open_session

    rows = len(refining.session.project.history())
    refining.bar.stride.setValue(5)
    assert refining.session.stride == 5 and len(refining.session.project.history()) == rows
    path = refining.session.project.path
    refining.close_clip()
    refining.open_with(open_session(refining.state, path, "Ada"))
    assert refining.session.stride == 5 and refining.bar.stride.value() == 5
    refining.close_clip()
    refining.open_with(open_session(refining.state, clip_folder, "Ada", tmp_path / "other.genmojo"))
    assert refining.session.stride == 2 and refining.bar.stride.value() == 2, "each clip has a stride of its own"


def test_rows_are_sorted_by_suspicion_keys_and_gap_and_stay_while_keys_are_placed(refining):
    session, play = refining.session, refining.play
    rows, sheet = play.sheet.rows(), play.sheet
    plan = {rows[0]: (4, 8, 12, 20), rows[1]: (12,), rows[2]: (2, 4)}
    for track, frames in plan.items():
        for frame in frames:
            xy = session.annotation.track(track).xy[frame].tolist()
            session.do(keys.set_key(session.annotation, track, frame, xy))
    refining.table.trigger("annotate.view.order_keys")
    by_keys = sheet.rows()
    counts = [len(session.annotation.keys(track)) for track in by_keys]
    assert counts == sorted(counts) and by_keys[-1] == rows[0] and play.order.currentData() == "keys"
    assert refining.table.is_checked("annotate.view.order_keys")
    for frame in (9, 10, 11, 13):
        xy = session.annotation.track(by_keys[0]).xy[frame].tolist()
        session.do(keys.set_key(session.annotation, by_keys[0], frame, xy))
    assert sheet.rows() == by_keys, "rows do not run away from under the mouse"
    refining.table.trigger("annotate.view.order_gap")
    by_gap = sheet.rows()
    assert by_gap.index(rows[2]) < by_gap.index(rows[1]) < by_gap.index(rows[0])
    session.suspicion = {rows[1]: np.full(session.annotation.frames, 0.9)}
    play.order.setCurrentIndex(play.order.findData("suspicion"))
    play.order.activated.emit(play.order.currentIndex())
    assert sheet.rows()[0] == rows[1]
    refining.table.trigger("annotate.view.order_object")
    assert sheet.rows() == rows
