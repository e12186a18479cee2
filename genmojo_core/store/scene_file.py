"""The 4D scene as files hold it: baked motion, plain numpy, readable without torch or our code.

`BakedScene` mirrors the HDF5 layout `genmojo4d` 1.0 (VIEWER.md section 5.1); `scene_hdf5.py` reads and writes it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from genmojo_core.clip.cameras import Cameras
from genmojo_core.conventions import dc_to_rgb, matrix_to_quaternion, normalise_quaternions, quaternion_multiply
from genmojo_core.tracks.model import PointTracks


@dataclass(frozen=True)
class SceneObject:
    """One object (or the background): which rows of the Gaussians are its own.

    Args:
        id: id in the source's masks; 0 for the background.
        name, color: for people; color is RGB in 0..1.
        is_background: True for the one background object.
        first, count: its Gaussians are rows first .. first + count - 1.
    """

    id: int
    name: str
    color: tuple[float, float, float]
    is_background: bool
    first: int
    count: int


@dataclass(frozen=True)
class Frame:
    """All Gaussians of one frame in world space, activated; rows as in the scene.

    means (N, 3), quats (N, 4) wxyz unit, scales (N, 3) linear, opacities (N,), rgb (N, 3) not clamped,
    object_index (N,) int64 position in `BakedScene.objects`.
    """

    means: np.ndarray
    quats: np.ndarray
    scales: np.ndarray
    opacities: np.ndarray
    rgb: np.ndarray
    object_index: np.ndarray


@dataclass(frozen=True)
class BakedScene:
    """T frames, K objects (background included), N Gaussians.

    Args:
        frame_index: (T,) int64 numbers in the source. seconds: (T,) float64. source_names: T names.
        objects: K objects, their rows contiguous and together all N.
        xyz: (N, 3) float32 canonical, object space. rot: (N, 4) wxyz. scale: (N, 3) linear. opacity: (N,) 0..1.
        dc: (N, 3) constant spherical-harmonic coefficient. uid: (N,) uint64 stable over density control.
        d_xyz: (T, N, 3) float32 added to xyz. rot_t: (T, N, 4) absolute rotation in object space.
        log_scale_t: (T, N, 3) added to log scale. d_dc: (T, N, 3) or None when nothing changes colour.
        object_to_world: (T, K, 3, 4) [s R | t], s > 0. depth_scale: (T, K) the dolly factor k (already inside s, t).
        cameras: input cameras in pixels of `cameras.size`, which is the clip's own (source) size.
        ref_frame: canonical frame position (K,) int64.
        world_up: (3,) unit. supervised: rows (elevation deg, azimuth deg, frame position) that saw supervision.
        predicted: optional point tracks of the scene, source pixels.
        config: JSON-able run configuration; effects: JSON-able effect plan; curve: rows of accuracy against time.
        metrics: name -> value. generator, run_uuid, created_utc: provenance.
    """

    frame_index: np.ndarray
    seconds: np.ndarray
    source_names: tuple[str, ...]
    objects: tuple[SceneObject, ...]
    xyz: np.ndarray
    rot: np.ndarray
    scale: np.ndarray
    opacity: np.ndarray
    dc: np.ndarray
    uid: np.ndarray
    d_xyz: np.ndarray
    rot_t: np.ndarray
    log_scale_t: np.ndarray
    object_to_world: np.ndarray
    depth_scale: np.ndarray
    cameras: Cameras
    ref_frame: np.ndarray
    world_up: np.ndarray
    d_dc: np.ndarray | None = None
    supervised: np.ndarray = field(default_factory=lambda: np.zeros((0, 3), np.float32))
    predicted: PointTracks | None = None
    config: dict[str, Any] = field(default_factory=dict)
    effects: list[dict[str, Any]] = field(default_factory=list)
    curve: list[dict[str, float]] = field(default_factory=list)
    metrics: dict[str, float] = field(default_factory=dict)
    fps: float = 24.0
    pixel_aspect: float = 1.0
    run_uuid: str = ""
    created_utc: str = ""
    generator: str = ""

    def __len__(self) -> int:
        return len(self.frame_index)

    @property
    def object_index(self) -> np.ndarray:  # (N,) int64
        """Position in `objects` of every Gaussian's owner."""
        return np.repeat(np.arange(len(self.objects)), [o.count for o in self.objects])

    def frame_at(self, time: float) -> Frame:
        """All Gaussians at a time 0..T-1 between two frames: centres and sizes on the straight way, turns shortest."""
        t = min(max(math.floor(time), 0), len(self) - 1)
        share = time - t
        one = self.frame(t)
        if share <= 0 or t + 1 >= len(self):
            return one
        two = self.frame(t + 1)
        sign = np.where((one.quats * two.quats).sum(1, keepdims=True) < 0, -1.0, 1.0)
        quats = normalise_quaternions((1 - share) * one.quats + share * sign * two.quats)
        scales = one.scales ** (1 - share) * two.scales**share
        means, rgb = ((1 - share) * a + share * b for a, b in ((one.means, two.means), (one.rgb, two.rgb)))
        return Frame(means.astype(np.float32), quats.astype(np.float32), scales.astype(np.float32), one.opacities,
                     rgb.astype(np.float32), one.object_index)  # fmt: skip

    def frame(self, t: int) -> Frame:
        """All Gaussians at frame t (0..T-1) in world space: x = s R (xyz + d_xyz) + t, sigma times s."""
        owner = self.object_index
        placement = self.object_to_world[t].astype(np.float64)  # (K, 3, 4)
        size = np.cbrt(np.maximum(np.linalg.det(placement[:, :, :3]), 1e-30))  # (K,)
        rotation = placement[:, :, :3] / size[:, None, None]
        local = self.xyz[:].astype(np.float64) + self.d_xyz[t]
        means = np.einsum("nij,nj->ni", placement[owner, :, :3], local) + placement[owner, :, 3]
        quats = quaternion_multiply(matrix_to_quaternion(rotation)[owner], normalise_quaternions(self.rot_t[t]))
        scales = self.scale * np.exp(self.log_scale_t[t].astype(np.float32)) * size[owner, None]
        dc = self.dc if self.d_dc is None else self.dc + self.d_dc[t]
        return Frame(means.astype(np.float32), quats.astype(np.float32), scales.astype(np.float32),
                     self.opacity.astype(np.float32), dc_to_rgb(dc).astype(np.float32), owner)  # fmt: skip
