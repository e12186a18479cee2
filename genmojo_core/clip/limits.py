"""Every size, count and ratio limit for what is read, in one table; checked before anything is allocated."""

from __future__ import annotations

from dataclasses import dataclass

from genmojo_core.errors import GenmojoError


@dataclass(frozen=True)
class Limit:
    """The largest value that is read, its unit as said in messages, and what the user can do about a larger one."""

    most: int
    unit: str
    hint: str


LIMITS: dict[str, Limit] = {
    "image_side": Limit(16_384, "pixels on one side", "give smaller images"),
    "image_pixels": Limit(80_000_000, "pixels in one image", "give smaller images"),
    "image_bytes": Limit(1 << 28, "bytes in one image file", "give smaller images"),
    "frames": Limit(200_000, "frames", "cut the clip"),
    "clip_bytes": Limit(6 << 30, "bytes of frames held at once", "select fewer frames or a smaller short side"),
    "objects": Limit(254, "objects", "merge or drop objects"),
    "folder_entries": Limit(1_000_000, "files in one folder", "cut the clip"),
    "array_bytes": Limit(64 << 30, "bytes in one array", "store it at a smaller resolution"),
    "held_array_bytes": Limit(8 << 30, "bytes in one array that is read at once", "store fewer entries"),
    "array_names": Limit(1000, "arrays in one npz file", "keep only the arrays that are needed"),
    "array_rank": Limit(8, "axes in one array", "store it with fewer axes"),
    "array_header": Limit(10_000, "bytes in the header of an array", "store plain numbers"),
    "tracks": Limit(200_000, "point tracks", "keep fewer points"),
    "meta_bytes": Limit(1 << 20, "bytes of JSON", "shorten it"),
    "name_length": Limit(200, "characters in a name", "shorten it"),
}

DEPTH_RANGE = (1e-6, 1e6)  # scene units; outside, a depth value is not valid
FLOW_MOST = 4.0  # image diagonals; a longer flow vector is not valid
PIXEL_ASPECT_RANGE = (0.1, 10.0)
FPS_RANGE = (1e-3, 1e5)
ASPECT_TOLERANCE = 0.05  # relative; how far a channel's picture shape may be from its frames'


def check_limit(name: str, value: int, where: str) -> None:
    """Raise GenmojoError("size") if a value is above its limit in `LIMITS`."""
    limit = LIMITS[name]
    if value > limit.most:
        raise GenmojoError("size", f"holds {value} {limit.unit}, allowed are {limit.most}", where, limit.hint)


def check_image_size(width: int, height: int, where: str) -> None:
    """Raise GenmojoError for an image without pixels ("format") or with too many ("size")."""
    if width < 1 or height < 1:
        raise GenmojoError("format", f"declares an image of {width} x {height} pixels", where, "write the file again")
    check_limit("image_side", max(width, height), where)
    check_limit("image_pixels", width * height, where)
