"""`genmojo render` and `genmojo tracks`: what a scene looks like from elsewhere, and where its points go."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from genmojo_core.cli.arguments import frame_range
from genmojo_core.cli.output import progress
from genmojo_core.clip.cameras import Cameras, View, check_cameras
from genmojo_core.errors import GenmojoError

if TYPE_CHECKING:
    from genmojo_core.measure.views import Picture
    from genmojo_core.store.scene_file import BakedScene

MODES = ("rgb", "depth", "instance", "flow")


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
    render.set_defaults(run=run_render)
    tracks = commands.add_parser("tracks", help="follow query points through a scene, in 2D and 3D")
    tracks.add_argument("scene", metavar="scene.h5")
    tracks.add_argument("--queries", required=True, metavar="q.npz", help="t (N,) and xy (N,2) raster px of the clip")
    tracks.add_argument("-o", "--output", required=True, metavar="tracks.npz")
    tracks.set_defaults(run=run_tracks)


def run_render(args: argparse.Namespace) -> dict[str, Any]:
    """Draw every frame asked for and write it."""
    from genmojo_core.store import scene_hdf5

    scene = scene_hdf5.read(args.scene)
    chosen = _chosen(args, scene)
    views = _views(args, scene)
    images = _images(args, scene, chosen, views)
    with progress("rendering") as tell:
        if args.output.lower().endswith((".mp4", ".mov")):
            _write_video(args.output, images, scene.fps, len(chosen), tell)
            paths = [args.output]
        else:
            paths = _write_pictures(args.output, images, [int(scene.frame_index[t]) for t in chosen], tell)
    return {"path": args.output, "frames": len(chosen), "size": [views[0].width, views[0].height], "files": paths}


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


def _images(args: argparse.Namespace, scene: BakedScene, chosen: list[int], views: list[View]) -> Iterator[np.ndarray]:
    """Pictures in the mode asked for: (H, W), (H, W, 3) or (H, W, 4), uint8 or uint16."""
    from genmojo_core.measure.views import Look, render_frame

    for t in chosen:
        after = views[min(t + 1, len(views) - 1)] if args.mode == "flow" else None
        picture = render_frame(scene, t, views[t], Look(objects_only=args.foreground, flow_to=after))
        yield _image(args, scene, picture)


def _image(args: argparse.Namespace, scene: BakedScene, picture: Picture) -> np.ndarray:
    """One picture."""
    from genmojo_core.measure import sheet

    video = args.output.lower().endswith((".mp4", ".mov"))
    if args.mode == "depth":
        return sheet.depth_picture(picture)
    if args.mode == "instance":
        return sheet.label_picture(scene, picture)
    if args.mode == "flow" and picture.flow is not None:
        return sheet.flow_picture(picture.flow)
    return picture.straight_rgba() if args.foreground and not video else sheet.to_bytes(picture.on())


def _write_pictures(
    folder: str, images: Iterator[np.ndarray], numbers: list[int], tell: Callable[[float], None]
) -> list[str]:
    """NNNNN.png by the clip's frame numbers."""
    from genmojo_core.measure.sheet import encode_png
    from genmojo_core.store.atomic import write_bytes

    if Path(folder).is_file():
        raise GenmojoError("io", "is a file", folder, "give a folder or a name ending in .mp4")
    paths = []
    for i, (number, image) in enumerate(zip(numbers, images, strict=True)):
        paths.append(str(Path(folder) / f"{number:05d}.png"))
        write_bytes(paths[-1], encode_png(image))
        tell((i + 1) / len(numbers))
    return paths


def _write_video(
    path: str, images: Iterator[np.ndarray], fps: float, count: int, tell: Callable[[float], None]
) -> None:
    """H.264 (MPEG-4 where that encoder is missing); odd sizes lose their last row or column."""
    from fractions import Fraction

    import av

    from genmojo_core.store.atomic import staged

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
