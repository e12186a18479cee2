"""Write a procedural clip in the layout of the shared Blender clips, so that one evaluator serves both."""

from __future__ import annotations

import io
from pathlib import Path

import cv2
import numpy as np

from genmojo_core.clip import png
from genmojo_core.clip.clip import Clip
from genmojo_core.clip.layouts import IMAGES, MASKS
from genmojo_core.clip.synthetic import Truth
from genmojo_core.errors import GenmojoError

JPEG_QUALITY = 97


def write(clip: Clip, truth: Truth, folder: str | Path) -> None:
    """Write frames, masks, the channels the clip carries, and the truth.

    Files: JPEGImages/<name>/NNNNN.jpg, Annotations/<name>/NNNNN.png (palette), depth.npz (float32), cameras.npz (with
    `world_up`), flow.npz, truth.npz (keys of the Blender clips, also `state`, `flow`, `flow_valid`, `depth`),
    novel/<elevation>_<azimuth>/NNNNN.png (RGBA, straight alpha). The same clip gives the same bytes again, so writing
    over an older run of it is safe.

    Raises GenmojoError("io") if the folder cannot be written or holds frames of another clip.
    """
    folder = Path(folder)
    names = [f"{i:05d}" for i in clip.frame_index]
    try:
        _check_free(folder / IMAGES, clip.name, {f"{name}.jpg" for name in names})
        for t, name in enumerate(names):
            _put(folder / IMAGES / clip.name / f"{name}.jpg", _jpeg(clip.frames[t]))
            if clip.masks is not None:
                index = np.concatenate([[0], clip.object_ids]).astype(np.uint8)[clip.masks.value[t]]
                _put(folder / MASKS / clip.name / f"{name}.png", png.encode_palette(index, png.davis_palette()))
        _write_channels(clip, folder)
        _put(folder / "truth.npz", _npz(_truth_arrays(truth)))
        for a, (elevation, azimuth) in enumerate(truth.novel_angles):
            for f, t in enumerate(truth.novel_frames):
                path = folder / "novel" / f"{elevation}_{azimuth}" / f"{names[t]}.png"
                _put(path, _rgba_png(truth.novel[a, f]))
    except OSError as error:
        raise GenmojoError(
            "io", f"cannot be written ({error.strerror})", str(folder), "choose another folder"
        ) from error


def _check_free(images: Path, name: str, files: set[str]) -> None:
    """Frames of another clip must not mix with these."""
    others = [p for p in images.glob("*") if p.name != name]
    others += [p for p in (images / name).glob("*") if p.name not in files]
    if others:
        raise GenmojoError("io", "holds another clip", str(images), "choose another folder")


def _write_channels(clip: Clip, folder: Path) -> None:
    """The channels that the clip gives to whoever reads it."""
    if clip.depth is not None:
        _put(folder / "depth.npz", _npz({"depth": np.where(clip.depth.valid, clip.depth.value, np.nan)}))
    if clip.cameras is not None:
        cameras = clip.cameras.value
        arrays = {"K": cameras.K[0], "world_to_camera": cameras.world_to_camera, "world_up": clip.world_up}
        _put(folder / "cameras.npz", _npz(arrays))
    if clip.flow is not None:
        _put(folder / "flow.npz", _npz({"flow": clip.flow.value, "valid": clip.flow.valid}))


def _truth_arrays(truth: Truth) -> dict[str, np.ndarray]:
    """The arrays of truth.npz."""
    names = ("tracks", "visible", "track_object", "track_xyz", "novel_angles", "novel_world_to_camera", "novel_frames",
             "orbit_centre", "state", "flow", "flow_valid", "depth")  # fmt: skip
    return {name: getattr(truth, name) for name in names}


def _npz(arrays: dict[str, np.ndarray]) -> bytes:
    """A compressed npz in memory; numpy stamps its entries with a fixed date, so the bytes are reproducible."""
    buffer = io.BytesIO()
    np.savez_compressed(buffer, allow_pickle=False, **arrays)
    return buffer.getvalue()


def _jpeg(rgb: np.ndarray) -> bytes:
    """A JPEG file of a frame, colours at full resolution."""
    options = [cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY, cv2.IMWRITE_JPEG_SAMPLING_FACTOR,
               cv2.IMWRITE_JPEG_SAMPLING_FACTOR_444]  # fmt: skip
    return cv2.imencode(".jpg", cv2.cvtColor(rgb, cv2.COLOR_RGB2BGR), options)[1].tobytes()


def _rgba_png(rgba: np.ndarray) -> bytes:
    """A PNG file with straight alpha."""
    return cv2.imencode(".png", cv2.cvtColor(rgba, cv2.COLOR_RGBA2BGRA))[1].tobytes()


def _put(path: Path, data: bytes) -> None:
    """Write a file, with its folders."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data)
