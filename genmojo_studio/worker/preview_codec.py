"""What a preview holds: Gaussians of one frame, or of all frames, as arrays for the preview bus and back.

Two streams: "now" is the frame the window shows, sent often; "layers" is every frame, sent seldom, so that scrubbing
needs no answer from the worker. Objects move, the background (id 0, last rows) stands still and is sent once.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Protocol

import numpy as np

from genmojo_core.clip.cameras import Cameras
from genmojo_core.store.scene_file import Frame
from genmojo_studio.view3d.snapshot import SceneSnapshot, SnapshotObject
from genmojo_studio.worker.preview_bus import Message

Arrays = dict[str, np.ndarray]
_COLOUR_STEP = 1 / 512  # colours that change less over time are sent once


class FrameArrays(Protocol):
    """N Gaussians of one frame in world space, activated; objects first, then the background (id 0)."""

    @property
    def means(self) -> np.ndarray:
        """(N, 3)."""
        ...

    @property
    def quats(self) -> np.ndarray:
        """(N, 4) wxyz."""
        ...

    @property
    def scales(self) -> np.ndarray:
        """(N, 3) linear sigma."""
        ...

    @property
    def opacities(self) -> np.ndarray:
        """(N,) 0..1."""
        ...

    @property
    def rgb(self) -> np.ndarray:
        """(N, 3) not clamped."""
        ...

    @property
    def object_id(self) -> np.ndarray:
        """(N,) uint16, 0 for the background."""
        ...

    @property
    def uid(self) -> np.ndarray:
        """(N,) uint64."""
        ...


@dataclass(frozen=True)
class Cloud:
    """The plain `FrameArrays`."""

    means: np.ndarray
    quats: np.ndarray
    scales: np.ndarray
    opacities: np.ndarray
    rgb: np.ndarray
    object_id: np.ndarray
    uid: np.ndarray


@dataclass(frozen=True)
class Setting:
    """What stays the same over a run: frames T, objects, cameras of the source, up, what views turn about."""

    frames: int
    objects: tuple[SnapshotObject, ...]
    cameras: Cameras
    world_up: np.ndarray
    target: np.ndarray | None = None
    supervised: np.ndarray = field(default_factory=lambda: np.zeros((0, 3), np.float32))


def pack_now(now: FrameArrays, t: int, stage: str, step: int, setting: Setting) -> tuple[dict[str, Any], Arrays]:
    """Meta and arrays of the stream "now"."""
    cameras = setting.cameras
    meta = {
        "frame": t, "stage": stage, "step": step, "T": setting.frames, "size": list(cameras.size),
        "near": cameras.near, "far": cameras.far, "dilation": cameras.dilation,
        "objects": [[o.id, o.name, list(o.color), o.is_background] for o in setting.objects],
    }  # fmt: skip
    arrays = {
        "positions": _f4(now.means), "rotations": _f4(now.quats), "scales": _f4(now.scales),
        "opacities": _f4(now.opacities), "colours": _f4(now.rgb), "object_id": now.object_id.astype(np.uint16),
        "uid": now.uid.astype(np.uint64), "K": cameras.K.astype(np.float64),
        "world_to_camera": cameras.world_to_camera.astype(np.float64), "world_up": np.asarray(setting.world_up, float),
        "supervised": _f4(setting.supervised),
    }  # fmt: skip
    if setting.target is not None:
        arrays["target"] = np.asarray(setting.target, np.float64)
    return meta, arrays


def unpack_now(message: Message) -> SceneSnapshot:
    """The snapshot of a message of the stream "now", version 0."""
    meta, a = message.meta, message.arrays
    cameras = Cameras(a["K"], a["world_to_camera"], (int(meta["size"][0]), int(meta["size"][1])), meta["near"],
                      meta["far"], meta["dilation"])  # fmt: skip
    objects = tuple(SnapshotObject(int(i), n, (c[0], c[1], c[2]), bool(b)) for i, n, c, b in meta["objects"])
    return SceneSnapshot(
        version=0, frame=int(meta["frame"]), stage=meta["stage"], step=int(meta["step"]), T=int(meta["T"]),
        positions=a["positions"], rotations=a["rotations"], scales=a["scales"], opacities=a["opacities"],
        colours=a["colours"], object_id=a["object_id"], uid=a["uid"], objects=objects, cameras=cameras,
        world_up=a["world_up"], target=a.get("target"), supervised=a["supervised"],
    )  # fmt: skip


def pack_layers(frames: Sequence[FrameArrays], step: int) -> tuple[dict[str, Any], Arrays]:
    """Meta and arrays of the stream "layers": all T frames with the same rows."""
    first = frames[0]
    moving = int((first.object_id != 0).sum())
    colours = np.stack([f.rgb[:moving] for f in frames])
    still = np.abs(colours - colours[:1]).max(initial=0.0) < _COLOUR_STEP
    arrays = {
        "means": _f4(np.stack([f.means[:moving] for f in frames])),
        "quats": np.stack([f.quats[:moving] for f in frames]).astype(np.float16),
        "log_scales": np.log(np.maximum(np.stack([f.scales[:moving] for f in frames]), 1e-7)).astype(np.float16),
        "rgb": _f4(colours[0]) if still else colours.astype(np.float16),
        "opacities": _f4(first.opacities), "object_id": first.object_id.astype(np.uint16),
        "uid": first.uid.astype(np.uint64), "rest_means": _f4(first.means[moving:]),
        "rest_quats": _f4(first.quats[moving:]), "rest_scales": _f4(first.scales[moving:]),
        "rest_rgb": _f4(first.rgb[moving:]),
    }  # fmt: skip
    return {"step": step, "T": len(frames)}, arrays


class Layers:
    """Every frame as the worker last sent them: a `FrameSource`. Rows are those of the snapshot they came with."""

    def __init__(self, message: Message) -> None:
        self.arrays = message.arrays
        self.uid = message.arrays["uid"]
        self.step = int(message.meta["step"])
        self._index = np.unique(message.arrays["object_id"], return_inverse=True)[1]

    def __len__(self) -> int:
        return len(self.arrays["means"])

    def frame(self, t: int) -> Frame:
        """All Gaussians at frame t (0..T-1), world space, activated."""
        a = self.arrays
        rgb = a["rgb"] if a["rgb"].ndim == 2 else a["rgb"][t].astype(np.float32)
        scales = np.exp(a["log_scales"][t].astype(np.float32))
        return Frame(
            np.concatenate([a["means"][t], a["rest_means"]]),
            np.concatenate([a["quats"][t].astype(np.float32), a["rest_quats"]]),
            np.concatenate([scales, a["rest_scales"]]), a["opacities"], np.concatenate([rgb, a["rest_rgb"]]),
            self._index,
        )  # fmt: skip


def with_layers(snapshot: SceneSnapshot, layers: Layers | None, version: int) -> SceneSnapshot:
    """The snapshot under a version, knowing its other frames too if the layers are of the same Gaussians."""
    same = layers is not None and len(layers) == snapshot.T and np.array_equal(layers.uid, snapshot.uid)
    return replace(snapshot, version=version, frames=layers if same else None)


def _f4(values: np.ndarray) -> np.ndarray:
    return np.ascontiguousarray(values, np.float32)
