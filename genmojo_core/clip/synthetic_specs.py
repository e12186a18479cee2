"""What the procedural clips show: the description type and the named ones."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from genmojo_core.clip.shapes import Shape, Vector
from genmojo_core.errors import GenmojoError


@dataclass(frozen=True)
class SyntheticSpec:
    """What to make; world units, z up, ground z = 0.

    Args:
        name: of the clip. shapes: solids. frames: T. size: (width, height) in pixels.
        parts: object of each shape, 0.. without gaps, object k has id k + 1; empty: every shape is one of its own.
        eye: camera centres at the clip's start and end. target: what it looks at.
        focal: focal length in image widths. wall: y of the wall. light: strength of the light at start and end.
        given: channels that the clip itself carries, of "depth", "cameras", "flow".
        tracks: points per object. fps: frames per second. seed: of the points' choice.
        novel_every: novel views are made of every n-th frame; 0 for none.
    """

    name: str
    shapes: tuple[Shape, ...]
    frames: int = 24
    size: tuple[int, int] = (192, 108)
    eye: tuple[Vector, Vector] = ((0.0, -6.0, 1.9), (0.0, -6.0, 1.9))
    target: Vector = (0.0, 0.0, 0.8)
    focal: float = 1.1
    wall: float = 3.0
    light: tuple[float, float] = (1.0, 1.0)
    given: tuple[str, ...] = ("depth", "cameras")
    tracks: int = 12
    fps: float = 24.0
    seed: int = 0
    novel_every: int = 3
    parts: tuple[int, ...] = ()

    def object_of(self) -> np.ndarray:
        """(S,) int64: index of the object that each shape belongs to."""
        return np.array(self.parts or range(len(self.shapes)), np.int64)


def spec(name: str) -> SyntheticSpec:
    """A named clip: "crossing-shapes" (the demo), "moving-camera", "still", "leaves-and-returns", "pixel".

    Raises GenmojoError("argument") for another name.
    """
    if name not in SPECS:
        raise GenmojoError("argument", f"there is no procedural clip '{name}'", hint=f"use {', '.join(SPECS)}")
    return SPECS[name]()


BALL = Shape(
    "ball", (0.5, 0.5, 0.5), ((-1.5, -1.0, 0.5), (1.5, -1.0, 0.5)), ((0.85, 0.2, 0.1), (0.98, 0.8, 0.35)),
    pattern=2.6, spin=120.0,
)  # fmt: skip
CUBE = Shape(
    "cube", (0.42, 0.42, 0.5), ((1.7, 0.2, 0.5), (-1.5, 0.2, 0.5)), ((0.1, 0.35, 0.75), (0.75, 0.9, 0.95)),
    pattern=1.5, checker=True, turned=20.0, spin=-100.0,
)  # fmt: skip
CYLINDER = Shape(
    "cylinder", (0.4, 0.4, 0.8), ((0.3, 1.4, 0.8), (-0.2, 1.4, 0.8)), ((0.15, 0.5, 0.2), (0.9, 0.9, 0.3)),
    pattern=2.2, spin=60.0, sway=0.25,
)  # fmt: skip


def _crossing() -> SyntheticSpec:
    """A ball in front and a cube behind it pass each other before a cylinder that sways."""
    return SyntheticSpec("crossing-shapes", (BALL, CUBE, CYLINDER))


def _moving_camera() -> SyntheticSpec:
    """The demo's objects seen by a camera that travels, under a light that fades."""
    return replace(_crossing(), name="moving-camera", eye=((-0.8, -6.0, 1.7), (0.9, -5.8, 2.2)), light=(1.0, 0.5))


def _still() -> SyntheticSpec:
    """One frame."""
    return replace(_crossing(), name="still", frames=1)


def _leaves_and_returns() -> SyntheticSpec:
    """The ball goes out of the picture in the middle of the clip and comes back; the cube turns in its place."""
    ball = replace(BALL, path=((0.0, -1.0, 0.5), (3.6, -1.0, 0.5), (3.6, -1.0, 0.5), (0.0, -1.0, 0.5)))
    return SyntheticSpec("leaves-and-returns", (ball, replace(CUBE, path=((-0.6, 0.6, 0.5),))))


def _pixel() -> SyntheticSpec:
    """A ball of exactly one pixel, which moves one pixel a frame, beside the cube."""
    frames = 8
    base = SyntheticSpec("pixel", (), frames=frames)
    forward = np.array(base.target) - np.array(base.eye[0])
    forward /= np.linalg.norm(forward)
    down = np.array([0.0, forward[2], -forward[1]])  # forward x right, with right = +x
    focal, depth = base.focal * base.size[0], 4.0
    row, column = 30.5 - base.size[1] / 2, 40.5 - base.size[0] / 2  # from the picture's centre to a pixel's centre
    start = np.array(base.eye[0]) + depth * (forward + down * row / focal)
    ends = [tuple(start + [depth * (column + step) / focal, 0, 0]) for step in (0, frames - 1)]
    speck = replace(BALL, radii=(0.45 * depth / focal,) * 3, path=(ends[0], ends[1]))
    return replace(base, shapes=(speck, replace(CUBE, path=((0.3, 0.3, 0.5), (-0.3, 0.3, 0.5)))))


SPECS: dict[str, Callable[[], SyntheticSpec]] = {
    "crossing-shapes": _crossing,
    "moving-camera": _moving_camera,
    "still": _still,
    "leaves-and-returns": _leaves_and_returns,
    "pixel": _pixel,
}
