"""A smaller copy of a clip to measure on: the same frames in time, at most so many pixels on the short side."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from genmojo_core.clip import resize
from genmojo_core.clip.clip import Channel, Clip

SHORT_SIDE = 256  # pixels: evidence in pixels is meant at this size; more would only cost time


def sample(clip: Clip, short_side: int = SHORT_SIDE) -> Clip:
    """The clip with frames, masks, depth, flow and cameras at a smaller size; the clip itself when it is that small.

    Flow is scaled to the new pixels. Other channels (background, tracks) are left as they are.
    """
    size = resize.fitted(clip.size, short_side)
    if size == clip.size:
        return clip
    small = replace(clip, frames=np.stack([resize.area(frame, size) for frame in clip.frames]))
    if clip.masks is not None:
        labels = np.stack([resize.nearest_labels(frame, size) for frame in clip.masks.value])
        small = replace(small, masks=replace(_nearest(clip.masks, size), value=labels))
    if clip.depth is not None:
        small = replace(small, depth=_nearest(clip.depth, size))
    if clip.flow is not None:
        flow = _nearest(clip.flow, size)
        scale = np.array([size[0] / clip.size[0], size[1] / clip.size[1]], np.float32)
        small = replace(small, flow=replace(flow, value=flow.value * scale))
    if clip.cameras is not None:
        small = replace(small, cameras=replace(clip.cameras, value=clip.cameras.value.resized(*size)))
    return small


def _nearest(channel: Channel, size: tuple[int, int]) -> Channel:
    """A per-pixel channel of all frames at another size."""
    value = np.stack([resize.nearest(frame, size) for frame in channel.value])
    return replace(channel, value=value, valid=np.stack([resize.nearest(frame, size) for frame in channel.valid]))
