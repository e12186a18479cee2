"""What a view draws: all Gaussians of one moment in world space, plain numpy.

A worker's previews and opened scene files become the same `SceneSnapshot`; views, pickers and exporters read nothing
else. Where all frames are known (a scene file) `frames` gives any of them, so that scrubbing needs no new snapshot.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Protocol

import numpy as np

from genmojo_core.clip.cameras import Cameras
from genmojo_core.errors import GenmojoError
from genmojo_core.store.scene_file import BakedScene, Frame
from genmojo_core.tracks.model import PointTracks

_WIDTHS = {"positions": 3, "rotations": 4, "scales": 3, "opacities": 0, "colours": 3, "object_id": 0, "uid": 0}
_TYPES = {"object_id": np.uint16, "uid": np.uint64}  # all others are float32


@dataclass(frozen=True)
class SnapshotObject:
    """One object of a snapshot: the id its masks have (background: 0), a name and a colour (RGB 0..1) for people."""

    id: int
    name: str
    color: tuple[float, float, float]
    is_background: bool = False


class FrameSource(Protocol):
    """Something that knows every frame: `BakedScene` is one. Rows are the snapshot's."""

    def __len__(self) -> int:
        """Frames."""
        ...

    def frame(self, t: int) -> Frame:
        """All Gaussians at frame t (0..T-1), world space, activated."""
        ...


@dataclass(frozen=True, eq=False)
class SceneSnapshot:
    """N Gaussians of K objects at one frame; compared by identity, replaced as a whole.

    Args:
        version: grows with every snapshot of one source; views ignore older ones.
        frame: position 0..T-1 in the clip that the arrays show. T: frames of the clip.
        stage, step: where the optimisation was ("" and 0 for a file).
        positions: (N, 3) float32 world. rotations: (N, 4) wxyz. scales: (N, 3) linear sigma, scene units.
        opacities: (N,) 0..1. colours: (N, 3) RGB, 1 = white, not clamped.
        object_id: (N,) uint16, `SnapshotObject.id`. uid: (N,) uint64 stable over density control.
        objects: whom the ids name; ids without a name are drawn too.
        cameras: the clip's own cameras, or None. world_up: (3,) unit. target: (3,) what views turn about, or None.
        supervised: (M, 3) rows (elevation deg, azimuth deg, frame) that saw supervision.
        frames: every frame, or None where only this one is known.
        tracks: predicted point tracks, or None.
    """

    version: int
    frame: int
    stage: str
    step: int
    T: int
    positions: np.ndarray
    rotations: np.ndarray
    scales: np.ndarray
    opacities: np.ndarray
    colours: np.ndarray
    object_id: np.ndarray
    uid: np.ndarray
    objects: tuple[SnapshotObject, ...] = ()
    cameras: Cameras | None = None
    world_up: np.ndarray = field(default_factory=lambda: np.array([0.0, -1.0, 0.0]))
    target: np.ndarray | None = None
    supervised: np.ndarray = field(default_factory=lambda: np.zeros((0, 3), np.float32))
    frames: FrameSource | None = None
    tracks: PointTracks | None = None

    def __post_init__(self) -> None:
        """Bring arrays to their types; raise GenmojoError("schema") where shapes do not fit together."""
        for name, width in _WIDTHS.items():
            array = np.ascontiguousarray(getattr(self, name), _TYPES.get(name, np.float32))
            wanted = (len(self.positions), width) if width else (len(self.positions),)
            if array.shape != wanted:
                raise GenmojoError("schema", f"{name} has shape {array.shape}, expected {wanted}", "snapshot")
            object.__setattr__(self, name, array)

    def __len__(self) -> int:
        return len(self.positions)

    @cached_property
    def object_ids(self) -> np.ndarray:
        """(K,) uint16 sorted ids that occur or have a name: the order of a renderer's object table."""
        return np.union1d(np.unique(self.object_id), np.array([o.id for o in self.objects], np.uint16))

    @cached_property
    def object_index(self) -> np.ndarray:
        """(N,) int64 position of every Gaussian's object in `object_ids`."""
        return np.searchsorted(self.object_ids, self.object_id)

    @cached_property
    def is_background(self) -> np.ndarray:
        """(N,) bool."""
        ids = [o.id for o in self.objects if o.is_background]
        return np.isin(self.object_id, np.array(ids, np.uint16))

    @cached_property
    def is_sound(self) -> np.ndarray:
        """(N,) bool: all values are finite and the quaternion has a length; the others are not drawn."""
        columns = (self.positions, self.rotations, self.scales, self.opacities[:, None], self.colours)
        finite = np.isfinite(np.concatenate(columns, axis=1)).all(axis=1)
        return finite & (np.abs(self.rotations).max(axis=1, initial=0) > 1e-12)

    @cached_property
    def orbit_target(self) -> np.ndarray:
        """(3,) float64 what views turn about: `target`, else the median of the objects (of everything if none)."""
        if self.target is not None:
            return np.asarray(self.target, np.float64)
        chosen = ~self.is_background & np.isfinite(self.positions).all(axis=1)
        points = self.positions[chosen] if chosen.any() else self.positions
        return np.median(points, axis=0).astype(np.float64) if len(points) else np.zeros(3)

    def object_of(self, object_id: int) -> SnapshotObject:
        """Name and colour of an id; an unnamed one gets a name and a grey."""
        for found in self.objects:
            if found.id == object_id:
                return found
        return SnapshotObject(object_id, f"object {object_id}", (0.6, 0.6, 0.6))

    def at(self, t: int) -> SceneSnapshot:
        """This scene at frame t; itself where t is its frame or other frames are not known."""
        if self.frames is None or t == self.frame:
            return self
        t = min(max(t, 0), self.T - 1)
        found = self.frames.frame(t)
        return replace(self, frame=t, positions=found.means, rotations=found.quats, scales=found.scales,
                       opacities=found.opacities, colours=found.rgb)  # fmt: skip

    @cached_property
    def canonical(self) -> SceneSnapshot:
        """Every object in the shape it was reconstructed in, at the frame it was reconstructed from, without motion.

        This snapshot itself where its source does not tell (a live preview).
        """
        if not isinstance(self.frames, BakedScene):
            return self
        scene = self.frames
        still = replace(
            scene, d_xyz=np.zeros((1, *scene.xyz.shape), np.float32), rot_t=scene.rot[None], d_dc=None,
            log_scale_t=np.zeros((1, *scene.scale.shape), np.float32),
            object_to_world=scene.object_to_world[scene.ref_frame, np.arange(len(scene.objects))][None],
        )  # fmt: skip
        found = still.frame(0)
        return replace(self, frames=None, positions=found.means, rotations=found.quats, scales=found.scales,
                       opacities=found.opacities, colours=found.rgb)  # fmt: skip

    def trajectory(self, row: int) -> dict[str, np.ndarray]:
        """One Gaussian over all known frames: positions (T, 3), rotations (T, 4), scales (T, 3), colours (T, 3).

        T = 1 where other frames are not known. Raises GenmojoError("argument") for a row that is not there.
        """
        if not 0 <= row < len(self):
            raise GenmojoError("argument", f"there is no Gaussian {row}", "snapshot")
        source = self.frames
        names = {"positions": "means", "rotations": "quats", "scales": "scales", "colours": "rgb"}
        if source is None:
            return {name: getattr(self, name)[row : row + 1] for name in names}
        if isinstance(source, BakedScene):
            source, row = _alone(source, row), 0
        frames = [source.frame(t) for t in range(len(source))]
        return {name: np.stack([getattr(f, key)[row] for f in frames]) for name, key in names.items()}

    @classmethod
    def from_baked(cls, scene: BakedScene, frame: int = 0, version: int = 0) -> SceneSnapshot:
        """A scene file's content at a frame; the target of views is the one `genmojo render` uses."""
        # Imported here: it loads the compiled kernels, which a window without a scene does not need.
        from genmojo_core.measure.views import orbit_target

        t = min(max(frame, 0), len(scene) - 1)
        found = scene.frame(t)
        objects = tuple(SnapshotObject(o.id, o.name, o.color, o.is_background) for o in scene.objects)
        ids = np.array([o.id for o in scene.objects], np.uint16)
        return cls(
            version=version, frame=t, stage="", step=0, T=len(scene), positions=found.means, rotations=found.quats,
            scales=found.scales, opacities=found.opacities, colours=found.rgb, object_id=ids[found.object_index],
            uid=scene.uid, objects=objects, cameras=scene.cameras, world_up=np.asarray(scene.world_up, np.float64),
            target=orbit_target(scene) if len(scene.xyz) else None, supervised=scene.supervised, frames=scene,
            tracks=scene.predicted,
        )  # fmt: skip


def _alone(scene: BakedScene, row: int) -> BakedScene:
    """A scene of one Gaussian: its frames cost nothing."""
    k = int(scene.object_index[row])
    one = slice(row, row + 1)
    return replace(
        scene, objects=(replace(scene.objects[k], first=0, count=1),), xyz=scene.xyz[one], rot=scene.rot[one],
        scale=scene.scale[one], opacity=scene.opacity[one], dc=scene.dc[one], uid=scene.uid[one],
        d_xyz=scene.d_xyz[:, one], rot_t=scene.rot_t[:, one], log_scale_t=scene.log_scale_t[:, one],
        object_to_world=scene.object_to_world[:, k : k + 1], depth_scale=scene.depth_scale[:, k : k + 1],
        ref_frame=scene.ref_frame[k : k + 1], d_dc=None if scene.d_dc is None else scene.d_dc[:, one],
    )  # fmt: skip
