"""The tour: on its own clip, with something to do, beside what it explains, and gone without a trace."""

from pathlib import Path

import pytest
from annotating import click
from PySide6.QtCore import QPoint, QRect, Qt
from PySide6.QtTest import QTest

from genmojo_studio import demo
from genmojo_studio.annotate.session import open_session
from genmojo_studio.annotate.tour_stops import STOPS


@pytest.fixture(autouse=True)
def made_already(monkeypatch, clip_folder):
    """The demo clip lies there: the same clip as the one that is open."""
    monkeypatch.setattr(demo, "write", lambda: clip_folder)


@pytest.fixture
def tour(workspace, qtbot):
    workspace.start_tour()
    qtbot.waitUntil(lambda: workspace.tour is not None, timeout=120_000)
    workspace.tour._praise.setInterval(0)
    return workspace.tour


def area(workspace, widget):
    return QRect(widget.mapTo(workspace, QPoint(0, 0)), widget.size())


def check_place(workspace, qtbot):
    """The note is in the window; it lies over what it explains only where that fills the window."""
    tour, target = workspace.tour, STOPS[workspace.tour.at].target(workspace)
    qtbot.waitUntil(lambda: workspace.rect().contains(tour.geometry()), timeout=60_000)
    qtbot.waitUntil(lambda: tour.frame.geometry().contains(area(workspace, target).center()), timeout=60_000)
    if target is not workspace.canvas:
        qtbot.waitUntil(lambda: not tour.geometry().intersects(area(workspace, target)), timeout=60_000)


def test_the_tour_goes_on_when_something_was_done_and_fills_in_what_was_not(workspace, qtbot, tour):
    session = workspace.session
    own = Path(session.project.path)
    workspace.objects.limits["points"].setValue(2)  # fewer tracks, sooner judged
    assert session.state is not workspace.state, "the rest of the app keeps its clip"
    tour.next.click()
    workspace.objects.table.selectRow(0)
    workspace.objects.choose_button.click()
    qtbot.waitUntil(lambda: tour.at == 2, timeout=60_000)
    tour.next.click()
    qtbot.waitUntil(lambda: workspace.screen_link.painted == session.frame, timeout=60_000)
    owner = session.objects()[0].id
    rows, columns = (session.cache.mask(session.frame) == owner).nonzero()
    click(workspace, columns[len(rows) // 2] + 0.5, rows[len(rows) // 2] + 0.5)
    qtbot.waitUntil(lambda: tour.at == 4, timeout=60_000)
    placed = session.annotation.tracks[1]
    for at in range(4, len(STOPS)):
        assert tour.at == at
        check_place(workspace, qtbot)
        if at == 6:
            assert session.annotation.tracks[1] == placed and len(session.annotation.tracks) == 2
            qtbot.waitUntil(lambda: len(workspace.hands.going.spots) > 0, timeout=120_000)
        if at == 8:
            QTest.keyClick(workspace.canvas, Qt.Key.Key_N)
            qtbot.waitUntil(lambda: tour.at == 9, timeout=60_000)
        elif at < len(STOPS) - 1:
            tour.next.click()
    tour.go(8)
    tour.back.click()
    assert tour.at == 7 and not tour._praise.isActive(), "what was done before counts only once"
    workspace.resize(1240, 740)
    tour.go(2)
    check_place(workspace, qtbot)
    tour.finish()
    assert not own.exists() and workspace.tour is None


def test_what_was_open_comes_back_and_another_clip_ends_the_tour(workspace, qtbot, clip_folder, tmp_path):
    path, digest = Path(workspace.session.project.path), workspace.session.annotation.digest()
    for end in ("finish", "another clip", "finish"):
        workspace.start_tour()
        workspace.start_tour()  # while it is being made ready
        qtbot.waitUntil(lambda: workspace.tour is not None, timeout=120_000)
        own = Path(workspace.session.project.path)
        assert own != path
        workspace.tour.go(5)
        if end == "finish":
            QTest.keyClick(workspace.tour.next, Qt.Key.Key_Escape)
            assert Path(workspace.session.project.path) == path and workspace.session.annotation.digest() == digest
        else:
            workspace.close_clip()
            assert workspace.session is None
            workspace.open_with(open_session(workspace.state, clip_folder, "Ada", path))
        assert workspace.tour is None and not own.exists()
    qtbot.waitUntil(lambda: bool(workspace.objects.figures), timeout=60_000)
