"""Single frames of a clip at full size, in any order, for looking at: folders of images, videos by time stamp, masks.

`read` of `folders.py` holds a whole clip in memory; an annotator steps through clips that do not fit, so this decodes
one frame at a time. Pixels are BGRA (B, G, R, 255), which screens take without conversion.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Protocol

import av
import numpy as np
from av.error import FFmpegError

from genmojo_core.clip import images, layouts, meta, video
from genmojo_core.clip.limits import check_image_size, check_limit
from genmojo_core.errors import GenmojoError

DEFAULT_FPS = 24.0
Keep = Callable[[int, np.ndarray], None]


class FrameSource(Protocol):
    """What a viewer needs of a clip: T frames of `size` (width, height), `seconds` (T,) from the first frame.

    A source belongs to one thread at a time; `open_source` again for another thread.
    """

    count: int
    size: tuple[int, int]
    seconds: np.ndarray

    def read(self, index: int, keep: Keep | None = None, out: np.ndarray | None = None) -> np.ndarray:
        """(H, W, 4) uint8 BGRA of frame `index`, in `out` (same shape) where that saves memory.

        Frames decoded on the way are given to `keep(index, frame)`.
        """

    def close(self) -> None:
        """Let go of files."""


def open_source(path: str | Path) -> FrameSource:
    """Frames of a folder of images or of a video (layouts as `layouts.find`).

    Raises GenmojoError as `layouts.find`, `images.read_rgb` and `video.read`.
    """
    layout = layouts.find(Path(path))
    if layout.video is not None:
        return VideoFrames(layout.video)
    fps = meta.read(layout.root / "meta.json").fps if layout.root else None
    return FolderFrames(layout.frames, fps or DEFAULT_FPS)


def frame_names(path: str | Path) -> tuple[str, ...]:
    """File names of a clip's frames; none for a video, or where the clip is not there any more."""
    try:
        return tuple(file.name for file in layouts.find(Path(path)).frames)
    except GenmojoError:
        return ()


class FolderFrames:
    """Frames in image files, one file each; `FrameSource`."""

    def __init__(self, files: tuple[Path, ...], fps: float = DEFAULT_FPS) -> None:
        check_limit("frames", len(files), str(files[0].parent))
        self._files = files
        first = images.read_rgb(files[0])
        self.count, self.size = len(files), (first.shape[1], first.shape[0])
        numbers = np.array(layouts.numbers(files), float)
        self.seconds = (numbers - numbers[0]) / fps

    def read(self, index: int, keep: Keep | None = None, out: np.ndarray | None = None) -> np.ndarray:
        """(H, W, 4) uint8 BGRA; raises GenmojoError("schema") for a frame of another size than the first."""
        picture = images.read_bgra(self._files[index], out)
        if (picture.shape[1], picture.shape[0]) != self.size:
            raise GenmojoError("schema", f"is {picture.shape[1]} x {picture.shape[0]} but the first frame is "
                               f"{self.size[0]} x {self.size[1]}", str(self._files[index]),
                               "make all frames the same size")  # fmt: skip
        return picture

    def close(self) -> None:
        """Nothing is held open."""


class VideoFrames:
    """Frames of a video by presentation time stamp; `FrameSource`.

    Going on to a later frame decodes on; anything else seeks to a key frame before it. Of the frames passed on the way
    only those at or after the last key frame before the target are kept, because earlier ones may lean on frames that
    the seek left out.
    """

    def __init__(self, path: Path) -> None:
        self._path, self._where = path, str(path)
        try:
            self._index = video.read_index(path)
            self._container = video.opened(path)
            self._stream = video.picture_stream(self._container, self._where)
            self._stream.thread_type = "AUTO"
        except FFmpegError as error:
            raise video.video_error(error, self._where) from error
        self._place = {int(s): i for i, s in enumerate(self._index.stamps)}
        self._decoder: Iterator[av.VideoFrame] | None = None
        self._last = -1  # position last decoded
        self._decoded = 0  # pictures since the start, for files whose stamps are counted
        self.count = len(self._index.stamps)
        self.seconds = (self._index.stamps - self._index.stamps[0]) * self._index.base
        first = self.read(0)
        self.size = (first.shape[1], first.shape[0])

    def read(self, index: int, keep: Keep | None = None, out: np.ndarray | None = None) -> np.ndarray:
        """(H, W, 4) uint8 BGRA of frame `index`; the decoder's memory is its own, `out` is not used.

        Raises GenmojoError("video") if that frame cannot be decoded.
        """
        try:
            found = self._on_to(index, keep) if self._ahead(index) else None
            if found is None:
                self._seek(index)
                found = self._on_to(index, keep)
            if found is None:  # a container whose seek overshoots
                self._restart()
                found = self._on_to(index, keep)
        except FFmpegError as error:
            raise video.video_error(error, self._where) from error
        if found is None:
            raise GenmojoError("video", f"frame {index} cannot be decoded", self._where, "convert it to H.264 in mp4")
        return found

    def close(self) -> None:
        """Close the file."""
        self._decoder = None
        self._container.close()

    def _ahead(self, index: int) -> bool:
        """True if decoding on reaches the frame no later than a seek would."""
        if self._decoder is None or index <= self._last:
            return False
        return self._index.counted or self._last >= self._start(index)[0]

    def _start(self, index: int) -> tuple[int, int]:
        """Positions of the key frame to seek to and of the first frame that is whole from there."""
        before = self._index.keys[self._index.keys <= self._index.stamps[index]]
        if not len(before):
            return 0, 0
        last = self._place.get(int(before[-1]), 0)
        return (self._place.get(int(before[-2]), 0) if len(before) > 1 else 0), last

    def _seek(self, index: int) -> None:
        start, _ = self._start(index)
        if start == 0 or self._index.counted:
            self._restart()
            return
        self._container.seek(int(self._index.stamps[start]), stream=self._stream)
        self._decoder, self._last = self._container.decode(self._stream), -1

    def _restart(self) -> None:
        """Begin at the first frame, with a fresh decoder."""
        self._container.close()
        self._container = video.opened(self._path)
        self._stream = video.picture_stream(self._container, self._where)
        self._stream.thread_type = "AUTO"
        self._decoder, self._last, self._decoded = self._container.decode(self._stream), -1, 0

    def _on_to(self, index: int, keep: Keep | None) -> np.ndarray | None:
        """Decode until frame `index`; None if it does not come."""
        whole_from = self._start(index)[1] if self._last < 0 else self._last
        while self._decoder is not None:
            frame = next(self._decoder, None)
            if frame is None:
                self._decoder = None
                break
            place = self._place_of(frame)
            if place is None or place <= self._last:
                continue
            self._last = place
            if place > index:
                break
            if place == index:
                return self._picture(frame)
            if keep and place >= whole_from:
                keep(place, self._picture(frame))
        return None

    def _place_of(self, frame: av.VideoFrame) -> int | None:
        if not self._index.counted:
            return None if frame.pts is None else self._place.get(int(frame.pts))
        self._decoded += 1
        return min(self._decoded - 1, self.count - 1)

    def _picture(self, frame: av.VideoFrame) -> np.ndarray:
        check_image_size(frame.width, frame.height, self._where)
        turned = np.rot90(frame.to_ndarray(format="bgra"), round(frame.rotation / 90))
        return np.ascontiguousarray(turned)


class MaskFrames:
    """Object ids of single frames, from palette PNGs or one folder of binary masks per object."""

    def __init__(self, path: str | Path) -> None:
        layout = layouts.find(Path(path))
        folder = layout.masks
        self._files: dict[int, dict[int, Path]] = {}  # object id, 0 for files of all objects -> frame number -> file
        self._numbers = layouts.numbers(layout.frames) if layout.frames else []
        if folder is None:
            return
        files = layouts.image_files(folder)
        if files:
            self._files[0] = dict(zip(layouts.numbers(files), files, strict=True))
        for owner in () if files else layouts.subfolders(folder):
            number = layouts.number(owner.name)
            held = layouts.image_files(owner)
            if number and held:
                self._files[number] = dict(zip(layouts.numbers(held), held, strict=True))

    def __bool__(self) -> bool:
        return bool(self._files)

    def read(self, index: int) -> np.ndarray | None:
        """(H, W) uint8 ids of the source, 0 background, 255 unknown; None for a frame without a mask.

        Raises GenmojoError as `images.read_labels`.
        """
        number = self._numbers[index] if self._numbers else index
        labels: np.ndarray | None = None
        for owner, files in self._files.items():
            if number not in files:
                continue
            if owner == 0:
                return images.read_labels(files[number]).index
            mask = images.read_binary(files[number])
            labels = np.zeros(mask.shape, np.uint8) if labels is None else labels
            labels[mask] = owner
        return labels
