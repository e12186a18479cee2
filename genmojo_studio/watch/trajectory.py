"""One Gaussian over time: where it goes and what its parameters do. Knows no Qt."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from genmojo_core.tracks.model import VISIBLE, PointTracks
from genmojo_studio.view3d.snapshot import SceneSnapshot


@dataclass(frozen=True)
class Trajectory:
    """A Gaussian in T frames.

    position (T, 3) world; rotation (T, 4) wxyz; scale (T, 3) linear; opacity (T,); colour (T, 3). `first`: position of
    the first of these frames in the clip.
    """

    uid: int
    object_id: int
    position: np.ndarray
    rotation: np.ndarray
    scale: np.ndarray
    opacity: np.ndarray
    colour: np.ndarray
    first: int = 0

    def curves(self, what: str) -> dict[str, np.ndarray]:
        """Name -> (T,) values of "position", "speed", "turn", "scale", "opacity" or "colour"."""
        if what == "position":
            return dict(zip("xyz", self.position.T, strict=True))
        if what == "speed":
            return {"speed": np.linalg.norm(np.diff(self.position, axis=0, append=self.position[-1:]), axis=1)}
        if what == "turn":
            cosine = np.abs(self.rotation @ self.rotation[0]) / np.linalg.norm(self.rotation, axis=1)
            return {"turn": np.degrees(2 * np.arccos(np.clip(cosine / np.linalg.norm(self.rotation[0]), 0, 1)))}
        if what == "scale":
            return {f"sigma {i + 1}": self.scale[:, i] for i in range(3)}
        if what == "opacity":
            return {"opacity": self.opacity}
        return dict(zip(("red", "green", "blue"), self.colour.T, strict=True))

    def as_track(self, size: tuple[int, int]) -> PointTracks:
        """The way as a point track with 3D positions only, to be drawn over a view."""
        frames = len(self.position)
        nowhere = np.full((1, frames, 2), np.nan, np.float32)
        states = np.full((1, frames), VISIBLE, np.uint8)
        return PointTracks(nowhere, states, np.array([self.object_id]), size, self.position[None].astype(np.float32))


def of(snapshot: SceneSnapshot, row: int) -> Trajectory:
    """The trajectory of a row of a snapshot; one frame long where other frames are not known. Takes a while: every
    frame of the scene is worked out, so do it on a thread."""
    frames = [snapshot] if snapshot.frames is None else [snapshot.at(t) for t in range(snapshot.T)]
    return Trajectory(
        int(snapshot.uid[row]),
        int(snapshot.object_id[row]),
        np.stack([f.positions[row] for f in frames]),
        np.stack([f.rotations[row] for f in frames]),
        np.stack([f.scales[row] for f in frames]),
        np.array([f.opacities[row] for f in frames]),
        np.stack([f.colours[row] for f in frames]),
        snapshot.frame if snapshot.frames is None else 0,
    )
