"""What a path is that somebody opens or drops on the window. Knows no Qt."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from genmojo_core.errors import GenmojoError

Kind = Literal["clip", "scene", "project", "ply", "run"]

SHARED_SHORT_SIDE = 540  # pixels at which the shared clip is held; annotation reads full frames on its own
VIDEOS = (".mp4", ".mov", ".mkv", ".webm", ".avi", ".m4v")
PICTURES = (".jpg", ".jpeg", ".png", ".bmp", ".webp", ".tif", ".tiff")


def kind_of(path: str | Path) -> Kind:
    """Which kind of thing lies there, by its name.

    A folder in which a worker was asked for something is a run, one with PLY files a moving splat, any
    other folder a clip.

    Raises:
        GenmojoError("io"): nothing is there. ("format"): a file that the app does not open.
    """
    path = Path(path)
    if not path.exists():
        raise GenmojoError("io", "does not exist", str(path), "check the name")
    if path.is_dir():
        return "run" if is_run(path) else "ply" if any(path.glob("*.ply")) else "clip"
    suffix = path.suffix.lower()
    by_suffix: dict[str, Kind] = {".h5": "scene", ".hdf5": "scene", ".genmojo": "project", ".ply": "ply"}
    if suffix in by_suffix:
        return by_suffix[suffix]
    if suffix in VIDEOS + PICTURES:
        return "clip"
    raise GenmojoError(
        "format",
        f"'{suffix or path.name}' is no kind of file that the app opens",
        str(path),
        "open a clip folder, a video, a scene (.h5), a project (.genmojo) or a .ply",
    )


def is_run(folder: Path) -> bool:
    """True for a folder in which a worker keeps a run."""
    return any((folder / name).exists() for name in ("lock.json", "request.json", "events.jsonl"))


def file_filter() -> str:
    """The filter of the open dialog."""
    endings = " ".join(f"*{suffix}" for suffix in (".h5", ".hdf5", ".genmojo", ".ply", *VIDEOS, *PICTURES))
    return f"GenMOJO ({endings});;*"
