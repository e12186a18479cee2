"""The 3D view as other parts of the app use it: a scene, a time, a look, a place to look from.

`SceneView` holds a surface (OpenGL, or the processor where that is missing or itself a program) and an overlay, turns
the mouse into orbits, and draws on demand only.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import replace

import numpy as np
from PySide6.QtCore import QEasingCurve, QEvent, QPointF, Qt, QTimer, QVariantAnimation, Signal
from PySide6.QtGui import QCloseEvent, QMouseEvent, QResizeEvent, QWheelEvent
from PySide6.QtWidgets import QWidget

from genmojo_core.clip.cameras import View
from genmojo_core.errors import GenmojoError
from genmojo_studio.translate import tr
from genmojo_studio.view3d import navigation
from genmojo_studio.view3d.cpu_view import CpuView
from genmojo_studio.view3d.frames import FrameReport, FrameRequest
from genmojo_studio.view3d.gl_probe import GlKind, probe, told
from genmojo_studio.view3d.look import BLACK, Look, Mode
from genmojo_studio.view3d.orbit import PRESETS, Orbit, Reference, between, reference_of
from genmojo_studio.view3d.overlay import Overlay, Paint
from genmojo_studio.view3d.picking import Pick, pick
from genmojo_studio.view3d.quality import MOVING_MS
from genmojo_studio.view3d.snapshot import SceneSnapshot
from genmojo_studio.view3d.splat_view import SplatView

REST_MS = 180  # after the last movement for so long, full detail is drawn
TURN_MS = 350  # an animated change of view
_CLICK_PIXELS = 4
_PACED_SHARE = 0.5  # of the time between two paced frames, drawing takes no more
SOFT_BANNER_MS = 8000  # news that changes nothing goes away by itself
HINT_MS = 12000  # so does the hint at how to move about, or with the first press


class SceneView(QWidget):
    """Shows a `SceneSnapshot`.

    Signals: `picked(Pick)` after a click; `view_changed(Orbit)` whenever the place to look from changes;
    `frame_drawn(FrameReport)` after every frame; `engine_changed(str)` with the sentence of the banner, "" for none.

    Args:
        engine: "auto" (OpenGL where it is a device, else the processor), "gl" or "cpu".
    """

    picked = Signal(object)
    view_changed = Signal(object)
    frame_drawn = Signal(object)
    engine_changed = Signal(str)

    def __init__(self, parent: QWidget | None = None, engine: str = "auto") -> None:
        super().__init__(parent)
        self.setMinimumSize(160, 120)
        self.setMouseTracking(False)
        self._snapshot: SceneSnapshot | None = None
        self._look = Look()
        self._orbit = Orbit()
        self._time = 0.0
        self._held: float | None = None
        self._has_hinted = False
        self._input: Callable[[int], np.ndarray | None] | None = None
        self._press: tuple[QPointF, QPointF] | None = None  # where it began, where the mouse was last
        self._rest = QTimer(self, interval=REST_MS, singleShot=True)
        self._rest.timeout.connect(self._redraw)
        self._turn = QVariantAnimation(self, duration=TURN_MS, startValue=0.0, endValue=1.0)
        self._turn.setEasingCurve(QEasingCurve.Type.Linear)  # `between` eases
        self._turn.valueChanged.connect(self._turned)
        self._turn.finished.connect(self._settle)
        self._way: tuple[Orbit, Orbit] = (Orbit(), Orbit())
        self._pace = 0.0
        self._drawn_at = 0.0
        self._changed_at = -math.inf
        self._later = QTimer(self, singleShot=True, timerType=Qt.TimerType.PreciseTimer)
        self._later.timeout.connect(self._redraw)
        self.surface: SplatView | CpuView
        self.overlay = Overlay(self)
        self._choose(engine)

    # ---- what is shown ------------------------------------------------------------------------------------------

    @property
    def snapshot(self) -> SceneSnapshot | None:
        """The scene on show."""
        return self._snapshot

    def set_snapshot(self, snapshot: SceneSnapshot | None) -> None:
        """Show a scene; older versions of the same source are the caller's to drop."""
        if snapshot is self._snapshot:
            return
        self._snapshot = snapshot
        if snapshot is None:
            self.surface.clear()
            self.overlay.report = None
            self.overlay.update()
        self._redraw()

    @property
    def time(self) -> float:
        """The time on show, frames: a snapshot that knows one frame only shows that."""
        if self._snapshot is not None and self._snapshot.frames is None:
            return float(self._snapshot.frame)
        return self._time

    def set_time(self, t: float, *, playing: bool = False) -> None:
        """Show time t (0..T-1, between frames interpolated); `playing` allows less detail until it stops."""
        if t == self._time:
            return
        self._time = float(t)
        self._move() if playing else self._redraw()

    @property
    def look(self) -> Look:
        """How the scene is shown."""
        return self._look

    def set_look(self, look: Look) -> None:
        """Show the scene another way."""
        if look != self._look:
            self._look = look
            self.surface.backdrop = look.backdrop or BLACK
            self.surface.update()  # also without a scene
            self._change()

    def set_input(self, frame: Callable[[int], np.ndarray | None] | None) -> None:
        """Where Mode.RESIDUAL gets the clip's frame t (H, W, 3) uint8 from."""
        self._input = frame
        if self._look.mode == Mode.RESIDUAL:
            self._redraw()

    def set_pace(self, seconds: float) -> None:
        """While something moves, frames lie so far apart at least; 0: as fast as they can be drawn."""
        self._pace = seconds
        if isinstance(self.surface, CpuView):
            self.surface.set_limit(1e3 * seconds * _PACED_SHARE if seconds else MOVING_MS)

    def add_overlay(self, paint: Paint) -> None:
        """Let `paint(painter, view, t)` draw over every frame; `view` is the camera in logical pixels."""
        self.overlay.paints.append(paint)
        self.overlay.update()

    def set_message(self, text: str) -> None:
        """A banner at the lower edge, "" for none."""
        self.overlay.message = text
        self.overlay.update()
        self.engine_changed.emit(text)

    # ---- where from ---------------------------------------------------------------------------------------------

    @property
    def orbit(self) -> Orbit:
        """The place to look from."""
        return self._orbit

    def set_orbit(self, orbit: Orbit, *, animate: bool = False) -> None:
        """Look from elsewhere, at once or in a short turn."""
        self._turn.stop()
        if animate and self._snapshot is not None:
            self._way = (self._orbit, orbit)
            self._turn.start()
        elif orbit != self._orbit:
            self._orbit = orbit
            self._change()
            self.view_changed.emit(orbit)

    def preset(self, name: str) -> None:
        """Turn to a preset of `orbit.PRESETS`, keeping distance and lens; "input" resets those too."""
        angles = PRESETS[name]
        turned = replace(self._orbit, elevation=angles.elevation, azimuth=angles.azimuth, roll=0.0)
        self.set_orbit(Orbit() if name == "input" else turned, animate=True)

    def hold_camera(self, t: float | None) -> None:
        """Look relative to the input camera of a fixed time; None: of the time on show (the view follows it)."""
        self._held = t
        self._redraw()

    def reference(self) -> Reference:
        """What the orbit is relative to: input camera, target, up. Raises GenmojoError("empty") without a scene."""
        return reference_of(self._scene(), self.time if self._held is None else self._held)

    def view(self) -> View:
        """The camera now, in logical pixels of this widget."""
        return self.frame_request().view(self.width(), self.height())

    # ---- questions ----------------------------------------------------------------------------------------------

    def frame_request(self) -> FrameRequest:
        """What is on show at full detail, for others to draw the same. Raises GenmojoError("empty") without a scene."""
        return self._request(moving=False)

    def pick(self, x: float, y: float) -> Pick:
        """What lies under logical pixel (x, y)."""
        request = self.frame_request()
        moment = request.snapshot.at(round(request.t))
        ratio = self.devicePixelRatioF()
        view = request.view(round(self.width() * ratio), round(self.height() * ratio))
        return pick(moment, view, request.look, x * ratio, y * ratio)

    def screenshot(
        self, width: int, height: int, look: Look | None = None, orbit: Orbit | None = None, t: float | None = None
    ) -> np.ndarray:  # (H, W, 4) uint8
        """A picture of any size, mode, view and time, at full detail, without overlays.

        Straight alpha where the look's backdrop is None. Raises GenmojoError without a scene or where it is too large.
        """
        request = self.frame_request()
        if t is not None and self._snapshot is not None:
            held = t if self._held is None else self._held
            request = replace(request, t=t, reference=reference_of(self._snapshot, held))
        request = replace(request, look=look or request.look, orbit=orbit or request.orbit)
        return self.surface.image(request, request.view(width, height))

    # ---- Qt -----------------------------------------------------------------------------------------------------

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802 - Qt's name
        """Surface and overlay fill the widget."""
        self.surface.setGeometry(self.rect())
        self.overlay.setGeometry(self.rect())

    def mousePressEvent(self, event: QMouseEvent) -> None:  # noqa: N802 - Qt's name
        """Begin a drag, or press an axis of the gizmo."""
        preset = self.overlay.axis_at(event.position())
        if preset and event.button() == Qt.MouseButton.LeftButton:
            self.preset(preset)
            return
        self._turn.stop()
        self._hint("")
        self._press = (event.position(), event.position())

    def mouseMoveEvent(self, event: QMouseEvent) -> None:  # noqa: N802 - Qt's name
        """Left turns, middle (or Shift) moves, right changes the distance."""
        if self._press is None or self._snapshot is None:
            return
        start, last = self._press
        if start == last and (event.position() - start).manhattanLength() < _CLICK_PIXELS:
            return
        moved = event.position() - last
        self._press = (start, event.position())
        orbit = navigation.dragged(self._orbit, self.reference(), self.view(), (moved.x(), moved.y()),
                                   navigation.action(event.buttons(), event.modifiers()))  # fmt: skip
        self._go(orbit)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:  # noqa: N802 - Qt's name
        """A press without a movement asks what is there."""
        if self._press is None:
            return
        start, last = self._press
        self._press = None
        if start == last and event.button() == Qt.MouseButton.LeftButton and self._snapshot is not None:
            self.picked.emit(self.pick(start.x(), start.y()))
        elif start != last:
            self._settle()

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:  # noqa: N802 - Qt's name
        """Back to the input view."""
        if self.overlay.axis_at(event.position()) is None:
            self.preset("input")

    def wheelEvent(self, event: QWheelEvent) -> None:  # noqa: N802 - Qt's name
        """Nearer and farther; with Ctrl the lens."""
        if self._snapshot is None:
            return
        steps = event.angleDelta().y() / 120
        lens = bool(event.modifiers() & Qt.KeyboardModifier.ControlModifier)
        self._turn.stop()
        self._go(navigation.wheeled(self._orbit, self.reference(), steps, lens=lens))
        event.accept()

    def closeEvent(self, event: QCloseEvent) -> None:  # noqa: N802 - Qt's name
        """Free what the surface holds."""
        for clock in (self._turn, self._rest, self._later):
            clock.stop()
        self.surface.drop_gl()
        super().closeEvent(event)

    def event(self, event: QEvent) -> bool:
        """A view that becomes visible or changes screens draws anew."""
        if event.type() in (QEvent.Type.Show, QEvent.Type.DevicePixelRatioChange):
            self._redraw()
        return super().event(event)

    # ---- pieces -------------------------------------------------------------------------------------------------

    def _choose(self, engine: str) -> None:
        """Make the surface."""
        kind = {"gl": GlKind.DEVICE, "cpu": GlKind.SOFTWARE}.get(engine) or probe()
        self._use(SplatView(self) if kind == GlKind.DEVICE else CpuView(self))
        if engine == "auto":
            self.overlay.message = told(kind)
            if kind == GlKind.SOFTWARE:
                QTimer.singleShot(SOFT_BANNER_MS, self, lambda: self.set_message(""))

    def _use(self, surface: SplatView | CpuView) -> None:
        """Put a surface under the overlay."""
        self.surface = surface
        surface.backdrop = self._look.backdrop or BLACK
        surface.setGeometry(self.rect())
        surface.drawn.connect(self._drawn)
        if isinstance(surface, CpuView):
            surface.waiting.connect(self._waits)
        surface.failed.connect(self._failed, Qt.ConnectionType.QueuedConnection)  # never within a paint event
        surface.show()
        self.overlay.raise_()

    def _failed(self, reason: str) -> None:
        """OpenGL did not work: the processor draws. Nothing left to fall back to: say why."""
        if isinstance(self.surface, SplatView):
            old = self.surface
            old.hide()
            self._use(CpuView(self))
            old.drop_gl()
            old.deleteLater()
            self.set_message(f"{told(GlKind.MISSING)} ({reason})")
            self._redraw()
        else:
            self.set_message(tr("The view cannot be drawn: {reason}").format(reason=reason))

    def _drawn(self, report: FrameReport) -> None:
        """A frame is on the screen."""
        if self._snapshot is not None:
            if self.overlay.report is None and not self._has_hinted:
                self._has_hinted = True
                self._hint(tr("Drag to turn, Shift+drag to move, wheel to go nearer; click to ask what is there"))
                QTimer.singleShot(HINT_MS, self, lambda: self._hint(""))
            self.overlay.report = report
            self.overlay.update()
            self.frame_drawn.emit(report)

    def _waits(self, text: str) -> None:
        """The first picture takes long, or is there: what the banner said before comes back."""
        self.overlay.waiting = text
        self.overlay.update()

    def _hint(self, text: str) -> None:
        """Show or clear how to move about."""
        self.overlay.hint = text
        self.overlay.update()

    def _turned(self, share: float) -> None:
        """One step of an animated turn."""
        if self._snapshot is not None:
            self._go(between(*self._way, share, self.reference()))

    def _go(self, orbit: Orbit) -> None:
        """Look from elsewhere while something moves."""
        if orbit != self._orbit:
            self._orbit = orbit
            self._move()
            self.view_changed.emit(orbit)

    def _move(self) -> None:
        """Draw soon with the detail that can be afforded, and fully once nothing moves."""
        self._rest.start()
        self._redraw()

    def _change(self) -> None:
        """One change alone is drawn in full at once; changes that follow each other, as from a slider, are a movement.

        Else a click that shows one object would first show it from a few swollen splats.
        """
        now = time.monotonic()
        follows = self._rest.isActive() or now - self._changed_at < 1e-3 * REST_MS
        self._changed_at = now
        self._move() if follows else self._redraw()

    def _settle(self) -> None:
        """A movement has ended: full detail need not wait."""
        if self._rest.isActive():
            self._rest.stop()
            self._redraw()

    def _redraw(self) -> None:
        """Ask the surface for a frame, if there is a scene and somebody can see it; not sooner than the pace allows."""
        if self._snapshot is not None and self.isVisible():
            now = time.monotonic()
            wait = self._drawn_at + self._pace - now
            if self._rest.isActive() and wait > 0:
                if not self._later.isActive():
                    self._later.start(math.ceil(1e3 * wait))
                return
            self._later.stop()
            self._drawn_at = now
            self.surface.show_frame(self._request(moving=self._rest.isActive()))

    def _request(self, *, moving: bool) -> FrameRequest:
        """Everything about the frame now."""
        snapshot = self._scene().canonical if self._look.canonical else self._scene()
        picture = self._input(int(self.time)) if self._input and self._look.mode == Mode.RESIDUAL else None
        return FrameRequest(snapshot, self.reference(), self._orbit, self._look, self.time, moving, picture)

    def _scene(self) -> SceneSnapshot:
        """The scene on show, or GenmojoError("empty")."""
        if self._snapshot is None:
            raise GenmojoError("empty", "there is no scene", "3D view", "open a scene or start a run")
        return self._snapshot
