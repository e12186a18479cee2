"""Videos that are broken, hostile or empty: one sentence, or the frames that are there.

Numbers in brackets are rows of the bad-input catalogue (RELIABILITY.md section c).
"""

from __future__ import annotations

import struct
from fractions import Fraction
from pathlib import Path

import av
import numpy as np
import pytest

from genmojo_core.clip import folders
from genmojo_core.errors import GenmojoError

W, H = 64, 48


def make_video(path: Path, frames: int = 12, codec: str = "libx264", **options: str) -> Path:
    """Frames that get brighter, a key frame every fourth."""
    with av.open(str(path), "w") as container:
        stream = container.add_stream(codec, rate=25, options={"g": "4", "bf": "0", **options})
        stream.width, stream.height, stream.pix_fmt = W, H, "yuv420p"
        for i in range(frames):
            frame = av.VideoFrame.from_ndarray(np.full((H, W, 3), 20 * (i % 12), np.uint8), format="rgb24")
            frame.pts, frame.time_base = i, Fraction(1, 25)
            container.mux(stream.encode(frame))
        container.mux(stream.encode())
    return path


def refused(path: Path, code: str, *words: str) -> None:
    """Reading must fail with one sentence that has these words."""
    with pytest.raises(GenmojoError) as caught:
        folders.read(path)
    sentence = caught.value.sentence()
    assert caught.value.code == code, sentence
    assert "\n" not in sentence and len(sentence) < 400
    for word in (path.name, *words):
        assert word in sentence, sentence


@pytest.mark.parametrize("content", [b"", b"junk" * 100, bytes(5000), b"\x89HDF\r\n\x1a\n" + bytes(200)])
@pytest.mark.parametrize("suffix", [".mp4", ".avi", ".mkv"])
def test_files_that_are_no_video(tmp_path, content, suffix):
    (tmp_path / f"v{suffix}").write_bytes(content)
    refused(tmp_path / f"v{suffix}", "video")


def test_video_without_its_header(tmp_path):
    """[31] a recording that was cut off has pictures but no moov atom."""
    path = make_video(tmp_path / "v.mp4")
    data = path.read_bytes()
    path.write_bytes(data[: data.index(b"moov") - 4])
    refused(path, "video", "header is missing")


def test_sound_only(tmp_path):
    """[35]"""
    path = tmp_path / "v.mp4"
    with av.open(str(path), "w") as container:
        stream = container.add_stream("aac", rate=16_000)
        sound = av.AudioFrame.from_ndarray(np.zeros((1, 1024), np.float32), format="fltp", layout="mono")
        sound.sample_rate = 16_000
        container.mux(stream.encode(sound))
        container.mux(stream.encode())
    refused(path, "video", "sound but no pictures")


def test_no_frame(tmp_path):
    """[35] a header that declares a picture stream, and nothing in it."""
    path = make_video(tmp_path / "v.mkv", frames=1)
    data = path.read_bytes()
    path.write_bytes(data[: data.index(b"\x1f\x43\xb6\x75")])  # cut before the first cluster
    refused(path, "video", "holds no frame")


def test_one_frame_is_a_still(tmp_path):
    """[35]"""
    assert len(folders.read(make_video(tmp_path / "v.mp4", frames=1))) == 1


@pytest.mark.parametrize("size", [(60_000, 60_000), (16_385, 16)])
def test_huge_pictures_are_not_decoded(tmp_path, size):
    """[32] the header of the stream and the decoder's own limit."""
    path = make_video(tmp_path / "v.avi", codec="mpeg4")
    data = bytearray(path.read_bytes())
    small = struct.pack("<II", W, H)
    for at in range(len(data) - 8):
        if data[at : at + 8] == small:
            data[at : at + 8] = struct.pack("<II", *size)
    path.write_bytes(bytes(data))
    try:
        clip = folders.read(path)
    except GenmojoError as error:
        assert error.code in ("size", "video")
    else:
        assert clip.source_size == (W, H)  # the pictures themselves say how large they are


def test_header_that_claims_too_many_frames(tmp_path):
    """[33] the frames that are there count, not the number in the header."""
    path = make_video(tmp_path / "v.avi", codec="mpeg4")
    data = bytearray(path.read_bytes())
    for name, offset in ((b"avih", 8 + 16), (b"strh", 8 + 32)):
        at = data.index(name) + offset
        data[at : at + 4] = struct.pack("<I", 10**9)
    path.write_bytes(bytes(data))
    assert len(folders.read(path)) == 12


def test_start_without_a_key_frame(tmp_path):
    """[34] frames before the first key frame cannot be decoded; the rest keep their numbers, times and neighbours."""
    path, cut = make_video(tmp_path / "v.ts"), tmp_path / "cut.mkv"
    with av.open(str(path)) as source, av.open(str(cut), "w") as target:
        stream = target.add_stream_from_template(source.streams.video[0])
        for i, packet in enumerate(p for p in source.demux(video=0) if p.size):
            if i >= 2:
                packet.stream = stream
                target.mux(packet)
    clip = folders.read(cut)
    assert clip.frames[-1].mean() > 200 and np.all(np.diff(clip.seconds) > 0)
    if len(clip) < 10:
        assert "cannot be decoded" in clip.guesses[0]


@pytest.mark.parametrize("keep", [0.3, 0.6, 0.9])
def test_truncated_stream_gives_what_is_there(tmp_path, keep):
    """A transport stream has no header to lose: its start is read, in order."""
    path = make_video(tmp_path / "v.ts", frames=40)
    data = path.read_bytes()
    path.write_bytes(data[: int(keep * len(data))])
    clip = folders.read(path)
    assert 1 <= len(clip) < 40
    assert np.all(np.diff(clip.frames.mean(axis=(1, 2, 3))[: min(12, len(clip) - 2)]) > 10)


def test_damaged_pictures(tmp_path):
    """Bytes changed all over the pictures: fewer frames or an error, never a crash."""
    path = make_video(tmp_path / "v.mp4", frames=40)
    good = path.read_bytes()
    for seed in range(20):
        random = np.random.default_rng(seed)
        data = bytearray(good)
        for at in random.integers(0, len(data), 5):
            data[at] ^= int(random.integers(1, 256))
        path.write_bytes(bytes(data))
        try:
            clip = folders.read(path)
        except GenmojoError as error:
            assert "\n" not in error.sentence()
        else:
            assert 1 <= len(clip) <= 40 and np.all(np.diff(clip.seconds) > 0)


def test_several_videos_and_ranges(tmp_path):
    make_video(tmp_path / "a.mp4")
    make_video(tmp_path / "b.mp4")
    refused(tmp_path, "argument", "holds 2 videos")
    with pytest.raises(GenmojoError, match="select nothing of 12 frames"):
        folders.read(tmp_path / "a.mp4", frames=(12, None))


def test_missing_video(tmp_path):
    refused(tmp_path / "gone.mp4", "io", "there is no such file")
