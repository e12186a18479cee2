"""Previews through a memory-mapped file with three slots: the latest wins, the writer never waits (VIEWER.md 4).

The file begins with a header of 64-bit words; every word is written by one aligned store. The writer fills a slot that
is neither the newest nor held by the reader, then names it the newest. A reader marks the newest as held, copies it,
and lets go. Two things make a torn read impossible: each slot has a counter that is odd while the slot is written and
is compared before and after copying, and the copy must have the checksum that the writer noted.

What lies in a slot: a JSON head, then numpy arrays, each at a multiple of 64 bytes.
"""

from __future__ import annotations

import json
import mmap
import os
import time
import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Any

import numpy as np

from genmojo_core.errors import GenmojoError

MAGIC = int.from_bytes(b"GMJBUS01", "little")
SLOTS = 3
HEADER_BYTES = 4096
_ALIGN = 64
# Words of the header.
_MAGIC, _CAPACITY, _FRONT, _HELD, _SEQUENCE, _CLOSED = range(6)
_SLOT0, _SLOT_WORDS = 16, 8  # per slot: counter, sequence, bytes, checksum, time (ns)
_COUNTER, _SLOT_SEQUENCE, _BYTES, _CHECKSUM, _TIME = range(5)
_NOBODY = SLOTS
_DTYPES = ("u1", "u2", "u4", "u8", "i4", "i8", "f2", "f4", "f8")


@dataclass(frozen=True)
class Message:
    """One preview as read: JSON `meta`, arrays by name (copies), its number and when it was published (monotonic s)."""

    meta: dict[str, Any]
    arrays: dict[str, np.ndarray]
    sequence: int
    published: float


class BusWriter:
    """The worker's end. Use as a context manager or call `close`.

    Args:
        path: file to make; an existing one is replaced. capacity: bytes of one slot.
    """

    def __init__(self, path: str | Path, capacity: int) -> None:
        self.path = Path(path)
        self.capacity = -(-capacity // 4096) * 4096
        part = self.path.with_suffix(".making")
        with open(part, "wb") as stream:
            stream.truncate(HEADER_BYTES + SLOTS * self.capacity)
        self._map, self._words = _mapped(part)
        self._words[_CAPACITY] = self.capacity
        self._words[_FRONT] = self._words[_HELD] = _NOBODY
        self._words[_MAGIC] = MAGIC
        os.replace(part, self.path)

    def fits(self, meta: Mapping[str, Any], arrays: Mapping[str, np.ndarray]) -> bool:
        """True if a slot can take it; if not, open a larger bus."""
        return size_of(meta, arrays) <= self.capacity

    def publish(self, meta: Mapping[str, Any], arrays: Mapping[str, np.ndarray]) -> int:
        """Put a preview in place of the last one; returns its number. Raises GenmojoError("size") if it is too large.

        Never waits for a reader.
        """
        slot = self._free_slot()
        base = HEADER_BYTES + slot * self.capacity
        words = self._slot_words(slot)
        head, places, total = _layout(meta, arrays)
        if total > self.capacity:
            raise GenmojoError("size", f"a preview of {total} bytes does not fit {self.capacity}", str(self.path))
        words[_COUNTER] += np.uint64(1)  # odd: being written
        self._map[base : base + len(head)] = head
        for name, offset in places.items():
            array = np.ascontiguousarray(arrays[name])
            target = np.frombuffer(self._map, np.uint8, array.nbytes, base + offset)
            target[:] = array.reshape(-1).view(np.uint8)
        sequence = int(self._words[_SEQUENCE]) + 1
        view = memoryview(self._map)[base : base + total]
        words[_CHECKSUM] = zlib.crc32(view)
        view.release()
        words[_SLOT_SEQUENCE], words[_BYTES], words[_TIME] = sequence, total, time.monotonic_ns()
        words[_COUNTER] += np.uint64(1)  # even: whole
        self._words[_FRONT] = slot
        self._words[_SEQUENCE] = sequence
        return sequence

    def close(self) -> None:
        """Tell readers that nothing more comes. The file stays for them; whoever made the run folder removes it."""
        self._words[_CLOSED] = 1

    def __enter__(self) -> BusWriter:
        return self

    def __exit__(self, *_: type[BaseException] | BaseException | TracebackType | None) -> None:
        self.close()

    def _free_slot(self) -> int:
        taken = {int(self._words[_FRONT]), int(self._words[_HELD])}
        return next(s for s in range(SLOTS) if s not in taken)

    def _slot_words(self, slot: int) -> np.ndarray:
        start = _SLOT0 + slot * _SLOT_WORDS
        return self._words[start : start + _SLOT_WORDS]


class BusReader:
    """A window's end. Raises GenmojoError("io") or ("format") when opened on what is no bus."""

    def __init__(self, path: str | Path) -> None:
        self.path = Path(path)
        try:
            if self.path.stat().st_size < HEADER_BYTES:
                raise GenmojoError("format", "is no preview bus", str(path))
            self._map, self._words = _mapped(self.path)
        except OSError as error:
            raise GenmojoError("io", "cannot be opened", str(path)) from error
        self._capacity = int(self._words[_CAPACITY])
        fits = HEADER_BYTES + SLOTS * self._capacity == len(self._map)
        if int(self._words[_MAGIC]) != MAGIC or not fits:
            raise GenmojoError("format", "is no preview bus", str(path))
        self.seen = 0

    @property
    def sequence(self) -> int:
        """Number of the newest preview, 0 if there is none."""
        return int(self._words[_SEQUENCE])

    @property
    def closed(self) -> bool:
        """True once the writer has closed the bus."""
        return bool(self._words[_CLOSED])

    def latest(self, attempts: int = 8) -> Message | None:
        """The newest preview if it is newer than the last one read, else None.

        A copy disturbed by the writer (only where two windows read the same bus) is made again, at most `attempts`
        times; the next call goes on.
        """
        for _ in range(attempts):
            if self.sequence == self.seen:
                return None
            slot = int(self._words[_FRONT])
            if slot >= SLOTS:
                return None
            self._words[_HELD] = slot
            try:
                message = self._copied(slot)
            finally:
                self._words[_HELD] = _NOBODY
            if message is not None:
                self.seen = message.sequence
                return message
        return None

    def close(self) -> None:
        """Let go of the file."""
        del self._words
        self._map.close()

    def _copied(self, slot: int) -> Message | None:
        """What lies in a slot, or None if it was written meanwhile."""
        start = _SLOT0 + slot * _SLOT_WORDS
        words = self._words[start : start + _SLOT_WORDS]
        counter, sequence, total = int(words[_COUNTER]), int(words[_SLOT_SEQUENCE]), int(words[_BYTES])
        checksum, published = int(words[_CHECKSUM]), int(words[_TIME])
        if counter % 2 or not 0 < total <= self._capacity:
            return None
        base = HEADER_BYTES + slot * self._capacity
        data = self._map[base : base + total]
        if int(words[_COUNTER]) != counter or zlib.crc32(data) != checksum:
            return None
        return Message(*_unpacked(data, str(self.path)), sequence, published * 1e-9)


def size_of(meta: Mapping[str, Any], arrays: Mapping[str, np.ndarray]) -> int:
    """Bytes a preview takes in a slot."""
    return _layout(meta, arrays)[2]


def _mapped(path: Path) -> tuple[mmap.mmap, np.ndarray]:
    """The file in memory and its header as 64-bit words."""
    with open(path, "r+b") as stream:
        memory = mmap.mmap(stream.fileno(), 0)
    return memory, np.frombuffer(memory, np.uint64, HEADER_BYTES // 8)


def _layout(meta: Mapping[str, Any], arrays: Mapping[str, np.ndarray]) -> tuple[bytes, dict[str, int], int]:
    """Head bytes, offset of each array, bytes in all. Offsets in the head count from the head's end, rounded up."""
    rows, places, offset = [], {}, 0
    for name, array in arrays.items():
        if array.dtype.str[1:] not in _DTYPES:
            raise GenmojoError("schema", f"{name} of type {array.dtype} cannot be a preview", "preview")
        rows.append([name, array.dtype.str[1:], list(array.shape), offset])
        places[name] = offset
        offset = _rounded(offset + array.nbytes)
    text = json.dumps({"meta": meta, "arrays": rows}, separators=(",", ":")).encode()
    head = len(text).to_bytes(8, "little") + text
    start = _rounded(len(head))
    return head, {name: start + place for name, place in places.items()}, start + offset


def _unpacked(data: bytes, where: str) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    """The inverse of `_layout`; arrays are views of `data`, which is the reader's own copy."""
    length = int.from_bytes(data[:8], "little")
    try:
        head = json.loads(data[8 : 8 + length])
        start = _rounded(8 + length)
        arrays = {
            name: np.frombuffer(data, dtype, int(np.prod(shape, dtype=np.int64)), start + offset).reshape(shape)
            for name, dtype, shape, offset in head["arrays"]
            if dtype in _DTYPES
        }
        return dict(head["meta"]), arrays
    except (ValueError, KeyError, TypeError) as error:
        raise GenmojoError("format", "holds a preview of another program version", where) from error


def _rounded(count: int) -> int:
    return -(-count // _ALIGN) * _ALIGN
