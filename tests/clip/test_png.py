"""Palette PNGs keep their object ids: every bit depth, every row filter, interlaced, with junk chunks around."""

from __future__ import annotations

import struct
import zlib

import numpy as np
import pytest
from clip_files import labels, shared_clip
from hypothesis import given, settings
from hypothesis import strategies as st

from genmojo_core.clip import png
from genmojo_core.errors import GenmojoError


def chunk(name: bytes, body: bytes) -> bytes:
    return struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))


def packed(row: np.ndarray, depth: int) -> np.ndarray:
    """A row of samples as bytes."""
    bits = (row[:, None] >> np.arange(depth)[::-1]) & 1
    return np.packbits(bits.astype(np.uint8).ravel())


def filtered(rows: list[np.ndarray], kinds: list[int]) -> bytes:
    """Rows with PNG filters applied, one byte per pixel step (indices of 8 bits or fewer)."""
    out = b""
    above = np.zeros(len(rows[0]), np.int64)
    for row, kind in zip(rows, kinds, strict=True):
        row = row.astype(np.int64)
        left = np.concatenate([[0], row[:-1]])
        corner = np.concatenate([[0], above[:-1]])
        p = left + above - corner
        distances = np.abs(np.stack([p - left, p - above, p - corner]))
        paeth = np.choose(distances.argmin(0), [left, above, corner])
        guess = [0, left, above, (left + above) // 2, paeth][kind]
        out += bytes([kind]) + ((row - guess) % 256).astype(np.uint8).tobytes()
        above = row
    return out


def palette_file(index: np.ndarray, depth: int = 8, kinds: list[int] | None = None, extra: bytes = b"") -> bytes:
    """A palette PNG written by hand."""
    height, width = index.shape
    rows = [packed(row, depth) for row in index]
    data = zlib.compress(filtered(rows, kinds or [0] * height))
    header = struct.pack(">IIBBBBB", width, height, depth, 3, 0, 0, 0)
    palette = png.davis_palette()[: 2**depth].tobytes()
    middle = len(data) // 2
    parts = [chunk(b"IHDR", header), extra, chunk(b"PLTE", palette), chunk(b"tRNS", b"\x00\xff")]
    return png.SIGNATURE + b"".join([*parts, chunk(b"IDAT", data[:middle]), chunk(b"IDAT", data[middle:]),
                                     chunk(b"IEND", b"")])  # fmt: skip


@settings(max_examples=60, deadline=None)
@given(st.data())
def test_indices_survive_any_depth_size_and_filter(data):
    depth = data.draw(st.sampled_from([1, 2, 4, 8]))
    width, height = data.draw(st.integers(1, 19)), data.draw(st.integers(1, 7))
    kinds = data.draw(st.lists(st.integers(0, 4), min_size=height, max_size=height))
    index = (
        np.random.default_rng(data.draw(st.integers(0, 999))).integers(0, 2**depth, (height, width)).astype(np.uint8)
    )
    got = png.parse(palette_file(index, depth, kinds), "x").samples("x")
    np.testing.assert_array_equal(got, index)


def test_interlaced_palette_file():
    """Adam7: two by two pixels come in passes 1, 6 and 7."""
    rows = bytes([0, 7]) + bytes([0, 8]) + bytes([0, 9, 10])
    header = struct.pack(">IIBBBBB", 2, 2, 8, 3, 0, 0, 1)
    parts = [
        (b"IHDR", header),
        (b"PLTE", png.davis_palette().tobytes()),
        (b"IDAT", zlib.compress(rows)),
        (b"IEND", b""),
    ]
    data = png.SIGNATURE + b"".join(chunk(*part) for part in parts)
    np.testing.assert_array_equal(png.parse(data, "x").samples("x"), [[7, 8], [9, 10]])


def test_what_we_write_is_read_back():
    index = np.arange(256, dtype=np.uint8).reshape(8, 32)
    file = png.parse(png.encode_palette(index, png.davis_palette()), "x")
    assert (file.colour_type, file.depth) == (png.PALETTE, 8)
    np.testing.assert_array_equal(file.samples("x"), index)


def test_palette_is_that_of_davis():
    palette = png.davis_palette()
    assert palette[:5].tolist() == [[0, 0, 0], [128, 0, 0], [0, 128, 0], [128, 128, 0], [0, 0, 128]]
    assert palette[255].tolist() == [224, 224, 192]
    assert len(np.unique(palette, axis=0)) == 256


def test_a_text_chunk_never_reaches_the_decoder():
    """Catalogue row 24: a chunk that unpacks to much more than it weighs is dropped unread."""
    bomb = chunk(b"zTXt", b"Comment\x00\x00" + zlib.compress(bytes(50_000_000)))
    file = png.parse(palette_file(labels(), extra=bomb), "x")
    assert len(file.to_bytes()) < 3000
    np.testing.assert_array_equal(file.samples("x"), labels())


@pytest.mark.parametrize("at", [40, 60, 820, 830])
def test_one_flipped_byte_is_noticed(at):
    data = bytearray(palette_file(labels()))
    data[at] ^= 0xFF
    with pytest.raises(GenmojoError) as caught:
        png.parse(bytes(data), "mask.png").samples("mask.png")
    assert caught.value.code == "format"


@pytest.mark.clips
@pytest.mark.parametrize("name", ["blender-cross", "gold-fish"])
def test_shared_masks_decode_like_by_hand(name):
    """The first rows of a real file against an unfilter written out here."""
    path = next((shared_clip(name) / "Annotations" / name).glob("*.png"))
    file = png.parse(path.read_bytes(), str(path))
    raw = zlib.decompress(b"".join(body for kind, body in file.chunks if kind == b"IDAT"))
    stride = 1 + (file.width * file.depth + 7) // 8
    above = np.zeros(stride - 1, np.int64)
    got = file.samples(str(path))
    for y in range(file.height):
        row = raw[y * stride : (y + 1) * stride]
        line = np.zeros(stride - 1, np.int64)
        for x, value in enumerate(row[1:]):
            a, b, c = (line[x - 1] if x else 0), above[x], (above[x - 1] if x else 0)
            nearest = min((abs(b - c), 0, a), (abs(a - c), 1, b), (abs(a + b - 2 * c), 2, c))[2]
            line[x] = (value + [0, a, b, (a + b) // 2, nearest][row[0]]) % 256
        above = line
        bits = np.unpackbits(line.astype(np.uint8)).reshape(-1, file.depth)
        index = (bits * (1 << np.arange(file.depth)[::-1])).sum(1)[: file.width]
        np.testing.assert_array_equal(got[y], index)
