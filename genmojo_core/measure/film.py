"""Pictures one after another: turntables and camera paths, written as mp4 or as numbered PNG files."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from genmojo_core.clip.camera_path import CameraPath, key_view
from genmojo_core.clip.cameras import View
from genmojo_core.errors import GenmojoError
from genmojo_core.measure import sheet
from genmojo_core.measure.views import Look, Picture, orbit_target, orbit_view, render_frame
from genmojo_core.store.atomic import staged, write_bytes
from genmojo_core.store.scene_file import BakedScene

MODES = ("rgb", "depth", "instance", "flow", "opacity", "normal")
TIME_MODES = ("freeze", "play", "loop")
VIDEO = (".mp4", ".mov")
Tell = Callable[[float], None]


@dataclass(frozen=True)
class Shot:
    """One picture to take: from where, and when (position 0..T-1 in the scene, fractions lie between frames)."""

    view: View
    time: float


def turntable(
    scene: BakedScene, frame: int, *, degrees: float = 360.0, seconds: float = 6.0, elevation: float = 0.0,
    fps: float = 24.0, time_mode: str = "freeze",
) -> list[Shot]:  # fmt: skip
    """The camera of a frame turned once round the objects, starting and ending at azimuth 0.

    Args:
        time_mode: "freeze" shows the frame all the time, "play" the whole clip once, "loop" the clip at its own speed,
            again and again. Raises GenmojoError("argument") for values that make no film.
    """
    count = round(seconds * fps)
    if time_mode not in TIME_MODES or not 1 <= count <= 100_000 or not 0 <= frame < len(scene):
        raise GenmojoError("argument", f"{seconds} s at {fps} pictures a second, {time_mode} from frame {frame} "
                           "make no film", "turntable")  # fmt: skip
    target = orbit_target(scene)
    shots = []
    for i in range(count):
        view = orbit_view(scene, frame, elevation, degrees * i / count, target)
        now = {"freeze": float(frame), "play": (len(scene) - 1) * i / max(count - 1, 1),
               "loop": float((frame + i * scene.fps / fps) % len(scene))}[time_mode]  # fmt: skip
        shots.append(Shot(view, min(now, len(scene) - 1.0)))
    return shots


def along(scene: BakedScene, path: CameraPath, fps: float = 24.0) -> list[Shot]:
    """A camera path, picture by picture; scene times beyond the clip show its last frame."""
    count = max(1, round(path.seconds * fps) + (0 if path.closed else 1))
    like = scene.cameras.view(0)
    keys = [path.at(i / fps) for i in range(count)]
    return [Shot(key_view(key, like), min(key.scene_time, len(scene) - 1.0)) for key in keys]


def sized(shots: Sequence[Shot], short_side: int | None) -> list[Shot]:
    """The same shots with the picture's short side brought to so many pixels. Raises GenmojoError("argument")."""
    if short_side is None:
        return list(shots)
    if not 1 <= short_side <= 8192:
        raise GenmojoError("argument", f"{short_side} pixels are no picture size", "--size", "give 1 to 8192")
    return [Shot(shot.view.resized(*_size(shot.view, short_side)), shot.time) for shot in shots]


def pictures(scene: BakedScene, shots: Iterable[Shot], mode: str = "rgb", objects_only: bool = False,
             transparent: bool = False) -> Iterator[np.ndarray]:  # fmt: skip
    """(H, W, 3) uint8 per shot, (H, W, 4) with straight alpha for transparent rgb. Flow is that of a still camera."""
    for shot in shots:
        look = Look(objects_only=objects_only, flow_to=shot.view if mode == "flow" else None, normals=mode == "normal")
        yield picture_of(scene, render_frame(scene, shot.time, shot.view, look), mode, transparent)


def picture_of(scene: BakedScene, picture: Picture, mode: str, transparent: bool = False) -> np.ndarray:
    """A rendered frame as an image in one of MODES."""
    if mode == "depth":
        return sheet.depth_picture(picture)
    if mode == "instance":
        return sheet.label_picture(scene, picture)
    if mode == "flow" and picture.flow is not None:
        return sheet.flow_picture(picture.flow)
    if mode == "opacity":
        return sheet.to_bytes(np.repeat(picture.alpha[..., None], 3, axis=2))
    if mode == "normal" and picture.normal is not None:
        return sheet.to_bytes((0.5 + 0.5 * picture.normal) * picture.alpha[..., None])
    return picture.straight_rgba() if transparent else sheet.to_bytes(picture.on())


def write_film(images: Iterator[np.ndarray], output: str, fps: float, numbers: Sequence[int], tell: Tell) -> list[str]:
    """An mp4 if the name says so, else numbered PNG files in a folder; returns the paths. `tell` may raise to cancel.

    Files of a cancelled or failed film are removed. Raises GenmojoError("io").
    """
    if output.lower().endswith(VIDEO):
        write_video(output, images, fps, len(numbers), tell)
        return [output]
    return write_pictures(output, images, numbers, tell)


def write_pictures(folder: str, images: Iterator[np.ndarray], numbers: Sequence[int], tell: Tell) -> list[str]:
    """NNNNN.png for every number; see `write_film`."""
    if Path(folder).is_file():
        raise GenmojoError("io", "is a file", folder, "give a folder or a name ending in .mp4")
    paths: list[str] = []
    finished = False
    try:
        for i, (number, image) in enumerate(zip(numbers, images, strict=True)):
            paths.append(str(Path(folder) / f"{number:05d}.png"))
            write_bytes(paths[-1], sheet.encode_png(image))
            tell((i + 1) / len(numbers))
        finished = True
    finally:
        for path in () if finished else paths:
            Path(path).unlink(missing_ok=True)
    return paths


def write_video(path: str, images: Iterator[np.ndarray], fps: float, count: int, tell: Tell) -> None:
    """H.264 (MPEG-4 where that encoder is missing); odd sizes lose their last row or column; see `write_film`."""
    from fractions import Fraction

    import av

    codec = "libx264" if "libx264" in av.codecs_available else "mpeg4"
    with staged(path) as part, av.open(str(part), "w", format="mp4") as container:
        stream: Any = container.add_stream(codec, rate=Fraction(fps).limit_denominator(1001))
        stream.pix_fmt = "yuv420p"
        for i, image in enumerate(images):
            even = np.ascontiguousarray(image[: image.shape[0] // 2 * 2, : image.shape[1] // 2 * 2, :3])
            if i == 0:
                stream.height, stream.width = even.shape[:2]
            container.mux(stream.encode(av.VideoFrame.from_ndarray(even, format="rgb24")))
            tell((i + 1) / count)
        container.mux(stream.encode(None))


def _size(view: View, short_side: int) -> tuple[int, int]:
    scale = short_side / min(view.width, view.height)
    return max(1, round(view.width * scale)), max(1, round(view.height * scale))
