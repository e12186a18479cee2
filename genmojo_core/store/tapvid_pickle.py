"""TAP-Vid's own pickles, unpacked by a child process that lets through arrays and texts only, after consent.

A pickle is a program. The child (`tapvid_pickle_process`) knows no class but numpy's arrays, refuses everything else,
and writes npz files, which are then read like any others.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from genmojo_core.errors import GenmojoError
from genmojo_core.store import tapvid
from genmojo_core.store.track_sheet import TrackSheet

MAX_BYTES = 8 << 30
_SECONDS = 600
_PROCESS = "genmojo_core.store.tapvid_pickle_process"


def unpack(path: str | Path, folder: str | Path, consent: bool) -> list[Path]:
    """One TAP-Vid npz per video of a pickle, in `folder`; returns their paths.

    Args:
        path: the pickle. folder: where to write. consent: the user agreed to open a pickle.
    Raises GenmojoError: "unsafe_pickle" without consent or if it holds more than arrays, "io", "size", "format".
    """
    file = Path(path)
    if not consent:
        raise GenmojoError("unsafe_pickle", "is a pickle, which can run code when it is opened", str(path),
                           "agree to open it in a closed process (--allow-pickle), or give npz")  # fmt: skip
    if not file.is_file():
        raise GenmojoError("io", "does not exist or is no file", str(path), "check the name")
    if file.stat().st_size > MAX_BYTES:
        raise GenmojoError("size", f"is larger than {MAX_BYTES >> 30} GiB", str(path))
    Path(folder).mkdir(parents=True, exist_ok=True)
    command = [sys.executable, "-m", _PROCESS, str(file.absolute()), str(Path(folder).absolute())]
    try:
        done = subprocess.run(command, capture_output=True, timeout=_SECONDS, check=False)
    except subprocess.TimeoutExpired as error:
        raise GenmojoError("size", f"takes more than {_SECONDS} s to open", str(path)) from error
    if done.returncode != 0:
        words = done.stderr.decode(errors="replace").strip().splitlines()
        code = "unsafe_pickle" if done.returncode == 3 else "format"
        raise GenmojoError(code, (words or ["cannot be opened"])[-1][:300], str(path), "do not trust this file")  # type: ignore[arg-type]
    return sorted(Path(folder).glob("*.npz"))


def read(
    path: str | Path,
    folder: str | Path,
    consent: bool,
    video: str | None = None,
    size: tuple[int, int] | None = None,
) -> TrackSheet:
    """The tracks of one video (default: the first) of a pickle, in pixels of its own frames or of `size`.

    Raises as `unpack`, and GenmojoError("argument") for an unknown video.
    """
    files = {file.stem: file for file in unpack(path, folder, consent)}
    if not files or (video is not None and video not in files):
        raise GenmojoError("argument", f"holds no video '{video}'" if files else "holds no video", str(path),
                           f"it has {', '.join(list(files)[:8]) or 'none'}")  # fmt: skip
    return tapvid.read(files[video] if video is not None else next(iter(files.values())), size)
