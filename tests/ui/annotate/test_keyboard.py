"""Everything that can be used with the mouse can be used with the keyboard, and is seen to have it.

Not covered: the float button in a panel's title and the handles between panels, which only arrange.
"""

import numpy as np
import pytest
from annotating import choose_all, fill, place_points
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractItemView,
    QAbstractSlider,
    QAbstractSpinBox,
    QApplication,
    QComboBox,
    QHeaderView,
    QLineEdit,
    QRadioButton,
    QScrollBar,
    QTabBar,
)

from genmojo_studio import theme
from genmojo_studio.annotate.canvas import Canvas
from genmojo_studio.annotate.dope_sheet import DopeSheet
from genmojo_studio.annotate.log_dialog import LogDialog
from genmojo_studio.annotate.merge_dialog import MergeDialog
from genmojo_studio.annotate.seed_dialog import SeedDialog

KINDS = (QAbstractButton, QAbstractItemView, QAbstractSlider, QAbstractSpinBox, QComboBox, QLineEdit, QTabBar,
         Canvas, DopeSheet)  # fmt: skip
INNER = (QAbstractSpinBox, QComboBox)  # what is part of these is used through them


@pytest.fixture(autouse=True)
def dressed(qapp):
    """As the app shows itself."""
    theme.apply(qapp, "dark")


def controls(root):
    """All that a person can use below `root` now; parts of a control belong to it."""
    found = []
    for widget in [w for kind in KINDS for w in root.findChildren(kind)]:
        above, inner = widget.parent(), False
        while above is not None and above is not root and not inner:
            inner, above = isinstance(above, INNER), above.parent()
        arranging = widget.objectName() in ("qt_dockwidget_floatbutton", "qt_dockwidget_closebutton")
        bare = isinstance(widget, (QHeaderView, QScrollBar)) or arranging or inner
        if widget.isVisible() and widget.isEnabled() and not bare and widget not in found:
            found.append(widget)
    return found


def looks(widget):
    picture = widget.grab().toImage().convertToFormat(widget.grab().toImage().Format.Format_RGB32)
    return np.frombuffer(picture.constBits(), np.uint8).copy()


def walk(start, stop=None, most=150):
    """Presses Tab from a widget on until `stop` or a widget seen before has the keyboard; the widgets on the way, and
    those of them that look the same with the keyboard and without."""
    start.window().setAttribute(Qt.WidgetAttribute.WA_KeyboardFocusChange)  # as after the first Tab
    start.setFocus(Qt.FocusReason.TabFocusReason)
    reached, unseen = [], []
    for _ in range(most):
        widget = QApplication.focusWidget()
        if widget is None or widget in reached or widget is stop:
            return reached, unseen
        reached.append(widget)
        if isinstance(widget, QRadioButton) and widget.group() is not None:
            reached += [b for b in widget.group().buttons() if b is not widget]  # arrows go on inside a group
        with_keyboard = looks(widget)
        QTest.keyClick(widget, Qt.Key.Key_Tab)
        if np.array_equal(with_keyboard, looks(widget)):
            unseen.append(widget)
    raise AssertionError(f"no end after {most} stops")


def said(widgets):
    return [(type(w).__name__, w.objectName(), w.accessibleName() or getattr(w, "text", str)()) for w in widgets]


@pytest.mark.parametrize("step", range(4))
def test_every_control_of_a_step_is_reached_and_shows_it(workspace, qtbot, step):
    choose_all(workspace)
    place_points(workspace, each=2)
    fill(workspace)
    workspace.show_step(step)
    qtbot.waitUntil(lambda: not workspace.work.tracker.tasks.busy, timeout=60_000)
    reached, unseen = {workspace.canvas}, []
    for panel in range(1, 5):
        workspace.canvas.setFocus()
        for _ in range(panel):
            workspace.table.trigger("annotate.move.panel")
        way, dark = walk(QApplication.focusWidget(), workspace.canvas)
        assert way, "F6 comes to every panel"
        reached |= set(way)
        unseen += dark
    by_key = {action.id for action in workspace.table if workspace.table.keys(action.id)}
    left = [w for w in controls(workspace) if w not in reached and w.objectName() not in by_key]
    assert not said(left), "Tab never comes here"
    assert not said(unseen), "nobody sees that the keyboard is here"
    workspace.table.trigger("annotate.move.panel")
    QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_Escape)
    assert QApplication.focusWidget() is workspace.canvas, "Escape brings the keyboard back to the frame"


def test_panels_are_shown_and_hidden_by_actions(workspace):
    for name, dock in workspace.docks.items():
        assert dock.isVisible() and workspace.table.is_checked(f"annotate.panel.{name}")
        workspace.table.trigger(f"annotate.panel.{name}")
        assert not dock.isVisible() and not workspace.table.is_checked(f"annotate.panel.{name}")
        for _ in range(5):
            workspace.table.trigger("annotate.move.panel")
            assert QApplication.focusWidget().isVisible()
        workspace.table.trigger(f"annotate.panel.{name}")
        assert dock.isVisible()


def shown(dialog, qtbot):
    dialog.open()
    dialog.activateWindow()
    qtbot.waitUntil(lambda: QApplication.activeWindow() is dialog, timeout=60_000)
    return dialog


def check_dialog(dialog):
    way, unseen = walk(next(w for w in controls(dialog) if w.focusPolicy() & Qt.FocusPolicy.TabFocus))
    left = [w for w in controls(dialog) if w not in way]
    assert not said(left), "Tab never comes here"
    assert not said(unseen), "nobody sees that the keyboard is here"


@pytest.mark.parametrize("tracker", ["optical", "scene", "cotracker", "file"])
def test_the_seed_dialog(workspace, qtbot, tracker):
    choose_all(workspace)
    place_points(workspace, each=1)
    dialog = shown(SeedDialog(workspace.session, workspace.work, workspace), qtbot)
    dialog.choose(tracker)
    check_dialog(dialog)
    dialog.reject()


def test_the_log(workspace, qtbot):
    choose_all(workspace)
    dialog = shown(LogDialog(workspace.session, workspace), qtbot)
    for tab in range(3):
        dialog.tabs.setCurrentIndex(tab)
        check_dialog(dialog)
    dialog.reject()


def test_the_merge_and_its_keys(workspace, qtbot):
    from genmojo_core.tracks import edit_tracks, keys
    from genmojo_core.tracks.annotation import Annotation

    choose_all(workspace)
    place_points(workspace, each=2)
    fill(workspace)
    mine, theirs = workspace.session.annotation, None
    theirs = Annotation(mine.frames, mine.size)
    edit_tracks.put_objects(theirs, list(mine.objects.values())).do(theirs)
    for track, info in mine.tracks.items():
        edit_tracks.add_track(theirs, info.object, info.number).do(theirs)
        keys.set_key(theirs, track, 3, (40.0, 30.0)).do(theirs)
        keys.set_state(theirs, track, 0, theirs.frames - 1, 1).do(theirs)
    dialog = shown(MergeDialog(workspace.session, theirs, None, workspace), qtbot)
    assert len(dialog.runs) >= 2
    check_dialog(dialog)
    dialog.table.setFocus()
    dialog.table.selectRow(0)
    QTest.keyClick(dialog.table, Qt.Key.Key_2)
    QTest.keyClick(dialog.table, Qt.Key.Key_3)
    assert [box.currentIndex() for box in dialog.choices[:2]] == [1, 2]
    dialog.reject()


def test_the_tour(workspace, qtbot):
    choose_all(workspace)
    workspace.start_tour()
    qtbot.waitUntil(lambda: workspace.tour is not None, timeout=120_000)
    note = workspace.tour.geometry()
    corner = workspace.grab().toImage().pixelColor(note.left() + 8, note.bottom() - 8)
    assert corner == workspace.tour.palette().window().color(), "what lies below must not shine through"
    workspace.tour.go(1)
    way, unseen = walk(workspace.tour.next, workspace.canvas)
    assert set(controls(workspace.tour)) <= set(way) and not said(unseen)
    workspace.canvas.setFocus()
    workspace.table.trigger("annotate.move.panel_back")
    assert QApplication.focusWidget() is workspace.tour.next, "F6 comes to the note"
    kind = type(workspace.tour)
    QTest.keyClick(workspace.tour.next, Qt.Key.Key_Escape)
    qtbot.waitUntil(lambda: not workspace.findChildren(kind), timeout=60_000)
