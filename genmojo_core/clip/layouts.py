"""Where a clip's files are: DAVIS, MOSE, GenMOJO, DreamScene4D, plain folders, one image, one video.

Only names are looked at here; nothing is decoded. Layouts as in METHOD.md section 1.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from genmojo_core.clip.images import EXTENSIONS
from genmojo_core.clip.limits import check_limit
from genmojo_core.errors import GenmojoError

VIDEO_EXTENSIONS = (
    ".mp4",
    ".mov",
    ".m4v",
    ".mkv",
    ".avi",
    ".webm",
    ".mpg",
    ".mpeg",
    ".ts",
    ".mts",
    ".3gp",
    ".wmv",
    ".h264",
)
IMAGES, MASKS, PLATES, MEGASAM = "JPEGImages", "Annotations", "InpaintedBackgrounds", "MegaSAM_Outputs"


@dataclass(frozen=True)
class Layout:
    """A clip's files by role.

    Args:
        name: short name of the clip.
        path: what the user gave.
        frames: image files in the order of their numbers; empty if `video` is set.
        video: the video file, or None.
        masks: folder of masks, or None; its files carry the frames' numbers.
        root: folder with depth.npz, cameras.npz, flow.npz, tracks.npz, meta.json and the like, or None.
    """

    name: str
    path: Path
    frames: tuple[Path, ...] = ()
    video: Path | None = None
    masks: Path | None = None
    root: Path | None = None


def find(path: Path) -> Layout:
    """The layout behind a path that the user gave.

    Raises GenmojoError: "io" if there is nothing at the path or it cannot be read; "format" for a file that is neither
    image nor video; "empty" for a folder without frames; "argument" for a folder with several clips.
    """
    try:
        if path.is_file():
            return _file(path)
        if not path.exists():
            return _named_in_root(path)
        return _folder(path)
    except OSError as error:
        shown = str(path) if len(str(path)) < 200 else f"...{str(path)[-100:]}"
        raise GenmojoError("io", f"cannot be read ({error.strerror})", shown, "check the path") from error


def image_files(folder: Path) -> tuple[Path, ...]:
    """Image files directly in a folder in natural order (numbers as numbers); hidden files are passed over.

    Raises GenmojoError: "io" if it cannot be read, "schema" if two files differ only in their extension.
    """
    found = [p for p in _entries(folder) if p.suffix.lower() in EXTENSIONS and not p.name.startswith(".")]
    files = tuple(sorted(found, key=lambda p: (_natural(p.stem), p.suffix)))
    for one, two in zip(files, files[1:], strict=False):
        if one.stem == two.stem:
            raise GenmojoError("schema", f"holds both {one.name} and {two.name}", str(folder),
                               "keep frames and masks in folders of their own")  # fmt: skip
    return files


def number(stem: str) -> int | None:
    """The last group of digits in a file's stem, or None: its frame number ("frame_0042_left" is 42)."""
    digits = re.findall(r"\d{1,15}", stem)
    return int(digits[-1]) if digits else None


def numbers(files: tuple[Path, ...]) -> list[int]:
    """Frame numbers of files: from their names where all have one and they rise, else their positions."""
    found = [number(p.stem) for p in files]
    known = [n for n in found if n is not None]
    if len(known) == len(found) and all(a < b for a, b in zip(known, known[1:], strict=False)):
        return known
    return list(range(len(files)))


def subfolders(folder: Path) -> tuple[Path, ...]:
    """Folders directly in a folder, natural order, without hidden ones."""
    found = [p for p in _entries(folder) if p.is_dir() and not p.name.startswith(".")]
    return tuple(sorted(found, key=lambda p: _natural(p.name)))


def _folder(path: Path) -> Layout:
    """A folder of any layout."""
    images = path / IMAGES
    if images.is_dir():
        return _root(path, images)
    if path.name == IMAGES:
        return _root(path.parent, path)
    above = next((p for p in path.parents if p.name == IMAGES), None)
    if above is not None and image_files(path):
        return _sequence(path, above)
    return _plain(path)


def _file(path: Path) -> Layout:
    """A still, or a video."""
    suffix = path.suffix.lower()
    if suffix in VIDEO_EXTENSIONS:
        return Layout(path.stem, path, video=path)
    if suffix in EXTENSIONS:
        return Layout(path.stem, path, frames=(path,))
    raise GenmojoError("format", f"is no clip ({suffix or 'no'} extension)", str(path),
                       "give a folder of frames, an image or a video")  # fmt: skip


def _root(root: Path, images: Path) -> Layout:
    """A folder with JPEGImages: the frames directly in it (GenMOJO), or one folder per clip (DAVIS, MOSE)."""
    files = image_files(images)
    if files:
        masks = root / MASKS
        return Layout(root.resolve().name, root, files, masks=masks if masks.is_dir() else None, root=root)
    clips = _clips(images)
    if not clips:
        raise GenmojoError("empty", "holds no frames", str(images), f"put images ({' '.join(EXTENSIONS)}) there")
    named = [p for p in clips if p.name == root.resolve().name]
    if len(clips) > 1 and len(named) != 1:
        shown = ", ".join(p.name for p in clips[:3])
        raise GenmojoError("argument", f"holds {len(clips)} clips ({shown}, ...)", str(root),
                           f"give one of them, such as {clips[0]}")  # fmt: skip
    clip = named[0] if named else clips[0]
    return Layout(clip.name, root, image_files(clip), masks=_masks_beside(clip, images), root=root)


def _clips(images: Path) -> tuple[Path, ...]:
    """Folders with frames under JPEGImages, at most two levels down (a resolution folder between)."""
    found: list[Path] = []
    for folder in subfolders(images):
        found += [folder] if image_files(folder) else [p for p in subfolders(folder) if image_files(p)]
    return tuple(found)


def _sequence(path: Path, images: Path) -> Layout:
    """One clip given by its own folder under JPEGImages; files beside JPEGImages are its own if it is alone."""
    alone = len(_clips(images)) == 1
    return Layout(path.name, path, image_files(path), masks=_masks_beside(path, images),
                  root=images.parent if alone else None)  # fmt: skip


def _masks_beside(clip: Path, images: Path) -> Path | None:
    """Annotations/<same path>, or its last part alone where the masks have no resolution folder."""
    relative = clip.resolve().relative_to(images.resolve())
    base = images.parent / MASKS
    return next((p for p in (base / relative, base / relative.name) if p.is_dir()), None)


def _named_in_root(path: Path) -> Layout:
    """`<root>/<clip name>` of a DAVIS or MOSE root, or nothing at all."""
    images = path.parent / IMAGES
    if images.is_dir():
        named = [p for p in _clips(images) if p.name == path.name]
        if named:
            return _sequence(named[0], images)
    raise GenmojoError("io", "there is no such file or folder", str(path), "check the path")


def _plain(path: Path) -> Layout:
    """A folder of images with masks in Annotations or masks if there are any, or with one video."""
    files = image_files(path)
    masks = next((p for p in (path / MASKS, path / "masks") if p.is_dir()), None)
    name = path.resolve().name
    if files:
        return Layout(name, path, files, masks=masks, root=path)
    videos = [p for p in _entries(path) if p.suffix.lower() in VIDEO_EXTENSIONS and not p.name.startswith(".")]
    if len(videos) == 1:
        return Layout(name, path, video=videos[0], masks=masks, root=path)
    if videos:
        raise GenmojoError("argument", f"holds {len(videos)} videos", str(path), "give one of them")
    clips = [p for p in subfolders(path) if (p / IMAGES).is_dir() or image_files(p)]
    if clips:
        raise GenmojoError("argument", f"holds {len(clips)} folders with frames", str(path),
                           f"give one of them, such as {clips[0]}")  # fmt: skip
    raise GenmojoError("empty", "holds no frames", str(path), "give a folder of images, an image or a video")


def _entries(folder: Path) -> list[Path]:
    """What is in a folder; raises GenmojoError("io") if it cannot be read."""
    try:
        entries = list(folder.iterdir())
    except OSError as error:
        raise GenmojoError("io", f"cannot be read ({error.strerror})", str(folder), "check the path") from error
    check_limit("folder_entries", len(entries), str(folder))
    return entries


def _natural(text: str) -> list[tuple[int, int, str]]:
    """Sort key with runs of digits as numbers."""
    return [(0, int(part), part) if part.isdigit() else (1, 0, part) for part in re.split(r"(\d+)", text) if part]
