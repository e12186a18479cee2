"""A clip with every channel present: what was given stays, what is missing is estimated and said to be a guess."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import cv2
import numpy as np

from genmojo_core.clip.clip import Channel, Clip
from genmojo_core.errors import GenmojoError
from genmojo_core.estimate import background, cameras, depth, flow, order

Progress = Callable[[str, float], None]


def complete(clip: Clip, *, boxes: Sequence = (), progress: Progress | None = None, models: object = None) -> Clip:
    """The clip with masks, flow, cameras, depth, background and its depth, each marked given or estimated.

    Args:
        clip: frames and whatever is known about them.
        boxes: where objects are, for clips without masks.
        progress: hears the stage's name and a share 0..1 of the whole.
        models: optional external models that replace embedded estimators.
    Raises:
        GenmojoError("empty"): no object is visible in any frame.
    """
    tell = progress or _silent
    clip = _with_objects(clip)
    tell("flow", 0.1)
    clip = _with_flow(clip)
    free = background_region(clip)
    tell("cameras", 0.5)
    clip = _with_cameras(clip, free)
    tell("depth", 0.6)
    clip = _with_depth(clip, free)
    tell("background", 0.8)
    clip = _with_background(clip, free)
    tell("done", 1.0)
    return clip


def background_region(clip: Clip, share: float = 0.02) -> np.ndarray:  # (T, H, W) bool
    """Pixels surely not of an object: outside the masks grown by a share of the short side, and not void."""
    labels = clip.masks.value if clip.masks is not None else np.zeros(clip.frames.shape[:3], np.uint8)
    valid = clip.masks.valid if clip.masks is not None else np.ones(clip.frames.shape[:3], bool)
    radius = max(1, round(share * min(clip.size)))
    kernel = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * radius + 1, 2 * radius + 1))
    taken = (labels > 0) | ~valid
    return np.stack([cv2.dilate(frame.astype(np.uint8), kernel) == 0 for frame in taken])


def _silent(stage: str, share: float) -> None:
    """Progress that nobody hears."""


def _with_objects(clip: Clip) -> Clip:
    """The clip itself, or GenmojoError("empty") when it shows no object."""
    if clip.masks is None or not (clip.masks.value[clip.masks.valid] > 0).any():
        raise GenmojoError("empty", "no object is visible in any frame", clip.path, "give masks or a box")
    return clip


def _with_flow(clip: Clip) -> Clip:
    """Flow t to t + 1, estimated where it was not given."""
    if clip.flow is not None:
        return clip
    found = flow.sequence_flow(clip.frames)
    return clip.with_channels(flow=Channel(found.forward, found.forward_valid, f"estimated: {flow.METHOD}"))


def _with_cameras(clip: Clip, free: np.ndarray) -> Clip:
    """Cameras of all frames, estimated where they were not given."""
    if clip.cameras is not None:
        return clip
    given = (None, None) if clip.depth is None else (clip.depth.value, clip.depth.valid)
    found = cameras.estimate_cameras(clip.frames, free, cameras.default_intrinsics(clip), *given)
    channel = Channel(found.cameras, found.valid, f"estimated: {found.kind} camera from background features")
    return clip.with_channels(
        cameras=channel,
        world_up=np.array([0.0, -1.0, 0.0]),
        guesses=(*clip.guesses, f"the camera is a guess: {found.kind}, {cameras.FOVY} degrees high"),
    )


def _with_depth(clip: Clip, free: np.ndarray) -> Clip:
    """Depth of every pixel and of the plate."""
    labels = np.where(clip.masks.valid, clip.masks.value, 0)
    rig = clip.cameras.value
    if clip.depth is not None:
        clean = depth.clean_depth(clip.depth.value, clip.depth.valid, labels)
        clip = clip.with_channels(depth=Channel(clean, clip.depth.valid, clip.depth.source))
        plate, seen = background.plate_depth(clean, clip.depth.valid, free, rig, clip.background_frame)
        return clip.with_channels(background_depth=Channel(plate, seen, "estimated: median of the given depth"))
    votes = order.front_votes(labels, clip.objects, clip.flow.value)
    guess, plate = depth.guess_depth(labels, clip.objects, rig, votes, clip.background_frame)
    source = f"estimated: {depth.METHOD}"
    return clip.with_channels(
        depth=Channel(guess, np.ones(guess.shape, bool), source),
        background_depth=Channel(plate, np.ones(plate.shape, bool), source),
        guesses=(
            *clip.guesses,
            f"depth is a guess from {depth.METHOD}; distances between objects are an order, not a measure",
        ),
    )


def _with_background(clip: Clip, free: np.ndarray) -> Clip:
    """The plate of the background, estimated where it was not given."""
    if clip.background is not None:
        return clip
    color, seen = background.make_plate(
        clip.frames, free, clip.cameras.value, clip.background_depth.value, clip.background_frame
    )
    return clip.with_channels(background=Channel(color, seen, "estimated: median over time, painted where never seen"))
