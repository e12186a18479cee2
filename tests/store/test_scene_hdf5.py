"""Scene files: what was written comes back; what others made is refused in one sentence; nothing silently changes."""

from __future__ import annotations

import os
import shutil
from dataclasses import replace

import h5py
import numpy as np
import pytest
from scenes import messy_scene, small_scene

from genmojo_core.clip.cameras import Cameras
from genmojo_core.errors import GenmojoError
from genmojo_core.store import safe, scene_hdf5
from genmojo_core.store.scene_file import BakedScene
from genmojo_core.tracks.model import PointTracks


def tracks(frames: int = 3) -> PointTracks:
    xy = np.arange(2 * frames * 2, dtype=np.float32).reshape(2, frames, 2)
    state = np.ones((2, frames), np.uint8)
    state[0, 1], xy[0, 1] = 0, np.nan
    return PointTracks(xy, state, np.array([1, 2]), (64, 48), xyz=np.ones((2, frames, 3), np.float32))


@pytest.fixture
def path(tmp_path):
    target = tmp_path / "scene.h5"
    scene_hdf5.write(replace(messy_scene(), predicted=tracks()), target)
    return target


def code(action, *args) -> str:
    with pytest.raises(GenmojoError) as caught:
        action(*args)
    sentence = caught.value.sentence()
    assert "\n" not in sentence and sentence.endswith(".")
    return caught.value.code


def change(path, action):
    """Edit a file as a program of somebody else would."""
    with h5py.File(path, "r+", libver=("v110", "v110")) as file:
        action(file)


def overwrite(name, array):
    def action(file):
        del file[name]
        file[name] = array

    return action


# ---- round trips ------------------------------------------------------------------------------------------------


def test_everything_comes_back(path):
    """All fields exact, but rotations, scale and colour changes over time, which are kept as float16."""
    scene, found = replace(messy_scene(), predicted=tracks()), scene_hdf5.read(path)
    half = {"rot_t": 5e-4, "log_scale_t": 5e-4, "d_dc": 5e-4, "rot": 1e-6}
    for name, value in vars(scene).items():
        other = getattr(found, name)
        if isinstance(value, np.ndarray):
            assert other.shape == value.shape, name
            np.testing.assert_allclose(other, value, atol=half.get(name, 0), rtol=0, err_msg=name)
        elif name == "cameras":
            np.testing.assert_array_equal(other.K, value.K)
            np.testing.assert_array_equal(other.world_to_camera, value.world_to_camera)
            assert other.size == value.size
        elif name == "predicted":
            np.testing.assert_array_equal(other.xy, value.xy)
            np.testing.assert_array_equal(other.state, value.state)
            assert other.size == value.size and other.conf is None
        else:
            assert other == value, name


def test_world_frames_are_the_same(path):
    """What a viewer draws does not move by more than float16 rotations allow; positions not at all."""
    scene, found = messy_scene(), scene_hdf5.read(path)
    for t in range(3):
        a, b = scene.frame(t), found.frame(t)
        np.testing.assert_array_equal(a.means, b.means)
        np.testing.assert_allclose(a.scales, b.scales, rtol=2e-3)
        np.testing.assert_allclose(np.abs((a.quats * b.quats).sum(-1)), 1, atol=1e-5)


def test_an_independent_reader_understands_it(path):
    """The layout of VIEWER.md 5.1 by name, shape and meaning, with h5py alone."""
    scene = messy_scene()
    with h5py.File(path, "r") as file:
        assert file.attrs["format"] == b"genmojo4d" or file.attrs["format"] == "genmojo4d"
        assert file.attrs["complete"] == 1
        np.testing.assert_array_equal(file["time/frame_index"][()], scene.frame_index)
        t, world = 1, file["object_to_world"][1]
        xyz = file["gaussians/xyz"][()] + file["deformation/dense/d_xyz"][t]
        ids = list(file["objects/id"][()])
        row = np.array([ids.index(i) for i in file["gaussians/object_id"][()]])
        means = np.einsum("nij,nj->ni", world[row, :, :3], xyz) + world[row, :, 3]
        np.testing.assert_allclose(means, scene.frame(t).means, atol=1e-5)
        for dataset in ("gaussians/xyz", "deformation/dense/d_xyz", "tracks/predicted/uv"):
            assert {"units", "axes", "description"} <= set(file[dataset].attrs)
        assert file["deformation/dense/rot_wxyz"].attrs["max_abs_error"] < 1e-3
        assert file["deformation/dense/d_xyz"].chunks[0] == 1


def test_tracks_only_file(tmp_path):
    """A file may hold tracks without a scene: ids, times and visibility survive, Gaussians are none."""
    base = small_scene(frames=3)
    scene = replace(
        base, objects=(), xyz=base.xyz[:0], rot=base.rot[:0], scale=base.scale[:0], opacity=base.opacity[:0],
        dc=base.dc[:0], uid=base.uid[:0], d_xyz=base.d_xyz[:, :0], rot_t=base.rot_t[:, :0],
        log_scale_t=base.log_scale_t[:, :0], object_to_world=base.object_to_world[:, :0],
        depth_scale=base.depth_scale[:, :0], ref_frame=base.ref_frame[:0], predicted=tracks(),
    )  # fmt: skip
    target = tmp_path / "tracks.h5"
    scene_hdf5.write(scene, target)
    found = scene_hdf5.read(target)
    assert len(found.xyz) == 0 and found.objects == () and len(found) == 3
    np.testing.assert_array_equal(found.predicted.state, tracks().state)
    change(target, lambda file: file.__delitem__("cameras"))
    assert scene_hdf5.read(target).cameras.size == (64, 48)


@pytest.mark.parametrize("frames", [1, 2])
def test_still_and_ids_with_gaps(tmp_path, frames):
    scene = small_scene(frames=frames)
    objects = tuple(replace(o, id={1: 15, 2: 29}.get(o.id, o.id), name="a<b> ü\n") for o in scene.objects)
    scene_hdf5.write(replace(scene, objects=objects), tmp_path / "a.h5")
    found = scene_hdf5.read(tmp_path / "a.h5")
    assert found.objects == objects and len(found) == frames


def test_infinite_budget_is_null(tmp_path):
    """`full` has no budget; JSON has no infinity."""
    scene_hdf5.write(replace(small_scene(), config={"budget_seconds": float("inf"), "n": np.int64(3)}), tmp_path / "a")
    assert scene_hdf5.read(tmp_path / "a").config == {"budget_seconds": None, "n": 3}


def test_static_scene_is_small(tmp_path):
    """Rows that never move cost next to nothing."""
    scene = small_scene(frames=40, per_object=2000)
    scene_hdf5.write(scene, tmp_path / "a.h5")
    motion = [d for d in scene_hdf5.inspect(tmp_path / "a.h5")["datasets"] if "/deformation/dense/" in d["path"]]
    assert len(motion) == 3 and sum(d["stored"] for d in motion) < 0.02 * sum(d["bytes"] for d in motion)


def test_inspect_and_validate(path):
    found = scene_hdf5.inspect(path)
    assert found["frames"] == 3 and found["gaussians"] == 263 and found["tracks"] == 2 and found["size"] == [64, 48]
    assert [o["name"] for o in found["objects"]] == ["background", "disc 1", "disc 2"]
    assert scene_hdf5.validate(path) == []


# ---- writing ----------------------------------------------------------------------------------------------------


def test_a_scene_that_is_none_is_not_written(tmp_path):
    scene = small_scene()
    bad = scene.d_xyz.copy()
    bad[1, 5, 2] = np.nan
    for broken in (
        replace(scene, d_xyz=bad),
        replace(scene, scale=scene.scale * 0),
        replace(scene, opacity=scene.opacity + 1),
        replace(scene, objects=scene.objects[:2]),
        replace(scene, seconds=scene.seconds * 0),
        replace(scene, cameras=Cameras(scene.cameras.K * np.nan, scene.cameras.world_to_camera, scene.cameras.size)),
    ):
        assert code(scene_hdf5.write, broken, tmp_path / "a.h5") in ("value", "camera")
        assert os.listdir(tmp_path) == []


def test_failed_verification_leaves_the_old_file(path, monkeypatch):
    """What does not read back equal never replaces what was there."""
    before = path.read_bytes()
    monkeypatch.setattr(scene_hdf5, "read_array", lambda *_: np.zeros(3))
    assert code(scene_hdf5.write, small_scene(), path) == "corrupt"
    assert path.read_bytes() == before and os.listdir(path.parent) == [path.name]


# ---- files of others --------------------------------------------------------------------------------------------


def test_truncated_random_empty_folder_missing_each_have_a_sentence(path, tmp_path):
    data = path.read_bytes()
    files = {"cut": data[: len(data) // 2], "random": os.urandom(5000), "empty": b"", "png": b"\x89PNG\r\n\x1a\n" * 9}
    sentences = set()
    for name, content in files.items():
        (tmp_path / name).write_bytes(content)
    for name in (*files, "missing", "."):
        with pytest.raises(GenmojoError) as caught:
            scene_hdf5.read(tmp_path / name)
        sentences.add(caught.value.what)
        assert scene_hdf5.validate(tmp_path / name) == [caught.value.sentence()]
    assert len(sentences) == 5  # random and png are both "not an HDF5 file"


@pytest.mark.parametrize(
    ("action", "expected"),
    [
        (lambda f: f.__setitem__("a", h5py.ExternalLink("/etc/passwd", "/x")), "hdf5_link"),
        (lambda f: f.__setitem__("a", h5py.SoftLink("/a")), "hdf5_link"),
        (lambda f: f["gaussians"].__setitem__("cycle", f["/gaussians"]), "hdf5_link"),
        (lambda f: f.create_dataset("a", (4,), "u1", external=[("/etc/passwd", 0, 4)]), "hdf5_link"),
        (lambda f: f.create_dataset("a", (10**13,), "f4", chunks=(1000,)), "size"),
        (lambda f: f.create_dataset("a", (1 << 28,), "u1", chunks=(1 << 27,), compression="gzip"), "size"),
        (lambda f: f.create_dataset("a", data=np.arange(9.0), compression=32000, chunks=(9,)), "format"),
        (lambda f: f.attrs.__setitem__("complete", 0), "corrupt"),
        (lambda f: f.attrs.__setitem__("format", "other"), "format"),
        (lambda f: f.attrs.__setitem__("version", "2.0"), "version"),
        (lambda f: f.attrs.__setitem__("up", np.zeros(3)), "schema"),
        (lambda f: f.__delitem__("time"), "schema"),
        (lambda f: f.__delitem__("gaussians/scale"), "schema"),
        (overwrite("gaussians/opacity", np.full(263, np.nan, np.float32)), "schema"),
        (overwrite("gaussians/xyz", np.full((263, 3), 1e30, np.float32)), "schema"),
        (overwrite("gaussians/xyz", np.zeros((262, 3), np.float32)), "schema"),
        (overwrite("gaussians/xyz", np.zeros(263, np.float32)), "schema"),
        (overwrite("gaussians/xyz", np.full((263, 3), b"x")), "schema"),
        (overwrite("tracks/predicted/state", np.full((2, 3), 9, np.uint8)), "schema"),
        (overwrite("objects/count", np.array([263, 263, 263])), "schema"),
        (overwrite("time/frame_index", np.array([1, 1, 2], np.int32)), "schema"),
        (overwrite("config/run", np.array([b'{"a": NaN}'])), "format"),
        (overwrite("config/run", np.array([b'{"a": 1, "a": 2}'])), "format"),
        (overwrite("config/run", np.array([b"[" * 5000])), "format"),
        (overwrite("config/run", np.array([b'{"a": 1e999}'])), "format"),
        (overwrite("cameras/input/K", np.zeros((3, 3, 3))), "camera"),
    ],
)
def test_refused(path, action, expected):
    """Links out of the file, bombs, foreign filters, unfinished files, wrong shapes and impossible numbers."""
    change(path, action)
    assert code(scene_hdf5.read, path) == expected
    assert scene_hdf5.validate(path)


def test_virtual_dataset(path):
    """Missing sources of virtual datasets read as zeros; they are refused instead."""
    layout = h5py.VirtualLayout((4,), "f4")
    layout[:] = h5py.VirtualSource("nowhere.h5", "x", (4,))
    change(path, lambda file: file.create_virtual_dataset("a", layout))
    assert code(scene_hdf5.read, path) == "hdf5_link"


def test_deep_and_wide_files(path):
    change(path, lambda file: file.create_group("/".join("a" * 40)))
    assert code(scene_hdf5.read, path) == "size"
    change(path, lambda file: file.__delitem__("a"))

    def wide(file):
        group = file.create_group("b")
        for i in range(safe.MAX_OBJECTS + 1):
            group.create_group(f"{i}")

    change(path, wide)
    assert code(scene_hdf5.read, path) == "size"


def test_unknown_groups_are_ignored(path):
    """A minor version adds; this reader goes on."""
    change(path, lambda file: file.create_dataset("new/thing", data=np.arange(3)))
    change(path, lambda file: file.attrs.__setitem__("version", "1.7"))
    assert len(scene_hdf5.read(path)) == 3


def test_all_faults_are_told_together(path):
    change(path, lambda file: [file.__delitem__(f"gaussians/{n}") for n in ("scale", "opacity", "uid")])
    assert len(scene_hdf5.validate(path)) == 3


def test_flipped_bits_never_change_a_scene_silently(path, tmp_path):
    """200 single-bit flips: each is refused, or the scene is what it was."""
    rng, data, target = np.random.default_rng(0), bytearray(path.read_bytes()), tmp_path / "flipped.h5"
    wanted = _digest(scene_hdf5.read(path))
    refused = 0
    for position, bit in zip(rng.integers(0, len(data), 200), rng.integers(0, 8, 200), strict=True):
        data[position] ^= 1 << bit
        target.write_bytes(data)
        data[position] ^= 1 << bit
        try:
            found = scene_hdf5.read(target)
        except GenmojoError:
            refused += 1
            continue
        assert _digest(found) == wanted, (position, bit)
    assert refused > 130


def test_killed_writers_leave_whole_files(path, tmp_path):
    """A leftover of a killed writer is beside the target, never in its place."""
    leftover = tmp_path / "scene.h5.0000.part"
    shutil.copy(path, leftover)
    leftover.write_bytes(leftover.read_bytes()[:1000])
    assert len(scene_hdf5.read(path)) == 3


def _digest(scene: BakedScene) -> tuple:
    arrays = [np.asarray(v).tobytes() for v in vars(scene).values() if isinstance(v, np.ndarray)]
    rest = [v for k, v in vars(scene).items() if k in ("objects", "config", "metrics", "curve", "source_names", "fps")]
    return (arrays, repr(rest), scene.predicted.xy.tobytes(), scene.cameras.K.tobytes(), scene.world_up.tobytes(),
            scene.run_uuid, scene.generator, scene.pixel_aspect, scene.created_utc)  # fmt: skip


def test_the_dilation_comes_back_and_scales_with_the_picture(tmp_path) -> None:
    scene = small_scene()
    made_at_half = replace(scene, cameras=replace(scene.cameras, dilation=1.2))
    scene_hdf5.write(made_at_half, tmp_path / "a.h5")
    back = scene_hdf5.read(tmp_path / "a.h5").cameras
    assert back.dilation == 1.2
    width, height = back.size
    assert back.view(0).resized(width // 2, height // 2).dilation == pytest.approx(0.3)
