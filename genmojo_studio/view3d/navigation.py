"""From mouse movements to orbits. Pure: angles and lengths in, an `Orbit` out."""

from __future__ import annotations

import math
from dataclasses import replace
from enum import Enum

import numpy as np
from PySide6.QtCore import Qt

from genmojo_core.clip.cameras import View
from genmojo_studio.view3d.orbit import Orbit, Reference

DEGREES_PER_PIXEL = 0.35
_NEAREST, _FARTHEST = 0.02, 50.0  # times the input camera's distance
_NARROWEST, _WIDEST = 2.0, 120.0  # degrees


class Action(Enum):
    """What a drag does."""

    NONE = 0
    TURN = 1
    MOVE = 2
    DISTANCE = 3


def action(buttons: Qt.MouseButton, modifiers: Qt.KeyboardModifier) -> Action:
    """Left turns; middle, or left with Shift, moves; right changes the distance."""
    if buttons & Qt.MouseButton.MiddleButton:
        return Action.MOVE
    if buttons & Qt.MouseButton.RightButton:
        return Action.DISTANCE
    if buttons & Qt.MouseButton.LeftButton:
        return Action.MOVE if modifiers & Qt.KeyboardModifier.ShiftModifier else Action.TURN
    return Action.NONE


def dragged(orbit: Orbit, reference: Reference, view: View, moved: tuple[float, float], does: Action) -> Orbit:
    """After the mouse has moved by (x, y) pixels of `view`: the scene follows the hand."""
    x, y = moved
    if does == Action.TURN:
        lowest, highest = elevation_range(reference)
        wanted = orbit.elevation + y * DEGREES_PER_PIXEL
        if lowest <= orbit.elevation <= highest:
            wanted = min(max(wanted, lowest), highest)
        return replace(orbit.turned(0.0, -x * DEGREES_PER_PIXEL), elevation=wanted)
    if does == Action.MOVE:
        distance = reference.radius if orbit.radius is None else orbit.radius
        right, down = view.world_to_camera[0, :3], view.world_to_camera[1, :3]
        shift = np.asarray(orbit.shift) - distance * (x / view.fx * right + y / view.fy * down)
        return replace(orbit, shift=(float(shift[0]), float(shift[1]), float(shift[2])))
    if does == Action.DISTANCE:
        return _farther(orbit, reference, math.exp(y * 0.005))
    return orbit


def wheeled(orbit: Orbit, reference: Reference, steps: float, *, lens: bool) -> Orbit:
    """After `steps` notches of the wheel (+ = away from the hand = nearer): distance, or the lens."""
    factor = 0.88**steps
    if not lens:
        return _farther(orbit, reference, factor)
    fov = reference.fov if orbit.fov is None else orbit.fov
    return replace(orbit, fov=min(max(fov * factor, _NARROWEST), _WIDEST))


def elevation_range(reference: Reference) -> tuple[float, float]:
    """Elevations between which the view does not go over a pole, a tenth of a degree before it."""
    up = reference.view.world_to_camera[:3, :3] @ np.asarray(reference.up, float)
    lowest = math.degrees(math.atan2(up[1], up[2]))
    return lowest + 0.1, lowest + 179.9


def _farther(orbit: Orbit, reference: Reference, factor: float) -> Orbit:
    """Another distance, within limits."""
    own = max(reference.radius, 1e-9)
    radius = own if orbit.radius is None else orbit.radius
    return replace(orbit, radius=min(max(radius * factor, own * _NEAREST), own * _FARTHEST))
