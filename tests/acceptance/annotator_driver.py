"""A scripted annotator at the real widgets: mouse and keys only, through all four steps, at 1920 x 1080.

    python tests/acceptance/annotator_driver.py CLIP [--scene scene.h5] [--shots DIR] [--seed 0]

Prints one JSON object: keys per track, errors in pixels of 1920 x 1080, states, seconds. With `--scene` the seeds come
from that scene through the seed dialog, without from the built-in tracker. A clip without truth.npz is only walked
through: points on corners, seeds, every frame accepted, the queue visited; its keys are the clicks that place points.

Rules as in tests/simulated_annotator.py: it sees the frames that a person visits (every second, then the queue),
corrects a point that is off by more than 3 px as seen, clicks with 1 px noise; every click, drag and state stroke is a
key, Enter and choosing a point are not. It reads the truth only for what a person would see in the frame on show.
"""

from __future__ import annotations

import argparse
import json
import sys
import tempfile
import time
from pathlib import Path

import cv2
import numpy as np
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from shiboken6 import isValid

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from simulated_annotator import FULL, NOISE, OFF, Report, most_trackable, truth_of  # noqa: E402

from genmojo_core.clip import images, layouts, png  # noqa: E402
from genmojo_core.tracks.model import NONE, OCCLUDED, OUT_OF_VIEW, VISIBLE  # noqa: E402
from genmojo_core.tracks.suspicion import SUSPICIOUS  # noqa: E402
from genmojo_studio import shell_actions, theme  # noqa: E402
from genmojo_studio.actions import ActionTable  # noqa: E402
from genmojo_studio.annotate.actions import ACTIONS  # noqa: E402
from genmojo_studio.annotate.seed_dialog import SeedDialog  # noqa: E402
from genmojo_studio.annotate.session import open_session  # noqa: E402
from genmojo_studio.annotate.workspace import AnnotateWorkspace  # noqa: E402
from genmojo_studio.menus import Menus  # noqa: E402
from genmojo_studio.state import AppState  # noqa: E402

LEFT, NO_KEY = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier
ZOOM = 4.0  # screen pixels per clip pixel while points are placed: a mouse has whole pixels


def write_full_hd(source: Path, target: Path) -> Path:
    """The clip's frames and masks as files of 1920 x 1080."""
    found = layouts.find(source)
    for path in found.frames:
        picture = cv2.resize(images.read_rgb(path)[..., ::-1], FULL, interpolation=cv2.INTER_CUBIC)
        folder = target / layouts.IMAGES / found.name
        folder.mkdir(parents=True, exist_ok=True)
        cv2.imwrite(str(folder / f"{path.stem}.jpg"), picture, [cv2.IMWRITE_JPEG_QUALITY, 95])
    for path in layouts.image_files(found.masks):
        folder = target / layouts.MASKS / found.name
        folder.mkdir(parents=True, exist_ok=True)
        labels = cv2.resize(images.read_labels(path).index, FULL, interpolation=cv2.INTER_NEAREST)
        (folder / path.name).write_bytes(png.encode_palette(labels, png.davis_palette()))
    return target


class Hands:
    """Mouse, keys and eyes of the annotator."""

    def __init__(self, clip: Path, source: Path, scene: Path | None, shots: Path | None, seed: int) -> None:
        self.truth = truth_of(source) if (source / "truth.npz").exists() else None
        self.scene, self.shots = scene, shots
        self.rng = np.random.default_rng(seed)
        self.state = AppState()
        table = ActionTable([*shell_actions.ACTIONS, *ACTIONS])
        self.w = AnnotateWorkspace(self.state, table)
        self.menus = Menus(self.w, table)
        self.w.resize(1920, 1040)
        self.w.show()
        self.w.activateWindow()  # keys reach only the active window
        QTest.qWaitForWindowActive(self.w)
        project = Path(tempfile.mkdtemp()) / "driven.genmojo"
        self.w.open_with(open_session(self.state, clip, "driver", project))
        self.menus.set_workspace("annotate")
        self.s = self.w.session
        self.row: dict[int, int] = {}
        self.keys: dict[int, int] = {}
        self.strokes: dict[int, int] = {}
        self.seconds: list[float] = []  # CPU of the whole app, from a click to the tracks solved
        self.waits: list[float] = []  # wall time of the same
        self.solved = 0
        self.w.work.tracker.solved.connect(self._count_solved)
        self.enters = 0

    def run(self, points: int = 5, stride: int = 2, share: float = 0.2) -> Report:
        """All four steps; the report of what stands at the end."""
        self.wait(lambda: bool(self.w.objects.figures), 600)
        self.objects()
        self.points(points)
        self.seed()
        self.refine(stride)
        self.queue(share)
        report = self.report()
        self.review()
        self.w.close()
        return report

    # ---- the four steps

    def objects(self) -> None:
        """Choose every candidate."""
        for row in range(self.w.objects.table.rowCount()):
            self.w.objects.table.selectRow(row)
            self.press(self.w.objects.choose_button)
        self.shot("1-objects")

    def points(self, count: int) -> None:
        """Five points per object that are seen on the first frame, those that the meter likes best."""
        self.press(self.w.bar.buttons[1])
        for info in self.s.objects():
            for number, (row, place) in enumerate(self.choices(info.id)[:count]):
                self.s.select(info.id, number + 1)
                self.click_at(*place)
                track = self.s.track_of(info.id, number + 1)
                self.row[track], self.keys[track], self.strokes[track] = row, 1, 0
        self.shot("2-points")

    def choices(self, object_id: int) -> list[tuple[int, tuple[float, float]]]:
        """Rows of the truth (-1: none) and places to click, the most trackable first."""
        if self.truth is not None:
            rows = most_trackable(self.s.clip, self.truth, object_id).tolist()
            return [(row, self.aim(row, 0)) for row in rows]
        frame, labels = self.s.cache.read(0), self.s.mask_at(0)
        inside = cv2.erode((labels == object_id).astype(np.uint8), np.ones((9, 9), np.uint8))
        corners = cv2.goodFeaturesToTrack(cv2.cvtColor(frame, cv2.COLOR_BGRA2GRAY), 5, 0.01, 12, mask=inside)
        found = [] if corners is None else corners[:, 0] + 0.5
        return [(-1, (float(x), float(y))) for x, y in found]

    def seed(self) -> None:
        """The dialog, with what it offers first, or with a scene."""
        self.w.table.trigger("annotate.track.seed")
        dialog = next(d for d in self.w.findChildren(SeedDialog) if d.isVisible())
        if self.scene is not None:
            dialog.choose("scene")
            dialog.scene.line.setText(str(self.scene))
        self.press(dialog.start)
        self.wait(lambda: not isValid(dialog), 1800)  # it deletes itself when it is done
        self.wait(lambda: all((self.s.annotation.track(t).state != NONE).all() for t in self.row), 10)
        self.idle()

    def refine(self, stride: int) -> None:
        """Step through the clip, correct, accept."""
        self.press(self.w.bar.buttons[2])
        self.w.bar.stride.setValue(stride)
        self.go(stride)
        while True:
            frame = self.s.frame
            for track in list(self.row):
                self.look_at(track)
            if frame == stride * 4:
                self.shot("3-refine")
            for _ in range(3 * len(self.row)):
                self.key(Qt.Key.Key_Return)
                self.enters += 1
                if self.s.frame != frame:
                    break
            if self.s.frame == frame:
                if frame + stride < self.s.annotation.frames:
                    raise TimeoutError(f"Enter does not leave frame {frame}")
                return
            if self.s.frame - frame < stride:
                return
            self.idle()

    def queue(self, share: float) -> None:
        """The worst of the queue, N by N."""
        self.idle()
        spots = [s for s in self.w.hands.going.spots if s.score >= SUSPICIOUS]
        total = len(self.row) * self.s.annotation.frames / 4
        for spot in spots[: int(np.ceil(share * total))]:
            self.key(Qt.Key.Key_N)
            self.idle()
            if self.s.track in self.row:
                self.look_at(self.s.track)
            del spot

    def review(self) -> None:
        """Approve everything."""
        self.press(self.w.bar.buttons[3])
        for track in list(self.row):
            self.s.select_track(track)
            self.press(self.w.review.approve_button)
        self.shot("4-review")

    # ---- eyes and hands

    def look_at(self, track: int) -> None:
        """Correct a point of the frame on show if it is seen to be wrong."""
        if self.truth is None:
            return
        t, row = self.s.frame, self.row[track]
        cells = self.s.annotation.cells(track, np.array([t]))
        seen = bool(self.truth.visible[row, t])
        if seen and np.linalg.norm(cells.xy[0] - self.truth.xy[row, t]) > OFF:
            self.keys[track] += 1
            self.s.select_track(track)
            cpu, began, before = time.process_time(), time.monotonic(), self.solved
            self.click_at(*self.aim(row, t))
            busy = self.w.work.tracker.tasks
            self.wait(lambda: self.solved > before or not busy.busy, 600)  # a click may also only choose a point
            self.seconds.append(time.process_time() - cpu)
            self.waits.append(time.monotonic() - began)
            self.idle()
        elif (cells.state[0] == VISIBLE) != seen:
            self.keys[track] += 1
            self.strokes[track] += 1
            last = t
            while last + 1 < self.s.annotation.frames and bool(self.truth.visible[row, last + 1]) == seen:
                last += 1
            state = VISIBLE if seen else (OUT_OF_VIEW if self.truth.state[row, t] == OUT_OF_VIEW else OCCLUDED)
            self.paint(track, state, t, last)

    def paint(self, track: int, state: int, first: int, last: int) -> None:
        """A drag over the dope sheet, or a key for one frame."""
        self.s.select_track(track)
        if first == last:
            key = {VISIBLE: Qt.Key.Key_V, OCCLUDED: Qt.Key.Key_Q, OUT_OF_VIEW: Qt.Key.Key_O}[state]
            self.key(key)
            return
        sheet = self.w.play.sheet
        self.w.play.brush.setCurrentIndex(self.w.play.brush.findData(state))
        place = sheet.rows().index(track)
        sheet.verticalScrollBar().setValue(max(0, place - 2))
        y = 30 + 18 * (place - sheet.verticalScrollBar().value()) + 9
        start, end = (QPoint(round(sheet.x_of(f + 0.5)), y) for f in (first, last))
        QTest.mousePress(sheet.viewport(), LEFT, NO_KEY, start)
        QTest.mouseMove(sheet.viewport(), (start + end) / 2)
        QTest.mouseMove(sheet.viewport(), end)
        QTest.mouseRelease(sheet.viewport(), LEFT, NO_KEY, end)
        self.idle()

    def _count_solved(self, _tracks: int) -> None:
        self.solved += 1

    def key(self, key: Qt.Key) -> None:
        """Press a key in the frame; without a window manager nobody else gives the window the keyboard back."""
        if not self.w.isActiveWindow():
            self.w.activateWindow()
            QTest.qWaitForWindowActive(self.w)
        self.w.canvas.setFocus()
        QTest.keyClick(self.w.canvas, key)

    def click_at(self, x: float, y: float) -> None:
        """Zoom there and click; where another point is in the way, drag the own one."""
        canvas = self.w.canvas
        self.wait(lambda: self.w.screen_link.painted == self.s.frame, 30)  # a person clicks what is on show
        canvas.zoom(ZOOM / canvas.mapping.zoom)
        canvas.mapping = canvas.mapping.centred(x, y, (canvas.width(), canvas.height()))
        QApplication.processEvents()
        wx, wy = canvas.mapping.to_widget(x, y)
        QTest.mouseClick(canvas, LEFT, NO_KEY, QPoint(round(wx), round(wy)))

    def aim(self, row: int, t: int) -> tuple[float, float]:
        """Where a person clicks: the point as seen, with a pixel of noise."""
        x, y = self.truth.xy[row, t] + self.rng.normal(0.0, NOISE, 2)
        return float(x), float(y)

    def press(self, button: object) -> None:
        """Click a button with the mouse."""
        QTest.mouseClick(button, LEFT)
        QApplication.processEvents()

    def go(self, frame: int) -> None:
        """Click the ruler of the dope sheet."""
        sheet = self.w.play.sheet
        QTest.mouseClick(sheet.viewport(), LEFT, NO_KEY, QPoint(round(sheet.x_of(frame + 0.5)), 8))
        self.wait(lambda: self.w.screen_link.painted == frame, 30)

    def idle(self) -> None:
        """Until the solver and the queue are done."""
        tracker = self.w.work.tracker
        self.wait(lambda: not tracker.tasks.busy and not tracker._look.isActive(), 600)

    def wait(self, until: object, seconds: float) -> None:
        """Let the app work. `QTest.qWait` would hold the interpreter lock, and the threads waited for would starve."""
        end = time.monotonic() + seconds
        while not until() and time.monotonic() < end:
            QApplication.processEvents()
            time.sleep(0.005)
        if not until():
            raise TimeoutError("the annotator waited in vain")

    def shot(self, name: str) -> None:
        if self.shots is not None:
            self.w.canvas.fit()
            QTest.qWait(300)
            self.w.grab().save(str(self.shots / f"driven-{name}.png"))

    def report(self) -> Report:
        """How good the tracks are now."""
        errors, per_track, right = [], [], []
        for track, row in self.row.items() if self.truth is not None else ():
            cells, seen = self.s.annotation.track(track), self.truth.visible[row]
            error = np.linalg.norm(cells.xy - self.truth.xy[row], axis=1)
            errors.append(error[seen])
            per_track.append(np.median(error[seen]))
            right.append(((cells.state == VISIBLE) == seen).mean())
        keys, strokes = (np.array([found[i] for i in self.row]) for found in (self.keys, self.strokes))
        every = np.concatenate(errors) if errors else np.zeros(0)
        return Report(keys, strokes, every, np.array(per_track), float(np.mean(right or [0.0])), self.seconds)


def drive(source: Path, scene: Path | None, shots: Path | None, seed: int) -> dict[str, object]:
    """Annotate a clip at 1920 x 1080 through the widgets; its figures."""
    began, cpu = time.monotonic(), time.process_time()
    application = QApplication.instance() or QApplication([])
    theme.apply(application, "dark")
    with tempfile.TemporaryDirectory() as name:
        hands = Hands(write_full_hd(source, Path(name) / "clip"), source, scene, shots, seed)
        report = hands.run()
    figures: dict[str, object] = {
        "clip": source.name, "seeds": "scene" if scene else "optical", "tracks": len(report.keys),
        "keys": float(np.median(report.keys)), "keys_per_track": report.keys.tolist(), "enters": hands.enters,
        "seconds": time.monotonic() - began, "cpu_seconds": time.process_time() - cpu,
    }  # fmt: skip
    if len(report.errors):
        figures |= {"error": float(np.median(report.errors)), "p90": float(np.quantile(report.errors, 0.9)),
                    "errors": report.errors.round(3).tolist(),
                    "oa": report.right_states, "error_per_track": report.per_track.tolist(),
                    "solve_seconds": float(np.median(report.solve_seconds)),
                    "solve_wait": float(np.median(hands.waits))}  # fmt: skip
    return figures


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("clip", type=Path)
    parser.add_argument("--scene", type=Path)
    parser.add_argument("--shots", type=Path, help="folder for screenshots of the four steps")
    parser.add_argument("--seed", type=int, default=0, help="of the noise of its clicks")
    args = parser.parse_args()
    if args.shots:
        args.shots.mkdir(parents=True, exist_ok=True)
    sys.stdout.write(json.dumps(drive(args.clip, args.scene, args.shots, args.seed)) + "\n")
