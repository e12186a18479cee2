"""Frames of a video file by presentation time stamp (PyAV), never by counting (ENVIRONMENT.md section 4).

One demux lists the time stamps without decoding; a range of frames is then decoded from a key frame before it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import av
import numpy as np
from av.error import FFmpegError, InvalidDataError

from genmojo_core.clip import pictures
from genmojo_core.clip.limits import LIMITS, PIXEL_ASPECT_RANGE, check_image_size, check_limit
from genmojo_core.errors import GenmojoError
from genmojo_core.sentences import say


@dataclass(frozen=True)
class Index:
    """Time stamps of a video's frames, in units of `base` seconds, rising, and those of its key frames.

    `counted` is True where frames carry no stamp to be trusted (bare streams, AVI with B-frames): the n-th picture
    decoded then has the n-th stamp, and decoding starts at the beginning.
    """

    stamps: np.ndarray
    keys: np.ndarray
    base: float
    counted: bool


def read(path: Path, span: pictures.Span | None, short_side: int | None) -> pictures.Pictures:
    """Frames of the first picture stream; their numbers are places in the order of time stamps; rotation is applied.

    `seconds` count from the video's first frame. Frames that a damaged video cannot give are left out with a note.

    Raises GenmojoError: "io"; "video" for a missing header, no picture stream, no frame, or frames that cannot be
    decoded; "size" for frames over the limits; "argument" for a span outside the video.
    """
    where = str(path)
    try:
        index = read_index(path)
        chosen = pictures.select(span, len(index.stamps), where)
        with opened(path) as container:
            stream = picture_stream(container, where)
            decoder = _Decoder(index, chosen, where)
            frames, size = pictures.collect(decoder.run(container, stream), len(chosen), short_side)
            aspect = _pixel_aspect(stream, turned=decoder.turned)
    except FFmpegError as error:
        raise video_error(error, where) from error
    if not decoder.found:
        raise GenmojoError("video", "none of its frames can be decoded", where, "convert it to H.264 in mp4")
    positions = np.array(decoder.found, np.int64)
    seconds = (index.stamps[positions] - index.stamps[0]) * index.base
    lost = len(chosen) - len(positions)
    notes = (say("frames_lost", count=lost, frames=len(chosen), name=path.name),) if lost else ()
    return pictures.Pictures(frames[: len(positions)], positions, len(index.stamps), positions, seconds,
                             tuple(f"{s:.3f} s" for s in seconds), size, aspect, notes)  # fmt: skip


class _Decoder:
    """Decodes the chosen frames in order and remembers which were there.

    After `run`: `found` holds their positions, `turned` is True if they were turned by a quarter.
    """

    def __init__(self, index: Index, chosen: range, where: str) -> None:
        self._index, self._chosen, self._where = index, chosen, where
        self.found: list[int] = []
        self.turned = False

    def run(self, container: av.container.InputContainer, stream: av.VideoStream) -> Iterator[tuple[str, np.ndarray]]:
        """(name for messages, (H, W, 3) uint8 RGB) of each chosen frame."""
        stamps = self._index.stamps
        first, last = stamps[self._chosen.start], stamps[self._chosen.stop - 1]
        place = {int(s): i for i, s in enumerate(stamps)}
        keys = self._index.keys[self._index.keys <= first]
        if len(keys) > 1 and not self._index.counted:
            container.seek(int(keys[-2]), stream=stream)  # the last may lean on the one before it
        for i, frame in enumerate(container.decode(stream)):
            stamp = int(stamps[min(i, len(stamps) - 1)]) if self._index.counted else frame.pts
            if stamp is None or stamp < first or stamp not in place:
                continue
            if stamp > last:
                break
            if self.found and place[stamp] <= self.found[-1]:
                continue
            check_image_size(frame.width, frame.height, self._where)
            self.found.append(place[stamp])
            self.turned = frame.rotation % 180 == 90
            picture = np.rot90(frame.to_ndarray(format="rgb24"), round(frame.rotation / 90))
            yield f"{self._where} at {(stamp - stamps[0]) * self._index.base:.3f} s", np.ascontiguousarray(picture)


def read_index(path: Path) -> Index:
    """Time stamps by one demux, without decoding."""
    with opened(path) as container:
        stream = picture_stream(container, str(path))
        packets = [(p.pts, p.is_keyframe) for p in container.demux(stream) if p.size and not p.is_discard]
        base, reordered = float(stream.time_base or 0), stream.codec_context.has_b_frames
        rate = float(stream.average_rate or 24)
    if not packets:
        raise GenmojoError("video", "holds no frame", str(path), "give a video with pictures")
    check_limit("frames", len(packets), str(path))
    stamps = np.array([pts for pts, _ in packets if pts is not None], np.int64)
    keys = np.unique([pts for pts, is_key in packets if is_key and pts is not None])
    if len(stamps) < len(packets) or not base:
        return Index(np.arange(len(packets)), keys, 1 / rate, counted=True)
    in_file_order = bool((np.diff(stamps) > 0).all())  # of frames that are shown in another order: made up
    return Index(np.unique(stamps), keys, base, counted=in_file_order and reordered)


def opened(path: Path) -> av.container.InputContainer:
    """The container; the caller closes it. Raises GenmojoError("io") if the file cannot be opened."""
    try:
        return av.open(str(path), metadata_errors="ignore")
    except OSError as error:
        if isinstance(error, FFmpegError) and not isinstance(error, FileNotFoundError | PermissionError):
            raise
        raise GenmojoError("io", f"cannot be read ({error.strerror})", str(path), "check the path") from error


def picture_stream(container: av.container.InputContainer, where: str) -> av.VideoStream:
    """The first stream of pictures, with the decoder held to the size limits."""
    if not container.streams.video:
        raise GenmojoError("video", "holds sound but no pictures" if container.streams.audio else "holds no pictures",
                           where, "give a video with pictures")  # fmt: skip
    stream = container.streams.video[0]
    if stream.codec_context is None:
        raise GenmojoError("video", "is stored in a codec that is not known here", where, "convert it to H.264 in mp4")
    stream.codec_context.options = {"max_pixels": str(LIMITS["image_pixels"].most)}
    check_image_size(stream.codec_context.width, stream.codec_context.height, where)
    return stream


def _pixel_aspect(stream: av.VideoStream, *, turned: bool) -> float | None:
    """width / height of a pixel as the file states it, after rotation."""
    ratio = float(stream.sample_aspect_ratio or 0)
    if not PIXEL_ASPECT_RANGE[0] <= ratio <= PIXEL_ASPECT_RANGE[1]:
        return None
    return 1 / ratio if turned else ratio


def video_error(error: FFmpegError, where: str) -> GenmojoError:
    """What FFmpeg says, in one sentence."""
    if isinstance(error, EOFError):
        return GenmojoError("video", "holds no frame", where, "give a video with pictures")
    if isinstance(error, InvalidDataError):
        return GenmojoError(
            "video", "is no video, or its header is missing or damaged", where, "record or copy it again"
        )
    return GenmojoError("video", f"cannot be decoded ({error.strerror})", where, "convert it to H.264 in mp4")
