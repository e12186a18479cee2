"""Masks of a clip's objects: as given, carried into frames that lack one, or made from boxes, scribbles or names."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from genmojo_core.clip.clip import Channel, Clip
from genmojo_core.errors import GenmojoError
from genmojo_core.estimate import masks
from genmojo_core.estimate.flow import SequenceFlow
from genmojo_core.estimate.masks import Box, Prompt
from genmojo_core.estimate.models import Models
from genmojo_core.sentences import say

_SEARCHED = (0.0, 0.5, 0.25, 0.75, 1.0)  # of the clip: frames in which names are looked for until one is found
_MOST_OBJECTS = 12  # a detector's best boxes


def with_objects(
    clip: Clip,
    prompts: Sequence[Prompt],
    flows: Callable[[], SequenceFlow],
    models: Models,
    progress: Callable[[float], None] | None = None,
) -> Clip:
    """The clip with a mask in every frame.

    Args:
        clip: with or without masks. prompts: boxes and scribbles, read only where the clip has no masks.
        flows: gives the flow of the frames when it is needed. models: a detector and a mask model, or neither.
        progress: hears a share 0..1.
    Raises GenmojoError: "empty" if no object is visible in any frame and nothing says where one is; "argument" for a
    prompt outside the clip.
    """
    if clip.masks is not None and (clip.masks.value[clip.masks.valid] > 0).any():
        if prompts:
            clip = _told(clip, say("boxes_not_used"))
        return _carried_on(clip, flows)
    source = masks.METHOD
    if not prompts and models.detector is not None and models.phrases:
        prompts, source = _detected(clip, models), f"{models.detector.name} for {', '.join(models.phrases)}"
    if not prompts:
        raise GenmojoError("empty", "no object is visible in any frame", clip.path, "give masks, or a box with --box")
    found = masks.masks_from_prompts(
        clip.frames, prompts, clip.source_size, masks.Helpers(flows(), models.masks, progress)
    )
    if models.masks is not None:
        source = f"{source}, cut by {models.masks.name}"
    return _labelled(clip, found, source)


def _labelled(clip: Clip, found: np.ndarray, source: str) -> Clip:
    """The clip with found labels (T, H, W); labels that ended without a pixel keep their place as objects."""
    used = np.unique(found[found > 0])
    if len(used) == 0:
        raise GenmojoError("empty", "no object was found where the boxes are", clip.path, "draw the box closer")
    lookup = np.zeros(256, np.uint8)
    lookup[used] = np.arange(1, len(used) + 1)
    channel = Channel(lookup[found], np.ones(found.shape, bool), f"estimated: {source}")
    clip = clip.with_channels(
        masks=channel, object_ids=used.astype(np.int64), object_names=tuple(f"object {label}" for label in used)
    )
    return _told(clip, say("masks_guess", source=source))


def _carried_on(clip: Clip, flows: Callable[[], SequenceFlow]) -> Clip:
    """Frames without any mask (MOSE's valid split gives only the first) take it from their neighbours by flow."""
    channel = clip.masks
    if channel is None:
        return clip
    lacking = ~channel.valid.any(axis=(1, 2))
    if not lacking.any():
        return clip
    known = np.flatnonzero(~lacking)
    scores = np.zeros((clip.objects, *channel.value.shape), np.float16)
    for k in range(clip.objects):
        mask = clip.object_mask(k)
        seeds = {int(t): mask[t] for t in known if mask[t].any()}
        if seeds:
            scores[k] = masks.follow(clip.frames, seeds, masks.Helpers(flows()))
    found = np.where(scores.max(axis=0) >= 0.5, scores.argmax(axis=0) + 1, 0).astype(np.uint8)
    value, valid = channel.value.copy(), channel.valid.copy()
    value[lacking], valid[lacking] = found[lacking], True
    count = int(lacking.sum())
    clip = clip.with_channels(masks=Channel(value, valid, f"{channel.source}; {count} frames carried on by flow"))
    return _told(clip, say("masks_carried", count=count, frames=len(clip)))


def _detected(clip: Clip, models: Models) -> list[Box]:
    """Boxes of the named objects in the first searched frame that shows any, in raster pixels of the source."""
    scale = np.array([clip.source_size[0] / clip.size[0], clip.source_size[1] / clip.size[1]] * 2)
    for share in _SEARCHED:
        frame = round(share * (len(clip) - 1))
        found = models.detector.find(clip.frames[frame], models.phrases) if models.detector else []
        if found:
            corners = [(np.asarray(d.box) * scale).tolist() for d in found[:_MOST_OBJECTS]]
            return [Box(frame, c[0], c[1], c[2], c[3], label=i + 1) for i, c in enumerate(corners)]
    raise GenmojoError("empty", f"shows no {', '.join(models.phrases)}", clip.path, "give other words or a box")


def _told(clip: Clip, sentence: str) -> Clip:
    """The clip with one more guess told."""
    return clip.with_channels(guesses=(*clip.guesses, sentence))
