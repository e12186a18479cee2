"""Masks of a clip: palette PNGs or one binary folder per object -> labels with validity."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from genmojo_core.clip import images, layouts, resize
from genmojo_core.clip.clip import Channel
from genmojo_core.clip.limits import check_limit
from genmojo_core.clip.pictures import Pictures
from genmojo_core.errors import GenmojoError

VOID = 255  # "nobody knows": the rim in DAVIS


@dataclass(frozen=True)
class MaskSet:
    """Labels of a clip and the objects they stand for.

    Args:
        channel: (T, h, w) uint8, 0 background, k + 1 for the k-th id.
        ids: (K,) int64 ids in the source. names: K names if folders had names, else empty.
    """

    channel: Channel
    ids: np.ndarray
    names: tuple[str, ...] = ()


def read(folder: Path, pictures: Pictures) -> MaskSet | None:
    """Masks of the frames read; None if the folder holds none for them.

    Masks are matched to frames by number. Frames without a mask, and void pixels, are not valid. Objects are those
    seen in the frames read.

    Raises GenmojoError: as `images.read_labels`; "schema" if a mask's size is not its frame's or no mask's number is a
    frame's; "empty" if every mask is background only.
    """
    files = layouts.image_files(folder)
    if files:
        stored, grey_only = _stack(pictures, _indexed(files, pictures))
        names: dict[int, str] = {}
    else:
        objects = [p for p in layouts.subfolders(folder) if layouts.image_files(p)]
        if not objects:
            return None
        owners = _owners(objects)
        stored, grey_only = _stack(pictures, _binary(owners, pictures, str(folder)))
        names = {i: p.name for i, p in owners.items() if not p.name.isdigit()}
    if not stored[1].any():
        return None  # all masks lie outside the frames read
    return _labelled(stored, names, str(folder), white_is_object=grey_only)


Reader = Callable[[int], tuple[np.ndarray, bool, Path] | None]  # frame number -> (H, W) ids, grey, file


def _indexed(files: tuple[Path, ...], pictures: Pictures) -> Reader:
    """Reader of files that hold all objects' ids."""
    by_number = _by_number(files, pictures)

    def one(frame: int) -> tuple[np.ndarray, bool, Path] | None:
        path = by_number.get(frame)
        if path is None:
            return None
        labels = images.read_labels(path)
        return labels.index, labels.grey, path

    return one


def _owners(folders: list[Path]) -> dict[int, Path]:
    """Object id of each folder: its number (000 is the background and no object), else its place from 1."""
    if all(p.name.isdigit() for p in folders):
        owners = {int(p.name): p for p in folders if int(p.name) > 0}
    else:
        owners = dict(enumerate(folders, 1))
    check_limit("objects", len(owners), str(folders[0].parent))
    if not owners:
        raise GenmojoError("empty", "holds a background mask (000) but no object", str(folders[0].parent),
                           "add one folder per object: 001, 002")  # fmt: skip
    too_large = [p for i, p in owners.items() if i >= VOID]
    if too_large:
        raise GenmojoError("value", "is named by an object id above 254", str(too_large[0]), "number objects from 001")
    return owners


def _binary(owners: dict[int, Path], pictures: Pictures, where: str) -> Reader:
    """Reader of one folder per object; a pixel that two objects claim is void."""
    files = {i: _by_number(layouts.image_files(p), pictures) for i, p in owners.items()}

    def one(frame: int) -> tuple[np.ndarray, bool, Path] | None:
        index: np.ndarray | None = None
        path = Path(where)
        for object_id, by_number in files.items():
            if frame not in by_number:
                continue
            path = by_number[frame]
            mask = images.read_binary(path)
            _check_size(mask, pictures.source_size, path)
            if index is None:
                index = np.zeros(mask.shape, np.uint8)
            index[mask] = np.where(index[mask] == 0, object_id, VOID)
        return None if index is None else (index, False, path)

    return one


def _by_number(files: tuple[Path, ...], pictures: Pictures) -> dict[int, Path]:
    """Mask files by frame number; files without numbers belong to the frames of their places."""
    found = dict(zip(layouts.numbers(files), files, strict=True))
    if not np.isin(pictures.numbers, list(found)).any() and not _outside(found, pictures):
        raise GenmojoError("schema", f"has masks numbered {min(found)} to {max(found)} but frames numbered "
                           f"{pictures.numbers[0]} to {pictures.numbers[-1]}", str(files[0].parent),
                           "name masks like their frames")  # fmt: skip
    return found


def _outside(found: dict[int, Path], pictures: Pictures) -> bool:
    """True if only a part of the clip was read, so that its masks may lie in the part that was not."""
    return len(pictures.positions) < pictures.total and len(found) > 0


def _stack(pictures: Pictures, reader: Reader) -> tuple[tuple[np.ndarray, np.ndarray], bool]:
    """((T, h, w) stored ids, (T,) frames that have a mask) and whether all files were grey."""
    count, height, width = pictures.frames.shape[:3]
    stored = np.zeros((count, height, width), np.uint8)
    present = np.zeros(count, bool)
    grey_only = True
    for t in range(count):
        found = reader(int(pictures.numbers[t]))
        if found is None:
            continue
        index, grey, path = found
        _check_size(index, pictures.source_size, path)
        stored[t] = resize.nearest_labels(index, (width, height))
        present[t] = True
        grey_only &= grey
    return (stored, present), grey_only


def _check_size(mask: np.ndarray, size: tuple[int, int], path: Path) -> None:
    """A mask is never resized to fit."""
    if mask.shape[1::-1] != size:
        raise GenmojoError("schema", f"the mask is {mask.shape[1]} x {mask.shape[0]} but its frame is "
                           f"{size[0]} x {size[1]}", str(path), "make them the same size")  # fmt: skip


def _labelled(
    stored: tuple[np.ndarray, np.ndarray], names: dict[int, str], where: str, *, white_is_object: bool
) -> MaskSet:
    """Consecutive labels 1..K of the ids that occur; 255 is void, or the object of a black and white mask."""
    index, present = stored
    seen = np.flatnonzero(np.bincount(index.ravel(), minlength=256))
    ids = seen[(seen != 0) & (seen != VOID)]
    if white_is_object and not ids.size and VOID in seen:
        index = (index == VOID).astype(np.uint8)
        seen = ids = np.array([1])
    if not ids.size:
        raise GenmojoError("empty", "no object is visible in any frame (all masks are background)", where,
                           "mark at least one object, or take the masks away")  # fmt: skip
    table = np.zeros(256, np.uint8)
    table[ids] = np.arange(1, len(ids) + 1)
    valid = (index != VOID) & present[:, None, None]
    labelled_names = tuple(names.get(int(i), "") for i in ids)
    return MaskSet(Channel(table[index], valid, f"given: {where}"), ids.astype(np.int64), labelled_names)
