"""Drives the real window through a whole job; started by test_watch.py in a process of its own.

python tests/system/watching.py FOLDER [job [CLIP] | stalls SECONDS [CLIP]]

`job`: a clip (the demo's if none is named), run, views, exports; screenshots and exports in FOLDER. `stalls`: a run
that is watched and played with for so long: views, frames, panels out and back, workspaces, themes. The last line
printed is JSON; `at_rest_db` is the least likeness of a picture at rest to the same scene drawn at full detail.
"""

import json
import sys
import time
from pathlib import Path

import numpy as np
from PySide6.QtCore import Qt, QTimer
from PySide6.QtGui import QImage
from PySide6.QtTest import QTest

from genmojo_core.store import scene_hdf5
from genmojo_studio import app, notify
from genmojo_studio.export.request import ExportRequest
from genmojo_studio.settings import Settings
from genmojo_studio.view3d.quality import FULL

BUDGET = 400.0  # seconds of optimisation at most; the drive stops it long before


class Drive:
    """A window and how a person gets through it."""

    def __init__(self, folder):
        self.folder = Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)
        self.told, self.shots, self.at_rest_db = [], 0, 99.0
        notify.show_dialog = lambda _parent, title, text, details: self.told.append((title, text, details))
        self.application = app.make_application()
        settings = Settings()
        settings.forget_layouts()  # of an earlier drive
        settings.put("theme", "dark")
        self.window = app.make_window(self.application, settings)
        self.window.resize(1920, 1080)
        self.window.show()

    def wait(self, condition, seconds, what):
        until = time.monotonic() + seconds
        while not condition():
            QTest.qWait(1)  # keeps Python's lock: other threads run in the sleep
            time.sleep(0.009)
            if self.told or time.monotonic() > until:
                raise SystemExit(f"{what}: {self.told or 'not within the time'}")

    def rest(self, seconds):
        until = time.monotonic() + seconds
        self.wait(lambda: time.monotonic() > until, seconds + 1, "rest")

    def open(self, clip):
        """Opens a clip, or makes the demo's if none is named; the workspace Watch once its effects are measured."""
        if clip is None:
            QTest.mouseClick(self.window.welcome.demo_button, Qt.MouseButton.LeftButton)
        else:
            self.window.open_path(Path(clip))
        self.wait(lambda: self.window.state.clip is not None, 60, "the clip")
        watch = self.window.workspaces["watch"]
        self.wait(lambda: watch.setup.effects.rows, 120, "the effects")
        return watch

    def shot(self, name):
        self.rest(0.3)
        watch = self.window.workspaces.get("watch")
        if watch is not None and watch.view.snapshot is not None and watch.view.isVisible():
            self.drawn(watch)
        self.shots += 1
        dog = self.window.watchdog
        stalls, longest = list(dog.stalls), dog.longest
        if watch is not None and watch.view.overlay.report is not None and watch.view.isVisible():
            self.at_rest_db = min(self.at_rest_db, _likeness(watch.view))
        self.window.screen().grabWindow(0).save(str(self.folder / f"{self.shots:02d}-{name}.png"))
        self.rest(0.2)
        dog.stalls, dog.longest = stalls, longest  # taking the picture held up the window, not the app

    def corner(self):
        """The colour that the screen has in the window's corner."""
        return self.window.screen().grabWindow(self.window.winId(), 3, 3, 1, 1).toImage().pixelColor(0, 0).name()

    def drawn(self, watch):
        """The view shows what was asked of it last, in full."""

        def there():
            wanted, report = watch.view.frame_request(), watch.view.overlay.report
            got = None if report is None or report.request.moving else report.request
            same = got is not None and (got.orbit, got.look, got.t) == (wanted.orbit, wanted.look, wanted.t)
            return same and report.quality == FULL

        self.wait(there, 30, "the picture")

    def do(self, action_id):
        if not self.window.table.trigger(action_id):
            raise SystemExit(f"{action_id} is not possible here")


def _likeness(view):
    """dB between what the view shows and its scene drawn anew with every Gaussian at full size."""
    report, shown = view.overlay.report, view.surface.grab().toImage().convertToFormat(QImage.Format.Format_RGB888)
    rows = np.frombuffer(shown.constBits(), np.uint8).reshape(shown.height(), shown.bytesPerLine())
    pixels = rows[:, : 3 * shown.width()].reshape(shown.height(), shown.width(), 3).astype(np.float64)
    full = view.surface.image(report.request, report.request.view(shown.width(), shown.height()))[..., :3]
    return float(10 * np.log10(255.0**2 / max(np.mean((pixels - full) ** 2), 1e-5)))


def main():
    drive = Drive(sys.argv[1])
    what, *more = sys.argv[2:] or ["job"]
    figures = _job(drive, *more) if what == "job" else _play(drive, float(more[0]), *more[1:])
    drive.window.close()
    (drive.folder / f"{what}.json").write_text(json.dumps(figures))
    print(json.dumps(figures))


def _job(drive, clip=None):
    drive.shot("start")
    watch = drive.open(clip)
    drive.shot("clip")
    figures = _run(drive, watch)
    figures |= _exports(drive, watch)
    figures |= {"torch": "torch" in sys.modules, "at_rest_db": drive.at_rest_db}
    figures |= _stalls(drive)
    return figures


def _stalls(drive):
    """What the watchdog saw, and what it says of a stall of 250 ms that is made on purpose."""
    dog = drive.window.watchdog
    found = sorted(dog.stalls, reverse=True)
    figures = {"longest": dog.longest, "stalls": [round(late) for late, _ in found]}
    figures["busy"] = sorted((round(busy) for _, busy in found), reverse=True)
    drive.rest(0.2)
    dog.reset()
    QTimer.singleShot(0, lambda: time.sleep(0.25))
    drive.rest(0.5)
    figures["on_purpose"] = dog.longest if dog.stalls else 0.0
    dog.reset()
    return figures


def _play(drive, seconds, clip=None):
    """Something else every second while the optimiser works."""
    window = drive.window
    watch = drive.open(clip)
    window.show_workspace("annotate")  # opened once: reading its clip is not part of the play
    drive.rest(5)
    window.show_workspace("watch")
    watch.setup.preset.setCurrentIndex(watch.setup.preset.findData("standard"))
    watch.setup.budget.setValue(seconds + 600)
    QTest.mouseClick(watch.setup.start_button, Qt.MouseButton.LeftButton)
    drive.wait(lambda: len(watch.control.log.step) > 3, 600, "steps")
    window.watchdog.reset()
    begun, done = time.monotonic(), 0
    docks = list(watch.docks.values())
    plays = [
        *(lambda name=name: drive.do(f"view.{name}") for name in ("right_30", "above_30", "back", "input")),
        *(lambda name=name: drive.do(f"compare.{name}") for name in ("wipe", "difference", "scene", "side")),
        *(lambda name=name: drive.do(f"mode.{name}") for name in ("depth", "flow", "residual", "ellipsoids", "rgb")),
        *(lambda dock=dock: dock.setFloating(not dock.isFloating()) for dock in docks for _ in range(2)),
        *(lambda name=name: window.show_workspace(name) for name in ("annotate", "watch")),
        *(lambda: drive.do("window.theme"),) * 2,
        *(lambda dock=dock: dock.raise_() for dock in docks),
        *(lambda at=at: window.state.set(frame=at) for at in (3, 17, 9)),
        lambda: QTest.mouseClick(watch.view, Qt.MouseButton.LeftButton, pos=watch.view.rect().center()),
        *(lambda: drive.do("time.play"),) * 2,
    ]
    slow = {}
    while time.monotonic() < begun + seconds:
        if not watch.control.live and watch.session.scene is not None:  # it was over before the time: once more
            drive.do("run.start")
        seen = len(window.watchdog.stalls)
        plays[done % len(plays)]()
        drive.rest(1.0)
        for stall in window.watchdog.stalls[seen:]:
            slow.setdefault(str(done % len(plays)), []).append([round(value) for value in stall])
        done += 1
    figures = {"seconds": time.monotonic() - begun, "steps": len(watch.control.log.step), "done": done, "slow": slow}
    figures |= _stalls(drive)
    if watch.control.live:
        drive.do("run.stop_keep")
    drive.wait(lambda: watch.session.scene is not None, 120, "the scene that was kept")
    return figures


def _run(drive, watch):
    window, control = drive.window, watch.control
    watch.setup.budget.setValue(BUDGET)
    window.watchdog.reset()
    begun = time.monotonic()
    QTest.mouseClick(watch.setup.start_button, Qt.MouseButton.LeftButton)
    drive.wait(lambda: watch.view.overlay.report is not None, 60, "the first cloud")  # drawn, not only known
    figures = {"first_cloud": time.monotonic() - begun}
    drive.shot("cloud")
    drive.wait(lambda: len(control.log.step) > 10, 600, "steps")
    drive.shot("running")
    for name, angles in (("right_30", (0, 30)), ("above_30", (30, 0)), ("input", (0, 0))):
        drive.do(f"view.{name}")
        drive.wait(lambda angles=angles: (watch.view.orbit.elevation, watch.view.orbit.azimuth) == angles, 20, name)
        drive.drawn(watch)
        drive.shot(name)
    window.state.set(frame=10)
    drive.shot("scrubbed")
    window.state.set(selected_object=int(window.state.clip.object_ids[0]))
    drive.do("view.solo")
    drive.drawn(watch)
    drive.shot("solo")
    drive.do("edit.undo")
    QTest.mouseClick(watch.view, Qt.MouseButton.LeftButton, pos=watch.view.rect().center())
    drive.wait(lambda: watch.picking.trajectory is not None, 30, "the picked Gaussian")
    figures["picked"] = watch.picking.list.topLevelItemCount()
    drive.shot("picked")
    drive.do("run.pause")
    drive.wait(lambda: control.state == "paused", 30, "the pause")
    steps = len(control.log.step)
    drive.do("run.step")
    drive.wait(lambda: len(control.log.step) == steps + 1 and control.state == "paused", 60, "one step")
    drive.shot("paused")
    drive.do("run.pause")
    drive.wait(lambda: control.state == "running", 30, "going on")
    drive.do("run.stop_keep")
    drive.wait(lambda: watch.session.scene is not None, 120, "the scene that was kept")
    figures["steps"] = len(control.log.step)
    drive.shot("kept")
    return figures


def _exports(drive, watch):
    take, scene = watch.take_away, str(watch.take_away.scene_file)
    drive.do("compare.difference")
    drive.wait(lambda: watch.center.comparison.render is not None, 30, "the comparison")
    drive.shot("difference")
    drive.do("compare.side")
    drive.do("panel.compare")
    watch.compare.offers.aboutToShow.emit()
    watch.compare.freeze.click()
    drive.wait(lambda: watch.compare._pair is not None, 30, "two scenes")
    drive.shot("compared")
    watch.compare.mode.setCurrentIndex(0)
    watch.compare.mode.activated.emit(0)
    drive.do("panel.tracks")
    drive.shot("tracks")
    copy, film = drive.folder / "copy.h5", drive.folder / "turn.mp4"
    for request in (
        ExportRequest("hdf5", scene, str(copy)),
        ExportRequest("turntable", scene, str(film), seconds=1.0, fps=8, short_side=128),
    ):
        take.export(request)
        drive.wait(lambda: take.last is not None, 180, request.kind)
    take.save_picture(str(drive.folder / "view.png"), (640, 360), True)
    drive.wait(lambda: take.last is not None, 60, "the picture")
    dark = drive.corner()
    drive.do("window.theme")
    drive.wait(lambda: drive.corner() != dark, 60, "the light theme")
    drive.shot("light")
    copied = scene_hdf5.read(copy)
    psnr = copied.curve[-1]["psnr_held_out"]
    return {"gaussians": len(copied.xyz), "film": film.stat().st_size, "psnr": psnr}


if __name__ == "__main__":
    main()
