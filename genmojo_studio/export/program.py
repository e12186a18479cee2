"""The exporting process: `python -m genmojo_studio.export.program`.

Its standard input is one line of JSON (request.ExportRequest), later perhaps a line "cancel"; its standard output is
lines of JSON: {"progress": share}, at last {"done": {...}}, {"cancelled": true} or {"error": sentence}.
"""

from __future__ import annotations

import json
import shutil
import sys
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from genmojo_core.clip.camera_path import CameraKey, CameraPath, key_view
from genmojo_core.errors import GenmojoError
from genmojo_core.measure import film
from genmojo_core.measure.film import Shot
from genmojo_core.measure.sheet import encode_png
from genmojo_core.measure.views import Look, orbit_target, orbit_view, render_frame
from genmojo_core.store import camera_paths, ply, scene_hdf5
from genmojo_core.store.atomic import check_writable, staged, write_bytes
from genmojo_core.store.scene_file import BakedScene
from genmojo_studio.export.request import ExportRequest

Tell = Callable[[float], None]
_TELL_SECONDS = 0.1


class Cancelled(Exception):  # noqa: N818 - no fault
    """The window asked to stop."""


def main() -> int:
    """Do one export."""
    line = sys.stdin.readline()
    cancelled = threading.Event()
    threading.Thread(target=_listen, args=(cancelled,), daemon=True).start()
    try:
        request = ExportRequest.from_json(json.loads(line))
        _say({"done": export(request, _teller(cancelled))})
    except Cancelled:
        _say({"cancelled": True})
    except GenmojoError as error:
        _say({"error": error.sentence()})
        return 2
    except MemoryError:
        _say({"error": "There is not enough memory for this; choose a smaller size."})
        return 2
    return 0


def export(request: ExportRequest, tell: Tell) -> dict[str, Any]:
    """Make what is asked for; returns {"path": ..., "files": ...}. `tell` gets the share done and may raise.

    Raises GenmojoError for what cannot be read, drawn or written.
    """
    tell(0.0)
    if request.kind == "hdf5":
        return _hdf5(request, tell)
    scene = scene_hdf5.read(request.scene)
    tell(0.0)
    if request.kind == "ply":
        ply.write(ply.of_frame(scene, request.frame, request.objects), request.output, request.extra)
        return {"path": request.output, "files": [request.output]}
    if request.kind == "ply-sequence":
        files = ply.write_sequence(scene, request.output, list(range(len(scene))), request.objects, request.extra, tell)
        return {"path": request.output, "files": files}
    if request.kind == "picture":
        return _picture(request, scene)
    shots = film.sized(_shots(request, scene), request.short_side)
    transparent = request.transparent and not request.output.lower().endswith(film.VIDEO)
    images = film.pictures(scene, shots, request.mode, request.objects_only or transparent, transparent)
    numbers = scene.frame_index.tolist() if request.kind == "frames" else list(range(len(shots)))
    fps = scene.fps if request.kind == "frames" else request.fps
    return {"path": request.output, "files": film.write_film(images, request.output, fps, numbers, tell)}


def _hdf5(request: ExportRequest, tell: Tell) -> dict[str, Any]:
    """A checked copy of the scene, with the camera paths asked for."""
    faults = scene_hdf5.validate(request.scene)
    if faults:
        raise GenmojoError("corrupt", faults[0].rstrip("."), request.scene)
    tell(0.5)
    check_writable(request.output)
    with staged(request.output) as part:
        shutil.copyfile(request.scene, part)
        tell(0.7)
        if request.paths:
            camera_paths.write_paths(part, [CameraPath.from_json(p) for p in request.paths])
        tell(1.0)
    return {"path": request.output, "files": [request.output]}


def _picture(request: ExportRequest, scene: BakedScene) -> dict[str, Any]:
    """One frame from one camera as a PNG."""
    view = _turned(request, scene, request.frame)
    if request.camera is not None:
        width, height = request.size or (view.width, view.height)
        pose = np.asarray(request.camera["world_to_camera"], np.float64)
        key = CameraKey(pose, float(request.camera["fov"]), float(request.frame), 0.0)
        CameraPath("camera", (key,))  # checks it
        view = key_view(key, view.resized(int(width), int(height)))
        view = replace(view, fx=view.fy)  # a view's pixels are square, whatever the clip's are
    (shot,) = film.sized([Shot(view, float(request.frame))], request.short_side)
    flow_to = shot.view if request.mode == "flow" else None
    objects_only = request.objects_only or request.transparent
    look = Look(objects_only=objects_only, flow_to=flow_to, normals=request.mode == "normal")
    drawn = render_frame(scene, request.frame, shot.view, look)
    write_bytes(request.output, encode_png(film.picture_of(scene, drawn, request.mode, request.transparent)))
    return {"path": request.output, "files": [request.output]}


def _shots(request: ExportRequest, scene: BakedScene) -> list[Shot]:
    """The camera's way."""
    if request.kind == "path":
        return film.along(scene, CameraPath.from_json(request.path or {}), request.fps)
    if request.kind == "turntable":
        return film.turntable(scene, request.frame, degrees=request.degrees, seconds=request.seconds,
                              elevation=request.elevation, fps=request.fps, time_mode=request.time_mode)  # fmt: skip
    target = orbit_target(scene) if request.elevation or request.azimuth else np.zeros(3)
    views = [orbit_view(scene, t, request.elevation, request.azimuth, target) for t in range(len(scene))]
    return [Shot(view, float(t)) for t, view in enumerate(views)]


def _turned(request: ExportRequest, scene: BakedScene, t: int) -> Any:
    """The clip's camera at a frame, turned."""
    if not 0 <= t < len(scene):
        raise GenmojoError("argument", f"there is no frame {t}, the scene has {len(scene)}", request.scene)
    target = orbit_target(scene) if request.elevation or request.azimuth else np.zeros(3)
    return orbit_view(scene, t, request.elevation, request.azimuth, target)


def _listen(cancelled: threading.Event) -> None:
    """Wait for "cancel", or for the window to go away."""
    for line in _lines():
        if line.strip() == "cancel":
            break
    cancelled.set()


def _lines() -> Iterator[str]:
    while line := sys.stdin.readline():
        yield line


def _teller(cancelled: threading.Event) -> Tell:
    """Tells the share done, not too often, and stops the work when asked to."""
    last = [0.0]

    def tell(share: float) -> None:
        if cancelled.is_set():
            raise Cancelled
        now = time.monotonic()
        if now - last[0] >= _TELL_SECONDS or share >= 1.0:
            last[0] = now
            _say({"progress": share})

    return tell


def _say(message: dict[str, Any]) -> None:
    sys.stdout.write(json.dumps(message) + "\n")
    sys.stdout.flush()


if __name__ == "__main__":
    sys.exit(main())
