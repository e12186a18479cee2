"""A snapshot on the GPU: one texel per splat in 2D textures, and one array layer per frame where frames are known.

Time needs no upload once a frame's layer is there: shaders interpolate between two layers. Layers are filled when a
frame is first shown (or prefetched); where all do not fit the budget, the longest unused one is overwritten.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from genmojo_core.store.scene_file import Frame
from genmojo_studio.view3d.look import ObjectTable
from genmojo_studio.view3d.snapshot import SceneSnapshot

TEXELS = 1024  # width of every splat texture
LAYER_BYTES = 40  # per splat and frame
LAYER_BUDGET = 256 << 20  # bytes
_NEAREST = (0x2600, 0x2600)  # GL_NEAREST


def rows_of(count: int) -> int:
    """Texture rows for that many splats (at least one)."""
    return max(1, -(-count // TEXELS))


def nearest(texture: Any) -> Any:
    """The texture, set to give texels as they are."""
    texture.filter = _NEAREST
    return texture


class SceneTextures:
    """Textures of one snapshot. The owner makes the context current and calls `release`.

    Args:
        ctx: moderngl context, 3.3 core.
        snapshot: what to upload; its first use uploads all of it.
    """

    def __init__(self, ctx: Any, snapshot: SceneSnapshot) -> None:
        self.ctx = ctx
        self.snapshot = snapshot
        size = (TEXELS, rows_of(len(snapshot)))
        self.places, self.turns, self.sizes, self.colours, self.next_places = (
            nearest(ctx.texture(size, 4, dtype="f4")) for _ in range(5)
        )
        self.scalars = nearest(ctx.texture(size, 1, bytes(4 * size[0] * size[1]), dtype="f4"))
        self.objects = nearest(ctx.texture((3, max(1, len(snapshot.object_ids))), 4, dtype="f4"))
        self.order = nearest(ctx.texture(size, 1, dtype="u4"))
        self._next_of: object = None
        self._layers: list[Any] = []  # places, turns, size ratios, colours
        self._slot_of: dict[int, int] = {}  # frame -> layer; order of use, oldest first
        self._positions: dict[int, np.ndarray] = {}  # frame -> (N, 3), for sorting
        self._slots = 0
        self.upload(snapshot)

    def fits(self, snapshot: SceneSnapshot) -> bool:
        """Can the snapshot take this one's place without new textures?"""
        same = rows_of(len(snapshot)) == rows_of(len(self.snapshot))
        return same and len(snapshot.object_ids) == len(self.snapshot.object_ids) and snapshot.frames is None \
            and self.snapshot.frames is None  # fmt: skip

    def upload(self, snapshot: SceneSnapshot) -> None:
        """Write all attributes of a snapshot that `fits`."""
        self.snapshot = snapshot
        self._next_of = None
        _write(self.places, snapshot.positions)
        _write(self.turns, snapshot.rotations)
        _write(self.sizes, np.column_stack([snapshot.scales, snapshot.opacities]))
        _write(self.colours, np.column_stack([snapshot.colours, snapshot.object_index]))

    def write_objects(self, table: ObjectTable) -> None:
        """Write the object table: a few texels, no splat attributes."""
        texels = np.zeros((max(1, len(table.shown)), 3, 4), np.float32)
        count = len(table.shown)
        texels[:count, 0, :3], texels[:count, 0, 3] = table.offset, table.opacity
        texels[:count, 1], texels[:count, 2, :3] = table.tint, table.color
        self.objects.write(texels.tobytes())

    def write_order(self, order: np.ndarray) -> None:
        """Write the drawing order (M,) uint32."""
        if len(order):
            padded = np.zeros(rows_of(len(order)) * TEXELS, np.uint32)
            padded[: len(order)] = order
            self.order.write(padded.tobytes(), viewport=(0, 0, TEXELS, rows_of(len(order))))

    def write_scalars(self, values: np.ndarray) -> None:
        """Write one number per splat (N,)."""
        _write(self.scalars, np.asarray(values, np.float32)[:, None])

    def write_next(self, key: object, positions: np.ndarray) -> None:
        """Write where splats are in the next frame (N, 3), unless `key` says that this is there already."""
        if key != self._next_of:
            _write(self.next_places, positions)
            self._next_of = key

    def layer(self, t: int) -> int:
        """The array layer of frame t, filled if need be; -1 where frames are not known."""
        if self.snapshot.frames is None:
            return -1
        if t in self._slot_of:
            self._slot_of[t] = self._slot_of.pop(t)
            return self._slot_of[t]
        if not self._layers:
            self._make_layers()
        if len(self._slot_of) < self._slots:
            slot = len(self._slot_of)
        else:
            oldest = next(iter(self._slot_of))
            slot = self._slot_of.pop(oldest)
            self._positions.pop(oldest, None)
        self._slot_of[t] = slot
        self._fill(slot, t, self.snapshot.frames.frame(t))
        return slot

    def missing(self) -> int | None:
        """A frame that is not on the GPU although there is room, or None: for prefetching while idle."""
        if self.snapshot.frames is None or (self._slots and len(self._slot_of) >= self._slots):
            return None
        return next((t for t in range(self.snapshot.T) if t not in self._slot_of), None)

    def positions(self, t: float) -> np.ndarray:
        """(N, 3) float32 at a time between frames, as the shader interpolates."""
        if self.snapshot.frames is None:
            return self.snapshot.positions
        first = int(t)
        self.layer(first)
        if t == first:
            return self._positions[first]
        self.layer(first + 1)
        share = np.float32(t - first)
        return self._positions[first] * (1 - share) + self._positions[first + 1] * share

    def release(self) -> None:
        """Free every texture."""
        for texture in (self.places, self.turns, self.sizes, self.colours, self.next_places, self.scalars,
                        self.objects, self.order, *self._layers):  # fmt: skip
            texture.release()
        self._layers = []

    def _make_layers(self) -> None:
        """Allocate as many layers as the budget and the driver allow, two at least."""
        rows = rows_of(len(self.snapshot))
        most = min(LAYER_BUDGET // (rows * TEXELS * LAYER_BYTES), self.ctx.info["GL_MAX_ARRAY_TEXTURE_LAYERS"])
        self._slots = max(2, min(self.snapshot.T, most))
        size = (TEXELS, rows, self._slots)
        self._layers = [
            nearest(self.ctx.texture_array(size, 4, dtype=kind)) for kind in ("f4", "f2", "f2", "f2")
        ]  # fmt: skip

    @property
    def layers(self) -> list[Any]:
        """The four arrays (places, turns, size ratios, colours); empty where frames are not known."""
        return self._layers

    def _fill(self, slot: int, t: int, frame: Frame) -> None:
        """Write frame t into a layer."""
        ratio = frame.scales / np.maximum(self.snapshot.scales, 1e-30)
        for texture, array, kind in zip(
            self._layers, (frame.means, frame.quats, ratio, frame.rgb), ("f4", "f2", "f2", "f2"), strict=True
        ):
            rows = rows_of(len(array))
            padded = np.zeros((rows * TEXELS, 4), kind)
            padded[: len(array), : array.shape[1]] = array
            texture.write(padded.tobytes(), viewport=(0, 0, slot, TEXELS, rows, 1))
        self._positions[t] = frame.means


def _write(texture: Any, values: np.ndarray) -> None:
    """Write (N, c) values into a texture of c or four channels, rows padded with zeros."""
    channels = texture.components
    padded = np.zeros((texture.height * TEXELS, channels), np.float32)
    padded[: len(values), : values.shape[1]] = values
    texture.write(padded.tobytes())
