"""The scene drawn at the input camera on the clip's own pixel grid, by the optimiser's rasteriser."""

from __future__ import annotations

import numpy as np

from genmojo_studio.view3d.snapshot import SceneSnapshot


def draw(snapshot: SceneSnapshot, frame: int, size: tuple[int, int]) -> np.ndarray | None:  # (H, W, 3) uint8
    """A snapshot at a frame from the clip's own camera, black behind, as the optimiser sees it.

    None where the snapshot has no camera for the frame, or does not know the scene at that frame. `size` is
    (width, height) in pixels. Takes tens of milliseconds: call it on a thread.
    """
    # Imported here: it loads the compiled kernels.
    from genmojo_core.render.cpu.rasterize import rasterize
    from genmojo_core.render.rasterizer import Splats

    shown = snapshot.at(frame)
    if snapshot.cameras is None or frame >= len(snapshot.cameras) or shown.frame != frame:
        return None
    view = snapshot.cameras.view(frame).resized(*size)
    splats = Splats(shown.positions, shown.rotations, shown.scales, shown.opacities, shown.colours)
    return np.round(np.clip(rasterize(splats, view).features, 0, 1) * 255).astype(np.uint8)
