"""PNG on the level of chunks: sizes before decoding, palette indices as they are stored, palette files written.

OpenCV turns palettes into colours, which loses object ids. Here a palette file's header is rewritten to say "grey", so
that the same library unpacks the indices untouched. Chunks nobody needs (text, profiles) never reach the decoder.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterable
from dataclasses import dataclass

import cv2
import numpy as np

from genmojo_core.clip.limits import check_image_size
from genmojo_core.errors import GenmojoError

SIGNATURE = b"\x89PNG\r\n\x1a\n"
GREY, COLOUR, PALETTE, GREY_ALPHA, COLOUR_ALPHA = 0, 2, 3, 4, 6  # colour types of the header
_NEEDED = (b"PLTE", b"tRNS", b"IDAT", b"eXIf")


@dataclass(frozen=True)
class PngFile:
    """A checked PNG file: its header and the chunks that matter, in order."""

    width: int
    height: int
    depth: int  # bits per sample
    colour_type: int
    interlace: int
    chunks: tuple[tuple[bytes, bytes], ...]  # (name, data) of _NEEDED

    def to_bytes(self) -> bytes:
        """The file again, with the needed chunks only."""
        return _assemble(self._header(self.colour_type), self.chunks)

    def samples(self, where: str) -> np.ndarray:
        """(H, W) or (H, W, C) samples as stored: palette indices, grey levels of any depth, or RGB(A) colours.

        Raises GenmojoError("format") if the pixel data cannot be decoded.
        """
        if self.colour_type in (COLOUR, COLOUR_ALPHA, GREY_ALPHA):
            pixels = _decode(self.to_bytes(), cv2.IMREAD_UNCHANGED, where)
            return pixels if pixels.ndim == 2 else np.ascontiguousarray(_bgr_to_rgb(pixels))
        data = [(name, body) for name, body in self.chunks if name == b"IDAT"]
        pixels = _decode(_assemble(self._header(GREY), data), cv2.IMREAD_UNCHANGED, where)
        pixels = pixels if pixels.ndim == 2 else pixels[..., 0]
        if self.depth >= 8:
            return pixels
        return pixels // (255 // (2**self.depth - 1))  # the decoder stretches 1, 2 and 4 bits to 0..255

    def _header(self, colour_type: int) -> bytes:
        return struct.pack(">IIBBBBB", self.width, self.height, self.depth, colour_type, 0, 0, self.interlace)


def parse(data: bytes, where: str) -> PngFile:
    """Check a PNG file's structure without decoding it.

    Raises GenmojoError: "format" if it is no PNG, cut short or damaged; "size" if it is too large.
    """
    if not data.startswith(SIGNATURE):
        raise GenmojoError("format", "is not a PNG file", where, "check the file's name")
    header: tuple[int, ...] | None = None
    kept: list[tuple[bytes, bytes]] = []
    for name, body in _chunks(data, where):
        if header is None:
            header = _parse_header(name, body, where)
        elif name in _NEEDED:
            kept.append((name, body))
    if header is None or not any(name == b"IDAT" for name, _ in kept):
        raise GenmojoError("format", "holds no pixels", where, "write the file again")
    width, height, depth, colour_type, _, _, interlace = header
    return PngFile(width, height, depth, colour_type, interlace, tuple(kept))


def encode_palette(index: np.ndarray, palette: np.ndarray) -> bytes:
    """A palette PNG file of (H, W) uint8 indices and a (256, 3) uint8 palette; deterministic."""
    height, width = index.shape
    rows = np.zeros((height, width + 1), np.uint8)  # a leading 0 per row: no filter
    rows[:, 1:] = index
    header = struct.pack(">IIBBBBB", width, height, 8, PALETTE, 0, 0, 0)
    return _assemble(header, [(b"PLTE", palette.tobytes()), (b"IDAT", zlib.compress(rows.tobytes(), 6))])


def davis_palette() -> np.ndarray:
    """(256, 3) uint8 palette of the DAVIS and VOC masks: colours from the bits of the index."""
    palette = np.zeros((256, 3), np.uint8)
    index = np.arange(256)
    for level in range(3):
        for channel in range(3):
            bit = (index >> (3 * level + channel)) & 1
            palette[:, channel] |= (bit << (7 - level)).astype(np.uint8)
    return palette


def _chunks(data: bytes, where: str) -> Iterable[tuple[bytes, bytes]]:
    """Names and data of all chunks up to IEND; refuses lengths beyond the file and wrong checksums."""
    at = len(SIGNATURE)
    while at + 12 <= len(data):
        (length,) = struct.unpack_from(">I", data, at)
        name = data[at + 4 : at + 8]
        if at + 12 + length > len(data):
            break
        (stored,) = struct.unpack_from(">I", data, at + 8 + length)
        if stored != zlib.crc32(memoryview(data)[at + 4 : at + 8 + length]):
            raise GenmojoError("format", "is damaged (a checksum does not match)", where, "copy the file again")
        if name == b"IEND":
            return
        yield name, data[at + 8 : at + 8 + length]
        at += 12 + length
    raise GenmojoError("format", "is cut short", where, "copy the file again")


def _parse_header(name: bytes, body: bytes, where: str) -> tuple[int, ...]:
    """Width, height, depth, colour type, compression, filter, interlace."""
    if name != b"IHDR" or len(body) != 13:
        raise GenmojoError("format", "does not start with a PNG header", where, "write the file again")
    header = struct.unpack(">IIBBBBB", body)
    check_image_size(header[0], header[1], where)
    if header[2] not in (1, 2, 4, 8, 16) or header[3] not in (GREY, COLOUR, PALETTE, GREY_ALPHA, COLOUR_ALPHA):
        raise GenmojoError("format", f"declares {header[2]} bits and colour type {header[3]}", where, "write it again")
    return header


def _assemble(header: bytes, chunks: Iterable[tuple[bytes, bytes]]) -> bytes:
    """A PNG file of a header and chunks."""
    parts = [SIGNATURE]
    for name, body in [(b"IHDR", header), *chunks, (b"IEND", b"")]:
        parts += [struct.pack(">I", len(body)), name, body, struct.pack(">I", zlib.crc32(body, zlib.crc32(name)))]
    return b"".join(parts)


def _decode(data: bytes, flags: int, where: str) -> np.ndarray:
    """Decoded samples; raises GenmojoError("format")."""
    try:
        pixels = cv2.imdecode(np.frombuffer(data, np.uint8), flags)
    except cv2.error:
        pixels = None
    if pixels is None:
        raise GenmojoError("format", "cannot be decoded", where, "write the file again")
    return pixels


def _bgr_to_rgb(pixels: np.ndarray) -> np.ndarray:
    """Channels in file order."""
    return pixels[..., ::-1] if pixels.shape[2] == 3 else pixels[..., [2, 1, 0, 3]]
