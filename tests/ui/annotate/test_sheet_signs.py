"""What the dope sheet draws and says of a cell, and what its buttons and menu do, in the real window.

Not covered: whether the signs are beautiful.
"""

from dataclasses import replace

import numpy as np
import pytest
from annotating import refine
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QContextMenuEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLabel, QMenu

from genmojo_core.tracks import edit_tracks, keys
from genmojo_core.tracks.annotation import BY_HOLD, BY_LINE, BY_TRACKER, UNCERTAIN
from genmojo_core.tracks.model import OCCLUDED, OUT_OF_VIEW, VISIBLE
from genmojo_core.tracks.suspicion import SIGNALS, TRUST, Suspicion
from genmojo_studio.annotate.sheet_painter import LABEL, ROW, RULER
from genmojo_studio.annotate.sheet_words import label

LEFT, MIDDLE, RIGHT = Qt.MouseButton.LeftButton, Qt.MouseButton.MiddleButton, Qt.MouseButton.RightButton
PLAIN = Qt.KeyboardModifier.NoModifier


@pytest.fixture
def refining(workspace):
    """Two points per object, filled without a tracker; the first has keys in 4 and 20."""
    refine(workspace, each=2)
    session = workspace.session
    track = workspace.play.sheet.rows()[0]
    for frame in (4, 20):
        xy = session.annotation.track(track).xy[frame].tolist()
        session.do(keys.set_key(session.annotation, track, frame, xy))
    workspace.canvas.setFocus()
    return workspace


def cell(sheet, frame, row=0):
    return QPoint(round(sheet.x_of(frame + 0.5)), RULER + ROW * row + ROW // 2)


def pixels(sheet, frame, frames=1):
    """(h, w, 4) of some cells of the first row, as the screen shows them."""
    picture = sheet.viewport().grab().toImage()
    picture = picture.convertToFormat(picture.Format.Format_ARGB32)
    x0, x1 = round(sheet.x_of(frame)), round(sheet.x_of(frame + frames))
    part = picture.copy(x0, RULER, x1 - x0, ROW)
    return np.frombuffer(part.constBits(), np.uint8).reshape(ROW, x1 - x0, 4).astype(int)


def ask(sheet, place):
    """Right click there; the menu that opens."""
    event = QContextMenuEvent(QContextMenuEvent.Reason.Mouse, place, sheet.viewport().mapToGlobal(place))
    QTest.mousePress(sheet.viewport(), RIGHT, PLAIN, place)
    QApplication.sendEvent(sheet.viewport(), event)
    QTest.mouseRelease(sheet.viewport(), RIGHT, PLAIN, place)
    menu = QApplication.activePopupWidget()
    assert isinstance(menu, QMenu)
    return menu


def choose(menu, text):
    """Choose an entry by the beginning of its text, in the menu or in one below it; closes it."""
    entries = {a.text().split("\t")[0]: a for a in menu.actions()}
    for entry in list(menu.actions()):
        if entry.menu():
            entries |= {a.text().split("\t")[0]: a for a in entry.menu().actions()}
    action = next(a for title, a in entries.items() if title.startswith(text))
    assert action.isEnabled()
    action.trigger()
    menu.close()


def test_uncertain_places_and_the_filling_of_segments_look_different(refining):
    sheet, session = refining.play.sheet, refining.session
    track = sheet.rows()[0]
    looks = {}
    for mode in (BY_TRACKER, BY_LINE, BY_HOLD):
        session.do(keys.set_mode(session.annotation, track, 8, mode))
        looks[mode] = pixels(sheet, 10, 6)
    middle = slice(ROW // 2 - 4, ROW // 2 + 4)
    pairs = [(BY_TRACKER, BY_LINE), (BY_TRACKER, BY_HOLD), (BY_LINE, BY_HOLD)]
    for one, other in pairs:
        assert (np.abs(looks[one] - looks[other]).max(-1) > 60)[middle].sum() > 60, (one, other)
    before = pixels(sheet, 12, 4)
    session.do(keys.set_uncertain(session.annotation, track, 12, 15, True))
    after = pixels(sheet, 12, 4)
    changed = np.abs(after - before).max(-1) > 60
    assert changed[:6].sum() > 30 and not changed[7:].any()


def test_only_the_left_button_paints_and_a_right_click_gives_a_drag_up(refining):
    sheet, session = refining.play.sheet, refining.session
    refining.play.brush.setCurrentIndex(refining.play.brush.findData(OUT_OF_VIEW))
    before = session.annotation.digest()
    for button in (RIGHT, MIDDLE):
        QTest.mousePress(sheet.viewport(), button, PLAIN, cell(sheet, 6))
        QTest.mouseMove(sheet.viewport(), cell(sheet, 8))
        QTest.mouseMove(sheet.viewport(), cell(sheet, 10))
        QTest.mouseRelease(sheet.viewport(), button, PLAIN, cell(sheet, 10))
    QTest.mousePress(sheet.viewport(), LEFT, PLAIN, cell(sheet, 6))
    QTest.mouseMove(sheet.viewport(), cell(sheet, 8))
    QTest.mousePress(sheet.viewport(), RIGHT, PLAIN, cell(sheet, 9))
    QTest.mouseRelease(sheet.viewport(), RIGHT, PLAIN, cell(sheet, 9))
    QTest.mouseRelease(sheet.viewport(), LEFT, PLAIN, cell(sheet, 10))
    assert session.annotation.digest() == before
    QTest.mousePress(sheet.viewport(), LEFT, PLAIN, cell(sheet, 6))
    QTest.mouseMove(sheet.viewport(), cell(sheet, 8))
    QTest.mouseMove(sheet.viewport(), cell(sheet, 10))
    QTest.mouseRelease(sheet.viewport(), LEFT, PLAIN, cell(sheet, 10))
    assert (session.annotation.track(sheet.rows()[0]).state[6:11] == OUT_OF_VIEW).all()


def test_the_menu_of_a_cell_marks_runs_paints_fills_and_goes(refining):
    sheet, session = refining.play.sheet, refining.session
    track = sheet.rows()[1]
    session.go(0)
    choose(ask(sheet, cell(sheet, 9, 1)), "Go to frame 9")
    assert session.frame == 9 and session.track == track
    choose(ask(sheet, cell(sheet, 11, 1)), "Run starts here")
    choose(ask(sheet, cell(sheet, 15, 1)), "Run ends here")
    assert session.run == (11, 15)
    choose(ask(sheet, cell(sheet, 13, 1)), "Occluded")
    state = session.annotation.track(track).state
    assert (state[11:16] == OCCLUDED).all() and state[10] == state[16] == VISIBLE
    choose(ask(sheet, cell(sheet, 2, 1)), "Uncertain")
    assert session.annotation.track(track).flags[2] & UNCERTAIN
    first = sheet.rows()[0]
    menu = ask(sheet, cell(sheet, 8, 0))
    filled = next(a.menu() for a in menu.actions() if a.menu() and a.text() == "Segment filled by")
    assert [a.isChecked() for a in filled.actions()] == [True, False, False]
    choose(menu, "hold")
    assert session.annotation.track(first).mode[4] == BY_HOLD and session.frame == 8
    choose(ask(sheet, cell(sheet, 8, 0)), "Zoom to this segment")
    assert (refining.play.view.first, refining.play.view.end) == (3.0, 22.0)
    session.undo()
    assert session.annotation.track(first).mode[4] == BY_TRACKER


def test_what_is_chosen_for_a_frame_is_not_done_to_a_run_that_is_marked_elsewhere(refining):
    sheet, session = refining.play.sheet, refining.session
    track = sheet.rows()[1]
    for run in ((11, 15), (11, None)):
        before = session.annotation.track(track).copy()
        session.go(20)
        session.run, session.run_track = run, track
        choose(ask(sheet, cell(sheet, 6, 1)), "Occluded")
        choose(ask(sheet, cell(sheet, 4, 1)), "Uncertain")
        now = session.annotation.track(track)
        assert np.flatnonzero(now.state != before.state).tolist() == [6], run
        assert np.flatnonzero((now.flags ^ before.flags) & UNCERTAIN).tolist() == [4], run
        session.undo()
        session.undo()


def test_two_objects_and_points_of_the_same_name_are_told_apart(refining):
    session, sheet = refining.session, refining.play.sheet
    fish = [replace(info, name="fish") for info in session.objects()]
    session.do(edit_tracks.put_objects(session.annotation, fish))
    for track in sheet.rows():
        session.do(edit_tracks.update_track(session.annotation, track, name="tail"))
    labels = ["".join(label(session, track)) for track in sheet.rows()]
    assert len(set(labels)) == len(labels) >= 4 and labels[0].startswith("1·1") and "fish · tail" in labels[0]
    codes = [label(session, track)[0] for track in sheet.rows()]  # what is never cut short
    assert len(set(codes)) == len(codes)
    assert labels[1] in sheet.words_at(QPointF(LABEL / 2, RULER + 1.5 * ROW))


def test_the_mouse_is_told_state_marks_filling_and_doubt_in_words(refining):
    session, sheet = refining.session, refining.play.sheet
    track, frames = sheet.rows()[0], session.annotation.frames
    session.do(keys.set_state(session.annotation, track, 9, 12, OCCLUDED))
    session.do(keys.set_uncertain(session.annotation, track, 9, 9, True))
    parts = np.zeros((len(SIGNALS), frames))
    parts[0, 9] = 0.8
    trust = np.array(list(TRUST.values()))
    session.suspicions = {track: Suspicion(parts.max(axis=0), parts, trust)}
    session.suspicion = {track: parts.max(axis=0)}
    words = sheet.words_at(QPointF(cell(sheet, 9)))
    assert "frame 9: occluded, uncertain" in words and "keys 4 and 20" in words and "tracker" in words
    assert "suspicious (7 of 9)" in words and next(iter(SIGNALS.values())) in words
    assert "key" in sheet.words_at(QPointF(cell(sheet, 4))) and "suspicious" not in sheet.words_at(
        QPointF(cell(sheet, 4))
    )


def test_the_legend_opens_by_button_menu_and_key_and_explains_every_sign(refining):
    refining.play.help.click()
    legend = refining.play.legend
    assert legend.isVisible()
    texts = {one.text() for one in legend.findChildren(QLabel)}
    assert {"visible", "occluded", "out of view", "not annotated", "marked as uncertain"} <= texts
    samples = [one.pixmap().toImage() for one in legend.findChildren(QLabel) if not one.pixmap().isNull()]
    assert len(samples) >= 12
    assert all(a != b for n, a in enumerate(samples) for b in samples[:n]), "every sign looks different"
    QTest.keyClick(refining.canvas, Qt.Key.Key_F1, Qt.KeyboardModifier.ShiftModifier)
    assert refining.play.legend.isVisible() and refining.play.legend is not legend
