"""Files of tracks by format: which endings they have, how they are written, read and told apart. No Qt."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import h5py

from genmojo_core.errors import GenmojoError
from genmojo_core.store import coco, cotracker_npz, cvat, deeplabcut, sleap, tapvid, track_npz, tracks_hdf5
from genmojo_core.store.track_sheet import TrackSheet

Size = tuple[int, int]
PICKLES = (".pkl", ".pickle")


@dataclass(frozen=True)
class Format:
    """A format: title, ending, writer of a sheet, reader for a clip of a size and a number of frames."""

    name: str
    title: str
    ending: str
    write: Callable[[TrackSheet, Path], None]
    read: Callable[[Path, Size, int], TrackSheet]


def _npz(path: Path, size: Size, frames: int) -> TrackSheet:
    """An npz by what it holds: TAP-Vid, CoTracker or ours."""
    return track_npz.read(path, size)


FORMATS = (
    Format("genmojo", "GenMOJO tracks", "npz", track_npz.write, _npz),
    Format("tapvid", "TAP-Vid", "npz", tapvid.write, _npz),
    Format("cotracker", "CoTracker", "npz", cotracker_npz.write, _npz),
    Format("hdf5", "GenMOJO HDF5", "h5", tracks_hdf5.write, lambda p, size, n: tracks_hdf5.read(p)),
    Format("sleap", "SLEAP analysis", "analysis.h5", sleap.write, sleap.read),
    Format("deeplabcut", "DeepLabCut", "csv", deeplabcut.write, deeplabcut.read),
    Format("cvat", "CVAT video", "xml", cvat.write, cvat.read),
    Format("coco", "COCO keypoints", "json", coco.write, lambda p, size, n: coco.read(p)),
)


def patterns() -> str:
    """All endings that can be read, as a file dialog wants them."""
    endings = dict.fromkeys(f.ending.rsplit(".", 1)[-1] for f in FORMATS)
    return " ".join([*(f"*.{e}" for e in endings), *(f"*{e}" for e in PICKLES)])


def told_apart(path: Path) -> Format:
    """The format of a file by what is in it. Raises GenmojoError: "io", "format"."""
    try:
        with open(path, "rb") as stream:
            head = stream.read(64).removeprefix(b"\xef\xbb\xbf").lstrip()
    except OSError as error:
        raise GenmojoError("io", f"cannot be read ({error.strerror})", str(path), "check the name") from error
    by_name = {f.name: f for f in FORMATS}
    if head.startswith(b"PK"):
        return by_name["genmojo"]
    if head.startswith(b"\x89HDF"):
        return by_name["sleap" if _has_nodes(path) else "hdf5"]
    if head.startswith((b"{", b"[")):
        return by_name["coco"]
    if head.startswith(b"<"):
        return by_name["cvat"]
    if path.suffix.lower() == ".csv":
        return by_name["deeplabcut"]
    raise GenmojoError("format", "holds no tracks we know", str(path), f"give one of {patterns()}")


def named(path: Path, form: Format) -> Path:
    """The path with the ending of its format; the ending of another format goes."""
    name = path.name
    if name.lower().endswith("." + form.ending):
        return path
    for ending in sorted((f.ending for f in FORMATS), key=len, reverse=True):
        name = name.removesuffix("." + ending)
    return path.with_name(f"{name}.{form.ending}")


def _has_nodes(path: Path) -> bool:
    """Whether an HDF5 file is SLEAP's. Raises GenmojoError("format")."""
    try:
        with h5py.File(path) as file:
            return "node_names" in file
    except OSError as error:
        raise GenmojoError("format", "is no HDF5 file or is damaged", str(path), "export it again") from error
