"""Scene files: write, read, validate and inspect `genmojo4d` HDF5 (VIEWER.md section 5.1, ARCHITECTURE.md section 6).

A file is built in memory (a full disk can crash HDF5 itself, RELIABILITY.md b), written beside its target, reopened,
compared value by value, and only then renamed. fletcher32 plus the newer format catch every flipped bit; all texts
have fixed length, because HDF5 keeps texts of free length in heaps without a checksum.
"""

from __future__ import annotations

import io
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from genmojo_core import __version__
from genmojo_core.errors import GenmojoError
from genmojo_core.store import scene_codec, scene_layout
from genmojo_core.store.atomic import staged
from genmojo_core.store.safe import DAMAGE, MAX_RATIO, RATIO_FROM_BYTES, open_hdf5, read_array
from genmojo_core.store.scene_file import BakedScene

_CHUNK_ROWS = 16384
_ATTRIBUTES = (
    "dilation_px2",
    "format",
    "version",
    "generator",
    "created_utc",
    "run_uuid",
    "complete",
    "up",
    "pixel_aspect",
)


def write(scene: BakedScene, path: str | Path) -> None:
    """Write a scene; when this returns, the file was flushed to disk, reopened and found equal.

    Rotations, scale changes and colour changes over time are kept as float16 (attribute `max_abs_error`).
    Raises GenmojoError: "io" where it cannot be written, "value" or "camera" for a scene that is none.
    """
    arrays = scene_codec.encode(scene)
    faults = list(_faults_of(arrays))
    if faults:
        raise GenmojoError("value", f"this scene cannot be saved: {faults[0]}", str(path))
    image = _build(arrays, _attributes(scene), scene_codec.rounding(scene, arrays), scene.fps)
    with staged(path) as part:
        part.write_bytes(image)
        _compare(part, arrays)


def read(path: str | Path) -> BakedScene:
    """Read a scene somebody wrote, suspiciously.

    A file without Gaussians (tracks only) gives a scene with N = 0 and K = 0. Raises GenmojoError in one sentence for
    everything that is missing, foreign, damaged, linked elsewhere, too large or impossible.
    """
    with open_hdf5(path) as file:
        attributes = _header(file, path)
        arrays, faults = _load(file, path)
    faults += list(_faults_of(arrays)) if not faults else []
    if faults:
        more = f" (and {len(faults) - 1} more faults)" if len(faults) > 1 else ""
        raise GenmojoError("schema", f"{faults[0]}{more}", str(path), "see genmojo validate")
    return scene_codec.decode(arrays, attributes, str(path))


def validate(path: str | Path) -> list[str]:
    """All faults of a file as sentences; empty for a good one. Never raises for what is in the file."""
    try:
        with open_hdf5(path) as file:
            attributes = _header(file, path)
            arrays, faults = _load(file, path)
        if not faults:
            faults = list(_faults_of(arrays))
        if not faults:
            scene_codec.decode(arrays, attributes, str(path))
    except GenmojoError as error:
        return [error.sentence()]
    return [f"{path}: {fault}." for fault in faults]


def inspect(path: str | Path) -> dict[str, Any]:
    """What a file holds, as plain data: format, frames, objects, counts, sizes of datasets, run, effects, metrics."""
    scene = read(path)
    with open_hdf5(path) as file:
        datasets: list[dict[str, Any]] = []
        file.visititems(lambda name, item: datasets.append(_describe(name, item)) if _is_data(item) else None)
        attributes = _header(file, path)
    tracks = scene.predicted
    return {
        "format": attributes["format"], "version": attributes["version"], "generator": scene.generator,
        "created_utc": scene.created_utc, "run_uuid": scene.run_uuid, "frames": len(scene),
        "first_frame": int(scene.frame_index[0]), "last_frame": int(scene.frame_index[-1]), "fps": scene.fps,
        "size": list(scene.cameras.size), "gaussians": len(scene.xyz),
        "tracks": 0 if tracks is None else len(tracks.xy),
        "objects": [{"id": o.id, "name": o.name, "background": o.is_background, "gaussians": o.count}
                    for o in scene.objects],
        "bytes": Path(path).stat().st_size, "datasets": datasets, "config": scene.config, "effects": scene.effects,
        "metrics": scene.metrics, "curve_points": len(scene.curve),
    }  # fmt: skip


def _faults_of(arrays: dict[str, np.ndarray]) -> Iterator[str]:
    """All checks that need no file: presence, shapes, values. Later checks run only where earlier ones passed."""
    found = False
    for fault in scene_layout.missing(set(arrays)):
        found = True
        yield fault
    for fault in scene_layout.shape_faults({p: (a.shape, a.dtype) for p, a in arrays.items()}):
        found = True
        yield fault
    if not found:
        yield from scene_layout.value_faults(arrays)


def _attributes(scene: BakedScene) -> dict[str, Any]:
    """Root attributes: conventions any reader needs, and provenance."""
    return {
        "format": scene_layout.FORMAT, "version": scene_layout.VERSION,
        "generator": scene.generator or f"genmojo {__version__}", "created_utc": scene.created_utc,
        "run_uuid": scene.run_uuid, "up": np.asarray(scene.world_up, np.float64), "handedness": "right",
        "camera": "opencv_w2c", "units": "scene", "elevation_sign": "+up", "sort_key": "view_z",
        "dilation_px2": float(scene.cameras.dilation), "alpha_min": 1 / 255, "alpha_max": 0.99, "aa_mode": "classic",
        "pixel_aspect": float(scene.pixel_aspect),
    }  # fmt: skip


def _build(
    arrays: dict[str, np.ndarray], attributes: dict[str, Any], errors: dict[str, float], fps: float
) -> memoryview:
    """The bytes of the file; `complete` = 1 is the last thing put in."""
    memory = io.BytesIO()
    with h5py.File(memory, "w", libver=("v110", "v110")) as file:
        for path, array in arrays.items():
            field = scene_layout.BY_PATH[path]
            dataset = file.create_dataset(path, data=array, **_storage(array))
            axes = " ".join(str(symbol) for symbol in field.shape)
            for key, text in {"units": field.units, "axes": axes, "description": field.description}.items():
                _set_text(dataset, key, text)
            if path.startswith("/gaussians/"):
                _set_text(dataset, "activation", "applied")
            if path in errors:
                dataset.attrs["max_abs_error"] = errors[path]
        file["time"].attrs["fps"] = float(fps)
        if "deformation" in file:
            _set_text(file["deformation"], "mode", "dense")
            _set_text(file["deformation"], "space", "object")
        for key, value in attributes.items():
            if isinstance(value, str):
                _set_text(file, key, value)
            else:
                file.attrs[key] = value
        file.attrs["complete"] = 1
    return memory.getbuffer()


def _storage(array: np.ndarray) -> dict[str, Any]:
    """Chunks of one frame by 16384 rows, checksums, gzip; raw only where zeros would look like a decompression bomb."""
    if array.size == 0:
        return {}
    chunks = tuple(min(n, _CHUNK_ROWS) if axis == 0 else n for axis, n in enumerate(array.shape))
    if array.ndim >= 3 and array.nbytes > 1 << 12:
        chunks = (1, min(array.shape[1], _CHUNK_ROWS), *array.shape[2:])
    nearly_constant = array.nbytes > RATIO_FROM_BYTES and np.count_nonzero(array) * MAX_RATIO < 8 * array.size
    packed = {} if nearly_constant else {"compression": "gzip", "compression_opts": 4, "shuffle": True}
    return {"chunks": chunks, "fletcher32": True, **packed}


def _set_text(item: h5py.HLObject, key: str, text: str) -> None:
    """A text attribute of fixed length (checksummed with its object, unlike texts of free length)."""
    data = text.encode("utf-8") or b" "
    item.attrs.create(key, np.array(data, dtype=h5py.string_dtype("utf-8", len(data))))


def _compare(part: Path, arrays: dict[str, np.ndarray]) -> None:
    """Reopen what was written and compare every value. Raises GenmojoError("corrupt") on any difference."""
    with open_hdf5(part) as file:
        _header(file, part)
        for path, array in arrays.items():
            if path not in file or read_array(file[path], path).tobytes() != array.tobytes():
                raise GenmojoError("corrupt", "what was written does not read back the same", path, "check the disk")


def _header(file: h5py.File, path: str | Path) -> dict[str, Any]:
    """The root attributes after checking that this is a finished genmojo4d 1.x file."""
    try:
        found = {key: _attribute(file, key) for key in _ATTRIBUTES if key in file.attrs}
        if "time" in file and "fps" in file["time"].attrs:
            found["fps"] = _attribute(file["time"], "fps")
    except DAMAGE as error:
        raise GenmojoError("corrupt", "its attributes are damaged", str(path), "copy or make the file again") from error
    if found.get("format") != scene_layout.FORMAT:
        raise GenmojoError("format", "is an HDF5 file but no genmojo4d scene", str(path))
    version = str(found.get("version", ""))
    if version.split(".")[0] != scene_layout.VERSION.split(".")[0]:
        raise GenmojoError("version", f"has format version '{version}', this program reads {scene_layout.VERSION}",
                           str(path), "update the program")  # fmt: skip
    if found.get("complete") != 1:
        raise GenmojoError("corrupt", "was not finished by the program that wrote it", str(path), "make it again")
    return found


def _attribute(file: h5py.Group, key: str) -> Any:
    """A text, a number or a short vector; anything else is refused."""
    value = file.attrs[key]
    if isinstance(value, bytes | np.bytes_):
        return value.decode("utf-8").strip()
    if isinstance(value, str):
        return value.strip()
    array = np.asarray(value)
    if array.dtype.kind not in "iuf" or array.size > 16 or not np.isfinite(array).all():
        raise ValueError(f"attribute {key}")
    return array if array.ndim else array.item()


def _load(file: h5py.File, path: str | Path) -> tuple[dict[str, np.ndarray], list[str]]:
    """All datasets of the table, once types and shapes fit; unknown ones are left alone. Returns arrays and faults."""
    shapes = {}
    for field in scene_layout.FIELDS:
        item = file.get(field.path)
        if isinstance(item, h5py.Dataset):
            shapes[field.path] = (item.shape or (), item.dtype)
    faults = list(scene_layout.missing(set(shapes))) + list(scene_layout.shape_faults(shapes))
    if faults:
        return {}, faults
    return {name: read_array(file[name], f"{path}:{name}") for name in shapes}, []


def _is_data(item: h5py.HLObject) -> bool:
    """True for datasets."""
    return isinstance(item, h5py.Dataset)


def _describe(name: str, dataset: h5py.Dataset) -> dict[str, Any]:
    """One dataset for `inspect`."""
    return {"path": f"/{name}", "shape": list(dataset.shape), "dtype": str(dataset.dtype),
            "bytes": math.prod(dataset.shape) * dataset.dtype.itemsize,
            "stored": dataset.id.get_storage_size()}  # fmt: skip
