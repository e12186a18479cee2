"""A clip with every channel present: what was given stays, what is missing is estimated and said to be a guess."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from typing import Any

import cv2
import numpy as np

from genmojo_core.clip.cameras import Cameras
from genmojo_core.clip.clip import Channel, Clip
from genmojo_core.errors import GenmojoError
from genmojo_core.estimate import background, cameras, depth, flow, order
from genmojo_core.estimate.depth_align import fit_alignment, floor_alignment, steady
from genmojo_core.estimate.depth_jitter import without_jitter
from genmojo_core.estimate.masks import Box, Prompt, Scribble
from genmojo_core.estimate.models import DepthPrediction, Models
from genmojo_core.estimate.objects import with_objects
from genmojo_core.estimate.shapes import measure_shapes
from genmojo_core.sentences import say

Progress = Callable[[str, float], None]

__all__ = ["Box", "Models", "Scribble", "background_region", "complete"]


def complete(
    clip: Clip, *, boxes: Sequence[Prompt] = (), progress: Progress | None = None, models: Models | None = None
) -> Clip:
    """The clip with masks, flow, cameras, depth, background and its depth, each marked given or estimated.

    Args:
        clip: frames and whatever is known about them.
        boxes: boxes and scribbles round objects, for clips without masks.
        progress: hears the stage's name and a share 0..1 of the whole.
        models: external models that replace embedded estimators.
    Raises GenmojoError: "empty" if no object is visible in any frame, or the given depth has no valid value;
    "argument" for a box outside the clip; "missing_package" for a model that is not there.
    """
    tell = progress or _silent
    models = models or Models()
    frames = clip.frames

    @cache
    def flows() -> flow.SequenceFlow:
        return flow.sequence_flow(frames, lambda share: tell("flow", 0.4 * share))

    clip = with_objects(clip, boxes, flows, models, lambda share: tell("masks", 0.4 + 0.2 * share))
    if clip.flow is None:
        found = flows()
        clip = clip.with_channels(flow=Channel(found.forward, found.forward_valid, f"estimated: {flow.METHOD}"))
    free = background_region(clip)
    tell("cameras", 0.6)
    prediction = models.depth.predict(clip) if models.depth else None
    clip = _with_model_depth(clip, prediction, free)
    clip, points = _with_cameras(clip, free)
    clip = without_jitter(clip, free)
    tell("depth", 0.7)
    clip = _with_depth(clip, free, points)
    tell("background", 0.85)
    clip = _with_background(clip, free)
    tell("background", 1.0)
    return clip


def background_region(clip: Clip, share: float = 0.02) -> np.ndarray:  # (T, H, W) bool
    """Pixels surely not of an object: outside the masks grown by a share of the short side, and not void."""
    masks = _channel(clip.masks, "masks")
    radius = max(1, round(share * min(clip.size)))
    kernel = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * radius + 1, 2 * radius + 1))
    taken = (masks.value > 0) | ~masks.valid
    return np.stack([cv2.dilate(frame.astype(np.uint8), kernel) == 0 for frame in taken])


def _silent(stage: str, share: float) -> None:
    """Progress that nobody hears."""


def _channel(channel: Channel | None, name: str) -> Channel:
    """A channel that an earlier stage has made sure of."""
    if channel is None:
        raise ValueError(f"the stage that makes {name} has not run")
    return channel


def _labels(clip: Clip) -> np.ndarray:  # (T, H, W) uint8
    """Labels with void pixels taken for background."""
    masks = _channel(clip.masks, "masks")
    return np.where(masks.valid, masks.value, 0)


def _told(clip: Clip, *sentences: str, **channels: Any) -> Clip:
    """The clip with channels replaced and guesses told."""
    return clip.with_channels(guesses=(*clip.guesses, *sentences), **channels)


def _with_model_depth(clip: Clip, prediction: DepthPrediction | None, free: np.ndarray) -> Clip:
    """Depth from a model, where the clip's own does not hold; disparity is aligned first (METHOD.md 11.6)."""
    own = clip.depth
    if own is not None and not own.valid.any():
        raise GenmojoError("empty", "the depth holds no valid value", clip.path, "take it away or --ignore depth")
    if prediction is None:
        return clip
    value, source, valid = prediction.value, f"estimated: {prediction.source}", prediction.valid
    key = "depth_from"
    if prediction.kind == "disparity":
        fitted = None if own is None else fit_alignment(value, own.value, own.valid & valid)
        if fitted is None:
            value = steady(value, free)
            key = "depth_order_from"
        value = (fitted or floor_alignment(value[valid])).depth(value)
    if own is None:
        return _told(clip, say(key, source=prediction.source), depth=Channel(value, valid, source))
    merged = np.where(own.valid, own.value, value).astype(np.float32)
    return clip.with_channels(depth=Channel(merged, own.valid | valid, f"{own.source}; gaps from {prediction.source}"))


def _with_cameras(clip: Clip, free: np.ndarray) -> tuple[Clip, np.ndarray]:
    """Cameras of all frames, estimated where they were not given, and the background points (N, 3) this gave."""
    if clip.cameras is not None:
        return clip, np.zeros((0, 3))
    lens = cameras.default_intrinsics(clip)
    found = cameras.estimate_cameras(clip.frames, free, lens, _believed(clip, lens))
    told = _told(
        clip,
        say(f"camera_{found.kind}", degrees=_fovy(found.cameras)),
        cameras=Channel(found.cameras, found.valid, f"estimated: {found.kind} camera from background points"),
        world_up=np.array([0.0, -1.0, 0.0]),
    )
    return told, found.points


def _believed(clip: Clip, lens: np.ndarray) -> cameras.Believed:
    """Depth as known before the cameras: the clip's, or a guessed stage in every frame."""
    if clip.depth is not None:
        return cameras.Believed(clip.depth.value, clip.depth.valid)
    count = len(clip)
    first = Cameras(np.tile(lens, (count, 1, 1)), np.tile(np.eye(4), (count, 1, 1)), clip.size)
    stage = depth.guess_stage(measure_shapes(_labels(clip), clip.objects, clip.held_pixel_aspect), first)
    plane = stage.depth(first.view(0))
    return cameras.Believed(np.broadcast_to(plane, clip.frames.shape[:3]), np.zeros(clip.frames.shape[:3], bool))


def _fovy(rig: Cameras) -> float:
    """Vertical field of view in degrees of camera 0."""
    return float(np.rad2deg(2 * np.arctan(0.5 * rig.size[1] / rig.K[0, 1, 1])))


def _with_depth(clip: Clip, free: np.ndarray, points: np.ndarray) -> Clip:
    """Depth of every pixel and of the plate."""
    labels, rig = _labels(clip), _rig(clip)
    if clip.depth is not None:
        clean = depth.clean_depth(clip.depth.value, clip.depth.valid, labels)
        clip = clip.with_channels(depth=Channel(clean, clip.depth.valid, clip.depth.source))
        if clip.background_depth is not None:
            return clip
        plate, seen = background.plate_depth(clean, clip.depth.valid, free, rig, clip.background_frame)
        return clip.with_channels(
            background_depth=Channel(plate, seen, "estimated: median depth outside the masks, filled behind objects")
        )
    votes = order.front_votes(labels, clip.objects, _channel(clip.flow, "flow").value)
    guess, plate = depth.guess_depth(labels, clip.objects, rig, votes, clip.background_frame, points)
    source = f"estimated: {depth.METHOD}"
    return _told(
        clip,
        say("depth_guess", method=depth.METHOD),
        depth=Channel(guess, np.ones(guess.shape, bool), source),
        background_depth=clip.background_depth or Channel(plate, np.ones(plate.shape, bool), source),
    )


def _with_background(clip: Clip, free: np.ndarray) -> Clip:
    """The plate of the background, estimated where it was not given."""
    if clip.background is not None:
        return clip
    plate_depth = _channel(clip.background_depth, "background depth").value
    color, seen = background.make_plate(clip.frames, free, _rig(clip), plate_depth, clip.background_frame)
    clip = clip.with_channels(background=Channel(color, seen, "estimated: median over time, painted where never seen"))
    painted = 1.0 - float(seen.mean())
    if painted < 0.001:
        return clip
    return _told(clip, say("painted", share=painted))


def _rig(clip: Clip) -> Cameras:
    """The clip's cameras at the size of its frames."""
    rig: Cameras = _channel(clip.cameras, "cameras").value
    return rig
