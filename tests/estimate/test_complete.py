"""A clip in, a clip with every channel out: nothing given is changed, nothing missing stays, guesses are told."""

import numpy as np
import pytest
from clip_files import shared_clip
from estimate_pictures import clip_of, squares, texture

from genmojo_core.clip import folders
from genmojo_core.clip.cameras import Cameras, check_cameras
from genmojo_core.clip.clip import Channel
from genmojo_core.errors import GenmojoError
from genmojo_core.estimate.complete import Box, Models, background_region, complete
from genmojo_core.estimate.models import DepthPrediction

NAMES = ("masks", "flow", "cameras", "depth", "background", "background_depth")


def check(clip):
    t, h, w = clip.frames.shape[:3]
    shapes = {"masks": (t, h, w), "flow": (t, h, w, 2), "depth": (t, h, w), "background": (h, w, 3),
              "background_depth": (h, w)}  # fmt: skip
    for name in NAMES:
        channel = getattr(clip, name)
        assert channel.source.startswith(("given", "estimated")), name
        if name in shapes:
            assert channel.value.shape == shapes[name] and np.isfinite(channel.value).all(), name
            assert channel.valid.shape == shapes[name][: channel.valid.ndim] and channel.valid.dtype == bool
    check_cameras(clip.cameras.value, t, "made")
    assert clip.cameras.value.size == clip.size and (clip.depth.value > 0).all()


def test_everything_missing_is_estimated_and_told():
    frames, labels, background = squares()
    done = complete(clip_of(frames, labels))
    check(done)
    assert not any(getattr(done, name).given for name in NAMES if name != "masks")
    assert any("depth is a guess" in s and "order, not a measure" in s for s in done.guesses)
    assert any("stand still" in s for s in done.guesses)
    assert np.array_equal(done.cameras.value.world_to_camera[0], np.eye(4)) and done.world_up.tolist() == [0, -1, 0]
    assert np.abs(done.background.value.astype(int) - background)[done.background.valid].mean() < 1


def test_what_is_given_stays():
    frames, labels, _ = squares(count=4)
    depth = np.where(labels == 1, 2.0, 5.0).astype(np.float32)
    lens = np.array([[90.0, 0, 48], [0, 90, 48], [0, 0, 1]])
    rig = Cameras(np.tile(lens, (4, 1, 1)), np.tile(np.eye(4), (4, 1, 1)), (96, 96))
    clip = clip_of(
        frames,
        labels,
        depth=Channel(depth, np.ones(depth.shape, bool), "given: depth.npz"),
        cameras=Channel(rig, np.ones(4, bool), "given: cameras.npz"),
    )
    done = complete(clip)
    check(done)
    assert np.array_equal(done.depth.value, depth) and done.cameras.value is rig and done.depth.given
    assert np.allclose(done.background_depth.value, 5.0)
    assert not any("depth" in s or "camera" in s for s in done.guesses)


@pytest.mark.parametrize("count", [1, 2])
def test_stills_and_pairs(count):
    frames, labels, _ = squares(count=count)
    done = complete(clip_of(frames, labels))
    check(done)
    assert not done.flow.valid[-1].any()


@pytest.mark.parametrize("case", ["pixel", "one frame only", "whole frame", "touches every border"])
def test_odd_masks(case):
    frames, labels, _ = squares(count=3)
    labels[:] = 0
    if case == "pixel":
        labels[:, 50, 50] = 1
    elif case == "one frame only":
        labels[1, 20:40, 20:40] = 1
    elif case == "whole frame":
        labels[:] = 1
    else:
        labels[:, :, 40:50] = labels[:, 40:50, :] = 1
    check(complete(clip_of(frames, labels)))


def test_tiny_frames():
    frames = texture(6, 9)[None].repeat(3, axis=0)
    labels = np.zeros((3, 6, 9), np.uint8)
    labels[:, 2:4, 3:5] = 1
    check(complete(clip_of(frames, labels)))


def test_empty_masks_and_no_box_are_refused():
    frames, labels, _ = squares(count=2)
    with pytest.raises(GenmojoError) as fault:
        complete(clip_of(frames, labels * 0))
    assert fault.value.code == "empty"


def test_depth_without_a_valid_value_is_refused():
    frames, labels, _ = squares(count=2)
    nothing = Channel(np.zeros(labels.shape, np.float32), np.zeros(labels.shape, bool), "given: depth.npz")
    with pytest.raises(GenmojoError) as fault:
        complete(clip_of(frames, labels, depth=nothing))
    assert fault.value.code == "empty"


def test_a_box_makes_the_object():
    frames, labels, _ = squares(count=4)
    done = complete(clip_of(frames), boxes=[Box(0, 2, 34, 30, 62)])
    check(done)
    assert done.objects == 1 and any("masks are a guess" in s for s in done.guesses)
    assert ((done.masks.value == 1) & (labels == 1)).sum() > 0.6 * (labels == 1).sum()


def test_progress_rises_to_one():
    frames, labels, _ = squares(count=3)
    heard = []
    complete(clip_of(frames, labels), progress=lambda stage, share: heard.append((stage, share)))
    shares = [share for _, share in heard]
    assert shares == sorted(shares) and shares[-1] == 1.0 and {"flow", "depth", "background"} <= {s for s, _ in heard}


def test_a_model_s_disparity_is_aligned_to_the_depth_that_is_given():
    frames, labels, _ = squares(count=3)
    truth = np.where(labels == 1, 2.0, 6.0).astype(np.float32) + np.linspace(0, 2, 96, dtype=np.float32)

    class Fake:
        def predict(self, clip):
            return DepthPrediction(0.4 / truth + 0.3, np.ones(truth.shape, bool), "disparity", "a fake")

    valid = np.zeros(truth.shape, bool)
    valid[:, ::2] = True
    given = Channel(np.where(valid, truth, 1).astype(np.float32), valid, "given: half")
    done = complete(clip_of(frames, labels, depth=given), models=Models(depth=Fake()))
    check(done)
    assert np.abs(done.depth.value / truth - 1).max() < 0.01 and done.depth.valid.all()
    alone = complete(clip_of(frames, labels), models=Models(depth=Fake()))
    check(alone)
    assert any("a fake" in s for s in alone.guesses) and "a fake" in alone.depth.source
    assert np.median(alone.depth.value[labels == 1]) < np.median(alone.depth.value[labels == 0])


def test_the_background_region_keeps_off_objects_and_void():
    frames, labels, _ = squares(count=1)
    clip = clip_of(frames, labels)
    void = np.ones(labels.shape, bool)
    void[0, :10] = False
    free = background_region(clip.with_channels(masks=Channel(labels, void, "given: test")))
    assert not free[0, :11].any() and not free[labels > 0].any() and free[0, 80:].all()


@pytest.mark.clips
@pytest.mark.parametrize("name, still", [("crossing", True), ("blender-cross", True)])
def test_still_cameras_of_real_clips(name, still):
    clip = folders.read(shared_clip(name), short_side=128, ignore=("depth", "cameras"))
    assert ("stand still" in " ".join(complete(clip).guesses)) is still


@pytest.mark.slow
@pytest.mark.clips
def test_moving_camera_and_order_of_a_clip_with_truth():
    path = shared_clip("blender-trio")
    truth = folders.read(path, short_side=192)
    done = complete(folders.read(path, short_side=192, ignore=("depth", "cameras")))
    check(done)
    poses = truth.cameras.value.world_to_camera
    relative = poses @ np.linalg.inv(poses[0])
    cosine = [
        np.trace(a[:3, :3] @ b[:3, :3].T) for a, b in zip(done.cameras.value.world_to_camera, relative, strict=True)
    ]
    assert np.rad2deg(np.arccos(np.clip((np.array(cosine) - 1) / 2, -1, 1))).max() < 6
    right = []
    for t in range(len(done)):
        seen = [k for k in range(3) if done.object_mask(k)[t].any()]
        own, true = ([np.median(c.depth.value[t][done.object_mask(k)[t]]) for k in seen] for c in (done, truth))
        right.append((np.argsort(own) == np.argsort(true)).all())
    assert np.mean(right) > 0.5
