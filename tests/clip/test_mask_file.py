"""Corrected masks come back at any size and for any frames, and nothing that does not fit is taken."""

import numpy as np
import pytest

from genmojo_core.clip import mask_file
from genmojo_core.clip.clip import Channel, Clip
from genmojo_core.errors import GenmojoError


def _clip(frames, size=(8, 6), numbers=None):
    width, height = size
    pixels = np.zeros((frames, height, width, 3), np.uint8)
    numbers = np.arange(frames) if numbers is None else np.array(numbers)
    return Clip("c", "c", pixels, numbers, numbers / 24, tuple(map(str, numbers)), (16, 12))


def _masked(frames=3, size=(16, 12)):
    clip = _clip(frames, size)
    labels = np.zeros(clip.frames.shape[:3], np.uint8)
    labels[:, 2:6, 2:8] = 1
    labels[1, 8:12, 8:16] = 2
    valid = np.ones(labels.shape, bool)
    valid[2, 0] = False
    return clip.with_channels(masks=Channel(labels, valid, "given: x"), object_ids=np.array([4, 9]),
                              object_names=("ball", "böx"))  # fmt: skip


def test_masks_come_back_at_another_size_for_other_frames(tmp_path):
    path = tmp_path / "a.masks.npz"
    path.write_bytes(mask_file.to_bytes(_masked()))
    same = mask_file.with_masks(_clip(3, (16, 12)), path)
    np.testing.assert_array_equal(same.masks.value, _masked().masks.value)
    np.testing.assert_array_equal(same.masks.valid, _masked().masks.valid)
    assert same.object_ids.tolist() == [4, 9] and same.object_names == ("ball", "böx") and same.masks.given
    half = mask_file.with_masks(_clip(3, (8, 6), [1, 2, 7]), path)
    assert half.masks.value[0].tolist() == _masked().masks.value[1, ::2, ::2].tolist()
    assert half.masks.valid[0].all() and not half.masks.valid[2].any()  # frame 7 is not in the file


@pytest.mark.parametrize("spoil", ["frames", "label", "shape"])
def test_what_does_not_fit_is_refused(tmp_path, spoil):
    with np.load(_written(tmp_path)) as file:
        arrays = dict(file)
    if spoil == "frames":
        arrays["frame_index"] = arrays["frame_index"] + 100
    elif spoil == "label":
        arrays["object_ids"], arrays["object_names"] = arrays["object_ids"][:1], arrays["object_names"][:1]
    else:
        arrays["valid"] = arrays["valid"][:, 1:]
    np.savez(tmp_path / "bad.npz", **arrays)
    with pytest.raises(GenmojoError) as error:
        mask_file.with_masks(_clip(3), tmp_path / "bad.npz")
    assert error.value.code == ("empty" if spoil == "frames" else "schema")


def _written(folder):
    path = folder / "good.npz"
    path.write_bytes(mask_file.to_bytes(_masked()))
    return path
