"""Video frames are found by their time stamps: variable rate, B-frames, late starts, rotation, ranges."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import av
import numpy as np
import pytest
from clip_files import make_clip, shared_clip

from genmojo_core.clip import folders

W, H = 64, 48
VARIABLE = [0, 1, 2, 5, 6, 12, 13, 14, 20, 21, 22, 30, 31, 33, 34, 40, 41, 50, 51, 52]  # stamps in 1/30 s


def frame_number(picture: np.ndarray) -> int:
    """Number drawn into a picture as five black or white columns."""
    width = picture.shape[1]
    columns = [picture[4:-4, int((b + 0.5) * width / 5)].mean() > 127 for b in range(5)]
    return sum(int(on) << b for b, on in enumerate(columns))


def drawn(number: int) -> np.ndarray:
    """The picture that carries a number."""
    picture = np.zeros((H, W, 3), np.uint8)
    for b in range(5):
        picture[:, b * W // 5 : (b + 1) * W // 5] = 255 * (number >> b & 1)
    return picture


def make_video(path: Path, stamps: list[int], codec: str = "libx264", start: int = 0, **options: str) -> Path:
    """A video whose frame i carries the number i and has the time stamp (start + stamps[i]) / 30 s."""
    with av.open(str(path), "w") as container:
        stream = container.add_stream(codec, rate=30, options={"crf": "12", **options} if codec == "libx264" else {})
        stream.width, stream.height, stream.pix_fmt = W, H, "yuvj420p" if codec == "mjpeg" else "yuv420p"
        stream.codec_context.time_base = Fraction(1, 30)
        for i, stamp in enumerate(stamps):
            frame = av.VideoFrame.from_ndarray(drawn(i), format="rgb24")
            frame.pts, frame.time_base = start + stamp, Fraction(1, 30)
            container.mux(stream.encode(frame))
        container.mux(stream.encode())
    return path


def numbers(clip) -> list[int]:
    return [frame_number(frame) for frame in clip.frames]


@pytest.mark.parametrize(
    ("suffix", "codec", "options"),
    [
        ("mp4", "libx264", {"g": "7", "bf": "3"}),  # B-frames: stored out of order
        ("mov", "libx264", {"g": "250"}),  # one key frame
        ("mkv", "libx264", {"g": "5", "bf": "2", "x264-params": "open-gop=1"}),
        ("mp4", "mpeg4", {}),
        ("avi", "mjpeg", {}),
    ],
)
@pytest.mark.parametrize("frames", [(0, None), (0, 4), (9, 13), (17, 20)])
def test_every_range_gives_its_own_frames(tmp_path, suffix, codec, options, frames):
    stamps = list(range(20)) if suffix == "avi" else VARIABLE  # avi has no variable rate
    clip = folders.read(make_video(tmp_path / f"v.{suffix}", stamps, codec, **options), frames=frames)
    expected = list(range(20))[slice(*frames)]
    assert numbers(clip) == expected and clip.frame_index.tolist() == expected
    np.testing.assert_allclose(clip.seconds, np.array(stamps)[expected] / 30, atol=1e-3)
    assert clip.source_names[0] == f"{stamps[expected[0]] / 30:.3f} s" and clip.guesses == ()


def test_a_late_start_counts_from_the_first_frame(tmp_path):
    clip = folders.read(make_video(tmp_path / "v.mkv", VARIABLE, start=300), frames=(3, 6))
    assert numbers(clip) == [3, 4, 5]
    np.testing.assert_allclose(clip.seconds, np.array([5, 6, 12]) / 30, atol=1e-3)


@pytest.mark.parametrize("suffix", ["avi", "h264", "ts"])
def test_streams_without_time_stamps_to_be_trusted(tmp_path, suffix):
    """AVI makes stamps up in file order, a bare H.264 stream has none: frames are then counted by decoding."""
    clip = folders.read(make_video(tmp_path / f"v.{suffix}", list(range(12)), bf="2"), frames=(2, 9))
    assert numbers(clip) == list(range(2, 9))
    np.testing.assert_allclose(np.diff(clip.seconds), 1 / 30, rtol=0.3)


def test_one_frame_is_a_still_and_small_is_small(tmp_path):
    clip = folders.read(make_video(tmp_path / "v.mp4", [0]), short_side=12)
    assert len(clip) == 1 and clip.size == (16, 12) and clip.source_size == (W, H) and clip.seconds.tolist() == [0]


@pytest.mark.parametrize(("degrees", "turns"), [(90, 1), (-90, -1), (180, 2)])
def test_rotation_of_a_phone_is_applied(tmp_path, degrees, turns):
    """The display matrix says counter-clockwise degrees, and so does numpy's rot90."""
    upright = folders.read(make_video(tmp_path / "plain.mp4", [0, 1, 2]))
    turned = _with_rotation(tmp_path / "plain.mp4", tmp_path / "turned.mp4", degrees)
    clip = folders.read(turned)
    np.testing.assert_array_equal(clip.frames[2], np.rot90(upright.frames[2], turns))
    assert clip.source_size == ((H, W) if turns % 2 else (W, H))


def _with_rotation(source: Path, target: Path, degrees: int) -> Path:
    """The same file with another matrix in its track header (tkhd)."""
    data = bytearray(source.read_bytes())
    at = data.index(b"tkhd") + 4 + 40  # version 0: the matrix starts 40 bytes after version and flags start
    cos, sin = {90: (0, 1), -90: (0, -1), 180: (-1, 0)}[degrees]
    matrix = [cos, -sin, 0, sin, cos, 0, 0, 0, 1]  # x' = cos x + sin y in a picture whose y points down
    for i, value in enumerate(matrix):
        unit = 1 << 30 if i % 3 == 2 else 1 << 16
        data[at + 4 * i : at + 4 * i + 4] = int(value * unit).to_bytes(4, "big", signed=True)
    target.write_bytes(bytes(data))
    return target


def test_stretched_pixels_are_told_by_the_file(tmp_path):
    path = tmp_path / "v.mp4"
    with av.open(str(path), "w") as container:
        stream = container.add_stream("libx264", rate=30)
        stream.width, stream.height, stream.pix_fmt = W, H, "yuv420p"
        stream.codec_context.sample_aspect_ratio = Fraction(16, 11)
        container.mux(stream.encode(av.VideoFrame.from_ndarray(drawn(1), format="rgb24")))
        container.mux(stream.encode())
    assert folders.read(path).pixel_aspect == pytest.approx(16 / 11)
    assert folders.read(path, pixel_aspect=1.0).pixel_aspect == 1


def test_a_folder_with_one_video_and_masks(tmp_path):
    """Masks, depth and the like may lie beside a video; frame numbers are places in the video."""
    make_video(tmp_path / "v.mp4", VARIABLE)
    source = make_clip(tmp_path / "other", frames=1)
    (tmp_path / "Annotations").mkdir()
    mask = (source / "Annotations" / "other" / "00000.png").read_bytes()
    clip = folders.read(tmp_path / "v.mp4", short_side=24)
    assert clip.masks is None
    from clip_files import labels, put_mask

    assert mask
    put_mask(tmp_path / "Annotations" / "00002.png", labels(W, H))
    for p in (tmp_path / "other").rglob("*.png"):
        p.unlink()
    clip = folders.read(tmp_path, frames=(1, 4))
    assert clip.masks.valid.any(axis=(1, 2)).tolist() == [False, True, False]


@pytest.mark.clips
def test_shared_videos():
    clip = folders.read(shared_clip("cups"), short_side=36, frames=(100, 110))
    assert clip.source_size == (1280, 720) and clip.size == (64, 36) and clip.frame_index[0] == 100
    bear, files = shared_clip("bear") / "bear.mp4", folders.read(shared_clip("bear"), short_side=48, frames=(50, 54))
    video = folders.read(bear, short_side=48, frames=(50, 54))
    assert np.abs(video.frames.astype(int) - files.frames).mean() < 3  # the JPEGs are this video's frames
    np.testing.assert_allclose(np.diff(video.seconds), 1 / 30, atol=1e-3)
