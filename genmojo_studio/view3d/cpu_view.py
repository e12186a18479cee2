"""The surface the processor draws on: where OpenGL is missing, or is a program itself and slower than our kernels.

A thread of its own draws the newest request; the window only shows finished pictures and never waits.
"""

from __future__ import annotations

import contextlib
import threading
import time
from collections.abc import Callable

import numpy as np
from PySide6.QtCore import QRectF, Qt, QTimer, Signal
from PySide6.QtGui import QCloseEvent, QColor, QImage, QPainter, QPaintEvent, QResizeEvent, QShowEvent
from PySide6.QtWidgets import QWidget

from genmojo_core.clip.cameras import View
from genmojo_core.errors import GenmojoError
from genmojo_studio.background import give_way
from genmojo_studio.translate import tr
from genmojo_studio.view3d.colouring import colour, straight_rgba, value_bounds
from genmojo_studio.view3d.cpu_painter import CpuPainter, warm_up
from genmojo_studio.view3d.frames import Feeder, FrameReport, FrameRequest
from genmojo_studio.view3d.look import BLACK, SCALAR_MODES, Mode
from genmojo_studio.view3d.quality import FULL, MOVING_MS, Detail

PATIENCE_MS = 1000  # the first picture takes longer where the kernels have to be compiled
LARGEST_PIXELS = 1 << 26


class CpuView(QWidget):
    """Draws the newest request. `drawn(FrameReport)` after every frame; `failed(str)` where the kernels fail."""

    drawn = Signal(object)
    failed = Signal(str)
    waiting = Signal(str)  # why the first picture takes long; "" when it is there
    _finished = Signal(object, object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.backdrop = BLACK  # where there is no scene
        self._image: QImage | None = None
        self._pixels: np.ndarray | None = None  # keeps the image's memory
        self._newest: FrameRequest | None = None
        self._asked: FrameRequest | None = None
        self._finished.connect(self._show, Qt.ConnectionType.QueuedConnection)
        self._patience = QTimer(self, interval=PATIENCE_MS, singleShot=True)
        self._patience.timeout.connect(self._tell_why)
        self._drawer = Drawer(self._finished.emit, self.failed.emit)
        self.destroyed.connect(self._drawer.stop)

    def show_frame(self, request: FrameRequest) -> None:
        """Draw this soon, or as soon as the window is no longer minimised; older requests are forgotten."""
        self._newest = request
        if not self.window().isMinimized():
            self._asked = request
            if self._image is None and not self._patience.isActive():
                self._patience.start()
            self._drawer.ask(request, self._device_size())

    def set_limit(self, ms: float) -> None:
        """A frame while moving may take so long; less detail is drawn where it would take longer."""
        self._drawer.limit_ms = ms

    def clear(self) -> None:
        """There is no scene any more."""
        self._newest = self._asked = self._image = None
        self._patience.stop()
        self.update()

    def image(self, request: FrameRequest, view: View) -> np.ndarray:  # (H, W, 4) uint8
        """A picture of any size off screen, at full detail."""
        return self._drawer.image(request, view)

    def drop_gl(self) -> None:
        """Stop the thread; the next request starts another."""
        self._drawer.stop()

    def paintEvent(self, event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Show the newest finished picture, stretched where it was drawn with less detail."""
        if self._newest is not None and self._newest is not self._asked:
            self.show_frame(self._newest)  # it came while the window was minimised
        painter = QPainter(self)
        if self._image is None:
            painter.fillRect(self.rect(), QColor.fromRgbF(*self.backdrop))
        else:
            painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
            painter.drawImage(QRectF(self.rect()), self._image)
        painter.end()

    def showEvent(self, event: QShowEvent) -> None:  # noqa: N802 - Qt's name
        """Somebody will want a picture: the kernels are made ready while there is no scene yet."""
        super().showEvent(event)
        self._drawer.begin()

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        """Another size needs another picture."""
        if self._newest is not None:
            self.show_frame(self._newest)

    def closeEvent(self, event: QCloseEvent) -> None:  # noqa: N802 - Qt's name
        """The window goes: so does the thread."""
        self.drop_gl()
        super().closeEvent(event)

    def _show(self, pixels: np.ndarray, report: FrameReport) -> None:
        """A picture is ready."""
        if self._newest is None:  # cleared meanwhile
            return
        if self._image is None:
            self._patience.stop()
            self.waiting.emit("")
        height, width = pixels.shape[:2]
        self._pixels = pixels
        self._image = QImage(pixels.data, width, height, 3 * width, QImage.Format.Format_RGB888)
        self.update()
        self.drawn.emit(report)

    def _tell_why(self) -> None:
        """The first picture is late: kernels are compiled where they never ran before."""
        if self._image is None:
            self.waiting.emit(tr("Preparing the drawing kernels, once on this computer …"))

    def _device_size(self) -> tuple[int, int]:
        """Pixels of the screen under this widget."""
        ratio = self.devicePixelRatioF()
        return max(1, round(self.width() * ratio)), max(1, round(self.height() * ratio))


class Drawer:
    """The thread: one request waits at most. Knows no widget."""

    def __init__(self, finished: Callable[..., None], failed: Callable[..., None]) -> None:
        self._finished, self._failed = finished, failed
        self._painter, self._feeder, self._detail = CpuPainter(), Feeder(), Detail()
        self._busy = threading.Lock()  # the painter
        self._wake = threading.Condition()
        self._waiting: tuple[FrameRequest, tuple[int, int]] | None = None
        self._stopped = False
        self._thread: threading.Thread | None = None
        self._full_ms: float | None = None
        self.limit_ms = MOVING_MS
        self._was_moving = False
        self._warm = False  # the first frame may include compiling the kernels
        self._bounds: tuple[object, tuple[float, float]] = (None, (0.0, 1.0))

    def ask(self, request: FrameRequest, size: tuple[int, int]) -> None:
        """Draw for a window of `size` device pixels."""
        with self._wake:
            self._waiting = (request, size)
            self._wake.notify()
        self.begin()

    def begin(self) -> None:
        """Start the thread unless it runs: it was not begun, was stopped, or died of a fault."""
        with self._wake:
            self._stopped = False
            if self._thread is None or not self._thread.is_alive():
                self._thread = threading.Thread(target=self._work, name="splat-painter", daemon=True)
                self._thread.start()

    def image(self, request: FrameRequest, view: View) -> np.ndarray:  # (H, W, 4) uint8
        """A picture at once, on the calling thread. Raises GenmojoError where it would not fit into memory."""
        if view.width * view.height > LARGEST_PIXELS:
            raise GenmojoError("budget", f"a picture of {view.width} x {view.height} pixels is more than the processor "
                               "draws", "3D view", "choose a smaller size")  # fmt: skip
        with self._busy:
            self._feeder.feed(self._painter, request)
            sums = self._painter.picture(view, request.look, request.t).sums
        bounds = request.look.value_range or value_bounds(sums, request.look.mode)
        backdrop = request.look.backdrop
        if backdrop is None:
            return straight_rgba(sums, request.look.mode, bounds, object_colors(request))
        rgb = colour(sums, request.look.mode, backdrop, bounds, object_colors(request))
        return np.dstack([rgb, np.full(rgb.shape[:2], 255, np.uint8)])

    def stop(self) -> None:
        """End the thread."""
        with self._wake:
            self._stopped = True
            self._wake.notify()
        if self._thread is not None and self._thread is not threading.current_thread():
            self._thread.join(timeout=10)
            self._thread = None

    def _work(self) -> None:
        """Until stopped: draw what waits. The first picture, which may compile kernels, waits for nobody."""
        with contextlib.suppress(GenmojoError, ImportError, MemoryError, RuntimeError):  # the first picture tells why
            warm_up()
        while True:
            with self._wake:
                while self._waiting is None and not self._stopped:
                    self._wake.wait()
                if self._stopped or self._waiting is None:
                    return
                (request, size), self._waiting = self._waiting, None
            try:
                pixels, report = self._draw(request, size)
            except (GenmojoError, ImportError, MemoryError, RuntimeError) as error:
                self._tell(self._failed, str(error).splitlines()[0] or type(error).__name__)
                continue
            give_way()
            self._tell(self._finished, pixels, report)

    def _tell(self, emit: Callable[..., None], *values: object) -> None:
        """Emit a signal unless its widget is gone."""
        if not self._stopped:
            emit(*values)

    def _draw(self, request: FrameRequest, size: tuple[int, int]) -> tuple[np.ndarray, FrameReport]:
        """One picture: (H, W, 3) uint8 and its report."""
        start = time.perf_counter()
        quality = FULL
        if request.moving:
            if not self._was_moving or self._detail.limit_ms != self.limit_ms:
                self._detail.limit_ms = self.limit_ms
                self._detail.begin(self._full_ms)
            quality = self._detail.quality
        self._was_moving = request.moving
        look = request.look
        with self._busy:
            self._feeder.feed(self._painter, request)
            sums = self._painter.picture(request.view(*size), look, request.t, quality).sums
        bounds = self._scale(request, sums)
        pixels = colour(sums, look.mode, look.backdrop or (0.0, 0.0, 0.0), bounds, object_colors(request))
        ms = (time.perf_counter() - start) * 1e3
        if request.moving:
            self._detail.took(ms)
        elif self._warm:
            self._full_ms = ms
        self._warm = True
        return pixels, FrameReport(request, ms, quality, bounds)

    def _scale(self, request: FrameRequest, sums: np.ndarray) -> tuple[float, float]:
        """The colour scale: the look's, or the picture's own, measured at rest and kept while moving."""
        look = request.look
        if look.value_range is not None:
            return look.value_range
        if look.mode not in SCALAR_MODES or look.mode == Mode.OPACITY:
            return 0.0, 1.0
        if self._bounds[0] != look.mode or not request.moving:
            self._bounds = (look.mode, value_bounds(sums, look.mode))
        return self._bounds[1]


def object_colors(request: FrameRequest) -> np.ndarray:  # (K, 3)
    """Colours of the objects in the order of `object_ids`."""
    snapshot = request.snapshot
    return np.array([snapshot.object_of(int(i)).color for i in snapshot.object_ids], np.float32).reshape(-1, 3)
