"""Which views can be trusted: those near one that the optimisation has seen."""

from __future__ import annotations

import math

import numpy as np

from genmojo_studio.view3d.orbit import Orbit

SAFE_DEGREES = 10.0  # a view this close to a supervised one counts as supervised


def degrees_outside(orbit: Orbit, supervised: np.ndarray) -> float:
    """Angle to the nearest supervised direction; rows (elevation, azimuth, frame) as in a snapshot.

    The input camera (0, 0) always was supervised.
    """
    angles = np.concatenate([np.zeros((1, 2)), np.asarray(supervised, np.float64).reshape(-1, 3)[:, :2]])
    cosine = float((_directions(angles) @ _directions(np.array([[orbit.elevation, orbit.azimuth]]))[0]).max())
    return math.degrees(math.acos(min(max(cosine, -1.0), 1.0)))


def _directions(angles: np.ndarray) -> np.ndarray:  # (M, 2) degrees -> (M, 3) unit
    """Unit vectors from the target towards the cameras, in the input camera's axes."""
    elevation, azimuth = np.deg2rad(angles).T
    return np.stack(
        [np.cos(elevation) * np.sin(azimuth), np.sin(elevation), np.cos(elevation) * np.cos(azimuth)], axis=1
    )
