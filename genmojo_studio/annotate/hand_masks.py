"""Masks that a person makes in step 1: prompts on frames, cut out and followed in a thread, kept in the project.

Each is a blob of its own that is never written again; which one stands for an object is `ObjectInfo.mask`, so undo and
redo of the edit that set it bring the other one back.
"""

from __future__ import annotations

import io
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from genmojo_core.clip import mask_file, resize
from genmojo_core.clip.clip import Channel, Clip
from genmojo_core.errors import GenmojoError
from genmojo_core.estimate.flow import FlowOnDemand
from genmojo_core.estimate.mask_correction import correct_masks
from genmojo_core.estimate.masks import Box, Helpers, Prompt, Scribble, follow, masks_from_prompts
from genmojo_core.store.atomic import write_bytes
from genmojo_core.store.project import Project

SUFFIX = ".masks.npz"  # beside the project: the clip's masks with these in them, for runs
_FIRST = "hand_masks"  # blob in which projects kept all masks before each became an edit
Progress = Callable[[float], None]


@dataclass(frozen=True)
class Drawn:
    """A mask (T, H, W) bool of one object, and the frames in which a person drew."""

    mask: np.ndarray
    frames: tuple[int, ...] = ()


def cut_out(clip: Clip, prompts: list[Prompt], progress: Progress | None = None) -> Drawn:
    """The object of prompts (in pixels of the clip's source) in every frame of the clip as held.

    Raises GenmojoError("argument") for a prompt that cannot be meant.
    """
    for frame in sorted({prompt.frame for prompt in prompts}):
        own = [p for p in prompts if p.frame == frame]
        if not any(isinstance(p, Box) or p.foreground for p in own):
            raise GenmojoError("argument", f"frame {frame} shows only what is not part of the object", clip.name,
                               "draw on the object too, or a box round it")  # fmt: skip
    alike = [replace(prompt, label=1) for prompt in prompts]
    helpers = Helpers(FlowOnDemand(clip.frames), progress=progress)
    mask = masks_from_prompts(clip.frames, alike, clip.source_size, helpers) > 0
    return Drawn(mask, tuple(sorted({prompt.frame for prompt in prompts})))


def corrected(clip: Clip, old: Drawn, prompts: list[Prompt]) -> Drawn:
    """A mask put right by prompts (in pixels of the clip's source), there and as far as the change goes on.

    Raises GenmojoError("argument") for a prompt that cannot be meant.
    """
    mask = correct_masks(clip.frames, fitted(old.mask, clip), prompts, clip.source_size, old.frames)
    return Drawn(mask, tuple(sorted({*old.frames, *(prompt.frame for prompt in prompts)})))


def followed(clip: Clip, old: Drawn, known: np.ndarray) -> Drawn:
    """A mask carried on into the frames for which the clip's files have none (not `known`, (T,) bool).

    Raises GenmojoError("empty") if there is no such frame, or no mask to follow.
    """
    mask = fitted(old.mask, clip)
    seeds = {int(t): mask[t] for t in np.flatnonzero(mask.any(axis=(1, 2)))}
    if known.all():
        raise GenmojoError("empty", "every frame has masks already", clip.name, "correct the mask instead")
    if not seeds:
        raise GenmojoError("empty", "the object has no mask to follow", clip.name, "draw a box where it is seen")
    found = follow(clip.frames, seeds, Helpers(FlowOnDemand(clip.frames))) >= 0.5
    return Drawn(np.where(known[:, None, None], mask, found), old.frames)


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


def with_drawn(clip: Clip, drawn: Mapping[int, Drawn], names: Mapping[int, str]) -> Clip:
    """The clip with masks drawn by object id, each over those before it.

    Raises GenmojoError("schema") for a mask of other frames.
    """
    for number, one in drawn.items():
        clip = with_object(clip, number, names.get(number, ""), fitted(one.mask, clip))
    return clip


def fitted(mask: np.ndarray, clip: Clip) -> np.ndarray:
    """A mask (T, h, w) bool at the size of a clip's frames. Raises GenmojoError("schema") if its frames are others."""
    if len(mask) != len(clip):
        raise GenmojoError("schema", f"a mask of {len(mask)} frames does not fit a clip of {len(clip)}", clip.path,
                           "open the clip that it was drawn on")  # fmt: skip
    if mask.shape[2:0:-1] == clip.size:
        return mask
    return np.stack([resize.nearest_labels(one.astype(np.uint8), clip.size) for one in mask]) > 0


def publish(clip: Clip, project: Path) -> Path:
    """Write the clip's masks, hand-made ones in them, beside the project; runs of the clip take them from there.

    Raises GenmojoError as `write_bytes` and `mask_file.to_bytes`.
    """
    path = project.with_suffix(SUFFIX)
    write_bytes(path, mask_file.to_bytes(clip))
    return path


def withdraw(project: Path) -> None:
    """No mask is drawn any more: runs take the clip's own again."""
    project.with_suffix(SUFFIX).unlink(missing_ok=True)


def pack(drawn: Drawn) -> bytes:
    """A drawn mask as a blob of the project."""
    stream = io.BytesIO()
    np.savez_compressed(stream, mask=np.packbits(drawn.mask, axis=2), width=np.array(drawn.mask.shape[2]),
                        frames=np.array(drawn.frames, np.int64))  # fmt: skip
    return stream.getvalue()


def keep(project: Project, number: int, packed: bytes) -> None:
    """Keep a packed mask under a number that no other has. Raises GenmojoError("io") if the project is read only."""
    project.put_blob(f"mask:{number}", packed)


def load(project: Project, number: int) -> Drawn:
    """The mask kept under a number. Raises GenmojoError("corrupt") if it is missing."""
    data = project.blob(f"mask:{number}")
    if data is None:
        raise GenmojoError("corrupt", f"lacks the mask of edit {number}", str(project.path), "open a backup copy")
    with np.load(io.BytesIO(data), allow_pickle=False) as file:
        mask = np.unpackbits(file["mask"], axis=2, count=int(file["width"])).astype(bool)
        return Drawn(mask, tuple(file["frames"].tolist()))


def load_first(project: Project) -> dict[int, Drawn]:
    """Masks by object id of a project made before masks were edits; they stand until one is drawn anew."""
    data = project.blob(_FIRST)
    if data is None:
        return {}
    with np.load(io.BytesIO(data), allow_pickle=False) as file:
        arrays = dict(file)
    ids = [int(name.removeprefix("object_")) for name in arrays if name.startswith("object_")]
    widths = {i: int(arrays[f"width_{i}"]) for i in ids}
    return {i: Drawn(np.unpackbits(arrays[f"object_{i}"], axis=2, count=widths[i]).astype(bool)) for i in ids}


def box_prompt(frame: int, corners: tuple[float, float, float, float]) -> Box:
    """A box drawn on a frame, source pixels."""
    return Box(frame, *corners)


def stroke_prompt(frame: int, points: np.ndarray, *, on: bool) -> Scribble:
    """A stroke or a click on a frame: points (n, 2) in source pixels, on the object or beside it."""
    return Scribble(frame, np.asarray(points, float), on)
