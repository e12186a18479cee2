"""The HDF5 layout `genmojo4d` as one table, and the checks every file must pass.

Version history of the format (the reader takes every 1.x and refuses 2.x):
  1.0  first: time, objects, gaussians, dense deformation, object_to_world, cameras, tracks, config, metrics.

T frames, N Gaussians grouped by object, K objects (background included), P tracks, M supervised views.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

FORMAT, VERSION = "genmojo4d", "1.0"
LARGEST = 1e9  # magnitude above which a number is no position, size or pixel
NEEDS_GAUSSIANS = ("/objects/", "/gaussians/", "/deformation/", "/object_to_world", "/depth_scale")


@dataclass(frozen=True)
class Field:
    """One dataset: numpy type ("S" = UTF-8 text of fixed length), symbolic shape and what it means.

    `needed`: must be there when its group is.
    """

    path: str
    dtype: str
    shape: tuple[str | int, ...]
    units: str
    description: str
    needed: bool = True


FIELDS = (
    Field("/time/frame_index", "i4", ("T",), "1", "number of the frame in the source"),
    Field("/time/seconds", "f8", ("T",), "s", "time stamp"),
    Field("/time/source_name", "S", ("T",), "", "file name or time label of the frame"),
    Field("/objects/id", "u2", ("K",), "1", "id in the source's masks, 0 = background"),
    Field("/objects/name", "S", ("K",), "", "name for people"),
    Field("/objects/class", "S", ("K",), "", "object or background"),
    Field("/objects/is_background", "u1", ("K",), "1", "1 for the background"),
    Field("/objects/color", "f4", ("K", 3), "1", "display colour, RGB 0..1"),
    Field("/objects/first", "i8", ("K",), "1", "first row of its Gaussians"),
    Field("/objects/count", "i8", ("K",), "1", "number of its Gaussians"),
    Field("/gaussians/xyz", "f4", ("N", 3), "scene", "canonical centre in object space"),
    Field("/gaussians/rot_wxyz", "f4", ("N", 4), "1", "canonical rotation, unit quaternion w x y z"),
    Field("/gaussians/scale", "f4", ("N", 3), "scene", "linear standard deviations"),
    Field("/gaussians/opacity", "f4", ("N",), "1", "opacity 0..1"),
    Field("/gaussians/sh", "f4", ("N", 1, 3), "1", "raw spherical harmonics, rgb = 0.5 + 0.28209479 dc"),
    Field("/gaussians/object_id", "u2", ("N",), "1", "id of the owner"),
    Field("/gaussians/uid", "u8", ("N",), "1", "stable identity over density control"),
    Field("/deformation/ref_frame", "i4", ("K",), "1", "position 0..T-1 of each object's canonical frame"),
    Field("/deformation/dense/d_xyz", "f4", ("T", "N", 3), "scene", "added to xyz, object space"),
    Field("/deformation/dense/rot_wxyz", "f2", ("T", "N", 4), "1", "absolute rotation in object space, w x y z"),
    Field("/deformation/dense/log_scale", "f2", ("T", "N", 3), "1", "added to log scale"),
    Field("/deformation/dense/d_sh", "f2", ("T", "N", 1, 3), "1", "added to sh", needed=False),
    Field("/object_to_world", "f4", ("T", "K", 3, 4), "scene", "[s R | t], s > 0: multiply scale by s, turn by R"),
    Field("/depth_scale", "f4", ("T", "K"), "1", "dolly factor, already inside object_to_world"),
    Field("/cameras/input/world_to_camera", "f8", ("T", 4, 4), "scene", "OpenCV axes: x right, y down, z forward"),
    Field("/cameras/input/K", "f8", ("T", 3, 3), "px", "intrinsics, raster pixels of size"),
    Field("/cameras/input/size", "i4", (2,), "px", "width, height"),
    Field("/cameras/input/range", "f8", (2,), "scene", "near, far"),
    Field("/cameras/supervision/elev", "f4", ("M",), "deg", "elevation of a supervised view, + = from above"),
    Field("/cameras/supervision/azim", "f4", ("M",), "deg", "azimuth, + = camera moves to its right"),
    Field("/cameras/supervision/frame", "i4", ("M",), "1", "frame position 0..T-1"),
    Field("/tracks/predicted/point_uid", "u8", ("P",), "1", "identity of the point"),
    Field("/tracks/predicted/uv", "f4", ("P", "T", 2), "px", "raster pixels of size, NaN where state is 0"),
    Field("/tracks/predicted/state", "u1", ("P", "T"), "1", "0 none, 1 visible, 2 occluded, 3 out of view"),
    Field("/tracks/predicted/object", "u2", ("P",), "1", "object id, 0 = background"),
    Field("/tracks/predicted/size", "i4", (2,), "px", "width, height that uv refers to"),
    Field("/tracks/predicted/xyz", "f4", ("P", "T", 3), "scene", "world position", needed=False),
    Field("/tracks/predicted/conf", "f4", ("P", "T"), "1", "confidence 0..1", needed=False),
    Field("/tracks/predicted/flags", "u1", ("P", "T"), "1", "1 human, 2 uncertain, 4 confirmed, 8 snapped",
          needed=False),
    Field("/tracks/predicted/source", "u1", ("P", "T"), "1", "who set it", needed=False),
    Field("/config/run", "S", (1,), "", "run configuration, JSON"),
    Field("/config/effects", "S", (1,), "", "effect plan, JSON"),
    Field("/config/curve", "S", (1,), "", "accuracy against time, JSON"),
    Field("/metrics/name", "S", ("R",), "", "name of a figure"),
    Field("/metrics/value", "f8", ("R",), "", "its value"),
)  # fmt: skip
BY_PATH = {field.path: field for field in FIELDS}
_NAN_ALLOWED = ("/tracks/predicted/uv", "/tracks/predicted/xyz")


def missing(present: set[str]) -> Iterator[str]:
    """What must be there and is not: /time always; of every other group everything needed, once one dataset is there.

    Gaussians, objects, deformation, placement and cameras come together; a file may hold tracks only.
    """
    groups = {path.rsplit("/", 1)[0] for path in present} | {"/time"}
    if any(path.startswith(NEEDS_GAUSSIANS) for path in present):
        groups |= {"/objects", "/gaussians", "/deformation", "/deformation/dense", "", "/cameras/input"}
    for field in FIELDS:
        if field.needed and field.path not in present and field.path.rsplit("/", 1)[0] in groups:
            yield f"{field.path} is missing"


def shape_faults(shapes: Mapping[str, tuple[tuple[int, ...], np.dtype]]) -> Iterator[str]:
    """Datasets of another type, rank or size than the table and the other datasets call for."""
    sizes: dict[str, int] = {}
    for field in FIELDS:
        if field.path not in shapes:
            continue
        shape, dtype = shapes[field.path]
        if not _type_fits(field.dtype, dtype):
            yield f"{field.path} holds {dtype}, expected {field.dtype}"
        if len(shape) != len(field.shape):
            yield f"{field.path} has {len(shape)} axes, expected {len(field.shape)}"
            continue
        for symbol, length in zip(field.shape, shape, strict=True):
            wanted = symbol if isinstance(symbol, int) else sizes.setdefault(symbol, length)
            if length != wanted:
                yield f"{field.path} has the shape {shape}, expected {symbol} = {wanted} on one axis"


def value_faults(arrays: Mapping[str, np.ndarray]) -> Iterator[str]:
    """Numbers that cannot be: not finite, absurdly large, quaternions of length 0, rows that do not add up."""
    for path, array in arrays.items():
        if array.dtype.kind == "f" and path not in _NAN_ALLOWED:
            yield from _number_faults(path, array)
    yield from _time_faults(arrays)
    if "/gaussians/xyz" in arrays:
        yield from _gaussian_faults(arrays)
    if "/tracks/predicted/uv" in arrays:
        yield from _track_faults(arrays)


def _type_fits(wanted: str, dtype: np.dtype) -> bool:
    """Text is fixed-length bytes; floats may have another width; integers must be of the same kind."""
    if wanted == "S":
        return dtype.kind == "S"
    return np.dtype(wanted).kind == dtype.kind and dtype.itemsize <= 8


def _number_faults(path: str, array: np.ndarray) -> Iterator[str]:
    """The first number that is not finite or larger than LARGEST."""
    bad = ~(np.abs(array) < (LARGEST if array.dtype.itemsize > 2 else np.inf))  # half floats end at 65504
    if bad.any():
        place = tuple(int(i) for i in np.argwhere(bad)[0])
        yield f"{path} has {int(bad.sum())} numbers that are not finite or over {LARGEST:g}, the first at {place}"


def _time_faults(arrays: Mapping[str, np.ndarray]) -> Iterator[str]:
    """At least one frame; numbers and time stamps grow."""
    index, seconds = arrays["/time/frame_index"], arrays["/time/seconds"]
    if len(index) == 0:
        yield "/time holds no frame"
    if (np.diff(index.astype(np.int64)) <= 0).any():
        yield "/time/frame_index does not grow"
    if (np.diff(seconds) <= 0).any():
        yield "/time/seconds does not grow"


def _gaussian_faults(arrays: Mapping[str, np.ndarray]) -> Iterator[str]:
    """Ranges of activated values, ownership of rows, placements that are similarities."""
    for path in ("/gaussians/rot_wxyz", "/deformation/dense/rot_wxyz"):
        if (np.abs(arrays[path].astype(np.float32)).max(axis=-1, initial=0) < 1e-3).any():
            yield f"{path} has quaternions of length 0"
    if (arrays["/gaussians/scale"] <= 0).any():
        yield "/gaussians/scale has values that are not positive"
    opacity = arrays["/gaussians/opacity"]
    if ((opacity < 0) | (opacity > 1)).any():
        yield "/gaussians/opacity leaves 0..1"
    first, count, ids = arrays["/objects/first"], arrays["/objects/count"], arrays["/objects/id"]
    if (count < 0).any() or not np.array_equal(first, np.cumsum(count) - count) or count.sum() != len(opacity):
        yield "/objects/first and count do not divide the Gaussians"
    elif not np.array_equal(arrays["/gaussians/object_id"], np.repeat(ids, count)):
        yield "/gaussians/object_id disagrees with /objects"
    if (np.linalg.det(arrays["/object_to_world"][..., :3].astype(np.float64)) <= 0).any():
        yield "/object_to_world has a matrix that is no similarity (determinant not positive)"
    ref = arrays["/deformation/ref_frame"]
    if ((ref < 0) | (ref >= len(arrays["/time/seconds"]))).any():
        yield "/deformation/ref_frame names a frame that is not there"


def _track_faults(arrays: Mapping[str, np.ndarray]) -> Iterator[str]:
    """States are 0..3 and every point with a state has a position."""
    uv, state = arrays["/tracks/predicted/uv"], arrays["/tracks/predicted/state"]
    if (state > 3).any():
        yield "/tracks/predicted/state holds values over 3"
    bad = ~(np.abs(uv) < LARGEST).all(axis=-1) & (state > 0)
    if bad.any():
        point, frame = (int(i) for i in np.argwhere(bad)[0])
        yield f"/tracks/predicted/uv is not a position at track {point}, frame {frame}"
    if (arrays["/tracks/predicted/size"] <= 0).any():
        yield "/tracks/predicted/size is not positive"
