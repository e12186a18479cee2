"""Any frame in any order is the frame asked for: burnt-in numbers over files of every kind that seeks go wrong on.

Not covered: damaged files (tests/bad_inputs) and speed (tests/benchmarks/frame_step.py).
"""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import av
import numpy as np
import pytest
from clip_files import make_clip

from genmojo_core.clip.frames import FolderFrames, MaskFrames, VideoFrames, open_source

W, H, FRAMES, BITS = 96, 48, 60, 6
RANDOM = np.random.default_rng(7)
UNEVEN = [0, *np.cumsum(RANDOM.integers(1, 9, FRAMES - 1)).tolist()]
EVEN = list(range(FRAMES))
FILES = {  # name: (suffix, codec, stamps, start, options)
    "one key": ("mp4", "libx264", EVEN, 0, {"g": "250", "bf": "3"}),
    "short groups": ("mp4", "libx264", EVEN, 0, {"g": "7", "bf": "2"}),
    "uneven": ("mp4", "libx264", UNEVEN, 0, {"g": "12", "bf": "3"}),
    "uneven mkv": ("mkv", "libx264", UNEVEN, 0, {"g": "9", "bf": "2"}),
    "open groups": ("mkv", "libx264", EVEN, 0, {"g": "6", "bf": "2", "x264-params": "open-gop=1"}),
    "intra": ("mov", "libx264", UNEVEN, 0, {"g": "1"}),
    "late start, edit list": ("mp4", "libx264", UNEVEN, 300, {"g": "10", "bf": "3"}),
    "mpeg4": ("mp4", "mpeg4", EVEN, 0, {"g": "8"}),
    "avi, counted": ("avi", "mpeg4", EVEN, 0, {}),
    "no B-frames": ("mkv", "libx264", UNEVEN, 17, {"g": "30", "bf": "0"}),
}


def drawn(number: int) -> np.ndarray:
    picture = np.zeros((H, W, 3), np.uint8)
    for b in range(BITS):
        picture[:, b * W // BITS : (b + 1) * W // BITS] = 255 * (number >> b & 1)
    return picture


def number_in(picture: np.ndarray) -> int:
    columns = [picture[8:-8, int((b + 0.5) * W / BITS), :3].mean() > 127 for b in range(BITS)]
    return sum(int(on) << b for b, on in enumerate(columns))


def make_video(path: Path, codec: str, stamps: list[int], start: int, options: dict[str, str]) -> Path:
    with av.open(str(path), "w") as container:
        extra = {"crf": "14"} if codec == "libx264" else {"qmin": "2", "qmax": "3"}
        stream = container.add_stream(codec, rate=30, options=extra | options)
        stream.width, stream.height, stream.pix_fmt = W, H, "yuv420p"
        stream.codec_context.time_base = Fraction(1, 30)
        for i, stamp in enumerate(stamps):
            frame = av.VideoFrame.from_ndarray(drawn(i), format="rgb24")
            frame.pts, frame.time_base = start + stamp, Fraction(1, 30)
            container.mux(stream.encode(frame))
        container.mux(stream.encode())
    return path


@pytest.mark.parametrize("kind", FILES)
def test_random_seeks_never_give_another_frame(tmp_path, kind):
    check_seeks(tmp_path, kind, 100)


@pytest.mark.slow
@pytest.mark.parametrize("kind", FILES)
def test_ten_thousand_random_seeks(tmp_path, kind):
    check_seeks(tmp_path, kind, 1000)


def check_seeks(folder: Path, kind: str, seeks: int) -> None:
    """Frames asked for at random, and those kept on the way, show their own numbers."""
    suffix, codec, stamps, start, options = FILES[kind]
    source = VideoFrames(make_video(folder / f"v.{suffix}", codec, stamps, start, options))
    assert source.count == FRAMES
    wrong, kept_wrong = [], []

    def keep(index: int, frame: np.ndarray) -> None:
        if number_in(frame) != index:
            kept_wrong.append(index)

    for index in np.random.default_rng(3).integers(0, FRAMES, seeks).tolist():
        if number_in(source.read(index, keep)) != index:
            wrong.append(index)
    source.close()
    assert not wrong and not kept_wrong


def test_every_frame_forward_and_backward(tmp_path):
    source = VideoFrames(make_video(tmp_path / "v.mp4", "libx264", UNEVEN, 0, {"g": "20", "bf": "3"}))
    assert [number_in(source.read(i)) for i in range(FRAMES)] == list(range(FRAMES))
    assert [number_in(source.read(i)) for i in reversed(range(0, FRAMES, 7))] == list(reversed(range(0, FRAMES, 7)))
    np.testing.assert_allclose(source.seconds, np.array(UNEVEN) / 30, atol=1e-3)


def test_folders_give_colours_in_screen_order_and_ids_of_masks(tmp_path):
    root = make_clip(tmp_path / "clip", frames=3, numbers=[5, 7, 9])
    source = open_source(root)
    assert isinstance(source, FolderFrames) and source.count == 3 and source.size == (32, 24)
    from genmojo_core.clip.images import read_rgb

    rgb = read_rgb(root / "JPEGImages" / "clip" / "00007.png")
    np.testing.assert_array_equal(source.read(1)[..., 2::-1], rgb)
    np.testing.assert_allclose(source.seconds, [0, 2 / 24, 4 / 24])
    labels = MaskFrames(root).read(2)
    assert labels is not None and sorted(np.unique(labels)) == [0, 1, 2]


def test_a_video_has_no_masks(tmp_path):
    path = make_video(tmp_path / "v.mp4", "libx264", EVEN, 0, {"g": "20"})
    assert not MaskFrames(path) and MaskFrames(path).read(0) is None
