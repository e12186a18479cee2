"""A point in the hand and points out of sight: dragging, the reticle, arrows at the rim, the way back to a view.

Not covered: how arrows and reticle look (tests/acceptance/annotator_screens.py); keys that a person changed.
"""

import numpy as np
import pytest
from annotating import at, refine
from PySide6.QtCore import QEvent, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QMouseEvent
from PySide6.QtTest import QTest

from genmojo_core.tracks import keys
from genmojo_core.tracks.annotation import KEY
from genmojo_core.tracks.model import OCCLUDED, OUT_OF_VIEW
from genmojo_studio.annotate import rim
from genmojo_studio.annotate.colours import point_colour
from genmojo_studio.annotate.mapping import Mapping
from genmojo_studio.annotate.overlay import Mark

NONE, SHIFT, CTRL, ALT = (Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.ShiftModifier,
                          Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.AltModifier)  # fmt: skip
LEFT = Qt.MouseButton.LeftButton


@pytest.fixture
def refining(workspace, qtbot):
    refine(workspace, each=2)
    shown(workspace, qtbot, workspace.session.frame)
    return workspace


def shown(workspace, qtbot, frame):
    qtbot.waitUntil(lambda: workspace.screen_link.painted == workspace.session.frame == frame, timeout=60_000)


def place(workspace, track=None, frame=None):
    session = workspace.session
    frame = session.frame if frame is None else frame
    xy = session.annotation.track(session.track if track is None else track).xy[frame]
    return float(xy[0]), float(xy[1])


def grab(workspace, track=None):
    """Press on a point and drag it a little; its new place is where the mouse is."""
    canvas, start = workspace.canvas, at(workspace, *place(workspace, track))
    QTest.mousePress(canvas, LEFT, NONE, start)
    for share in (10, 20):
        QTest.mouseMove(canvas, start + QPointF(share, share).toPoint())
    QTest.qWait(20)
    assert canvas.dragged_to() is not None
    return start


def let_go(workspace):
    QTest.mouseRelease(workspace.canvas, LEFT, NONE, workspace.canvas._mouse.toPoint())


@pytest.mark.parametrize("key", ["Right", "Left", "Period", "Comma", "Return", "N", "Down", "End", "B", "Space"])
def test_the_frame_stands_still_while_a_point_is_held(refining, qtbot, key):
    workspace, session, said = refining, refining.session, []
    session.said.connect(said.append)
    session.go(5)
    shown(workspace, qtbot, 5)
    before = session.annotation.track(session.track).flags.copy()
    grab(workspace)
    there = workspace.canvas.dragged_to()
    QTest.keyClick(workspace.canvas, getattr(Qt.Key, f"Key_{key}"))
    QTest.qWait(60)
    assert session.frame == 5 and not workspace.play.player.playing and "Esc" in said[-1]
    assert workspace.canvas.dragged_to() == there, "and the point stays in the hand"
    let_go(workspace)
    changed = np.flatnonzero(session.annotation.track(session.track).flags != before)
    assert changed.tolist() == [5] and session.annotation.track(session.track).flags[5] & KEY
    assert place(workspace) == pytest.approx(there, abs=1e-3)
    QTest.keyClick(workspace.canvas, Qt.Key.Key_Right)
    assert session.frame == 6, "afterwards all keys work again"


def test_nothing_is_undone_deleted_or_painted_under_a_held_point(refining, qtbot):
    workspace, session = refining, refining.session
    track = session.track
    grab(workspace)
    revision = session.annotation.revision
    QTest.keyClick(workspace.canvas, Qt.Key.Key_Z, CTRL)
    QTest.keyClick(workspace.canvas, Qt.Key.Key_Delete, SHIFT)
    QTest.keyClick(workspace.canvas, Qt.Key.Key_Q)
    QTest.keyClick(workspace.canvas, Qt.Key.Key_Tab)
    assert session.annotation.revision == revision and session.track == track
    let_go(workspace)
    assert session.annotation.revision != revision and session.annotation.track(track).flags[0] & KEY


def test_playing_stops_where_a_point_is_taken(refining, qtbot):
    workspace, session = refining, refining.session
    workspace.play.player.speed = 0.1
    workspace.table.trigger("annotate.move.play")
    qtbot.waitUntil(lambda: session.frame == 1 and workspace.screen_link.painted == 1, timeout=60_000)
    grab(workspace)
    assert not workspace.play.player.playing
    let_go(workspace)
    assert session.annotation.track(session.track).flags[1] & KEY


def test_a_point_of_a_frame_that_is_about_to_go_is_not_taken(refining, qtbot, monkeypatch):
    workspace, session = refining, refining.session
    monkeypatch.setattr(session.cache, "get", lambda _frame: None)  # not decoded yet
    session.go(7)
    revision = session.annotation.revision
    start = at(workspace, *place(workspace))
    QTest.mousePress(workspace.canvas, LEFT, NONE, start)
    QTest.mouseMove(workspace.canvas, start + QPointF(30, 0).toPoint())
    QTest.qWait(20)
    let_go(workspace)
    assert session.annotation.revision == revision and not session.holding


def test_escape_puts_the_point_back_and_only_that(refining, qtbot):
    workspace, session = refining, refining.session
    session.run, session.run_track = (0, 4), session.track
    where, revision, view = place(workspace), session.annotation.revision, workspace.canvas.mapping
    start = grab(workspace)
    QTest.keyClick(workspace.canvas, Qt.Key.Key_Escape)
    assert workspace.canvas.dragged_to() is None and not session.holding and session.run == (0, 4)
    QTest.mouseMove(workspace.canvas, start + QPointF(70, 40).toPoint())
    QTest.qWait(20)
    let_go(workspace)
    assert session.annotation.revision == revision and place(workspace) == where
    assert workspace.canvas.mapping == view, "what is left of the movement does not pan"
    grab(workspace)
    let_go(workspace)
    assert session.annotation.revision != revision, "and it can be taken again"


def test_shift_slows_the_hand_and_the_reticle_goes_with_the_point(refining, qtbot):
    workspace, canvas = refining, refining.canvas
    start = grab(workspace)
    before, zoom = canvas.dragged_to(), canvas.mapping.zoom
    there = QPointF(start) + QPointF(60, 20)
    canvas.mouseMoveEvent(QMouseEvent(QEvent.Type.MouseMove, there, canvas.mapToGlobal(there), Qt.MouseButton.NoButton,
                                      LEFT, SHIFT))  # fmt: skip
    moved = canvas.dragged_to()[0] - before[0]
    assert moved == pytest.approx(40 / 8 / zoom)
    canvas.set_reticle(40)
    x, y = canvas.mapping.to_widget(*canvas.dragged_to())
    picture = canvas.grab().toImage()
    canvas.set_reticle(6)
    without = canvas.grab().toImage()
    for dx, dy in ((30, 0), (-30, 0), (0, 30), (0, -30)):
        spots = [(int(x) + dx + i, int(y) + dy + k) for i in (-1, 0, 1) for k in (-1, 0, 1)]
        assert any(picture.pixel(*spot) != without.pixel(*spot) for spot in spots), "an arm of the reticle"
    let_go(workspace)


def test_no_other_point_hides_where_one_is_dragged_to(refining, qtbot):
    workspace, canvas, session = refining, refining.canvas, refining.session
    mine, other = session.annotation.tracks_of(session.active[0])[:2]
    session.select_track(mine.id)
    target = canvas.mapping.to_widget(*place(workspace, other.id))
    session.trail = 0
    session.shown.emit()
    alone = canvas.grab().toImage()
    grab(workspace, mine.id)
    QTest.mouseMove(canvas, QPointF(*target).toPoint())
    QTest.qWait(20)
    held = canvas.grab().toImage()
    let_go(workspace)
    colour = QColor(*point_colour(session.place_of(other.object), other.number - 1))

    def near(picture):
        spots = [QColor(picture.pixel(round(target[0]) + dx, round(target[1]) + dy)) for dx in range(-8, 9)
                 for dy in range(-8, 9)]  # fmt: skip
        return sum(abs(s.red() - colour.red()) + abs(s.green() - colour.green()) + abs(s.blue() - colour.blue()) < 40
                   for s in spots)  # fmt: skip

    assert near(alone) > 12 and near(held) < near(alone) / 3


def test_the_reticle_keeps_its_size(refining, qtbot):
    workspace = refining
    size = workspace.canvas.reticle
    grab(workspace)
    QTest.keyClick(workspace.canvas, Qt.Key.Key_Equal, ALT)
    assert workspace.canvas.reticle == size + 4 and workspace.canvas.dragged_to() is not None
    let_go(workspace)
    assert workspace.settings.whole("reticle", 0) == size + 4
    workspace.settings.put("reticle", "broken [")
    assert workspace.settings.whole("reticle", 18) == 18
    workspace.settings.put("reticle", str(size))


def test_an_arrow_leads_to_a_point_out_of_sight_and_back_again(refining, qtbot):
    workspace, canvas, session = refining, refining.canvas, refining.session
    other = session.annotation.tracks_of(session.objects()[1].id)[0]
    active = session.active
    canvas.zoom(12.0)
    x, y = place(workspace)
    canvas.centre_on(x, y)
    view = canvas.mapping
    arrow = next(a for a in canvas._arrows() if a.mark.track == other.id)
    assert QRectF(canvas.rect()).contains(arrow.at)
    QTest.mouseClick(canvas, LEFT, NONE, arrow.at.toPoint())
    assert session.track == other.id
    assert canvas.mapping.to_widget(*place(workspace)) == pytest.approx((canvas.width() / 2, canvas.height() / 2))
    assert canvas.mapping.zoom == view.zoom
    QTest.keyClick(canvas, Qt.Key.Key_Home, ALT)
    assert session.active == active and canvas.mapping.zoom == pytest.approx(view.zoom)
    assert canvas.mapping.to_image(9, 9) == pytest.approx(view.to_image(9, 9), abs=0.02), "back to what was seen"
    QTest.keyClick(canvas, Qt.Key.Key_End, ALT)
    assert session.track == other.id
    canvas.fit()
    session.remember()
    canvas.zoom(3.0)
    QTest.keyClick(canvas, Qt.Key.Key_F, SHIFT)
    assert canvas.mapping.to_widget(*place(workspace)) == pytest.approx((canvas.width() / 2, canvas.height() / 2))
    for _ in range(2):
        QTest.keyClick(canvas, Qt.Key.Key_Home, ALT)
    assert canvas.view() is None, "the whole frame, as before"


def test_a_point_beyond_the_picture_is_found_and_dragged(refining, qtbot):
    workspace, canvas, session = refining, refining.canvas, refining.session
    track, width = session.track, session.annotation.size[0]
    session.do(keys.set_key(session.annotation, track, 0, (width + 60.0, 20.0), OUT_OF_VIEW))
    QTest.mouseClick(canvas, LEFT, NONE, next(a for a in canvas._arrows() if a.mark.track == track).at.toPoint())
    assert canvas.mapping.to_widget(width + 60.0, 20.0) == pytest.approx((canvas.width() / 2, canvas.height() / 2))
    assert not any(a.mark.track == track for a in canvas._arrows())
    grab(workspace, track)
    there = canvas.dragged_to()
    let_go(workspace)
    assert place(workspace) == pytest.approx(there, abs=1e-3) and there[0] > width
    assert session.annotation.track(track).state[0] == OUT_OF_VIEW


def test_arrows_keep_apart_and_near_their_direction():
    view, mapping = QRectF(0, 0, 900, 500), Mapping(1.0)
    rng = np.random.default_rng(3)
    away = [(float(x), float(y)) for x, y in rng.uniform(-2000, 3000, (40, 2)) if not view.contains(QPointF(x, y))]
    crowd = [(2000.0, 250.0 + k) for k in range(6)]
    marks = [Mark(n, xy, OCCLUDED if n % 2 else 1, 0, 0, n % 5) for n, xy in enumerate([*away[:14], *crowd])]
    found = rim.arrows([*marks, Mark(99, (10.0, 10.0), 1, 0, 0, 0), Mark(98, (-50.0, 0.0), 0, 0, 0, 0),
                        Mark(97, (np.nan, 0.0), 2, 0, 0, 0)], mapping, view)  # fmt: skip
    assert [a.mark.track for a in found] == list(range(20))
    spots = np.array([(a.at.x(), a.at.y()) for a in found])
    away_from = np.linalg.norm(spots[:, None] - spots[None], axis=-1) + 1e3 * np.eye(len(spots))
    assert away_from.min() > 0.7 * rim.APART - 1e-6, "round a corner the way is shorter than along the rim"
    assert all(rim.hit(found, a.at) is a.mark for a in found)
    for arrow in found:
        assert view.adjusted(20, 20, -20, -20).contains(arrow.at)
    assert rim.arrows(marks, mapping, QRectF(0, 0, 40, 40)) == []
