"""One frame of a view: what is asked of a surface, and what it reports when it is on the screen."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from genmojo_core.clip.cameras import View
from genmojo_studio.view3d.look import Look, Mode
from genmojo_studio.view3d.orbit import Orbit, Reference
from genmojo_studio.view3d.quality import Picture, Quality
from genmojo_studio.view3d.residuals import residuals
from genmojo_studio.view3d.snapshot import SceneSnapshot

_SQUARE = 0.02  # focal lengths this close belong to square pixels


@dataclass(frozen=True, eq=False)
class FrameRequest:
    """What to draw: a snapshot at time t from an orbit about a reference, in a look.

    `moving` allows less detail. `input_image` (H, W, 3) uint8 is the clip's frame for Mode.RESIDUAL.
    """

    snapshot: SceneSnapshot
    reference: Reference
    orbit: Orbit
    look: Look
    t: float
    moving: bool = False
    input_image: np.ndarray | None = None

    def view(self, width: int, height: int) -> View:
        """The camera for a window of that many pixels, the clip's picture fitted in and shown with square pixels."""
        source = self.reference.view
        aspect = source.fy / source.fx
        return self.reference.view_of(
            self.orbit, max(width, 1), max(height, 1), aspect if abs(aspect - 1) > _SQUARE else 1.0
        )


@dataclass(frozen=True)
class FrameReport:
    """A frame that is on the screen: its request, milliseconds, detail, colour scale, whether its order is exact."""

    request: FrameRequest
    ms: float
    quality: Quality
    bounds: tuple[float, float]
    order_is_exact: bool = True


class Engine(Protocol):
    """What `SplatRenderer` and `CpuPainter` have in common."""

    def upload(self, snapshot: SceneSnapshot) -> None:
        """Take a snapshot."""
        ...

    def set_residuals(self, values: np.ndarray) -> None:
        """One number per splat."""
        ...

    def picture(self, view: View, look: Look, t: float | None = None) -> Picture:
        """The sums of a view."""
        ...


class Feeder:
    """Brings an engine up to a request: uploads what is new, works out errors where they are shown."""

    def __init__(self) -> None:
        self._snapshot: SceneSnapshot | None = None
        self._errors_of: tuple[object, ...] = ()

    def feed(self, engine: Engine, request: FrameRequest) -> None:
        """Upload the request's snapshot unless it is there; likewise the errors in Mode.RESIDUAL."""
        if request.snapshot is not self._snapshot:
            engine.upload(request.snapshot)
            self._snapshot, self._errors_of = request.snapshot, ()
        if request.look.mode != Mode.RESIDUAL or request.input_image is None:
            return
        picture = request.input_image
        key = (int(request.t), picture.shape, int(picture[::16, ::16].sum()))
        if key != self._errors_of:
            moment = request.snapshot.at(int(request.t))
            engine.set_residuals(
                residuals(moment, picture, lambda view, look: engine.picture(view, look, int(request.t)))
            )
            self._errors_of = key
