"""Step 2 as a person does it: on which frame points land, which one is next, what clicks and nudges move, snapping.

Not covered: how good the places are that the meter likes (tests/acceptance/5.py).
"""

import shutil
from dataclasses import replace

import cv2
import numpy as np
import pytest
from annotating import at, choose_all, click, fill, place_points
from clip_files import put_mask
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from genmojo_core.clip import images
from genmojo_studio.annotate import steps
from genmojo_studio.annotate.session import open_session
from genmojo_studio.annotate.snap import corner

CTRL = Qt.KeyboardModifier.ControlModifier
LATE = 3  # the frame in which the second object of `late` appears


@pytest.fixture
def said(workspace):
    sentences = []
    workspace.session.said.connect(sentences.append)
    return sentences


@pytest.fixture
def late(workspace, qtbot, clip_folder, tmp_path):
    """A clip whose second object is first seen in frame LATE."""
    root = tmp_path / "late"
    shutil.copytree(clip_folder, root)
    second = workspace.session.annotation.objects[sorted(workspace.session.annotation.objects)[1]].id
    for path in sorted((root / "Annotations").rglob("*.png"))[:LATE]:
        labels = images.read_labels(path).index
        put_mask(path, np.where(labels == second, 0, labels).astype(np.uint8))
    workspace.close_clip()
    workspace.open_with(open_session(workspace.state, root, "Ada", tmp_path / "late.genmojo"))
    qtbot.waitUntil(lambda: bool(workspace.objects.figures), timeout=60_000)
    shown(workspace, qtbot, 0)
    return workspace


def shown(workspace, qtbot, frame):
    qtbot.waitUntil(lambda: workspace.screen_link.painted == workspace.session.frame == frame, timeout=60_000)


def inside(workspace, object_id, share=0.5):
    """A raster place on an object's mask in the frame on show."""
    rows, columns = np.nonzero(workspace.session.cache.mask(workspace.session.frame) == object_id)
    k = int(share * len(rows))
    return float(columns[k]) + 0.5, float(rows[k]) + 0.5


def test_points_land_on_the_first_frame_of_their_object(late, qtbot):
    workspace, session = late, late.session
    choose_all(workspace)
    workspace.objects.limits["points"].setValue(2)
    first, second = session.objects()[:2]
    session.select(first.id, 1)
    session.go(8)
    shown(workspace, qtbot, 8)
    workspace.show_step(steps.place_of("points"))
    shown(workspace, qtbot, 0)  # wherever one came from
    for share in (0.4, 0.6):
        click(workspace, *inside(workspace, first.id, share))
    shown(workspace, qtbot, LATE)  # the other object is not there before
    assert session.active == (second.id, 1)
    session.go(LATE + 2)
    shown(workspace, qtbot, LATE + 2)
    assert f"frame {LATE} on" in workspace.points.next.text(), "a start that is late for no reason is said before"
    session.go(LATE)
    shown(workspace, qtbot, LATE)
    click(workspace, *inside(workspace, second.id))
    starts = {i.object: session.annotation.keys(i.id).tolist() for i in session.annotation.tracks.values()}
    assert starts == {first.id: [0], second.id: [LATE]}
    item = workspace.points.tree._items[second.id, 1]
    qtbot.waitUntil(lambda: item.text(1) == f"frame {LATE}, late", timeout=60_000)
    session.go(LATE + 1)
    workspace.screen_link.painted = LATE  # as while a frame is still being read: what is on show is another one
    before = session.annotation.digest()
    workspace.hands.placing.clicked(*inside(workspace, first.id))
    assert session.annotation.digest() == before


def test_clicks_place_and_what_has_its_place_stays(workspace, said):
    choose_all(workspace)
    workspace.show_step(steps.place_of("points"))
    session = workspace.session
    owner = session.objects()[0].id
    session.select(owner, 1)
    x, y = inside(workspace, owner)
    click(workspace, x, y)
    one, two = session.track_of(owner, 1), (owner, 2)
    assert session.active == two
    start = session.annotation.track(one).xy[0].tolist()
    QTest.keyClick(workspace.canvas, Qt.Key.Key_Right, CTRL)  # the point placed just now, not the next one
    assert session.annotation.track(one).xy[0].tolist() == pytest.approx([start[0] + 0.25, start[1]])
    assert session.active == two and "nudge" in workspace.points.next.text()
    session.undo()
    session.select(*two)

    click(workspace, x + 9 / workspace.canvas.mapping.zoom, y)  # in reach of point 1, and yet a place of its own
    assert session.track_of(*two) is not None and session.active == (owner, 3)
    click(workspace, x, y)  # on the glyph of point 1: that one is meant
    assert session.active == (owner, 1)
    before = session.annotation.digest()
    click(workspace, 3.0, 3.0)
    assert session.annotation.digest() == before and "has its place" in said[-1]
    click(workspace, x + 4 / workspace.canvas.mapping.zoom, y)
    assert session.annotation.digest() != before, "a click beside it moves it"

    session.undo()
    session.undo()
    assert session.active == two, "the point taken back is the next to be placed"
    click(workspace, -2.0, y)
    assert session.track_of(*two) is None and "inside the picture" in said[-1]
    session.select(owner, 1)
    for _ in range(round(x) + 2):
        QTest.keyClick(workspace.canvas, Qt.Key.Key_Left, CTRL | Qt.KeyboardModifier.ShiftModifier)
    assert session.annotation.track(one).xy[0, 0] < 0 and "outside the picture" in said[-1]


def test_names_are_of_an_object_and_those_typed_stay(workspace):
    choose_all(workspace)
    places = place_points(workspace, each=3)
    session, page = workspace.session, workspace.points
    one, other = (o.id for o in session.objects()[:2])
    names = lambda owner: [i.name for i in session.annotation.tracks_of(owner)]  # noqa: E731
    session.select(one, 2)
    page.name.setFocus()
    QTest.keyClicks(page.name, "left ear")
    QTest.keyClick(page.name, Qt.Key.Key_Return)
    page.template.setCurrentIndex(page.template.findData("animal"))
    assert names(one) == ["left eye", "left ear", "nose"]
    session.select(other, 1)
    assert page.template.currentData() == "free" and names(other) == ["", "", ""]
    page.template.setCurrentIndex(page.template.findData("vehicle"))
    session.select(one, 1)
    assert page.template.currentData() == "animal"
    page.template.setCurrentIndex(page.template.findData("fish"))
    assert names(one) == ["eye", "left ear", "back fin"], "a template changes what a template said"
    session.undo()
    assert names(one) == ["left eye", "left ear", "nose"] and page.template.currentData() == "animal"
    assert names(other)[0] == "front left" and len(places) >= 6


def corner_at(x, y, angle, size=60, fine=8):
    """(size, size, 4) uint8 frame: a quarter plane whose tip is at a raster place, each pixel the mean of its area."""
    v, u = (np.mgrid[0 : size * fine, 0 : size * fine] + 0.5) / fine
    c, s = np.cos(angle), np.sin(angle)
    on = (c * (u - x) + s * (v - y) > 0) & (c * (v - y) - s * (u - x) > 0)
    grey = np.where(on, 200.0, 40.0).reshape(size, fine, size, fine).mean(axis=(1, 3))
    return np.dstack([grey] * 3 + [np.full_like(grey, 255)]).astype(np.uint8)


def test_snapping_finds_corners_to_a_part_of_a_pixel_and_nothing_else():
    for x, y, angle in ((30.0, 30.0, 0.0), (30.3, 29.6, 0.5), (28.75, 31.5, 1.2)):
        for dx, dy in ((0.0, 0.0), (3.0, -2.0), (-4.0, 3.0)):
            found = corner(corner_at(x, y, angle), (x + dx, y + dy))
            assert found is not None and np.hypot(found[0] - x, found[1] - y) < 0.2
        assert corner(corner_at(x, y, angle), (x + 9.0, y)) is None, "out of reach"
    frame = corner_at(30.0, 30.0, 0.0)
    assert corner(frame, (50.0, 30.0)) is None, "an edge"
    assert corner(frame, (10.0, 10.0)) is None, "nothing at all"


def test_snap_and_loupe_in_step_two(workspace, qtbot, said):
    choose_all(workspace)
    workspace.show_step(steps.place_of("points"))
    session, canvas, link = workspace.session, workspace.canvas, workspace.screen_link
    owner = session.objects()[0].id
    session.select(owner, 1)
    grey = cv2.cvtColor(session.cache.read(0), cv2.COLOR_BGRA2GRAY)
    inner = np.where(session.cache.mask(0) == owner, cv2.cornerMinEigenVal(grey, 5), 0.0)
    row, column = np.unravel_index(np.argmax(inner), inner.shape)
    canvas.zoom(4.0 / canvas.mapping.zoom)
    canvas.mapping = canvas.mapping.centred(column, row, (canvas.width(), canvas.height()))
    QTest.mouseMove(canvas, at(workspace, column + 2.0, row + 1.0))
    qtbot.waitUntil(lambda: canvas.mouse_raster() is not None, timeout=60_000)
    workspace.table.trigger("annotate.point.snap")
    assert canvas.ghost is not None, "shown at once, on a point's first frame too"
    ghost = canvas.ghost
    click(workspace, column + 2.0, row + 1.0)
    track = session.track_of(owner, 1)
    assert session.annotation.track(track).xy[0].tolist() == pytest.approx(ghost, abs=1e-3)
    workspace.table.trigger("annotate.point.snap")

    session.select(owner, 1)
    link.set_loupe(True)
    away = canvas.loupe.sources["now"]
    assert away.xy == pytest.approx(canvas.mouse_raster()) and away.point == pytest.approx(ghost, abs=1e-3)
    QTest.keyClick(canvas, Qt.Key.Key_Right, CTRL)
    now = canvas.loupe.sources["now"]
    assert now.xy == now.point == pytest.approx((ghost[0] + 0.25, ghost[1]), abs=1e-3), "nudges are watched"
    QTest.mouseMove(canvas, at(workspace, column - 3.0, row + 2.0))
    qtbot.waitUntil(lambda: canvas.loupe.sources["now"].xy == canvas.mouse_raster(), timeout=60_000)
    sharp = canvas.grab().toImage()
    workspace.table.trigger("annotate.view.loupe_smooth")
    assert workspace.table.is_checked("annotate.view.loupe_smooth") and canvas.grab().toImage() != sharp
    link.set_loupe(False)

    workspace.table.trigger("annotate.point.snap")
    canvas.mapping = canvas.mapping.centred(5.0, 5.0, (canvas.width(), canvas.height()))
    flat = np.full_like(session.cache.read(0), 90)
    session.cache._frames[0] = flat
    QTest.mouseMove(canvas, at(workspace, 8.0, 6.0))
    QTest.mouseMove(canvas, at(workspace, 9.0, 6.0))
    qtbot.waitUntil(lambda: canvas.ghost is None and "Nothing to snap" in said[-1], timeout=60_000)


def test_the_loupe_takes_a_key_that_is_decoded_late(workspace, qtbot):
    choose_all(workspace)
    place_points(workspace, each=1)
    fill(workspace)
    session, link = workspace.session, workspace.screen_link
    session.go(6)
    shown(workspace, qtbot, 6)
    link.set_loupe(True)
    with session.cache._changed:
        session.cache._frames.pop(0, None)
    link.refresh()
    qtbot.waitUntil(lambda: {"key", "first"} <= set(workspace.canvas.loupe.sources), timeout=60_000)


def test_the_list_of_steps_is_data(qapp, qtbot, monkeypatch, clip_folder, tmp_path):
    """One more step of placing points between the others: nothing else has to be told."""
    from genmojo_studio import shell_actions
    from genmojo_studio.actions import ActionTable
    from genmojo_studio.annotate import actions
    from genmojo_studio.annotate.workspace import AnnotateWorkspace
    from genmojo_studio.state import AppState

    more = replace(steps.STEPS[1], name="more points", title="More points")
    monkeypatch.setattr(steps, "STEPS", (steps.STEPS[0], more, *steps.STEPS[1:]))
    known = [a for a in actions.ACTIONS if not a.id.startswith("annotate.step.")]
    own = [a for a in actions.ACTIONS if a.id == "annotate.step.edit_mask"]
    table = ActionTable([*shell_actions.ACTIONS, *known, *own, *actions.step_actions()])
    workspace = AnnotateWorkspace(AppState(), table)
    qtbot.addWidget(workspace)
    workspace.resize(1400, 860)
    workspace.show()
    workspace.open_with(open_session(workspace.state, clip_folder, "Ada", tmp_path / "a.genmojo"))
    qtbot.waitUntil(lambda: bool(workspace.objects.figures), timeout=60_000)
    shown(workspace, qtbot, 0)
    assert [b.text()[3:].split("  ")[0] for b in workspace.bar.buttons] == [
        "Objects", "More points", "Points and seed", "Refine", "Review"]  # fmt: skip
    choose_all(workspace)
    owner = workspace.session.objects()[0].id
    workspace.session.select(owner, 1)
    for number in (1, 2):
        table.trigger(f"annotate.step.{number + 1}")
        click(workspace, *inside(workspace, owner, 0.3 * number))
        assert workspace.session.active == (owner, number + 1)
    table.trigger("annotate.step.5")
    assert steps.STEPS[workspace.step].name == "review" and workspace.review.isVisible()
    workspace.close()


def test_layouts_outlive_a_window_that_is_low_for_a_while_and_the_clip(workspace, qtbot, clip_folder, tmp_path):
    workspace.resize(1400, 900)
    workspace.show_step(steps.place_of("points"))
    workspace.docks["buttons"].hide()
    for height, low in ((800, True), (900, False)):
        workspace.resize(1400, height)
        qtbot.waitUntil(lambda low=low: workspace._low == low, timeout=60_000)
        qtbot.waitUntil(lambda low=low: workspace.docks["buttons"].isVisible() == low, timeout=60_000)
    assert workspace.docks["information"].isVisible()
    workspace.show_step(steps.place_of("objects"))
    widths = {name: 200 if name == "buttons" else 300 for name in ("buttons", "information")}
    workspace.resizeDocks([workspace.docks[n] for n in widths], list(widths.values()), Qt.Orientation.Horizontal)
    qtbot.waitUntil(lambda: workspace.docks["information"].width() == 300, timeout=60_000)
    workspace.save_layout()
    for project in ("b.genmojo", "c.genmojo"):
        workspace.close_clip()
        qtbot.wait(1)  # the panels of the clip before go
        workspace.open_with(open_session(workspace.state, clip_folder, "Ada", tmp_path / project))
        qtbot.waitUntil(lambda: bool(workspace.objects.figures), timeout=60_000)
        qtbot.waitUntil(lambda: {name: workspace.docks[name].width() for name in widths} == widths, timeout=60_000)
    workspace.show_step(steps.place_of("points"))  # another step than the one that a new clip begins with
    workspace.resizeDocks([workspace.docks["information"]], [330], Qt.Orientation.Horizontal)
    qtbot.waitUntil(lambda: workspace.docks["information"].width() == 330, timeout=60_000)
    workspace.close_clip()
    workspace.open_with(open_session(workspace.state, clip_folder, "Ada", tmp_path / "d.genmojo"))
    qtbot.waitUntil(lambda: bool(workspace.objects.figures), timeout=60_000)
    workspace.show_step(steps.place_of("points"))
    qtbot.waitUntil(lambda: workspace.docks["information"].width() == 330, timeout=60_000)
