"""`BakedScene` to and from the arrays of a scene file (scene_layout.py names them)."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from genmojo_core.clip.cameras import Cameras, check_cameras
from genmojo_core.conventions import DILATION, normalise_quaternions
from genmojo_core.errors import GenmojoError
from genmojo_core.store.safe import json_text, parse_json
from genmojo_core.store.scene_file import BakedScene, SceneObject
from genmojo_core.tracks.model import PointTracks

MAX_DILATION = 1e6  # px^2; a scene optimised at 2 px for a 4k clip stays under it

_HALF = {"/deformation/dense/rot_wxyz": "rot_t", "/deformation/dense/log_scale": "log_scale_t",
         "/deformation/dense/d_sh": "d_dc"}  # fmt: skip


def encode(scene: BakedScene) -> dict[str, np.ndarray]:
    """Path -> array in the file's types. A scene without Gaussians gives time, cameras, tracks and texts only.

    Raises GenmojoError("camera") for cameras that are none.
    """
    check_cameras(scene.cameras, len(scene), "scene")
    names, values = list(scene.metrics), list(scene.metrics.values())
    arrays = {
        "/time/frame_index": np.asarray(scene.frame_index, "i4"),
        "/time/seconds": np.asarray(scene.seconds, "f8"),
        "/time/source_name": _texts(scene.source_names),
        "/cameras/input/world_to_camera": np.asarray(scene.cameras.world_to_camera, "f8"),
        "/cameras/input/K": np.asarray(scene.cameras.K, "f8"),
        "/cameras/input/size": np.array(scene.cameras.size, "i4"),
        "/cameras/input/range": np.array([scene.cameras.near, scene.cameras.far], "f8"),
        "/cameras/supervision/elev": np.asarray(scene.supervised[:, 0], "f4"),
        "/cameras/supervision/azim": np.asarray(scene.supervised[:, 1], "f4"),
        "/cameras/supervision/frame": np.asarray(scene.supervised[:, 2], "i4"),
        "/config/run": _texts([json_text(scene.config)]),
        "/config/effects": _texts([json_text(scene.effects)]),
        "/config/curve": _texts([json_text(scene.curve)]),
        "/metrics/name": _texts(names),
        "/metrics/value": np.array([v if math.isfinite(v) else 0.0 for v in values], "f8"),
    }
    if len(scene.xyz):
        arrays |= _encode_gaussians(scene)
    if scene.predicted is not None:
        arrays |= _encode_tracks(scene.predicted)
    return arrays


def decode(arrays: Mapping[str, np.ndarray], attributes: Mapping[str, Any], where: str) -> BakedScene:
    """The scene of checked arrays. Raises GenmojoError for cameras or texts that cannot be."""
    frames = len(arrays["/time/seconds"])
    cameras = _decode_cameras(arrays, frames)
    check_cameras(cameras, frames, where)
    dilation = float(attributes.get("dilation_px2", DILATION))
    if not 0.0 <= dilation < MAX_DILATION:
        raise GenmojoError("value", f"the attribute dilation_px2 is {dilation:g}", where)
    cameras = replace(cameras, dilation=dilation)
    up = np.asarray(attributes.get("up", (0.0, -1.0, 0.0)), np.float64).reshape(-1)
    if up.shape != (3,) or abs(np.linalg.norm(up) - 1) > 1e-3:
        raise GenmojoError("schema", "the attribute up is no unit vector", where)
    names = _strings(arrays.get("/metrics/name", np.zeros(0, "S1")))
    supervision = [arrays.get(f"/cameras/supervision/{key}", np.zeros(0)) for key in ("elev", "azim", "frame")]
    return BakedScene(
        frame_index=arrays["/time/frame_index"].astype(np.int64),
        seconds=arrays["/time/seconds"].astype(np.float64),
        source_names=tuple(_strings(arrays["/time/source_name"])),
        **_decode_gaussians(arrays, frames),
        cameras=cameras,
        world_up=up,
        supervised=np.stack(supervision, axis=-1).astype(np.float32),
        predicted=_decode_tracks(arrays),
        config=_decode_json(arrays, "/config/run", where, dict),
        effects=_decode_json(arrays, "/config/effects", where, list),
        curve=_decode_json(arrays, "/config/curve", where, list),
        metrics=dict(zip(names, arrays.get("/metrics/value", np.zeros(0)).tolist(), strict=True)),
        fps=float(attributes.get("fps", 24.0)),
        pixel_aspect=float(attributes.get("pixel_aspect", 1.0)),
        run_uuid=str(attributes.get("run_uuid", "")),
        created_utc=str(attributes.get("created_utc", "")),
        generator=str(attributes.get("generator", "")),
    )


def rounding(scene: BakedScene, arrays: Mapping[str, np.ndarray]) -> dict[str, float]:
    """Largest absolute error of every array kept in half precision."""
    errors = {}
    for path, name in _HALF.items():
        if path in arrays:
            exact = np.asarray(getattr(scene, name), np.float32)
            exact = normalise_quaternions(exact) if name == "rot_t" else exact
            errors[path] = float(np.abs(arrays[path].astype(np.float32).reshape(exact.shape) - exact).max(initial=0))
    return errors


def _encode_gaussians(scene: BakedScene) -> dict[str, np.ndarray]:
    """Objects, canonical Gaussians, baked motion and placement."""
    objects = scene.objects
    arrays = {
        "/objects/id": np.array([o.id for o in objects], "u2"),
        "/objects/name": _texts([o.name for o in objects]),
        "/objects/class": _texts(["background" if o.is_background else "object" for o in objects]),
        "/objects/is_background": np.array([o.is_background for o in objects], "u1"),
        "/objects/color": np.array([o.color for o in objects], "f4").reshape(-1, 3),
        "/objects/first": np.array([o.first for o in objects], "i8"),
        "/objects/count": np.array([o.count for o in objects], "i8"),
        "/gaussians/xyz": np.asarray(scene.xyz, "f4"),
        "/gaussians/rot_wxyz": normalise_quaternions(np.asarray(scene.rot, "f4")),
        "/gaussians/scale": np.asarray(scene.scale, "f4"),
        "/gaussians/opacity": np.asarray(scene.opacity, "f4"),
        "/gaussians/sh": np.asarray(scene.dc, "f4")[:, None, :],
        "/gaussians/object_id": np.repeat([o.id for o in objects], [o.count for o in objects]).astype("u2"),
        "/gaussians/uid": np.asarray(scene.uid, "u8"),
        "/deformation/ref_frame": np.asarray(scene.ref_frame, "i4"),
        "/deformation/dense/d_xyz": np.asarray(scene.d_xyz, "f4"),
        "/deformation/dense/rot_wxyz": normalise_quaternions(np.asarray(scene.rot_t, "f4")).astype("f2"),
        "/deformation/dense/log_scale": np.asarray(scene.log_scale_t, "f2"),
        "/object_to_world": np.asarray(scene.object_to_world, "f4"),
        "/depth_scale": np.asarray(scene.depth_scale, "f4"),
    }
    if scene.d_dc is not None:
        arrays["/deformation/dense/d_sh"] = np.asarray(scene.d_dc, "f2")[:, :, None, :]
    return arrays


def _decode_gaussians(arrays: Mapping[str, np.ndarray], frames: int) -> dict[str, Any]:
    """The fields of `BakedScene` that speak of Gaussians; empty ones if the file holds tracks only."""

    def get(path: str, *shape: int) -> np.ndarray:
        return arrays[path].astype(np.float32) if path in arrays else np.zeros(shape, np.float32)

    objects: tuple[SceneObject, ...] = ()
    if "/objects/id" in arrays:
        columns = [arrays[f"/objects/{key}"] for key in ("id", "color", "is_background", "first", "count")]
        objects = tuple(
            SceneObject(int(i), name, (float(c[0]), float(c[1]), float(c[2])), bool(b), int(first), int(count))
            for name, (i, c, b, first, count) in zip(
                _strings(arrays["/objects/name"]), zip(*columns, strict=True), strict=True
            )
        )
    d_sh = arrays.get("/deformation/dense/d_sh")
    return {
        "objects": objects,
        "xyz": get("/gaussians/xyz", 0, 3),
        "rot": normalise_quaternions(get("/gaussians/rot_wxyz", 0, 4)),
        "scale": get("/gaussians/scale", 0, 3),
        "opacity": get("/gaussians/opacity", 0),
        "dc": get("/gaussians/sh", 0, 1, 3)[:, 0],
        "uid": arrays.get("/gaussians/uid", np.zeros(0)).astype(np.uint64),
        "d_xyz": get("/deformation/dense/d_xyz", frames, 0, 3),
        "rot_t": normalise_quaternions(get("/deformation/dense/rot_wxyz", frames, 0, 4)),
        "log_scale_t": get("/deformation/dense/log_scale", frames, 0, 3),
        "object_to_world": get("/object_to_world", frames, 0, 3, 4),
        "depth_scale": get("/depth_scale", frames, 0),
        "ref_frame": arrays.get("/deformation/ref_frame", np.zeros(0)).astype(np.int64),
        "d_dc": None if d_sh is None else d_sh[:, :, 0].astype(np.float32),
    }


def _decode_cameras(arrays: Mapping[str, np.ndarray], frames: int) -> Cameras:
    """Input cameras; a file of tracks without cameras gets one that stands still, with the tracks' image size."""
    if "/cameras/input/K" in arrays:
        width, height = (int(n) for n in arrays["/cameras/input/size"])
        near, far = (float(x) for x in arrays["/cameras/input/range"])
        poses = arrays["/cameras/input/world_to_camera"].astype(np.float64)
        return Cameras(arrays["/cameras/input/K"].astype(np.float64), poses, (width, height), near, far)
    width, height = (int(n) for n in arrays.get("/tracks/predicted/size", np.array([1, 1])))
    focal = float(max(width, height))
    lens = np.array([[focal, 0, width / 2], [0, focal, height / 2], [0, 0, 1]])
    return Cameras(np.tile(lens, (frames, 1, 1)), np.tile(np.eye(4), (frames, 1, 1)), (width, height))


def _encode_tracks(tracks: PointTracks) -> dict[str, np.ndarray]:
    """/tracks/predicted."""
    root = "/tracks/predicted"
    arrays = {
        f"{root}/point_uid": np.arange(len(tracks.xy), dtype="u8"),
        f"{root}/uv": np.asarray(tracks.xy, "f4"),
        f"{root}/state": np.asarray(tracks.state, "u1"),
        f"{root}/object": np.asarray(tracks.object, "u2"),
        f"{root}/size": np.array(tracks.size, "i4"),
    }
    optional = {"xyz": (tracks.xyz, "f4"), "conf": (tracks.conf, "f4"), "flags": (tracks.flags, "u1"),
                "source": (tracks.source, "u1")}  # fmt: skip
    for key, (value, dtype) in optional.items():
        if value is not None:
            arrays[f"{root}/{key}"] = np.asarray(value, dtype)
    return arrays


def _decode_tracks(arrays: Mapping[str, np.ndarray]) -> PointTracks | None:
    """Point tracks, if the file has some."""
    root = "/tracks/predicted"
    if f"{root}/uv" not in arrays:
        return None
    width, height = (int(n) for n in arrays[f"{root}/size"])
    optional = [arrays.get(f"{root}/{key}") for key in ("xyz", "conf", "flags", "source")]
    return PointTracks(arrays[f"{root}/uv"].astype(np.float32), arrays[f"{root}/state"].astype(np.uint8),
                       arrays[f"{root}/object"].astype(np.int64), (width, height), *optional)  # fmt: skip


def _texts(texts: Sequence[str]) -> np.ndarray:
    """Texts as fixed-length UTF-8."""
    encoded = [text.replace("\0", "").encode("utf-8") for text in texts]
    return np.array(encoded, dtype=f"S{max([1, *map(len, encoded)])}")


def _strings(encoded: np.ndarray) -> list[str]:
    """Texts of fixed-length UTF-8; bytes that are no UTF-8 show as replacement characters."""
    return [bytes(text).decode("utf-8", errors="replace") for text in encoded]


def _decode_json(arrays: Mapping[str, np.ndarray], path: str, where: str, kind: type) -> Any:
    """A JSON text of the file; an empty one if absent. Raises GenmojoError("format")."""
    if path not in arrays:
        return kind()
    value = parse_json(bytes(arrays[path][0]), f"{where}:{path}")
    if not isinstance(value, kind):
        raise GenmojoError("format", f"is no JSON {kind.__name__}", f"{where}:{path}")
    return value
