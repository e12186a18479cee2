"""Two annotators in the real window: their point is seen beside mine, what they alone have is offered, locks hold."""

import numpy as np
from annotating import choose_all, fill, place_points
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from genmojo_core.store.edit_codec import decode_annotation, encode_annotation
from genmojo_core.tracks import edit_tracks, keys
from genmojo_core.tracks.merge import MergeRun, MergeThing
from genmojo_studio.annotate.merge_dialog import MergeDialog


def sides(workspace):
    """A project with points that stand still, and a copy of it as the second annotator's."""
    choose_all(workspace)
    place_points(workspace)
    fill(workspace)
    return decode_annotation(encode_annotation(workspace.session.annotation))


def test_their_point_is_drawn_beside_mine_while_the_two_are_compared(workspace, qtbot):
    theirs = sides(workspace)
    session = workspace.session
    track = next(iter(session.annotation.tracks))
    x, y = (float(v) for v in session.annotation.track(track).xy[5])
    place = (x + 30.0, y + 20.0)
    keys.set_key(theirs, track, 5, place).do(theirs)
    dialog = MergeDialog(session, theirs, None, workspace)
    dialog.open()
    qtbot.waitActive(dialog, timeout=60_000)
    run = dialog.runs[0]
    assert isinstance(run, MergeRun)
    qtbot.waitUntil(lambda: workspace.screen_link.painted == (run.first + run.last) // 2, timeout=60_000)
    QTest.keyClick(dialog.table, Qt.Key.Key_Period)
    assert session.frame == (run.first + run.last) // 2 + 1
    QTest.keyClick(dialog.table, Qt.Key.Key_Comma)
    assert session.frame == (run.first + run.last) // 2
    session.go(5)
    qtbot.waitUntil(lambda: workspace.screen_link.painted == 5, timeout=60_000)
    (ghost,) = workspace.canvas.picture.ghosts
    assert ghost is not None
    np.testing.assert_allclose(ghost.xy[ghost.now], place, atol=1e-3)
    picture = workspace.canvas.grab().toImage()
    wx, wy = workspace.canvas.mapping.to_widget(*place)
    ratio = picture.devicePixelRatio()
    ring = [picture.pixelColor(round((wx + 9 * np.cos(a)) * ratio), round((wy + 9 * np.sin(a)) * ratio)).lightness()
            for a in np.linspace(0, 6.28, 24)]  # fmt: skip
    assert np.median(ring) > 230
    dialog.reject()
    assert not workspace.canvas.picture.ghosts


def test_what_only_they_have_is_offered_and_locked_rows_rest(workspace):
    theirs = sides(workspace)
    session = workspace.session
    one, other = list(session.annotation.tracks)[:2]
    owner = session.annotation.tracks[one].object
    edit_tracks.add_track(theirs, owner, 5, "Bob", "tail").do(theirs)
    keys.set_key(theirs, max(theirs.tracks), 2, (5.0, 5.0)).do(theirs)
    edit_tracks.update_track(theirs, other, name="nose").do(theirs)
    session.do(edit_tracks.update_track(session.annotation, other, locked=True))
    dialog = MergeDialog(session, theirs, None, workspace, "name")
    things = {(t.what, t.number): n for n, t in enumerate(dialog.runs) if isinstance(t, MergeThing)}
    number = session.annotation.tracks[other].number
    assert not dialog.choices[things["name", number]].isEnabled()
    assert dialog.choices[things["point", 5]].currentIndex() == 1
    assert not dialog.take.isEnabled()
    dialog.sure.setChecked(True)
    dialog.take.click()
    assert session.track_of(owner, 5) is not None
    assert session.annotation.tracks[other].name == ""


def test_nothing_in_common_is_said_and_can_still_be_merged(workspace):
    theirs = sides(workspace)
    session = workspace.session
    for track in list(session.annotation.tracks):
        session.do(edit_tracks.delete_track(session.annotation, track))
    dialog = MergeDialog(session, theirs, None, workspace)
    dialog.take.click()
    assert len(session.annotation.tracks) == len(theirs.tracks)
