"""Views of a scene by numbers: elevation, azimuth, roll, radius, field of view, shift; and back from a camera.

The convention is `genmojo_core.conventions.orbit_camera`: (0, 0) is the frame's input camera, azimuth turns it about
world up (+ = the camera moves to its right), then elevation about its own right axis (+ = from above), rigidly about
the target. Then the camera rolls about its axis (+ = clockwise), moves to another distance from the target, and is
shifted. Numbers are kept, matrices derived from them; near the poles nothing flips.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, replace

import numpy as np

from genmojo_core.clip.cameras import Cameras, View
from genmojo_core.conventions import axis_angle_matrix, orbit_camera
from genmojo_core.errors import GenmojoError
from genmojo_studio.view3d.snapshot import SceneSnapshot

Vector = tuple[float, float, float]
_FORWARD = np.array([0.0, 0.0, 1.0])
_NAMES = ("elevation", "azimuth", "roll", "radius", "fov", "shift")


@dataclass(frozen=True)
class Orbit:
    """A view relative to the input camera.

    Args:
        elevation, azimuth, roll: degrees.
        radius: distance from the target in scene units, or None for the input camera's own.
        fov: vertical field of view of the clip's picture in degrees, or None for the input camera's own.
        shift: world vector added to camera and target.
    """

    elevation: float = 0.0
    azimuth: float = 0.0
    roll: float = 0.0
    radius: float | None = None
    fov: float | None = None
    shift: Vector = (0.0, 0.0, 0.0)

    def turned(self, elevation: float, azimuth: float) -> Orbit:
        """Turned further by degrees."""
        return replace(
            self, elevation=_half_turn(self.elevation + elevation), azimuth=_half_turn(self.azimuth + azimuth)
        )

    def text(self) -> str:
        """One line for the clipboard; `parse` reads it back to the last digit."""
        parts = [f"elevation {self.elevation!r}", f"azimuth {self.azimuth!r}", f"roll {self.roll!r}"]
        parts += [f"{name} {value!r}" for name in ("radius", "fov") if (value := getattr(self, name)) is not None]
        if any(self.shift):
            parts.append("shift " + " ".join(repr(float(v)) for v in self.shift))
        return " ".join(parts)


PRESETS: dict[str, Orbit] = {
    "input": Orbit(),
    "right_30": Orbit(azimuth=30.0),
    "left_30": Orbit(azimuth=-30.0),
    "above_30": Orbit(elevation=30.0),
    "below_30": Orbit(elevation=-30.0),
    "right_90": Orbit(azimuth=90.0),
    "left_90": Orbit(azimuth=-90.0),
    "back": Orbit(azimuth=180.0),
    "top": Orbit(elevation=89.9),
    "bottom": Orbit(elevation=-89.9),
}


@dataclass(frozen=True)
class Reference:
    """What orbits are relative to.

    Args:
        view: the input camera with its own picture size.
        target: (3,) world, what views turn about.
        up: (3,) unit, world.
    """

    view: View
    target: np.ndarray
    up: np.ndarray

    @property
    def radius(self) -> float:
        """Distance of the input camera from the target."""
        return float(np.linalg.norm(_centre(self.view.world_to_camera) - self.target))

    @property
    def fov(self) -> float:
        """Vertical field of view of the input picture, degrees."""
        return math.degrees(2 * math.atan(0.5 * self.view.height / self.view.fy))

    def pose(self, orbit: Orbit) -> np.ndarray:  # (4, 4) world_to_camera
        """The camera of an orbit."""
        turned = orbit_camera(self.view.world_to_camera, self.target, self.up, orbit.elevation, orbit.azimuth)
        if orbit.roll:
            turned = _homogeneous(axis_angle_matrix(_FORWARD, -orbit.roll)) @ turned
        centre = _centre(turned)
        if orbit.radius is not None:
            centre = self.target + (centre - self.target) * (orbit.radius / max(self.radius, 1e-12))
        centre = centre + np.asarray(orbit.shift)
        pose = np.eye(4)
        pose[:3, :3] = turned[:3, :3]
        pose[:3, 3] = -turned[:3, :3] @ centre
        return pose

    def view_of(self, orbit: Orbit, width: int, height: int, pixel_aspect: float = 1.0) -> View:
        """The camera of an orbit for a window: the clip's picture fits inside it, centred; what lies beside shows too.

        `pixel_aspect` is the width of a clip's pixel relative to its height.
        """
        source = self.view
        sx = min(width / (source.width * pixel_aspect), height / source.height) * pixel_aspect
        sy = sx / pixel_aspect
        zoom = (
            1.0 if orbit.fov is None else math.tan(math.radians(self.fov) / 2) / math.tan(math.radians(orbit.fov) / 2)
        )
        return View(
            self.pose(orbit), source.fx * sx * zoom, source.fy * sy * zoom,
            source.cx * sx + (width - source.width * sx) / 2, source.cy * sy + (height - source.height * sy) / 2,
            width, height, source.near, source.far, source.dilation * sx * sy * zoom * zoom,
        )  # fmt: skip

    def orbit_of(self, world_to_camera: np.ndarray, fov: float | None = None) -> Orbit:
        """The numbers of any pose: `pose` of the result is the pose again.

        Elevation is within half a turn above the lowest one; where the camera looks straight along world up, roll is 0
        if that is possible. Raises GenmojoError("camera") for a pose no turn about these axes can reach, which needs an
        input camera that is itself rolled.
        """
        base = np.asarray(self.view.world_to_camera, np.float64)[:3, :3]
        up = base @ (np.asarray(self.up, np.float64) / np.linalg.norm(self.up))
        turn = base @ np.asarray(world_to_camera, np.float64)[:3, :3].T  # in camera axes: azimuth, elevation, roll
        elevation, azimuth, roll = _angles(turn, up)
        direction = np.linalg.inv(orbit_camera(self.view.world_to_camera, self.target, self.up, elevation, azimuth))
        away = (direction[:3, 3] - self.target) / max(self.radius, 1e-12)
        offset = _centre(np.asarray(world_to_camera, np.float64)) - self.target
        radius = float(offset @ away)
        shift = offset - radius * away
        if np.abs(shift).max() < 1e-12 * max(1.0, abs(radius)):
            shift = np.zeros(3)
        return Orbit(elevation, azimuth, roll, radius, fov, (float(shift[0]), float(shift[1]), float(shift[2])))


def reference_of(snapshot: SceneSnapshot, t: float | None = None) -> Reference:
    """The input camera at a time (between frames interpolated), target and up of a snapshot.

    Without cameras (a PLY file) a camera that sees everything from the front stands in.
    """
    t = float(snapshot.frame if t is None else t)
    up = np.asarray(snapshot.world_up, np.float64)
    if snapshot.cameras is None or not len(snapshot.cameras):
        return Reference(_overview(snapshot), snapshot.orbit_target, up)
    first = min(max(int(t), 0), len(snapshot.cameras) - 1)
    view = snapshot.cameras.view(first)
    share = t - first
    if share > 0 and first + 1 < len(snapshot.cameras):
        view = view.with_pose(_between(view.world_to_camera, snapshot.cameras.view(first + 1).world_to_camera, share))
    return Reference(view, snapshot.orbit_target, up)


def next_pose(cameras: Cameras | None, view: View, t: float) -> np.ndarray:  # (4, 4)
    """A view's pose one frame later: the input camera's own motion applied to it."""
    if cameras is None or int(t) + 1 >= len(cameras):
        return view.world_to_camera
    now, after = cameras.world_to_camera[int(t)], cameras.world_to_camera[int(t) + 1]
    return view.world_to_camera @ np.linalg.inv(now) @ after


def between(a: Orbit, b: Orbit, share: float, reference: Reference) -> Orbit:
    """On the way from one orbit to another, eased in and out; the azimuth takes the shorter way round."""
    s = min(max(share, 0.0), 1.0)
    if s == 1.0:
        return b
    s = s * s * (3 - 2 * s)
    ra, rb = (reference.radius if o.radius is None else o.radius for o in (a, b))
    fa, fb = (reference.fov if o.fov is None else o.fov for o in (a, b))
    shift = tuple(float(v) for v in np.add(a.shift, s * np.subtract(b.shift, a.shift)))
    radius = None if a.radius is None and b.radius is None else ra * (rb / ra) ** s if ra > 0 and rb > 0 else rb
    return Orbit(
        _half_turn(a.elevation + s * _half_turn(b.elevation - a.elevation)),
        _half_turn(a.azimuth + s * _half_turn(b.azimuth - a.azimuth)),
        _half_turn(a.roll + s * _half_turn(b.roll - a.roll)),
        radius,
        None if a.fov is None and b.fov is None else fa + s * (fb - fa),
        (shift[0], shift[1], shift[2]),
    )


def parse(text: str) -> Orbit:
    """Read what `Orbit.text` wrote; names may be left out (then the default holds) and come in any order.

    Raises GenmojoError("value") for words or numbers that are none of these.
    """
    number = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
    pattern = rf"\s*(?:({'|'.join(_NAMES)})[\s:=]+({number}(?:[\s,]+{number})*)[\s,;]*)"
    found: dict[str, list[float]] = {}
    at = 0
    while at < len(text.rstrip()):
        match = re.compile(pattern).match(text, at)
        if match is None:
            break
        found[match.group(1)] = [float(v) for v in re.findall(number, match.group(2))]
        at = match.end()
    wrong = [k for k, v in found.items() if len(v) != (3 if k == "shift" else 1) or not np.isfinite(v).all()]
    if not found or wrong or text[at:].strip():
        raise GenmojoError("value", "is no view", repr(text[:60]), "write for example: elevation 30 azimuth -15")
    shift = found.pop("shift", [0.0, 0.0, 0.0])
    return Orbit(**{k: v[0] for k, v in found.items()}, shift=(shift[0], shift[1], shift[2]))


def _angles(turn: np.ndarray, up: np.ndarray) -> tuple[float, float, float]:
    """(elevation, azimuth, roll) in degrees with turn = about `up` by azimuth, about x by -elevation, about z by roll.

    `turn` (3, 3) and `up` (3,) unit are in the input camera's axes. Looking direction w = turn z: its part along `up`
    gives the elevation, its direction around `up` the azimuth, what is left the roll.
    """
    looking = turn[:, 2]
    along, reach = float(up @ looking), math.hypot(up[1], up[2])
    across = float(np.sum(np.cross(up, looking) ** 2) - up[0] ** 2)
    if across < -1e-9 or reach < 1e-9:
        raise GenmojoError("camera", "this pose cannot be reached from the input camera by elevation, azimuth and roll",
                           "view")  # fmt: skip
    elevation = math.atan2(up[1], up[2]) + math.atan2(math.sqrt(max(across, 0.0)), along)
    lifted = np.array([0.0, math.sin(elevation), math.cos(elevation)])
    first, second = (v - (v @ up) * up for v in (lifted, looking))
    if min(np.linalg.norm(first), np.linalg.norm(second)) < 1e-9:  # along world up: right axes say where it points
        first, second = (v - (v @ up) * up for v in (np.array([1.0, 0, 0]), turn[:, 0]))
    azimuth = math.atan2(float(up @ np.cross(first, second)), float(first @ second))
    undone = axis_angle_matrix(np.array([1.0, 0, 0]), math.degrees(elevation)) @ axis_angle_matrix(
        up, -math.degrees(azimuth)
    )
    rest = undone @ turn
    roll = math.degrees(math.atan2(rest[1, 0], rest[0, 0]))
    return _half_turn(math.degrees(elevation)), _half_turn(math.degrees(azimuth)), roll


def _half_turn(degrees: float) -> float:
    """The same angle in (-180, 180]; angles already there stay exactly what they are."""
    return degrees if -180.0 < degrees <= 180.0 else 180.0 - (180.0 - degrees) % 360.0


def _centre(world_to_camera: np.ndarray) -> np.ndarray:  # (3,) world
    """Where a camera is."""
    return -world_to_camera[:3, :3].T @ world_to_camera[:3, 3]


def _homogeneous(rotation: np.ndarray) -> np.ndarray:
    """(4, 4) of a (3, 3)."""
    full = np.eye(4)
    full[:3, :3] = rotation
    return full


def _between(a: np.ndarray, b: np.ndarray, share: float) -> np.ndarray:
    """A pose on the way between two cameras: centres on a line, rotation at constant speed."""
    turn = b[:3, :3] @ a[:3, :3].T
    angle = math.degrees(math.acos(min(max((np.trace(turn) - 1) / 2, -1.0), 1.0)))
    axis = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]])
    length = float(np.linalg.norm(axis))
    part = axis_angle_matrix(axis / length, angle * share) if length > 1e-12 else np.eye(3)
    pose = np.eye(4)
    pose[:3, :3] = part @ a[:3, :3]
    pose[:3, 3] = -pose[:3, :3] @ ((1 - share) * _centre(a) + share * _centre(b))
    return pose


def _overview(snapshot: SceneSnapshot) -> View:
    """A camera in front of everything (world z forward, y down), 16:9, 45 degrees high."""
    target = snapshot.orbit_target
    points = snapshot.positions[snapshot.is_sound]
    extent = float(np.percentile(np.linalg.norm(points - target, axis=1), 95)) if len(points) else 1.0
    pose = np.eye(4)
    pose[:3, 3] = -(target - np.array([0, 0, 3.0 * max(extent, 1e-6)]))
    focal = 0.5 * 720 / math.tan(math.radians(22.5))
    return View(pose, focal, focal, 640.0, 360.0, 1280, 720, near=0.01 * max(extent, 1e-6), far=1e3 * max(extent, 1.0))
