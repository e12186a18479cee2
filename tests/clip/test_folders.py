"""Every folder layout becomes the same clip: frames, ids, gaps, void, per-object folders, selections and sizes."""

from __future__ import annotations

import json
import tracemalloc

import cv2
import numpy as np
import pytest
from clip_files import labels, make_clip, picture, put_image, put_mask, shared_clip
from hypothesis import given, settings
from hypothesis import strategies as st

from genmojo_core.clip import folders, resize
from genmojo_core.errors import GenmojoError


def test_clip_folder(tmp_path):
    clip = folders.read(make_clip(tmp_path / "pair"))
    assert (clip.name, clip.size, clip.source_size, len(clip)) == ("pair", (32, 24), (32, 24), 3)
    np.testing.assert_array_equal(clip.frames, [picture(seed=t) for t in range(3)])
    np.testing.assert_array_equal(clip.masks.value, [labels()] * 3)
    assert clip.masks.valid.all() and clip.masks.given
    assert clip.object_ids.tolist() == [1, 2] and clip.object_names == ("object 1", "object 2")
    assert clip.pixel_aspect == 1 and clip.guesses == ()
    assert all(c is None for c in (clip.depth, clip.cameras, clip.flow, clip.background, clip.tracks))
    np.testing.assert_allclose(clip.seconds, [0, 1 / 24, 2 / 24])


@pytest.mark.parametrize("layout", ["480p", ""])
@pytest.mark.parametrize("given_as", ["folder", "name in root"])
def test_davis_and_mose_sequences(tmp_path, layout, given_as):
    """One sequence of many, given by its frames' folder or as <root>/<name>."""
    for name in ("bear", "goat"):
        for t in range(2):
            put_image(tmp_path / "JPEGImages" / layout / name / f"{t:05d}.jpg", picture(seed=t))
            put_mask(tmp_path / "Annotations" / layout / name / f"{t:05d}.png", labels(ids=(3,)))
    path = tmp_path / "JPEGImages" / layout / "goat" if given_as == "folder" else tmp_path / "goat"
    clip = folders.read(path)
    assert clip.name == "goat" and clip.object_ids.tolist() == [3] and clip.masks.valid.all()
    with pytest.raises(GenmojoError, match=r"holds 2 clips \(bear, goat"):
        folders.read(tmp_path)


def test_mose_valid_has_masks_in_the_first_frame_only(tmp_path):
    root = make_clip(tmp_path / "clip")
    for t in (1, 2):
        (root / "Annotations" / "clip" / f"{t:05d}.png").unlink()
    clip = folders.read(root)
    assert clip.masks.valid.any(axis=(1, 2)).tolist() == [True, False, False]
    assert not clip.object_mask(0)[1:].any()
    assert folders.read(root, frames=(1, 3)).masks is None


@pytest.mark.parametrize("background", [True, False])
def test_genmojo_layout_keeps_its_last_object(tmp_path, background):
    """Frames directly in JPEGImages, one binary folder per object; no 000 folder must not cost an object."""
    for t in range(2):
        put_image(tmp_path / "JPEGImages" / f"{t:05d}.png", picture(seed=t))
        index = labels(ids=(1, 2, 3))
        for i in range(0 if background else 1, 4):
            put_image(tmp_path / "Annotations" / f"{i:03d}" / f"{t:05d}.png", ((index == i) * 255).astype(np.uint8))
    clip = folders.read(tmp_path)
    assert clip.object_ids.tolist() == [1, 2, 3]
    np.testing.assert_array_equal(clip.masks.value, [labels(ids=(1, 2, 3))] * 2)


def test_pixels_of_two_binary_masks_are_void(tmp_path):
    put_image(tmp_path / "JPEGImages" / "00000.png", picture())
    for i in (1, 2):
        mask = np.zeros((24, 32), np.uint8)
        mask[4:10, 4 * i : 4 * i + 6] = 255
        put_image(tmp_path / "Annotations" / f"{i:03d}" / "00000.png", mask)
    clip = folders.read(tmp_path)
    assert (clip.masks.value == 1).sum() == (clip.masks.value == 2).sum() == 24
    assert (~clip.masks.valid).sum() == 12


def test_void_is_background_and_not_valid(tmp_path):
    root = make_clip(tmp_path / "clip", frames=1)
    index = labels()
    index[4, :20] = 255
    put_mask(root / "Annotations" / "clip" / "00000.png", index)
    clip = folders.read(root)
    np.testing.assert_array_equal(clip.masks.valid[0], index != 255)
    assert clip.masks.value.max() == 2 and (clip.masks.value[0, 4] == 0).all()


def test_gaps_in_numbers_stay_gaps(tmp_path):
    clip = folders.read(make_clip(tmp_path / "clip", numbers=[34, 35, 40]))
    assert clip.frame_index.tolist() == [34, 35, 40]
    np.testing.assert_allclose(clip.seconds * 24, [0, 1, 6])
    assert folders.read(tmp_path / "clip", frames=(1, None)).frame_index.tolist() == [35, 40]


def test_numbers_sort_as_numbers_and_masks_follow_numbers(tmp_path):
    """img2 before img10; masks may spell the numbers differently."""
    for t in (2, 10, 1):
        put_image(tmp_path / f"img{t}.png", picture(seed=t))
        put_mask(tmp_path / "masks" / f"{t:04d}.png", labels(ids=(t,)))
    clip = folders.read(tmp_path)
    assert clip.frame_index.tolist() == [1, 2, 10]
    np.testing.assert_array_equal(clip.frames[2], picture(seed=10))
    assert [np.unique(m).tolist() for m in clip.masks.value] == [[0, 1], [0, 2], [0, 3]]
    assert clip.object_ids.tolist() == [1, 2, 10]


def test_folder_without_numbers_and_a_still(tmp_path):
    put_image(tmp_path / "shots" / "red.png", picture(seed=1))
    put_image(tmp_path / "shots" / "blue.png", picture(seed=2))
    clip = folders.read(tmp_path / "shots")
    assert clip.source_names == ("blue.png", "red.png") and clip.frame_index.tolist() == [0, 1]
    still = folders.read(tmp_path / "shots" / "red.png")
    assert len(still) == 1 and still.name == "red" and still.masks is None


@pytest.mark.parametrize("how", ["grey ids", "black and white", "davis colours", "16 bit", "1 bit"])
def test_masks_that_are_no_palette_files(tmp_path, how):
    """RGB copies of palettes are mapped back; a black and white mask is one object; ids may be grey levels."""
    from genmojo_core.clip import png

    index = labels(ids=(1, 2))
    stored = {
        "grey ids": index,
        "black and white": ((index > 0) * 255).astype(np.uint8),
        "davis colours": png.davis_palette()[index],
        "16 bit": index.astype(np.uint16),
        "1 bit": (index > 0).astype(np.uint8),
    }[how]
    put_image(tmp_path / "JPEGImages" / "00000.png", picture())
    path = put_image(tmp_path / "Annotations" / "00000.png", stored)
    if how == "1 bit":
        cv2.imwrite(str(path), stored * 255, [cv2.IMWRITE_PNG_BILEVEL, 1])
    clip = folders.read(tmp_path)
    expected = (index > 0) if how in ("black and white", "1 bit") else index
    np.testing.assert_array_equal(clip.masks.value[0], expected)
    assert clip.masks.valid.all()


def test_meta_names_rate_and_pixel_shape(tmp_path):
    root = make_clip(tmp_path / "clip")
    about = {"fps": 30, "objects": {"2": "<img src=//host/x>"}, "pixel_aspect": 1.5, "note": "anything"}
    (root / "meta.json").write_text(json.dumps(about))
    clip = folders.read(root)
    assert clip.object_names == ("object 1", "<img src=//host/x>")
    assert clip.pixel_aspect == 1.5 and clip.seconds[1] == pytest.approx(1 / 30)
    assert folders.read(root, pixel_aspect=2.0).pixel_aspect == 2.0


@pytest.mark.parametrize("frames", [(0, None), (1, 3), (0, 99), (2, 3)])
def test_frame_selection(tmp_path, frames):
    root = make_clip(tmp_path / "clip", frames=4)
    clip = folders.read(root, frames=frames)
    assert clip.frame_index.tolist() == list(range(4))[slice(*frames)]
    np.testing.assert_array_equal(clip.frames[0], picture(seed=frames[0]))


@pytest.mark.parametrize("frames", [(4, None), (2, 2), (-1, 3), (3, 1)])
def test_selection_of_nothing_is_told(tmp_path, frames):
    with pytest.raises(GenmojoError, match="select nothing of 4 frames") as caught:
        folders.read(make_clip(tmp_path / "clip", frames=4), frames=frames)
    assert caught.value.code == "argument"


@settings(max_examples=40, deadline=None)
@given(st.integers(1, 400), st.integers(1, 400), st.integers(1, 500))
def test_reduced_size_keeps_the_shape_and_never_enlarges(width, height, side):
    small = resize.fitted((width, height), side)
    assert small[0] <= width and small[1] <= height and min(small) == min(side, width, height)
    scale = min(small) / min(width, height)
    assert abs(small[0] - width * scale) <= 0.5 and abs(small[1] - height * scale) <= 0.5


def test_reduced_frames_are_area_means_and_labels_are_labels(tmp_path):
    root = make_clip(tmp_path / "clip")
    clip = folders.read(root, short_side=12)
    assert clip.size == (16, 12) and clip.source_size == (32, 24)
    means = picture(seed=1).reshape(12, 2, 16, 2, 3).mean(axis=(1, 3))
    np.testing.assert_allclose(clip.frames[1], means, atol=0.5)
    np.testing.assert_array_equal(clip.masks.value[1], labels()[1::2, 1::2])
    assert folders.read(root, short_side=100).size == (32, 24)


def test_a_tiny_object_survives_reduction(tmp_path):
    root = make_clip(tmp_path / "clip", frames=1)
    index = np.zeros((24, 32), np.uint8)
    index[20, 30] = 7
    index[3:9, 3:9] = 4
    put_mask(root / "Annotations" / "clip" / "00000.png", index)
    clip = folders.read(root, short_side=5)
    assert clip.object_ids.tolist() == [4, 7]
    assert np.argwhere(clip.masks.value[0] == 2).tolist() == [[20 * 5 // 24, 30 * 7 // 32]]


def test_reading_small_needs_little_memory(tmp_path):
    """40 frames of 960 x 720 at 96 on the short side: one full frame at a time, not 83 MB."""
    for t in range(40):
        put_image(tmp_path / "clip" / f"{t:03d}.jpg", np.full((720, 960, 3), 6 * t, np.uint8))
    folders.read(tmp_path / "clip", short_side=96, frames=(0, 1))  # what is loaded once
    tracemalloc.start()
    clip = folders.read(tmp_path / "clip", short_side=96)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert clip.frames.nbytes == 40 * 96 * 128 * 3
    assert peak < clip.frames.nbytes + 5 * 960 * 720 * 3
    assert clip.frames[:, 5, 5, 0].tolist() == [6 * t for t in range(40)]


@pytest.mark.clips
@pytest.mark.parametrize(
    ("name", "count", "size", "ids"),
    [
        ("gold-fish", 78, (512, 512), [1, 2, 3, 4, 5]),
        ("crossing", 52, (512, 512), [1, 2, 3]),
        ("dogs-jump", 11, (512, 512), [1, 2, 3]),
        ("bear", 82, (854, 480), []),
        ("tennis", 24, (448, 256), [1]),
        ("blender-cross", 24, (480, 270), [1, 2]),
        ("blender-trio", 24, (480, 270), [1, 2, 3]),
    ],
)
def test_shared_clips(name, count, size, ids):
    clip = folders.read(shared_clip(name), short_side=64)
    assert (len(clip), clip.source_size, clip.object_ids.tolist()) == (count, size, ids)
    assert (clip.masks is None) == (not ids)
    assert np.all(np.diff(clip.seconds) > 0) and 20 < clip.frames.mean() < 235
    if name == "dogs-jump":
        assert clip.frame_index.tolist() == list(range(34, 45)) and clip.object_names[2] == "person"
    if ids:
        assert clip.masks.value.max() == len(ids)
    if name.startswith("blender"):
        assert clip.depth.valid.all() and clip.depth.value.min() > 4 and clip.depth.value.max() < 13
        assert clip.cameras.value.size == clip.size
    if name == "bear":
        assert clip.tracks.value.state.shape == (20, 82)
        assert (clip.tracks.value.state == 1).sum() == 300 and (clip.tracks.value.state == 2).sum() == 40
