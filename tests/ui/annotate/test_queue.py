"""The queue of suspicious spots in the real window: what N offers, what it leaves out, what it learns."""

import threading

import numpy as np
import pytest
from annotating import choose_all, fill, place_points, refine

from genmojo_core.tracks import edit_tracks, suspicion
from genmojo_core.tracks.edit_tracks import update_track
from genmojo_core.tracks.suspicion import Spot


@pytest.fixture
def queue(workspace):
    """Two points filled by a line; the spots of a test are made by hand."""
    refine(workspace, each=1)
    return workspace.hands.going.queue


def spots(workspace, shift=0.0, first=0):
    """Three runs of the first track, one of another, worst first; scores shift as after any re-ranking."""
    one, other = list(workspace.session.annotation.tracks)[:2]
    return [Spot(t, a, a + 3, a + 1, score - shift, ("sudden motion",))
            for t, a, score in ((one, 4 + first, 0.9), (one, 12, 0.8), (other, 8, 0.7), (one, 18, 0.6))]  # fmt: skip


def press(workspace):
    workspace.table.trigger("annotate.move.worst")
    return workspace.session.track, workspace.session.frame


def test_every_spot_is_offered_once_however_the_ranking_changes_and_then_it_says_so(workspace, queue):
    session, said = workspace.session, []
    session.said.connect(said.append)
    shown = []
    for n in range(4):
        queue.set_spots(spots(workspace, 0.01 * n, first=n % 2))
        assert workspace.refine.title.text().startswith(f"Queue: {4 - n} of 4 left")
        shown.append(press(workspace))
        assert workspace.refine.queue.currentRow() == n
    assert len(set(shown)) == 4, shown
    assert not any("again" in s for s in said)
    assert press(workspace)[0] == shown[0][0] and "again from the worst" in said[-1]


def test_a_run_that_changed_is_offered_again_and_settled_tracks_are_not(workspace, queue):
    session = workspace.session
    queue.set_spots(spots(workspace))
    first = press(workspace)
    assert press(workspace) != first
    session.go(first[1])
    session.select_track(first[0])
    workspace.table.trigger("annotate.point.push_right")  # its run is no longer the one that was looked at
    queue.set_spots(spots(workspace))
    assert press(workspace) == first
    for change in ({"review": "approved"}, {"review": "draft", "locked": True}):
        session.do(update_track(session.annotation, first[0], **change))
        queue.set_spots(spots(workspace))
        assert {s.track for s in queue.spots}.isdisjoint({first[0]}) and len(queue.spots) == 1


def test_without_masks_a_jump_is_found_and_enter_stops_at_it(workspace, qtbot):
    choose_all(workspace)
    place_points(workspace, each=1)
    fill(workspace)
    workspace.show_step(2)
    session = workspace.session
    session.clip = session.clip.with_channels(masks=None)
    track = next(iter(session.annotation.tracks))
    cells = session.annotation.cells(track, np.array([10]))
    cells.xy[:] += 120
    session.annotation.write_cells(track, np.array([10]), cells)
    workspace.work.tracker.look_again()
    qtbot.waitUntil(lambda: track in session.suspicion and session.suspicion[track][10] > 0.5, timeout=60_000)
    shown = press(workspace)
    assert shown[0] == track and abs(shown[1] - 10) <= 1
    session.go(10)
    session.select_track(list(session.annotation.tracks)[1])
    workspace.table.trigger("annotate.move.accept")
    assert session.frame == 10 and session.track == track


def test_ranking_is_no_work_of_the_window_and_ends_also_without_masks(workspace, qtbot, monkeypatch):
    """Edits go on meanwhile: what was deleted is not offered, what was changed is ranked again."""
    choose_all(workspace)
    place_points(workspace, each=2)
    fill(workspace)
    session, tracker = workspace.session, workspace.work.tracker
    session.clip = session.clip.with_channels(masks=None)
    assess, began, go_on, ranked = suspicion.assess, threading.Event(), threading.Event(), []

    def slow(annotation, *rest):
        ranked.append((threading.current_thread(), annotation.revision))
        began.set()
        go_on.wait(60)
        return assess(annotation, *rest)

    monkeypatch.setattr(suspicion, "assess", slow)
    tracker.look_again()
    qtbot.waitUntil(began.is_set, timeout=60_000)
    gone, changed = list(session.annotation.tracks)[:2]
    offered = []
    tracker.spots_ready.connect(offered.append)
    session.do(edit_tracks.delete_track(session.annotation, gone))
    session.do(update_track(session.annotation, changed, name="nose"))
    go_on.set()
    qtbot.waitUntil(
        lambda: ranked[-1][1] == session.annotation.revision and len(offered) == len(ranked), timeout=60_000
    )
    assert all(gone not in {s.track for s in spots} for spots in offered) and gone not in session.suspicion
    assert not {thread for thread, _ in ranked} & {threading.main_thread()}
    count = len(ranked)
    qtbot.wait(1000)  # longer than it waits for another edit
    assert len(ranked) == count, "nothing has changed since"


def test_what_was_learnt_is_kept_with_the_project(workspace, qtbot):
    from genmojo_studio.annotate.tracking import Tracking

    choose_all(workspace)
    place_points(workspace, each=1)
    fill(workspace)
    workspace.show_step(2)
    session, tracker = workspace.session, workspace.work.tracker
    qtbot.waitUntil(lambda: set(tracker.suspicions) == set(session.annotation.tracks), timeout=120_000)
    session.go(session.annotation.frames - 1)
    for _ in range(5):
        workspace.table.trigger("annotate.move.accept")
    learnt = tracker.learnt.calibration.outcomes
    assert 0 < len(learnt) <= len(session.annotation.tracks)
    tracker.close()
    again = Tracking(session)
    assert again.learnt.calibration.rows() == tracker.learnt.calibration.rows()
    again.close()
