"""Some frames of a clip on their own, every channel cut alike."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from genmojo_core.clip.clip import Clip


def cut(clip: Clip, first: int, count: int) -> Clip:
    """Frames first to first + count - 1 of a clip, without tracks of its own; the background plate stays.

    The plate's frame becomes the nearest one that is kept.
    """
    part = slice(first, first + count)
    plate = min(max(clip.background_frame - first, 0), count - 1)
    changes: dict[str, Any] = {"tracks": None, "background_frame": plate}
    for name in ("masks", "depth", "flow"):
        channel = getattr(clip, name)
        if channel is not None:
            changes[name] = replace(channel, value=channel.value[part], valid=channel.valid[part].copy())
    if clip.flow is not None:
        changes["flow"].valid[-1] = False
    if clip.cameras is not None:
        cameras = clip.cameras.value
        kept = replace(cameras, K=cameras.K[part], world_to_camera=cameras.world_to_camera[part])
        changes["cameras"] = replace(clip.cameras, value=kept, valid=clip.cameras.valid[part])
    return replace(clip.with_channels(**changes), frames=clip.frames[part], frame_index=clip.frame_index[part],
                   seconds=clip.seconds[part], source_names=clip.source_names[part])  # fmt: skip
