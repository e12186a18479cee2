"""The shared state: what panels rely on. No window."""

import threading

import pytest

from genmojo_studio.state import AppState


def test_a_change_is_told_once_and_only_to_whom_it_concerns():
    state, heard = AppState(), []
    state.subscribe(lambda: heard.append("frame"), "frame")
    state.subscribe(lambda: heard.append("speed"), "speed")
    state.set(frame_count=10, frame=5)
    assert heard == ["frame"]
    state.set(frame=5)
    assert heard == ["frame"]


def test_the_frame_stays_inside_the_clip():
    state = AppState()
    state.set(frame_count=4, frame=99)
    assert state.frame == 3
    state.set(frame_count=2)
    assert state.frame == 1
    state.set(frame=-5)
    assert state.frame == 0


def test_unknown_names_are_refused():
    state = AppState()
    with pytest.raises(AttributeError):
        state.set(frmae=3)
    with pytest.raises(AttributeError):
        state.subscribe(print, "frmae")


def test_a_subscription_ends_with_its_object():
    class Panel:
        count = 0

        def heard(self):
            Panel.count += 1

    state, panel = AppState(), Panel()
    state.subscribe(panel.heard, "speed")
    state.set(speed=2.0)
    del panel
    state.set(speed=4.0)
    assert Panel.count == 1


def test_other_threads_may_not_change_it():
    state, faults = AppState(), []

    def change():
        try:
            state.set(speed=2.0)
        except RuntimeError as error:
            faults.append(error)

    thread = threading.Thread(target=change)
    thread.start()
    thread.join()
    assert faults and state.speed == 1.0
