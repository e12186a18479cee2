"""Which sides of an object no frame shows, of those that the user may want to look at."""

from __future__ import annotations

import math

import numpy as np

GRAZING = 75.0  # degrees: surface turned further from the camera tells next to nothing
MOST_ELEVATION = 30.0  # degrees that views rise or sink at most, however far they go round
_NORMALS = 600
_FRAMES = 8  # whose surroundings are asked for, spread over the clip
_STEP = 15.0  # degrees between the views asked for


def unseen_share(sight: np.ndarray, view_range: float) -> float:
    """Share of the picture that shows what no frame has shown, in the worst of the views asked for; 0..1.

    The object counts as a ball: normals seen within 75 degrees of some frame's line of sight are known, and a view's
    picture shows every normal by its foreshortened area.

    Args:
        sight: (T, 3, 3) rotations from object to camera (OpenCV axes). view_range: degrees round every frame's camera.
    """
    normals = _ball(_NORMALS)
    towards = -sight[:, 2, :]  # (T, 3): from the object to the camera, in object axes
    seen = (normals @ towards.T).max(axis=1) > math.cos(math.radians(GRAZING))
    worst = 0.0
    for t in np.unique(np.linspace(0, len(sight) - 1, min(len(sight), _FRAMES)).round().astype(int)):
        shown = np.maximum(normals @ (_asked(view_range) @ sight[t]).T, 0.0)  # (N, V)
        worst = max(worst, float((shown[~seen].sum(axis=0) / shown.sum(axis=0)).max()))
    return worst


def _asked(view_range: float) -> np.ndarray:
    """(V, 3) directions from an object to the views asked for, in axes of the frame's camera."""
    rise = min(view_range, MOST_ELEVATION)
    azimuths = np.deg2rad(np.linspace(-view_range, view_range, max(3, 1 + 2 * math.ceil(view_range / _STEP))))
    views = []
    for elevation in np.deg2rad([-rise, 0.0, rise]):
        flat = np.cos(elevation)
        views.append(np.stack([flat * np.sin(azimuths), np.full(len(azimuths), -np.sin(elevation)),
                               -flat * np.cos(azimuths)], axis=1))  # fmt: skip
    return np.concatenate(views)


def _ball(count: int) -> np.ndarray:
    """(count, 3) even directions (Fibonacci lattice)."""
    i = np.arange(count) + 0.5
    z, turn = 1 - 2 * i / count, math.pi * (1 + math.sqrt(5)) * i
    flat = np.sqrt(1 - z * z)
    return np.stack([flat * np.cos(turn), flat * np.sin(turn), z], axis=1)
