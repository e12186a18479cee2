"""A large part of the window is made in many turns of the event loop; all at once where somebody cannot wait."""

from PySide6.QtCore import QObject, QTimer

from genmojo_studio.assembly import Assembly


def _parts(made, count=5):
    for number in range(count):
        made.append(number)
        yield


def test_other_work_has_its_turn_between_two_parts(qapp, qtbot):
    made, between, owner = [], [], QObject()
    other = QTimer(owner, interval=0)
    other.timeout.connect(lambda: between.append(len(made)))
    other.start()
    done = []
    Assembly(_parts(made), owner).start(lambda: done.append(len(made)))
    assert not made  # nothing is done in the turn that asks for it
    qtbot.waitUntil(lambda: bool(done), timeout=60_000)
    other.stop()
    assert done == [5] and {1, 2, 3, 4} <= set(between)


def test_who_cannot_wait_has_all_of_it_now_and_nothing_twice(qapp, qtbot):
    made, done, owner = [], [], QObject()
    assembly = Assembly(_parts(made), owner)
    assembly.start(lambda: done.append("first"))
    qtbot.waitUntil(lambda: bool(made), timeout=60_000)
    assembly.finish()
    assert made == [0, 1, 2, 3, 4]
    assembly.start(lambda: done.append("second"))
    qtbot.waitUntil(lambda: len(done) == 2, timeout=60_000)
    assert made == [0, 1, 2, 3, 4] and done == ["first", "second"]


def test_a_window_that_closes_makes_no_more_of_it(qapp, qtbot):
    made, done, owner = [], [], QObject()
    assembly = Assembly(_parts(made, 10**9), owner)  # more than there is time for
    assembly.start(lambda: done.append(1))
    qtbot.waitUntil(lambda: len(made) > 1, timeout=60_000)
    assembly.stop()
    seen = len(made)
    later = []
    QTimer.singleShot(50, owner, lambda: later.append(1))
    qtbot.waitUntil(lambda: bool(later), timeout=60_000)
    assert len(made) == seen and not done


def test_watch_is_made_on_the_start_page_before_a_clip_is_opened(window, qtbot):
    qtbot.waitUntil(lambda: "watch" in window.workspaces, timeout=60_000)
    assert window.workspace == "" and not window.workspaces["watch"].isVisible()
    made = window.workspaces["watch"]
    window.show_workspace("watch")
    assert window.workspaces["watch"] is made and made.isVisible()
    assert made.docks["view"].width() >= 200 and made.center.width() > made.docks["view"].width()
