"""Image files of frames and masks: what they are by their bytes, their size before decoding, RGB or labels after."""

from __future__ import annotations

import struct
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

from genmojo_core.clip import png
from genmojo_core.clip.limits import check_image_size, check_limit
from genmojo_core.errors import GenmojoError

EXTENSIONS = (".jpg", ".jpeg", ".png", ".bmp", ".webp")


@dataclass(frozen=True)
class Labels:
    """A mask file's object ids.

    Args:
        index: (H, W) uint8 ids as stored; 0 background, 255 void (or white, see `grey`).
        grey: True if the file holds grey levels, where 255 alone may mean "object" (DAVIS 2016, per-object folders).
    """

    index: np.ndarray
    grey: bool


def read_rgb(path: Path) -> np.ndarray:
    """(H, W, 3) uint8 RGB of an image file; 16 bits are cut to 8, CMYK and palettes converted, EXIF rotation applied.

    Raises GenmojoError: "io" if it cannot be read; "format" if it is no image, another kind than its bytes say, cut
    short or damaged; "size" if it is too large.
    """
    return np.asarray(cv2.cvtColor(_read_bgr(path), cv2.COLOR_BGR2RGB))


def read_bgra(path: Path, out: np.ndarray | None = None) -> np.ndarray:
    """(H, W, 4) uint8 B, G, R, 255 of an image file, as screens take it. Raises GenmojoError as `read_rgb`.

    It is written into `out` if that has the file's size.
    """
    return np.asarray(cv2.cvtColor(_read_bgr(path), cv2.COLOR_BGR2BGRA, out))


def _read_bgr(path: Path) -> np.ndarray:
    """(H, W, 3) uint8 as OpenCV decodes it, after the checks of `read_rgb`."""
    data = _read_bytes(path)
    kind = _kind(data)
    if kind == "png":
        data = png.parse(data, str(path)).to_bytes()
    elif kind == "jpeg":
        _check_jpeg(data, str(path))
    elif kind == "bmp":
        width, height = struct.unpack_from("<ii", data, 18)
        check_image_size(width, abs(height), str(path))
    elif kind == "webp":
        _check_webp(data, str(path))
    else:
        raise GenmojoError("format", f"is not an image ({_describe(data)})", str(path), "check the file's name")
    try:
        bgr = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_COLOR)
    except cv2.error:
        bgr = None
    if bgr is None:
        raise GenmojoError("format", "is an image that cannot be decoded", str(path), "write the file again")
    return np.asarray(bgr)


def read_labels(path: Path) -> Labels:
    """Object ids of a mask PNG: palette indices, grey levels, or colours of the DAVIS palette mapped back.

    Raises GenmojoError as `read_rgb`, and "value" for colours that stand for no id or ids above 255.
    """
    data = _read_bytes(path)
    if _kind(data) != "png":
        raise GenmojoError("format", "is not a PNG, and a mask must be stored without loss", str(path), "write a PNG")
    file = png.parse(data, str(path))
    samples = file.samples(str(path))
    if file.colour_type in (png.COLOUR, png.COLOUR_ALPHA):
        return _labels_of_colours(samples[..., :3], str(path))
    grey = samples if samples.ndim == 2 else samples[..., 0]
    if grey.dtype != np.uint8:
        grey = _narrow(grey, str(path))
    return Labels(grey, file.colour_type != png.PALETTE)


def read_binary(path: Path) -> np.ndarray:
    """(H, W) bool of a one-object mask: true where the brightest channel is above half (0/255 files), or where the
    index is not 0 (files that store 0/1 or a palette). Raises GenmojoError as `read_rgb`."""
    data = _read_bytes(path)
    if _kind(data) == "png":
        file = png.parse(data, str(path))
        if file.colour_type == png.PALETTE or file.depth < 8:
            return file.samples(str(path)) > 0
    rgb = read_rgb(path).max(axis=2)
    return rgb > (0 if rgb.max(initial=0) <= 1 else 127)


def _labels_of_colours(rgb: np.ndarray, where: str) -> Labels:
    """Ids of colours that are exactly in the DAVIS palette; black and white alone are a grey mask."""
    if rgb.dtype != np.uint8:
        rgb = _narrow(rgb, where)
    packed = (rgb.astype(np.uint32) @ np.array([65536, 256, 1], np.uint32)).astype(np.uint32)
    palette = png.davis_palette().astype(np.uint32) @ np.array([65536, 256, 1], np.uint32)
    order = np.argsort(palette)
    place = np.searchsorted(palette[order], packed).clip(max=255)
    found = palette[order][place] == packed
    if found.all():
        return Labels(order[place].astype(np.uint8), grey=False)
    if np.isin(packed, (0, 0xFFFFFF)).all():
        return Labels(rgb[..., 0].copy(), grey=True)
    r, g, b = rgb[~found][0]
    raise GenmojoError("value", f"is a mask in colours, and ({r}, {g}, {b}) is no colour of the DAVIS palette", where,
                       "store object ids as a palette PNG")  # fmt: skip


def _narrow(samples: np.ndarray, where: str) -> np.ndarray:
    """16-bit samples as uint8 if they are small ids or black and white."""
    if np.isin(samples, (0, 65535)).all():
        return (samples > 0).astype(np.uint8) * np.uint8(255)
    if samples.max() > 255:
        raise GenmojoError("value", f"holds the object id {samples.max()}, allowed are ids up to 254", where,
                           "number the objects 1, 2, 3")  # fmt: skip
    return samples.astype(np.uint8)


def _read_bytes(path: Path) -> bytes:
    """The file, after a look at its size."""
    try:
        check_limit("image_bytes", path.stat().st_size, str(path))
        return path.read_bytes()
    except OSError as error:
        raise GenmojoError("io", f"cannot be read ({error.strerror})", str(path), "check the path") from error


def _kind(data: bytes) -> str | None:
    """The kind of image by its first bytes."""
    if data.startswith(png.SIGNATURE):
        return "png"
    if data.startswith(b"\xff\xd8\xff"):
        return "jpeg"
    if data.startswith(b"BM") and len(data) > 26:
        return "bmp"
    if data.startswith(b"RIFF") and data[8:12] == b"WEBP" and len(data) > 30:
        return "webp"
    return None


def _describe(data: bytes) -> str:
    """What the bytes look like, for a message."""
    known = {
        b"\x89HDF": "it is HDF5",
        b"PK\x03\x04": "it is a zip or npz file",
        b"\x93NUMPY": "it is an npy file",
        b"%PDF": "it is a PDF",
        b"GIF8": "it is a GIF",
        b"II*\x00": "it is a TIFF",
        b"MM\x00*": "it is a TIFF",
    }
    if not data:
        return "it is empty"
    if data[4:8] == b"ftyp":
        return "it is a video or HEIF file"
    return next((name for start, name in known.items() if data.startswith(start)), "its bytes are of no known kind")


def _check_jpeg(data: bytes, where: str) -> None:
    """Walk the segments: refuse a file without size or end, which decoders would fill with grey."""
    at = 2
    sized = False
    while at + 4 <= len(data) and data[at] == 0xFF:
        marker = data[at + 1]
        if marker == 0xFF:  # padding
            at += 1
            continue
        if 0xC0 <= marker <= 0xCF and marker not in (0xC4, 0xC8, 0xCC) and at + 9 <= len(data):
            height, width = struct.unpack_from(">HH", data, at + 5)
            check_image_size(width, height, where)
            sized = True
        if marker == 0xDA:  # picture data; its end marker cannot occur inside it
            if sized and data.rfind(b"\xff\xd9") > at:
                return
            break
        at += 2 + struct.unpack_from(">H", data, at + 2)[0]
    raise GenmojoError("format", "is a JPEG file that is cut short", where, "copy the file again")


def _check_webp(data: bytes, where: str) -> None:
    """Size and completeness from the RIFF header and the first chunk."""
    if struct.unpack_from("<I", data, 4)[0] + 8 > len(data):
        raise GenmojoError("format", "is a WebP file that is cut short", where, "copy the file again")
    chunk = data[12:16]
    if chunk == b"VP8X":
        width, height = (int.from_bytes(data[at : at + 3], "little") + 1 for at in (24, 27))
    elif chunk == b"VP8L":
        bits = struct.unpack_from("<I", data, 21)[0]
        width, height = (bits & 0x3FFF) + 1, (bits >> 14 & 0x3FFF) + 1
    else:
        width, height = (side & 0x3FFF for side in struct.unpack_from("<HH", data, 26))
    check_image_size(width, height, where)
