"""Swap, split and join in the window: partners told apart, shown before they are done, one step each, and why not."""

import numpy as np
import pytest
from annotating import refine
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from genmojo_core.tracks import keys
from genmojo_core.tracks.annotation import KEY
from genmojo_core.tracks.edit_tracks import put_objects
from genmojo_studio.annotate.exchange_dialog import ExchangeDialog


def ask(workspace, kind):
    """The dialog that the menu opens."""
    assert workspace.table.trigger(f"annotate.track.{kind}")
    return next(d for d in workspace.findChildren(ExchangeDialog) if d.isVisible())


def choose(dialog, point):
    rows = {dialog.partners.item(r).data(Qt.ItemDataRole.UserRole): r for r in range(dialog.partners.count())}
    dialog.partners.setCurrentRow(rows[point])


@pytest.fixture
def refined(workspace):
    """Two objects that have the same name, two points each, all known in every frame; the first is active."""
    refine(workspace, 2)
    session = workspace.session
    named = [session.annotation.objects[o.id] for o in session.objects()]
    session.do(put_objects(session.annotation, [type(o)(o.id, "dog", o.order, o.status, "moves") for o in named]))
    return workspace


def test_points_of_objects_of_one_name_are_told_apart_and_the_right_one_is_swapped(refined, qtbot):
    session = refined.session
    annotation = session.annotation
    dialog = ask(refined, "swap")
    texts = [dialog.partners.item(r).text() for r in range(dialog.partners.count())]
    assert len(set(texts)) == len(texts) == len(annotation.tracks) - 1
    mine = session.track
    second = session.objects()[1].id
    choose(dialog, (second, 1))
    theirs = session.track_of(second, 1)
    places = [annotation.track(t).xy[0].copy() for t in (mine, theirs)]
    dialog.frames.setCurrentIndex(dialog.frames.count() - 1)
    dialog.take.click()
    for track, place in zip((mine, theirs), reversed(places), strict=True):
        np.testing.assert_array_equal(annotation.track(track).xy[0], place)
    session.undo()
    for track, place in zip((mine, theirs), places, strict=True):
        np.testing.assert_array_equal(annotation.track(track).xy[0], place)


def test_a_swap_takes_the_marked_frames_and_shows_them_before(refined, qtbot):
    session = refined.session
    session.go(2)
    refined.table.trigger("annotate.point.run_start")
    session.go(4)
    refined.table.trigger("annotate.point.run_end")
    mine, before = session.track, session.annotation.track(session.track).xy.copy()
    head = session.project.log.head
    dialog = ask(refined, "swap")
    assert "2" in dialog.frames.currentText()
    assert "4" in dialog.frames.currentText()
    ghosts = refined.canvas.picture.ghosts
    assert len(ghosts) == 2
    assert all(g.label.startswith("→") for g in ghosts)
    assert ghosts[0].colour != ghosts[1].colour
    np.testing.assert_array_equal(session.annotation.track(mine).xy, before)  # nothing is done yet
    assert session.project.log.head == head
    QTest.keyClick(dialog.partners, Qt.Key.Key_Period)
    assert session.frame == 5
    dialog.take.click()
    changed = (session.annotation.track(mine).xy != before).any(axis=1)
    assert np.flatnonzero(changed).tolist() == [2, 3, 4]
    assert not refined.canvas.picture.ghosts
    assert session.run == (None, None)


def test_a_dialog_that_is_cancelled_leaves_nothing_behind(refined, qtbot):
    head = refined.session.project.log.head
    dialog = ask(refined, "join")
    assert refined.canvas.picture.ghosts or dialog.take.isEnabled()
    dialog.reject()
    assert not refined.canvas.picture.ghosts
    assert refined.session.project.log.head == head


def test_a_split_goes_to_a_free_point_and_a_join_brings_it_back(refined, qtbot):
    session = refined.session
    session.go(3)
    mine, before = session.track, session.annotation.track(session.track).copy()
    dialog = ask(refined, "split")
    free = [dialog.partners.item(r).data(Qt.ItemDataRole.UserRole) for r in range(dialog.partners.count())]
    assert session.active not in free
    assert not any(session.track_of(*p) for p in free)
    point = dialog.partner()
    assert point[0] == session.active[0]
    dialog.take.click()
    new = session.track
    assert session.active == point
    assert not session.annotation.track(mine).state[3:].any()
    assert session.annotation.track(new).state[3:].all()
    session.select_track(mine)
    dialog = ask(refined, "join")
    choose(dialog, point)
    dialog.take.click()
    for now, then in zip(session.annotation.track(mine).arrays(), before.arrays(), strict=True):
        np.testing.assert_array_equal(now, then)
    assert new not in session.annotation.tracks


def test_a_join_tells_conflicts_and_asks_who_wins(refined, qtbot):
    session = refined.session
    own, other = session.annotation.tracks_of(session.active[0])[:2]
    for track, x in ((own.id, 11.0), (other.id, 77.0)):
        session.do(keys.set_key(session.annotation, track, 3, (x, 20.0)))
    session.select_track(own.id)
    dialog = ask(refined, "join")
    choose(dialog, (other.object, other.number))
    frames = session.annotation.frames
    assert f"{frames} frames both" in dialog.about.text()
    dialog.winner.setCurrentIndex(1)
    dialog.take.click()
    cells = session.annotation.track(own.id)
    assert cells.flags[3] & KEY
    assert cells.xy[3, 0] == 77.0
    session.undo()
    assert session.annotation.track(own.id).xy[3, 0] == 11.0


def test_what_cannot_be_done_is_said(refined, qtbot):
    session, said = refined.session, []
    session.said.connect(said.append)
    refined.table.trigger("annotate.track.lock")
    for kind in ("swap", "split", "join"):
        said.clear()
        refined.table.trigger(f"annotate.track.{kind}")
        assert len(said) == 1
        assert "locked" in said[0]
    refined.table.trigger("annotate.track.lock")
    session.do(keys.clear(session.annotation, session.track, 3, session.annotation.frames - 1))
    session.go(3)
    said.clear()
    refined.table.trigger("annotate.track.split")
    assert said == ["This track has nothing from this frame on; go to an earlier frame."]
    assert not any(d.isVisible() for d in refined.findChildren(ExchangeDialog))


def test_commands_that_find_nothing_to_do_say_so(refined, qtbot):
    session, said = refined.session, []
    session.said.connect(said.append)
    for frame, action, words in (
        (0, "track.clear_before", "nothing to forget"),
        (session.annotation.frames - 1, "track.clear_after", "nothing to forget"),
        (3, "point.object_9", "no object 9"),
    ):
        session.go(frame)
        said.clear()
        head = session.project.log.head
        refined.table.trigger(f"annotate.{action}")
        assert any(words in one for one in said), action
        assert session.project.log.head == head
    session.do(keys.clear(session.annotation, session.track, 3, 3))
    said.clear()
    refined.table.trigger("annotate.point.key")
    assert said == ["The point has no place in this frame."]
