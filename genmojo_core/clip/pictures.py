"""The pictures of a clip, read one at a time into an array of the wanted size."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from genmojo_core.clip import images, layouts, resize
from genmojo_core.clip.limits import check_limit
from genmojo_core.errors import GenmojoError

Span = tuple[int, int | None]  # first frame and one past the last, as positions in the source


@dataclass(frozen=True)
class Pictures:
    """Frames as read, T of them.

    Args:
        frames: (T, h, w, 3) uint8 RGB.
        positions: (T,) int64 place in the source (0..total-1). total: frames in the source.
        numbers: (T,) int64 frame numbers. seconds: (T,) float64, or None if only numbers are known.
        names: T file names or time labels.
        source_size: (width, height) before resizing.
        pixel_aspect: width / height of one source pixel if the file says so, else None.
        notes: sentences the user should read.
    """

    frames: np.ndarray
    positions: np.ndarray
    total: int
    numbers: np.ndarray
    seconds: np.ndarray | None
    names: tuple[str, ...]
    source_size: tuple[int, int]
    pixel_aspect: float | None = None
    notes: tuple[str, ...] = ()


def from_files(files: tuple[Path, ...], span: Span | None, short_side: int | None, where: str) -> Pictures:
    """Read image files at reduced size, one in memory at a time.

    Raises GenmojoError as `images.read_rgb`, and "schema" naming the first frame of another size.
    """
    check_limit("frames", len(files), where)
    chosen = select(span, len(files), where)
    frames, size = collect(((files[i], images.read_rgb(files[i])) for i in chosen), len(chosen), short_side)
    numbers = np.array(layouts.numbers(files), np.int64)
    return Pictures(frames, np.array(chosen, np.int64), len(files), numbers[chosen.start : chosen.stop], None,
                    tuple(files[i].name for i in chosen), size)  # fmt: skip


def select(span: Span | None, total: int, where: str) -> range:
    """Positions of the wanted frames; an end beyond the clip means its end.

    Raises GenmojoError("argument") for a span that is no span or holds no frame.
    """
    first, end = span if span is not None else (0, None)
    end = total if end is None else min(end, total)
    if first < 0 or first >= end:
        raise GenmojoError("argument", f"frames {first}:{end} select nothing of {total} frames", where,
                           f"give a range within 0:{total}")  # fmt: skip
    return range(first, end)


def collect(
    pictures: Iterable[tuple[object, np.ndarray]], count: int, short_side: int | None
) -> tuple[np.ndarray, tuple[int, int]]:
    """(count, h, w, 3) resized pictures and the (width, height) they had; each comes with its name for messages.

    Raises GenmojoError: "schema" if a picture has another size than the first, "size" if the whole is too large.
    """
    held = np.zeros((0, 0, 0, 3), np.uint8)
    size = (0, 0)
    first: object = ""
    for i, (name, picture) in enumerate(pictures):
        here = (picture.shape[1], picture.shape[0])
        if i == 0:
            first, size = name, here
            width, height = resize.fitted(size, short_side)
            check_limit("clip_bytes", count * width * height * 3, str(name))
            held = np.empty((count, height, width, 3), np.uint8)
        elif here != size:
            raise GenmojoError("schema", f"is {here[0]} x {here[1]} but the first frame is {size[0]} x {size[1]}",
                               str(name), f"make it as large as {first}")  # fmt: skip
        held[i] = resize.area(picture, (held.shape[2], held.shape[1]))
    return held, size
