"""A picture of a snapshot in any look, drawn by the processor; safe on any thread."""

from __future__ import annotations

import numpy as np

from genmojo_core.clip.cameras import View
from genmojo_studio.view3d.colouring import colour, value_bounds
from genmojo_studio.view3d.cpu_painter import CpuPainter
from genmojo_studio.view3d.look import Look
from genmojo_studio.view3d.snapshot import SceneSnapshot


def paint(snapshot: SceneSnapshot, view: View, look: Look, t: float) -> np.ndarray:  # (H, W, 3) uint8
    """The snapshot at time t from a camera, as the screen shows it; black where a look has no backdrop."""
    painter = CpuPainter()
    painter.upload(snapshot)
    sums = painter.picture(view, look, t).sums
    bounds = look.value_range or value_bounds(sums, look.mode)
    colors = np.array([snapshot.object_of(int(i)).color for i in snapshot.object_ids], np.float32).reshape(-1, 3)
    return colour(sums, look.mode, look.backdrop or (0.0, 0.0, 0.0), bounds, colors)
