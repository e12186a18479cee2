"""Point tracks: positions, states and owners."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

NONE, VISIBLE, OCCLUDED, OUT_OF_VIEW = 0, 1, 2, 3  # state of a point in a frame


@dataclass(frozen=True)
class PointTracks:
    """N point tracks over T frames (the npz of ARCHITECTURE.md section 5).

    Args:
        xy: (N, T, 2) float32 raster pixels of an image of `size`; where state is NONE, NaN is allowed.
        state: (N, T) uint8, one of NONE, VISIBLE, OCCLUDED, OUT_OF_VIEW.
        object: (N,) int64 object id, 0 for background.
        size: (width, height) in pixels.
        xyz: (N, T, 3) float32 world, or None.
        conf: (N, T) float32 confidence 0..1, or None.
        flags, source: (N, T) uint8 as in ANNOTATOR.md section 3, or None.
    """

    xy: np.ndarray
    state: np.ndarray
    object: np.ndarray
    size: tuple[int, int]
    xyz: np.ndarray | None = None
    conf: np.ndarray | None = None
    flags: np.ndarray | None = None
    source: np.ndarray | None = None

    @property
    def visible(self) -> np.ndarray:  # (N, T) bool
        """Where a point is seen."""
        return self.state == VISIBLE

    def resized(self, width: float, height: float) -> PointTracks:
        """The same tracks in pixels of an image of another size (x and y scaled on their own)."""
        scale = np.array([width / self.size[0], height / self.size[1]], np.float32)
        return PointTracks(self.xy * scale, self.state, self.object, (int(width), int(height)), self.xyz, self.conf,
                           self.flags, self.source)  # fmt: skip
