"""The coordinates a run works in: near the origin and of ordinary size, whatever the clip's are.

float32 has seven digits: at 10,000 units from the origin a millimetre is lost, and the optimiser's small steps with it;
near planes and floors are made for scenes some units deep. A clip whose world is far off or of unusual size is
therefore optimised in coordinates x' = (x - origin) / unit and written back in its own (RELIABILITY.md N24, N28).
Ordinary clips stay as they are, bit for bit.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from genmojo_core.clip.cameras import Cameras
from genmojo_core.clip.clip import Channel, Clip
from genmojo_core.optimise.live import LiveFrame
from genmojo_core.store.scene_file import BakedScene

FAR_OFF = 50.0  # typical depths from the origin beyond which the origin is moved to the first camera
ORDINARY = (0.02, 500.0)  # typical depths that need no other unit
TYPICAL = 5.0  # what the typical depth becomes otherwise
NEAR, FAR = 0.01, 1e4


@dataclass(frozen=True)
class WorkingSpace:
    """x' = (x - origin) / unit: origin (3,) float64 and unit in the clip's world units."""

    origin: np.ndarray
    unit: float

    @property
    def plain(self) -> bool:
        """True if the clip's own coordinates are worked in."""
        return self.unit == 1.0 and not self.origin.any()

    def inside(self, clip: Clip) -> Clip:
        """The clip in working coordinates."""
        if self.plain:
            return clip
        channels: dict[str, Any] = {}
        for name in ("depth", "background_depth"):
            channel: Channel | None = getattr(clip, name)
            if channel is not None:
                channels[name] = replace(channel, value=(channel.value / self.unit).astype(np.float32))
        if clip.cameras is not None:
            channels["cameras"] = replace(clip.cameras, value=self._cameras(clip.cameras.value))
        return clip.with_channels(**channels)

    def outside(self, scene: BakedScene) -> BakedScene:
        """A scene of working coordinates in the clip's."""
        if self.plain:
            return scene
        placed = scene.object_to_world.astype(np.float64) * self.unit
        placed[..., 3] += self.origin
        return replace(scene, object_to_world=placed.astype(np.float32), cameras=self.outside_cameras(scene.cameras))

    def outside_cameras(self, cameras: Cameras) -> Cameras:
        """Cameras of working coordinates in the clip's."""
        if self.plain:
            return cameras
        poses = cameras.world_to_camera.copy()
        poses[:, :3, 3] = self.unit * poses[:, :3, 3] - poses[:, :3, :3] @ self.origin
        return replace(cameras, world_to_camera=poses, near=cameras.near * self.unit, far=cameras.far * self.unit)

    def outside_live(self, frame: LiveFrame) -> LiveFrame:
        """Live Gaussians of working coordinates in the clip's."""
        if self.plain:
            return frame
        means = (frame.means * self.unit + self.origin).astype(np.float32)
        return replace(frame, means=means, scales=frame.scales * np.float32(self.unit))

    def _cameras(self, cameras: Cameras) -> Cameras:
        poses = cameras.world_to_camera.copy()
        poses[:, :3, 3] = (poses[:, :3, 3] + poses[:, :3, :3] @ self.origin) / self.unit
        return replace(cameras, world_to_camera=poses, near=min(cameras.near / self.unit, NEAR),
                       far=max(cameras.far / self.unit, FAR))  # fmt: skip


def working_space(clip: Clip) -> WorkingSpace:
    """The space a complete clip is to be optimised in."""
    depth = _typical(clip.depth)
    unit = 1.0 if ORDINARY[0] <= depth <= ORDINARY[1] else depth / TYPICAL
    origin = np.zeros(3)
    if clip.cameras is not None:
        pose = clip.cameras.value.world_to_camera[0]
        first = -pose[:3, :3].T @ pose[:3, 3]
        origin = first if np.linalg.norm(first) > FAR_OFF * depth else origin
    return WorkingSpace(origin, float(unit))


def _typical(depth: Channel | None) -> float:
    """Median depth where it holds; TYPICAL if there is none."""
    if depth is None or not depth.valid.any():
        return TYPICAL
    return float(np.median(depth.value[depth.valid]))
