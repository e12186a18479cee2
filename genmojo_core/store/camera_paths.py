"""Camera paths in scene files (/cameras/paths/<name>) and as JSON files."""

from __future__ import annotations

import io
import json
from collections.abc import Sequence
from pathlib import Path

import h5py
import numpy as np

from genmojo_core.clip.camera_path import MAX_KEYS, CameraKey, CameraPath
from genmojo_core.errors import GenmojoError
from genmojo_core.store.atomic import staged, write_bytes
from genmojo_core.store.safe import DAMAGE, open_hdf5, read_array

GROUP = "/cameras/paths"
MAX_PATHS = 1000
MAX_JSON = 64 << 20
_COLUMNS = {
    "pose": ("world_to_camera", "OpenCV world to camera", ""), "fov": ("fov", "vertical field of view", "deg"),
    "scene_time": ("scene_time", "position 0..T-1 in the clip", "frame"),
    "seconds": ("seconds", "when the camera arrives", "s"), "hold": ("hold", "how long it stays", "s"),
}  # fmt: skip


def read_paths(scene: str | Path) -> list[CameraPath]:
    """The camera paths of a scene file, by name. Raises GenmojoError for what is damaged or no camera."""
    paths = []
    with open_hdf5(scene) as file:
        group = file.get(GROUP)
        if group is None:
            return []
        try:
            names = sorted(group)[:MAX_PATHS]
            for name in names:
                where = f"{scene}:{GROUP}/{name}"
                columns = {c: read_array(group[name][c], where) for c in _COLUMNS}
                closed = bool(group[name].attrs.get("closed", 0))
                paths.append(_path(name, columns, closed, where))
        except DAMAGE as error:
            raise GenmojoError("corrupt", "its camera paths are damaged", str(scene)) from error
    return paths


def write_paths(scene: str | Path, paths: Sequence[CameraPath]) -> None:
    """Replace all camera paths of a scene file; everything else stays as it is.

    The file appears whole or not at all. Raises GenmojoError: "argument" for two paths of one name or a name with "/",
    "io" where it cannot be written.
    """
    names = [path.name for path in paths]
    bad = [n for n in names if not n or "/" in n or n in (".", "..") or names.count(n) > 1]
    if bad or len(paths) > MAX_PATHS:
        raise GenmojoError("argument", f"'{(bad or ['...'])[0]}' cannot name a camera path", str(scene), "rename it")
    with open_hdf5(scene):  # it is a scene file that can be trusted
        memory = io.BytesIO(Path(scene).read_bytes())
    with h5py.File(memory, "r+", libver=("v110", "v110")) as file:
        if GROUP in file:
            del file[GROUP]
        for path in paths:
            group = file.create_group(f"{GROUP}/{path.name}")
            group.attrs["closed"] = int(path.closed)
            for column, (attribute, description, units) in _COLUMNS.items():
                values = np.array([getattr(key, attribute) for key in path.keys], np.float64)
                dataset = group.create_dataset(column, data=values, chunks=values.shape, fletcher32=True)
                dataset.attrs["description"], dataset.attrs["units"] = np.bytes_(description), np.bytes_(units or "1")
    with staged(scene) as part:
        part.write_bytes(memory.getbuffer())
        if [p.to_json() for p in read_paths(part)] != [p.to_json() for p in sorted(paths, key=lambda p: p.name)]:
            raise GenmojoError("corrupt", "what was written does not read back the same", str(scene), "check the disk")


def write_json(path: CameraPath, file: str | Path) -> None:
    """One path as a JSON file. Raises GenmojoError("io")."""
    write_bytes(file, json.dumps(path.to_json(), indent=1).encode())


def read_json(file: str | Path) -> CameraPath:
    """One path from a JSON file. Raises GenmojoError: "io", "size", "schema", "camera"."""
    try:
        if Path(file).stat().st_size > MAX_JSON:
            raise GenmojoError("size", "is too large for a camera path", str(file))
        data = json.loads(Path(file).read_bytes())
    except OSError as error:
        raise GenmojoError("io", "cannot be read", str(file), "check the name") from error
    except ValueError as error:
        raise GenmojoError("format", "is no JSON", str(file)) from error
    if not isinstance(data, dict):
        raise GenmojoError("schema", "is no camera path", str(file))
    return CameraPath.from_json(data, str(file))


def find_path(name: str, scene: str | Path) -> CameraPath:
    """A path by its name in a scene file, or by the name of a JSON file. Raises GenmojoError("argument")."""
    if name.lower().endswith(".json"):
        return read_json(name)
    paths = {path.name: path for path in read_paths(scene)}
    if name not in paths:
        known = ", ".join(paths) or "none"
        raise GenmojoError("argument", f"has no camera path '{name}'", str(scene), f"it has {known}")
    return paths[name]


def _path(name: str, columns: dict[str, np.ndarray], closed: bool, where: str) -> CameraPath:
    """The path of its columns."""
    count = len(columns["fov"]) if columns["fov"].ndim == 1 else -1
    shapes = {c: (count, 4, 4) if c == "pose" else (count,) for c in _COLUMNS}
    if not 1 <= count <= MAX_KEYS or any(columns[c].shape != shapes[c] for c in _COLUMNS):
        raise GenmojoError("schema", "has columns of different lengths", where)
    rows = zip(*(columns[c] for c in _COLUMNS), strict=True)
    return CameraPath(name, tuple(CameraKey(pose, *(float(v) for v in rest)) for pose, *rest in rows), closed)
