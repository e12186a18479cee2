"""Real windows, driven: `window_program.py CASE [COUNT]` prints one JSON object. Run by test_windows.py."""

from __future__ import annotations

import gc
import json
import sys
import threading
import time
from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QDockWidget, QLabel, QMainWindow
from scenes import small_scene

from genmojo_studio.app import make_application
from genmojo_studio.view3d.cpu_painter import CpuPainter
from genmojo_studio.view3d.cpu_view import CpuView
from genmojo_studio.view3d.frames import FrameReport
from genmojo_studio.view3d.gl_probe import GlKind, probe
from genmojo_studio.view3d.look import Look, Mode
from genmojo_studio.view3d.orbit import Orbit
from genmojo_studio.view3d.overlay import axes_of, axis_ends
from genmojo_studio.view3d.picking import Pick
from genmojo_studio.view3d.scene_view import SceneView
from genmojo_studio.view3d.snapshot import SceneSnapshot
from genmojo_studio.view3d.splat_view import SplatView

LIMIT_S = 120.0  # a slow, busy machine draws at last


class Watched:
    """A view and the frames it has drawn."""

    def __init__(self, view: SceneView) -> None:
        self.view = view
        self.reports: list[FrameReport] = []
        view.frame_drawn.connect(self.reports.append)

    def after(self, act: Callable[[], object]) -> FrameReport:
        """Do something and wait for the full picture that follows."""
        self.reports.clear()
        act()
        wait(lambda: bool(self.reports) and not self.reports[-1].request.moving)
        return self.reports[-1]

    def rest(self) -> None:
        """Until nothing is drawn any more."""
        seen = -1
        while seen != len(self.reports):
            seen = len(self.reports)
            QTest.qWait(300)


def wait(done: Callable[[], bool]) -> None:
    """Until something is so. qWait keeps Python's lock, so that other threads run in the sleep only."""
    end = time.monotonic() + LIMIT_S
    while not done():
        QTest.qWait(1)
        time.sleep(0.004)
        if time.monotonic() > end:
            raise TimeoutError("nothing was drawn")


def shown(view: SceneView) -> np.ndarray:
    """Pixels of the surface as the screen has them (H, W, 3)."""
    surface = view.surface
    image = surface.grabFramebuffer() if isinstance(surface, SplatView) else surface.grab().toImage()
    image = image.convertToFormat(image.Format.Format_RGB888)
    rows = np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), image.bytesPerLine())
    return rows[:, : 3 * image.width()].reshape(image.height(), image.width(), 3).astype(int)


def decibels(a: np.ndarray, b: np.ndarray) -> float:
    return float(-10 * np.log10(max(np.mean(((a - b) / 255.0) ** 2), 1e-9)))


def memory_mb() -> float:
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * 4096 / 1e6


def the_scene() -> SceneSnapshot:
    return SceneSnapshot.from_baked(small_scene(frames=4, size=(160, 120)))


def life(engine: str) -> dict:
    """Draw, compare with what the same moment looks like elsewhere, turn, ask, scrub."""
    snapshot = the_scene()
    watched = Watched(SceneView(engine=engine))
    view = watched.view
    view.resize(400, 300)
    view.set_snapshot(snapshot)
    watched.after(view.show)
    answer: dict = {"surface": type(view.surface).__name__}
    size = shown(view).shape
    answer["pixels"] = [size[1], size[0]]
    answer["screen_is_screenshot"] = decibels(shown(view), view.screenshot(size[1], size[0])[..., :3].astype(int))
    painter = CpuPainter()
    painter.upload(snapshot)
    request = view.frame_request()
    sums = painter.picture(request.view(size[1], size[0]), Look(), 0.0).sums[..., :3]
    answer["screen_is_optimiser"] = decibels(shown(view), np.clip(sums, 0, 1) * 255)
    picks: list[Pick] = []
    view.picked.connect(picks.append)
    at = view.view()
    spot = QPoint(int(at.fx * -0.6 / 4 + at.cx), int(at.cy))
    QTest.mouseClick(view, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, spot)
    answer["picked"] = picks[0].main.object_name if picks and picks[0].main else ""
    orbits: list[Orbit] = []
    view.view_changed.connect(orbits.append)
    QTest.mousePress(view, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, spot)
    watched.reports.clear()
    for k in range(1, 9):
        QTest.mouseMove(view, spot + QPoint(5 * k, 3 * k))
        QTest.qWait(10)
    QTest.mouseRelease(view, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, spot + QPoint(40, 24))
    wait(lambda: bool(watched.reports) and not watched.reports[-1].request.moving)
    answer["dragged"] = [orbits[-1].elevation, orbits[-1].azimuth] if orbits else []
    answer["picks_after_drag"] = len(picks)
    watched.after(lambda: view.preset("right_30"))
    answer["preset"] = [view.orbit.elevation, view.orbit.azimuth]
    axis = next(place for place, _, name, _ in axis_ends(view.overlay.gizmo_rect(), axes_of(watched.reports[-1]))
                if name == "top")  # fmt: skip
    spot = axis.toPoint()
    watched.after(lambda: QTest.mouseClick(view, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, spot))
    answer["gizmo"] = [view.orbit.elevation, view.orbit.azimuth]
    answer["picks_after_gizmo"] = len(picks)
    watched.after(lambda: view.set_orbit(Orbit()))
    before = shown(view)
    watched.after(lambda: view.set_time(3.0))
    answer["time_changes_it"] = decibels(before, shown(view))
    for mode in list(Mode)[1:]:
        watched.after(lambda mode=mode: view.set_look(Look(mode=mode)))
        if shown(view).max() == 0 and mode != Mode.RESIDUAL:
            answer["black"] = str(mode)
    watched.after(lambda: view.set_look(Look(canonical=True)))
    view.showMinimized()
    watched.rest()
    watched.reports.clear()
    view.set_orbit(Orbit(azimuth=7.0))
    QTest.qWait(400)
    answer["drawn_while_minimised"] = len(watched.reports)
    watched.after(view.showNormal)
    answer["after_minimised"] = watched.reports[-1].request.orbit.azimuth
    second = Watched(SceneView(engine=engine))
    second.view.resize(200, 150)
    second.view.set_snapshot(snapshot)
    second.after(second.view.show)
    answer["second"] = int(shown(second.view).max())
    view.close()
    watched.after(view.show)
    answer["closed_and_shown"] = int(shown(view).max())
    view.close()
    second.after(lambda: second.view.set_orbit(Orbit(10, 10)))
    answer["second_after_first_closed"] = int(shown(second.view).max())
    second.view.close()
    return answer


def docks(count: int) -> dict:
    """Take a dock out and put it back, again and again; then delete it while it draws."""
    window = QMainWindow()
    window.setCentralWidget(QLabel("middle"))
    dock = QDockWidget("scene", window)
    watched = Watched(SceneView(engine="gl"))
    view = watched.view
    dock.setWidget(view)
    window.addDockWidget(Qt.DockWidgetArea.RightDockWidgetArea, dock)
    window.resize(600, 300)
    view.set_snapshot(the_scene())
    watched.after(window.show)

    def toggle(k: int) -> None:
        dock.setFloating(k % 2 == 0)
        dock.resize(260 + 20 * (k % 3), 220)
        view.set_orbit(Orbit(azimuth=float(k + 1)))

    black, sizes, memory = 0, set(), []
    for k in range(count):
        watched.after(partial(toggle, k))
        picture = shown(view)
        black += int(picture.max() == 0)
        sizes.add(picture.shape[:2])
        memory.append(memory_mb())
    threads = threading.active_count()
    dock.deleteLater()
    QTest.qWait(100)
    window.close()
    third = max(len(memory) // 3, 1)
    growth = float(np.median(memory[-third:]) - np.median(memory[third : 2 * third]))
    return {"black": black, "sizes": len(sizes), "growth_mb": growth, "threads": threads}


def previews(count: int) -> dict:
    """A run's previews: other values each time, now and then another number of Gaussians."""
    watched = Watched(SceneView(engine="gl"))
    view = watched.view
    view.resize(160, 120)
    base = replace(the_scene(), frames=None)
    view.set_snapshot(base)
    watched.after(view.show)
    rng = np.random.default_rng(0)
    memory = []
    slowest = 0.0
    for k in range(count):
        moved = replace(base, version=k + 1, positions=base.positions + rng.normal(0, 0.02, base.positions.shape))
        if k % 50 == 49:
            kept = rng.random(len(base)) < 0.9
            names = ("positions", "rotations", "scales", "opacities", "colours", "object_id", "uid")
            moved = replace(moved, **{name: getattr(moved, name)[kept] for name in names})
        start = time.monotonic()
        watched.after(lambda moved=moved: view.set_snapshot(moved))
        slowest = max(slowest, time.monotonic() - start)
        if k % 20 == 0:
            gc.collect()
            memory.append(memory_mb())
    newest = watched.reports[-1].request.snapshot.version
    view.close()
    half = len(memory) // 2
    return {"growth_mb": float(np.median(memory[-3:]) - np.median(memory[half : half + 3])), "newest": newest}


def missing(_: int) -> dict:
    """Where Qt has no OpenGL at all: the view opens, says so, and draws; also one that insisted on OpenGL."""
    answer: dict = {"probe": probe().name}
    for engine in ("auto", "gl"):
        view = SceneView(engine=engine)
        watched = Watched(view)
        view.resize(200, 150)
        view.set_snapshot(the_scene())
        watched.after(view.show)
        answer[engine] = [type(view.surface).__name__, view.overlay.message, int(shown(view).max())]
        view.close()
    return answer


def broken(_: int) -> dict:
    """A driver that fails while drawing (out of memory, lost context): the processor takes over, with the reason."""
    view = SceneView(engine="gl")
    watched = Watched(view)
    view.resize(200, 150)
    view.set_snapshot(the_scene())
    watched.after(view.show)

    def fail(*_: object) -> None:
        raise MemoryError("driver out of memory")

    view.surface.renderer.draw = fail
    watched.reports.clear()
    view.set_orbit(Orbit(azimuth=5.0))
    wait(lambda: isinstance(view.surface, CpuView) and bool(watched.reports))
    answer = {
        "surface": type(view.surface).__name__,
        "message": view.overlay.message,
        "brightest": int(shown(view).max()),
    }
    view.close()
    return answer


def late(_: int) -> dict:
    """A first picture that takes long (kernels are compiled) is explained while it does."""
    view = SceneView(engine="cpu")
    watched = Watched(view)
    texts = []
    view.surface.waiting.connect(texts.append)
    draw = CpuPainter.picture

    def slowly(self: CpuPainter, *args: object) -> object:
        time.sleep(1.5)
        return draw(self, *args)

    CpuPainter.picture = slowly
    view.resize(200, 150)
    view.set_snapshot(the_scene())
    watched.after(view.show)
    view.close()
    return {"texts": texts, "left_on_screen": view.overlay.waiting}


def main() -> None:
    application = make_application()
    case, count = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 0
    if case != "missing" and probe() == GlKind.MISSING:
        answer: dict = {"skip": f"no OpenGL 3.3 in windows here ({QApplication.platformName()})"}
    elif case == "life":
        answer = life("gl")
    elif case == "processor":
        answer = life("cpu")
    else:
        answer = {"docks": docks, "previews": previews, "missing": missing, "broken": broken, "late": late}[case](count)
    answer["probe"] = probe().name
    answer["left"] = [t.name for t in threading.enumerate() if t.name.startswith("splat")]
    print(json.dumps(answer))
    del application


if __name__ == "__main__":
    main()
