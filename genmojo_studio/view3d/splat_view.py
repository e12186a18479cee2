"""The surface that OpenGL draws on. Rules that were reproduced (VIEWER.md section 3), all kept here:

every `initializeGL` makes a moderngl context for this widget and rebuilds everything; the framebuffer is asked for in
every `paintGL`; sizes are those of the framebuffer; GL is called between makeCurrent and doneCurrent only; a context
that dies frees its objects first; nothing is drawn that nobody asked for. Overlays lie in a widget above.
"""

from __future__ import annotations

import time
from typing import Any

import moderngl
import numpy as np
from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QCloseEvent, QShowEvent
from PySide6.QtOpenGLWidgets import QOpenGLWidget
from PySide6.QtWidgets import QWidget

from genmojo_core.clip.cameras import View
from genmojo_core.errors import GenmojoError
from genmojo_studio.view3d.frames import Feeder, FrameReport, FrameRequest
from genmojo_studio.view3d.look import BLACK, SCALAR_MODES
from genmojo_studio.view3d.quality import FULL, MOVING_MS, SMOOTH_MS, Detail, Quality
from genmojo_studio.view3d.renderer import SplatRenderer

_PATIENCE_MS = 1500  # a context is there by then, or never
_PREFETCH_MS = 30  # pause between two frames brought to the GPU while nothing moves


class SplatView(QOpenGLWidget):
    """Draws the newest request. `drawn(FrameReport)` after every frame; `failed(str)` once if OpenGL is no use."""

    drawn = Signal(object)
    failed = Signal(str)
    _order_ready = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.renderer: SplatRenderer | None = None
        self.backdrop = BLACK  # where there is no scene
        self._ctx: Any = None
        self._is_useless = False
        self._request: FrameRequest | None = None
        self._feeder = Feeder()
        self._detail = Detail()
        self._was_moving = False
        self._full_ms: float | None = None
        self._bounds: tuple[object, tuple[float, float]] = (None, (0.0, 1.0))
        self._prefetch = QTimer(self, interval=_PREFETCH_MS, singleShot=True)
        self._prefetch.timeout.connect(self._bring_frame)
        self._order_ready.connect(self.update, Qt.ConnectionType.QueuedConnection)

    def show_frame(self, request: FrameRequest) -> None:
        """Draw this soon, or as soon as the window is no longer minimised; older requests are forgotten."""
        self._request = request
        if not self.window().isMinimized():
            self.update()

    def clear(self) -> None:
        """There is no scene any more."""
        self._request = None
        self.update()

    def image(self, request: FrameRequest, view: View) -> np.ndarray:  # (H, W, 4) uint8
        """A picture of any size off screen, at full detail. Raises GenmojoError where OpenGL failed."""
        if self.renderer is None:
            raise GenmojoError("missing_package", "OpenGL is not ready", "3D view", "show the view first")
        self.makeCurrent()
        try:
            self._feeder.feed(self.renderer, request)
            return self.renderer.image(view, request.look, request.t)
        finally:
            self.doneCurrent()

    def initializeGL(self) -> None:  # noqa: N802 - Qt's name
        """A context is there, the first one or another one: build everything."""
        context = self.context()
        if context is None:
            return
        context.aboutToBeDestroyed.connect(self.drop_gl, Qt.ConnectionType.DirectConnection)
        self._build()

    def _build(self) -> None:
        """A renderer in the current context; where that fails, say so once."""
        try:
            moderngl.init_context()  # create_context() crashes in a second view on EGL
            self._ctx = moderngl.get_context()
            self.renderer = SplatRenderer(self._ctx, self._order_ready.emit)
            self._detail = Detail(MOVING_MS if self.renderer.is_software else SMOOTH_MS)
        except (GenmojoError, moderngl.Error, KeyError, ValueError, OSError) as error:
            self._ctx, self.renderer, self._is_useless = None, None, True
            self.failed.emit(str(error).splitlines()[0])
        self._feeder = Feeder()

    def paintGL(self) -> None:  # noqa: N802 - Qt's name
        """Draw the newest request into the framebuffer Qt has now."""
        if self.renderer is None and not self._is_useless:
            self._build()  # closed, and shown again
        if self.renderer is None or self._ctx is None:
            return
        target = self._ctx.detect_framebuffer(self.defaultFramebufferObject())
        request = self._request
        if request is None:
            target.clear(*self.backdrop, 1.0)
            return
        try:
            report = self._draw(self.renderer, request, target)
        except (GenmojoError, moderngl.Error, MemoryError) as error:
            self._request = None
            self.failed.emit(str(error).splitlines()[0] if str(error) else type(error).__name__)
            return
        if request.moving:
            self._detail.took(report.ms)
        else:
            self._full_ms = report.ms
            self._prefetch.start()
        self.drawn.emit(report)

    def showEvent(self, event: QShowEvent) -> None:  # noqa: N802 - Qt's name
        """Where Qt cannot make a context it says nothing: look whether there is one."""
        super().showEvent(event)
        QTimer.singleShot(_PATIENCE_MS, self, self._check_context)

    def drop_gl(self) -> None:
        """Free everything on the GPU; drawing again builds it anew."""
        if self.renderer is None:
            return
        self._prefetch.stop()
        self.makeCurrent()
        self.renderer.release()
        self.renderer, self._ctx = None, None
        self.doneCurrent()

    def closeEvent(self, event: QCloseEvent) -> None:  # noqa: N802 - Qt's name
        """The window goes: so does what is on the GPU."""
        self.drop_gl()
        super().closeEvent(event)

    def _draw(self, renderer: SplatRenderer, request: FrameRequest, target: Any) -> FrameReport:
        """Draw a request into a framebuffer."""
        start = time.perf_counter()
        quality = self._quality(request)
        self._feeder.feed(renderer, request)
        renderer.draw(request.view(*target.size), request.look, request.t, quality)
        bounds = self._scale(renderer, request)
        renderer.resolve(target, request.look, bounds)
        renderer.ctx.finish()  # else the time would be somebody else's
        ms = (time.perf_counter() - start) * 1e3
        return FrameReport(request, ms, quality, bounds, renderer.order_is_exact)

    def _check_context(self) -> None:
        """Tell the owner that there is no OpenGL."""
        if self.isVisible() and (self.context() is None or not self.isValid()):
            self.failed.emit("no context")

    def _quality(self, request: FrameRequest) -> Quality:
        """Full at rest; what can be afforded while something moves."""
        if not request.moving:
            self._was_moving = False
            return FULL
        if not self._was_moving:
            self._detail.begin(self._full_ms)
            self._was_moving = True
        return self._detail.quality

    def _scale(self, renderer: SplatRenderer, request: FrameRequest) -> tuple[float, float]:
        """The colour scale: the look's, or the picture's own, measured at rest and kept while moving."""
        look = request.look
        if look.value_range is not None:
            return look.value_range
        if look.mode not in SCALAR_MODES:
            return 0.0, 1.0
        if self._bounds[0] != look.mode or not request.moving:
            self._bounds = (look.mode, renderer.measure(look))
        return self._bounds[1]

    def _bring_frame(self) -> None:
        """While nothing moves, bring the clip's other frames to the GPU one by one."""
        if self.renderer is None or self._request is None or self._request.moving or not self.isVisible():
            return
        self.makeCurrent()
        more = self.renderer.prefetch()
        self.doneCurrent()
        if more:
            self._prefetch.start()
