"""Files appear whole or not at all: temporary file beside the target, fsync, check, rename, fsync of the folder.

Measured (RELIABILITY.md b): of 100 kills during temp + fsync + replace none left an unreadable file, of 100 during
rewriting in place 84 did.
"""

from __future__ import annotations

import os
import secrets
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from genmojo_core.errors import GenmojoError

_WINDOWS_BUSY = (5, 32, 33)  # access denied, sharing violation, lock violation: a scanner holds the file
_RETRY_SECONDS = 2.5


def write_bytes(path: str | Path, data: bytes | memoryview) -> None:
    """Write a whole file; readers see the old contents or the new ones, never a mixture.

    Missing parent folders are made. Raises GenmojoError("io"); the old file is then untouched and no temporary stays.
    """
    with staged(path) as part:
        part.write_bytes(data)


def append_line(path: str | Path, line: str, first: bool = False) -> None:
    """Add a line to a text file, or begin it anew with its first. Raises GenmojoError("io")."""
    try:
        Path(path).parent.mkdir(parents=True, exist_ok=True)
        with open(path, "w" if first else "a", encoding="utf-8") as stream:
            stream.write(line + "\n")
    except OSError as error:
        raise _fault(error, path) from error


@contextmanager
def staged(path: str | Path) -> Iterator[Path]:
    """A temporary name (`<name>.<random>.part`) beside `path` to write to; renamed to `path` when the block ends well.

    The block may also check the finished file and raise. When it raises, `path` is untouched and the temporary is gone.
    Raises GenmojoError("io") for faults of the file system.
    """
    target = Path(os.path.realpath(path))  # through a link, so that the link stays one
    part = target.with_name(f"{target.name[:200]}.{secrets.token_hex(4)}.part")
    try:
        if target.is_dir():
            raise GenmojoError("io", "is a folder", str(path), "give a file name")
        target.parent.mkdir(parents=True, exist_ok=True)
        yield part
        _sync(part)
        _replace(part, target)
        _sync_folder(target.parent)
    except OSError as error:
        raise _fault(error, path) from error
    finally:
        if part.exists():
            part.unlink()


def check_writable(path: str | Path) -> None:
    """Raise GenmojoError("io") unless a file can be made at `path` (tried in the nearest folder that exists)."""
    target = Path(os.path.realpath(path))
    if target.is_dir():
        raise GenmojoError("io", "is a folder", str(path), "give a file name")
    folder = target.parent
    while not folder.exists() and folder != folder.parent:
        folder = folder.parent
    try:
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        raise _fault(error, path) from error


def _sync(path: Path) -> None:
    """Flush a finished file to the disk."""
    with open(path, "rb+") as stream:
        os.fsync(stream.fileno())


def _replace(part: Path, target: Path) -> None:
    """Rename; on Windows wait, bounded, for a scanner that holds the file."""
    deadline = time.monotonic() + _RETRY_SECONDS
    while True:
        try:
            os.replace(part, target)
            return
        except PermissionError as error:
            if getattr(error, "winerror", None) not in _WINDOWS_BUSY or time.monotonic() > deadline:
                raise
            time.sleep(0.05)


def _sync_folder(folder: Path) -> None:
    """Make the rename itself durable; Windows cannot open folders and needs it not."""
    if os.name == "nt":
        return
    handle = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def _fault(error: OSError, path: str | Path) -> GenmojoError:
    """The plain sentence of an operating system's error."""
    reason = (error.strerror or str(error)).lower()
    return GenmojoError("io", f"cannot be written ({reason})", str(path), "choose another place or free some space")
