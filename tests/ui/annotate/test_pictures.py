"""Pictures that changed under a project are told by frame, nothing is lost; old projects get digests; merges ask."""

import shutil
from dataclasses import replace

import numpy as np
import pytest
from annotating import choose_all, place_points
from PIL import Image
from PySide6.QtWidgets import QFileDialog, QLabel, QMessageBox

from genmojo_core.cli import main as cli
from genmojo_core.errors import GenmojoError
from genmojo_core.store import project_file
from genmojo_core.store.project import Project
from genmojo_studio.annotate.merge_dialog import MergeDialog
from genmojo_studio.annotate.picture_watch import spans
from genmojo_studio.annotate.session import open_session


def watched(workspace, qtbot):
    """The frames that the check found changed."""
    with qtbot.waitSignal(workspace.work.pictures.done, timeout=60_000) as told:
        pass
    return told.args[0]


def frames_of(folder):
    from genmojo_core.clip import layouts

    return layouts.find(folder).frames


@pytest.fixture
def own_clip(clip_folder, tmp_path):
    """A copy of the clip that a test may change."""
    return shutil.copytree(clip_folder, tmp_path / "own")


@pytest.fixture
def annotated(workspace, qtbot, own_clip, tmp_path):
    """The workspace with that copy open, digests stored, points placed; and its project file."""
    workspace.close_clip()
    workspace.open_with(open_session(workspace.state, own_clip, "Ada", tmp_path / "own.genmojo"))
    assert watched(workspace, qtbot) == []
    qtbot.waitUntil(lambda: bool(workspace.objects.figures), timeout=60_000)
    choose_all(workspace)
    place_points(workspace, each=1)
    return tmp_path / "own.genmojo"


def reopened(workspace, project):
    workspace.close_clip()
    workspace.open_with(open_session(workspace.state, project, "Ada"))


def change(folder, *numbers):
    for n in numbers:
        file = frames_of(folder)[n]
        Image.fromarray(255 - np.array(Image.open(file).convert("RGB"))).save(file)


def test_changed_pictures_are_named_once_and_work_stays(workspace, qtbot, own_clip, annotated):
    before = workspace.session.annotation.digest()
    change(own_clip, 3, 7, 8)
    reopened(workspace, annotated)
    assert watched(workspace, qtbot) == [3, 7, 8]
    box = workspace.work.pictures.box
    assert box.isVisible()
    assert "3, 7 to 8" in box.text()
    assert workspace.session.annotation.digest() == before
    next(b for b in box.buttons() if box.buttonRole(b) == QMessageBox.ButtonRole.RejectRole).click()
    workspace.close_clip()
    assert cli.main(["validate", str(annotated)]) == 2
    reopened(workspace, annotated)
    assert watched(workspace, qtbot) == [3, 7, 8]  # as long as nobody said that they are right
    box = workspace.work.pictures.box
    next(b for b in box.buttons() if box.buttonRole(b) == QMessageBox.ButtonRole.AcceptRole).click()
    reopened(workspace, annotated)
    assert watched(workspace, qtbot) == []
    workspace.close_clip()
    assert cli.main(["validate", str(annotated)]) == 0


def test_an_old_project_gets_digests_and_what_was_begun_goes_on(workspace, qtbot, annotated):
    workspace.close_clip()
    info = project_file.clip_of(annotated)
    assert all(d.startswith("file:") for d in info.sha256)
    project = Project.open(annotated, backup=False)
    project.note_digests(dict.fromkeys(range(5, info.frames), ""))
    project.close()
    assert sum(bool(d) for d in project_file.clip_of(annotated).sha256) == 5
    reopened(workspace, annotated)
    assert watched(workspace, qtbot) == []
    workspace.close_clip()
    assert project_file.clip_of(annotated).sha256 == info.sha256


def test_a_clip_that_lost_a_frame_is_refused_in_one_sentence(workspace, own_clip, annotated):
    workspace.close_clip()
    frames_of(own_clip)[-1].unlink()
    with pytest.raises(GenmojoError, match="the project's clip has"):
        open_session(workspace.state, annotated, "Ada")


def test_a_merge_of_another_clip_is_asked_about(workspace, qtbot, annotated, tmp_path, monkeypatch):
    session, shown = workspace.session, []
    monkeypatch.setattr(MergeDialog, "open", lambda self: shown.append(self))
    session.project.save_copy(tmp_path / "theirs.genmojo")

    def compared(*frames):
        """The dialog for a project in which these frames have other pictures."""
        theirs = Project.open(tmp_path / "theirs.genmojo", backup=False)
        theirs.note_digests({n: f"file:{n}" for n in frames} | {n: session.project.info.sha256[n] for n in
                             range(theirs.info.frames) if n not in frames})  # fmt: skip
        theirs.close()
        answers = iter([str(tmp_path / "theirs.genmojo"), ""])
        monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (next(answers), ""))
        workspace.hands.dialogs.merge()
        return shown[-1], [label.text() for label in shown[-1].findChildren(QLabel)]

    dialog, _ = compared()
    assert dialog.sure.isHidden()
    dialog, texts = compared(2, 3, 4)
    assert not dialog.sure.isHidden()
    assert not dialog.take.isEnabled()
    assert any("differ in 3 of" in text and "2 to 4" in text for text in texts)
    dialog, texts = compared(*range(session.annotation.frames))
    assert any("in every frame" in text for text in texts)


def test_frames_are_named_in_runs():
    assert spans([3, 7, 8, 9]) == "3, 7 to 9"
    assert spans(range(0, 40, 2)).endswith(", …")


def test_digests_of_other_kinds_are_not_compared(workspace):
    info = workspace.session.project.info
    one, other = (replace(info, sha256=(f"{kind}:1",) * info.frames) for kind in ("file", "packet"))
    assert project_file.clip_doubt(one, other) == ""
