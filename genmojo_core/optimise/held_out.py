"""Frames held out of a run: in no loss, not followed, no start for Gaussians; they are only rendered and compared.

To the run the objects are hidden there and nothing is known, as for void masks, so motion runs through them as it does
through an occlusion (`--held-out-every`, `genmojo tradeoff`).
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import torch

from genmojo_core.clip.clip import Channel, Clip
from genmojo_core.optimise.objective import Objective

MIDDLE = 0.5  # of the interval: which of the frames is held out


def held_frames(frames: int, every: int) -> tuple[int, ...]:
    """One frame of every `every`, in the middle of each; never the first or last, none for 0 or a clip of under 3."""
    if every < 2 or frames < 3:
        return ()
    return tuple(t for t in range(int(every * MIDDLE), frames - 1, every) if t > 0)


def without(clip: Clip, held: tuple[int, ...]) -> Clip:
    """The clip as a run may see it: pixels of its neighbours' mean, masks void, no depth, no flow there or thither."""
    if not held or clip.masks is None:
        return clip
    rows = np.array(held)
    frames = clip.frames.copy()
    for t in held:
        frames[t] = np.round((clip.frames[t - 1].astype(np.float32) + clip.frames[t + 1]) / 2).astype(np.uint8)
    masks = _unknown(clip.masks, rows)
    masks.value[rows] = 0
    changes: dict[str, Channel | None] = {"masks": masks}
    if clip.depth is not None:
        changes["depth"] = _unknown(clip.depth, rows)
    if clip.flow is not None:
        touched = np.union1d(rows, rows - 1)
        changes["flow"] = _unknown(clip.flow, touched[touched < len(clip.flow.value)])
    return replace(clip.with_channels(**changes), frames=frames)


def held_frame_psnr(objective: Objective, clip: Clip, held: tuple[int, ...], deform: bool) -> float:
    """PSNR in dB over the foreground of the held-out frames of the whole clip, as the scene stands; 0 without any."""
    error, count = 0.0, 0
    with torch.no_grad():
        for t in held:
            inside = (clip.masks.value[t] > 0) & clip.masks.valid[t]
            if not inside.any():
                continue
            drawn = objective.picture(t, deform).numpy()
            error += float(((drawn - clip.frames[t].astype(np.float32) / 255.0)[inside] ** 2).sum()) / 3
            count += int(inside.sum())
    return -10.0 * math.log10(max(error / count, 1e-10)) if count else 0.0


def _unknown(channel: Channel, rows: np.ndarray) -> Channel:
    """A copy of a channel that says nothing in some frames."""
    valid = channel.valid.copy()
    valid[rows] = False
    return replace(channel, value=channel.value.copy(), valid=valid)
