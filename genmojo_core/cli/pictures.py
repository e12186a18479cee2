"""`genmojo render` and `genmojo tracks`: what a scene looks like from elsewhere, and where its points go."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from genmojo_core.cli.arguments import frame_range
from genmojo_core.cli.output import progress
from genmojo_core.clip.cameras import Cameras, View, check_cameras
from genmojo_core.errors import GenmojoError

if TYPE_CHECKING:
    from genmojo_core.measure.film import Shot
    from genmojo_core.store.scene_file import BakedScene

MODES = ("rgb", "depth", "instance", "flow", "opacity", "normal")


def add_commands(commands: Any) -> None:
    """Add `render` and `tracks`."""
    render = commands.add_parser("render", help="novel views of a scene, as PNG files or mp4")
    render.add_argument("scene", metavar="scene.h5")
    render.add_argument("-o", "--output", required=True, metavar="DIR|FILE.mp4")
    render.add_argument("--elevation", type=float, default=0.0, help="degrees, + = from above")
    render.add_argument("--azimuth", type=float, default=0.0, help="degrees, + = the camera moves to its right")
    render.add_argument("--cameras", metavar="npz", help="K (3,3) and world_to_camera (T,4,4) for the clip's frames")
    render.add_argument("--frames", type=frame_range, metavar="A:B", help="positions in the scene, default all")
    render.add_argument("--mode", choices=MODES, default="rgb", help="depth: near is bright; instance, flow: colours")
    render.add_argument("--foreground", action="store_true", help="objects only, RGBA with straight alpha")
    render.add_argument("--size", type=int, metavar="PX", help="short side, default the clip's own")
    film = render.add_argument_group("camera moves")
    film.add_argument("--turntable", type=float, metavar="DEG", help="turn so far round the objects, e.g. 360")
    film.add_argument("--path", metavar="NAME|json", help="a camera path of the scene file, or one as a JSON file")
    film.add_argument("--seconds", type=float, default=6.0, help="length of the turntable")
    film.add_argument("--time", choices=("freeze", "play", "loop"), default="freeze", help="scene time on a turntable")
    film.add_argument("--at", type=int, default=0, metavar="FRAME", help="frame the turntable starts from")
    film.add_argument("--fps", type=float, default=24.0, help="pictures a second of a camera move")
    render.set_defaults(run=run_render)
    tracks = commands.add_parser("tracks", help="follow query points through a scene, in 2D and 3D")
    tracks.add_argument("scene", metavar="scene.h5")
    tracks.add_argument("--queries", required=True, metavar="q.npz", help="t (N,) and xy (N,2) raster px of the clip")
    tracks.add_argument("-o", "--output", required=True, metavar="tracks.npz")
    tracks.set_defaults(run=run_tracks)


def run_render(args: argparse.Namespace) -> dict[str, Any]:
    """Draw every frame asked for, or a camera move, and write it."""
    from genmojo_core.measure import film
    from genmojo_core.store import scene_hdf5

    scene = scene_hdf5.read(args.scene)
    shots = _moves(args, scene)
    transparent = args.foreground and not args.output.lower().endswith(film.VIDEO)
    if shots is None:
        chosen = _chosen(args, scene)
        views = _views(args, scene)
        images = _images(args, scene, chosen, views)
        numbers, fps, view = [int(scene.frame_index[t]) for t in chosen], scene.fps, views[0]
    else:
        images = film.pictures(scene, shots, args.mode, args.foreground, transparent)
        numbers, fps, view = list(range(len(shots))), args.fps, shots[0].view
    with progress("rendering") as tell:
        paths = film.write_film(images, args.output, fps, numbers, tell)
    return {"path": args.output, "frames": len(numbers), "size": [view.width, view.height], "files": paths}


def run_tracks(args: argparse.Namespace) -> dict[str, Any]:
    """Track the queries and write the npz."""
    from genmojo_core.store import npz, scene_hdf5
    from genmojo_core.store.atomic import check_writable
    from genmojo_core.trackers import scene as scene_tracker

    check_writable(args.output)
    t, xy = npz.read_queries(args.queries)
    scene = scene_hdf5.read(args.scene)
    with progress("tracking") as tell:
        tracks = scene_tracker.track(scene, t, xy, tell)
    npz.write_tracks(tracks, args.output)
    return {"path": args.output, "tracks": len(tracks.xy), "frames": tracks.xy.shape[1], "size": list(tracks.size),
            "visible_share": float(tracks.visible.mean())}  # fmt: skip


def _chosen(args: argparse.Namespace, scene: BakedScene) -> list[int]:
    """Positions to draw. Raises GenmojoError("argument") if none is in the scene."""
    first, end = args.frames or (0, None)
    chosen = list(range(len(scene)))[first:end]
    if not chosen:
        raise GenmojoError(
            "argument", f"the scene has frames 0 to {len(scene) - 1}", "--frames", "ask for some of them"
        )
    return chosen


def _views(args: argparse.Namespace, scene: BakedScene) -> list[View]:
    """One camera per frame of the scene."""
    from genmojo_core.measure.views import orbit_target, orbit_view, short_side_size

    if args.cameras is not None:
        cameras = _given_cameras(args.cameras, scene)
        views = [cameras.view(t) for t in range(len(scene))]
    elif args.elevation or args.azimuth:
        target = orbit_target(scene)
        views = [orbit_view(scene, t, args.elevation, args.azimuth, target) for t in range(len(scene))]
    else:
        views = [scene.cameras.view(t) for t in range(len(scene))]
    if args.size is None:
        return views
    if not 1 <= args.size <= 8192:
        raise GenmojoError("argument", f"{args.size} pixels are no picture size", "--size", "give 1 to 8192")
    return [view.resized(*short_side_size(scene.cameras.size, args.size)) for view in views]


def _given_cameras(path: str, scene: BakedScene) -> Cameras:
    """Cameras of a file: one per frame of the scene, or one per frame of the clip the scene is a part of."""
    from genmojo_core.store.npz import read_arrays

    arrays = read_arrays(path)
    if not {"K", "world_to_camera"} <= set(arrays):
        raise GenmojoError("schema", f"holds {', '.join(arrays)}, expected K and world_to_camera", path)
    poses = np.asarray(arrays["world_to_camera"], np.float64)
    poses = np.tile(poses, (len(scene), 1, 1)) if poses.ndim == 2 else poses
    lens = np.asarray(arrays["K"], np.float64)
    lens = np.tile(lens, (len(poses), 1, 1)) if lens.ndim == 2 else lens
    if len(poses) != len(scene) and len(poses) > scene.frame_index.max():
        poses, lens = poses[scene.frame_index], lens[scene.frame_index]
    cameras = replace(scene.cameras, K=lens, world_to_camera=poses)
    check_cameras(cameras, len(scene), path)
    return cameras


def _moves(args: argparse.Namespace, scene: BakedScene) -> list[Shot] | None:
    """The camera move asked for, None if there is none. Raises GenmojoError("argument") for two at once."""
    from genmojo_core.measure import film

    if args.path is not None and args.turntable is not None:
        raise GenmojoError("argument", "a film follows one camera", "--path, --turntable", "give one of them")
    if args.path is not None:
        from genmojo_core.store.camera_paths import find_path

        return film.sized(film.along(scene, find_path(args.path, args.scene), args.fps), args.size)
    if args.turntable is None:
        return None
    shots = film.turntable(scene, args.at, degrees=args.turntable, seconds=args.seconds, elevation=args.elevation,
                           fps=args.fps, time_mode=args.time)  # fmt: skip
    return film.sized(shots, args.size)


def _images(args: argparse.Namespace, scene: BakedScene, chosen: list[int], views: list[View]) -> Iterator[np.ndarray]:
    """Pictures in the mode asked for: (H, W), (H, W, 3) or (H, W, 4), uint8 or uint16."""
    from genmojo_core.measure import film
    from genmojo_core.measure.views import Look, render_frame

    transparent = args.foreground and not args.output.lower().endswith(film.VIDEO)
    for t in chosen:
        after = views[min(t + 1, len(views) - 1)] if args.mode == "flow" else None
        look = Look(objects_only=args.foreground, flow_to=after, normals=args.mode == "normal")
        yield film.picture_of(scene, render_frame(scene, t, views[t], look), args.mode, transparent)
