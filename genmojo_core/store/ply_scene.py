"""PLY files as a 4D scene: one file is a still, a numbered sequence moves."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from genmojo_core.clip.cameras import Cameras
from genmojo_core.errors import GenmojoError
from genmojo_core.store import ply
from genmojo_core.store.ply import Splats3D
from genmojo_core.store.scene_file import BakedScene, SceneObject

FIELD_OF_VIEW = 50.0  # degrees, of the camera invented for files that bring none
SIZE = (960, 540)
FPS = 24.0
_COLORS = ((0.90, 0.30, 0.25), (0.25, 0.60, 0.90), (0.35, 0.75, 0.35), (0.95, 0.70, 0.20), (0.65, 0.40, 0.80))


def read_scene(path: str | Path) -> BakedScene:
    """A PLY file, or a folder of PLY files with equally many splats in name order, as a scene.

    Raises GenmojoError as `ply.read`; "empty" for a folder without PLY files, "schema" when the splats do not match.
    """
    source = Path(path)
    files = sorted(source.glob("*.ply")) if source.is_dir() else [source]
    if not files:
        raise GenmojoError("empty", "holds no PLY file", str(path), "give a PLY file or a folder of them")
    return scene_of([ply.read(file) for file in files], [file.name for file in files], str(path))


def scene_of(frames: Sequence[Splats3D], names: Sequence[str], where: str = "") -> BakedScene:
    """A scene whose frame t is `frames[t]`; splats keep their row, opacity and owner over time.

    The files bring no camera: one is invented that looks along +z at the middle of the splats. Colour beyond the
    constant harmonic is dropped. Raises GenmojoError("schema") when frames have different numbers of splats.
    """
    counts = {len(f) for f in frames}
    if len(counts) != 1 or 0 in counts:
        raise GenmojoError("schema", f"has frames of {min(counts)} to {max(counts)} splats", where,
                           "give files with equally many splats")  # fmt: skip
    owner = np.asarray(frames[0].extra.get("object_id", np.ones(len(frames[0])))).astype(np.int64).clip(0, 65535)
    order = np.lexsort((np.arange(len(owner)), owner == 0, np.where(owner == 0, 65536, owner)))
    first = frames[0]
    means = np.stack([f.means[order] for f in frames])
    scales = np.stack([np.maximum(f.scales[order], 1e-9) for f in frames])
    dc = np.stack([f.sh[order, 0] for f in frames])
    objects = _objects(owner[order])
    shape = (len(frames), len(objects))
    return BakedScene(
        np.arange(len(frames)), np.arange(len(frames)) / FPS, tuple(names), objects, means[0], first.quats[order],
        scales[0], first.opacities[order], dc[0], np.arange(len(owner), dtype=np.uint64), means - means[0],
        np.stack([f.quats[order] for f in frames]), np.log(scales / scales[0]).astype(np.float32),
        np.tile(np.eye(3, 4, dtype=np.float32), (*shape, 1, 1)), np.ones(shape, np.float32),
        _invented(means[0], len(frames)), np.zeros(len(objects), np.int64), np.array([0.0, -1.0, 0.0]),
        None if np.array_equal(dc, np.broadcast_to(dc[0], dc.shape)) else dc - dc[0],
        config={"input": where, "guesses": ["the camera is invented: PLY files bring none"]}, fps=FPS,
    )  # fmt: skip


def _objects(owner: np.ndarray) -> tuple[SceneObject, ...]:
    """Runs of equal owners."""
    starts = np.flatnonzero(np.diff(owner, prepend=-1))
    ends = [*starts[1:], len(owner)]
    return tuple(
        SceneObject(int(owner[a]), "background" if owner[a] == 0 else f"object {owner[a]}",
                    _COLORS[i % len(_COLORS)], bool(owner[a] == 0), int(a), int(b - a))
        for i, (a, b) in enumerate(zip(starts, ends, strict=True))
    )  # fmt: skip


def _invented(means: np.ndarray, frames: int) -> Cameras:
    """One still camera from which the middle 90 % of the splats are seen."""
    centre = np.median(means, axis=0).astype(np.float64)
    radius = max(float(np.percentile(np.linalg.norm(means - centre, axis=1), 90)), 1e-3)
    focal = SIZE[1] / 2 / np.tan(np.deg2rad(FIELD_OF_VIEW / 2))
    distance = radius / np.sin(np.deg2rad(FIELD_OF_VIEW / 2))
    pose = np.eye(4)
    pose[:3, 3] = np.array([0, 0, distance]) - centre
    lens = np.array([[focal, 0, SIZE[0] / 2], [0, focal, SIZE[1] / 2], [0, 0, 1.0]])
    return Cameras(np.tile(lens, (frames, 1, 1)), np.tile(pose, (frames, 1, 1)), SIZE, distance * 1e-3, distance * 1e3)
