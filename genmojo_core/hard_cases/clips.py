"""Hostile clips: a tiny procedural clip with exact depth and cameras, and ways to spoil it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from genmojo_core.clip.cameras import Cameras
from genmojo_core.clip.clip import Channel, Clip
from genmojo_core.clip.synthetic import generate
from genmojo_core.clip.synthetic_specs import BALL, CUBE, SyntheticSpec

Vector = tuple[float, float, float]


def plain(frames: int = 5, size: tuple[int, int] = (48, 32), given: tuple[str, ...] = ("depth", "cameras")) -> Clip:
    """A ball and a cube that pass each other."""
    return generate(SyntheticSpec("hard", (BALL, CUBE), frames, size, given=given, tracks=2, novel_every=0))[0]


def colliding() -> Clip:
    """Two balls that go through the same place at the same time."""
    other = replace(BALL, path=(BALL.path[1], BALL.path[0]), colours=((0.1, 0.3, 0.8), (0.6, 0.8, 0.9)))
    return generate(SyntheticSpec("colliding", (BALL, other), 5, (48, 32), tracks=2, novel_every=0))[0]


def painted(clip: Clip, value: int) -> Clip:
    """Every frame in one grey."""
    return replace(clip, frames=np.full_like(clip.frames, value))


def noisy(clip: Clip, seed: int = 0) -> Clip:
    """Every pixel at random, so that no flow holds."""
    frames = np.random.default_rng(seed).integers(0, 256, clip.frames.shape)
    return replace(clip, frames=frames.astype(np.uint8))


def frozen(clip: Clip) -> Clip:
    """Its first frame over and over."""
    first = {name: _first(getattr(clip, name)) for name in ("masks", "depth")}
    return clip.with_channels(frames=np.repeat(clip.frames[:1], len(clip), axis=0), **first)


def masked(clip: Clip, object_masks: dict[int, np.ndarray]) -> Clip:
    """Other masks: object index -> (T, H, W) bool, later objects over earlier ones; objects left out stay."""
    masks = clip.masks.value.copy()
    for k in object_masks:
        masks[masks == k + 1] = 0
    for k, mask in sorted(object_masks.items()):
        masks[mask] = k + 1
    return clip.with_channels(masks=replace(clip.masks, value=masks))


def without(clip: Clip, k: int, frames: slice) -> Clip:
    """Object k is in no mask of some frames."""
    mask = clip.object_mask(k).copy()
    mask[frames] = False
    return masked(clip, {k: mask})


def deep(clip: Clip, factor: float) -> Clip:
    """Depth wrong by a factor, cameras as they are."""
    return clip.with_channels(depth=replace(clip.depth, value=clip.depth.value * np.float32(factor)))


def partly_deep(clip: Clip, valid: np.ndarray, filler: float) -> Clip:
    """Depth known only where `valid` (T, H, W) says so; the rest holds a number that nobody may read."""
    value = np.where(valid, clip.depth.value, np.float32(filler)).astype(np.float32)
    return clip.with_channels(depth=Channel(value, valid & clip.depth.valid, clip.depth.source))


def moved_world(clip: Clip, shift: Vector) -> Clip:
    """The same pictures in world coordinates with another origin."""
    return _posed(clip, _shift(shift))


def turned_away(clip: Clip, frames: slice) -> Clip:
    """Cameras of some frames look the other way: whatever the other frames saw lies behind them."""
    cameras = clip.cameras.value
    poses = cameras.world_to_camera.copy()
    poses[frames] = np.diag([-1.0, 1.0, -1.0, 1.0]) @ poses[frames]
    return clip.with_channels(cameras=replace(clip.cameras, value=replace(cameras, world_to_camera=poses)))


def _shift(by: Vector) -> np.ndarray:
    matrix = np.eye(4)
    matrix[:3, 3] = by
    return matrix


def _posed(clip: Clip, moved: np.ndarray) -> Clip:
    """World coordinates x' = moved x."""
    cameras: Cameras = clip.cameras.value
    poses = cameras.world_to_camera @ np.linalg.inv(moved)
    return clip.with_channels(cameras=replace(clip.cameras, value=replace(cameras, world_to_camera=poses)))


def _first(channel: Channel) -> Channel:
    """The first frame's values in every frame."""
    count = len(channel.value)
    return replace(channel, value=np.repeat(channel.value[:1], count, axis=0),
                   valid=np.repeat(channel.valid[:1], count, axis=0))  # fmt: skip
