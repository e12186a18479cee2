"""How far the scene is from the input, Gaussian by Gaussian: the error of the input view carried into every view."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from genmojo_core.clip.cameras import View
from genmojo_studio.view3d.look import Look, Mode
from genmojo_studio.view3d.quality import Picture
from genmojo_studio.view3d.snapshot import SceneSnapshot

_SHORT_SIDE = 270  # pixels of the picture that is compared
_BEHIND = 0.03  # a splat this share of its depth behind what is seen is hidden


def residuals(
    snapshot: SceneSnapshot,
    image: np.ndarray,  # (H, W, 3) uint8 input frame
    draw: Callable[[View, Look], Picture],
) -> np.ndarray:  # (N,) float32
    """Mean absolute error (0..1) of the input view around every Gaussian's centre; 0 where it is not seen there.

    `draw` gives pictures of the snapshot at its frame. Without cameras everything is 0.
    """
    import cv2  # see colouring.palette_rgb

    errors = np.zeros(len(snapshot), np.float32)
    if snapshot.cameras is None or not len(snapshot):
        return errors
    source = snapshot.cameras.view(snapshot.frame)
    scale = min(1.0, _SHORT_SIDE / min(source.width, source.height))
    view = source.resized(max(1, round(source.width * scale)), max(1, round(source.height * scale)))
    sums = draw(view, Look()).sums
    wanted = cv2.resize(image, (view.width, view.height), interpolation=cv2.INTER_AREA).astype(np.float32) / 255
    error = cv2.blur(np.abs(np.clip(sums[..., :3], 0, 1) - wanted).mean(axis=2), (3, 3))
    depth = _depth(draw, view)
    camera = snapshot.positions @ view.world_to_camera[:3, :3].T.astype(np.float32) + view.world_to_camera[:3, 3]
    z = np.maximum(camera[:, 2], 1e-6)
    with np.errstate(invalid="ignore", over="ignore"):
        x = np.nan_to_num(view.fx * camera[:, 0] / z + view.cx, nan=-1.0)
        y = np.nan_to_num(view.fy * camera[:, 1] / z + view.cy, nan=-1.0)
    inside = (camera[:, 2] > view.near) & (x >= 0) & (x < view.width) & (y >= 0) & (y < view.height)
    column, row = x[inside].astype(int), y[inside].astype(int)
    seen = camera[inside, 2] <= depth[row, column] * (1 + _BEHIND) + snapshot.scales[inside].max(axis=1)
    errors[inside] = np.where(seen, error[row, column], 0.0)
    return errors


def _depth(draw: Callable[[View, Look], Picture], view: View) -> np.ndarray:  # (H, W)
    """Expected depth where something is, infinity elsewhere."""
    sums = draw(view, Look(mode=Mode.DEPTH)).sums
    return np.where(sums[..., 3] > 0.05, sums[..., 0] / np.maximum(sums[..., 3], 1e-4), np.inf)
