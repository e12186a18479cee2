"""Masks that a person corrected, in one npz beside a clip that stays as it is.

`labels` (T, H, W) uint8, 0 background, k + 1 for object k; `valid` (T, H, W) bool; `frame_index` (T,) int64, the
frames' numbers in the source; `object_ids` (K,) int64; `object_names` (K,) text.
"""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np

from genmojo_core.clip import resize
from genmojo_core.clip.clip import Channel, Clip
from genmojo_core.clip.npz import open_npz
from genmojo_core.errors import GenmojoError


def to_bytes(clip: Clip) -> bytes:
    """The clip's masks as a file. Raises GenmojoError("empty") if it has none."""
    if clip.masks is None:
        raise GenmojoError("empty", "the clip has no masks", clip.path)
    stream = io.BytesIO()
    np.savez_compressed(
        stream,
        labels=clip.masks.value.astype(np.uint8),
        valid=clip.masks.valid,
        frame_index=clip.frame_index,
        object_ids=clip.object_ids,
        object_names=np.array(clip.object_names or ("",) * clip.objects, np.str_),
    )
    return stream.getvalue()


def with_masks(clip: Clip, path: str | Path) -> Clip:
    """The clip with the masks of a file in place of its own, at the clip's size and for its frames.

    A frame that the file does not know has no mask (not valid). Raises GenmojoError: as `open_npz`; "schema" where the
    arrays do not fit together; "empty" where the file knows none of the clip's frames.
    """
    file = open_npz(Path(path))
    labels, valid = file.array("labels"), file.array("valid").astype(bool)
    numbers, ids, names = (file.array(name) for name in ("frame_index", "object_ids", "object_names"))
    frames = len(numbers)
    fits = labels.ndim == 3 and labels.dtype == np.uint8 and labels.shape == valid.shape and len(labels) == frames
    if not fits or ids.ndim != 1 or names.shape != ids.shape or (labels.size and labels.max() > len(ids)):
        raise GenmojoError("schema", "its arrays do not fit together", str(path), "write it with genmojo-studio")
    there = {int(number): i for i, number in enumerate(numbers)}
    value, known = np.zeros(clip.frames.shape[:3], np.uint8), np.zeros(clip.frames.shape[:3], bool)
    for t, number in enumerate(clip.frame_index.tolist()):
        if number in there:
            row = there[number]
            value[t] = resize.nearest_labels(labels[row], clip.size)
            known[t] = resize.nearest(valid[row], clip.size)
    if not known.any():
        raise GenmojoError("empty", "holds none of the clip's frames", str(path), "give the masks of this clip")
    return clip.with_channels(
        masks=Channel(value, known, f"given: {path}"),
        object_ids=ids.astype(np.int64),
        object_names=tuple(str(name) for name in names),
    )
