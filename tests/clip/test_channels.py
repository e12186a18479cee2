"""Depth, cameras, flow and tracks beside a clip: scaled to the frames read, selected with them, validity kept."""

from __future__ import annotations

import numpy as np
import pytest
from clip_files import make_clip, put_image, shared_clip
from hypothesis import given, settings
from hypothesis import strategies as st

from genmojo_core.clip import folders, npz, resize
from genmojo_core.clip.points import NONE, OCCLUDED, OUT_OF_VIEW, VISIBLE
from genmojo_core.errors import GenmojoError

T, H, W = 3, 24, 32


@pytest.fixture
def clip_folder(tmp_path):
    return make_clip(tmp_path / "clip", frames=T)


def planes(seed: int = 0) -> np.ndarray:
    return np.random.default_rng(seed).uniform(1, 9, (T, H, W)).astype(np.float32)


@pytest.mark.parametrize("key", ["depth", "depths"])
@pytest.mark.parametrize("dtype", [np.float16, np.float32, np.float64])
def test_depth_is_read_and_selected(clip_folder, key, dtype):
    depth = planes().astype(dtype)
    np.savez_compressed(clip_folder / "depth.npz", **{key: depth})
    clip = folders.read(clip_folder)
    np.testing.assert_array_equal(clip.depth.value, depth.astype(np.float32))
    assert clip.depth.valid.all() and clip.depth.given and "depth.npz" in clip.depth.source
    np.testing.assert_array_equal(folders.read(clip_folder, frames=(1, 2)).depth.value[0], depth[1].astype(np.float32))
    assert folders.read(clip_folder, ignore=("depth",)).depth is None


@pytest.mark.parametrize("bad", [np.nan, 0.0, -1.0, 1e-12, np.inf, -np.inf])
def test_depth_that_is_none_is_not_valid(clip_folder, bad):
    """N15: whatever a file uses for "unknown", nobody downstream sees it as a number."""
    depth = planes()
    depth[:, :6] = bad
    np.savez(clip_folder / "depth.npz", depth=depth)
    channel = folders.read(clip_folder).depth
    assert not channel.valid[:, :6].any() and channel.valid[:, 6:].all()
    assert np.isfinite(channel.value).all() and channel.value[:, :6].min() > 1 and channel.value[:, :6].max() < 9
    np.testing.assert_array_equal(channel.value[:, 6:], depth[:, 6:])


def test_one_valid_pixel_of_depth_is_enough(clip_folder):
    depth = np.zeros((T, H, W), np.float32)
    depth[1, 4, 5] = 65504
    np.savez(clip_folder / "depth.npz", depth=depth)
    channel = folders.read(clip_folder).depth
    assert channel.valid.sum() == 1 and (channel.value == 65504).all()


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 10_000), st.integers(1, 24), st.floats(0, 1))
def test_reduced_depth_is_a_value_of_its_own_pixel(seed, side, share):
    """No depth between two surfaces is made up; a pixel is valid if its centre is, and never without a valid source."""
    random = np.random.default_rng(seed)
    plane = random.uniform(1, 9, (H, W))
    valid = random.random((H, W)) < share
    size = resize.fitted((W, H), side)
    value, good = resize.nearest_valid(plane, valid, size)
    for i in range(size[1]):
        for j in range(size[0]):
            rows = slice(i * H // size[1], -(-(i + 1) * H // size[1]))
            columns = slice(j * W // size[0], -(-(j + 1) * W // size[0]))
            if good[i, j]:
                assert value[i, j] in plane[rows, columns][valid[rows, columns]]
    centres = resize.nearest(valid, size)
    assert good[centres].all()
    np.testing.assert_array_equal(value[centres], resize.nearest(plane, size)[centres])


def poses(count: int = T) -> np.ndarray:
    out = np.repeat(np.eye(4)[None], count, axis=0)
    out[:, 0, 3] = np.arange(count)
    return out


LENS = np.array([[30.0, 0, 16], [0, 40, 12], [0, 0, 1]])


@pytest.mark.parametrize("per_frame", [False, True])
def test_cameras_scale_with_the_frames(clip_folder, per_frame):
    lens = np.repeat(LENS[None], T, axis=0) if per_frame else LENS
    np.savez(clip_folder / "cameras.npz", K=lens, world_to_camera=poses(), world_up=[0, 0, 2.0])
    clip = folders.read(clip_folder, short_side=12, frames=(1, None))
    view = clip.cameras.value.view(0)
    assert (view.fx, view.fy, view.cx, view.cy, view.width, view.height) == (15, 20, 8, 6, 16, 12)
    assert view.world_to_camera[0, 3] == 1 and clip.cameras.valid.tolist() == [True, True]
    assert clip.world_up.tolist() == [0, 0, 1]


def test_up_is_by_default_minus_y_of_the_first_camera(clip_folder):
    turned = poses()
    turned[:, :3, :3] = [[1, 0, 0], [0, 0, -1], [0, 1, 0]]  # camera y is world minus z
    np.savez(clip_folder / "cameras.npz", K=LENS, world_to_camera=turned)
    assert folders.read(clip_folder, frames=(2, 3)).world_up.tolist() == [0, 0, 1]


def test_megasam_output(clip_folder):
    """Half size, camera to world; depth and cameras come from the one file in MegaSAM_Outputs."""
    (clip_folder / "MegaSAM_Outputs").mkdir()
    back = poses()
    np.savez(clip_folder / "MegaSAM_Outputs" / "clip_sgd_cvd_hr.npz", depths=planes()[:, ::2, ::2].astype(np.float16),
             intrinsic=LENS, cam_c2w=back, images=np.zeros((T, 12, 16, 3), np.uint8))  # fmt: skip
    clip = folders.read(clip_folder)
    assert clip.depth.value.shape == (T, H, W)
    np.testing.assert_array_equal(clip.depth.value[:, ::2, ::2], planes()[:, ::2, ::2].astype(np.float16))
    np.testing.assert_allclose(clip.cameras.value.K[0], LENS * [[2], [2], [1]])
    np.testing.assert_allclose(clip.cameras.value.world_to_camera @ back, np.repeat(np.eye(4)[None], T, axis=0))
    assert folders.read(clip_folder, ignore=("cameras",)).cameras is None


@pytest.mark.parametrize("rows", [T - 1, T])
@pytest.mark.parametrize("trust", [None, "valid", "confidence"])
def test_flow_scales_in_value_and_size(clip_folder, rows, trust):
    flow = np.random.default_rng(0).uniform(-4, 4, (rows, H, W, 2)).astype(np.float16)
    sure = np.random.default_rng(1).random((rows, H, W)) < 0.7
    extra = {} if trust is None else {trust: sure if trust == "valid" else sure * np.uint8(255)}
    np.savez(clip_folder / "flow.npz", flow=flow, **extra)
    clip = folders.read(clip_folder, short_side=6)
    assert clip.flow.value.shape == (T, 6, 8, 2) and clip.flow.value.dtype == np.float32
    assert not clip.flow.valid[-1].any()
    good = sure[: T - 1, 2::4, 2::4] if trust else np.ones((T - 1, 6, 8), bool)
    np.testing.assert_array_equal(clip.flow.valid[:-1], good)
    expected = np.where(good[..., None], flow[: T - 1, 2::4, 2::4].astype(np.float32) / 4, 0)
    np.testing.assert_allclose(clip.flow.value[:-1], expected, rtol=1e-6)
    part = folders.read(clip_folder, frames=(1, 2)).flow
    assert not part.valid.any()


def test_flow_that_is_no_number_is_not_valid(clip_folder):
    flow = np.zeros((T, H, W, 2), np.float32)
    flow[0, 0, :4] = [[np.nan, 0], [np.inf, 0], [1e9, 0], [0, 1000]]
    np.savez(clip_folder / "flow.npz", flow=flow)
    channel = folders.read(clip_folder).flow
    assert (~channel.valid[0]).sum() == 4 and np.isfinite(channel.value).all()


def test_tracks_in_our_keys(clip_folder):
    xy = np.array([[[1, 2], [3, 4], [5, 6]], [[7, 8], [np.nan, np.nan], [9, 9]]], np.float32)
    state = np.array([[VISIBLE, OCCLUDED, OUT_OF_VIEW], [VISIBLE, VISIBLE, NONE]], np.uint8)
    np.savez(clip_folder / "tracks.npz", xy=xy, state=state, object=[1, 2], size=[16, 12], conf=np.ones((2, T)))
    channel = folders.read(clip_folder, short_side=12, frames=(0, 2)).tracks
    tracks = channel.value
    assert tracks.size == (32, 24)  # of the source, whatever size is read
    np.testing.assert_array_equal(tracks.xy[0], [[2, 4], [6, 8]])
    assert tracks.state.tolist() == [[VISIBLE, OCCLUDED], [VISIBLE, NONE]]
    assert channel.valid.tolist() == [[True, True], [True, False]]
    assert tracks.object.tolist() == [1, 2] and tracks.conf.shape == (2, 2)


def test_tracks_without_annotation_say_nothing(clip_folder):
    """The bear's keys: NaN and frames without annotation are NONE, never "occluded"."""
    xy = np.zeros((2, T, 2), np.float32)
    xy[1, 0] = np.nan
    visible = np.array([[True, False, True], [False, True, True]])
    np.savez(clip_folder / "tracks.npz", tracks=xy, visible=visible, annotated=[True, True, False])
    tracks = folders.read(clip_folder).tracks.value
    assert tracks.state.tolist() == [[VISIBLE, OCCLUDED, NONE], [NONE, VISIBLE, NONE]]
    assert tracks.object.tolist() == [0, 0]


def test_given_tracks_take_the_place_of_the_clips_own(clip_folder, tmp_path):
    own, given = np.full((2, T, 2), 1.0, np.float32), np.full((1, T, 2), 5.0, np.float32)
    np.savez(clip_folder / "tracks.npz", xy=own, state=np.ones((2, T), np.uint8), object=[1, 2], size=[32, 24])
    np.savez(tmp_path / "a.npz", xy=given, state=np.ones((1, T), np.uint8), object=[2], size=[32, 24])
    tracks = folders.read(clip_folder, tracks=tmp_path / "a.npz").tracks.value
    assert tracks.object.tolist() == [2] and (tracks.xy == 5.0).all()
    plain = folders.read(clip_folder / "JPEGImages" / "clip", tracks=tmp_path / "a.npz")  # a folder without channels
    assert plain.tracks.value.object.tolist() == [2]


def test_painted_background(clip_folder):
    plate = np.full((H, W, 3), 77, np.uint8)
    put_image(clip_folder / "InpaintedBackgrounds" / "00000.png", plate)
    clip = folders.read(clip_folder, short_side=12)
    assert clip.background.value.shape == (12, 16, 3) and (clip.background.value == 77).all()
    assert clip.background.given and folders.read(clip_folder, ignore=("background",)).background is None


def test_npz_rows_are_read_one_at_a_time(tmp_path):
    import tracemalloc

    array = np.arange(64 * 200 * 200, dtype=np.float32).reshape(64, 200, 200)
    np.savez_compressed(tmp_path / "a.npz", plain=array, fortran=np.asfortranarray(array[:4]))
    file = npz.open_npz(tmp_path / "a.npz")
    tracemalloc.start()
    total = sum(float(row[0, 0]) for row in file.rows("plain", 10, 60))
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert total == array[10:60, 0, 0].sum() and peak < 1_000_000
    np.testing.assert_array_equal(list(file.rows("fortran", 1, 3)), array[1:3])
    np.testing.assert_array_equal(file.array("fortran"), array[:4])


def test_ignoring_a_broken_channel_works(clip_folder):
    """Who cannot use a file can leave it out."""
    (clip_folder / "depth.npz").write_bytes(b"junk")
    with pytest.raises(GenmojoError):
        folders.read(clip_folder)
    assert folders.read(clip_folder, ignore=("depth",)).depth is None


@pytest.mark.clips
def test_shared_cameras_and_depth_agree_with_true_tracks():
    """Blender: a visible track's world point, projected, is where the track says, at the depth the depth says."""
    folder = shared_clip("blender-trio")
    clip = folders.read(folder)
    truth = np.load(folder / "truth.npz")
    for p, t in zip(*np.nonzero(truth["visible"][:, ::6]), strict=True):
        view = clip.cameras.value.view(6 * t)
        local = view.world_to_camera @ np.append(truth["track_xyz"][p, 6 * t], 1)
        x, y = (view.K @ local[:3])[:2] / local[2]
        assert np.allclose((x, y), truth["tracks"][p, 6 * t], atol=0.02)
        if clip.masks.value[6 * t, int(y), int(x)] == truth["track_object"][p]:
            assert abs(clip.depth.value[6 * t, int(y), int(x)] - local[2]) < 0.25
