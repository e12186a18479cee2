"""What tells whether a clip's pictures are those that were annotated: a SHA-256 per frame of what is stored, undecoded.

"file:<hex>" of the bytes of a picture's file, "packet:<hex>" of a video's packets for that frame. Only digests of one
kind can be compared.
"""

from __future__ import annotations

import hashlib
from collections.abc import Collection, Iterator, Sequence
from pathlib import Path

from av.error import FFmpegError

from genmojo_core.clip import layouts, video
from genmojo_core.errors import GenmojoError


def of_frames(path: str | Path, last: Collection[int] = ()) -> Iterator[tuple[int, str]]:
    """(frame, digest) of every frame; those in `last` come after the others where each has a file of its own.

    Raises GenmojoError as `layouts.find` and `video.read_index`, "io" for a file that cannot be read.
    """
    layout = layouts.find(Path(path))
    if layout.video is not None:
        yield from _of_video(layout.video)
        return
    order = sorted(range(len(layout.frames)), key=lambda frame: (frame in last, frame))
    for frame in order:
        file = layout.frames[frame]
        try:
            with open(file, "rb") as stream:
                yield frame, f"file:{hashlib.file_digest(stream, 'sha256').hexdigest()}"
        except OSError as error:
            raise GenmojoError("io", f"cannot be read ({error.strerror})", str(file), "check the file") from error


def differing(one: Sequence[str], other: Sequence[str]) -> tuple[list[int], int]:
    """Frames whose digests differ, and how many could be compared: both known and of the same kind."""
    both = [(frame, a, b) for frame, (a, b) in enumerate(zip(one, other, strict=False))
            if a and b and _kind(a) == _kind(b)]  # fmt: skip
    return [frame for frame, a, b in both if a != b], len(both)


def _kind(digest: str) -> str:
    return digest.partition(":")[0] if ":" in digest else ""


def _of_video(path: Path) -> Iterator[tuple[int, str]]:
    """By one demux. Frames in the order of their time stamps, or as they come where stamps are made up."""
    index = video.read_index(path)
    places = {int(stamp): frame for frame, stamp in enumerate(index.stamps)}
    found: dict[int, hashlib._Hash] = {}
    try:
        with video.opened(path) as container:
            stream = video.picture_stream(container, str(path))
            packets = (p for p in container.demux(stream) if p.size and not p.is_discard)
            for number, packet in enumerate(packets):
                frame = number if index.counted else places.get(int(packet.pts), -1) if packet.pts is not None else -1
                if 0 <= frame < len(index.stamps):
                    found.setdefault(frame, hashlib.sha256()).update(bytes(packet))
    except FFmpegError as error:
        raise video.video_error(error, str(path)) from error
    for frame in sorted(found):
        yield frame, f"packet:{found[frame].hexdigest()}"
