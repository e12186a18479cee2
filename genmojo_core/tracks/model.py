"""Point tracks: positions, states and owners. They live in the clip layer, because a clip may bring tracks along."""

from __future__ import annotations

from genmojo_core.clip.points import NONE, OCCLUDED, OUT_OF_VIEW, VISIBLE, PointTracks

__all__ = ["NONE", "OCCLUDED", "OUT_OF_VIEW", "VISIBLE", "PointTracks"]
