"""Depth, cameras, flow and tracks files that are broken or hostile: one sentence naming file and array.

Numbers in brackets are rows of the bad-input catalogue (RELIABILITY.md section c).
"""

from __future__ import annotations

import io
import struct
import tracemalloc
import zipfile

import numpy as np
import pytest
from clip_files import make_clip
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from genmojo_core.clip import folders
from genmojo_core.errors import GenmojoError

T, H, W = 3, 24, 32
LENS = np.array([[30.0, 0, 16], [0, 30, 12], [0, 0, 1]])
POSES = np.repeat(np.eye(4)[None], T, axis=0)


@pytest.fixture
def root(tmp_path):
    return make_clip(tmp_path / "clip", frames=T)


def refused(root, code: str, *words: str) -> None:
    """Reading must fail with one sentence that has these words."""
    with pytest.raises(GenmojoError) as caught:
        folders.read(root)
    sentence = caught.value.sentence()
    assert caught.value.code == code, sentence
    assert "\n" not in sentence and len(sentence) < 400
    for word in words:
        assert word in sentence, sentence


@pytest.mark.parametrize("name", ["depth", "cameras", "flow", "tracks"])
@pytest.mark.parametrize("content", [b"", b"junk", b"PK\x03\x04" + bytes(50), b"\x93NUMPY" + bytes(50)])
def test_files_that_are_no_npz(root, name, content):
    (root / f"{name}.npz").write_bytes(content)
    refused(root, "format", f"{name}.npz", "no npz file or is damaged")


@pytest.mark.parametrize("name", ["depth", "cameras", "flow", "tracks"])
def test_python_objects_are_never_read(root, name):
    """[2] the header alone is enough to refuse."""
    np.savez(root / f"{name}.npz", depth=np.array([{"a": 1}], dtype=object), allow_pickle=True)
    refused(root, "unsafe_pickle", f"{name}.npz: depth", "could run code")


def _npz_with(path, header: dict, data: bytes = b"") -> None:
    """An npz whose one array has a header of our making."""
    text = (repr(header) + "\n").encode()
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        archive.writestr("depth.npy", b"\x93NUMPY\x01\x00" + struct.pack("<H", len(text)) + text + data)
    path.write_bytes(buffer.getvalue())


@pytest.mark.parametrize("shape", [(10**6, 10**6, 10**6), (T, H, W), (-1, 5, 5), (1,) * 20, (T, 10**5, 10**4)])
def test_declared_sizes_are_not_believed(root, shape):
    """[5] nothing is allocated for what is not there."""
    _npz_with(root / "depth.npz", {"descr": "<f4", "fortran_order": False, "shape": shape}, bytes(16))
    tracemalloc.start()
    with pytest.raises(GenmojoError) as caught:
        folders.read(root)
    assert tracemalloc.get_traced_memory()[1] < 5_000_000
    tracemalloc.stop()
    assert caught.value.code in ("size", "format") and "depth.npz: depth" in caught.value.sentence()


def test_header_that_is_code(root):
    _npz_with(root / "depth.npz", {"descr": "<f4", "fortran_order": False, "shape": (1,), "x": "__import__('os')"})
    refused(root, "format", "depth")


@pytest.mark.parametrize(
    ("array", "code", "words"),
    [
        (np.zeros((T, H, W), np.float32), "empty", ["no valid depth", "--ignore depth"]),
        (np.full((T, H, W), np.nan, np.float32), "empty", ["no valid depth"]),
        (np.full((T, H, W), -3, np.float32), "empty", ["no valid depth"]),
        (np.full((T, H, W), np.inf, np.float16), "empty", ["no valid depth"]),
        (np.ones((T, H, W), np.uint8), "schema", ["uint8", "floating"]),
        (np.ones((T, H, W), "U3"), "schema", ["<U3"]),
        (np.ones((T, H, W), np.complex64), "schema", ["complex64"]),
        (np.ones((T - 1, H, W), np.float32), "schema", ["2 frames for a clip of 3"]),
        (np.ones((H, W), np.float32), "schema", ["(24, 32)", "(T, H, W)"]),
        (np.ones((T, W, H), np.float32), "schema", ["24 x 32, another shape than the frames' 32 x 24"]),
        (np.ones((T, 0, W), np.float32), "schema", ["(3, 0, 32)"]),
        (np.float32(1), "schema", ["()"]),
    ],
)
def test_depth_that_is_none(root, array, code, words):
    """[30]"""
    np.savez(root / "depth.npz", depth=array)
    refused(root, code, "depth.npz", *words)


def test_missing_arrays_are_named(root):
    np.savez(root / "depth.npz", disparity=np.ones((T, H, W)))
    refused(root, "schema", "holds no 'depth' (it holds disparity)")
    (root / "depth.npz").unlink()
    np.savez(root / "cameras.npz", K=LENS)
    refused(root, "schema", "holds no 'world_to_camera'")
    (root / "cameras.npz").unlink()
    np.savez(root / "tracks.npz", xy=np.zeros((1, T, 2)))
    refused(root, "schema", "holds no 'state'")


def _posed(**changes) -> np.ndarray:
    """Poses with one changed in frame 1."""
    poses = POSES.copy()
    for name, value in changes.items():
        poses[1, *{"xx": (0, 0), "xy": (0, 1), "tx": (0, 3), "last": (3, 0)}[name]] = value
    return poses


@pytest.mark.parametrize(
    ("K", "poses", "code", "words"),
    [
        (LENS * [[0], [1], [1]], POSES, "camera", ["frame 0", "focal length"]),
        (LENS * [[-1], [1], [1]], POSES, "camera", ["focal length"]),
        (LENS * np.nan, POSES, "camera", ["not finite"]),
        (LENS, _posed(tx=np.inf), "camera", ["frame 1", "not finite"]),
        (LENS, _posed(xx=-1), "camera", ["frame 1", "left-handed"]),
        (LENS, _posed(xy=0.3), "camera", ["frame 1", "not orthonormal"]),
        (LENS, _posed(last=1), "camera", ["frame 1", "last row"]),
        (LENS, POSES[:2], "camera", ["2 cameras for 3 frames"]),
        (np.repeat(LENS[None], 2, axis=0), POSES, "camera", ["for 3 frames"]),
        (LENS[:2], POSES, "schema", ["(2, 3)"]),
        (LENS, POSES[:, :3], "schema", ["(3, 3, 4)"]),
        (LENS, POSES.astype("U5"), "schema", ["<U5"]),
        (LENS, np.eye(4), "schema", ["(4, 4)"]),
        (LENS, np.zeros((0, 4, 4)), "camera", ["0 cameras"]),
    ],
)
def test_cameras_that_are_none(root, K, poses, code, words):
    """[45]"""
    np.savez(root / "cameras.npz", K=K, world_to_camera=poses)
    refused(root, code, "cameras.npz", *words)


@pytest.mark.parametrize(
    ("extra", "word"),
    [({"world_up": [0, 0, 0]}, "no direction"), ({"world_up": [1, np.nan, 0]}, "no direction"),
     ({"world_up": [1, 2]}, "no direction"), ({"size": [0, 5]}, "size"), ({"size": [1, 2, 3]}, "size")],
)  # fmt: skip
def test_odd_extras_of_cameras(root, extra, word):
    np.savez(root / "cameras.npz", K=LENS, world_to_camera=POSES, **extra)
    refused(root, "camera", "cameras.npz", word)


def test_megasam_pose_without_inverse(root):
    np.savez(root / "cameras.npz", intrinsic=LENS, cam_c2w=np.zeros((T, 4, 4)))
    refused(root, "camera", "cannot be inverted")


@pytest.mark.parametrize(
    ("arrays", "word"),
    [
        ({"flow": np.zeros((T - 2, H, W, 2), np.float32)}, "1 frames"),
        ({"flow": np.zeros((T, H, W, 3), np.float32)}, "(3, 24, 32, 3)"),
        ({"flow": np.zeros((T, H, W, 2), np.uint8)}, "uint8"),
        ({"flow": np.zeros((T, H, W, 2), np.float32), "valid": np.ones((T, H, W + 1), bool)}, "(3, 24, 33)"),
        ({"motion": np.zeros(3)}, "holds no 'flow'"),
    ],
)
def test_flow_that_is_none(root, arrays, word):
    np.savez(root / "flow.npz", **arrays)
    refused(root, "schema", "flow.npz", word)


@pytest.mark.parametrize(
    ("changes", "code", "word"),
    [
        ({"xy": np.zeros((2, T + 1, 2))}, "schema", "(2, 4, 2)"),
        ({"xy": np.zeros((2, T, 3))}, "schema", "(2, 3, 3)"),
        ({"xy": np.full((2, T, 2), "a")}, "schema", "<U1"),
        ({"state": np.full((2, T), 9)}, "value", "0 to 3"),
        ({"state": np.full((2, T), -1)}, "value", "0 to 3"),
        ({"state": np.zeros((1, T))}, "schema", "(1, 3)"),
        ({"object": np.zeros(5, int)}, "schema", "(5,)"),
        ({"size": np.array([0, 4])}, "value", "0 x 4"),
        ({"xyz": np.zeros((2, T))}, "schema", "xyz"),
    ],
)
def test_tracks_that_are_none(root, changes, code, word):
    arrays = {"xy": np.zeros((2, T, 2)), "state": np.ones((2, T), np.uint8), "object": [1, 2], "size": [W, H]}
    np.savez(root / "tracks.npz", **{**arrays, **changes})
    refused(root, code, "tracks.npz", word)


def test_truncated_npz(root):
    np.savez_compressed(root / "depth.npz", depth=np.random.default_rng(0).uniform(1, 2, (T, H, W)))
    data = (root / "depth.npz").read_bytes()
    for keep in (0.1, 0.5, 0.99):
        (root / "depth.npz").write_bytes(data[: int(keep * len(data))])
        refused(root, "format", "depth.npz")


@settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.data())
@pytest.mark.parametrize("save", [np.savez, np.savez_compressed])
def test_one_changed_byte(root, save, data):
    """[50] refused, or the same numbers: an npz carries checksums."""
    depth = np.random.default_rng(0).uniform(1, 2, (T, H, W)).astype(np.float16)
    save(root / "depth.npz", depth=depth)
    content = bytearray((root / "depth.npz").read_bytes())
    at = data.draw(st.integers(0, len(content) - 1))
    content[at] ^= data.draw(st.integers(1, 255))
    (root / "depth.npz").write_bytes(bytes(content))
    try:
        got = folders.read(root).depth
    except GenmojoError:
        return
    np.testing.assert_array_equal(got.value, depth.astype(np.float32))
