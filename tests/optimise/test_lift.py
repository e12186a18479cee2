"""Static lift: parts hidden in the canonical frame come from other frames, but only where the frames agree."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import torch

from genmojo_core.clip.cameras import Cameras
from genmojo_core.clip.clip import Channel, Clip
from genmojo_core.optimise.lift import object_points
from genmojo_core.scene.background import never_shown
from genmojo_core.scene.initialise import project
from tests.optimise.small_runs import small_clip, small_run

SIZE, FRAMES, FOCAL = 48, 8, 60.0


@dataclass(frozen=True)
class Known:
    """A motion that is known."""

    ref_frame: int
    pose: np.ndarray
    confidence: np.ndarray
    bend: None = None
    depth: None = None


def sliding_square() -> tuple[Clip, Known]:
    """A square 20 px wide at depth 2 that moves 2 px a frame; in frame 0 its left half lies behind another object."""
    masks = np.zeros((FRAMES, SIZE, SIZE), np.uint8)
    pose = np.tile(np.eye(4), (FRAMES, 1, 1))
    for t in range(FRAMES):
        masks[t, 14:34, 6 + 2 * t : 26 + 2 * t] = 1
        pose[t, 0, 3] = 2 * t * 2.0 / FOCAL
    masks[0, 14:34, 6:16] = 2
    frames = np.random.default_rng(0).integers(0, 255, (FRAMES, SIZE, SIZE, 3), dtype=np.uint8)
    lens = np.array([[FOCAL, 0, SIZE / 2], [0, FOCAL, SIZE / 2], [0, 0, 1.0]])
    cameras = Cameras(np.tile(lens, (FRAMES, 1, 1)), np.tile(np.eye(4), (FRAMES, 1, 1)), (SIZE, SIZE))
    everywhere = np.ones(masks.shape, bool)
    clip = Clip(
        name="square", path="square", frames=frames, frame_index=np.arange(FRAMES), seconds=np.arange(FRAMES) / 10,
        source_names=tuple(map(str, range(FRAMES))), source_size=(SIZE, SIZE), object_ids=np.array([1, 2]),
        object_names=("square", "screen"),
        masks=Channel(masks, everywhere, "given: test"), cameras=Channel(cameras, np.ones(FRAMES, bool), "given: test"),
        depth=Channel(np.full(masks.shape, 2.0, np.float32), everywhere, "given: test"),
    )  # fmt: skip
    return clip, Known(0, pose, np.ones(FRAMES))


def columns(xyz: np.ndarray) -> np.ndarray:
    """Image columns of points in frame 0."""
    return xyz[:, 0] / xyz[:, 2] * FOCAL + SIZE / 2


def test_a_part_hidden_in_the_canonical_frame_comes_from_frames_that_show_it() -> None:
    clip, motion = sliding_square()
    found = columns(object_points(clip, 0, motion, 400).xyz)
    assert found.min() < 8 and found.max() > 24
    assert (found > 5.5).all() and (found < 26.5).all()


def test_a_frame_with_a_wrong_pose_brings_nothing_in() -> None:
    clip, motion = sliding_square()
    pose = motion.pose.copy()
    pose[5, 1, 3] += 14 * 2.0 / FOCAL  # the object is believed 14 px lower than it is
    points = object_points(clip, 0, replace(motion, pose=pose), 400).xyz
    rows = points[:, 1] / points[:, 2] * FOCAL + SIZE / 2
    assert rows.min() > 11 and rows.max() < 37
    assert columns(points).min() < 8


def test_what_objects_hide_in_every_frame_is_never_shown() -> None:
    clip, _ = sliding_square()
    y, x = np.mgrid[2:46:4, 2:46:4]
    wall = np.stack([(x - SIZE / 2) * 5 / FOCAL, (y - SIZE / 2) * 5 / FOCAL, np.full(x.shape, 5.0)], axis=-1)
    hidden = never_shown(wall.reshape(-1, 3), clip).reshape(x.shape)
    always = (clip.masks.value > 0).all(axis=0)
    assert 0 < hidden.sum() < hidden.size and (hidden == always[y, x]).all()


def test_background_that_no_frame_shows_keeps_its_painted_colours() -> None:
    clip = small_clip()
    masks = clip.masks.value.copy()
    masks[:, 10:30, 30:50] = 1  # an object that stands before the wall all the time
    run = small_run(clip.with_channels(masks=replace(clip.masks, value=masks)), lift_steps=2, joint_steps=2)
    for event in run:
        if type(event).__name__ == "StageStarted" and event.stage == "background":
            before = {name: p.detach().clone() for name, p in run.scene.background.named_parameters()}
    g = run.scene.background
    column, row = project(g.means.double().numpy(), clip.cameras.value.view(0))[0].T
    inner = torch.from_numpy((column > 31) & (column < 49) & (row > 11) & (row < 29))
    assert inner.any() and g.invented[inner].all() and not g.invented.all()
    for name in ("dc", "logit_opacities", "quats"):  # it may be moved back behind the objects and grow with it
        assert torch.equal(getattr(g, name)[g.invented], before[name][g.invented])
    assert not torch.equal(g.dc[~g.invented], before["dc"][~g.invented])
