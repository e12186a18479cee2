"""The history dialog: every state is listed and reached, also branches that redo does not lead to."""

from annotating import choose_all, place_points
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from genmojo_core.store.project import Project
from genmojo_studio.annotate.history_dialog import HistoryDialog


def opened(workspace):
    assert workspace.table.trigger("annotate.edit.history")
    (dialog,) = [d for d in workspace.findChildren(HistoryDialog) if d.isVisible()]
    return dialog


def branched(workspace):
    """Points placed, some taken back, another put in their place; the states of both ends."""
    choose_all(workspace)
    place_points(workspace, each=2)
    session = workspace.session
    left, digest = session.project.log.head, session.annotation.digest()
    for _ in range(2):
        session.undo()
    place_points(workspace, each=2)
    return left, digest


def test_a_branch_is_gone_to_and_back_from(workspace, qtbot):
    left, digest = branched(workspace)
    session = workspace.session
    now, here = session.annotation.digest(), session.project.log.head
    dialog = opened(workspace)
    assert dialog.marked() == here and not dialog.go_button.isEnabled() and not dialog.back_button.isEnabled()
    dialog.choose(left)
    assert dialog.marked() == left
    dialog.go_button.click()
    assert session.annotation.digest() == digest and session.project.log.head == left
    dialog.back_button.click()
    assert session.annotation.digest() == now and session.project.log.head == here
    dialog.choose(left)
    dialog.go_button.click()
    session.project.wait()
    path = session.project.path
    assert workspace.close()
    project = Project.open(path)
    assert project.annotation.digest() == digest
    project.close()


def test_named_moments_stand_in_the_history_and_are_found(workspace, qtbot):
    left, digest = branched(workspace)
    session = workspace.session
    session.go_to(left)
    session.project.checkpoint("before {lunch}")
    session.undo()
    dialog = opened(workspace)
    dialog.named.setChecked(True)
    shown = [i for i in dialog._items() if not i.isHidden() and i.data(0, Qt.ItemDataRole.UserRole) is not None]
    assert [i.text(1) for i in shown if i.text(1)] == ["before {lunch}"]
    dialog.choose(left)
    dialog.go()
    assert session.annotation.digest() == digest


def test_the_history_follows_what_is_done_beside_it_and_ends_with_the_clip(workspace, qtbot):
    branched(workspace)
    dialog = opened(workspace)
    workspace.session.undo()
    qtbot.waitUntil(lambda: dialog._history.head == workspace.session.project.log.head, timeout=60_000)
    workspace.session.project.checkpoint("noon")
    qtbot.waitUntil(lambda: any(i.text(1) == "noon" for i in dialog._items()), timeout=60_000)
    workspace.close_clip()
    qtbot.waitUntil(lambda: not workspace.findChildren(HistoryDialog), timeout=60_000)


def test_the_key_opens_it(workspace, qtbot):
    choose_all(workspace)
    QTest.keyClick(workspace.canvas, Qt.Key.Key_H, Qt.KeyboardModifier.ControlModifier)
    assert [d.isVisible() for d in workspace.findChildren(HistoryDialog)] == [True]
