"""The child process that opens a TAP-Vid pickle: numpy arrays, numbers, texts, lists and dicts, and nothing else.

    python -m genmojo_core.store.tapvid_pickle_process FILE.pkl FOLDER

Exit 0: one npz per video in FOLDER; 3: the pickle asks for something else; 2: it is no TAP-Vid file. The reader below
looks classes up in a list and calls nothing else. Where the system can, the process bounds its memory and children.
"""

from __future__ import annotations

import io
import pickle
import re
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import cv2
import numpy as np

from genmojo_core.store.npz import write_arrays

_REFUSED, _BAD = 3, 2
_MEMORY = 24 << 30
_ALLOWED = {
    ("numpy", "ndarray"), ("numpy", "dtype"),
    ("numpy.core.multiarray", "_reconstruct"), ("numpy._core.multiarray", "_reconstruct"),
    ("numpy.core.multiarray", "scalar"), ("numpy._core.multiarray", "scalar"),
    ("numpy.core.numeric", "_frombuffer"), ("numpy._core.numeric", "_frombuffer"), ("_codecs", "encode"),
}  # fmt: skip


class RefusedError(Exception):
    """The pickle names something that is not on the list."""


class Reader(pickle.Unpickler):
    """An unpickler that knows arrays only."""

    def find_class(self, module: str, name: str) -> Any:
        """The class or function of that name if it is on the list; raises RefusedError."""
        if (module, name) not in _ALLOWED:
            raise RefusedError(f"asks for {module}.{name}")
        return super().find_class(module.replace("numpy.core", "numpy._core"), name)

    def persistent_load(self, pid: Any) -> Any:
        """Nothing lies outside the file; raises RefusedError."""
        raise RefusedError("refers to objects outside")


def main(arguments: Sequence[str]) -> int:
    """Unpack one file."""
    source, folder = Path(arguments[0]), Path(arguments[1])
    _give_up_rights()
    try:
        held = Reader(io.BytesIO(source.read_bytes())).load()
        for name, video in _videos(held):
            write_arrays(folder / f"{name}.npz", video)
    except RefusedError as error:
        sys.stderr.write(f"{error}\n")
        return _REFUSED
    except (pickle.UnpicklingError, EOFError, KeyError, TypeError, ValueError, AttributeError, IndexError) as error:
        sys.stderr.write(f"is no TAP-Vid pickle ({type(error).__name__}: {error})\n")
        return _BAD
    return 0


def _videos(held: Any) -> list[tuple[str, dict[str, np.ndarray]]]:
    """Name and arrays of every video: a dict of videos (DAVIS, RoboTAP) or a list of them (RGB-stacking)."""
    items = list(held.items()) if isinstance(held, Mapping) else list(enumerate(held))
    found: list[tuple[str, dict[str, np.ndarray]]] = []
    taken: set[str] = set()
    for name, video in items:
        points, occluded = np.asarray(video["points"], np.float32), np.asarray(video["occluded"], bool)
        if points.ndim != 3 or points.shape[2] != 2 or occluded.shape != points.shape[:2]:
            raise ValueError(f"video {name} has points {points.shape}")
        arrays = {"points": points, "occluded": occluded}
        size = _size(video.get("video"))
        if size is not None:
            arrays["size"] = np.array(size, np.int64)
        found.append((_file_name(str(name), taken), arrays))
    return found


def _size(frames: Any) -> tuple[int, int] | None:
    """(width, height) of frames: an array of them, or pictures as the bytes of JPEG files (Kinetics, RoboTAP)."""
    if isinstance(frames, np.ndarray) and frames.ndim == 4:
        return int(frames.shape[2]), int(frames.shape[1])
    first = frames[0] if isinstance(frames, np.ndarray | list) and len(frames) else None
    if not isinstance(first, bytes) or not first:
        return None
    picture = cv2.imdecode(np.frombuffer(first, np.uint8), cv2.IMREAD_GRAYSCALE)
    return None if picture is None else (picture.shape[1], picture.shape[0])


def _file_name(video: str, taken: set[str]) -> str:
    """A name for a video's file that no other video has."""
    plain = re.sub(r"[^A-Za-z0-9_-]", "_", video)[:100] or "video"
    name, count = plain, 1
    while name.lower() in taken:
        count += 1
        name = f"{plain}_{count}"
    taken.add(name.lower())
    return name


def _give_up_rights() -> None:
    """Bound memory, and start no further process."""
    if not sys.platform.startswith("linux"):
        return
    import resource

    resource.setrlimit(resource.RLIMIT_AS, (_MEMORY, _MEMORY))
    resource.setrlimit(resource.RLIMIT_NPROC, (0, 0))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
