"""`genmojo export` and `genmojo import`: scenes and tracks to and from the files of other programs.

Each format is one row of `EXPORTS` or `IMPORTS`; a module with further formats adds its rows to the two tables.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from genmojo_core.cli.arguments import frame_range, names, picture_size
from genmojo_core.cli.output import progress
from genmojo_core.errors import GenmojoError

Writer = Callable[[argparse.Namespace, Callable[[float], None]], dict[str, Any]]


@dataclass(frozen=True)
class Format:
    """One file format of another program.

    Args:
        name: as given to --to or --from. help: one line. run: does it, gets the arguments (file, output, frames,
            objects, extra) and a function that takes the share done; returns what the command prints.
        suffixes: file names the format is guessed from when reading.
    """

    name: str
    help: str
    run: Writer
    suffixes: tuple[str, ...] = ()


def add_commands(commands: Any) -> None:
    """Add `export` and `import`."""
    export = commands.add_parser("export", help="a scene or tracks as files of other programs")
    export.add_argument("file", metavar="FILE")
    export.add_argument("--to", required=True, choices=list(EXPORTS), metavar="FORMAT", help=_list(EXPORTS))
    export.add_argument("-o", "--output", required=True, metavar="FILE|DIR")
    export.add_argument("--frames", type=frame_range, metavar="A:B", help="positions in the scene, default all")
    export.add_argument("--objects", type=names, default=(), metavar="1,2", help="mask ids, 0 = background")
    export.add_argument("--extra", action="store_true", help="PLY: also write columns of ours (object_id)")
    export.add_argument("--review", choices=("not-rejected", "all", "approved"), default="not-rejected",
                        help="tracks of a project, by their review (default not-rejected)")  # fmt: skip
    export.set_defaults(run=run_export)
    importer = commands.add_parser("import", help="files of other programs as a scene or tracks")
    importer.add_argument("file", metavar="FILE|DIR")
    importer.add_argument("--from", dest="source_format", choices=list(IMPORTS), metavar="FORMAT", help=_list(IMPORTS))
    importer.add_argument("-o", "--output", required=True, metavar="FILE")
    importer.add_argument("--size", type=picture_size, metavar="WxH", help="picture size, for tracks whose file does "
                          "not say it")  # fmt: skip
    importer.add_argument("--length", type=int, metavar="T", help="frames of the clip, likewise")
    importer.add_argument("--video", metavar="NAME", help="which video of a TAP-Vid pickle")
    importer.add_argument("--allow-pickle", action="store_true", help="open a TAP-Vid pickle in a closed process")
    importer.set_defaults(run=run_import)


def run_export(args: argparse.Namespace) -> dict[str, Any]:
    """Write the format asked for."""
    with progress("exporting") as tell:
        return EXPORTS[args.to].run(args, tell)


def run_import(args: argparse.Namespace) -> dict[str, Any]:
    """Read the format named, or the one the file's name tells."""
    name = args.source_format or _guessed(args.file)
    with progress("importing") as tell:
        return {"format": name, **IMPORTS[name].run(args, tell)}


def chosen_frames(args: argparse.Namespace, count: int) -> list[int]:
    """Positions 0..count-1 that --frames names. Raises GenmojoError("argument") if there is none."""
    first, end = args.frames or (0, None)
    chosen = list(range(count))[first:end]
    if not chosen:
        raise GenmojoError("argument", f"the scene has frames 0 to {count - 1}", "--frames", "ask for some of them")
    return chosen


def chosen_objects(args: argparse.Namespace) -> list[int] | None:
    """Mask ids that --objects names, None for all. Raises GenmojoError("argument") for what is no number."""
    if not args.objects:
        return None
    if not all(part.isdigit() for part in args.objects):
        raise GenmojoError("argument", f"'{','.join(args.objects)}' are no mask ids", "--objects", "write 1,2")
    return [int(part) for part in args.objects]


def _ply(args: argparse.Namespace, tell: Callable[[float], None]) -> dict[str, Any]:
    """One frame (the first of --frames) as PLY."""
    from genmojo_core.store import ply, scene_hdf5

    scene = scene_hdf5.read(args.file)
    t = chosen_frames(args, len(scene))[0]
    splats = ply.of_frame(scene, t, chosen_objects(args))
    ply.write(splats, args.output, args.extra)
    tell(1.0)
    return {"path": args.output, "frame": int(scene.frame_index[t]), "gaussians": len(splats)}


def _ply_sequence(args: argparse.Namespace, tell: Callable[[float], None]) -> dict[str, Any]:
    """Every frame as PLY in a folder."""
    from genmojo_core.store import ply, scene_hdf5

    scene = scene_hdf5.read(args.file)
    chosen = chosen_frames(args, len(scene))
    files = ply.write_sequence(scene, args.output, chosen, chosen_objects(args), args.extra, tell)
    return {"path": args.output, "frames": len(files), "files": files}


def _from_ply(args: argparse.Namespace, tell: Callable[[float], None]) -> dict[str, Any]:
    """PLY, or a folder of them, as a scene."""
    from genmojo_core.store import ply_scene, scene_hdf5

    scene = ply_scene.read_scene(args.file)
    tell(0.5)
    scene_hdf5.write(scene, args.output)
    tell(1.0)
    return {"path": args.output, "frames": len(scene), "gaussians": len(scene.xyz)}


EXPORTS: dict[str, Format] = {
    f.name: f
    for f in (
        Format("ply", "3D Gaussian splats of one frame", _ply),
        Format("ply-sequence", "3D Gaussian splats, one file per frame", _ply_sequence),
    )
}
IMPORTS: dict[str, Format] = {f.name: f for f in (Format("ply", "3D Gaussian splats", _from_ply, (".ply",)),)}


def _list(formats: dict[str, Format]) -> str:
    """The formats for --help."""
    return "; ".join(f"{f.name}: {f.help}" for f in formats.values())


def _guessed(path: str) -> str:
    """The format of a file by its name; a folder by what lies in it. Raises GenmojoError("argument")."""
    file = Path(path)
    sample = [p.name for p in sorted(file.iterdir())] if file.is_dir() else [file.name]
    for name, form in IMPORTS.items():
        if any(n.lower().endswith(form.suffixes) for n in sample if form.suffixes):
            return name
    raise GenmojoError("argument", "its name tells no format", path, f"give --from with one of {', '.join(IMPORTS)}")
