"""Work on threads: who is told, and that nothing of a closed window dies on a thread that was working for it."""

import gc
import threading
import weakref

import pytest
from PySide6.QtCore import QObject

from genmojo_studio.background import Tasks
from genmojo_studio.garbage import MOST, Collector


def test_results_and_errors_come_back_on_the_ui_thread(qapp, qtbot):
    tasks, told = Tasks(), []
    tasks.run(lambda: 6 * 7, lambda value: told.append((value, threading.current_thread())), told.append)
    tasks.run(lambda: 1 // 0, told.append, lambda error: told.append((type(error), threading.current_thread())))
    assert tasks.busy
    qtbot.waitUntil(lambda: len(told) == 2, timeout=60_000)
    assert told == [(42, threading.main_thread()), (ZeroDivisionError, threading.main_thread())]
    assert not tasks.busy
    tasks.close()


def test_after_closing_nobody_is_told(qapp, qtbot):
    tasks, told, go = Tasks(), [], threading.Event()
    tasks.run(lambda: go.wait(60), told.append, told.append)  # runs; the next one waits
    tasks.run(lambda: told.append("began"), told.append, told.append)
    tasks.close()
    go.set()
    other = Tasks()
    other.run(lambda: None, lambda _: told.append("later"), told.append)
    qtbot.waitUntil(lambda: told == ["later"], timeout=60_000)
    other.close()


@pytest.mark.parametrize("fails", [False, True])
def test_what_a_task_held_dies_on_the_ui_thread(qapp, qtbot, fails):
    """The window is closed while its task runs: the task alone keeps it, and the UI thread lets go of it."""
    died = []

    class Window:
        def __init__(self):
            self.tasks = Tasks()
            self.begun, self.go = threading.Event(), threading.Event()
            weakref.finalize(self, lambda: died.append(threading.current_thread()))

        def start(self):
            self.tasks.run(self.work, self.done, self.done)

        def work(self):
            self.begun.set()
            assert self.go.wait(60)
            return 1 // (not fails)

        def done(self, _):
            pytest.fail("told after it was closed")

    for _ in range(20):
        window = Window()
        window.start()
        begun, go = window.begun, window.go
        assert begun.wait(60)
        window.tasks.close()
        del window
        gc.collect()
        before = len(died)
        go.set()
        qtbot.waitUntil(lambda before=before: len(died) > before, timeout=60_000)
    assert set(died) == {threading.main_thread()}


def test_cycles_are_collected_by_the_timer_and_not_by_allocation(qapp, qtbot):
    keeper, died = QObject(), []
    collector = Collector(keeper)

    class Node:
        """Half of a cycle."""

    for _ in range(2 * gc.get_threshold()[0]):
        a, b = Node(), Node()
        a.other, b.other = b, a
        weakref.finalize(a, lambda: died.append(threading.current_thread()))
    assert not gc.isenabled() and not died
    qtbot.waitUntil(lambda: bool(died), timeout=60_000)
    assert set(died) == {threading.main_thread()}
    collector.deleteLater()


def test_what_came_at_once_in_great_number_is_never_gone_through_by_the_timer(qapp, qtbot):
    """A library that a thread has loaded: hundreds of thousands of objects that all stay."""
    keeper = QObject()
    collector = Collector(keeper)

    class Node:
        """Half of a cycle."""

    rounds = []
    gc.callbacks.append(rounds_of := lambda phase, info: rounds.append((phase, info["generation"])))
    try:
        stays = [[] for _ in range(MOST + 1)]
        a, b = Node(), Node()
        a.other, b.other = b, a
        gone = weakref.ref(a)
        del a, b
        before = gc.get_freeze_count()
        collector.collect()
        assert not rounds and gc.get_freeze_count() > before + MOST
    finally:
        gc.callbacks.remove(rounds_of)
    assert gone() is not None and len(stays) > MOST
    collector.sweep()
    assert gone() is None
    collector.deleteLater()


def test_what_outlived_a_full_collection_waits_for_a_sweep(qapp, qtbot):
    keeper = QObject()
    collector = Collector(keeper)

    class Node:
        """Half of a cycle."""

    a, b = Node(), Node()
    a.other, b.other = b, a
    gone = weakref.ref(a)
    gc.collect()
    gc.freeze()  # as after a collection of the oldest generation
    del a, b
    gc.collect()
    assert gone() is not None
    collector.sweep()
    assert gone() is None
    collector.deleteLater()
