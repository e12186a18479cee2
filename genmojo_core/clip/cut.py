"""Some frames of a clip on their own, every channel cut alike."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from genmojo_core.clip.clip import Clip


def cut(clip: Clip, first: int, count: int) -> Clip:
    """Frames first to first + count - 1 of a clip, as `picked`."""
    return picked(clip, range(first, first + count))


def picked(clip: Clip, places: Sequence[int]) -> Clip:
    """The frames at some places (rising), without tracks of its own; the background plate stays.

    The plate's frame becomes the nearest one that is kept. Flow goes from a frame to the next: where frames are left
    out in between there is none, and it is to be estimated anew.
    """
    part = np.asarray(places, np.int64)
    plate = int(np.argmin(np.abs(part - clip.background_frame)))
    changes: dict[str, Any] = {"tracks": None, "background_frame": plate}
    for name in ("masks", "depth", "flow"):
        channel = getattr(clip, name)
        if channel is not None:
            changes[name] = replace(channel, value=channel.value[part], valid=channel.valid[part])
    if clip.flow is not None and (np.diff(part) == 1).all():
        changes["flow"].valid[-1] = False
    else:
        changes["flow"] = None
    if clip.cameras is not None:
        cameras = clip.cameras.value
        kept = replace(cameras, K=cameras.K[part], world_to_camera=cameras.world_to_camera[part])
        changes["cameras"] = replace(clip.cameras, value=kept, valid=clip.cameras.valid[part])
    return replace(clip.with_channels(**changes), frames=clip.frames[part], frame_index=clip.frame_index[part],
                   seconds=clip.seconds[part], source_names=tuple(clip.source_names[i] for i in part))  # fmt: skip
