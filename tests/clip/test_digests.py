"""A digest per frame, of files and of videos: the same for the same clip, another for a changed frame only."""

from __future__ import annotations

import shutil
from pathlib import Path

import av
import numpy as np
import pytest
from PIL import Image

from genmojo_core.clip import digests, frames
from genmojo_core.errors import GenmojoError


def pictures(folder: Path, count: int = 6) -> Path:
    folder.mkdir()
    for n in range(count):
        Image.fromarray(np.full((24, 32, 3), 10 * n, np.uint8)).save(folder / f"{n:05d}.png")
    return folder


def film(path: Path, dark: int = -1, count: int = 12) -> Path:
    """A video of noise; frame `dark` is black."""
    rng = np.random.default_rng(0)
    with av.open(str(path), "w") as container:
        stream = container.add_stream("mpeg4", rate=24)
        stream.width, stream.height, stream.pix_fmt, stream.gop_size = 64, 48, "yuv420p", 4
        for n in range(count):
            picture = rng.integers(0, 255, (48, 64, 3)).astype(np.uint8) * (n != dark)
            for packet in stream.encode(av.VideoFrame.from_ndarray(picture, format="rgb24")):
                container.mux(packet)
        for packet in stream.encode():
            container.mux(packet)
    return path


def test_pictures_have_a_digest_each_and_only_the_changed_one_differs(tmp_path: Path) -> None:
    folder = pictures(tmp_path / "a")
    first = dict(digests.of_frames(folder))
    assert sorted(first) == list(range(6))
    assert all(d.startswith("file:") for d in first.values())
    shutil.copytree(folder, tmp_path / "b")
    Image.fromarray(np.zeros((24, 32, 3), np.uint8)).save(tmp_path / "b" / "00003.png")
    second = dict(digests.of_frames(tmp_path / "b"))
    listed = [[found[n] for n in range(6)] for found in (first, second)]
    assert digests.differing(*listed) == ([3], 6)
    assert digests.differing(listed[0], ["", "packet:0", *listed[1][2:5], ""]) == ([3], 3)


def test_what_is_known_already_comes_last(tmp_path: Path) -> None:
    folder = pictures(tmp_path / "a")
    assert [n for n, _ in digests.of_frames(folder, {0, 1, 4})] == [2, 3, 5, 0, 1, 4]


def test_videos_have_a_digest_of_their_packets(tmp_path: Path) -> None:
    one, again, other = (dict(digests.of_frames(film(tmp_path / f"{name}.mp4", dark)))
                         for name, dark in (("a", -1), ("b", -1), ("c", 5)))  # fmt: skip
    assert sorted(one) == list(range(frames.open_source(tmp_path / "a.mp4").count))
    assert one == again
    changed, compared = digests.differing(list(one.values()), list(other.values()))
    assert compared == 12
    assert changed[0] == 5
    assert 0 not in changed


def test_a_clip_that_is_not_there_is_told(tmp_path: Path) -> None:
    with pytest.raises(GenmojoError):
        list(digests.of_frames(tmp_path / "nowhere"))
