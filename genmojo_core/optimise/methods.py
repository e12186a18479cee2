"""Other methods as configurations of this engine: what each lacks, so that differences come from the idea alone.

They are not the authors' programs: losses, schedules and rasteriser are ours throughout.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from genmojo_core.clip.clip import Clip
from genmojo_core.config import METHODS
from genmojo_core.errors import GenmojoError


@dataclass(frozen=True)
class Method:
    """A method: effects that it lacks, whether it takes all objects for one, and a sentence about it."""

    about: str
    lacks: tuple[str, ...] = field(default=())
    one_object: bool = False


TABLE: dict[str, Method] = {
    "genmojo": Method("joint splatting of all objects with instance labels, a prior per object, flow and tracks"),
    "dreamscene4d": Method(
        "objects are optimised one by one, each against its own mask, and put together by depth",
        ("joint_occlusion", "instance_labels", "depth_order", "track_supervision"),
    ),
    "dreamgaussian4d": Method(
        "everything that moves is one object with one prior; no flow, no tracks",
        ("flow", "track_supervision", "instance_labels", "depth_order"), True,
    ),
    "shape-of-motion": Method(
        "one joint scene driven by tracks and depth; no prior for unseen sides, no instance labels",
        ("unseen_views", "instance_labels", "depth_order", "flow"),
    ),
}  # fmt: skip


def prepared(clip: Clip, method: str, overrides: Mapping[str, bool] | None = None) -> tuple[Clip, dict[str, bool]]:
    """The clip and the effect overrides of a method; what the user switches on or off himself wins.

    Raises GenmojoError("argument") for a name that is none.
    """
    if method not in TABLE:
        raise GenmojoError("argument", f"there is no method '{method}'", "--method", f"use {', '.join(METHODS)}")
    chosen = TABLE[method]
    switched = dict.fromkeys(chosen.lacks, False) | dict(overrides or {})
    return (as_one(clip) if chosen.one_object else clip), switched


def as_one(clip: Clip) -> Clip:
    """The same clip with all objects taken for one."""
    if clip.masks is None or clip.objects < 2:
        return clip
    masks = replace(clip.masks, value=(clip.masks.value > 0).astype(np.uint8))
    return clip.with_channels(masks=masks, object_ids=np.array([1]), object_names=("everything",))
