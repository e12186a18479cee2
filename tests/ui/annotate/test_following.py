"""A project that somebody else has open: their work appears here, nothing moves away, and writing is taken over."""

import os
import socket

import numpy as np
import pytest

from genmojo_core.store.project import Project
from genmojo_core.store.project_file import ClipInfo
from genmojo_core.tracks import edit_tracks, keys
from genmojo_core.tracks.annotation import ObjectInfo
from genmojo_studio.annotate.session import open_session


@pytest.fixture
def writer(workspace, clip_folder, qtbot, tmp_path):
    """Ada's program; the workspace shows the same project, read only."""
    cache = workspace.session.cache
    info = ClipInfo(clip_folder.name, str(clip_folder.absolute()), cache.size, np.arange(cache.count), cache.seconds)
    ada = Project.create(tmp_path / "b.genmojo", info, "Ada")
    ada.do(edit_tracks.put_objects(ada.annotation, [ObjectInfo(1, "dog", 1, "chosen")]))
    ada.do(edit_tracks.add_track(ada.annotation, 1, 1))
    ada.wait()
    workspace.close_clip()
    workspace.open_with(open_session(workspace.state, clip_folder, "Bob", tmp_path / "b.genmojo"))
    qtbot.waitUntil(lambda: workspace.screen_link.painted == workspace.session.frame, timeout=60_000)
    yield ada
    ada.close()


def test_a_reader_sees_what_the_writer_does_and_stays_where_it_is(workspace, writer, qtbot):
    session = workspace.session
    words = f"read only: Ada is editing ({os.getpid()}/{socket.gethostname()})"
    qtbot.waitUntil(lambda: workspace.bar.saved.toolTip().startswith(words), timeout=60_000)
    assert workspace.bar.saved.text().startswith("read only: Ada is editing (")
    session.go(7)
    session.select(1, 1)
    workspace.canvas.zoom(3.0)
    view = workspace.canvas.mapping
    for frame in (3, 7, 9):
        writer.do(keys.set_key(writer.annotation, 1, frame, (30.0 + frame, 40.0)))
    qtbot.waitUntil(lambda: session.annotation.digest() == writer.annotation.digest(), timeout=60_000)
    qtbot.waitUntil(lambda: [m.track for m in workspace.canvas.picture.marks] == [1], timeout=60_000)
    writer.undo()
    qtbot.waitUntil(lambda: session.annotation.digest() == writer.annotation.digest(), timeout=60_000)
    assert (session.frame, session.active, workspace.canvas.mapping) == (7, (1, 1), view)
    assert not workspace.bar.take_over.isVisible() and not workspace.table.is_enabled("annotate.file.take_over")


def test_once_the_writer_has_left_writing_is_taken_over(workspace, writer, qtbot):
    writer.do(keys.set_key(writer.annotation, 1, 3, (30.0, 40.0)))
    writer.close()
    qtbot.waitUntil(workspace.bar.take_over.isVisible, timeout=60_000)
    assert workspace.bar.saved.text() == "read only: Ada has left"
    assert workspace.table.is_enabled("annotate.file.take_over")
    workspace.bar.take_over.click()
    session = workspace.session
    assert not session.project.read_only and not workspace.bar.take_over.isVisible()
    assert session.annotation.keys(1).tolist() == [3]
    session.do(keys.set_key(session.annotation, 1, 5, (31.0, 40.0)))
    assert session.project.wait()
    qtbot.waitUntil(lambda: workspace.bar.saved.text().startswith("saved"), timeout=60_000)


def test_another_that_was_faster_is_told_and_followed(workspace, writer, qtbot):
    writer.close()
    qtbot.waitUntil(workspace.bar.take_over.isVisible, timeout=60_000)
    eve = Project.open(writer.path, "Eve")
    said = []
    workspace.session.said.connect(said.append)
    workspace.table.trigger("annotate.file.take_over")
    assert workspace.session.project.read_only and "faster" in said[-1]
    qtbot.waitUntil(lambda: "Eve is editing" in workspace.bar.saved.text(), timeout=60_000)
    workspace.close_clip()
    eve.close()
