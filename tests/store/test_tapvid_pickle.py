"""TAP-Vid pickles: DAVIS and RGB-stacking layouts are read after consent; anything but arrays is refused unrun."""

from __future__ import annotations

import pickle
from pathlib import Path

import numpy as np
import pytest

from genmojo_core.errors import GenmojoError
from genmojo_core.store import tapvid, tapvid_pickle
from genmojo_core.tracks.model import OCCLUDED, VISIBLE


class Harm:
    """Would make a file when unpickled."""

    def __init__(self, target: Path) -> None:
        self.target = target

    def __reduce__(self) -> tuple:
        return open, (str(self.target), "w")


def video() -> dict[str, np.ndarray]:
    points = np.array([[[0.25, 0.5], [0.5, 0.75]]], np.float32)
    return {"video": np.zeros((2, 40, 80, 3), np.uint8), "points": points, "occluded": np.array([[False, True]])}


@pytest.mark.parametrize("protocol", [2, 4, 5])
def test_both_layouts_are_read_in_pixels_of_their_frames(tmp_path: Path, protocol: int) -> None:
    for name, held in (("davis", {"goat": video(), "../cow": video()}), ("rgb", [video(), video()])):
        file = tmp_path / f"{name}.pkl"
        file.write_bytes(pickle.dumps(held, protocol))
        tracks = tapvid_pickle.read(file, tmp_path / name, consent=True).tracks
        assert tracks.xy[0].tolist() == [[20.0, 20.0], [40.0, 30.0]]
        assert tracks.state[0].tolist() == [VISIBLE, OCCLUDED]
        assert len(list((tmp_path / name).glob("*.npz"))) == 2


def test_names_that_look_alike_stay_two_videos_and_jpeg_bytes_tell_their_size(tmp_path: Path) -> None:
    import cv2

    jpeg = cv2.imencode(".jpg", np.zeros((30, 50, 3), np.uint8))[1].tobytes()
    held = {"a b": video(), "a/b": video() | {"video": np.array([jpeg, jpeg], object)}}
    (tmp_path / "k.pkl").write_bytes(pickle.dumps(held))
    files = tapvid_pickle.unpack(tmp_path / "k.pkl", tmp_path / "out", consent=True)
    assert [file.stem for file in files] == ["a_b", "a_b_2"]
    sizes = [tapvid.read(file).tracks.size for file in files]
    assert sizes == [(80, 40), (50, 30)]


def test_without_consent_nothing_is_opened(tmp_path: Path) -> None:
    with pytest.raises(GenmojoError, match="can run code"):
        tapvid_pickle.read(tmp_path / "absent.pkl", tmp_path, consent=False)


@pytest.mark.parametrize("where", ["beside", "inside"])
def test_a_pickle_with_code_is_refused_and_the_code_does_not_run(tmp_path: Path, where: str) -> None:
    bad = Harm(tmp_path / "made")
    held = {"goat": video(), "x": bad} if where == "beside" else {"goat": video() | {"points": bad}}
    (tmp_path / "bad.pkl").write_bytes(pickle.dumps(held))
    with pytest.raises(GenmojoError, match=r"asks for .*open"):
        tapvid_pickle.read(tmp_path / "bad.pkl", tmp_path / "out", consent=True)
    assert not (tmp_path / "made").exists()


def test_noise_is_no_pickle(tmp_path: Path) -> None:
    rng = np.random.default_rng(0)
    whole = pickle.dumps({"goat": video()})
    for k in range(4):
        data = bytearray(whole)
        for at in rng.integers(0, len(data), 3):
            data[at] = int(rng.integers(256))
        (tmp_path / "n.pkl").write_bytes(bytes(data[: len(data) - 100 * k]))
        try:
            tapvid_pickle.read(tmp_path / "n.pkl", tmp_path / f"n{k}", consent=True)
        except GenmojoError as error:
            assert "\n" not in error.sentence()
