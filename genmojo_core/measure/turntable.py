"""How a scene holds up when looked at from around: whether it flickers, has holes, or is flat. Needs no truth."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np

from genmojo_core.config import MEASURED_SIDE
from genmojo_core.errors import GenmojoError
from genmojo_core.measure.views import Look, Picture, orbit_target, orbit_view, render_frame, short_side_size
from genmojo_core.store.scene_file import BakedScene

AZIMUTHS = (0.0, 30.0, -30.0, 90.0, -90.0, 180.0)  # degrees
SOLID = 0.9  # coverage from which a pixel's colour is compared
COVERED = 0.5  # coverage below which a pixel inside an outline is a hole
SHOWS = 0.5  # opacity from which a Gaussian counts as a part of the body


def turntable_figures(
    scene: BakedScene, azimuths: tuple[float, ...] = AZIMUTHS, progress: Callable[[float], None] | None = None
) -> dict[str, Any]:
    """Views at elevation 0 of every frame, the objects alone.

    Returns {"turntable": {"<azimuth>": {"flicker", "holes"}}, "thickness": {object name: share}}. flicker is the mean
    change of colour from a frame to the next, in levels of 255, along the scene's own motion where the same object
    shows in both: what motion explains is none. holes is the percentage of what the outlines enclose that is not
    covered. thickness is the smallest extent of an object's body over the middle one, in the canonical frame; a flat
    card has next to none. A view in which no object shows twice in a row has no flicker (nan).

    Raises GenmojoError("empty") for a file without Gaussians.
    """
    if len(scene.xyz) == 0:
        raise GenmojoError("empty", "holds tracks but no Gaussians", "scene", "give a scene written by optimize")
    target = orbit_target(scene)
    views: dict[str, dict[str, float]] = {}
    for i, azimuth in enumerate(azimuths):
        pictures = [_picture(scene, t, azimuth, target) for t in range(len(scene))]
        changes = [_change(a, b) for a, b in zip(pictures, pictures[1:], strict=False)]
        total, count = np.sum(changes, axis=0) if changes else (0.0, 0)
        enclosed, open_ = np.sum([_holes(picture.alpha) for picture in pictures], axis=0)
        views[f"{azimuth:g}"] = {
            "flicker": float(total / count) if count else float("nan"),
            "holes": float(100.0 * open_ / max(enclosed, 1)),
        }
        if progress is not None:
            progress((i + 1) / len(azimuths))
    return {"turntable": views, "thickness": thickness(scene)}


def thickness(scene: BakedScene) -> dict[str, float]:
    """Smallest over middle extent (5th to 95th percentile along the principal axes) of every object's body."""
    found = {}
    for k, one in enumerate(scene.objects):
        body = (scene.object_index == k) & (scene.opacity.reshape(-1) > SHOWS)
        if one.is_background or body.sum() < 4:
            continue
        points = scene.xyz[body].astype(np.float64) - scene.xyz[body].mean(axis=0)
        along = points @ np.linalg.svd(points, full_matrices=False)[2].T
        low, high = np.percentile(along, [5, 95], axis=0)
        smallest, middle, _ = np.sort(high - low)
        found[one.name] = float(smallest / max(middle, 1e-12))
    return found


def _picture(scene: BakedScene, t: int, azimuth: float, target: np.ndarray) -> Picture:
    """Frame t with the flow to the next, as its orbit camera sees it."""
    after = min(t + 1, len(scene) - 1)
    size = short_side_size(scene.cameras.size, MEASURED_SIDE)
    now, then = (orbit_view(scene, f, 0.0, azimuth, target).resized(*size) for f in (t, after))
    return render_frame(scene, t, now, Look(objects_only=True, flow_to=then))


def _change(now: Picture, then: Picture) -> tuple[float, int]:
    """Sum of mean absolute changes of colour (levels of 255) and the count of pixels compared."""
    owner, flow = now.instance(SOLID), now.flow
    if flow is None:
        return 0.0, 0
    rows, columns = np.nonzero(owner >= 0)
    x, y = (np.stack([columns, rows], axis=-1) + flow[rows, columns]).astype(np.float32).T
    if not len(x):
        return 0.0, 0
    height, width = owner.shape
    column, row = np.rint(x).astype(int), np.rint(y).astype(int)
    inside = (column >= 0) & (column < width) & (row >= 0) & (row < height)
    there = then.instance(SOLID)[np.clip(row, 0, height - 1), np.clip(column, 0, width - 1)]
    same = inside & (there == owner[rows, columns])
    shown = _sampled(then.on(), x, y)
    change = 255.0 * np.abs(shown - now.on()[rows, columns]).mean(axis=-1)
    return float(change[same].sum()), int(same.sum())


def _sampled(image: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:  # (H, W, 3), (N,), (N,) -> (N, 3)
    """Bilinear colours at pixel indices; in pieces, as cv2.remap takes fewer than 32,767 places a row."""
    pieces = max(1, -(-len(x) // 30000))
    parts = [
        cv2.remap(image, a[None], b[None], cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)[0]
        for a, b in zip(np.array_split(x, pieces), np.array_split(y, pieces), strict=True)
    ]
    return np.concatenate(parts)


def _holes(alpha: np.ndarray) -> tuple[int, int]:
    """Pixels that the outer outlines enclose, and how many of them are not covered."""
    covered = (alpha > COVERED).astype(np.uint8)
    outlines, _ = cv2.findContours(covered, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
    enclosed = cv2.drawContours(np.zeros_like(covered), outlines, -1, 1, cv2.FILLED)
    return int(enclosed.sum()), int((enclosed & (1 - covered)).sum())
