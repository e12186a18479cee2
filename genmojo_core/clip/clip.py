"""What the camera gave: one clip, every channel with its validity and where it came from."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Channel:
    """A value, where it holds, and who gave it. Nothing downstream sees NaN or a 0 that means "missing".

    Args:
        value: the data; entries that are not valid hold finite filler.
        valid: bool, of the value's leading shape (per pixel, per frame or 0-d).
        source: "given: <file>" or "estimated: <method>".
    """

    value: Any
    valid: np.ndarray
    source: str

    @property
    def given(self) -> bool:
        """True if it was read from the user's files, False if estimated."""
        return self.source.startswith("given")


@dataclass(frozen=True)
class Clip:
    """A multi-object video and whatever is known about it.

    T frames of H x W pixels, K objects. Labels in `masks` are 0 for background and k + 1 for object k (0..K-1).

    Args:
        name: short name of the clip.
        path: where it was read from (for messages), or "procedural".
        frames: (T, H, W, 3) uint8 RGB.
        frame_index: (T,) int64, number of each frame in the source (gaps allowed).
        seconds: (T,) float64 time stamps, strictly increasing.
        source_names: T file names or time labels.
        source_size: (width, height) of the source; queries and tracks of users are in its raster pixels.
        pixel_aspect: width / height of one *source* pixel as shown (16:9 squeezed to a square: 1.779).
        object_ids: (K,) int64 ids in the source's masks. object_names: K names.
        masks: (T, H, W) uint8 labels; `valid` (T, H, W) is False on void (255) pixels and in frames without a mask.
        depth: (T, H, W) float32 z in scene units, or None.
        cameras: Cameras for size (W, H); `valid` (T,), or None.
        flow: (T, H, W, 2) float32 pixels from frame t to t + 1 (dx, dy), last frame invalid, or None.
        background: (H, W, 3) uint8 plate seen by the camera of `background_frame` with objects taken away, or None.
        background_depth: (H, W) float32 depth of that plate, or None.
        tracks: PointTracks in source pixels (genmojo_core.tracks.model), or None.
        world_up: (3,) unit vector in world coordinates.
        guesses: sentences that tell the user which channels are guesses and how good they are.
    """

    name: str
    path: str
    frames: np.ndarray
    frame_index: np.ndarray
    seconds: np.ndarray
    source_names: tuple[str, ...]
    source_size: tuple[int, int]
    pixel_aspect: float = 1.0
    object_ids: np.ndarray = field(default_factory=lambda: np.zeros(0, np.int64))
    object_names: tuple[str, ...] = ()
    masks: Channel | None = None
    depth: Channel | None = None
    cameras: Channel | None = None
    flow: Channel | None = None
    background: Channel | None = None
    background_depth: Channel | None = None
    background_frame: int = 0
    tracks: Channel | None = None
    world_up: np.ndarray = field(default_factory=lambda: np.array([0.0, -1.0, 0.0]))
    guesses: tuple[str, ...] = ()

    def __len__(self) -> int:
        return len(self.frames)

    @property
    def size(self) -> tuple[int, int]:
        """(width, height) of the frames held."""
        return int(self.frames.shape[2]), int(self.frames.shape[1])

    @property
    def objects(self) -> int:
        """Number of objects K."""
        return len(self.object_ids)

    @property
    def held_pixel_aspect(self) -> float:
        """width / height of one pixel of the frames *held*, which may be resized unevenly against the source."""
        sx, sy = self.size[0] / self.source_size[0], self.size[1] / self.source_size[1]
        return self.pixel_aspect * sy / sx

    def object_mask(self, k: int) -> np.ndarray:  # (T, H, W) bool
        """Visible pixels of object k (0..K-1) in every frame."""
        if self.masks is None:
            return np.zeros(self.frames.shape[:3], bool)
        return (self.masks.value == k + 1) & self.masks.valid

    def with_channels(self, **channels: Any) -> Clip:
        """The same clip with some fields replaced."""
        return replace(self, **channels)
