"""How a scene is shown: render mode, objects, splat size, backdrop. Plain values, one `Look` per view."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from enum import StrEnum

import numpy as np

from genmojo_studio.view3d.snapshot import SceneSnapshot

RGB = tuple[float, float, float]
BLACK: RGB = (0.0, 0.0, 0.0)


class Mode(StrEnum):
    """What a view's pixels mean."""

    RGB = "rgb"
    INSTANCE = "instance"  # the object with the largest share of a pixel
    INSTANCE_SOFT = "instance_soft"  # objects' colours mixed by their shares
    DEPTH = "depth"  # expected z
    DEPTH_MEDIAN = "depth_median"  # z where half of the light is absorbed
    FLOW = "flow"  # motion to the next frame in pixels
    NORMAL = "normal"  # thinnest axis, towards the camera
    OPACITY = "opacity"  # coverage
    RESIDUAL = "residual"  # every Gaussian's error in the input view
    ELLIPSOIDS = "ellipsoids"
    CENTRES = "centres"


TITLES = {
    Mode.RGB: "Colour", Mode.INSTANCE: "Objects", Mode.INSTANCE_SOFT: "Objects, mixed", Mode.DEPTH: "Depth",
    Mode.DEPTH_MEDIAN: "Depth, median", Mode.FLOW: "Motion to the next frame", Mode.NORMAL: "Surface direction",
    Mode.OPACITY: "Coverage", Mode.RESIDUAL: "Error against the input", Mode.ELLIPSOIDS: "Ellipsoids",
    Mode.CENTRES: "Centres",
}  # fmt: skip
SCALAR_MODES = frozenset({Mode.DEPTH, Mode.DEPTH_MEDIAN, Mode.OPACITY, Mode.RESIDUAL, Mode.FLOW})  # have a legend


@dataclass(frozen=True)
class ObjectLook:
    """One object's appearance: shown or not, tinted towards a colour by `tint_mix` (0..1), opacity times a gain."""

    visible: bool = True
    tint: RGB | None = None
    tint_mix: float = 0.5
    opacity: float = 1.0


@dataclass(frozen=True)
class Look:
    """Everything about a picture except scene, camera and time.

    Args:
        mode: what is shown.
        splat_scale: sigmas times this, 0..3.
        backdrop: RGB behind everything, or None for a transparent picture (screenshots, videos).
        show_background: False leaves the background object out.
        solo: only objects with these ids are drawn; empty for all.
        objects: object id -> look; others look plain.
        explode: objects move away from the target by this times their distance from it.
        value_range: (lowest, highest) value of the colour scale in scalar modes, or None for the picture's own.
        canonical: True shows every object in the shape it was reconstructed in, without its motion.
    """

    mode: Mode = Mode.RGB
    splat_scale: float = 1.0
    backdrop: RGB | None = BLACK
    show_background: bool = True
    solo: frozenset[int] = frozenset()
    objects: Mapping[int, ObjectLook] = field(default_factory=dict)
    explode: float = 0.0
    value_range: tuple[float, float] | None = None
    canonical: bool = False

    def of(self, object_id: int) -> ObjectLook:
        """The look of one object."""
        return self.objects.get(object_id, ObjectLook())

    def with_object(self, object_id: int, look: ObjectLook) -> Look:
        """The same with another look of one object."""
        return replace(self, objects={**self.objects, object_id: look})

    def shows(self, snapshot: SceneSnapshot, object_id: int) -> bool:
        """Is this object drawn?"""
        if self.solo and object_id not in self.solo:
            return False
        if not self.show_background and snapshot.object_of(object_id).is_background:
            return False
        return self.of(object_id).visible


@dataclass(frozen=True)
class ObjectTable:
    """A look worked out for a snapshot's K objects, rows as `snapshot.object_ids`; what renderers read.

    shown (K,) bool; opacity (K,); tint (K, 4) RGB and mix; color (K, 3) for the object modes; offset (K, 3) world.
    """

    shown: np.ndarray
    opacity: np.ndarray
    tint: np.ndarray
    color: np.ndarray
    offset: np.ndarray


def object_table(snapshot: SceneSnapshot, look: Look) -> ObjectTable:
    """The table of a snapshot under a look. Objects move apart along the line from the target to their median."""
    ids = [int(i) for i in snapshot.object_ids]
    named = [snapshot.object_of(i) for i in ids]
    looks = [look.of(i) for i in ids]
    tint = [(*(one.tint or (0.0, 0.0, 0.0)), one.tint_mix if one.tint else 0.0) for one in looks]
    offset = np.zeros((len(ids), 3), np.float32)
    if look.explode:
        for k, one in enumerate(named):
            rows = snapshot.positions[snapshot.object_index == k]
            if not one.is_background and len(rows):
                offset[k] = look.explode * (np.median(rows, axis=0) - snapshot.orbit_target)
    return ObjectTable(
        np.array([look.shows(snapshot, i) for i in ids], bool),
        np.array([one.opacity for one in looks], np.float32),
        np.array(tint, np.float32).reshape(-1, 4),
        np.array([o.color for o in named], np.float32).reshape(-1, 3),
        offset,
    )
