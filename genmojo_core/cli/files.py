"""`genmojo inspect` and `genmojo validate`: what is in a file, and whether it can be trusted."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from genmojo_core.errors import GenmojoError

if TYPE_CHECKING:
    from genmojo_core.store.project_file import ClipInfo


def add_commands(commands: Any) -> None:
    """Add `inspect` and `validate`."""
    inspect = commands.add_parser("inspect", help="what a scene, a tracks npz, an annotation or a clip holds")
    inspect.add_argument("file", metavar="FILE")
    inspect.set_defaults(run=run_inspect)
    validate = commands.add_parser("validate", help="check a scene, tracks or annotation file, naming every fault")
    validate.add_argument("file", metavar="FILE")
    validate.set_defaults(run=run_validate)


def run_inspect(args: argparse.Namespace) -> dict[str, Any]:
    """Describe a file by what it is: npz of tracks, annotation project, clip (folder or video), else a scene."""
    from genmojo_core.store import npz, scene_hdf5

    kind = _kind(args.file)
    if kind == "tracks":
        tracks = npz.read_tracks(args.file)
        return {"kind": kind, "tracks": len(tracks.xy), "frames": tracks.xy.shape[1], "size": list(tracks.size),
                "objects": sorted({int(i) for i in tracks.object}), "visible_share": float(tracks.visible.mean()),
                "has_xyz": tracks.xyz is not None}  # fmt: skip
    if kind == "clip":
        return {"kind": kind, **_clip(args.file)}
    if kind == "project":
        return {"kind": kind, **_project(Path(args.file))}
    return {"kind": kind, **scene_hdf5.inspect(args.file)}


def run_validate(args: argparse.Namespace) -> dict[str, Any]:
    """All faults; exit 2 if there is one."""
    from genmojo_core.store import npz, project_file, scene_hdf5

    kind = _kind(args.file)
    try:
        if kind == "project":
            loaded = project_file.load(Path(args.file))
            faults = [*project_file.verify(Path(args.file)), *_changed_pictures(loaded.info)]
        elif kind == "tracks":
            npz.read_tracks(args.file)
            faults = []
        else:
            faults = scene_hdf5.validate(args.file)
    except GenmojoError as error:
        faults = [error.sentence()]
    return {"file": args.file, "valid": not faults, "faults": faults, "exit_code": 2 if faults else 0}


def _changed_pictures(info: ClipInfo) -> list[str]:
    """Frames whose pictures are not those that were annotated, where the clip is there and the project knows them."""
    from genmojo_core.clip import digests

    if not any(info.sha256) or not Path(info.path).exists():
        return []
    now = dict(digests.of_frames(info.path))
    changed, _ = digests.differing(info.sha256, [now.get(frame, "") for frame in range(info.frames)])
    return [f"frame {frame} has another picture than when it was annotated" for frame in changed]


def _kind(path: str) -> str:
    """By content: an npz is a zip file; folders and everything that is no HDF5 file and no zip are clips."""
    file = Path(path)
    if not file.exists():
        raise GenmojoError("io", "does not exist", path, "check the name")
    if file.is_dir():
        return "clip"
    with open(file, "rb") as stream:
        head = stream.read(16)
    if head.startswith(b"PK"):
        return "tracks"
    if head.startswith(b"SQLite format 3"):
        return "project"
    return "clip" if file.suffix.lower() in (".mp4", ".mov", ".mkv", ".webm", ".avi", ".png", ".jpg") else "scene"


def _project(path: Path) -> dict[str, Any]:
    """An annotation: how far it is, who worked on it how long (with their consent), where it can be returned to."""
    from genmojo_core.store import audit, project_file, work_figures
    from genmojo_core.store.time_sheet import time_sheet
    from genmojo_core.tracks.statistics import clip_figures

    loaded = project_file.load(path)
    rows, figures = loaded.log.rows, clip_figures(loaded.annotation)
    consent = figures["consent"] == "yes"
    keys = work_figures.placed_keys(audit.entries(path)) if consent else {}
    if not consent:
        figures.pop("people", None)
    return {"clip": loaded.info.name, "size": list(loaded.info.size), **figures,
            "edits": sum(row.verb == "do" for row in rows),
            "checkpoints": [row.title for row in rows if row.verb == "checkpoint"],
            "time": [vars(day) for day in time_sheet(rows, keys=keys)] if consent else [],
            "backups": len(project_file.backups(path))}  # fmt: skip


def _clip(path: str) -> dict[str, Any]:
    """A clip, read small."""
    from genmojo_core.clip import folders

    clip = folders.read(path, short_side=64)
    channels = ("masks", "depth", "cameras", "flow", "background", "tracks")
    return {"name": clip.name, "frames": len(clip), "size": list(clip.source_size), "pixel_aspect": clip.pixel_aspect,
            "objects": [{"id": int(i), "name": n} for i, n in zip(clip.object_ids, clip.object_names, strict=True)],
            "seconds": float(clip.seconds[-1]),
            "channels": [c for c in channels if getattr(clip, c) is not None]}  # fmt: skip
