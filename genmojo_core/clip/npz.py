"""npz files read without trust: no pickles, sizes known before anything is allocated, one frame at a time."""

from __future__ import annotations

import ast
import math
import zipfile
import zlib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import IO

import numpy as np

from genmojo_core.clip.limits import check_limit
from genmojo_core.errors import GenmojoError


@dataclass(frozen=True)
class Header:
    """What an array in an npz file declares: shape, dtype, memory order."""

    shape: tuple[int, ...]
    dtype: np.dtype
    fortran: bool

    @property
    def nbytes(self) -> int:
        """Bytes of its data."""
        return math.prod(self.shape) * self.dtype.itemsize


@dataclass(frozen=True)
class NpzFile:
    """An npz file whose headers were checked; arrays are read on demand.

    Args:
        path: the file. headers: array name -> what it declares.
    """

    path: Path
    headers: Mapping[str, Header]

    def __contains__(self, name: str) -> bool:
        return name in self.headers

    def first_of(self, *names: str) -> str | None:
        """The first of some names that is there."""
        return next((name for name in names if name in self.headers), None)

    def array(self, name: str) -> np.ndarray:
        """A whole array. Raises GenmojoError: "schema" if it is not there, "size", "format"."""
        header = self._header(name)
        check_limit("held_array_bytes", header.nbytes, self.where(name))
        with _opened(self.path, name) as stream:
            _read_header(stream, self.where(name))
            data = _exactly(stream, header.nbytes, self.where(name))
            stream.read(1)  # the end: here the zip compares its checksum
        flat = np.frombuffer(data, header.dtype)
        return flat.reshape(header.shape[::-1]).T if header.fortran else flat.reshape(header.shape)

    def rows(self, name: str, first: int, end: int) -> Iterator[np.ndarray]:
        """Entries first..end-1 along the first axis, one in memory at a time. Raises as `array`."""
        header = self._header(name)
        if header.fortran:
            yield from self.array(name)[first:end]
            return
        size = header.nbytes // max(1, header.shape[0])
        check_limit("held_array_bytes", size, self.where(name))
        with _opened(self.path, name) as stream:
            _read_header(stream, self.where(name))
            for i in range(end):
                data = _exactly(stream, size, self.where(name))
                if i >= first:
                    yield np.frombuffer(data, header.dtype).reshape(header.shape[1:])
            if end == header.shape[0]:
                stream.read(1)

    def where(self, name: str) -> str:
        """File and array, for messages."""
        return f"{self.path}: {name}"

    def _header(self, name: str) -> Header:
        if name not in self.headers:
            held = ", ".join(sorted(self.headers)[:8]) or "nothing"
            raise GenmojoError("schema", f"holds no '{name}' (it holds {held})", str(self.path), f"store '{name}'")
        return self.headers[name]


def open_npz(path: Path) -> NpzFile:
    """Check the headers of all arrays in an npz file.

    Raises GenmojoError: "io" if it cannot be read; "format" if it is no npz; "unsafe_pickle" if it holds Python
    objects; "size" if it holds too much.
    """
    headers: dict[str, Header] = {}
    try:
        with zipfile.ZipFile(path) as archive:
            names = [n for n in archive.namelist() if n.endswith(".npy")]
            check_limit("array_names", len(archive.namelist()), str(path))
            for member in names:
                with archive.open(member) as stream:
                    headers[member[:-4]] = _read_header(stream, f"{path}: {member[:-4]}")
                _check_member(archive.getinfo(member), headers[member[:-4]], f"{path}: {member[:-4]}")
    except OSError as error:
        raise GenmojoError("io", f"cannot be read ({error.strerror})", str(path), "check the path") from error
    except (zipfile.BadZipFile, zlib.error, RuntimeError, EOFError, ValueError) as error:
        raise GenmojoError("format", "is no npz file or is damaged", str(path), "write it again with numpy") from error
    return NpzFile(path, headers)


def _read_header(stream: IO[bytes], where: str) -> Header:
    """The npy header at the start of a stream, read strictly: numpy's own reader also mends headers of Python 2."""
    start = _exactly(stream, 8, where)
    width = {1: 2, 2: 4, 3: 4}.get(start[6])
    if start[:6] != b"\x93NUMPY" or width is None:
        raise GenmojoError("format", "is no numpy array", where, "write it again with numpy")
    length = int.from_bytes(_exactly(stream, width, where), "little")
    check_limit("array_header", length, where)
    shape, fortran, dtype = _declared(_exactly(stream, length, where), where)
    if dtype.hasobject:
        raise GenmojoError("unsafe_pickle", "holds Python objects, which could run code when read", where,
                           "store plain numbers")  # fmt: skip
    check_limit("array_rank", len(shape), where)
    header = Header(shape, dtype, fortran)
    check_limit("array_bytes", header.nbytes, where)
    return header


def _declared(text: bytes, where: str) -> tuple[tuple[int, ...], bool, np.dtype]:
    """Shape, order and dtype of a header's text, a Python dict of constants."""
    try:
        fields = ast.literal_eval(text.decode("utf-8").strip())
        shape, fortran, dtype = fields["shape"], fields["fortran_order"], np.dtype(fields["descr"])
        good = len(fields) == 3 and isinstance(fortran, bool) and isinstance(shape, tuple)
        good = good and all(type(n) is int and 0 <= n < 2**48 for n in shape)
    except (ValueError, TypeError, KeyError, SyntaxError, RecursionError, MemoryError):
        good = False
    if not good:
        raise GenmojoError("format", "has a header that is no numpy array's", where, "write it again with numpy")
    return shape, fortran, dtype


def _check_member(info: zipfile.ZipInfo, header: Header, where: str) -> None:
    """The zip's own size must be what the array declares, give or take its header."""
    if not header.nbytes < info.file_size < header.nbytes + 70_000:
        raise GenmojoError("format", f"declares {header.nbytes} bytes but {info.file_size} are there", where,
                           "write it again with numpy")  # fmt: skip


@contextmanager
def _opened(path: Path, name: str) -> Iterator[IO[bytes]]:
    """One array's bytes; damage found while reading is a GenmojoError."""
    try:
        with zipfile.ZipFile(path) as archive, archive.open(f"{name}.npy") as stream:
            yield stream
    except (zipfile.BadZipFile, zlib.error, RuntimeError, EOFError, ValueError) as error:
        raise GenmojoError("format", "is damaged", f"{path}: {name}", "write it again with numpy") from error
    except OSError as error:
        raise GenmojoError("io", f"cannot be read ({error.strerror})", str(path), "check the path") from error


def _exactly(stream: IO[bytes], count: int, where: str) -> bytes:
    """That many bytes; raises GenmojoError("format") if there are fewer."""
    data = stream.read(count)
    if len(data) != count:
        raise GenmojoError("format", f"ends after {len(data)} of {count} bytes", where, "write it again with numpy")
    return data
