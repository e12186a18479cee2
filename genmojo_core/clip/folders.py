"""Read a clip: the one entry for folders, single images and videos (ARCHITECTURE.md section 2)."""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import replace
from pathlib import Path
from typing import TypeVar

import numpy as np

from genmojo_core.clip import channels, given_tracks, images, layouts, masks, meta, pictures, resize, video
from genmojo_core.clip.clip import Channel, Clip
from genmojo_core.errors import GenmojoError

DEFAULT_FPS = 24.0  # of frames whose rate nobody states (DAVIS)
CHANNELS = ("depth", "cameras", "flow", "background", "tracks")

Result = TypeVar("Result")


def read(
    path: str | Path,
    *,
    frames: tuple[int, int | None] | None = None,
    short_side: int | None = None,
    ignore: Collection[str] = (),
    pixel_aspect: float | None = None,
    tracks: str | Path | None = None,
) -> Clip:
    """A clip with every channel that lies beside it.

    Args:
        path: a folder (clip folder, DAVIS or MOSE sequence, GenMOJO or DreamScene4D layout, plain images), an image or
            a video. Layouts are in `layouts.py`.
        frames: (first, end) positions in the source, end None for all; applies to every channel.
        short_side: read at this many pixels on the short side; never enlarges.
        ignore: channels to leave out, of `CHANNELS`.
        pixel_aspect: width / height of one source pixel as shown; by default meta.json's `pixel_aspect`, then the
            video's own, then 1.
        tracks: npz of point tracks to take instead of the clip's own tracks.npz.

    Returns:
        A Clip whose channels are None where nothing is given. Frames without a frame rate get 24 per second.

    Raises GenmojoError: one sentence with the file, for anything the files or arguments can cause.
    """
    _check_arguments(short_side, ignore)
    layout = layouts.find(Path(path))
    if layout.video is not None:
        read_in = video.read(layout.video, frames, short_side)
    else:
        read_in = pictures.from_files(layout.frames, frames, short_side, str(layout.path))
    about = meta.read(layout.root / "meta.json") if layout.root else meta.Meta()
    clip = _with_masks(_bare(layout, str(path), read_in, about, pixel_aspect), layout, read_in, about)
    ids = clip.object_ids if clip.objects else list(about.names)
    only_object = int(ids[0]) if len(ids) == 1 else 0
    left_out = frozenset([*ignore, "tracks"] if tracks else ignore)
    clip = clip if layout.root is None else _with_channels(clip, layout.root, read_in, only_object, left_out)
    return replace(clip, tracks=given_tracks.read(Path(tracks), read_in, only_object)) if tracks else clip


def _bare(
    layout: layouts.Layout, path: str, read_in: pictures.Pictures, about: meta.Meta, pixel_aspect: float | None
) -> Clip:
    """The clip's frames, times and names, without any channel."""
    aspect = next((a for a in (pixel_aspect, about.pixel_aspect, read_in.pixel_aspect) if a is not None), 1.0)
    return Clip(
        name=layout.name,
        path=path,
        frames=read_in.frames,
        frame_index=read_in.numbers,
        seconds=_seconds(read_in, about.fps),
        source_names=read_in.names,
        source_size=read_in.source_size,
        pixel_aspect=meta.check_pixel_aspect(aspect, path),
        guesses=read_in.notes,
    )


def _check_arguments(short_side: int | None, ignore: Collection[str]) -> None:
    """Raise GenmojoError("argument") for what no clip can have."""
    if short_side is not None and short_side < 1:
        raise GenmojoError("argument", f"the short side is {short_side} pixels", hint="give 1 or more")
    unknown = [name for name in ignore if name not in CHANNELS]
    if unknown:
        raise GenmojoError("argument", f"cannot ignore '{unknown[0]}'", hint=f"use {', '.join(CHANNELS)}")


def _seconds(read_in: pictures.Pictures, fps: float | None) -> np.ndarray:
    """(T,) time stamps: the video's, else numbers over the frame rate, so that gaps stay gaps."""
    if read_in.seconds is not None:
        return read_in.seconds
    return (read_in.numbers - read_in.numbers[0]) / (fps or DEFAULT_FPS)


def _with_masks(clip: Clip, layout: layouts.Layout, read_in: pictures.Pictures, about: meta.Meta) -> Clip:
    """The clip with masks, ids and names, if there are masks."""
    found = masks.read(layout.masks, read_in) if layout.masks else None
    if found is None:
        return clip
    folder_names = found.names or ("",) * len(found.ids)
    names = tuple(
        about.names.get(int(i)) or given or f"object {i}" for i, given in zip(found.ids, folder_names, strict=True)
    )
    return replace(clip, masks=found.channel, object_ids=found.ids, object_names=names)


def _with_channels(
    clip: Clip, root: Path, read_in: pictures.Pictures, only_object: int, ignore: frozenset[str]
) -> Clip:
    """The clip with the channels of its root folder."""
    megasam = next(iter(sorted((root / layouts.MEGASAM).glob("*.npz"))), None)
    depth = _channel("depth", root, megasam, ignore, lambda p: channels.depth(p, read_in))
    cameras = _channel("cameras", root, megasam, ignore, lambda p: channels.cameras(p, read_in))
    flow = _channel("flow", root, None, ignore, lambda p: channels.flow(p, read_in))
    tracks = _channel("tracks", root, None, ignore, lambda p: given_tracks.read(p, read_in, only_object))
    clip = replace(clip, depth=depth, flow=flow, tracks=tracks)
    if cameras is not None:
        clip = replace(clip, cameras=cameras.channel, world_up=cameras.world_up)
    plates = layouts.image_files(root / layouts.PLATES) if (root / layouts.PLATES).is_dir() else ()
    if plates and "background" not in ignore:
        clip = replace(clip, background=_plate(plates[0], clip))
    return clip


def _channel(
    name: str, root: Path, otherwise: Path | None, ignore: frozenset[str], reader: Callable[[Path], Result]
) -> Result | None:
    """What a reader makes of <root>/<name>.npz or of another file, or None."""
    path = root / f"{name}.npz"
    if not path.is_file():
        if otherwise is None:
            return None
        path = otherwise
    return None if name in ignore else reader(path)


def _plate(path: Path, clip: Clip) -> Channel:
    """GenMOJO's painted background, made for its first frame."""
    picture = images.read_rgb(path)
    if picture.shape[1::-1] != clip.source_size:
        raise GenmojoError("schema", f"is {picture.shape[1]} x {picture.shape[0]} but the frames are "
                           f"{clip.source_size[0]} x {clip.source_size[1]}", str(path),
                           "make them the same size or use --ignore background")  # fmt: skip
    return Channel(resize.area(picture, clip.size), np.ones(clip.size[::-1], bool), f"given: {path}")
