"""Masks drawn in step 1 are edits: undo brings the other mask back, on the screen, in the file and for runs.

How well objects are cut out is measured in tests/estimate, how corrections spread in test_hand_masks.py.
"""

import io
import sqlite3

import numpy as np
import pytest
from annotating import choose_all

from genmojo_core.store.project import Project
from genmojo_studio.annotate.session import open_session

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
    workspace.objects.instead.setChecked(instead_of is not None)
    head = workspace.session.project.log.head
    workspace.work.masks.add_box(*box)
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
