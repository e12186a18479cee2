"""Static lift: parts hidden in the canonical frame come from other frames, but only where the frames agree."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from genmojo_core.clip.cameras import Cameras
from genmojo_core.clip.clip import Channel, Clip
from genmojo_core.optimise.lift import object_points

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
