"""Ways back, curves on show and the keyboard after a choice, in the real window."""

import pytest
from annotating import refine
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest

LEFT, PLAIN = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier


@pytest.fixture
def refining(workspace):
    """Two points per object, filled without a tracker."""
    refine(workspace, each=2)
    workspace.canvas.setFocus()
    return workspace


def test_back_and_ahead_know_clicks_scrubs_choices_and_undo(refining):
    session, sheet = refining.session, refining.play.sheet
    session.go(3)
    start = (session.frame, session.active)

    def spot(frame, row):
        return QPoint(int(sheet.x_of(frame + 0.5)), 30 + 18 * row + 9 if row is not None else 5)

    QTest.mouseClick(sheet.viewport(), LEFT, PLAIN, spot(15, 1))
    clicked = (session.frame, session.active)
    assert clicked[0] == 15 and clicked[1] != start[1]
    QTest.mousePress(sheet.viewport(), LEFT, PLAIN, spot(4, None))
    for frame in (6, 9, 12):
        QTest.mouseMove(sheet.viewport(), spot(frame, None))
    QTest.mouseRelease(sheet.viewport(), LEFT, PLAIN, spot(12, None))
    scrubbed = (session.frame, session.active)
    refining.strip.seek.emit(10)
    refining.refine.tree.chosen.emit(*start[1])
    session.undo()
    ways = []
    for _ in range(12):
        refining.table.trigger("annotate.move.back")
        ways.append((session.frame, session.active))
        if ways[-1] == start:
            break
    assert ways[-1] == start and clicked in ways and len(ways) <= 6, ways
    assert scrubbed[0] == 12 and scrubbed in ways
    back = ways[::-1]
    for place in back[1:]:
        refining.table.trigger("annotate.move.ahead")
        assert (session.frame, session.active) == place


def test_a_zoomed_graph_is_whole_again_for_another_curve_and_after_a_double_click(refining, qtbot):
    refining.play.tabs.setCurrentIndex(1)
    graphs = refining.play.graphs
    qtbot.waitUntil(graphs.isVisible, timeout=60_000)
    box, last = graphs.plot.getViewBox(), refining.session.annotation.frames - 1

    def zoom():
        box.setRange(xRange=(5.2, 5.8), yRange=(0.0, 0.1), padding=0)
        assert box.viewRange()[0][1] < 7

    def whole():
        return box.viewRange()[0][0] <= 0 and box.viewRange()[0][1] >= last

    qtbot.waitUntil(whole, timeout=60_000)
    zoom()
    refining.session.select(refining.session.active[0], 2)
    qtbot.waitUntil(whole, timeout=60_000)
    zoom()
    graphs.choice.setCurrentIndex(1)
    qtbot.waitUntil(whole, timeout=60_000)
    zoom()
    view = graphs.plot.viewport()
    for gesture in (QTest.mouseClick, QTest.mouseDClick, QTest.mouseRelease):  # what a mouse sends
        gesture(view, LEFT, PLAIN, view.rect().center())
    qtbot.waitUntil(whole, timeout=60_000)


@pytest.mark.parametrize("name", ["brush", "speed"])
def test_the_keyboard_goes_back_to_the_frame_after_a_choice_with_the_mouse(refining, qtbot, name):
    box = getattr(refining.play, name)
    box.showPopup()
    qtbot.waitUntil(box.view().isVisible, timeout=60_000)
    there = box.view().visualRect(box.model().index(1, 0)).center()
    QTest.mouseMove(box.view().viewport(), there)
    QTest.keyClick(box.view(), Qt.Key.Key_Down)
    QTest.keyClick(box.view(), Qt.Key.Key_Return)
    qtbot.waitUntil(refining.canvas.hasFocus, timeout=60_000)
    chosen = box.currentIndex()
    QTest.keyClick(refining.canvas, Qt.Key.Key_Right)
    assert box.currentIndex() == chosen and refining.session.frame == 1
