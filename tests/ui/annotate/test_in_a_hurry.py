"""The annotator used faster than its solver, and keys that were taken back."""

import numpy as np
from annotating import choose_all, fill, place_points
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from genmojo_core.tracks.annotation import BY_HOLD, BY_LINE, BY_TRACKER, CONFIRMED, KEY
from genmojo_core.tracks.model import NONE, OCCLUDED, VISIBLE

CONTROL = Qt.KeyboardModifier.ControlModifier


def go(workspace, qtbot, frame):
    workspace.session.go(frame)
    qtbot.waitUntil(lambda: workspace.screen_link.painted == frame, timeout=60_000)


def settled(workspace, qtbot):
    qtbot.waitUntil(lambda: workspace.work.tracker.pending == 0, timeout=120_000)


def prepared(workspace, qtbot, seeded=False):
    """Every point on one place through the clip, or followed by the tracker; step Refine; the first track."""
    choose_all(workspace)
    place_points(workspace, each=1)
    if seeded:
        with qtbot.waitSignal(workspace.work.tracker.seeded, timeout=120_000):
            workspace.work.tracker.seed([workspace.session.objects()[0].id])
        workspace.session.select_track(next(iter(workspace.session.annotation.tracks)))
    else:
        fill(workspace)
    workspace.show_step(2)
    go(workspace, qtbot, 10)
    return workspace.session.track


def key_at(workspace, qtbot, track, frame, by):
    """A person's key, moved from where the point stands; solved."""
    go(workspace, qtbot, frame)
    x, y = map(float, workspace.session.annotation.track(track).xy[frame])
    workspace.hands.placing.dragged(track, x + by, y)
    settled(workspace, qtbot)


def test_enter_waits_for_the_solver_and_accepts_what_it_found(workspace, qtbot):
    track, session = prepared(workspace, qtbot), workspace.session
    session.go(8)
    qtbot.waitUntil(lambda: workspace.screen_link.painted == 8, timeout=60_000)
    x, y = map(float, session.annotation.track(track).xy[8])
    workspace.hands.placing.dragged(track, x + 9.0, y)
    assert workspace.work.tracker.pending == 1
    go(workspace, qtbot, 10)
    pending = workspace.work.tracker.pending
    workspace.table.trigger("annotate.move.accept")
    if pending:
        assert not session.annotation.track(track).flags[10] & CONFIRMED, "not where it is carried for the moment"
    settled(workspace, qtbot)
    qtbot.waitUntil(lambda: session.frame == 12, timeout=60_000)
    cells = session.annotation.track(track)
    assert cells.flags[10] & CONFIRMED
    apart = np.linalg.norm(cells.xy[10] - 0.5 * (cells.xy[9] + cells.xy[11]))
    assert apart < 3.0, "the accepted place belongs to the solved track"


def test_enter_does_not_accept_a_frame_that_is_not_on_show(workspace, qtbot):
    track, session = prepared(workspace, qtbot), workspace.session
    workspace.screen_link.painted = 9  # as while a frame is still being decoded
    workspace.table.trigger("annotate.move.accept")
    assert session.frame == 10
    assert not session.annotation.track(track).flags[10] & CONFIRMED


def test_deleting_a_key_takes_its_pull_away(workspace, qtbot):
    track, session = prepared(workspace, qtbot, seeded=True), workspace.session
    before = session.annotation.track(track).xy.copy()
    key_at(workspace, qtbot, track, 10, 20.0)
    assert np.linalg.norm(session.annotation.track(track).xy[12] - before[12]) > 3.0
    QTest.keyClick(workspace.canvas, Qt.Key.Key_Delete)
    settled(workspace, qtbot)
    off = np.linalg.norm(session.annotation.track(track).xy - before, axis=1)
    assert off.max() < 1.5
    session.undo()
    assert session.annotation.track(track).flags[10] & KEY, "one step with what was solved after it"


def test_ctrl_t_solves_the_segment_and_nothing_else(workspace, qtbot):
    track, session = prepared(workspace, qtbot, seeded=True), workspace.session
    key_at(workspace, qtbot, track, 12, 0.0)
    before = session.annotation.track(track).copy()
    go(workspace, qtbot, 18)
    QTest.keyClick(workspace.canvas, Qt.Key.Key_T, CONTROL)
    settled(workspace, qtbot)
    np.testing.assert_array_equal(session.annotation.track(track).xy[:13], before.xy[:13])


def test_the_mode_tracker_tracks_and_open_ends_have_no_choice(workspace, qtbot):
    track, session = prepared(workspace, qtbot, seeded=True), workspace.session
    key_at(workspace, qtbot, track, 14, 0.0)
    go(workspace, qtbot, 7)
    tracked = session.annotation.track(track).xy.copy()
    for mode in (BY_LINE, BY_HOLD, BY_TRACKER):
        QTest.keyClick(workspace.canvas, Qt.Key.Key_I)
        assert (workspace.work.tracker.pending > 0) == (mode == BY_TRACKER), "a line or a hold needs no solver"
        settled(workspace, qtbot)
        assert session.annotation.track(track).mode[0] == mode
    np.testing.assert_allclose(session.annotation.track(track).xy, tracked, atol=0.5)
    go(workspace, qtbot, 20)
    said = []
    session.said.connect(said.append)
    QTest.keyClick(workspace.canvas, Qt.Key.Key_I)
    assert said and session.annotation.track(track).mode[14] == BY_TRACKER


def test_frames_followed_one_by_one_wait_their_turn(workspace, qtbot):
    track, session = prepared(workspace, qtbot), workspace.session
    workspace.table.trigger("annotate.track.clear_after")
    assert session.annotation.track(track).state[11] == NONE
    for _ in range(3):
        QTest.keyClick(workspace.canvas, Qt.Key.Key_Right, Qt.KeyboardModifier.AltModifier)
    settled(workspace, qtbot)
    assert session.frame == 13
    assert (session.annotation.track(track).state[11:14] != NONE).all()


def test_a_gap_is_painted_and_a_mark_belongs_to_its_track(workspace, qtbot):
    track, session = prepared(workspace, qtbot), workspace.session
    QTest.keyClick(workspace.canvas, Qt.Key.Key_BracketLeft)
    go(workspace, qtbot, 12)
    QTest.keyClick(workspace.canvas, Qt.Key.Key_Backspace)
    assert session.annotation.track(track).state[9:14].tolist() == [VISIBLE, NONE, NONE, NONE, VISIBLE]
    QTest.keyClick(workspace.canvas, Qt.Key.Key_BracketLeft)
    other = next(t for t in session.annotation.tracks if t != track)
    session.select_track(other)
    go(workspace, qtbot, 15)
    QTest.keyClick(workspace.canvas, Qt.Key.Key_Q)
    QTest.keyRelease(workspace.canvas, Qt.Key.Key_Q)
    assert np.flatnonzero(session.annotation.track(other).state == OCCLUDED).tolist() == [15]
    session.select_track(track)
    QTest.keyClick(workspace.canvas, Qt.Key.Key_BracketLeft)
    QTest.keyClick(workspace.canvas, Qt.Key.Key_Escape)
    go(workspace, qtbot, 18)
    QTest.keyClick(workspace.canvas, Qt.Key.Key_Q)
    QTest.keyRelease(workspace.canvas, Qt.Key.Key_Q)
    assert np.flatnonzero(session.annotation.track(track).state == OCCLUDED).tolist() == [18]


def test_a_note_stays_with_the_track_that_it_was_typed_for(workspace, qtbot):
    track, session = prepared(workspace, qtbot), workspace.session
    note = workspace.refine.note
    note.setFocus()
    qtbot.waitUntil(note.hasFocus, timeout=60_000)
    QTest.keyClicks(note, "slips")
    other = next(t for t in session.annotation.tracks if t != track)
    session.select_track(other)
    qtbot.waitUntil(lambda: note.text() == "", timeout=60_000)
    assert session.annotation.tracks[track].note == "slips"
    assert session.annotation.tracks[other].note == ""
    QTest.keyClick(note, Qt.Key.Key_Return)
    assert workspace.canvas.hasFocus()
