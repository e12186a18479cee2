"""Opening HDF5 files that somebody else wrote: everything that could read other files or fill the memory is refused.

RELIABILITY.md c: external links and external storage read any file of the user, virtual datasets silently return
zeros, 1,400 bytes can declare 40 TB and 1 MB can expand to 1 GB. So the whole tree is walked, link by link, before one
value is read.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from genmojo_core.errors import GenmojoError

MAX_OBJECTS = 10_000  # groups and datasets in a file
MAX_DEPTH = 16  # groups in groups
MAX_DATASET_BYTES = 4 << 30  # declared, uncompressed
MAX_TOTAL_BYTES = 8 << 30  # all datasets together
MAX_CHUNK_BYTES = 64 << 20
RATIO_FROM_BYTES = 256 << 20  # below this any compression ratio is harmless
MAX_RATIO = 200
MAX_TEXT_BYTES = 16 << 20
MAX_JSON_DEPTH = 64
_FILTERS = {h5py.h5z.FILTER_DEFLATE, h5py.h5z.FILTER_SHUFFLE, h5py.h5z.FILTER_FLETCHER32}
_MAGIC = b"\x89HDF\r\n\x1a\n"
DAMAGE = (OSError, RuntimeError, KeyError, ValueError, TypeError)  # what h5py raises on damaged structure


@contextmanager
def open_hdf5(path: str | Path) -> Iterator[h5py.File]:
    """A file opened read-only after its whole tree was checked (`faults`).

    Raises GenmojoError: "io" missing or unreadable, "empty", "format" not HDF5, "corrupt" truncated or damaged,
    "hdf5_link", "size", "schema" as found by the walk.
    """
    _check_signature(path)
    try:
        file = h5py.File(path, "r", locking="best-effort")
    except DAMAGE as error:
        raise _unopenable(path, error) from error
    with file:
        try:
            check_tree(file, path)
        except DAMAGE as error:
            raise GenmojoError("corrupt", "its structure is damaged", str(path), "make the file again") from error
        yield file


def check_tree(file: h5py.File, path: str | Path) -> None:
    """Walk every link without following it. Raises GenmojoError naming the first object that is refused."""
    seen: set[int] = set()
    waiting: list[tuple[h5py.Group, str, int]] = [(file, "", 0)]
    total, count = 0, 0
    while waiting:
        group, name, depth = waiting.pop()
        if depth > MAX_DEPTH:
            raise GenmojoError("size", f"groups are nested deeper than {MAX_DEPTH}", f"{path}:{name}")
        count += len(group)
        if count > MAX_OBJECTS:
            raise GenmojoError("size", f"holds more than {MAX_OBJECTS} objects", str(path))
        for key in group:
            where = f"{path}:{name}/{key}"
            if not isinstance(group.get(key, getlink=True), h5py.HardLink):
                raise GenmojoError("hdf5_link", "is a link to elsewhere and is not followed", where, "store the data")
            item = group[key]
            address = h5py.h5o.get_info(item.id).addr
            if address in seen:
                raise GenmojoError("hdf5_link", "is a second name of another object", where, "store the data once")
            seen.add(address)
            if isinstance(item, h5py.Group):
                waiting.append((item, f"{name}/{key}", depth + 1))
            elif isinstance(item, h5py.Dataset):
                total += _check_dataset(item, where)
        if total > MAX_TOTAL_BYTES:
            raise GenmojoError("size", f"declares {total / 2**30:.0f} GiB of data", str(path))


def read_array(dataset: h5py.Dataset, where: str) -> np.ndarray:
    """All values of a dataset that passed the walk. Raises GenmojoError("corrupt") if a checksum does not match."""
    try:
        return np.asarray(dataset[()])
    except DAMAGE as error:
        raise GenmojoError("corrupt", "a checksum does not match or data is missing", where, "copy or make the file "
                           "again") from error  # fmt: skip


def parse_json(text: bytes | str, where: str) -> Any:
    """Strict JSON: no NaN, no infinity, no key twice, bounded size and depth. Raises GenmojoError("format")."""
    if len(text) > MAX_TEXT_BYTES:
        raise GenmojoError("size", f"is longer than {MAX_TEXT_BYTES >> 20} MiB", where)
    try:
        decoded = text.decode("utf-8") if isinstance(text, bytes) else text
        _check_json_depth(decoded)
        return json.loads(decoded, parse_constant=_no_constant, parse_float=_finite, object_pairs_hook=_no_twins)
    except (ValueError, RecursionError) as error:
        raise GenmojoError("format", f"is not valid JSON ({error})", where) from error


def json_text(value: Any, indent: int | None = None) -> str:
    """Strict JSON of plain data, numpy values included; numbers that are not finite (a budget without end) are null."""
    return json.dumps(_plain(value), allow_nan=False, indent=indent)


def _plain(value: Any) -> Any:
    """The value in types JSON knows."""
    if isinstance(value, Mapping):
        return {str(k): _plain(v) for k, v in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(v) for v in value]
    if isinstance(value, np.ndarray | np.generic):
        return _plain(value.tolist())
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value


def _check_signature(path: str | Path) -> None:
    """Missing, a folder, empty and foreign files each have their own sentence."""
    file = Path(path)
    if file.is_dir():
        raise GenmojoError("io", "is a folder, not a file", str(path))
    if not file.exists():
        raise GenmojoError("io", "does not exist", str(path), "check the name")
    try:
        with open(file, "rb") as stream:
            head = stream.read(len(_MAGIC))
    except OSError as error:
        raise GenmojoError("io", f"cannot be read ({(error.strerror or '').lower()})", str(path)) from error
    if not head:
        raise GenmojoError("empty", "is empty (0 bytes)", str(path), "make the file again")
    if head != _MAGIC:
        raise GenmojoError("format", "is not an HDF5 file", str(path), "give a scene written by genmojo optimize")


def _unopenable(path: str | Path, error: BaseException) -> GenmojoError:
    """Why HDF5 refused the file, in one sentence."""
    if "consistency flags" in str(error) or "already open for write" in str(error):
        return GenmojoError("corrupt", "another program is writing it or died while writing", str(path),
                            "close that program or make the file again")  # fmt: skip
    return GenmojoError("corrupt", "is truncated or damaged", str(path), "copy or make the file again")


def _check_dataset(dataset: h5py.Dataset, where: str) -> int:
    """Check one dataset's storage without reading it; returns its declared bytes."""
    if dataset.is_virtual:
        raise GenmojoError("hdf5_link", "is a virtual dataset (its values lie in other files)", where)
    if dataset.external:
        raise GenmojoError("hdf5_link", "keeps its values in another file", where)
    layout = dataset.id.get_create_plist()
    for number in range(layout.get_nfilters()):
        code = layout.get_filter(number)[0]
        if code not in _FILTERS:
            raise GenmojoError("format", f"uses the unknown HDF5 filter {code}", where, "use gzip")
    size = math.prod(dataset.shape or ()) * dataset.id.get_type().get_size()
    if size > MAX_DATASET_BYTES:
        raise GenmojoError("size", f"declares {size / 2**30:.1f} GiB, the limit is {MAX_DATASET_BYTES >> 30}", where)
    chunk = math.prod(dataset.chunks or (0,)) * dataset.id.get_type().get_size()
    if chunk > MAX_CHUNK_BYTES:
        raise GenmojoError("size", f"has chunks of {chunk >> 20} MiB", where)
    if size > RATIO_FROM_BYTES and size > MAX_RATIO * dataset.id.get_storage_size():
        raise GenmojoError("size", f"would expand {MAX_RATIO} times and more to {size >> 20} MiB", where)
    return size


def _check_json_depth(text: str) -> None:
    """Bound the nesting before the parser recurses (brackets inside strings count too, which is harmless)."""
    depth = 0
    for character in text:
        if character in "[{":
            depth += 1
            if depth > MAX_JSON_DEPTH:
                raise ValueError(f"nested deeper than {MAX_JSON_DEPTH}")
        elif character in "]}":
            depth -= 1


def _no_constant(name: str) -> float:
    """Python would accept NaN and Infinity, JSON does not."""
    raise ValueError(f"{name} is no JSON number")


def _finite(text: str) -> float:
    """Python reads 1e999 as infinity."""
    value = float(text)
    if not math.isfinite(value):
        raise ValueError(f"{text} is out of range")
    return value


def _no_twins(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """An object whose keys all differ."""
    found = dict(pairs)
    if len(found) != len(pairs):
        raise ValueError("a key occurs twice")
    return found
