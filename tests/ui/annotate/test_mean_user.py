"""What people do to a window without asking whether it is ready: no exception, no freeze, nothing lost.

A fault inside a slot fails the test by itself (pytest-qt). Not covered: disks that are full (tests/store).
"""

import itertools
import shutil

import cv2
import numpy as np
import pytest
from annotating import choose_all, click, fill, place_points
from clip_files import make_clip, put_image, put_mask
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from genmojo_core.store.project import Project
from genmojo_core.tracks.annotation import KEY
from genmojo_core.tracks.model import NONE
from genmojo_studio.annotate.seed_dialog import SeedDialog
from genmojo_studio.annotate.session import open_session

KEYS = [Qt.Key.Key_Right, Qt.Key.Key_Left, Qt.Key.Key_Return, Qt.Key.Key_N, Qt.Key.Key_B, Qt.Key.Key_Q, Qt.Key.Key_V,
        Qt.Key.Key_O, Qt.Key.Key_U, Qt.Key.Key_K, Qt.Key.Key_Up, Qt.Key.Key_Down, Qt.Key.Key_Home, Qt.Key.Key_End,
        Qt.Key.Key_Tab, Qt.Key.Key_T, Qt.Key.Key_I, Qt.Key.Key_Delete, Qt.Key.Key_G, Qt.Key.Key_M, Qt.Key.Key_L,
        Qt.Key.Key_P, Qt.Key.Key_S, Qt.Key.Key_BracketLeft, Qt.Key.Key_BracketRight]  # fmt: skip
CTRL = [Qt.Key.Key_Z, Qt.Key.Key_Y, Qt.Key.Key_Left, Qt.Key.Key_Up, Qt.Key.Key_T, Qt.Key.Key_Return, Qt.Key.Key_L]


@pytest.fixture
def swap(workspace, tmp_path, qtbot):
    """Another clip in the same window."""
    count = itertools.count()

    def opened(path, project=None):
        workspace.close_clip()
        file = project or tmp_path / f"swap{next(count)}.genmojo"
        workspace.open_with(open_session(workspace.state, path, "Eve", file))
        qtbot.waitUntil(lambda: workspace.session.clip is not None, timeout=60_000)
        return workspace.session

    return opened


def hammer(workspace, seed, presses):
    """Keys at random, faster than anything can be done in answer."""
    rng = np.random.default_rng(seed)
    for _ in range(presses):
        workspace.canvas.setFocus()
        if rng.random() < 0.25:
            QTest.keyClick(workspace.canvas, CTRL[rng.integers(len(CTRL))], Qt.KeyboardModifier.ControlModifier)
        else:
            QTest.keyClick(workspace.canvas, KEYS[rng.integers(len(KEYS))])
        if rng.random() < 0.1:
            workspace.show_step(int(rng.integers(4)))


def settled(workspace, qtbot):
    qtbot.waitUntil(lambda: not workspace.work.tracker.tasks.busy, timeout=120_000)
    qtbot.waitUntil(lambda: workspace.screen_link.painted == workspace.session.frame, timeout=60_000)


def check_undone_and_stored(workspace):
    """Undo to the beginning and redo to the end give the same; a new reader sees it too."""
    session = workspace.session
    end, path = session.annotation.digest(), session.project.path
    steps = 0
    while session.project.undo() is not None:
        steps += 1
    assert not session.annotation.tracks or steps
    for _ in range(steps):
        session.project.redo()
    assert session.annotation.digest() == end
    workspace.close_clip()
    again = Project.open(path)
    assert again.annotation.digest() == end
    again.close()


@pytest.mark.parametrize(
    ("seed", "presses"), [(0, 60), *(pytest.param(seed, 200, marks=pytest.mark.slow) for seed in (1, 2, 3, 4))]
)
def test_keys_at_random_faster_than_the_solver(workspace, qtbot, seed, presses, told):
    choose_all(workspace)
    place_points(workspace, each=2)
    fill(workspace)
    workspace.show_step(2)
    hammer(workspace, seed, presses)
    settled(workspace, qtbot)
    assert not told
    check_undone_and_stored(workspace)


def test_undo_while_a_key_is_being_solved(workspace, qtbot):
    """The answer comes too late: nothing of it may stay."""
    choose_all(workspace)
    place_points(workspace, each=1)
    fill(workspace)
    workspace.show_step(2)
    session = workspace.session
    settled(workspace, qtbot)
    before, track = session.annotation.digest(), session.track
    for frame in (6, 9, 12):
        session.go(frame)
        x, y = session.annotation.track(track).xy[frame].tolist()
        workspace.hands.placing.dragged(track, x + 9.0, y + 5.0)
        assert session.annotation.track(track).flags[frame] & KEY and workspace.work.tracker.tasks.busy
        session.undo()
    settled(workspace, qtbot)
    assert session.annotation.digest() == before


@pytest.mark.slow
def test_the_point_is_dragged_again_while_it_is_being_solved(workspace, qtbot):
    choose_all(workspace)
    place_points(workspace, each=1)
    fill(workspace)
    workspace.show_step(2)
    session, track = workspace.session, workspace.session.track
    session.go(8)
    for shift in range(1, 6):
        workspace.hands.placing.dragged(track, 30.0 + shift, 40.0)
    settled(workspace, qtbot)
    cells = session.annotation.track(track)
    assert cells.xy[8].tolist() == [35.0, 40.0] and cells.flags[8] & KEY, "the person's last word stands"


@pytest.mark.parametrize("when", ["seeding", pytest.param("solving", marks=pytest.mark.slow), "cutting", "reading"])
def test_the_window_closes_in_the_middle_of_it(workspace, qtbot, clip_folder, tmp_path, when):
    choose_all(workspace)
    if when == "cutting":
        size = workspace.session.annotation.size
        workspace.work.masks.add_box(0.2 * size[0], 0.2 * size[1], 0.5 * size[0], 0.6 * size[1])
        workspace.work.masks.cut()
    elif when == "reading":
        workspace.close_clip()
        workspace.state.set(clip=None, clip_path=None)
        workspace.open_with(open_session(workspace.state, clip_folder, "Eve", tmp_path / "b.genmojo"))
    else:
        place_points(workspace, each=1)
        workspace.table.trigger("annotate.track.seed")
        dialog = next(d for d in workspace.findChildren(SeedDialog) if d.isVisible())
        dialog.start.click()
        if when == "solving":
            qtbot.waitUntil(lambda: all((workspace.session.annotation.track(t).state != NONE).all()
                                        for t in workspace.session.annotation.tracks), timeout=60_000)  # fmt: skip
            workspace.show_step(2)
            workspace.hands.placing.dragged(workspace.session.track, 40.0, 40.0)
    path, digest = workspace.session.project.path, workspace.session.annotation.digest()
    workspace.close()
    assert workspace.session is None
    again = Project.open(path)
    assert again.annotation.digest() == digest
    again.close()


def test_a_clip_without_masks(workspace, qtbot, swap, tmp_path):
    session = swap(make_clip(tmp_path / "bare", frames=6, masks=False))
    for step in range(4):
        workspace.show_step(step)
        click(workspace, 10.0, 10.0)
        hammer(workspace, step, 25)
    settled(workspace, qtbot)
    said = []
    session.said.connect(said.append)
    workspace.show_step(0)
    workspace.objects.cut.click()
    workspace.work.masks.cut()
    assert said and not session.annotation.tracks


@pytest.mark.parametrize("frames", [1, pytest.param(2, marks=pytest.mark.slow)])
def test_a_clip_of_hardly_any_frames(workspace, qtbot, swap, tmp_path, frames):
    session = swap(make_clip(tmp_path / "short", frames=frames))
    qtbot.waitUntil(lambda: bool(workspace.objects.figures), timeout=60_000)
    choose_all(workspace)
    session.cache.read(0)
    place_points(workspace, each=2)
    workspace.work.tracker.seed([o.id for o in session.objects()])
    settled(workspace, qtbot)
    for step in (2, 3):
        workspace.show_step(step)
        hammer(workspace, step, 60)
    settled(workspace, qtbot)
    check_undone_and_stored(workspace)


def test_files_vanish_under_its_feet(workspace, qtbot, swap, clip_folder, tmp_path):
    """What was decoded stays; what cannot be read is said in a sentence; the annotation is not touched."""
    root = tmp_path / "gone"
    shutil.copytree(clip_folder, root)
    session = swap(root)
    qtbot.waitUntil(lambda: bool(workspace.objects.figures), timeout=60_000)
    choose_all(workspace)
    place_points(workspace, each=1)
    fill(workspace)
    workspace.show_step(2)
    settled(workspace, qtbot)
    digest, said = session.annotation.digest(), []
    session.said.connect(said.append)
    shutil.rmtree(root)
    session.cache.forget()
    for frame in range(session.annotation.frames):
        session.go(frame)
    qtbot.waitUntil(lambda: any(str(root) in s for s in said), timeout=60_000)  # frames passed by need not be read
    workspace.canvas.repaint()
    workspace.screen_link.set_loupe(True)
    workspace.canvas.repaint()
    assert session.annotation.digest() == digest


def test_a_project_that_somebody_else_has_open(workspace, qtbot, swap, clip_folder, tmp_path):
    path = tmp_path / "shared.genmojo"
    session = swap(clip_folder, path)
    qtbot.waitUntil(lambda: bool(workspace.objects.figures), timeout=60_000)
    choose_all(workspace)
    place_points(workspace, each=1)
    fill(workspace)
    session.project.wait()
    digest = session.annotation.digest()
    workspace.close_clip()
    first = Project.open(path, "Ada")
    session = swap(clip_folder, path)
    assert session.project.read_only and workspace.bar.saved.text().startswith("read only")
    said = []
    session.said.connect(said.append)
    choose_all(workspace)
    workspace.objects.limits["points"].setValue(7)
    for step in range(4):
        workspace.show_step(step)
        click(workspace, 30.0, 30.0)
        hammer(workspace, step, 25)
    workspace.review.consent.click()
    workspace.review.reject_button.click()
    settled(workspace, qtbot)
    assert said and session.annotation.digest() == digest == first.annotation.digest()
    assert workspace.objects.limits["points"].value() == 5 and not workspace.review.consent.isChecked()
    first.close()


@pytest.mark.slow
def test_frames_of_4k_and_25_points(workspace, qtbot, swap, tmp_path):
    root, rng = tmp_path / "large", np.random.default_rng(0)
    texture = cv2.resize(rng.integers(0, 255, (216, 384, 3), np.uint8), (3840, 2160), interpolation=cv2.INTER_CUBIC)
    masks = np.zeros((2160, 3840), np.uint8)
    for k in range(5):
        masks[400:1700, 200 + 700 * k : 700 + 700 * k] = k + 1
    for t in range(4):
        put_image(root / "JPEGImages" / "large" / f"{t:05d}.jpg", np.roll(texture, 8 * t, axis=1))
        put_mask(root / "Annotations" / "large" / f"{t:05d}.png", np.roll(masks, 8 * t, axis=1))
    session = swap(root)
    qtbot.waitUntil(lambda: bool(workspace.objects.figures), timeout=60_000)
    choose_all(workspace)
    assert len(session.objects()) == 5 and session.cache.read(0, 60.0) is not None
    place_points(workspace, each=5)
    assert len(session.annotation.tracks) == 25
    fill(workspace)
    workspace.show_step(2)
    workspace.canvas.zoom(4.0)
    hammer(workspace, 7, 60)
    settled(workspace, qtbot)
    check_undone_and_stored(workspace)


def test_clip_after_clip_in_one_window_and_other_colours(workspace, qapp, qtbot, swap, tmp_path):
    """What belonged to an earlier clip is gone, and nothing calls it any more."""
    roots = [make_clip(tmp_path / f"clip{k}", frames=3, masks=k > 0) for k in range(3)]
    for k, root in enumerate(roots):
        swap(root)
        QTest.qWait(20)  # let Qt delete the panels before
        workspace.table.changed()
        workspace.state.set(theme=("light", "dark")[k % 2])
    workspace.close_clip()
    QTest.qWait(20)
    workspace.table.changed()
    workspace.state.set(theme="dark")
    QTest.qWait(20)
    for action in workspace.table:
        assert not (action.checkable and workspace.table.is_checked(action.id))
