"""`genmojo seed`, and point tracks in `genmojo export` and `genmojo import`."""

from __future__ import annotations

import argparse
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from genmojo_core.cli.export import EXPORTS, IMPORTS, Format
from genmojo_core.cli.output import progress, say
from genmojo_core.errors import GenmojoError

if TYPE_CHECKING:
    from genmojo_core.clip.clip import Clip
    from genmojo_core.store.track_sheet import TrackSheet, Which

Tell = Callable[[float], None]


def add_commands(commands: Any) -> None:
    """Add `seed`; the formats are rows of the tables of `export` and `import`."""
    seed = commands.add_parser("seed", help="first tracks for annotation")
    seed.add_argument("clip", metavar="CLIP", help="folder of frames with masks, or a video")
    seed.add_argument("--points", required=True, metavar="p.npz", help="t (N,), xy (N, 2) pixels of the clip, optional "
                      "object (N,)")  # fmt: skip
    seed.add_argument("--tracker", default="optical", metavar="NAME[:PATH]", help="optical, scene:scene.h5, "
                      "file:tracks.npz, cotracker:CHECKOUT, cotracker:hub:MODEL")  # fmt: skip
    seed.add_argument("--checkpoint", metavar="FILE.pth", help="CoTracker's weights")
    seed.add_argument("--window", type=int, metavar="N", help="frames that CoTracker sees at once (64)")
    seed.add_argument("--memory", type=float, metavar="GIB", help="memory it may take (0.8 of the machine's; 0: all)")
    seed.add_argument("--allow-download", action="store_true", help="cotracker:hub:MODEL may download and run code")
    seed.add_argument("-o", "--output", required=True, metavar="t.npz")
    seed.set_defaults(run=run_seed)


def run_seed(args: argparse.Namespace) -> dict[str, Any]:
    """Follow the points and write our track npz."""
    from genmojo_core.clip import folders
    from genmojo_core.store import npz
    from genmojo_core.store.atomic import check_writable
    from genmojo_core.trackers import seeding, solver

    check_writable(args.output)
    t, xy = npz.read_queries(args.points)
    name, _, path = args.tracker.partition(":")
    options = {"checkpoint": args.checkpoint or "", "consent": "yes" if args.allow_download else "",
               "window": "" if args.window is None else str(args.window),
               "memory": "" if args.memory is None else str(args.memory)}  # fmt: skip
    seeder = seeding.make(name, path or None, **options)
    if seeder.licence:
        say(seeder.licence)
    clip = folders.read(args.clip, short_side=solver.SHORT_SIDE, ignore=("depth", "cameras", "flow"))
    _check_points(args.points, clip, t, xy)
    owner = _owners(args.points, clip, t, xy)
    queries = seeding.Queries(t, xy, owner)
    say(f"about {seeder.forecast(clip, queries):.0f} s")
    with progress(f"tracking ({name})") as tell:
        tracks = seeder.seed(clip, queries, tell)
    npz.write_tracks(tracks, args.output)
    return {"path": args.output, "tracker": name, "tracks": len(tracks.xy), "frames": tracks.xy.shape[1],
            "visible_share": float(tracks.visible.mean())}  # fmt: skip


def read_sheet(path: str | Path, which: Which = "all") -> TrackSheet:
    """The tracks of a project (those or all), of a scene file or of an npz in our, TAP-Vid's or CoTracker's layout."""
    from genmojo_core.clip.frames import frame_names
    from genmojo_core.store import project_file, track_npz, tracks_hdf5
    from genmojo_core.store.track_sheet import TrackSheet

    file = Path(path)
    if not file.is_file():
        raise GenmojoError("io", "does not exist or is no file", str(path), "check the name")
    with open(file, "rb") as stream:
        head = stream.read(16)
    if head.startswith(b"SQLite format 3"):
        loaded = project_file.load(file)
        names = frame_names(loaded.info.path)
        names = names if len(names) == loaded.annotation.frames else ()
        sheet = TrackSheet.of_annotation(loaded.annotation, names, loaded.info.seconds, which)
        if loaded.annotation.tracks and not len(sheet.numbers):
            raise GenmojoError("empty", "holds no track that the review lets through", str(path), "give --review all")
        return sheet
    if head.startswith(b"\x89HDF"):
        return tracks_hdf5.read(file)
    if not head.startswith(b"PK"):
        raise GenmojoError("format", "holds no tracks we know", str(path), "give a project, a scene or an npz")
    return track_npz.read(file)


def _check_points(points: str, clip: Clip, t: np.ndarray, xy: np.ndarray) -> None:
    """Raise GenmojoError("value") for a point outside the clip's frames or its picture."""
    late = (t < 0) | (t >= len(clip))
    if late.any():
        raise GenmojoError("value", f"a query asks at frame {t[late][0]}, the clip has 0 to {len(clip) - 1}", points)
    width, height = clip.source_size
    outside = ((xy < 0) | (xy > (width, height))).any(axis=1)
    if outside.any():
        raise GenmojoError("value", f"asks at {xy[outside][0].round(1).tolist()}, outside the {width} x {height} "
                           "picture", points, "give raster pixels of the clip")  # fmt: skip


def _owners(points: str, clip: Clip, t: np.ndarray, xy: np.ndarray) -> np.ndarray:  # (N,) mask ids
    """Whose each query is: as its file says, else the object whose mask covers it, or the nearest to it."""
    from genmojo_core.store.npz import read_arrays
    from genmojo_core.store.track_import import nearest_object

    arrays = read_arrays(points)
    if "object" in arrays:
        told = np.asarray(arrays["object"])
        if told.shape != t.shape or told.dtype.kind not in "iub":
            raise GenmojoError("schema", f"object is {told.shape} {told.dtype} for {len(t)} points, expected whole "
                               "numbers (N,)", points)  # fmt: skip
        return told.astype(np.int64)
    if clip.masks is None or not len(clip.object_ids):
        return np.zeros(len(t), np.int64)
    out = np.zeros(len(t), np.int64)
    for n, (frame, place) in enumerate(zip(t, xy / np.array(clip.source_size), strict=True)):
        found = nearest_object(clip.masks.value[frame], place)
        out[n] = clip.object_ids[found - 1] if found else 0
    return out


def _writer(write: Callable[[TrackSheet, str], str | None]) -> Callable[[argparse.Namespace, Tell], dict[str, Any]]:
    """A row's `run` for a function that writes a sheet."""

    def run(args: argparse.Namespace, tell: Tell) -> dict[str, Any]:
        sheet = _chosen(read_sheet(args.file, args.review), args)
        warning = write(sheet, args.output)
        if warning:
            say(warning)
        tell(1.0)
        return {"path": args.output, "tracks": len(sheet.tracks.xy), "frames": sheet.tracks.state.shape[1]}

    return run


def _chosen(sheet: TrackSheet, args: argparse.Namespace) -> TrackSheet:
    """Only the objects and frames asked for."""
    from genmojo_core.cli.export import chosen_frames, chosen_objects

    owners = chosen_objects(args)
    rows = np.ones(len(sheet.numbers), bool) if owners is None else np.isin(sheet.tracks.object, owners)
    if not rows.any():
        raise GenmojoError("empty", "holds no track of those objects", args.file, "leave --objects out")
    frames = np.array(chosen_frames(args, sheet.tracks.state.shape[1]))
    return sheet.select(rows, frames)


def _reader(read: Callable[[argparse.Namespace], TrackSheet]) -> Callable[[argparse.Namespace, Tell], dict[str, Any]]:
    """A row's `run` for a function that reads a sheet; it is written as our npz."""

    def run(args: argparse.Namespace, tell: Tell) -> dict[str, Any]:
        from genmojo_core.store import track_npz

        sheet = read(args)
        track_npz.write(sheet, args.output)
        tell(1.0)
        return {"path": args.output, "tracks": len(sheet.tracks.xy), "frames": sheet.tracks.state.shape[1],
                "size": list(sheet.tracks.size)}  # fmt: skip

    return run


def _write_tapvid(sheet: TrackSheet, path: str) -> str | None:
    from genmojo_core.store import tapvid

    tapvid.write(sheet, path)
    outside = tapvid.clipped_count(sheet.tracks)
    return f"{outside} visible points lie outside the picture; TAP-Vid has them at its border" if outside else None


def _by_module(name: str) -> Callable[[TrackSheet, str], str | None]:
    """`write` of a format's module, imported when it is used."""

    def write(sheet: TrackSheet, path: str) -> str | None:
        import importlib

        importlib.import_module(f"genmojo_core.store.{name}").write(sheet, path)
        return None

    return write


def _read_tapvid(args: argparse.Namespace) -> TrackSheet:
    """npz, or a pickle after consent."""
    from genmojo_core.store import tapvid, tapvid_pickle

    if not str(args.file).lower().endswith((".pkl", ".pickle")):
        return tapvid.read(args.file, args.size)
    with tempfile.TemporaryDirectory(prefix="genmojo-tapvid-") as folder:
        return tapvid_pickle.read(args.file, folder, args.allow_pickle, args.video, args.size)


def _read_cotracker(args: argparse.Namespace) -> TrackSheet:
    from genmojo_core.store import cotracker_npz

    return cotracker_npz.read(args.file, args.size)


def _read_sleap(args: argparse.Namespace) -> TrackSheet:
    from genmojo_core.store import sleap

    return sleap.read(args.file, args.size, args.length)


def _read_deeplabcut(args: argparse.Namespace) -> TrackSheet:
    from genmojo_core.store import deeplabcut

    if args.size is None:
        raise GenmojoError("schema", "does not say the image size", args.file, "give --size WIDTHxHEIGHT")
    return deeplabcut.read(args.file, args.size, args.length)


def _read_cvat(args: argparse.Namespace) -> TrackSheet:
    from genmojo_core.store import cvat

    return cvat.read(args.file, args.size, args.length)


def _read_coco(args: argparse.Namespace) -> TrackSheet:
    from genmojo_core.store import coco

    return coco.read(args.file)


def _read_hdf5(args: argparse.Namespace) -> TrackSheet:
    from genmojo_core.store import tracks_hdf5

    return tracks_hdf5.read(args.file)


EXPORTS.update({
    f.name: f for f in (
        Format("tracks", "our point tracks, npz", _writer(_by_module("track_npz"))),
        Format("tapvid", "TAP-Vid npz", _writer(_write_tapvid)),
        Format("cotracker", "CoTracker npz", _writer(_by_module("cotracker_npz"))),
        Format("sleap", "SLEAP analysis HDF5", _writer(_by_module("sleap"))),
        Format("deeplabcut", "DeepLabCut csv", _writer(_by_module("deeplabcut"))),
        Format("cvat", "CVAT video XML 1.1", _writer(_by_module("cvat"))),
        Format("coco", "COCO keypoints JSON", _writer(_by_module("coco"))),
        Format("tracks-hdf5", "tracks group of a genmojo4d HDF5", _writer(_by_module("tracks_hdf5"))),
    )
})  # fmt: skip
IMPORTS.update({
    f.name: f for f in (
        Format("tapvid", "TAP-Vid npz or pickle", _reader(_read_tapvid), (".pkl", ".pickle")),
        Format("cotracker", "CoTracker npz", _reader(_read_cotracker)),
        Format("sleap", "SLEAP analysis HDF5", _reader(_read_sleap), (".analysis.h5",)),
        Format("deeplabcut", "DeepLabCut csv", _reader(_read_deeplabcut), (".csv",)),
        Format("cvat", "CVAT video XML 1.1", _reader(_read_cvat), (".xml",)),
        Format("coco", "COCO keypoints JSON", _reader(_read_coco), (".json",)),
        Format("tracks-hdf5", "tracks of a genmojo4d HDF5", _reader(_read_hdf5)),
    )
})  # fmt: skip
