"""Masks drawn in step 1 are edits: undo brings the other mask back, on the screen, in the file and for runs.

How well objects are cut out, and how corrections spread, is told in tests/estimate.
"""

import io
import shutil
import sqlite3

import numpy as np
import pytest
from annotating import at, choose_all, click
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from genmojo_core.store.project import Project
from genmojo_studio.annotate.colours import object_colour
from genmojo_studio.annotate.masks import Purpose
from genmojo_studio.annotate.session import open_session
from genmojo_studio.annotate.steps import STEPS

WAIT = 120_000


@pytest.fixture
def drawing(workspace, qtbot):
    """The workspace, and how to wait for the masks that stand: (workspace, area in frame 0 by object id)."""

    def area(object_id):
        return int((workspace.session.mask_at(0) == object_id).sum())

    return workspace, area


def box_of(workspace, object_id):
    rows, columns = np.nonzero(workspace.session.cache.mask(0) == object_id)
    return columns.min() - 2.0, rows.min() - 2.0, columns.max() + 3.0, rows.max() + 3.0


def published(workspace, qtbot):
    """The masks that a run would take, None if the clip's own."""
    qtbot.waitUntil(lambda: not workspace.work.masks.busy, timeout=WAIT)
    return workspace.state.masks_path


def cut(workspace, qtbot, box, instead_of=None):
    """Draw a box; instead of an object's mask, or as a new object. Returns the mask's object."""
    if instead_of is not None:
        workspace.session.select(instead_of, 1)
    workspace.objects.set_purpose(Purpose.NEW if instead_of is None else Purpose.ANEW)
    head = workspace.session.project.log.head
    workspace.work.masks.add_box(*box)
    workspace.work.masks.cut()
    qtbot.waitUntil(lambda: workspace.session.project.log.head != head, timeout=WAIT)
    qtbot.waitUntil(lambda: not workspace.work.masks.busy, timeout=WAIT)
    return workspace.session.active[0]


def reopen(workspace, qtbot, clip_folder):
    path = workspace.session.project.path
    workspace.close_clip()
    workspace.open_with(open_session(workspace.state, clip_folder, "Ada", path))
    qtbot.waitUntil(lambda: workspace.session.clip is not None, timeout=WAIT)
    qtbot.waitUntil(lambda: not workspace.work.masks.busy, timeout=WAIT)
    return workspace.session


def test_undo_brings_a_replaced_mask_back_also_after_a_restart(drawing, qtbot, clip_folder):
    workspace, area = drawing
    choose_all(workspace)
    session = workspace.session
    one, other = session.clip.object_ids.tolist()[:2]
    own = area(one)
    cut(workspace, qtbot, box_of(workspace, other), instead_of=one)
    drawn = area(one)
    assert drawn != own and published(workspace, qtbot) is not None

    session.undo()
    qtbot.waitUntil(lambda: area(one) == own, timeout=WAIT)
    assert session.annotation.objects[one].status == "chosen", "only the mask was taken back"
    assert published(workspace, qtbot) is None and not session.hand_masks, "runs take the clip's own again"
    session.redo()
    qtbot.waitUntil(lambda: area(one) == drawn, timeout=WAIT)

    session = reopen(workspace, qtbot, clip_folder)
    assert area(one) == drawn
    cut(workspace, qtbot, box_of(workspace, one), instead_of=one)
    newest = area(one)
    session = reopen(workspace, qtbot, clip_folder)
    for wanted in (drawn, own):
        session.undo()
        qtbot.waitUntil(lambda wanted=wanted: area(one) == wanted, timeout=WAIT)
    for wanted in (drawn, newest):
        session.redo()
        qtbot.waitUntil(lambda wanted=wanted: area(one) == wanted, timeout=WAIT)


def test_an_object_that_was_taken_back_stays_away_and_can_be_done_again(drawing, qtbot, clip_folder):
    workspace, area = drawing
    session = workspace.session
    candidates = session.project.log.head
    number = cut(workspace, qtbot, box_of(workspace, session.clip.object_ids[0]))
    drawn = area(number)
    assert drawn > 0 and number in session.annotation.objects
    session.undo()
    qtbot.waitUntil(lambda: area(number) == 0, timeout=WAIT)
    assert number not in session.hand_masks and number not in session.clip.object_ids
    published(workspace, qtbot)

    session = reopen(workspace, qtbot, clip_folder)
    assert number not in session.annotation.objects and area(number) == 0
    assert session.project.log.head == candidates, "opening makes no edit"
    session.undo()  # the candidates themselves
    assert not session.annotation.objects
    session = reopen(workspace, qtbot, clip_folder)
    assert not session.annotation.objects and session.project.log.head == 0
    session.redo()
    session.redo()
    qtbot.waitUntil(lambda: area(number) == drawn, timeout=WAIT)


def test_a_project_of_before_masks_were_edits_opens_as_it_was(drawing, qtbot, clip_folder):
    """Such a project has all masks in one blob, and no note of what became a candidate."""
    workspace, area = drawing
    session, path = workspace.session, workspace.session.project.path
    one, other = session.clip.object_ids.tolist()[:2]
    mask = np.zeros(session.clip.frames.shape[:3], bool)
    mask[:, 5:15, 5:25] = True
    stream = io.BytesIO()
    np.savez_compressed(stream, **{f"object_{one}": np.packbits(mask, axis=2), f"width_{one}": mask.shape[2]})
    workspace.close_clip()
    project = Project.open(path)
    project.put_blob("hand_masks", stream.getvalue())
    project.close()
    with sqlite3.connect(path) as connection:
        connection.execute("DELETE FROM blobs WHERE name = 'candidates'")
    connection.close()
    workspace.open_with(open_session(workspace.state, clip_folder, "Ada", path))
    qtbot.waitUntil(lambda: workspace.session.clip is not None, timeout=WAIT)
    session = workspace.session
    assert session.project.log.head == 1 and len(session.project.log) == 1, "opening makes no edit"
    assert (session.mask_at(0) == one).sum() == mask[0].sum()
    cut(workspace, qtbot, box_of(workspace, other), instead_of=one)
    assert (session.mask_at(0) == one).sum() != mask[0].sum()
    session.undo()
    qtbot.waitUntil(lambda: (session.mask_at(0) == one).sum() == mask[0].sum(), timeout=WAIT)


def draw(workspace, *places):
    """A stroke over the frame with the mouse, raster places."""
    canvas = workspace.canvas
    QTest.mousePress(canvas, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, at(workspace, *places[0]))
    for place in places[1:]:
        QTest.mouseMove(canvas, at(workspace, *place))
    QTest.mouseRelease(canvas, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, at(workspace, *places[-1]))


def undo_key(workspace):
    QTest.keyClick(workspace.canvas, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)


def test_what_is_drawn_waits_is_shown_and_is_taken_back_before_any_edit(drawing, qtbot):
    workspace, _ = drawing
    session, head = workspace.session, workspace.session.project.log.head
    x0, y0, x1, y1 = box_of(workspace, session.clip.object_ids[0])
    middle = ((x0 + x1) / 2, (y0 + y1) / 2)
    workspace.table.trigger("annotate.object.box")
    draw(workspace, (x0, y0), middle, (x1, y1))
    workspace.table.trigger("annotate.object.stroke")
    draw(workspace, middle, (middle[0] + 4, middle[1]))
    workspace.table.trigger("annotate.object.not_this")
    draw(workspace, (x0, y0), (x0 + 3, y0))
    assert [type(p).__name__ for p in session.sketch] == ["Box", "Scribble", "Scribble"]
    assert workspace.canvas.picture.sketch == session.sketch, "all of it stays on show"
    assert workspace.objects.cut.isEnabled() and session.project.log.head == head
    said = []
    session.said.connect(said.append)
    draw(workspace, (-20.0, 5.0))
    assert len(session.sketch) == 3 and "inside the frame" in said[-1]
    session.go(1)
    qtbot.waitUntil(lambda: workspace.screen_link.painted == 1, timeout=WAIT)
    assert not workspace.canvas.picture.sketch, "it belongs to the frame that it was drawn in"
    for left in (2, 1, 0):
        undo_key(workspace)
        assert len(session.sketch) == left and session.project.log.head == head
    assert not workspace.objects.cut.isEnabled()
    workspace.table.trigger("annotate.edit.redo")
    workspace.table.trigger("annotate.edit.redo")
    assert len(session.sketch) == 2
    workspace.table.trigger("annotate.object.cut")
    qtbot.waitUntil(lambda: session.project.log.head != head, timeout=WAIT)
    assert not session.sketch and session.frame == 1
    session.undo()
    assert session.frame == 0, "where it was drawn"


def test_a_correction_starts_from_the_mask_and_leaves_what_nobody_pointed_at(drawing, qtbot):
    workspace, area = drawing
    session = workspace.session
    one, other = session.clip.object_ids.tolist()[:2]
    number = cut(workspace, qtbot, box_of(workspace, one))
    before = session.hand_masks[number].copy()
    session.select(number, 1)
    workspace.objects.set_purpose(Purpose.CORRECT)
    rows, columns = np.nonzero(session.cache.mask(0) == other)
    x, y = float(np.median(columns)), float(np.median(rows))
    head = session.project.log.head
    workspace.work.masks.add_stroke(np.array([[x - 3, y], [x + 3, y]]), True)
    workspace.work.masks.cut()
    qtbot.waitUntil(lambda: session.project.log.head != head, timeout=WAIT)
    qtbot.waitUntil(lambda: not workspace.work.masks.busy, timeout=WAIT)
    after = session.hand_masks[number]
    scale = after.shape[2] / session.annotation.size[0]
    assert after[0, int(y * scale), int(x * scale)] and not before[0, int(y * scale), int(x * scale)]
    assert (after & before).sum() == before.sum(), "adding takes nothing away"
    session.undo()
    qtbot.waitUntil(lambda: np.array_equal(session.hand_masks[number], before), timeout=WAIT)


def test_only_what_is_not_part_of_it_makes_no_object(drawing, qtbot):
    workspace, _ = drawing
    session, said = workspace.session, []
    head = session.project.log.head
    session.said.connect(said.append)
    workspace.work.masks.add_stroke(np.array([[20.0, 20.0]]), False)
    workspace.work.masks.cut()
    qtbot.waitUntil(lambda: not workspace.work.masks.busy, timeout=WAIT)
    assert session.project.log.head == head and len(session.sketch) == 1, "what was drawn is still there"
    assert "not part of the object" in said[-1]


def test_a_click_on_a_mask_selects_its_row_and_colours_match(drawing):
    workspace, _ = drawing
    session, page = workspace.session, workspace.objects
    for number in session.clip.object_ids.tolist():
        rows, columns = np.nonzero(session.cache.mask(0) == number)
        k = len(rows) // 2
        click(workspace, columns[k] + 0.5, rows[k] + 0.5)
        assert page.current().id == number
        icon = page.table.item(page.table.currentRow(), 0).icon().pixmap(14, 14).toImage()
        place = workspace.canvas.picture.contours[number][0]
        assert icon.pixelColor(2, 7).getRgb()[:3] == tuple(object_colour(place)[:3])


def test_masks_of_some_frames_are_followed_into_the_others(drawing, qtbot, clip_folder, tmp_path):
    workspace, _ = drawing
    folder = tmp_path / "sparse"
    shutil.copytree(clip_folder, folder)
    for path in sorted(p for p in folder.rglob("*.png") if "nnotation" in str(p))[2:]:
        path.unlink()
    workspace.close_clip()
    workspace.open_with(open_session(workspace.state, folder, "Ada", tmp_path / "sparse.genmojo"))
    page = workspace.objects
    qtbot.waitUntil(lambda: bool(page.figures), timeout=WAIT)
    session = workspace.session
    frames = session.annotation.frames
    assert page.bare == frames - 2 and all(f.seen == 1.0 for f in page.figures.values())
    for number in session.clip.object_ids.tolist()[:2]:
        given = session.mask_at(1) == number
        session.select(number, 1)
        workspace.table.trigger("annotate.object.follow")
        qtbot.waitUntil(lambda number=number: number in session.hand_masks, timeout=WAIT)
        mask = session.hand_masks[number]
        assert mask[2:6].any(axis=(1, 2)).all(), "it goes on, until it is hidden"
        assert abs(int(mask[1].sum()) - int(given.sum())) <= 0.1 * given.sum(), "what was given stays"


def test_names_reasons_and_limits_say_what_stands(drawing):
    workspace, _ = drawing
    session, page, said = workspace.session, workspace.objects, []
    session.said.connect(said.append)
    choose_all(workspace)
    first = page.current()
    session.select(session.objects()[0].id, 1)
    first = page.current()
    page.table.item(0, 0).setText("   ")
    assert page.table.item(0, 0).text() == first.name and "needs a name" in said[-1]
    page.table.item(0, 0).setText("n" * 70)
    assert session.annotation.objects[first.id].name == "n" * 60 and "60" in said[-1]

    chosen = len(session.objects())
    page.limits["objects"].setValue(chosen - 1)
    assert str(chosen - 1) in page.note.text()
    missing = STEPS[0].missing(session.annotation, 5, 2)
    assert f"{chosen}" in missing and f"{chosen - 1}" in missing, "more are chosen than wanted"

    page.reason.setCurrentText("behind the fence all the time")
    workspace.table.trigger("annotate.object.reject")
    assert session.annotation.objects[first.id].reason == "behind the fence all the time"
    session.select(first.id, 1)
    assert "behind the fence" in page.about.text(), "the reason can be read, not only as a tool tip"
    page.reason.setCurrentText("  ")
    head = session.project.log.head
    workspace.table.trigger("annotate.object.reject")
    assert session.project.log.head == head and "why" in said[-1]
    page.limits["objects"].setValue(chosen)
    workspace.table.trigger("annotate.object.choose")
    assert session.annotation.objects[first.id].status == "chosen"
    assert [o.id for o in session.objects()][-1] == first.id
    workspace.table.trigger("annotate.object.earlier")
    assert [o.id for o in session.objects()][-2:][0] == first.id
