"""Frames and masks that are broken, hostile or odd: one sentence naming the file, or the right picture.

Numbers in brackets are rows of the bad-input catalogue (RELIABILITY.md section c).
"""

from __future__ import annotations

import json
import struct
import zlib

import cv2
import numpy as np
import pytest
from clip_files import labels, make_clip, picture, put_image, put_mask
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from genmojo_core.clip import folders, images, png
from genmojo_core.clip.limits import LIMITS
from genmojo_core.errors import GenmojoError


def refused(path, code: str, *words: str, **options) -> str:
    """Reading must fail with one sentence that has these words; returns it."""
    with pytest.raises(GenmojoError) as caught:
        folders.read(path, **options)
    sentence = caught.value.sentence()
    assert caught.value.code == code, sentence
    assert "\n" not in sentence and sentence.endswith(".") and len(sentence) < 400
    for word in words:
        assert word in sentence
    return sentence


def chunk(name: bytes, body: bytes) -> bytes:
    return struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))


def png_header(width: int, height: int, depth: int = 8, kind: int = 2) -> bytes:
    return chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, depth, kind, 0, 0, 0))


def test_nothing_there(tmp_path):
    refused(tmp_path / "none", "io", "none: there is no such file or folder")
    refused(tmp_path, "empty", "holds no frames")
    (tmp_path / "JPEGImages").mkdir()
    refused(tmp_path, "empty", "JPEGImages: holds no frames")
    (tmp_path / "notes.txt").write_text("x")
    refused(tmp_path / "notes.txt", "format", "notes.txt")
    refused(tmp_path / "\0", "io")
    refused(tmp_path / ("x" * 5000), "io")


def test_folders_that_hold_something_else(tmp_path):
    """A folder of clips names one of them; masks beside frames are not taken for frames."""
    make_clip(tmp_path / "one")
    refused(tmp_path, "argument", "holds 1 folders with frames", "one")
    put_image(tmp_path / "mixed" / "00000.jpg", picture())
    put_mask(tmp_path / "mixed" / "00000.png", labels())
    refused(tmp_path / "mixed", "schema", "holds both 00000.jpg and 00000.png")


def test_odd_arguments(tmp_path):
    root = make_clip(tmp_path / "clip")
    refused(root, "argument", "'sound'", ignore=("sound",))
    refused(root, "argument", "short side", short_side=0)
    for aspect in (0.0, -1.0, float("nan"), 1e9):
        refused(root, "value", "pixel aspect", pixel_aspect=aspect)


@pytest.mark.parametrize("width", [31, 33, 16])
def test_frames_of_different_sizes_name_the_first(tmp_path, width):
    """[27]"""
    root = make_clip(tmp_path / "clip", frames=5)
    for t in (2, 4):
        put_image(root / "JPEGImages" / "clip" / f"{t:05d}.png", picture(width))
    refused(root, "schema", "00002.png", f"{width} x 24", "32 x 24")
    refused(root, "schema", "00002.png", short_side=8)


def test_mask_of_another_size(tmp_path):
    """[28]"""
    root = make_clip(tmp_path / "clip")
    put_mask(root / "Annotations" / "clip" / "00001.png", labels(64, 48))
    refused(root, "schema", "00001.png", "the mask is 64 x 48 but its frame is 32 x 24")
    for i in (1, 2):
        put_image(tmp_path / "g" / "Annotations" / f"00{i}" / "00000.png", np.full((24, 30 + i), 255, np.uint8))
    put_image(tmp_path / "g" / "JPEGImages" / "00000.png", picture())
    refused(tmp_path / "g", "schema", "001", "31 x 24")


def test_no_object_in_any_frame(tmp_path):
    """[29]"""
    root = make_clip(tmp_path / "clip")
    for t in range(3):
        put_mask(root / "Annotations" / "clip" / f"{t:05d}.png", labels(ids=()))
    refused(root, "empty", "no object is visible in any frame", "Annotations")
    put_image(tmp_path / "g" / "JPEGImages" / "00000.png", picture())
    put_image(tmp_path / "g" / "Annotations" / "000" / "00000.png", np.full((24, 32), 255, np.uint8))
    refused(tmp_path / "g", "empty", "background mask (000) but no object")


def test_masks_for_other_frames(tmp_path):
    root = make_clip(tmp_path / "clip", numbers=[34, 35])
    for path in (root / "Annotations" / "clip").iterdir():
        path.rename(path.with_name(f"9{path.name}"))
    refused(root, "schema", "masks numbered 900034 to 900035 but frames numbered 34 to 35")


def test_too_many_ids_and_ids_too_high(tmp_path):
    """[29] 255 of them fit; 16-bit ids above are refused, not wrapped."""
    root = make_clip(tmp_path / "clip", frames=1)
    mask = root / "Annotations" / "clip" / "00000.png"
    put_image(mask, np.full((24, 32), 300, np.uint16))
    refused(root, "value", "00000.png", "object id 300")
    index = np.arange(24 * 32, dtype=np.uint32).reshape(24, 32) % 256
    put_mask(mask, index.astype(np.uint8))
    clip = folders.read(root)
    assert clip.objects == 254 and (~clip.masks.valid).sum() == 3
    put_image(tmp_path / "g" / "JPEGImages" / "00000.png", picture())
    put_image(tmp_path / "g" / "Annotations" / "300" / "00000.png", np.full((24, 32), 255, np.uint8))
    refused(tmp_path / "g", "value", "300", "254")


def test_mask_in_colours_that_mean_nothing(tmp_path):
    root = make_clip(tmp_path / "clip", frames=1)
    mask = root / "Annotations" / "clip" / "00000.png"
    put_image(mask, png.davis_palette()[labels()] + np.uint8(1))
    refused(root, "value", "00000.png", "no colour of the DAVIS palette")
    cv2.imwrite(str(mask.with_suffix(".jpg")), labels())
    mask.unlink()
    refused(root, "format", "00000.jpg", "without loss")


@pytest.mark.parametrize("keep", [0.05, 0.5, 0.9, 0.999])
@pytest.mark.parametrize("suffix", [".jpg", ".png", ".webp"])
def test_truncated_pictures(tmp_path, suffix, keep):
    """[25] decoders would fill the rest with grey."""
    path = put_image(tmp_path / f"a{suffix}", np.random.default_rng(0).integers(0, 255, (48, 64, 3), np.uint8))
    data = path.read_bytes()
    path.write_bytes(data[: int(keep * len(data))])
    refused(path, "format", path.name)


def test_png_whose_pixels_end_early(tmp_path):
    """All checksums are right, but rows are missing."""
    rows = zlib.compress(bytes(10 * (1 + 32 * 3)))
    path = tmp_path / "a.png"
    path.write_bytes(png.SIGNATURE + png_header(32, 24) + chunk(b"IDAT", rows) + chunk(b"IEND", b""))
    refused(path, "format", "a.png")


@pytest.mark.parametrize(
    ("content", "word"),
    [
        (b"", "it is empty"),
        (b"\x89HDF\r\n\x1a\n" + bytes(100), "HDF5"),
        (b"PK\x03\x04" + bytes(100), "zip"),
        (b"\x00\x00\x00\x18ftypmp42" + bytes(100), "video"),
        (b"<html>not found</html>", "no known kind"),
        (bytes(1000), "no known kind"),
        (b"\xff\xd8\xff" + bytes(50), "cut short"),
        (png.SIGNATURE, "cut short"),
        (b"BM" + bytes(40), "0 x 0"),
    ],
)
@pytest.mark.parametrize("suffix", [".png", ".jpg"])
def test_extension_lies(tmp_path, content, word, suffix):
    """[26]"""
    path = tmp_path / f"00000{suffix}"
    path.write_bytes(content)
    refused(tmp_path, "format", path.name, word)


def test_right_picture_under_the_wrong_name_is_read(tmp_path):
    """A JPEG called .png is still that picture: bytes decide."""
    put_image(tmp_path / "a.jpg", np.full((8, 8, 3), 90, np.uint8)).rename(tmp_path / "a.png")
    assert (folders.read(tmp_path / "a.png").frames == 90).all()


@pytest.mark.parametrize("size", [(50_000, 50_000), (20_000, 10), (0, 5), (2**31, 1)])
def test_huge_or_empty_pictures_are_not_allocated(tmp_path, size):
    """[23]"""
    path = tmp_path / "a.png"
    path.write_bytes(png.SIGNATURE + png_header(*size) + chunk(b"IDAT", zlib.compress(b"")) + chunk(b"IEND", b""))
    refused(path, "format" if 0 in size else "size", "a.png")
    if max(size) < 65536:
        sof = b"\xff\xd8\xff\xc0" + struct.pack(">HBHHB", 17, 8, size[1], size[0], 3) + bytes(9)
        path.write_bytes(sof + b"\xff\xda\x00\x02" + b"\xff\xd9")
        refused(path, "format" if 0 in size else "size", "a.png")


def test_too_many_bytes_of_frames(tmp_path, monkeypatch):
    """The whole clip is weighed before it is allocated; a smaller short side helps."""
    monkeypatch.setitem(LIMITS, "clip_bytes", type(LIMITS["clip_bytes"])(3000, "bytes of frames", "read less"))
    root = make_clip(tmp_path / "clip")
    refused(root, "size", "6912 bytes", "read less")
    assert folders.read(root, short_side=8).size == (11, 8)


def test_cmyk_16_bit_grey_and_rotated_pictures(tmp_path):
    """[25] converted: CMYK by the decoder, 16 bits cut to 8, grey to three channels, EXIF turned upright."""
    put_image(tmp_path / "deep.png", np.full((6, 8, 3), 0x8040, np.uint16))
    assert (folders.read(tmp_path / "deep.png").frames == 0x80).all()
    put_image(tmp_path / "grey.png", np.full((6, 8), 77, np.uint8))
    assert (folders.read(tmp_path / "grey.png").frames == 77).all()
    put_mask(tmp_path / "palette.png", labels())
    assert folders.read(tmp_path / "palette.png").frames[0, 6, 3].tolist() == [128, 0, 0]
    wide = np.zeros((16, 32, 3), np.uint8)
    wide[:, :16] = 255
    data = put_image(tmp_path / "turned.jpg", wide).read_bytes()
    exif = b"Exif\0\0II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0\x06\0\0\0\0\0\0\0"  # orientation 6
    segment = b"\xff\xe1" + struct.pack(">H", len(exif) + 2) + exif
    (tmp_path / "turned.jpg").write_bytes(data[:2] + segment + data[2:])
    frame = folders.read(tmp_path / "turned.jpg").frames[0]
    assert frame.shape == (32, 16, 3) and frame[:12].min() > 200 and frame[20:].max() < 50


def test_cmyk_jpeg(tmp_path):
    """A four-channel JPEG made by PyAV's encoder is not at hand; a hand-made 8 x 8 one is."""
    path = tmp_path / "cmyk.jpg"
    path.write_bytes(_cmyk_jpeg())
    frame = folders.read(path).frames[0]
    assert frame.shape == (8, 8, 3) and np.ptp(frame) == 0


def _cmyk_jpeg() -> bytes:
    """An 8 x 8 baseline JPEG of four components, every coefficient zero (mid grey in each ink)."""
    table = b"\xff\xdb" + struct.pack(">HB", 67, 0) + bytes([1] * 64)
    frame = b"\xff\xc0" + struct.pack(">HBHHB", 20, 8, 8, 8, 4) + b"".join(bytes([i, 0x11, 0]) for i in range(1, 5))
    # One code of one bit ("0") for the value 0: no DC difference, and end of block.
    trees = b"".join(b"\xff\xc4" + struct.pack(">HB", 20, k) + bytes([1] + [0] * 15) + b"\0" for k in (0x00, 0x10))
    scan = b"\xff\xda" + struct.pack(">HB", 14, 4) + b"".join(bytes([i, 0]) for i in range(1, 5)) + b"\0\x3f\0"
    adobe = b"\xff\xee" + struct.pack(">H", 14) + b"Adobe\0\x64\0\0\0\0\0"
    return b"\xff\xd8" + adobe + table + frame + trees + scan + b"\x00" + b"\xff\xd9"


@pytest.mark.parametrize(
    "text",
    ["{", "[1, 2]", '{"fps": NaN}', '{"fps": 1e999}', '{"fps": -1}', '{"fps": "fast"}', '{"fps": true}',
     '{"objects": [1]}', '{"objects": {"dog": 1}}', '{"pixel_aspect": 0}', "[" * 200_000, '{"fps": ' + "9" * 5000 + "}",
     "\udcff"],
)  # fmt: skip
def test_bad_meta(tmp_path, text):
    """[43]"""
    root = make_clip(tmp_path / "clip")
    (root / "meta.json").write_text(text, errors="surrogateescape")
    with pytest.raises(GenmojoError, match=r"meta\.json") as caught:
        folders.read(root)
    assert caught.value.code in ("format", "value", "size") and len(caught.value.sentence()) < 400


def test_odd_but_good_meta(tmp_path):
    """[43, 46] a byte-order mark is skipped; names are literal and cut to a length."""
    root = make_clip(tmp_path / "clip")
    (root / "meta.json").write_text("\ufeff" + json.dumps({"objects": {"1": "x" * 10_000, "2": "\u202egod"}}))
    names = folders.read(root).object_names
    assert len(names[0]) == LIMITS["name_length"].most and names[1] == "\u202egod"


@settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.data())
def test_one_changed_byte(tmp_path, data):
    """[50] a changed PNG is refused or has the same pixels; a changed JPEG is refused or a picture."""
    suffix = data.draw(st.sampled_from([".png", ".jpg", ".webp", ".bmp"]))
    path = put_image(tmp_path / f"a{suffix}", picture())
    expected = images.read_rgb(path)
    content = bytearray(path.read_bytes())
    at = data.draw(st.integers(0, len(content) - 1))
    content[at] ^= data.draw(st.integers(1, 255))
    path.write_bytes(bytes(content))
    try:
        got = images.read_rgb(path)
    except GenmojoError:
        return
    assert got.dtype == np.uint8 and got.ndim == 3
    if suffix == ".png":
        np.testing.assert_array_equal(got, expected)


def test_unreadable_file(tmp_path):
    """A frame that is a folder, and a dangling link."""
    (tmp_path / "00000.png").mkdir()
    refused(tmp_path, "io", "00000.png")
    (tmp_path / "00000.png").rmdir()
    (tmp_path / "00000.png").symlink_to(tmp_path / "gone.png")
    refused(tmp_path, "io", "00000.png")
