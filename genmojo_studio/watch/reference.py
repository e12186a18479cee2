"""The scene drawn at the input camera on the clip's own pixel grid, by the optimiser's rasteriser, on a thread."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from PySide6.QtCore import QObject, Signal

from genmojo_core.clip.cameras import View
from genmojo_studio.background import Tasks
from genmojo_studio.view3d.snapshot import SceneSnapshot


class Reference(QObject):
    """Draws the newest request; what is asked for meanwhile replaces what waits. Emits `drawn(pixels, frame)`."""

    drawn = Signal(object, int)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._tasks = Tasks(self)
        self._waiting: Callable[[], tuple[np.ndarray, int]] | None = None

    def request(self, snapshot: SceneSnapshot, frame: int, size: tuple[int, int]) -> None:
        """Draws frame `frame` at `size` (width, height); nothing happens for a scene without cameras."""
        if snapshot.cameras is None or frame >= len(snapshot.cameras):
            return
        self._waiting = lambda: (draw(snapshot, frame, size), frame)
        self._next()

    def close(self) -> None:
        """No more results."""
        self._waiting = None
        self._tasks.close()

    def _next(self) -> None:
        if self._waiting is not None and not self._tasks.busy:
            work, self._waiting = self._waiting, None
            self._tasks.run(work, self._done, self._failed)

    def _done(self, result: tuple[np.ndarray, int]) -> None:
        self.drawn.emit(*result)
        self._next()

    def _failed(self, error: BaseException) -> None:
        """A fault of ours: it goes where all such faults go."""
        raise error


def draw(snapshot: SceneSnapshot, frame: int, size: tuple[int, int]) -> np.ndarray:  # (H, W, 3) uint8
    """A snapshot at a frame from the clip's own camera, black behind, as the optimiser sees it."""
    from genmojo_core.render.cpu.rasterize import rasterize
    from genmojo_core.render.rasterizer import Splats

    if snapshot.cameras is None:
        return np.zeros((size[1], size[0], 3), np.uint8)
    view: View = snapshot.cameras.view(frame).resized(*size)
    shown = snapshot.at(frame)
    splats = Splats(shown.positions, shown.rotations, shown.scales, shown.opacities, shown.colours)
    return np.round(np.clip(rasterize(splats, view).features, 0, 1) * 255).astype(np.uint8)
