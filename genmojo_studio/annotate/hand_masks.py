"""Masks that a person makes in step 1: prompts on frames, cut out and followed in a thread, kept in the project."""

from __future__ import annotations

import io
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np

from genmojo_core.clip import mask_file
from genmojo_core.clip.clip import Channel, Clip
from genmojo_core.estimate.flow import sequence_flow
from genmojo_core.estimate.masks import Box, Helpers, Prompt, Scribble, masks_from_prompts
from genmojo_core.store.atomic import write_bytes
from genmojo_core.store.project import Project

BLOB = "hand_masks"
SUFFIX = ".masks.npz"  # beside the project: the clip's masks with these in them, for runs
Progress = Callable[[float], None]


def cut_out(clip: Clip, prompts: list[Prompt], progress: Progress | None = None) -> np.ndarray:  # (T, H, W) bool
    """The object of prompts (in pixels of the clip's source) in every frame of the clip as held.

    Raises GenmojoError("argument") for a prompt that cannot be meant.
    """
    alike = [replace(prompt, label=1) for prompt in prompts]
    helpers = Helpers(sequence_flow(clip.frames), progress=progress)
    return masks_from_prompts(clip.frames, alike, clip.source_size, helpers) > 0


def with_object(clip: Clip, object_id: int, name: str, mask: np.ndarray) -> Clip:
    """The clip with one more object, whose mask (T, H, W) bool lies over the others'."""
    if clip.masks is None:
        labels, valid = np.zeros(clip.frames.shape[:3], np.uint8), np.ones(clip.frames.shape[:3], bool)
    else:
        labels, valid = clip.masks.value.copy(), clip.masks.valid
    ids = clip.object_ids.tolist()
    names = clip.object_names or ("",) * len(ids)
    if object_id in ids:
        labels[labels == ids.index(object_id) + 1] = 0
    else:
        ids, names = [*ids, object_id], (*names, name)
    labels[mask] = ids.index(object_id) + 1
    channel = Channel(labels, valid | mask, "given: drawn by hand")
    return clip.with_channels(masks=channel, object_ids=np.array(ids, np.int64), object_names=tuple(names))


def publish(clip: Clip, project: Path) -> Path:
    """Write the clip's masks, hand-made ones in them, beside the project; runs of the clip take them from there.

    Raises GenmojoError as `write_bytes` and `mask_file.to_bytes`.
    """
    path = project.with_suffix(SUFFIX)
    write_bytes(path, mask_file.to_bytes(clip))
    return path


def save(project: Project, masks: dict[int, np.ndarray]) -> None:
    """Keep masks (T, H, W) bool by object id in the project."""
    packed = {f"object_{i}": np.packbits(mask, axis=2) for i, mask in masks.items()}
    shapes = {f"width_{i}": np.array(mask.shape[2]) for i, mask in masks.items()}
    stream = io.BytesIO()
    np.savez_compressed(stream, **packed, **shapes)  # type: ignore[arg-type]
    project.put_blob(BLOB, stream.getvalue())


def load(project: Project) -> dict[int, np.ndarray]:
    """The masks kept in the project, by object id."""
    data = project.blob(BLOB)
    if data is None:
        return {}
    with np.load(io.BytesIO(data), allow_pickle=False) as file:
        arrays = dict(file)
    ids = [int(name.removeprefix("object_")) for name in arrays if name.startswith("object_")]
    return {i: np.unpackbits(arrays[f"object_{i}"], axis=2, count=int(arrays[f"width_{i}"])).astype(bool) for i in ids}


def box_prompt(frame: int, corners: tuple[float, float, float, float]) -> Box:
    """A box drawn on a frame, source pixels."""
    return Box(frame, *corners)


def stroke_prompt(frame: int, points: np.ndarray, *, on: bool) -> Scribble:
    """A stroke or a click on a frame: points (n, 2) in source pixels, on the object or beside it."""
    return Scribble(frame, np.asarray(points, float), on)
