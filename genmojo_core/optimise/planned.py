"""The clip as the effect plan lets the run see it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from genmojo_core.clip.cameras import Cameras
from genmojo_core.clip.clip import Clip
from genmojo_core.effects.plan import EffectPlan


def planned_clip(clip: Clip, plan: EffectPlan) -> Clip:
    """The clip itself, or with one camera for all frames where the plan says that the camera stands still."""
    if plan.on("camera_motion") or clip.cameras is None:
        return clip
    cameras: Cameras = clip.cameras.value
    still = clip.background_frame
    if (cameras.world_to_camera == cameras.world_to_camera[still]).all():
        return clip
    count = len(clip)
    one = replace(cameras, K=np.repeat(cameras.K[still : still + 1], count, axis=0),
                  world_to_camera=np.repeat(cameras.world_to_camera[still : still + 1], count, axis=0))  # fmt: skip
    return clip.with_channels(cameras=replace(clip.cameras, value=one))
