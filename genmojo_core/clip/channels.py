"""Depth, cameras and flow that lie beside a clip, brought to the size of the frames read."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from genmojo_core.clip import resize
from genmojo_core.clip.cameras import Cameras, check_cameras
from genmojo_core.clip.clip import Channel
from genmojo_core.clip.limits import ASPECT_TOLERANCE, DEPTH_RANGE, FLOW_MOST
from genmojo_core.clip.npz import NpzFile, open_npz
from genmojo_core.clip.pictures import Pictures
from genmojo_core.errors import GenmojoError


@dataclass(frozen=True)
class GivenCameras:
    """Cameras for the frames read and the clip's up direction, (3,) unit, world coordinates."""

    channel: Channel
    world_up: np.ndarray


def depth(path: Path, pictures: Pictures) -> Channel:
    """(T, h, w) float32 z of an npz with `depth` or MegaSaM's `depths`, (total, H, W) of any resolution.

    Valid are finite values within limits.DEPTH_RANGE; elsewhere the value is the median of the valid ones.
    Raises GenmojoError: as `open_npz`; "schema" for a wrong rank, type, count or picture shape; "empty" if no value of
    the frames read is valid.
    """
    file = open_npz(path)
    name = file.first_of("depth", "depths") or "depth"
    where = file.where(name)
    _check_planes(file, name, pictures, (pictures.total,), 3)
    count, height, width = pictures.frames.shape[:3]
    value = np.ones((count, height, width), np.float32)
    valid = np.zeros((count, height, width), bool)
    for t, plane in enumerate(_read(file, name, pictures.positions)):
        plane = plane.astype(np.float32)
        good = np.isfinite(plane) & (plane > DEPTH_RANGE[0]) & (plane < DEPTH_RANGE[1])
        value[t], valid[t] = resize.nearest_valid(plane, good, (width, height))
    if not valid.any():
        raise GenmojoError("empty", "holds no valid depth (0 % of its values are finite and positive)", where,
                           "take the file away or use --ignore depth")  # fmt: skip
    value[~valid] = np.median(value[valid][:: max(1, int(valid.sum()) // 100_000)])
    return Channel(value, valid, f"given: {path}")


def cameras(path: Path, pictures: Pictures) -> GivenCameras:
    """Cameras of the frames read from an npz: ours (`K`, `world_to_camera`, optional `world_up` and `size`) or
    MegaSaM's (`intrinsic`, `cam_c2w`, with the size of its `images` or `depths`).

    K is in pixels of `size` (W, H), by default the source's. World up is by default minus y of the clip's camera 0.
    Raises GenmojoError: as `open_npz`; "schema" for wrong ranks; "camera" where a camera is no camera.
    """
    file = open_npz(path)
    ours = "world_to_camera" in file or "cam_c2w" not in file
    K = _numbers(file, "K" if ours else "intrinsic")
    poses = _numbers(file, "world_to_camera" if ours else "cam_c2w")
    if K.shape[-2:] != (3, 3) or K.ndim > 3 or poses.shape[1:] != (4, 4):
        raise GenmojoError("schema", f"holds intrinsics {K.shape} and poses {poses.shape}", str(path),
                           "store K as (3, 3) or (T, 3, 3) and world_to_camera as (T, 4, 4)")  # fmt: skip
    if K.ndim == 2:
        K = np.repeat(K[None], len(poses), axis=0)
    size = _camera_size(file, pictures)
    if not ours:
        poses = _inverted(poses, str(path))
    whole = Cameras(K, poses, size)
    check_cameras(whole, pictures.total, str(path))
    held = whole.resized(pictures.frames.shape[2], pictures.frames.shape[1]).selected(pictures.positions)
    channel = Channel(held, np.ones(len(held), bool), f"given: {path}")
    return GivenCameras(channel, _world_up(file, poses[0]))


def flow(path: Path, pictures: Pictures) -> Channel:
    """(T, h, w, 2) float32 flow to the next frame in pixels of the frames read, from an npz with `flow`.

    `flow` is (total - 1 or total, H, W, 2) of any resolution, dx dy in its own pixels; `valid` (bool) or `confidence`
    (0..1 or uint8, valid from a half) may be beside it. The last frame read has none.
    Raises GenmojoError as `depth`.
    """
    file = open_npz(path)
    _check_planes(file, "flow", pictures, (pictures.total - 1, pictures.total), 4)
    count, height, width = pictures.frames.shape[:3]
    value = np.zeros((count, height, width, 2), np.float32)
    valid = np.zeros((count, height, width), bool)
    trust = file.first_of("valid", "confidence")
    followed = pictures.positions[:-1]
    planes = _read(file, "flow", followed)
    trusts = _read(file, trust, followed) if trust else iter(())
    shape = file.headers["flow"].shape
    if trust and file.headers[trust].shape != shape[:3]:
        raise GenmojoError("schema", f"is {file.headers[trust].shape} beside a flow of {shape}", file.where(trust),
                           "give one value per pixel")  # fmt: skip
    scale = np.array([width / shape[2], height / shape[1]], np.float32)
    for t, plane in enumerate(planes):
        plane = plane.astype(np.float32)
        length = np.hypot(plane[..., 0], plane[..., 1])
        good = np.isfinite(length) & (length < FLOW_MOST * np.hypot(shape[1], shape[2]))
        if trust:
            good &= _trusted(next(trusts))
        if followed[t] + 1 != pictures.positions[t + 1]:
            continue  # the next frame could not be decoded
        small = resize.nearest(good, (width, height))
        valid[t] = small
        value[t][small] = (resize.nearest(plane, (width, height)) * scale)[small]
    return Channel(value, valid, f"given: {path}")


def _check_planes(file: NpzFile, name: str, pictures: Pictures, counts: tuple[int, ...], rank: int) -> None:
    """Rank, number of frames, type and picture shape of a per-pixel array."""
    where = file.where(name)
    if name not in file:
        file.array(name)  # says what is there instead
    header = file.headers[name]
    if len(header.shape) != rank or (rank == 4 and header.shape[3] != 2) or 0 in header.shape[1:]:
        raise GenmojoError("schema", f"has the shape {header.shape}", where,
                           "give (T, H, W)" if rank == 3 else "give (T, H, W, 2)")  # fmt: skip
    if header.dtype.kind != "f" and not (header.dtype.kind in "iu" and header.dtype.itemsize > 1):
        raise GenmojoError("schema", f"is stored as {header.dtype}", where, "store floating point numbers")
    if header.shape[0] not in counts:
        raise GenmojoError("schema", f"holds {header.shape[0]} frames for a clip of {pictures.total}", where,
                           "give one plane per frame")  # fmt: skip
    ratio = (header.shape[2] / header.shape[1]) / (pictures.source_size[0] / pictures.source_size[1])
    slack = max(ASPECT_TOLERANCE, 1.5 / min(header.shape[1:3]))
    if not 1 - slack <= ratio <= 1 + slack:
        raise GenmojoError("schema", f"is {header.shape[2]} x {header.shape[1]}, another shape than the frames' "
                           f"{pictures.source_size[0]} x {pictures.source_size[1]}", where,
                           "give it in the frames' shape")  # fmt: skip


def _read(file: NpzFile, name: str, positions: np.ndarray) -> Iterator[np.ndarray]:
    """Planes of some frames in rising order, one in memory at a time."""
    if not len(positions):
        return
    first = int(positions[0])
    wanted = set(positions.tolist())
    for i, plane in enumerate(file.rows(name, first, int(positions[-1]) + 1), first):
        if i in wanted:
            yield plane


def _trusted(plane: np.ndarray) -> np.ndarray:
    """Validity of a bool, 0..1 or 0..255 plane."""
    if plane.dtype == np.uint8:
        return plane > 127
    return plane if plane.dtype == bool else plane >= 0.5


def _numbers(file: NpzFile, name: str) -> np.ndarray:
    """An array as float64; raises GenmojoError("schema") if it is not numeric."""
    array = file.array(name)
    if array.dtype.kind not in "fiu":
        raise GenmojoError("schema", f"is stored as {array.dtype}", file.where(name), "store floating point numbers")
    return array.astype(np.float64)


def _camera_size(file: NpzFile, pictures: Pictures) -> tuple[int, int]:
    """(width, height) that K refers to."""
    if "size" in file:
        size = _numbers(file, "size").ravel()
        if size.shape != (2,) or not (np.isfinite(size) & (size >= 1)).all():
            raise GenmojoError("camera", "is no (width, height)", file.where("size"), "store two positive numbers")
        return int(size[0]), int(size[1])
    picture = file.first_of("images", "depths")
    if picture is not None and len(file.headers[picture].shape) >= 3:
        return file.headers[picture].shape[2], file.headers[picture].shape[1]
    return pictures.source_size


def _inverted(poses: np.ndarray, where: str) -> np.ndarray:
    """(T, 4, 4) inverse; raises GenmojoError("camera") where there is none."""
    try:
        return np.linalg.inv(poses)
    except np.linalg.LinAlgError as error:
        raise GenmojoError("camera", "holds a pose that cannot be inverted", where, "check cam_c2w") from error


def _world_up(file: NpzFile, first_pose: np.ndarray) -> np.ndarray:
    """(3,) unit up."""
    if "world_up" not in file:
        return -first_pose[1, :3]
    up = _numbers(file, "world_up").ravel()
    length = np.linalg.norm(up) if up.shape == (3,) and np.isfinite(up).all() else 0.0
    if length < 1e-9:
        raise GenmojoError("camera", "is no direction", file.where("world_up"), "store three numbers, not all zero")
    return up / length
