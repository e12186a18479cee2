"""Which views can be trusted: those near one that the optimisation has seen."""

from __future__ import annotations

import numpy as np

from genmojo_studio.view3d.orbit import Orbit

SAFE_DEGREES = 10.0  # a view this close to a supervised one counts as supervised
_PAIRS = 330_000  # of directions that are compared at a time: a long run supervises thousands of views


def degrees_outside(orbit: Orbit, supervised: np.ndarray) -> float:
    """Angle of a view to the nearest supervised direction, as `degrees_to_supervised`."""
    return float(degrees_to_supervised(np.array([[orbit.elevation, orbit.azimuth]]), supervised)[0])


def degrees_to_supervised(angles: np.ndarray, supervised: np.ndarray) -> np.ndarray:  # (N, 2) degrees -> (N,) degrees
    """Angle of directions (elevation, azimuth) to the nearest of rows (elevation, azimuth, frame) as in a snapshot.

    The input camera (0, 0) always was supervised.
    """
    rows = np.asarray(supervised, np.float64).reshape(-1, 3)[:, :2]
    wanted, seen = _directions(np.asarray(angles, np.float64)), _directions(np.concatenate([np.zeros((1, 2)), rows]))
    cosine = np.full(len(wanted), -1.0)
    rows_at_once = max(1, _PAIRS // max(len(wanted), 1))
    for first in range(0, len(seen), rows_at_once):
        np.maximum(cosine, (seen[first : first + rows_at_once] @ wanted.T).max(axis=0), out=cosine)
    return np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0)))


def _directions(angles: np.ndarray) -> np.ndarray:  # (M, 2) degrees -> (M, 3) unit
    """Unit vectors from the target towards the cameras, in the input camera's axes."""
    elevation, azimuth = np.deg2rad(angles).T
    return np.stack(
        [np.cos(elevation) * np.sin(azimuth), np.sin(elevation), np.cos(elevation) * np.cos(azimuth)], axis=1
    )
