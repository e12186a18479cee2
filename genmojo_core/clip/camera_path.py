"""Camera paths: keys with pose, field of view and scene time, and the smooth way between them.

Positions follow a Catmull-Rom spline through the keys, rotations turn at constant speed between two
keys, the field of view and scene time go straight. A key may hold: the camera stands while scene time may run on.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from genmojo_core.clip.cameras import View
from genmojo_core.conventions import matrix_to_quaternion, quaternion_to_matrix
from genmojo_core.errors import GenmojoError

MAX_KEYS = 10_000


@dataclass(frozen=True, eq=False)
class CameraKey:
    """One key of a path.

    Args:
        world_to_camera: (4, 4) rigid, OpenCV axes. fov: vertical field of view in degrees.
        scene_time: position 0..T-1 in the clip, fractions lie between frames. seconds: when the camera arrives.
        hold: seconds it stays.
    """

    world_to_camera: np.ndarray
    fov: float
    scene_time: float
    seconds: float
    hold: float = 0.0


@dataclass(frozen=True, eq=False)
class CameraPath:
    """A path of at least one key, by growing `seconds`. `closed`: after the last key it goes back to the first.

    Raises GenmojoError("camera") for keys that are no camera or not in order.
    """

    name: str
    keys: tuple[CameraKey, ...]
    closed: bool = False

    def __post_init__(self) -> None:
        """Check the keys."""
        end = -math.inf
        for i, key in enumerate(self.keys):
            pose = np.asarray(key.world_to_camera, np.float64)
            numbers = (key.fov, key.scene_time, key.seconds, key.hold)
            good = pose.shape == (4, 4) and np.isfinite(pose).all() and all(map(math.isfinite, numbers))
            if (
                not good
                or np.abs(pose[:3, :3] @ pose[:3, :3].T - np.eye(3)).max() > 1e-3
                or np.linalg.det(pose[:3, :3]) < 0
            ):
                raise GenmojoError("camera", f"key {i} holds no camera", self.name)
            if not 0.1 <= key.fov <= 179 or key.hold < 0 or key.scene_time < 0:
                raise GenmojoError(
                    "camera", f"key {i} has a field of view, hold or scene time that cannot be", self.name
                )
            if key.seconds < end or (i and key.seconds <= self.keys[i - 1].seconds):
                raise GenmojoError("camera", f"key {i} comes before the one before it has ended", self.name,
                                   "put the keys in order of time")  # fmt: skip
            end = key.seconds + key.hold
        if not 1 <= len(self.keys) <= MAX_KEYS:
            raise GenmojoError("camera", f"has {len(self.keys)} keys, allowed are 1 to {MAX_KEYS}", self.name)

    @property
    def seconds(self) -> float:
        """Length of the film; a closed path takes as long to the first key as it does on average between keys."""
        last = self.keys[-1].seconds + self.keys[-1].hold
        return last + (self._back() if self.closed else 0.0) - self.keys[0].seconds

    def at(self, seconds: float) -> CameraKey:
        """Pose, field of view and scene time so many seconds after the first key (clamped; wrapped if closed)."""
        first = self.keys[0].seconds
        length = max(self.seconds, 1e-9)
        clock = first + (seconds % length if self.closed else min(max(seconds, 0.0), length))
        stops = [(k.seconds, k.seconds + k.hold, i) for i, k in enumerate(self.keys)]
        if self.closed:
            stops.append((first + length, first + length, 0))
        for j, (start, end, i) in enumerate(stops):
            if clock <= end or j + 1 == len(stops):
                share = 0.0 if clock >= start or j == 0 else 1.0
                if share == 0.0:
                    return self._standing(i, clock)
                before = stops[j - 1]
                return self._between(before[2], i, (clock - before[1]) / max(start - before[1], 1e-9), clock)
        return self._standing(len(self.keys) - 1, clock)

    def to_json(self) -> dict[str, Any]:
        """Plain data; `from_json` is the inverse."""
        return {"name": self.name, "closed": self.closed, "keys": [
            {"world_to_camera": np.asarray(k.world_to_camera).tolist(), "fov": k.fov, "scene_time": k.scene_time,
             "seconds": k.seconds, "hold": k.hold} for k in self.keys]}  # fmt: skip

    @classmethod
    def from_json(cls, data: Mapping[str, Any], where: str = "camera path") -> CameraPath:
        """The path of plain data. Raises GenmojoError("schema") or ("camera")."""
        try:
            keys = tuple(
                CameraKey(np.asarray(k["world_to_camera"], np.float64), float(k["fov"]), float(k["scene_time"]),
                          float(k["seconds"]), float(k.get("hold", 0.0)))
                for k in data["keys"]
            )  # fmt: skip
            return cls(str(data.get("name", "path")), keys, bool(data.get("closed", False)))
        except (KeyError, TypeError, ValueError, AttributeError) as error:
            raise GenmojoError(
                "schema", "is no camera path", where, "export one as JSON to see how it looks"
            ) from error

    def _back(self) -> float:
        """Seconds from the last key to the first of a closed path."""
        count = len(self.keys)
        return (self.keys[-1].seconds - self.keys[0].seconds) / (count - 1) if count > 1 else 0.0

    def _standing(self, i: int, clock: float) -> CameraKey:
        key = self.keys[i]
        return CameraKey(np.asarray(key.world_to_camera, np.float64), key.fov, key.scene_time, clock, key.hold)

    def _between(self, a: int, b: int, x: float, clock: float) -> CameraKey:
        """Part x (0..1) of the way from key a to key b."""
        one, two = self.keys[a], self.keys[b]
        count = len(self.keys)
        before = self.keys[(a - 1) % count] if self.closed or a > 0 else one
        after = self.keys[(b + 1) % count] if self.closed or b + 1 < count else two
        centre = _spline([_centre(k) for k in (before, one, two, after)], x)
        turn = _slerp(_rotation(one), _rotation(two), x)
        pose = np.eye(4)
        pose[:3, :3] = turn
        pose[:3, 3] = -turn @ centre
        mix = [(1 - x) * getattr(one, n) + x * getattr(two, n) for n in ("fov", "scene_time")]
        return CameraKey(pose, mix[0], mix[1], clock)


def key_view(key: CameraKey, like: View) -> View:
    """The camera of a key with the picture size, range and shape of pixels of another one; axis in the middle."""
    focal = like.height / 2 / math.tan(math.radians(key.fov) / 2)
    return View(np.asarray(key.world_to_camera, np.float64), focal * like.fx / like.fy, focal, like.width / 2,
                like.height / 2, like.width, like.height, like.near, like.far, like.dilation)  # fmt: skip


def key_of(view: View, scene_time: float, seconds: float, hold: float = 0.0) -> CameraKey:
    """The key that shows what a camera sees."""
    fov = math.degrees(2 * math.atan(view.height / 2 / view.fy))
    return CameraKey(view.world_to_camera, fov, scene_time, seconds, hold)


def _centre(key: CameraKey) -> np.ndarray:
    pose = np.asarray(key.world_to_camera, np.float64)
    return -pose[:3, :3].T @ pose[:3, 3]


def _rotation(key: CameraKey) -> np.ndarray:
    return np.asarray(key.world_to_camera, np.float64)[:3, :3]


def _spline(points: list[np.ndarray], x: float) -> np.ndarray:
    """Catmull-Rom between the middle two of four points."""
    p, q, r, s = points
    return q + 0.5 * x * (r - p + x * (2 * p - 5 * q + 4 * r - s + x * (3 * (q - r) + s - p)))


def _slerp(a: np.ndarray, b: np.ndarray, x: float) -> np.ndarray:
    """Rotation part x of the way, the short way round, at constant speed."""
    q, r = matrix_to_quaternion(a), matrix_to_quaternion(b)
    r = -r if float(q @ r) < 0 else r
    angle = math.acos(min(1.0, float(q @ r)))
    if angle < 1e-6:
        return quaternion_to_matrix((1 - x) * q + x * r)
    return quaternion_to_matrix((math.sin((1 - x) * angle) * q + math.sin(x * angle) * r) / math.sin(angle))
