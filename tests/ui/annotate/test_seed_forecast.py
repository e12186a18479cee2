"""How long seeding takes is told before and meanwhile, for every tracker, and learnt from what this machine needed.

Not covered: how good the guesses are.
"""

import numpy as np
import pytest
from annotating import choose_all, place_points
from PySide6.QtCore import QProcess
from shiboken6 import isValid

from genmojo_core.store.npz import write_tracks
from genmojo_core.trackers.cotracker import HUB_MODELS, window_seconds
from genmojo_core.tracks.model import VISIBLE, PointTracks
from genmojo_studio.annotate.scene_job import SceneJob
from genmojo_studio.annotate.seed_dialog import SeedDialog
from genmojo_studio.annotate.seed_forecast import Speeds, duration, foretold, rest, so_far
from genmojo_studio.settings import Settings


def test_a_machine_is_known_by_what_it_needed(qapp):
    speeds = Speeds(Settings())
    assert speeds.seconds("new:kind", 10.0) == (10.0, False)
    speeds.learn("new:kind", 10.0, 40.0)
    assert Speeds(Settings()).seconds("new:kind", 20.0) == (80.0, True), "remembered"
    speeds.learn("new:kind", 10.0, 10.0)
    assert speeds.seconds("new:kind", 10.0) == (pytest.approx(20.0, rel=1e-3), True), "both runs count"
    speeds.learn("new:kind", 0.0, 10.0)
    assert speeds.seconds("new:kind", 10.0)[0] == pytest.approx(20.0, rel=1e-3), "nothing to do teaches nothing"
    Settings().put("seed/speed/new:kind", "nonsense")
    assert speeds.seconds("new:kind", 10.0) == (10.0, False)


def test_times_are_told_in_honest_words(qapp):
    assert [duration(s) for s in (0.3, 4.4, 43.0, 200.0)] == ["a moment", "about 4 s", "about 45 s", "about 3 min"]
    assert "a guess" in foretold(30.0, False, 5, 20) and "guess" not in foretold(30.0, True, 5, 20)
    assert rest(0.0, 4.0, 10.0) == 6.0 and rest(0.0, 11.0, 10.0) is None
    assert rest(0.5, 10.0, 10.0) == pytest.approx(7.5), "what was measured and what was expected"
    assert rest(0.9, 90.0, 10.0) == pytest.approx(10.0, abs=0.2), "in the end what was measured"
    assert rest(1.0, 90.0, 10.0) == 0.0
    assert so_far(0.25, 65.0, 200.0).startswith("25 % – 1:05 so far, about") and "longer" in so_far(0.0, 9.0, 5.0)


def test_more_windows_take_longer():
    first = np.zeros(3, int)
    assert window_seconds(60, 64, first) < window_seconds(60, 20, first) < window_seconds(120, 20, first)
    assert window_seconds(120, 20, first) < window_seconds(120, 20, np.array([0, 60, 119])), "both ways"


@pytest.fixture
def dialog(workspace):
    for kind in ("optical", "cotracker:cotracker2"):
        Settings().put(f"seed/speed/{kind}", "")  # other tests have run trackers
    choose_all(workspace)
    place_points(workspace, each=2)
    workspace.table.trigger("annotate.track.seed")
    return next(d for d in workspace.findChildren(SeedDialog) if d.isVisible())


def test_every_tracker_says_how_long_it_will_take(workspace, dialog, tmp_path):
    session = workspace.session
    count, frames = len(session.annotation.tracks), session.annotation.frames
    about = f"{count} points in {frames} frames: "
    assert dialog.forecast.text().startswith(about) and "a guess" in dialog.forecast.text()
    dialog.active_only.click()
    assert dialog.forecast.text().startswith("2 points in")
    dialog.choose("file")
    assert not dialog.forecast.isVisible(), "no file, nothing to tell"
    dialog.file.line.setText(str(made_file(session, tmp_path)))
    assert dialog.forecast.isVisible() and "a moment" in dialog.forecast.text()
    dialog.choose("cotracker")
    few = dialog.forecast.text()
    Speeds(Settings()).learn("cotracker:cotracker2", 10.0, 90.0)
    dialog.cotracker.origin.setCurrentIndex(dialog.cotracker.origin.findData("hub:cotracker2"))
    assert "needed before" in dialog.forecast.text() and dialog.forecast.text() != few
    names = [dialog.cotracker.origin.itemData(n) for n in range(1, dialog.cotracker.origin.count())]
    assert names == [f"hub:{name}" for name in HUB_MODELS], "each by its own name"
    assert all(name[4:] in dialog.cotracker.origin.itemText(n + 1) for n, name in enumerate(names))
    dialog.choose("scene")
    assert not dialog.forecast.isVisible() and "ready in" in dialog.minutes.currentText()
    dialog.reject()


def made_file(session, folder):
    """Tracks that stay where their points were placed."""
    first = [session.annotation.track(t).xy[0] for t in session.annotation.tracks]
    xy = np.repeat(np.array(first)[:, None], session.annotation.frames, axis=1)
    state = np.full(xy.shape[:2], VISIBLE, np.uint8)
    write_tracks(PointTracks(xy, state, np.zeros(len(xy), int), session.annotation.size), folder / "t.npz")
    return folder / "t.npz"


def test_what_a_run_took_is_remembered_and_told_meanwhile(workspace, qtbot, dialog, tmp_path):
    told = []
    workspace.work.tracker.progressed.connect(lambda share: told.append(dialog.progress.text()))
    dialog.start.click()
    assert "so far" in dialog.progress.text() and dialog.progress.isVisible()
    qtbot.waitUntil(lambda: not isValid(dialog), timeout=120_000)
    assert told and all("so far" in text for text in told)
    workspace.table.trigger("annotate.track.seed")
    again = next(d for d in workspace.findChildren(SeedDialog) if d.isVisible())
    assert "by what this machine needed before" in again.forecast.text()
    assert "a moment" in again.forecast.text(), "what was matched is not matched again"
    again.reject()


def test_a_cancelled_optimisation_ends_at_once_and_is_not_asked_to_finish(qtbot, tmp_path):
    script, said = tmp_path / "slow.py", tmp_path / "asked.txt"
    script.write_text(
        "import signal, time\n"
        f"signal.signal(signal.SIGTERM, lambda *_: open({str(said)!r}, 'a').write('asked'))\n"
        f"open({str(tmp_path / 'ready.txt')!r}, 'w').close()\n"
        "while True: time.sleep(0.05)\n"
    )
    job = SceneJob(tmp_path, tmp_path / "s.h5", 60.0, 60.0, {})
    job._process.setArguments([str(script)])
    job.start()
    qtbot.waitUntil((tmp_path / "ready.txt").exists, timeout=30_000)
    job.cancel()
    assert job._process.state() == QProcess.ProcessState.NotRunning and not said.exists()
